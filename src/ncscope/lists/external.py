"""The list of external variables: which V.E names a program may use.

Source: TF5200 external variables, P-EXTV-00001 (name), 00003 (type), 00006 (access_rights), 00007
(array_elements, older array_size), 00008 (size). Memory layout and scope have no effect here.
"""

from __future__ import annotations

import re
from collections import defaultdict

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.lists.document import Entry, ListDocument
from ncscope.machine import ExternalVariable

TYPES = {
    "BOOLEAN": "BOOLEAN", "SGN08": "SGN08", "UNS08": "UNS08", "SGN16": "SGN16", "UNS16": "UNS16",
    "SGN32": "SGN32", "UNS32": "UNS32", "REAL64": "REAL64", "REAL": "REAL64",
    "STRING": "STRING", "VSTRING": "STRING", "CHAR": "SGN08",
}  # fmt: skip
ACCESS = ("READ_ONLY", "WRITE_ONLY", "READ_WRITE")
MOST_ELEMENTS = 100_000
DEFAULT_STRING = 127
_FIELD = re.compile(r"var\[(\d+)\]\.(\w+)", re.IGNORECASE)


def external_variables(
    document: ListDocument,
) -> tuple[dict[str, ExternalVariable], tuple[Diagnostic, ...]]:
    """The variables of the list by name; what is wrong is left out with a warning."""
    records: dict[int, dict[str, Entry]] = defaultdict(dict)
    for entry in document.entries:
        match = _FIELD.fullmatch(entry.key)
        if match:
            records[int(match.group(1))][match.group(2).lower()] = entry
    found: list[Diagnostic] = []
    variables: dict[str, ExternalVariable] = {}
    for _, record in sorted(records.items()):
        if "name" in record:
            variables[_first(record["name"])] = _variable(record, found)
    return variables, tuple(found)


def _variable(record: dict[str, Entry], found: list[Diagnostic]) -> ExternalVariable:
    kind = _choice(record.get("type"), tuple(TYPES), "REAL64", found)
    access = _choice(record.get("access_rights"), ACCESS, "READ_WRITE", found)
    elements = _whole(record.get("array_elements") or record.get("array_size"), 0, found)
    size = _whole(record.get("size"), 0, found)
    length = min((size or DEFAULT_STRING + 1) - 1, DEFAULT_STRING)
    return ExternalVariable(TYPES[kind], min(elements, MOST_ELEMENTS), length, access)


def _first(entry: Entry) -> str:
    return entry.value_text.split()[0] if entry.value_text.split() else ""


def _choice(
    entry: Entry | None, allowed: tuple[str, ...], default: str, found: list[Diagnostic]
) -> str:
    if entry is None:
        return default
    text = _first(entry).upper()
    if text in allowed:
        return text
    hint = "write one of " + " ".join(allowed)
    message = f"{entry.key}: {text or 'nothing'} is not allowed; {default} is taken"
    found.append(diagnostic("110552", entry.value_span, message, hint))
    return default


def _whole(entry: Entry | None, default: int, found: list[Diagnostic]) -> int:
    if entry is None:
        return default
    text = _first(entry)
    if text.isascii() and text.isdigit() and len(text) < 10:
        return int(text)
    message = f"{entry.key}: {text or 'nothing'} is no whole number; {default} is taken"
    found.append(diagnostic("1020", entry.value_span, message))
    return default
