"""The axes of the channel, from the channel list and the axis lists.

Lengths 0.1 um and angles 0.0001 degrees in the lists, mm and degrees in `Axis`.
Source: P-CHAN-00006, P-CHAN-00035, P-AXIS-00015, -00016, -00018, -00126, -00127, -00152, -00177,
-00178, -00705.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from ncscope.diagnostics import Diagnostic, Severity, Span, diagnostic
from ncscope.lists.values import Reading
from ncscope.machine import MAX_CHANNEL_AXES, Axis, is_rotary_name

UNITS = 10_000.0
"""List units in a millimetre or degree."""
MODULO_MODE = 0x4
FACE_TURNING_MODE = 0x40
SPINDLE_TYPE = 4
AXIS_TYPES = {"ACHSTYP_TRANSLATOR": 1, "ACHSTYP_ROTATOR": 2, "ACHSTYP_SPINDEL": 4}
MAX_NAME = 16
DEFAULT_LIMIT = 100_000_000
"""List units; the default of both software limits."""

_FIRST_LETTERS = "ABCUVWXYZQ"
_NAME = re.compile(r"[A-Za-z0-9_]+")


@dataclass(frozen=True, slots=True)
class AxisRecord:
    """One axis list: the axis as it describes it, under its own name."""

    axis: Axis
    spindle: bool = False


@dataclass(frozen=True, slots=True)
class ChannelAxes:
    """The axes in channel order, where their names stand, and what is wrong with them."""

    axes: tuple[Axis, ...] = ()
    name_spans: tuple[Span | None, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()


def axis_record(
    readings: Iterable[Reading], number: int
) -> tuple[AxisRecord, tuple[Diagnostic, ...]]:
    """The axis of an axis list; `number` counts where the list has no kopf.achs_nr."""
    last = _last_values(readings)
    kind, found = _axis_type(last.get("kenngr.achs_typ"))
    first = _value(last, "kopf.achs_nr", number)
    modulo = bool(int(_value(last, "kenngr.achs_mode", 1)) & MODULO_MODE)
    name = last.get("kopf.log_achs_name")
    rotary, turns = kind == AXIS_TYPES["ACHSTYP_ROTATOR"], _modulo_range(last) if modulo else None
    axis = Axis(
        str(name.value) if name else f"axis {int(first)}",
        int(first),
        rotary=rotary,
        modulo_range=turns,
        limits=_limits(last, turns if rotary else None),
        face_turning=bool(int(_value(last, "kenngr.achs_mode", 1)) & FACE_TURNING_MODE),
        diameter_absolute=bool(_value(last, "kenngr.durchm_prog_abs", 0)),
        diameter_relative=bool(_value(last, "kenngr.durchm_prog_rel", 0)),
        reference=_value(last, "getriebe[0].pos_refpkt", 0) / UNITS,
        measuring=bool(_value(last, "kenngr.messachse", 0)),
    )
    return AxisRecord(axis, kind == SPINDLE_TYPE), found


def channel_axes(readings: Iterable[Reading], records: Mapping[int, AxisRecord]) -> ChannelAxes:
    """The axes that a channel list names, completed by the axis lists; empty when it names none."""
    last = _last_values(readings)
    names = _by_channel_index(last, "bezeichnung")
    numbers = _by_channel_index(last, "log_achs_nr")
    axes: list[Axis] = []
    spans: list[Span | None] = []
    found: list[Diagnostic] = []
    for index in sorted({*names, *numbers}):
        name, number = names.get(index), numbers.get(index)
        axis = _channel_axis(index, name, number, records)
        found.extend(_name_complaints(axis.name, name, number))
        found.extend(_duplicates(axis, name, number, axes, spans))
        axes.append(axis)
        spans.append(name.entry.value_span if name else None)
    found.extend(_count_complaints(last, sorted({*names, *numbers})))
    return ChannelAxes(tuple(axes[:MAX_CHANNEL_AXES]), tuple(spans), tuple(found))


def _last_values(readings: Iterable[Reading]) -> dict[str, Reading]:
    return {r.entry.key.lower(): r for r in readings if r.value is not None}


def _value(last: Mapping[str, Reading], key: str, default: float) -> float:
    reading = last.get(key)
    return default if reading is None or reading.value is None else float(reading.value)


def _by_channel_index(last: Mapping[str, Reading], field: str) -> dict[int, Reading]:
    key = f"gruppe[].achse[].{field}"
    return {r.indices[1]: r for r in last.values() if r.row.key == key}


def _axis_type(reading: Reading | None) -> tuple[int, tuple[Diagnostic, ...]]:
    if reading is None:
        return AXIS_TYPES["ACHSTYP_TRANSLATOR"], ()
    text = str(reading.value)
    if text.upper() in AXIS_TYPES:
        return AXIS_TYPES[text.upper()], ()
    number = _small_number(text)
    if number in AXIS_TYPES.values():
        return number, ()
    message = (
        f"{reading.entry.key} ({reading.row.id}): {text} is no axis type; a linear axis is assumed"
    )
    hint = "write ACHSTYP_TRANSLATOR (1), ACHSTYP_ROTATOR (2) or ACHSTYP_SPINDEL (4)"
    warning = diagnostic("110552", reading.entry.value_span, message, hint)
    return AXIS_TYPES["ACHSTYP_TRANSLATOR"], (warning,)


def _small_number(text: str) -> int:
    match = re.fullmatch(r"0[xX]0*([0-9a-fA-F]{1,4})|(\d{1,4})", text, re.ASCII)
    if match is None:
        return -1
    return int(match[1], 16) if match[1] else int(match[2])


def _modulo_range(last: Mapping[str, Reading]) -> tuple[float, float]:
    low = _value(last, "getriebe[0].modulou", 0)
    high = _value(last, "getriebe[0].moduloo", 3_600_000)
    return (low / UNITS, high / UNITS) if low < high else (0.0, 360.0)


def _limits(
    last: Mapping[str, Reading], turns: tuple[float, float] | None
) -> tuple[float, float] | None:
    """The software limits that are monitored; None where none are.

    turns: the range of a rotary modulo axis. Such an axis is monitored only where P-AXIS-00705
    asks for it, and only with limits inside its range.
    """
    if "kenngr.swe_neg" not in last and "kenngr.swe_pos" not in last:
        return None
    low = _value(last, "kenngr.swe_neg", -DEFAULT_LIMIT) / UNITS
    high = _value(last, "kenngr.swe_pos", DEFAULT_LIMIT) / UNITS
    check = int(_value(last, "kenngr.swe_check", -1))
    if check == 0:
        return None
    if turns is not None and (check != 1 or low < turns[0] or high > turns[1]):
        return None
    return low, high


def _channel_axis(
    index: int,
    name: Reading | None,
    number: Reading | None,
    records: Mapping[int, AxisRecord],
) -> Axis:
    logical = int(number.value) if number and number.value is not None else index + 1
    record = records.get(logical)
    own = str(name.value) if name else ""
    if record is None:
        return Axis(own, logical, rotary=is_rotary_name(own), assumed=True)
    return replace(record.axis, name=own or record.axis.name)


def _name_complaints(
    text: str, name: Reading | None, number: Reading | None
) -> tuple[Diagnostic, ...]:
    if name is None:
        span = number.entry.key_span if number else None
        message = "an axis of the channel has a number and no name"
        return (diagnostic("20425", span, message, "add its entry .bezeichnung"),)
    span = name.entry.value_span
    key = f"{name.entry.key} ({name.row.id})"
    if text[:1] not in _FIRST_LETTERS:
        message = f"{key}: the axis name {text} begins with a letter that axis names may not have"
        return (diagnostic("20425", span, message, "begin it with A, B, C, Q, U, V, W, X, Y or Z"),)
    if len(text) > MAX_NAME:
        message = f"{key}: the axis name {text} has more than {MAX_NAME} characters"
        return (diagnostic("20425", span, message),)
    if not _NAME.fullmatch(text):
        message = f"{key}: the axis name {text} has characters that a program cannot write"
        hint = "use letters, digits and _"
        return (diagnostic("20425", span, message, hint, severity=Severity.WARNING),)
    return ()


def _duplicates(
    axis: Axis,
    name: Reading | None,
    number: Reading | None,
    earlier: list[Axis],
    spans: list[Span | None],
) -> list[Diagnostic]:
    found = []
    for other, span in zip(earlier, spans, strict=True):
        notes = (("used first here", span),) if span else ()
        if name and other.name == axis.name:
            message = f"the axis name {axis.name} is used twice in the channel"
            found.append(diagnostic("20424", name.entry.value_span, message, notes=notes))
        if number and other.number == axis.number:
            message = f"the axes {other.name} and {axis.name} both have the number {axis.number}"
            found.append(diagnostic("20423", number.entry.value_span, message, notes=notes))
    return found


def _count_complaints(last: Mapping[str, Reading], indices: list[int]) -> tuple[Diagnostic, ...]:
    count = last.get("gruppe[0].achs_anzahl")
    found = []
    if count and indices and count.value != len(indices):
        message = f"gruppe[0].achs_anzahl is {count.value}, but {len(indices)} axes are listed"
        found.append(diagnostic("20427", count.entry.value_span, message))
    missing = [i for i in range(len(indices)) if i not in indices]
    if missing:
        span = last_span(last, indices)
        message = f"the channel has no axis at index {missing[0]}; the axes behind it move up"
        found.append(diagnostic("20427", span, message, "number the axes 0, 1, 2 without gaps"))
    return tuple(found)


def last_span(last: Mapping[str, Reading], indices: list[int]) -> Span | None:
    """The key of the axis with the highest index."""
    for reading in last.values():
        if reading.row.key.startswith("gruppe[].achse[]") and reading.indices[1] == indices[-1]:
            return reading.entry.key_span
    return None
