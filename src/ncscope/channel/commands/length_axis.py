"""#TLAX [Z+], #TLAX DEFAULT: the main axis that takes the tool length (TF5200 #TLAX).

Counts from the next absolute word, like a new tool. A tool with an orientation of its own
(P-TOOL-00146) keeps it. Inside a transformation the length follows the kinematics.
"""

from __future__ import annotations

import re

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.state import LengthAxis
from ncscope.language import tree

_FORM = "write for example #TLAX [Z+]; the length is then added in Z in every plane"
_SIGNED = re.compile(r"(\w+?)\s*([-+])")


def pin(draft: Draft, command: tree.HashCommand) -> None:
    """#TLAX [Z+]: the axis moves by plus the length; [Z-]: by minus the length."""
    items = [item for group in command.groups for item in group.items]
    word = items[0].value.text if len(items) == 1 and isinstance(items[0].value, tree.Name) else ""
    found = _SIGNED.fullmatch(word)
    if found is None or items[0].key is not None:
        draft.fail("N1005", command.span, "#TLAX needs a main axis with its sign", _FORM)
    name, sign = found.groups()
    axis = draft.axis_index(name, items[0].span, "20797")
    if axis > 2:
        has = " ".join(draft.state.axis_names[:3])
        draft.fail("N2040", items[0].span, f"axis {name} is no main axis; main axes are {has}")
    _take(draft, LengthAxis(axis, 1.0 if sign == "+" else -1.0))


def follow_plane(draft: Draft, command: tree.HashCommand) -> None:
    """#TLAX DEFAULT: the length is in the third axis of the plane again."""
    _take(draft, None)


def _take(draft: Draft, length_axis: LengthAxis | None) -> None:
    draft.state = draft.state.changed(length_axis=length_axis)
    draft.state = offsets.with_tool(draft.state, draft.state.tool)


COMMANDS = {"TLAX": pin, "TLAX DEFAULT": follow_plane}
