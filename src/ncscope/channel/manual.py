"""G74 homing and G200 to G202 manual mode (TF5200 coordinate systems and offsets).

Offline nobody jogs: manual mode leaves every axis where it is, and manual offsets are 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ncscope.channel import offsets
from ncscope.channel.draft import Draft

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
    if number != 202:
        draft.warn("N2026", span, f"G{number} moves nothing here: no jog increments are given")
    words.axes.clear()


def home(draft: Draft, words: Words) -> None:
    """G74 X1 Y2: these axes to their reference position; the numbers are the order.

    The position preset (#PSET) of these axes ends.
    """
    if 74 not in words.gfunctions:
        return
    span = words.gfunctions[74].span
    state = draft.state
    chain = state.coordinates
    if len(chain.levels) > 1 or chain.kinematics is not None or state.suspended is not None:
        what = "G74 inside a coordinate system or transformation is not supported yet"
        draft.fail("N2001", span, what, "switch it off first")
    if not words.axes:
        draft.fail("N2027", span, "G74 needs at least one axis", "write for example G74 X1 Y2")
    draft.state = offsets.clear_preset(state, frozenset(words.axes))
    axes = state.position.axes.copy()
    for axis in words.axes:
        axes[axis] = state.axes[axis].reference
    words.axes.clear()
    motion = draft.modes.motion
    draft.modal(motion="G00")
    draft.move_to(draft.state.coordinates.to_program(axes), span)
    draft.modal(motion=motion)


def get_offsets(draft: Draft, command: object) -> None:
    """#GET MANUAL OFFSETS: V.A.MANUAL_OFFSETS, which are 0; no position changes."""


COMMANDS = {"GET MANUAL OFFSETS": get_offsets}
