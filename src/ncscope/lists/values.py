"""List values: text to number, flag or name, checked against the table.

Leaves the value, or None where the default stays, and a warning that says what was expected.
Source: ZERO 1.3; ids 1019 to 1028 and 110552 are the control's own.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.lists import table
from ncscope.lists.document import Entry, ListDocument
from ncscope.lists.table import ParameterRow

Value = int | float | str

_INTEGER = re.compile(r"[+-]?\d+", re.ASCII)
_HEX = re.compile(r"[+-]?0[xX][0-9a-fA-F]+")
_HEX_WITHOUT_MARK = re.compile(r"\d[0-9a-fA-F]*[a-fA-F][0-9a-fA-F]*", re.ASCII)
_REAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_SYMBOLS = re.compile(r"[A-Za-z_]\w*([ \t]*\|[ \t]*\w+)*", re.ASCII)
_MAX_DIGITS = 40

_VARIABLE = re.compile(r"V\.(?:G\.)?KIN\[(?P<id>\d+)\]\.(?P<field>.+)", re.IGNORECASE)

MACRO_TEXT = "makro_def[].nc_code"
"""The entry whose value is an NC block, with blanks."""
MEANT = {"inaktiv": "versch"}
"""An entry that is often written where the other one is meant."""


@dataclass(frozen=True, slots=True)
class Reading:
    """An entry that the table knows, with its value; None where the default stays."""

    row: ParameterRow
    entry: Entry
    value: Value | None

    @property
    def indices(self) -> tuple[int, ...]:
        return self.entry.indices

    @property
    def field(self) -> str:
        """The last name of the key: `versch` of `np_grp[1].achse[0].versch`."""
        return self.row.key.rsplit(".", 1)[-1]


def read_values(
    document: ListDocument, list_kind: str
) -> tuple[tuple[Reading, ...], tuple[Diagnostic, ...]]:
    """The known entries of a list with their values, and what is wrong with the others."""
    readings: list[Reading] = []
    found: list[Diagnostic] = list(document.diagnostics)
    outside: dict[str, list[Diagnostic]] = {}
    for entry in document.entries:
        row = table.find(list_kind, entry.key)
        if row is None:
            found.append(_unknown_key(entry, list_kind))
            continue
        place = _wrong_index(entry, row)
        if place is not None:
            outside.setdefault(_up_to_index(entry, place), []).append(
                _index_complaint(entry, row, place)
            )
            continue
        found.extend(_spelling(entry, row))
        value, complaints = convert(entry, row)
        found.extend(complaints)
        readings.append(Reading(row, entry, value))
    found.extend(_counted(items, prefix) for prefix, items in outside.items())
    return tuple(readings), tuple(found)


def convert(entry: Entry, row: ParameterRow) -> tuple[Value | None, tuple[Diagnostic, ...]]:
    """The value of an entry, None where the default stays, and warnings about it."""
    if not entry.value_text:
        return None, ()
    if row.type == "BOOLEAN":
        return _flag(entry, row)
    if row.type == "REAL64":
        return _real(entry, row)
    if row.type in table.INTEGER_RANGES:
        return _integer(entry, row)
    return entry.value_text, _text_after_string(entry, row)


def default_of(row: ParameterRow) -> str:
    """The default as a person reads it."""
    return row.default if row.default not in ("", "-") else "of the control"


_Result = tuple[Value | None, tuple[Diagnostic, ...]]


def _flag(entry: Entry, row: ParameterRow) -> _Result:
    if entry.value_text in ("0", "1"):
        return int(entry.value_text), ()
    name = _last_name(entry)
    meant = MEANT.get(name)
    what = f"; {meant} was probably meant" if meant else ""
    text = f"{_named(entry, row)} must be 0 or 1, not {entry.value_text}{what}"
    hint = f"write {entry.key[: -len(name)]}{meant} {entry.value_text}" if meant else "write 0 or 1"
    return None, (diagnostic("1019", entry.value_span, _kept(text, row), hint),)


def _real(entry: Entry, row: ParameterRow) -> _Result:
    text = entry.value_text
    if _REAL.fullmatch(text):
        return _finite(entry, row, text)
    pointed = text.replace(",", ".", 1)
    if not _REAL.fullmatch(pointed):
        return None, (_bad_number(entry, row, "a number"),)
    value, found = _finite(entry, row, pointed)
    message = f"{_named(entry, row)} has a decimal comma; {text} is taken as {pointed}"
    return value, (diagnostic("N3002", entry.value_span, message, f"write {pointed}"), *found)


def _finite(entry: Entry, row: ParameterRow, text: str) -> _Result:
    value = float(text)
    if math.isfinite(value):
        return _in_range(entry, row, value)
    message = f"{_named(entry, row)}: {text} is too large for a real number"
    return None, (diagnostic("1027", entry.value_span, _kept(message, row)),)


def _integer(entry: Entry, row: ParameterRow) -> _Result:
    text = entry.value_text
    if len(text) <= _MAX_DIGITS:
        if _HEX.fullmatch(text):
            return _in_range(entry, row, int(text, 16))
        if _INTEGER.fullmatch(text):
            return _decimal(entry, row, text)
        if _REAL.fullmatch(text):
            return _rounded(entry, row, text)
        if _HEX_WITHOUT_MARK.fullmatch(text):
            message = f"{_named(entry, row)}: the hexadecimal value {text} lacks its 0x"
            hint = f"write 0x{text}"
            return None, (diagnostic("1026", entry.value_span, _kept(message, row), hint),)
        if row.status != "effective" and _SYMBOLS.fullmatch(text):
            return text, ()
    return None, (_bad_number(entry, row, "a whole number"),)


def _decimal(entry: Entry, row: ParameterRow, text: str) -> _Result:
    digits = text.lstrip("+-")
    if len(digits) > 1 and digits[0] == "0":
        plain = str(int(text))
        message = f"{_named(entry, row)}: {text} has a leading zero"
        return None, (diagnostic("1022", entry.value_span, _kept(message, row), f"write {plain}"),)
    return _in_range(entry, row, int(text))


def _rounded(entry: Entry, row: ParameterRow, text: str) -> _Result:
    real = float(text)
    if not math.isfinite(real):
        return None, (_bad_number(entry, row, "a whole number"),)
    value = int(math.copysign(math.floor(abs(real) + 0.5), real))
    if value == real:
        return _in_range(entry, row, value)
    message = f"{_named(entry, row)} must be a whole number, not {text}; {value} is used"
    warning = diagnostic("N3005", entry.value_span, message, _whole_hint(row, real, value))
    result, found = _in_range(entry, row, value)
    return result, (warning, *found)


def _whole_hint(row: ParameterRow, real: float, value: int) -> str:
    """A fraction of a length or angle is mostly one that was given in mm or degrees."""
    scaled = round(real * 10_000, 6)
    if not row.unit.startswith("0.1 um") or not scaled.is_integer():
        return f"write {value}"
    return f"the unit is {row.unit}; write {int(scaled)} if {real:g} mm or degrees was meant"


def _in_range(entry: Entry, row: ParameterRow, value: float) -> _Result:
    limits = row.range
    if limits is None or limits[0] <= value <= limits[1]:
        return value, ()
    id = "20585" if row.id == "P-ZERO-00002" else "110552"
    message = (
        f"{_named(entry, row)} must be between {limits[0]} and {limits[1]}, not {entry.value_text}"
    )
    return None, (diagnostic(id, entry.value_span, _kept(message, row)),)


def _bad_number(entry: Entry, row: ParameterRow, expected: str) -> Diagnostic:
    message = f"{_named(entry, row)} must be {expected}, not '{entry.value_text}'"
    hint = "a comment behind a number needs a blank before it" if entry.rest else ""
    return diagnostic("1020", entry.value_span, _kept(message, row), hint)


def _text_after_string(entry: Entry, row: ParameterRow) -> tuple[Diagnostic, ...]:
    rest = entry.rest.strip()
    if not rest or row.status == "-" or row.key == MACRO_TEXT or rest.startswith(("(", "#", "/*")):
        return ()
    message = f"text behind the value of {_named(entry, row)} is ignored"
    return (diagnostic("N3001", entry.value_span, message, "begin the comment with '('"),)


def _unknown_key(entry: Entry, list_kind: str) -> Diagnostic:
    message = f"{entry.key} is not known in a {table.LIST_NAMES[list_kind]}; it is not taken over"
    return diagnostic("110303", entry.key_span, message, _key_hint(entry, list_kind))


def _key_hint(entry: Entry, list_kind: str) -> str:
    variable = _VARIABLE.fullmatch(entry.key)
    if variable:
        name = f"kinematik[{variable['id']}].{variable['field'].lower()}"
        return f"V.G.KIN is the spelling of NC programs; in a list write {name}"
    close = table.close_matches(list_kind, entry.key)
    if close:
        return f"{_with_indices(close[0], entry)} was probably meant"
    other = [kind for kind in table.kinds_of(entry.key) if kind != list_kind]
    return f"this key belongs into a {table.LIST_NAMES[other[0]]}" if other else ""


def _with_indices(key: str, entry: Entry) -> str:
    """A key pattern with the index numbers of the entry, as far as they go."""
    if key.count("[]") != len(entry.indices):
        return key
    if entry.key.lower().startswith("kinematik["):
        key = "kinematik[]" + key.removeprefix("trafo[]")
    numbers = iter(entry.indices)
    return re.sub(r"\[\]", lambda _: f"[{next(numbers)}]", key)


def _wrong_index(entry: Entry, row: ParameterRow) -> int | None:
    """The place of the first index number that does not exist, None when all do."""
    offset = len(entry.indices) - len(row.sizes)
    for place, (index, size) in enumerate(zip(entry.indices[offset:], row.sizes, strict=True)):
        old_id = place == 0 and entry.key.lower().startswith("kinematik[")
        if size is not None and index >= size and not old_id:
            return offset + place
    return None


def _index_complaint(entry: Entry, row: ParameterRow, place: int) -> Diagnostic:
    size = row.sizes[place - len(entry.indices) + len(row.sizes)]
    index = entry.indices[place]
    message = f"{_named(entry, row)}: index {index} does not exist; it is not taken over"
    hint = f"the indices are 0 to {(size or 1) - 1}"
    return diagnostic("110303", entry.key_span, message, hint)


def _up_to_index(entry: Entry, place: int) -> str:
    """The key up to its wrong index number: lines that share it have one fault in common."""
    numbers = list(re.finditer(r"\[\d+\]", entry.key))
    return entry.key[: numbers[place].end()].lower()


def _counted(items: list[Diagnostic], prefix: str) -> Diagnostic:
    """The first of several complaints about one index number, with how many lines have it."""
    first, more = items[0], len(items) - 1
    if not more:
        return first
    lines = "1 more line begins" if more == 1 else f"{more} more lines begin"
    return replace(first, message=f"{first.message}; {lines} with {prefix}")


def _spelling(entry: Entry, row: ParameterRow) -> tuple[Diagnostic, ...]:
    right = _with_indices(row.key, entry)
    if table.pattern(entry.key) == row.key and entry.key[:1] != "K":
        return ()
    message = f"{entry.key} is written with other upper and lower case than the control writes it"
    return (diagnostic("N3011", entry.key_span, message, f"write {right}"),)


def _named(entry: Entry, row: ParameterRow) -> str:
    return f"{entry.key} ({row.id})" if row.id else entry.key


def _kept(message: str, row: ParameterRow) -> str:
    return f"{message}; the default {default_of(row)} is used"


def _last_name(entry: Entry) -> str:
    return re.sub(r"\[\d+\]$", "", entry.key.rsplit(".", 1)[-1]).lower()
