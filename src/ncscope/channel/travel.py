"""The motion of a block: where its axis words lead, and on which path.

Source: TF5200 programming manual, G00 to G03, G100; TF5200 coordinate systems and offsets.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ncscope.channel import circle, diameter, measuring, modulo, radius_compensation
from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span
from ncscope.frames import Array

if TYPE_CHECKING:
    from ncscope.channel.words import Words


THREADS = ("G33", "G63", "G331", "G332")
"""Straight motions whose I, J, K are the pitch of a thread."""
NO_FEED = ("G00", "G33", "G331", "G332")
"""Motions that are rapid, or whose feed is that of the spindle."""


def motion(draft: Draft, words: Words) -> None:
    """G00 to G03 to the axis words of the block, G100 to its target."""
    if 100 in words.gfunctions:
        return _measure(draft, words)
    circular = draft.modes.motion in circle.CIRCULAR
    centre = circle.centre_words(draft, words)
    if not circular and draft.modes.motion not in THREADS:
        _ignored(draft, centre)
    elif circular and not words.axes and not centre:
        words.addresses.pop("R", None)  # the radius is stored for the arcs to come
        return None
    if circular:
        _travel_arc(draft, words, centre)
    elif words.axes:
        target, way = _target(draft, words)
        span = next(iter(words.axes.values()))[1]
        radius_compensation.motion(draft, False, span)
        _check_feed(draft, span)
        draft.move_to(target, span, direction=_direction_word(draft, words), way=way)
    words.axes.clear()
    return None


def _travel_arc(draft: Draft, words: Words, centre: dict[int, circle.Word]) -> None:
    span = next(iter((*words.axes.values(), *centre.values())))[1]
    target, way = _target(draft, words)
    radius_compensation.motion(draft, True, span)
    path = circle.arc(draft, words, centre, target, span)
    _check_feed(draft, span)
    draft.move_to(target, span, arc=path, direction=_direction_word(draft, words), way=way)


def _direction_word(draft: Draft, words: Words) -> Span | None:
    """The first word of the block that gives the tool direction."""
    active = draft.state.coordinates.kinematics
    if active is None:
        return None
    columns = active.model.orientation
    return next((words.axes[axis][1] for axis in columns if axis in words.axes), None)


def _ignored(draft: Draft, centre: dict[int, circle.Word]) -> None:
    for axis, (_, span) in centre.items():
        letter = circle.CENTRE_LETTERS[axis]
        draft.warn("20048", span, f"{letter} has no effect in a linear block")


def _target(draft: Draft, words: Words) -> tuple[Array, Array | None]:
    """Programmed values (n,) at the end of the block, and where the way there leads without
    wrapping; None where that is the same."""
    way = draft.state.position.program.copy()
    for axis, (value, span) in words.axes.items():
        turned = modulo.travel(draft, words, axis)
        length = diameter.radius(draft, axis, value, span)
        if turned is not None:
            way[axis] += turned
        else:
            way[axis] = length if draft.modes.absolute else way[axis] + length
    program = draft.state.coordinates.shown(way)
    return program, None if program is way or np.array_equal(program, way) else way


def _check_feed(draft: Draft, span: Span) -> None:
    modes = draft.modes
    if modes.motion not in NO_FEED and modes.feed is None and not modes.feed_warned:
        draft.warn("20008", span, "a feed motion is programmed without a feed (F)")
        draft.modal(feed_warned=True)


def _measure(draft: Draft, words: Words) -> None:
    """G100 X100: a feed motion to the point where the probe triggers, at most to the target."""
    run = measuring.begin(draft, words)
    axes, modal = tuple(words.axes), draft.modes.motion
    draft.modal(motion="G01")
    motion(draft, words)
    draft.modal(motion=modal)
    measuring.record(draft, axes, run)
