"""#MCS ON, #MCS OFF: programmed values are axis positions for a while.

Kinematics, coordinate systems, contour rotation, tool and all offsets wait; scale and mirror stay.
Source: TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.state import Suspended
from ncscope.channel.tools import renew_kinematics
from ncscope.coordinates import Coordinates
from ncscope.kinematics.step import KinematicsError
from ncscope.language import tree

REFUSED = frozenset({"CS", "ACS", "BCS", "ECS", "TLC", "TRAFO", "RTCP"})
"""First words of the commands that cannot stand between #MCS ON and #MCS OFF."""
POSE_CHANGE = 1e-3
"""Degrees: axes that would turn by more stand in another pose."""


def refuse_inside(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for a command that is not allowed while #MCS is active."""
    if draft.state.suspended is not None and command.name.split(" ")[0] in REFUSED:
        what = f"#{command.name} is not allowed while #MCS is active"
        draft.fail("20805", command.span, what, "write #MCS OFF before it")


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#MCS ON, #MCS ON [EX TOOL]: with EX TOOL a D word counts after #MCS OFF only."""
    ex_tool = _ex_tool(draft, command)
    state = draft.state
    if state.suspended is not None:
        draft.warn("N2023", command.span, "#MCS is on already; this #MCS ON does nothing")
        return
    held = state.coordinates
    suspended = Suspended(held, state.zero_index, ex_tool)
    draft.state = state.changed(suspended=suspended, zero_index=0)
    bare = Coordinates(
        held.axis_count,
        contour=held.contour.without_turn(),
        modulo=held.modulo,
        manual=held.manual,
    )
    draft.set_coordinates(bare, command.span)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#MCS OFF: as before #MCS ON, with the tool, scale and mirror that are valid now."""
    state = draft.state
    held = state.suspended
    if held is None:
        draft.warn("N2023", command.span, "#MCS is not on; #MCS OFF does nothing")
        return
    contour = replace(state.coordinates.contour, turn=held.coordinates.contour.turn)
    tool = offsets.active_tool(state)
    draft.state = state.changed(suspended=None, zero_index=held.zero_index)
    restored = replace(
        held.coordinates, contour=contour, tool=tool, manual=state.coordinates.manual
    )
    draft.set_coordinates(restored, command.span)
    renew_kinematics(draft, command.span)
    _warn_of_pose(draft, command)


def _warn_of_pose(draft: Draft, command: tree.HashCommand) -> None:
    """The pose is fixed while a transformation is selected, wherever #MCS took the axes."""
    position, coordinates = draft.state.position, draft.state.coordinates
    try:
        wanted = coordinates.to_axes(position.program, near=position.axes)
    except KinematicsError:
        return  # the next motion will say so
    turn = (wanted - position.axes)[3:]
    if np.any(np.abs(turn - 360.0 * np.round(turn / 360.0)) > POSE_CHANGE):
        what = "the axes stand in another pose than the transformation keeps since its selection"
        hint = "the next motion turns them back; #TRAFO OFF and #TRAFO ON would take this pose"
        draft.warn("N2071", command.span, what, hint)


def _ex_tool(draft: Draft, command: tree.HashCommand) -> bool:
    items = [item for group in command.groups for item in group.items]
    words = [m.upper() for m in command.modifiers]
    words += [i.value.text.upper() for i in items if isinstance(i.value, tree.Name)]
    if words not in ([], ["EX", "TOOL"]) or any(not isinstance(i.value, tree.Name) for i in items):
        draft.fail("N1005", command.span, "#MCS ON is written wrongly", "write #MCS ON [EX TOOL]")
    return bool(words)


COMMANDS = {"MCS ON": on, "MCS OFF": off}
