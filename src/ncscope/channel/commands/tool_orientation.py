"""#TOOL ORI CS: turns the tool onto an axis of the active coordinate system; the tip stays.

Source: TF5200 #TOOL ORI CS; P-CHAN-00188 (which axis), P-CHAN-00189 (which of two solutions).
"""

from __future__ import annotations

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.frames import Array
from ncscope.kinematics.alignment import aligned, pose_of
from ncscope.kinematics.step import KinematicsError
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.language import tree

SHORTEST, WITHIN_LIMITS, FIRST, SECOND = 1, 2, 3, 4
"""P-CHAN-00189; 0 keeps the pose of the axes."""


def turn(draft: Draft, command: tree.HashCommand) -> None:
    """#TOOL ORI CS"""
    coordinates = draft.state.coordinates
    active = coordinates.kinematics
    if active is None:
        what = "#TOOL ORI CS needs an active transformation"
        draft.fail("21323", command.span, what, "write #TRAFO ON before it")
    model, axes = active.model, draft.state.position.axes
    if not isinstance(model, UniversalKinematics):
        what = f"kinematics {model.id} does not say how to turn the tool"
        draft.fail("292006", command.span, what, "only a single step of type 91 does")
    along = (draft.machine.settings.tool_orientation_axis or 3) - 1
    direction = coordinates.mcs_frame.rotation[:, along]
    try:
        both = aligned(model, axes, direction, coordinates.tool.length)
    except KinematicsError as error:
        draft.fail(error.id, command.span, error.message, error.hint)
    target = both[_choice(draft, model, both)]
    program = coordinates.to_program(target, near=draft.state.position.program)
    draft.move_to(program, command.span)


def _choice(draft: Draft, model: UniversalKinematics, both: Array) -> int:
    """Row of the solution to take; a complete transformation stays in its pose."""
    settings, now = draft.machine.settings, draft.state.position.axes
    active, rotary = draft.state.coordinates.kinematics, list(model.chain.rotary)
    mode = settings.tool_orientation_mode
    if not model.rtcp and active is not None:
        return 0 if active.pose is None or active.pose > 0 else 1
    if mode in (FIRST, SECOND):
        return mode - FIRST
    if mode not in (SHORTEST, WITHIN_LIMITS):
        return 0 if pose_of(model, now) > 0 else 1
    inside = [all(_inside(draft, axis, row[axis]) for axis in rotary) for row in both]
    if mode == WITHIN_LIMITS and inside[0] != inside[1]:
        return 0 if inside[0] else 1
    way = both - now
    way -= draft.state.coordinates.modulo.whole_turns(way)
    travel = np.abs(way[:, rotary]).sum(axis=1)
    return 0 if travel[0] <= travel[1] else 1


def _inside(draft: Draft, axis: int, value: float) -> bool:
    limits = draft.state.axes[axis].limits
    return limits is None or limits[0] <= value <= limits[1]


COMMANDS = {"TOOL ORI CS": turn}
