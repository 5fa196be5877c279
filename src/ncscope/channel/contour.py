"""G68, G69, G20 to G23 and G351, and what a change of plane does to a contour rotation.

A contour function moves nothing: the channel stays and reads another programmed value.
Source: TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.contour import Contour, Turn
from ncscope.diagnostics import Span

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def set_contour(draft: Draft, contour: Contour) -> None:
    """Another contour; offsets and axes stay where they are."""
    if contour == draft.state.coordinates.contour:
        return
    old = draft.state.coordinates
    below = len(old.levels) > 1 and contour.mirror_shift != old.contour.mirror_shift
    draft.state = draft.state.with_coordinates(
        replace(old, contour=contour), keep="axes" if below else "level"
    )


def turn_on(draft: Draft, turn: Turn, span: Span) -> None:
    """Contour rotation with these values; they replace those that act."""
    if draft.state.suspended is not None:
        what = "a contour rotation inside #MCS is not modelled"
        draft.fail("N2022", span, what, "switch it on before #MCS ON or after #MCS OFF")
    draft.state = draft.state.changed(turn=turn)
    set_contour(draft, replace(draft.state.coordinates.contour, turn=turn))


def plane_axes(draft: Draft, span: Span, what: str) -> tuple[int, int]:
    """The two axes of the plane; fails where the channel has no such axis (20010)."""
    first, second, _ = draft.state.main_axes
    _require(draft, (first, second), span, what)
    return first, second


def _require(draft: Draft, axes: Iterable[int], span: Span, what: str) -> None:
    """Fails where the channel has fewer axes than the place of one of these."""
    if max(axes, default=-1) >= len(draft.state.axes):
        names = " ".join(draft.state.axis_names)
        text = f"{what} needs an axis of plane G{draft.modes.plane} that the channel lacks: {names}"
        draft.fail("20010", span, text, "choose another plane, or add the axis to the channel")


def turn_off(draft: Draft, span: Span) -> None:
    """Ends the contour rotation; N2022 inside #MCS. Source: TF5200, #ROTATION OFF, G69."""
    suspended = draft.state.suspended
    if suspended is not None and suspended.coordinates.contour.turn is not None:
        what = "a contour rotation cannot be ended inside #MCS; that is not modelled"
        draft.fail("N2022", span, what, "end it before #MCS ON or after #MCS OFF")
    set_contour(draft, draft.state.coordinates.contour.without_turn())


def plane(draft: Draft, number: int, span: Span) -> None:
    """G17, G18, G19: another plane switches the contour rotation off, with a warning."""
    changed = number != draft.modes.plane
    draft.modal(plane=number)
    if changed and _drop_turn(draft):
        draft.warn("21143", span, f"G{number} switched the contour rotation off")


def _drop_turn(draft: Draft) -> bool:
    """Without contour rotation, here and in what #MCS suspends; whether there was one."""
    suspended, contour = draft.state.suspended, draft.state.coordinates.contour
    held = contour if suspended is None else suspended.coordinates.contour
    set_contour(draft, contour.without_turn())
    if suspended is not None:
        waiting = replace(suspended.coordinates, contour=held.without_turn())
        draft.state = draft.state.changed(suspended=replace(suspended, coordinates=waiting))
    return held.turn is not None


def rotation(draft: Draft, words: Words) -> None:
    """G68 R30 X10 Y20: turn about this point; G69: no turn.

    R is the absolute angle, 0 where it is missing; a missing centre coordinate is the present
    position.
    """
    if 69 in words.gfunctions:
        turn_off(draft, words.gfunctions[69].span)
    if 68 not in words.gfunctions:
        return
    first, second = plane_axes(draft, words.gfunctions[68].span, "G68")
    third = draft.state.main_axes[2]
    if third in words.axes:
        name = draft.state.axis_names[third]
        what = f"{name} is not in the plane; G68 takes the two axes of the plane only"
        draft.fail("22156", words.axes[third][1], what)
    for axis, (_, span) in words.axes.items():
        if axis not in (first, second):
            draft.fail("N2003", span, "G68 takes the two axes of the plane only")
    angle = words.addresses.pop("R", (0.0, None))[0]
    centre = (_centre(draft, words, first), _centre(draft, words, second))
    words.axes.clear()
    turn_on(draft, Turn(angle, centre, (first, second), draft.place), words.gfunctions[68].span)


def _centre(draft: Draft, words: Words, axis: int) -> float:
    """The centre word in mm; without it the present position after scale and old rotation."""
    if axis in words.axes:
        return draft.length(axis, words.axes[axis][0])
    state = draft.state
    contour = replace(state.coordinates.contour, mirror=frozenset())
    return float(contour.apply(state.position.program)[axis])


def mirror(draft: Draft, words: Words) -> None:
    """G20 to G23 for the axes of the plane, G351 X-1 for any axis and its G92 value."""
    for number, word in words.gfunctions.items():
        if number in (20, 21, 22, 23):
            _mirror_plane(draft, number, word.span)
        elif number == 351:
            _mirror_axes(draft, words, word.span)


def _mirror_plane(draft: Draft, number: int, span: Span) -> None:
    contour = draft.state.coordinates.contour
    if contour.mirror_shift:
        hint = "take the mirror of G351 away first, for example G351 X1"
        draft.fail("N2021", span, f"G{number} after G351 is not modelled", hint)
    first, second, _ = draft.state.main_axes
    axes = {20: (), 21: (first,), 22: (second,), 23: (first, second)}[number]
    _require(draft, axes, span, f"G{number}")
    origin = draft.place if axes else None
    set_contour(draft, replace(contour, mirror=frozenset(axes), mirror_origin=origin))


def _mirror_axes(draft: Draft, words: Words, span: Span) -> None:
    contour = draft.state.coordinates.contour
    if contour.mirror != contour.mirror_shift:
        draft.fail("N2021", span, "G351 after G21 to G23 is not modelled", "write G20 first")
    if len(words.gfunctions) > 1 or words.addresses or words.mfunctions or not words.axes:
        hint = "write for example G351 X-1; G351 X1 takes it away"
        draft.fail("20860", span, "G351 needs at least one axis and a block of its own", hint)
    axes = set(contour.mirror)
    for axis, (value, place) in words.axes.items():
        if abs(value) != 1.0:
            draft.fail("20860", place, f"G351 takes 1 or -1, not {value:g}")
        (axes.add if value < 0 else axes.discard)(axis)
    words.axes.clear()
    mirrored = frozenset(axes)
    origin = draft.place if mirrored else None
    set_contour(
        draft, replace(contour, mirror=mirrored, mirror_shift=mirrored, mirror_origin=origin)
    )
