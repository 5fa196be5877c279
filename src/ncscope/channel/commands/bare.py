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
    "FLUSH": "write #FLUSH",
    "FLUSH WAIT": "write #FLUSH WAIT",
    "FLUSH CONTINUE": "write #FLUSH CONTINUE",
    "CS OFF ALL": "write #CS OFF ALL",
    "CS DEL ALL": "write #CS DEL ALL; #CS DEL [name] deletes one",
    "MCS OFF": "write #MCS OFF",
    "ROTATION OFF": "write #ROTATION OFF",
    "SCALE OFF": "write #SCALE OFF",
    "TLAX DEFAULT": "write #TLAX DEFAULT; #TLAX [Z+] chooses an axis",
    "AX DEF DEFAULT": "write #AX DEF DEFAULT",
    "INIT MACRO TAB": "write #INIT MACRO TAB",
    "INIT MAKRO TAB": "write #INIT MACRO TAB",
    "GET MANUAL OFFSETS": "V.A.MANUAL_OFFSETS holds what was fetched",
    "GET IPO OFFSET": "V.A.MANUAL_OFFSETS holds what was fetched",
    "DISABLE MODAL CYCLE": "write #DISABLE MODAL CYCLE",
    "RETAIN CYCLE CHANGES": "write #RETAIN CYCLE CHANGES",
    "SPLINE ON": "#SPLINE TYPE AKIMA chooses the type",
    "SPLINE TYPE AKIMA": "write #SPLINE TYPE AKIMA",
    "SPLINE TYPE BSPLINE": "write #SPLINE TYPE BSPLINE",
    "MEAS DEFAULT": "write #MEAS DEFAULT; #MEAS [TYPE=2] sets options",
    "TOOL ORI CS": "the list says the axis and the solution: tool_ori_cs.axis, tool_ori_cs.mode",
}
"""Name of the command and what would have been right."""

WITHOUT_BRACKETS: Mapping[str, str] = {
    "PSET": "write for example #PSET X20",
    "PRESET": "write #PRESET, or for some axes #PRESET X0",
    "SCALE": "write for example #SCALE X2 Y2",
    "SCALE ON": "write #SCALE ON, or with factors #SCALE ON X2 Y2",
}
"""Commands with words of axes, and what would have been right."""
PLAIN_VALUES: Mapping[str, str] = {
    "KIN ID": "write for example #KIN ID [91]",
    "TLC ON": "write for example #TLC ON [0.5]",
    "TRAFO PCS ID": "write for example #TRAFO PCS ID [500]",
    "MEAS MODE": "write for example #MEAS MODE [2]",
    "MSG": 'write for example #MSG ["X is %f", P1]',
    "MSG INFO": 'write for example #MSG INFO ["X is %f", P1]',
    "MSG SAVE": 'write for example #MSG SAVE ["X is %f", P1]',
}
"""Commands with one value between commas, without a name before it."""


def refuse_arguments(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for brackets, a further word or a value behind a command that takes none."""
    hint = BARE.get(command.name)
    if hint is not None and (command.groups or command.modifiers or command.value is not None):
        what = f"nothing can stand behind #{command.name}"
        draft.fail("N1005", command.span, what, hint)
    hint = WITHOUT_BRACKETS.get(command.name)
    if hint is not None and command.groups:
        what = f"brackets cannot stand behind #{command.name}"
        draft.fail("N1005", command.groups[0].span, what, hint)
    if command.name in PLAIN_VALUES:
        _plain_values(draft, command, PLAIN_VALUES[command.name])


def _plain_values(draft: Draft, command: tree.HashCommand, hint: str) -> None:
    for cell in (cell for group in command.groups for cell in group.cells):
        if cell and cell[0].key is not None:
            what = f"{cell[0].key}= is unknown in #{command.name}"
            draft.fail("N1005", cell[0].span, what, hint)
        if len(cell) > 1:
            what = f"a comma is missing between the values of #{command.name}"
            draft.fail("N1005", cell[1].span, what, hint)
