"""The machine as the page draws and moves it: its axes, and each kinematics as a chain."""

from __future__ import annotations

from typing import Any

import numpy as np

from ncscope.kinematics import Chain, KinematicsError, UniversalKinematics, explain_status
from ncscope.kinematics.chain import LINEAR
from ncscope.kinematics.poses import Poses, poses_of_axes, poses_of_tool
from ncscope.machine import Machine


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
    found = {}
    for id in machine.kinematic_parameters:
        try:
            found[id] = _kinematics(machine, id).chain
        except KinematicsError:
            continue  # `check` says what is wrong with it
    return found


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
    """Tool tip (mm), direction (tip -> flange), pose and condition numbers of axis positions.

    Raises KinematicsError and KeyError.
    """
    kin = _kinematics(machine, id)
    return _pose(kin, poses_of_axes(kin, _row(kin, axes), length), 0)


def jog_inverse(
    machine: Machine,
    id: int,
    tip: list[float],
    direction: list[float],
    length: float,
    near: list[float],
) -> list[dict[str, Any]]:
    """Axis positions for tool tip (mm) and direction, one entry for each pose.

    An entry has `problem` where the machine cannot get there. Raises KinematicsError, KeyError.
    """
    kin = _kinematics(machine, id)
    if not any(direction):
        raise KinematicsError("292007", "the tool direction is the zero vector")
    unit = np.asarray(direction, float) / np.linalg.norm(direction)
    found = poses_of_tool(kin, [tip], [unit], length, _row(kin, near), both=True)
    return [_pose(kin, found, row) for row in range(len(found))]


def _kinematics(machine: Machine, id: int) -> UniversalKinematics:
    if id not in machine.kinematic_parameters:
        raise KeyError(f"the lists configure no kinematics {id}")
    kin = machine.kinematics[id]
    if not isinstance(kin, UniversalKinematics):
        raise KinematicsError("N2001", f"kinematics {id} is not of type 91")
    return kin


def _pose(kin: UniversalKinematics, found: Poses, row: int) -> dict[str, Any]:
    if found.status[row]:
        id, message = explain_status(kin, int(found.status[row]))
        return {"pose": int(found.pose[row]), "problem": f"{id}: {message}"}
    return {
        "pose": int(found.pose[row]) if 0 < len(kin.chain.rotary) <= 2 else None,
        "axes": found.axes[row].tolist(),
        "program": found.program[row].tolist(),
        "tip": found.tip[row].tolist(),
        "direction": found.direction[row].tolist(),
        "condition": [float(found.linear[row]), float(found.rotary[row])],
    }


def _row(kin: UniversalKinematics, values: list[float]) -> np.ndarray:
    """Axis positions of the whole channel; 0 for those that were not given."""
    row = np.zeros(len(kin.axis_names))
    row[: len(values)] = values[: len(row)]
    return row
