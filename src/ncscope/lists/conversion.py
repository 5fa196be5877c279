"""A channel list in another spelling of its kinematics; every other character stays.

Two pairs of spellings: `kinematik[91].x` (up to V2.11) and `trafo[j].x` with `trafo[j].id 91`
(from V3.00); named fields and `param[i]`. Converting there and back gives the bytes of before:
lines that V2.11 has no form for stay as comments that begin with `MARK`. Only `Kinematik` comes
back as `kinematik`: the control would not know a `Trafo`.
Source: FCT-C27 3.2 and 3.5, P-CHAN-00262, -00263, -00829.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ncscope.diagnostics import Diagnostic, Severity, diagnostic
from ncscope.kinematics.parameters import FIELD_OF_INDEX, field_index
from ncscope.lists.document import BYTE_ORDER_MARKS, Entry, ListDocument
from ncscope.lists.kinematic_sets import Slot, split_key

MARK = "# V3.00: "
UNIVERSAL = 91
MOST_SETS = 10
LAST_DOCUMENTED = 56
"""Numbers behind this one are not documented: linkage keeps its names."""

_MARKED = re.compile(
    rf"^[ \t]*(?P<mark>{re.escape(MARK)})(?P<slot>(?:kin_step\[0\]\.)?trafo\[\d+\])\.id[ \t]+"
    r"(?P<id>\d{1,18})\b",
    re.MULTILINE | re.IGNORECASE,
)
_ID = re.compile(r"[0-9]{1,18}")
_WITHOUT_OLD_FORM = re.compile(
    r"(kin_step\[[1-9]\d*\]|trafo_pcs\[\d*\]|default_id_of_kin_step\[)", re.IGNORECASE
)

Edit = tuple[int, int, str]
Converted = tuple[ListDocument, tuple[Diagnostic, ...]]


@dataclass(frozen=True, slots=True)
class _Set:
    """The entries of one slot: `id` and `type` lines apart from all others."""

    slot: Slot
    id: int
    type: int
    heads: tuple[Entry, ...]
    entries: tuple[tuple[Entry, str], ...]


def to_new_syntax(document: ListDocument) -> Converted:
    """`kinematik[91].x` as `trafo[j].x`, with a line `trafo[j].id 91` before the first."""
    sets = _sets(document)
    taken = {s.slot.spelling for s in sets if s.slot.fixed_id is None}
    marked = {int(m["id"]): m["slot"] for m in _MARKED.finditer(document.text)}
    edits = [(m.start("mark"), m.end("mark"), "") for m in _marks(document.text)]
    taken |= {slot.lower() for slot in marked.values()}
    found: list[Diagnostic] = []
    for item in sets:
        if item.slot.fixed_id is None:
            continue
        spelling = marked.get(item.id) or _free(taken)
        if spelling is None:
            found.append(_left(item, f"only {MOST_SETS} data sets are possible"))
            continue
        taken.add(spelling)
        edits.extend(_renamed(item, spelling))
        if item.id not in marked:
            edits.append(_id_line(document, item, spelling))
    return _edited(document, edits), tuple(found)


def to_old_syntax(document: ListDocument) -> Converted:
    """`trafo[j].x` as `kinematik[91].x`; the lines of id and type go, or stay as comments."""
    short, found = _old_syntax(document, keep_heads=False)
    if to_new_syntax(short)[0].text == document.text:
        return short, found
    return _old_syntax(document, keep_heads=True)


def to_parameters(document: ListDocument) -> ListDocument:
    """Named fields of the universal kinematics as `param[i]`."""
    return _edited(document, _fields(document, to_names=False))


def to_names(document: ListDocument) -> ListDocument:
    """`param[i]` of the universal kinematics as named fields."""
    return _edited(document, _fields(document, to_names=True))


def _old_syntax(document: ListDocument, keep_heads: bool) -> Converted:
    edits: list[Edit] = []
    found = list(_without_old_form(document))
    ids: set[int] = {s.id for s in _sets(document) if s.slot.fixed_id is not None}
    for item in _sets(document):
        if item.slot.fixed_id is not None or item.slot.step != 0:
            continue
        why = _no_old_form(item, ids)
        if why:
            found.append(_left(item, why))
            continue
        ids.add(item.id)
        edits.extend(_renamed(item, f"kinematik[{item.id}]"))
        for entry in item.heads:
            edits.append(_head_edit(document, entry, keep_heads))
    return _edited(document, edits), tuple(found)


def _no_old_form(item: _Set, ids: set[int]) -> str:
    if item.id == 0:
        return "it has no id"
    if not item.entries:
        return "it has no parameters"
    if item.type not in (0, item.id):
        return f"its type {item.type} differs from its id {item.id}, which V2.11 cannot say"
    return f"id {item.id} is used twice" if item.id in ids else ""


def _head_edit(document: ListDocument, entry: Entry, keep: bool) -> Edit:
    """An id or type line as a comment, or taken out with its end of line."""
    start = entry.key_span.start
    if keep:
        return start, start, MARK
    first, behind = _line(document.text, start)
    return first, behind, ""


def _without_old_form(document: ListDocument) -> Iterator[Diagnostic]:
    said: set[str] = set()
    for entry in document.entries:
        match = _WITHOUT_OLD_FORM.match(entry.key)
        if match and match[0].lower() not in said:
            said.add(match[0].lower())
            message = f"{entry.key} has no form in V2.11; it is left as it is"
            yield diagnostic("N3501", entry.key_span, message)


def _sets(document: ListDocument) -> list[_Set]:
    """The data sets in the order of their first entries."""
    by_slot: dict[Slot, list[tuple[Entry, str]]] = {}
    for entry in document.entries:
        split = split_key(entry.key)
        if split is not None:
            by_slot.setdefault(split[0], []).append((entry, split[1]))
    return [_set(slot, entries) for slot, entries in by_slot.items()]


def _set(slot: Slot, entries: list[tuple[Entry, str]]) -> _Set:
    id, type = slot.fixed_id or 0, 0
    heads = []
    for entry, field in entries:
        if field not in ("id", "type") or slot.fixed_id is not None:
            continue
        heads.append(entry)
        number = int(entry.value_text) if _ID.fullmatch(entry.value_text) else 0
        id, type = (number, type) if field == "id" else (id, number)
    others = tuple((e, f) for e, f in entries if e not in heads)
    return _Set(slot, id, type, tuple(heads), others)


def _renamed(item: _Set, spelling: str) -> Iterator[Edit]:
    for entry, _ in item.entries:
        start = entry.key_span.start
        yield start, start + len(item.slot.spelling), spelling


def _free(taken: Iterable[str]) -> str | None:
    names = (f"trafo[{place}]" for place in range(MOST_SETS))
    used = {name.removeprefix("kin_step[0].") for name in taken}
    return next((name for name in names if name not in used), None)


def _id_line(document: ListDocument, item: _Set, spelling: str) -> Edit:
    start, _ = _line(document.text, item.entries[0][0].key_span.start)
    end = "\r\n" if "\r\n" in document.text else "\n"
    return start, start, f"{spelling}.id {item.id}{end}"


def _marks(text: str) -> Iterator[re.Match[str]]:
    """The marks of all lines that were put aside: those of id lines and of type lines."""
    pattern = rf"^[ \t]*(?P<mark>{re.escape(MARK)})(?=(?:kin_step\[0\]\.)?trafo\[\d+\]\.)"
    return re.finditer(pattern, text, re.MULTILINE | re.IGNORECASE)


def _fields(document: ListDocument, to_names: bool) -> Iterator[Edit]:
    for item in _sets(document):
        if (item.type or item.id) != UNIVERSAL:
            continue
        for entry, field in item.entries:
            index = field_index(field)
            if index is None or index > LAST_DOCUMENTED or field.startswith("param") != to_names:
                continue
            name = FIELD_OF_INDEX[index] if to_names else f"param[{index}]"
            yield entry.key_span.end - len(field), entry.key_span.end, name


def _line(text: str, offset: int) -> tuple[int, int]:
    """Start of the line and start of the next one; a byte order mark stays before the first."""
    start, end = text.rfind("\n", 0, offset) + 1, text.find("\n", offset)
    if start == 0:
        start = next((len(m) for m in BYTE_ORDER_MARKS if text.startswith(m)), 0)
    return start, len(text) if end < 0 else end + 1


def _left(item: _Set, why: str) -> Diagnostic:
    first = (*item.heads, *(e for e, _ in item.entries))[0]
    message = f"{item.slot.spelling} is left as it is: {why}"
    return diagnostic("N3501", first.key_span, message, severity=Severity.WARNING)


def _edited(document: ListDocument, edits: Iterable[Edit]) -> ListDocument:
    """The document with pieces of its text replaced; an insertion goes before what it stands at."""
    parts: list[str] = []
    at = 0
    for start, end, new in sorted(edits, key=lambda edit: edit[:2]):
        parts.extend((document.text[at:start], new))
        at = end
    text = "".join((*parts, document.text[at:]))
    return ListDocument.from_text(text, document.name)
