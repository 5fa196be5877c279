"""G200 to G202 manual mode, #GET MANUAL OFFSETS, and G74 homing.

The increments that somebody jogs are given as rows (`--manual`), one for each G200 and G201; they
are jogged in that block. After G201 they lie on the axes behind all that the program computes,
until the channel is initialised; G200 initialises it at once.
Source: TF5200 manual mode; TF5200 coordinate systems and offsets.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.coordinates import Coordinates, Offset
from ncscope.diagnostics import Span
from ncscope.frames import Array

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def jog(draft: Draft, words: Words) -> None:
    """G200, G201 X0, G202: the axis words only name axes."""
    number = next((n for n in (200, 201, 202) if n in words.gfunctions), None)
    if number is None:
        return
    span = words.gfunctions[number].span
    if number == 201 and not words.axes:
        draft.fail("20038", span, "G201 needs at least one axis", "write for example G201 X1")
    axes = tuple(words.axes) or tuple(range(len(draft.state.axes)))
    words.axes.clear()
    if number == 202:
        return
    increments, place = _increments(draft, number, axes, span)
    if any(increments.values()):
        _check_chain(draft, number, span)
    if number == 201 and any(increments.values()):
        coordinates = replace(draft.state.coordinates, manual=_added(draft, increments, place))
        draft.state = draft.state.with_coordinates(coordinates, keep="level")
        draft.rapid_to(draft.state.position.program, span)
    if number == 200:
        _take_over(draft, increments, place, span)


def _take_over(draft: Draft, increments: Mapping[int, float], place: str, span: Span) -> None:
    """G200: the axes stand where they were jogged to, and the channel takes these positions."""
    _fetch(draft, _added(draft, increments, place))
    draft.set_coordinates(replace(draft.state.coordinates, manual=None), span)
    if any(increments.values()):
        position = draft.state.position.axes.copy()
        for axis, increment in increments.items():
            position[axis] += increment
        draft.rapid_to(draft.state.coordinates.to_program(position), span)
    _check_limits(draft, increments, span)


def _increments(
    draft: Draft, number: int, axes: Iterable[int], span: Span
) -> tuple[Mapping[int, float], str]:
    """The next row of increments by channel index, mm and degrees, and its place."""
    given = draft.state.manual
    if given is None:
        draft.warn("N2026", span, f"G{number} moves nothing here: no jog increments are given")
        return {}, ""
    row = given.next
    if row is None:
        count = len(given.rows)
        what = f"{given.name} has no row for this G{number}; it has {count} rows"
        draft.fail("N2042", span, what, "add a row with the increments, or an empty one")
    draft.state = draft.state.changed(manual=given.taken())
    names = {draft.state.axis_names[axis]: axis for axis in axes}
    for name, cell in row.cells.items():
        if name not in names and row.values[name] != 0.0:
            what = f"{cell.place} has an increment for axis {name}, which is not in manual mode"
            draft.fail("N2043", span, what, notes=(("the increment", cell),))
    increments = {names[name]: value for name, value in row.values.items() if name in names}
    return increments, row.span.place


def _check_chain(draft: Draft, number: int, span: Span) -> None:
    chain = draft.state.coordinates
    steps = (chain.kinematics, chain.program_step, chain.length_step)
    if len(chain.levels) > 1 or any(step is not None for step in steps):
        what = f"jogging by G{number} inside a coordinate system or transformation"
        draft.fail("N2001", span, f"{what} is not supported", "switch it off first")


def _check_limits(draft: Draft, increments: Mapping[int, float], span: Span) -> None:
    """The software limits end the jogging of G200."""
    for index in increments:
        axis, position = draft.state.axes[index], float(draft.state.position.axes[index])
        if axis.limits is not None and not axis.limits[0] <= position <= axis.limits[1]:
            low, high = axis.limits
            what = f"axis {axis.name} cannot be jogged to {position:g}"
            draft.fail("N2043", span, what, f"its software limits are {low:g} and {high:g}")


def _added(draft: Draft, increments: Mapping[int, float], place: str) -> Offset:
    """What lies on the axes with these increments."""
    n = len(draft.state.axes)
    held = draft.state.coordinates.manual or Offset("manual", (0.0,) * n, (None,) * n, place)
    values, origins = list(held.values), list(held.origins)
    for axis, increment in increments.items():
        values[axis] += increment
        origins[axis] = place
    return replace(held, values=tuple(values), origins=tuple(origins))


def _fetch(draft: Draft, manual: Offset | None) -> None:
    """V.A.MANUAL_OFFSETS reads this from now on."""
    values = manual.values if manual is not None else (0.0,) * len(draft.state.axes)
    fetched = dict(zip(draft.state.axis_names, values, strict=True))
    draft.state = draft.state.changed(manual_offsets=fetched)


def home(draft: Draft, words: Words) -> None:
    """G74 X1 Y2: these axes to their reference position; the numbers are the order.

    The reference position is one of the axis itself, whatever system is active. The position
    preset (#PSET) of these axes ends, in every system.
    """
    if 74 not in words.gfunctions:
        return
    span = words.gfunctions[74].span
    if not words.axes:
        draft.fail("N2027", span, "G74 needs at least one axis", "write for example G74 X1 Y2")
    named = frozenset(words.axes)
    words.axes.clear()
    draft.state = offsets.without_presets(draft.state, named)
    position = draft.state.position.axes.copy()
    for axis in named:
        position[axis] = draft.state.axes[axis].reference
    _move_axes(draft, position, span)


def _move_axes(draft: Draft, position: Array, span: Span) -> None:
    """The axes themselves to a position; in a transformation the tool does not go straight."""
    chain = draft.state.coordinates
    if chain.kinematics is None:
        draft.rapid_to(chain.to_program(position), span)
        return
    pose = chain.kinematics.model.pose_of(position)
    active = replace(chain.kinematics, pose=pose)
    draft.rapid_to(position, span, Coordinates(chain.axis_count, modulo=chain.modulo))
    draft.set_coordinates(replace(chain, kinematics=active), span)


def get_offsets(draft: Draft, command: object) -> None:
    """#GET MANUAL OFFSETS: V.A.MANUAL_OFFSETS; the offsets stay, and no position changes."""
    _fetch(draft, draft.state.coordinates.manual)


COMMANDS = {"GET MANUAL OFFSETS": get_offsets, "GET IPO OFFSET": get_offsets}
