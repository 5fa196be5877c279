"""#ECS ON, #ECS OFF: the effector coordinate system, with Z along the tool.

Z points from the tip to the flange, so a relative motion in +Z withdraws the tool. The origin
stays where it was. Source: TF5200 #ECS; FCT-C2 2.2.5; P-CHAN-00031, P-CHAN-00050
"""

from __future__ import annotations

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.systems import ECS, active, link, unlink
from ncscope.coordinates import Level
from ncscope.frames import Array, Frame, axes_in_plane, tilt
from ncscope.kinematics.universal import KinematicsError
from ncscope.language import tree


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#ECS ON"""
    if command.groups or command.modifiers:
        what = "#ECS ON takes no values: its axes follow from the tool direction"
        draft.fail("N1005", command.span, what)
    others = draft.state.coordinates.levels[1:]
    if others:
        what = (
            f"#ECS cannot be selected while another coordinate system is active: {others[-1].name}"
        )
        draft.fail("20774", command.span, what, "switch all others off first (#CS OFF ALL)")
    rotation = _rotation(draft, _tool_direction(draft, command))
    level = Level(ECS, ECS, Frame(f"below {ECS}", ECS, rotation), origin=draft.place)
    link(draft, command.span, level)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#ECS OFF, #ECS OFF ALL"""
    if not active(draft, ECS):
        what = "no effector coordinate system is active; #ECS OFF does nothing"
        draft.warn("20824", command.span, what)
        return
    unlink(draft, command.span, (len(draft.state.coordinates.levels) - 1,))


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#ECS DEF: there is no such thing."""
    what = "an effector coordinate system cannot be defined: it follows from the tool direction"
    draft.fail("20823", command.span, what, "write #ECS ON")


def _tool_direction(draft: Draft, command: tree.HashCommand) -> Array:
    """Unit vector tip -> flange (3,) in the machine system."""
    state = draft.state
    try:
        direction = state.coordinates.direction(state.position.axes)
    except KinematicsError as error:
        draft.fail(error.id, command.span, error.message)
    if direction is not None:
        return direction
    if any(state.kinematics.ids):
        draft.fail(
            "N2050",
            command.span,
            "#ECS needs the tool direction, and no transformation is active",
            "write #TRAFO ON before #ECS ON",
        )
    return -np.array(state.coordinates.tool.direction)


def _rotation(draft: Draft, direction: Array) -> Array:
    settings = draft.machine.settings
    if not (settings.ecs_axis or settings.ecs_plane):
        return tilt(direction)
    return axes_in_plane(direction, settings.ecs_axis or "X", settings.ecs_plane or "XY")


COMMANDS = {"ECS ON": on, "ECS OFF": off, "ECS OFF ALL": off, "ECS DEF": define}
