"""G51 and G52: positions of the face turning axis are diameters.

Programmed values are kept as radii: what a word means changes, not the coordinates.
Source: TF5200 turning functions, diameter programming; P-AXIS-00015, P-AXIS-00058, P-AXIS-00059,
P-CHAN-00091.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def select(draft: Draft, words: Words) -> None:
    """G51 and G52 act in their own block already."""
    if 51 in words.gfunctions:
        span = words.gfunctions[51].span
        found = _face_axis(draft, span)
        if draft.machine.settings.offsets_in_diameter:
            draft.refuse(span, "G51 with offsets in diameter (versch_im_durchm, P-CHAN-00091)")
        draft.modal(diameter_axis=found)
    elif 52 in words.gfunctions:
        draft.modal(diameter_axis=None)
    axis = draft.modes.diameter_axis
    if axis is not None and axis in draft.state.coordinates.contour.mirror:
        span = next(iter(words.gfunctions.values())).span
        name = draft.state.axis_names[axis]
        what = f"the face turning axis {name} cannot be mirrored in diameter programming"
        draft.fail("20019", span, what, "write G52 or G20 before it")


def _face_axis(draft: Draft, span: Span) -> int:
    state = draft.state
    plane = [axis for axis in state.main_axes[:2] if axis < len(state.axes)]
    found = [axis for axis in plane if state.axes[axis].face_turning]
    if len(found) != 1:
        names = " and ".join(state.axis_names[axis] for axis in plane)
        what = f"G51 needs one face turning axis in the plane of G{state.modal.plane} ({names})"
        draft.fail("20042", span, what, "set kenngr.achs_mode 0x40 (P-AXIS-00015) in its axis list")
    return found[0]


def radius(draft: Draft, axis: int, value: float, span: Span) -> float:
    """The position in mm or degrees that an axis word means: half of a diameter."""
    length = draft.length(axis, value)
    if axis != draft.modes.diameter_axis:
        return length
    own, absolute = draft.state.axes[axis], draft.modes.absolute
    if not (own.diameter_absolute if absolute else own.diameter_relative):
        return length
    if absolute and value < 0.0:
        draft.warn("N2036", span, "a diameter is negative")
    return length / 2
