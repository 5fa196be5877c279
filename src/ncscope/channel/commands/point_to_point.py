"""#PTP ON, #PTP OFF: with a transformation, axes go straight to the same end point.

End points are the same with and without it; points between them lie where straight axes lead.
Source: TF5200 #PTP.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.language import tree

SYSTEMS = frozenset({"CS", "ACS", "BCS", "ECS"})
ALLOWED = frozenset({"DEF", "MODE", "ADD"})
"""Of the commands of coordinate systems: they store something and switch nothing."""


def refuse_inside(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for a command that is not allowed while #PTP is active."""
    id = _refusal(command.name) if draft.state.coordinates.point_to_point else None
    if id is not None:
        what = f"#{command.name} is not allowed while #PTP is active"
        draft.fail(id, command.span, what, "write #PTP OFF before it")


def _refusal(name: str) -> str | None:
    first, *rest = name.split(" ")
    verb = rest[0] if rest else ""
    if first in SYSTEMS and verb not in ALLOWED:
        return "21529" if verb in ("OFF", "DEL") else "21550"
    return "21531" if first == "MCS" and verb in ("ON", "OFF") else None


def _switch(draft: Draft, command: tree.HashCommand, on: bool) -> None:
    coordinates = draft.state.coordinates
    if coordinates.kinematics is None:
        what = f"#{command.name} is only allowed while a transformation is active"
        draft.fail("21527", command.span, what, "write #TRAFO ON before it")
    active = replace(coordinates.kinematics, point_to_point=on)
    draft.set_coordinates(replace(coordinates, kinematics=active), command.span)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP ON"""
    _switch(draft, command, on=True)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP OFF"""
    _switch(draft, command, on=False)


COMMANDS = {"PTP ON": on, "PTP OFF": off}
