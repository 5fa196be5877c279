"""G100, G101, G102: measured positions and the offset made of them.

Offline no probe answers: it triggers at the target, so the measured offset is 0 and a note says so.
Source: TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.channel.state import Measured, State
from ncscope.coordinates import Offset
from ncscope.diagnostics import Span

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def record(draft: Draft, axes: Iterable[int], span: Span) -> None:
    """After the motion of G100: the values of these axes, measured at the target.

    The value is the axis position; in a coordinate system or kinematics the programmed one.
    """
    state = draft.state
    plain = len(state.coordinates.levels) == 1 and state.coordinates.kinematics is None
    values = state.position.axes if plain else state.position.program
    new = {state.axis_names[axis]: Measured(float(values[axis])) for axis in axes}
    draft.state = replace(state, measured={**state.measured, **new})
    draft.warn("N2024", span, "no probe answers here: it triggers at the target of G100")


def offset(draft: Draft, words: Words) -> None:
    """G101 X1: include factor times (measured - target); G102: take it out."""
    for number in (101, 102):
        if number in words.gfunctions:
            rule = _include if number == 101 else _exclude
            rule(draft, words, words.gfunctions[number].span)
            words.axes.clear()


def _include(draft: Draft, words: Words, span: Span) -> None:
    if not words.axes:
        draft.fail("N2025", span, "G101 needs an axis with its factor", "write for example G101 X1")
    values = {}
    for axis, (factor, place) in words.axes.items():
        name = draft.state.axis_names[axis]
        if name not in draft.state.measured:
            what = f"axis {name} has not been measured"
            draft.fail("N2025", place, what, f"write G100 {name}.. before it")
        values[axis] = factor * draft.state.measured[name].offset
    draft.state = with_measured(draft.state, values, draft.place)


def _exclude(draft: Draft, words: Words, span: Span) -> None:
    held = draft.state.coordinates.levels[0].offset("measure")
    included = {i for i, o in enumerate(held.origins) if o} if held else set()
    for axis, (_, place) in words.axes.items():
        if axis not in included:
            name = draft.state.axis_names[axis]
            draft.fail("N2025", place, f"axis {name} has no measuring offset that G102 could end")
    axes = set(words.axes) or included
    draft.state = with_measured(draft.state, dict.fromkeys(axes, 0.0), None)


def with_measured(state: State, values: Mapping[int, float], place: str | None) -> State:
    """The measuring offset of these axes, mm and degrees, in the workpiece level; nothing moves.

    place: None takes the offset out.
    """
    base, *rest = state.coordinates.levels
    n = len(state.axes)
    held = base.offset("measure") or Offset("G101", (0.0,) * n, (None,) * n)
    new, origins = list(held.values), list(held.origins)
    for axis, value in values.items():
        new[axis], origins[axis] = value, place
    offset = replace(held, values=tuple(new), origins=tuple(origins)) if any(origins) else None
    levels = (base.with_offset("measure", offset), *rest)
    coordinates = replace(state.coordinates, levels=levels)
    return state.with_coordinates(coordinates, keep="axes" if rest else "level")
