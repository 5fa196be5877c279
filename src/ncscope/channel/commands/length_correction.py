"""#TLC ON [15], #TLC OFF: the tool is longer than its data say (TF5200 #TLC).

Counts from the next absolute word. Not together with a transformation.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.language import tree


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TLC ON [dL]: new minus old length, mm or inches."""
    if draft.state.coordinates.kinematics is not None:
        what = "#TLC is not allowed while a transformation is active"
        draft.fail("20669", command.span, what, "switch it off first (#TRAFO OFF)")
    tool = draft.state.tool
    if tool.correction_at is not None:
        what = "a correction of the tool length is active"
        draft.fail("N2028", command.span, what, "switch it off first (#TLC OFF)")
    places = command.groups[0].places if len(command.groups) == 1 else ()
    if len(places) != 1 or places[0] is None:
        form = "write for example #TLC ON [0.5]"
        draft.fail("N1005", command.span, "#TLC ON needs the difference of length", form)
    length = evaluate_number(draft, places[0]) * draft.modes.length_factor
    tool = replace(tool, correction=length, correction_at=draft.place)
    draft.state = offsets.with_tool(draft.state, tool)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TLC OFF"""
    tool = replace(draft.state.tool, correction=0.0, correction_at=None)
    draft.state = offsets.with_tool(draft.state, tool)


COMMANDS = {"TLC ON": on, "TLC OFF": off}
