"""Commands that take nothing behind their name: what stands there is an error, never overlooked.

`#TRAFO ON [91]` looks as if it chose kinematics 91 and would not.
"""

from __future__ import annotations

from collections.abc import Mapping

from ncscope.channel.draft import Draft
from ncscope.language import tree

BARE: Mapping[str, str] = {
    "TRAFO ON": "#TRAFO [91] or #KIN ID [91] chooses the kinematics",
    "TRAFO OFF": "write #TRAFO OFF",
    "RTCP ON": "#KIN ID [91] chooses the kinematics",
    "RTCP OFF": "write #RTCP OFF",
    "TRAFO PCS OFF": "write #TRAFO PCS OFF",
    "PTP ON": "write #PTP ON",
    "PTP OFF": "write #PTP OFF",
    "TLC OFF": "write #TLC OFF",
    "TOOL ORI CS": "the list says the axis and the solution: tool_ori_cs.axis, tool_ori_cs.mode",
}
"""Name of the command and what would have been right."""


def refuse_arguments(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for brackets, a further word or a value behind a command that takes none."""
    hint = BARE.get(command.name)
    if hint is not None and (command.groups or command.modifiers or command.value is not None):
        what = f"nothing can stand behind #{command.name}"
        draft.fail("N1005", command.span, what, hint)
