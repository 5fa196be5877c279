"""V.G.WZ[j].*: the tool table; V.G.WZ_AKT.*: the tool that is selected.

A record that the program writes counts when its D word is programmed again. A change of the
selected tool acts at the next absolute word and is lost with the next D word.
Source: TF5200 tool management, access to tool data in the NC program.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.rows import Reference, Row, axis_rows, refuse_while_active
from ncscope.machine import TOOL_RECORDS, Tool

PARAMETERS = 60
KINEMATIC_PARAMETERS = 70
UNITS_PER_RPM = 6000.0
"""0.001 degrees a second in one turn a minute."""

Read = Callable[[Draft, Reference, Tool], float]
Write = Callable[[Draft, Reference, Tool, float], Tool]


class Field(NamedTuple):
    """One field of a tool. access: `both` (also of the selected tool), `table` or `read`."""

    read: Read
    write: Write | None
    access: str
    meaning: str


def _length(name: str, meaning: str) -> Field:
    return Field(
        lambda d, r, t: getattr(t, name) / d.modes.length_factor,
        lambda d, r, t, v: _changed(t, name, v * d.modes.length_factor),
        "both",
        meaning,
    )


def _changed(tool: Tool, name: str, value: Any) -> Tool:
    return replace(tool, **{name: value})


def _flag(name: str, meaning: str) -> Field:
    return Field(
        lambda d, r, t: float(getattr(t, name)),
        lambda d, r, t, v: _changed(t, name, abs(v) >= 0.5),
        "table",
        meaning,
    )


def _data(key: str, meaning: str, access: str = "table", unit: float = 1.0) -> Field:
    return Field(
        lambda d, r, t: t.data.get(key, 0.0) / unit,
        lambda d, r, t, v: replace(t, data={**t.data, key: v * unit}),
        access,
        meaning,
    )


def _array(name: str, size: int, meaning: str) -> Field:
    def index(draft: Draft, ref: Reference) -> int:
        number = ref.numbers[-1]
        if not 0 <= number < size:
            draft.fail("20906", ref.span, f"the indices are 0 to {size - 1}, not {number}")
        return number

    def read(draft: Draft, ref: Reference, tool: Tool) -> float:
        return float(getattr(tool, name).get(index(draft, ref), 0.0))

    def write(draft: Draft, ref: Reference, tool: Tool, value: float) -> Tool:
        return _changed(tool, name, {**getattr(tool, name), index(draft, ref): value})

    return Field(read, write, "both", meaning)


_AXIS_OFFSET = Field(
    lambda d, r, t: d.shown(r.axis, t.axis_offsets.get(r.axis, 0.0)),
    lambda d, r, t, v: replace(t, axis_offsets={**t.axis_offsets, r.axis: d.length(r.axis, v)}),
    "both",
    "axis offset of",
)
_KINEMATICS = Field(
    lambda d, r, t: float(t.kinematic_id),
    lambda d, r, t, v: replace(t, kinematic_id=round(v)),
    "table",
    "kinematic id of",
)
FIELDS: Mapping[str, Field] = {
    "L": _length("length", "length of"),
    "R": _length("radius", "radius of"),
    "P[]": _array("parameters", PARAMETERS, "parameter of"),
    "KIN_PARAM[]": _array(
        "kinematic_parameters", KINEMATIC_PARAMETERS, "kinematic parameter, list units, of"
    ),
    "OK": _flag("valid", "1 for a valid record of"),
    "ME": Field(lambda d, r, t: 0.0, None, "read", "unit, always 0 for mm, of"),
    "KIN_ID": _KINEMATICS,
    "TYPE": _data("typ", "type (0 milling, 1 turning, 2 grinding) of", "read"),
    "TOOL_FIXED": _flag("fixed", "1 where offsets stay along machine axes, of"),
    "SRK_ID": _data("srk_lage", "cutting position of"),
    "SPDL_AX_NR": _data("log_ax_nr_spdl", "number of the spindle of"),
    "S_MIN_SPEED": _data("vb_min", "smallest speed in rpm of", unit=UNITS_PER_RPM),
    "S_MAX_SPEED": _data("vb_max", "largest speed in rpm of", unit=UNITS_PER_RPM),
    "S_MAX_ACC": _data("a_max", "largest acceleration of"),
    "SISTER_VALID": _data("tool_id.sister_valid", "1 for a valid sister of"),
    "SISTER": _data("tool_id.sister", "sister of"),
    "VARIANT_VALID": _data("tool_id.variant_valid", "1 for a valid variant of"),
    "VARIANT": _data("tool_id.variant", "variant of"),
}


# --- the table of tools ------------------------------------------------------------------------


def _index(draft: Draft, ref: Reference) -> int:
    index = ref.numbers[0]
    if not 0 < index < TOOL_RECORDS:
        last = TOOL_RECORDS - 1
        draft.fail("20906", ref.span, f"tool data records are 1 to {last}, not {index}")
    return index


def _record(draft: Draft, ref: Reference) -> Tool:
    index = _index(draft, ref)
    if index not in draft.state.tools:
        draft.fail("20172", ref.span, f"tool data D{index} does not exist")
    return draft.state.tools[index]


def _of_table(field: Field) -> Row:
    def write(draft: Draft, ref: Reference, value: float) -> None:
        index = _index(draft, ref)
        old = draft.state.tools.get(index, Tool(valid=False))
        assert field.write is not None
        record = replace(field.write(draft, ref, old, value), origin=draft.place)
        draft.state = draft.state.changed(tools={**draft.state.tools, index: record})

    read_only = field.access == "read"
    return Row(
        lambda d, r: field.read(d, r, _record(d, r)),
        None if read_only else write,
        f"{field.meaning} a tool of the table",
    )


# --- the selected tool -------------------------------------------------------------------------


def _of_selected(field: Field) -> Row:
    def write(draft: Draft, ref: Reference, value: float) -> None:
        refuse_while_active(draft, ref)
        tool = draft.state.tool
        assert field.write is not None
        record = field.write(draft, ref, tool.record, value)
        written = tool.changed(record=record, selected_at=draft.place)
        draft.state = offsets.with_tool(draft.state, written)

    return Row(
        lambda d, r: field.read(d, r, d.state.tool.record),
        write if field.access == "both" else None,
        f"{field.meaning} the selected tool",
    )


ROWS: dict[str, Row] = {
    **{f"V.G.WZ_AKT.{name}": _of_selected(field) for name, field in FIELDS.items()},
    **axis_rows("V.G.WZ_AKT.V", _of_selected(_AXIS_OFFSET)),
    **{f"V.G.WZ[].{name}": _of_table(field) for name, field in FIELDS.items()},
    **axis_rows("V.G.WZ[].V", _of_table(_AXIS_OFFSET)),
}
"""Every tool variable by its pattern."""
