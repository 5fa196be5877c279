"""#PSET and #PRESET: the present position reads what the program says (FCT-C2 2.5)."""

from __future__ import annotations

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.words import axis_values
from ncscope.language import tree


def pset(draft: Draft, command: tree.HashCommand) -> None:
    """#PSET X20: the present position of X is 20; G91 has no influence."""
    words = axis_values(draft, command.words, command.name)
    if not words:
        draft.fail("N1005", command.span, "#PSET needs an axis and its new position")
    _check_contour(draft, command)
    if draft.state.coordinates.program_step is not None:
        what = "#PSET under a PCS transformation is not supported"
        draft.fail("N2001", command.span, what, "switch it off first (#TRAFO PCS OFF)")
    values = {axis: draft.length(axis, value) for axis, (value, _) in words.items()}
    draft.state = offsets.preset(draft.state, values, draft.place)


def _check_contour(draft: Draft, command: tree.HashCommand) -> None:
    _check_mirror(draft, command)
    if draft.state.coordinates.contour.turn is not None:
        what = "#PSET under a contour rotation is not modelled"
        draft.fail("N2005", command.span, what, "switch it off first (#ROTATION OFF or G69)")


def _check_mirror(draft: Draft, command: tree.HashCommand) -> None:
    if draft.state.coordinates.contour.mirror:
        what = f"#{command.name} is not allowed while a mirror is active"
        draft.fail("20612", command.span, what, "switch the mirror off first (G20, or G351 X1)")


def preset(draft: Draft, command: tree.HashCommand) -> None:
    """#PRESET: all axes; #PRESET X0: X, its value does not matter."""
    _check_mirror(draft, command)
    words = axis_values(draft, command.words, command.name)
    axes = frozenset(words) or frozenset(range(len(draft.state.axes)))
    draft.state = offsets.clear_preset(draft.state, axes)


COMMANDS = {"PSET": pset, "PRESET": preset}
