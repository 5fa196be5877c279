"""The machine as the page draws and moves it: its axes, and each kinematics as a chain."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ncscope.kinematics import Chain, KinematicsError, UniversalKinematics, validate
from ncscope.kinematics.chain import LINEAR
from ncscope.kinematics.parameters import INDEX_OF_FIELD
from ncscope.machine import Machine

POSES = (1, -1)


def machine_view(machine: Machine) -> dict[str, Any]:
    """Axes in channel order, and every kinematics of the lists that can be drawn."""
    return {
        "name": machine.name,
        "axes": [
            {"name": a.name, "rotary": a.rotary, "limits": a.limits, "modulo": a.modulo_range}
            for a in machine.axes
        ],
        "kinematics": [
            chain_view(machine, id, chain) for id, chain in sorted(_chains(machine).items())
        ],
        "default": machine.settings.default_kinematic_id,
    }


def _chains(machine: Machine) -> dict[int, Chain]:
    mode = machine.settings.orientation_mode
    names = machine.axis_names
    return {
        id: Chain.from_parameters(parameters, mode)
        for id, parameters in machine.kinematic_parameters.items()
        if not validate(parameters, len(names), mode, names)
    }


def model_view(machine: Machine, model: Any) -> dict[str, Any] | None:
    """The chain of a kinematics that a program selected; None for one that is no chain."""
    chain = getattr(model, "chain", None)
    return chain_view(machine, model.id, chain) if isinstance(chain, Chain) else None


def chain_view(machine: Machine, id: int, chain: Chain) -> dict[str, Any]:
    """A chain in mm and unit vectors, joints from the workpiece to the tool."""
    names = machine.axis_names
    return {
        "id": id,
        "joints": [
            {
                "axis": int(a),
                "name": names[a] if a < len(names) else f"axis {a}",
                "linear": bool(chain.types[a] == LINEAR),
                "direction": chain.directions[a].tolist(),
                "point": chain.points[a].tolist(),
            }
            for a in chain.order
        ],
        "flange": chain.zero_position.tolist(),
        "orientation": chain.zero_orientation.tolist(),
        "linkage": None if chain.linkage is None else chain.linkage.tolist(),
        "linkageOffset": None if chain.linkage_offset is None else chain.linkage_offset.tolist(),
        "rtcp": chain.rtcp,
        "mode": chain.programming_mode,
    }


def jog_forward(machine: Machine, id: int, axes: list[float], length: float) -> dict[str, Any]:
    """Tool tip (mm), direction (tip -> flange) and pose. Raises KinematicsError and KeyError."""
    model = machine.kinematics[id]
    tip, direction = model.forward(_padded(axes, machine), tool_length=length)
    pose = int(_directed(machine, id).pose_of(axes)) if _has_poses(model) else None
    return {"tip": tip.tolist(), "direction": direction.tolist(), "pose": pose}


def jog_inverse(
    machine: Machine,
    id: int,
    tip: list[float],
    direction: list[float],
    length: float,
    near: list[float],
) -> list[dict[str, Any]]:
    """Axis positions for tool tip (mm) and direction, one entry for each pose.

    An entry has `axes`, or `problem` where the machine cannot get there.
    Raises KinematicsError and KeyError.
    """
    model = _directed(machine, id)
    program = np.zeros(max(6, len(machine.axes)))
    program[:3] = tip
    found = []
    for pose in POSES:
        try:
            axes = model.inverse(
                program, tool_length=length, near=_padded(near, machine), pose=pose,
                direction=direction,
            )  # fmt: skip
        except KinematicsError as error:
            found.append({"pose": pose, "problem": f"{error.id}: {error.message}"})
            continue
        found.append({"pose": pose, "axes": axes[: len(machine.axes)].tolist()})
    return found


def _directed(machine: Machine, id: int) -> UniversalKinematics:
    """The kinematics as a complete transformation, which takes a tool direction."""
    parameters = machine.kinematic_parameters[id]
    values = list(parameters.values)
    values[INDEX_OF_FIELD["rtcp"]] = 0.0
    mode = machine.settings.orientation_mode
    complete = replace(parameters, values=tuple(values))
    return UniversalKinematics.from_parameters(complete, machine.axis_names, mode)


def _has_poses(model: UniversalKinematics) -> bool:
    return 0 < len(model.chain.rotary) <= 2


def _padded(axes: list[float], machine: Machine) -> np.ndarray:
    values = np.zeros(max(6, len(machine.axes)))
    values[: len(axes)] = axes
    return values
