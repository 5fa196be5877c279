"""#PSET and #PRESET: the present position reads what the program says (FCT-C2 2.5)."""

from __future__ import annotations

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.words import axis_values
from ncscope.language import tree


def pset(draft: Draft, command: tree.HashCommand) -> None:
    """#PSET X20: the present position of X is 20; G91 has no influence."""
    words = axis_values(draft, command.words)
    if not words:
        draft.fail("N1005", command.span, "#PSET needs an axis and its new position")
    values = {axis: draft.length(axis, value) for axis, (value, _) in words.items()}
    draft.state = offsets.preset(draft.state, values, draft.place)


def preset(draft: Draft, command: tree.HashCommand) -> None:
    """#PRESET: all axes; #PRESET X0: X, its value does not matter."""
    words = axis_values(draft, command.words)
    axes = frozenset(words) or frozenset(range(len(draft.state.axes)))
    draft.state = offsets.clear_preset(draft.state, axes)


COMMANDS = {"PSET": pset, "PRESET": preset}
