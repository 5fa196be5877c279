"""#PTP ON, #PTP OFF: with a transformation, axes go straight to the same end point.

The path between two positions is another one; end points, and so everything here, are the same.
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
    id = _refusal(command.name) if draft.state.kinematics.point_to_point else None
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
    if draft.state.coordinates.kinematics is None:
        what = f"#{command.name} is only allowed while a transformation is active"
        draft.fail("21527", command.span, what, "write #TRAFO ON before it")
    held = replace(draft.state.kinematics, point_to_point=on)
    draft.state = replace(draft.state, kinematics=held)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP ON"""
    _switch(draft, command, on=True)
    what = "#PTP changes the path, not the end points; points between them are those without it"
    draft.warn("N2070", command.span, what)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#PTP OFF"""
    _switch(draft, command, on=False)


COMMANDS = {"PTP ON": on, "PTP OFF": off}
