"""#PTP ON, #PTP OFF: with a transformation, axes go straight to the same end point.

The path between two positions is another one; end points, and so everything here, are the same.
Source: TF5200 #PTP.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.language import tree

REFUSED = {
    "CS ON": "21550",
    "ACS ON": "21550",
    "BCS ON": "21550",
    "CS OFF": "21529",
    "CS OFF ALL": "21529",
    "ACS OFF": "21529",
    "ACS OFF ALL": "21529",
    "BCS OFF": "21529",
    "BCS OFF ALL": "21529",
    "MCS ON": "21531",
    "MCS OFF": "21531",
    "KIN ID": "20687",
}
"""Commands that cannot stand between #PTP ON and #PTP OFF, and their errors."""


def refuse_inside(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for a command that is not allowed while #PTP is active."""
    id = REFUSED.get(command.name)
    if id is not None and draft.state.kinematics.point_to_point:
        what = f"#{command.name} is not allowed while #PTP is active"
        draft.fail(id, command.span, what, "write #PTP OFF before it")


def _switch(draft: Draft, command: tree.HashCommand, on: bool) -> None:
    if draft.state.coordinates.kinematics is None:
        what = f"#{command.name} is only allowed while a transformation is active"
        draft.fail("21527", command.span, what, "write #TRAFO ON before it")
    held = replace(draft.state.kinematics, point_to_point=on)
    draft.state = replace(draft.state, kinematics=held)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP ON"""
    _switch(draft, command, on=True)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP OFF"""
    _switch(draft, command, on=False)


COMMANDS = {"PTP ON": on, "PTP OFF": off}
