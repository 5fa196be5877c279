"""NC variables of the control: one table of what can be read and written.

A pattern is the variable in capitals with `[]` for each index and `.<axis>` where an axis name
stands. Lengths are in the programmed unit (mm, or inches under G70), angles in degrees,
`V.G.KIN` and `KIN_PARAM` in list units (0.1 um).
Source: TF5200 coordinate systems and offsets, TF5200 programming manual, FCT-C27 3.5.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ncscope.channel import offsets, program_variables, readers, tool_variables
from ncscope.channel.draft import Draft
from ncscope.channel.rows import Reference, Row, axis_rows, length, plain, refuse_while_active
from ncscope.coordinates import Offset
from ncscope.kinematics.parameters import PARAMETER_COUNT, KinematicParameters, field_index
from ncscope.machine import ZERO_GROUPS, OffsetRecord

# --- kinematics --------------------------------------------------------------------------------


def _kin_parameter(draft: Draft, ref: Reference) -> tuple[KinematicParameters, int]:
    held = draft.state.kinematics.parameters
    id = ref.numbers[0]
    if id not in held and id != 91:
        known = " ".join(str(i) for i in sorted({*held, 91}))
        draft.fail("20906", ref.span, f"kinematics {id} is not configured; known: {known}")
    index = field_index(ref.field)
    if index is None:
        draft.fail(
            "20196",
            ref.span,
            f"kinematics {id} has no parameter {ref.field.upper()}",
            f"parameters are the named ones and PARAM[0] to PARAM[{PARAMETER_COUNT - 1}]",
        )
    return held.get(id, KinematicParameters(id=id, type=id)), index


def _read_kin(draft: Draft, ref: Reference) -> float:
    parameters, index = _kin_parameter(draft, ref)
    return parameters.values[index]


def _write_kin(draft: Draft, ref: Reference, value: float) -> None:
    refuse_while_active(draft, ref)
    parameters, index = _kin_parameter(draft, ref)
    held = draft.state.kinematics
    changed = parameters.with_value(index, value, ref.span)
    kinematics = replace(held, parameters={**held.parameters, parameters.id: changed})
    draft.state = draft.state.changed(kinematics=kinematics)


# --- zero offsets ------------------------------------------------------------------------------


def group_index(draft: Draft, ref: Reference) -> int:
    """Index of a zero offset group; 20906 when there is none of this number."""
    index = ref.numbers[0]
    if not 0 <= index < ZERO_GROUPS:
        draft.fail("20906", ref.span, f"zero offset groups are 0 to {ZERO_GROUPS - 1}, not {index}")
    return index


def _read_np(draft: Draft, ref: Reference) -> float:
    record = draft.state.zero_offsets.groups.get(group_index(draft, ref), OffsetRecord())
    return draft.shown(ref.axis, record.values.get(ref.axis, 0.0))


def _write_np(draft: Draft, ref: Reference, value: float) -> None:
    index = group_index(draft, ref)
    record = draft.state.zero_offsets.groups.get(index, OffsetRecord())
    values = {**record.values, ref.axis: draft.length(ref.axis, value)}
    origins = {**record.origins, ref.axis: draft.place}
    store_group(draft, index, replace(record, values=values, origins=origins))


def store_group(draft: Draft, index: int, record: OffsetRecord) -> None:
    """Puts a group into the zero offset table; what is active does not change."""
    table = draft.state.zero_offsets
    groups = {**table.groups, index: record}
    draft.state = draft.state.changed(zero_offsets=replace(table, groups=groups))


def active_zero(draft: Draft) -> Offset:
    """The active zero offset in mm and degrees; zeros when none is held."""
    n = len(draft.state.axes)
    held = offsets.held_offset(draft.state, "zero")
    name = offsets.zero_name(draft.state.zero_index)
    return held or Offset(name, (0.0,) * n, (None,) * n, draft.place)


def _read_np_active(draft: Draft, ref: Reference) -> float:
    return draft.shown(ref.axis, active_zero(draft).values[ref.axis])


def _write_np_active(draft: Draft, ref: Reference, value: float) -> None:
    values = {ref.axis: draft.length(ref.axis, value)}
    name = active_zero(draft).name
    draft.state = offsets.set_offsets(draft.state, "zero", name, values, draft.place)


def _write_np_default(draft: Draft, ref: Reference, value: float) -> None:
    table = replace(draft.state.zero_offsets, default_index=round(value))
    draft.state = draft.state.changed(zero_offsets=table)


# --- axis values -------------------------------------------------------------------------------


def _absolute(draft: Draft, ref: Reference) -> float:
    """V.A.ABS: the value of the innermost system with its offsets, tool included."""
    state = draft.state
    chain = state.coordinates
    if ref.axis >= offsets.MAIN_AXES and offsets.shares_offsets(state):
        chain = replace(chain, levels=chain.levels[:1])
    level = chain.level_from_program(state.position.program)
    return draft.shown(ref.axis, float(level[ref.axis]))


def _on_machine_axes(draft: Draft, ref: Reference) -> float:
    """V.A.PROG: the programmed value after scale, contour rotation and mirror."""
    state = draft.state
    values = state.coordinates.contour.apply(state.position.program)
    return draft.shown(ref.axis, float(values[ref.axis]))


def _programmed(draft: Draft, ref: Reference) -> float:
    return draft.shown(ref.axis, float(draft.state.position.program[ref.axis]))


def _machine_axis(draft: Draft, ref: Reference) -> float:
    """V.A.ACS.ABS: reading it waits for the axes, which the radius compensation forbids."""
    if draft.modes.compensation:
        what = f"{ref.text} cannot be read while G{draft.modes.compensation} is active"
        draft.fail("20651", ref.span, what, "write G40 before it")
    return draft.shown(ref.axis, float(draft.state.position.axes[ref.axis]))


def _offset_reader(kind: str) -> Callable[[Draft, Reference], float]:
    def read(draft: Draft, ref: Reference) -> float:
        base = draft.state.coordinates.levels[0]
        shared = kind in ("clamp", "measure")
        offset = base.offset(kind) if shared else offsets.held_offset(draft.state, kind)
        return draft.shown(ref.axis, offset.values[ref.axis]) if offset else 0.0

    return read


def _circle(place: int) -> Callable[[Draft], float]:
    return lambda draft: draft.state.circle[place]


VARIABLES: dict[str, Row] = {
    "V.G.KIN[].<field>": Row(_read_kin, _write_kin, "parameter of a kinematics, list units"),
    **tool_variables.ROWS,
    **axis_rows("V.G.NP[].V", Row(_read_np, _write_np, "zero offset of a group")),
    **axis_rows(
        "V.G.NP_AKT.V", Row(_read_np_active, _write_np_active, "zero offset that is active")
    ),
    "V.G.NP_DEFAULT": Row(
        plain(lambda d: d.state.zero_offsets.default_index),
        _write_np_default,
        "group that is active after program start",
    ),
    "V.G.T_AKT": Row(plain(lambda d: d.state.tool.place), None, "tool place of the last T"),
    "V.G.D_AKT": Row(plain(lambda d: d.state.tool.record_index), None, "tool data of the last D"),
    "V.G.AKT_PLATZ": Row(plain(lambda d: d.state.clamp_index), None, "clamp position"),
    "V.G.MASS_MM": Row(plain(lambda d: float(d.modes.inch)), None, "0 in millimetres"),
    "V.G.ROT_ACTIVE": Row(
        plain(lambda d: float(d.state.coordinates.contour.turn is not None)),
        None,
        "1 while a contour rotation is active",
    ),
    "V.G.ROT_ANGLE": Row(plain(lambda d: d.state.turn.angle), None, "contour rotation: angle"),
    "V.G.ROT_CENTER1": Row(
        length(lambda d: d.state.turn.centre[0]), None, "contour rotation: centre, first axis"
    ),
    "V.G.ROT_CENTER2": Row(
        length(lambda d: d.state.turn.centre[1]), None, "contour rotation: centre, second axis"
    ),
    **{
        f"V.G.{letter}": Row(length(_circle(i)), None, f"corrected {letter} of the last arc")
        for i, letter in enumerate("IJKR")
    },
    "V.G.BLOCK_NR": Row(plain(lambda d: d.state.block or 0), None, "block number"),
    "V.G.FEEDRATE": Row(length(lambda d: d.modes.feed or 0.0), None, "programmed feed"),
    **axis_rows("V.A.ABS", Row(_absolute, None, "absolute value in the innermost system")),
    **axis_rows("V.A.PROG", Row(_on_machine_axes, None, "programmed value")),
    **axis_rows("V.A.MENT", Row(_programmed, None, "programmed value before mirroring")),
    **axis_rows("V.A.ACT_POS", Row(_programmed, None, "present value without offsets")),
    **axis_rows("V.A.ACS.ABS", Row(_machine_axis, None, "axis position")),
    **axis_rows("V.A.BZP", Row(_offset_reader("g92"), None, "reference point offset (G92)")),
    **axis_rows("V.A.MEIN", Row(_offset_reader("measure"), None, "measuring offset included")),
    **axis_rows("V.A.MESS", Row(readers.measured("value"), None, "measured value")),
    **axis_rows("V.A.MOFFS", Row(readers.measured("offset"), None, "measured value - target")),
    **axis_rows(
        "V.A.MEAS.PCS.VALUE", Row(readers.measured("program"), None, "measured programmed value")
    ),
    **axis_rows(
        "V.A.MEAS.ACS.VALUE", Row(readers.measured("axis"), None, "measured axis position")
    ),
    "V.G.MEAS_TYPE": Row(plain(lambda d: d.state.measuring.type), None, "measuring type"),
    **axis_rows("V.A.MERF", Row(readers.was_measured, None, "1 when the axis has been measured")),
    **{
        f"V.G.SELECTED_CS.TRANS.{letter}": Row(
            readers.selected_origin(axis),
            None,
            f"zero of the innermost system in the MCS, {letter}",
        )
        for axis, letter in enumerate("XYZ")
    },
    **axis_rows(
        "V.A.TRANSFORM",
        Row(readers.converted("TRANSFORM", "#TRANSFORM"), None, "result of #TRANSFORM"),
    ),
    **axis_rows(
        "V.A.MCS", Row(readers.converted("MCS", "#WCS TO MCS"), None, "result of #WCS TO MCS")
    ),
    **axis_rows(
        "V.A.WCS", Row(readers.converted("WCS", "#MCS TO WCS"), None, "result of #MCS TO WCS")
    ),
    **axis_rows(
        "V.A.MANUAL_OFFSETS", Row(readers.manual_offset, None, "manual offset fetched last")
    ),
    **axis_rows("V.A.SOFFS", Row(readers.manual_offset, None, "old name of V.A.MANUAL_OFFSETS")),
    **axis_rows("V.A.RERF", Row(lambda d, r: 1.0, None, "1: axes are taken as homed")),
    **axis_rows("V.A.PSET", Row(_offset_reader("pset"), None, "position preset (#PSET)")),
    **axis_rows("V.A.PZV", Row(_offset_reader("clamp"), None, "clamp position offset")),
    **program_variables.PROGRAM_ROWS,
}
"""Every variable of the control that is known here, by pattern."""
