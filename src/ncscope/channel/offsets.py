"""Offsets and tool data: each function returns the state under other coordinates.

Nothing here moves an axis: a new offset counts from the next absolute word of its axis.
Source: TF5200 coordinate systems and offsets; P-ZERO-00001..00004; TF5200 G92, #PSET, tool data.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ncscope.channel.state import SelectedTool, State
from ncscope.coordinates import ActiveTool, Coordinates, Level, Offset
from ncscope.machine import OffsetRecord, Tool

MAIN_AXES = 3
NO_OFFSET = Offset("", (), ())


def zero_name(index: int) -> str:
    """`G54` for group 1, `G159=7` for the groups without a G function of their own."""
    return f"G{53 + index}" if index <= 6 else f"G159={index}"


def select_zero(state: State, index: int, place: str) -> State:
    """The zero offset group `index` in the innermost level (G53..G59, G159)."""
    record = state.zero_offsets.record(index)
    none = index == 0 and not state.zero_offsets.group_0_is_offset
    offset = None if none else _offset_from_record(state, zero_name(index), record, place)
    return _with_offset(state, "zero", offset).changed(zero_index=index)


def select_clamp(state: State, index: int, record: OffsetRecord) -> State:
    """The clamp position `index`: it belongs to the workpiece level and stays for the program."""
    offset = _offset_from_record(state, "clamp", record, f"clamp position {index}")
    level = state.coordinates.levels[0].with_offset("clamp", offset)
    coordinates = replace(state.coordinates, levels=(level, *state.coordinates.levels[1:]))
    return state.with_coordinates(coordinates).changed(clamp_index=index)


def set_offsets(
    state: State, kind: str, name: str, values: Mapping[int, float], place: str, add: bool = False
) -> State:
    """Values of one kind for the axes given; other axes keep theirs. `add` adds to the old."""
    held = held_offset(state, kind)
    n = len(state.axes)
    new = list(held.values) if held else [0.0] * n
    origins: list[str | None] = list(held.origins) if held else [None] * n
    for axis, value in values.items():
        new[axis] = new[axis] + value if add else value
        origins[axis] = place
    offset = Offset(name, tuple(new), tuple(origins), held.selected_at if held else place)
    return _with_offset(state, kind, offset)


def clear_preset(state: State, axes: frozenset[int]) -> State:
    """#PRESET: the position preset of these axes is gone in the innermost level."""
    held = held_offset(state, "pset")
    return state if held is None else _with_offset(state, "pset", _without(held, axes))


def without_presets(state: State, axes: frozenset[int]) -> State:
    """G74: the position preset of these axes is gone in every level, also in those that wait."""
    if state.suspended is not None:
        waiting = _cleared(state.suspended.coordinates, axes)
        state = state.changed(suspended=replace(state.suspended, coordinates=waiting))
    cleared = _cleared(state.coordinates, axes)
    return state if cleared is state.coordinates else state.with_coordinates(cleared)


def _cleared(coordinates: Coordinates, axes: frozenset[int]) -> Coordinates:
    levels = tuple(_without_preset(level, axes) for level in coordinates.levels)
    unchanged = all(a is b for a, b in zip(levels, coordinates.levels, strict=True))
    return coordinates if unchanged else replace(coordinates, levels=levels)


def _without_preset(level: Level, axes: frozenset[int]) -> Level:
    held = level.offset("pset")
    return level if held is None else level.with_offset("pset", _without(held, axes))


def _without(held: Offset, axes: frozenset[int]) -> Offset | None:
    values = tuple(0.0 if i in axes else v for i, v in enumerate(held.values))
    origins = tuple(None if i in axes else o for i, o in enumerate(held.origins))
    return replace(held, values=values, origins=origins) if any(values) else None


def preset(state: State, values: Mapping[int, float], place: str) -> State:
    """#PSET: the present position of these axes reads `values` from now on.

    The old preset is replaced, not accumulated: it already counts in the present value.
    Neither a contour rotation nor a mirror may be active; a scale may.
    """
    held = held_offset(state, "pset")
    shown = state.position.program
    factors = state.coordinates.contour.factors(len(state.axes))
    new = {
        axis: (held.values[axis] if held else 0.0) + float(factors[axis] * (shown[axis] - value))
        for axis, value in values.items()
    }
    return set_offsets(state, "pset", "#PSET", new, place)


def select_tool(state: State, index: int, record: Tool, place: str) -> State:
    """The tool data record `index` (D word); 0 is no tool."""
    suspended = state.suspended
    if suspended is not None and not suspended.ex_tool:
        state = state.changed(suspended=replace(suspended, tool_acts=True))
    tool = state.tool.changed(record_index=index, record=record, selected_at=place)
    return with_tool(state, tool)


def with_tool(state: State, tool: SelectedTool) -> State:
    """The state in which `tool` acts, by the plane and settings that are valid now.

    Inside #MCS it acts only where a D word stood there.
    """
    state = state.changed(tool=tool)
    if state.suspended is not None and not state.suspended.tool_acts:
        return state
    coordinates = replace(state.coordinates, tool=active_tool(state))
    if coordinates.tool == state.coordinates.tool:
        return state
    fixed = tool.record.fixed or state.coordinates.tool.fixed
    simple = coordinates.kinematics is None and not fixed
    return state.with_coordinates(coordinates, keep="level" if simple else "axes")


def active_tool(state: State) -> ActiveTool:
    """The selected tool as it acts in the plane that is valid now."""
    tool = state.tool
    record = tool.record
    n = len(state.axes)
    places = (record.origin, tool.selected_at, tool.correction_at)
    return ActiveTool(
        length=record.length + tool.correction,
        axis_offsets=tuple(record.axis_offsets.get(i, 0.0) for i in range(n)),
        direction=_tool_direction(state, record),
        fixed=record.fixed,
        origin=", ".join(dict.fromkeys(p for p in places if p)) or None,
    )


def _tool_direction(state: State, record: Tool) -> tuple[float, float, float]:
    """Unit vector mount -> tip: P-TOOL-00146, else #TLAX, else against the third axis of the
    plane. The axes move by plus the length along the axis that #TLAX names with +."""
    if record.orientation is not None:
        vector = np.array(record.orientation, dtype=float)
        return tuple(vector / np.linalg.norm(vector))
    direction = [0.0, 0.0, 0.0]
    pinned = state.length_axis
    if pinned is None:
        direction[state.main_axes[2]] = -1.0
    else:
        direction[pinned.axis] = -pinned.sign
    return direction[0], direction[1], direction[2]


def _offset_from_record(state: State, name: str, record: OffsetRecord, place: str) -> Offset:
    indices = range(len(state.axes))
    origins = tuple(record.origins.get(i) if record.effective(i) else None for i in indices)
    return Offset(name, tuple(record.effective(i) for i in indices), origins, place)


def held_offset(state: State, kind: str) -> Offset | None:
    """What a new offset of this kind replaces: that of the innermost level.

    Where the axes beyond the third have one offset for all levels, theirs is that of level 0.
    """
    levels = state.coordinates.levels
    if not shares_offsets(state):
        return levels[-1].offset(kind)
    return _spliced(levels[-1].offset(kind), levels[0].offset(kind))


def shares_offsets(state: State) -> bool:
    """Whether level 0 holds the offsets of the axes beyond the third for all levels
    (P-CHAN-00397, AXES_OFFSETS_LAYER_SPECIFIC)."""
    above = len(state.coordinates.levels) > 1 and len(state.axes) > MAIN_AXES
    return above and not state.system_mode.per_level


def _with_offset(state: State, kind: str, offset: Offset | None) -> State:
    chain = state.coordinates
    if not shares_offsets(state):
        levels = (*chain.levels[:-1], chain.top.with_offset(kind, offset))
        return state.with_coordinates(replace(chain, levels=levels), keep="level")
    base, *between, top = chain.levels
    base = base.with_offset(kind, _spliced(base.offset(kind), offset))
    top = top.with_offset(kind, _spliced(offset, None))
    return state.with_coordinates(replace(chain, levels=(base, *between, top)))


def _spliced(main: Offset | None, further: Offset | None) -> Offset | None:
    """The main axes of one offset and the further axes of another one; None without any value."""
    n = len((main or further or NO_OFFSET).values)
    parts = [(part, range(*bounds)) for part, bounds in ((main, (0, 3)), (further, (3, n))) if part]
    used = [(p, own) for p, own in parts if any(p.values[i] or p.origins[i] for i in own)]
    if not used:
        return None
    values, origins = [0.0] * n, [None] * n  # type: tuple[list[float], list[str | None]]
    for part, own in used:
        for i in own:
            values[i], origins[i] = part.values[i], part.origins[i]
    names = dict.fromkeys(part.name for part, _ in used)
    return Offset(", ".join(names), tuple(values), tuple(origins), used[0][0].selected_at)
