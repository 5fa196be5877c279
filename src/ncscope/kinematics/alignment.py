"""The tool along a given direction, or longer, at axis values that are given: RTCP helpers.

Enters: axis values, mm and degrees, and a direction in the workpiece system or a length. Leaves:
axis values. Serves `#TOOL ORI CS` and `#TLC`, which work on machine axes.
Source: TF5200 #TOOL ORI CS, #TLC; P-CHAN-00188, P-CHAN-00189.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ncscope.kinematics import kernels
from ncscope.kinematics.orientation import OrientationSolver
from ncscope.kinematics.step import Array, KinematicsError
from ncscope.kinematics.universal import UniversalKinematics


def aligned(
    kinematics: UniversalKinematics,
    axes: ArrayLike,
    direction: ArrayLike,
    tool_length: float,
) -> Array:
    """Axis values (2, n) with the same tool tip and the tool along `direction`.

    axes: (n,) present values. direction: (3,) from the tip to the flange, workpiece system.
    Rows: pose +1, pose -1. A rotary axis that the direction leaves free stays where it is.
    Raises KinematicsError: 20662 without a rotary axis, 292006 with three of them, 292014 for a
    direction out of reach.
    """
    rotary = list(kinematics.chain.rotary)
    if not rotary:
        raise KinematicsError("20662", "the kinematics has no rotary axis to turn the tool with")
    if len(rotary) > 2:
        raise KinematicsError("292006", "three rotary axes leave open how to turn the tool")
    now = np.asarray(axes, dtype=float)
    solver, start = _solver(kinematics), _angles(kinematics, now)
    wanted = np.array([direction, direction], dtype=float)
    angles, status = solver.solve(wanted, start, np.array([1, -1], np.int8))
    if status.any():
        raise _out_of_reach(solver, wanted[0])
    result = np.array([now, now])
    result[:, rotary] = angles[:, : len(rotary)]
    return with_linear(kinematics, result, now, tool_length)


def _out_of_reach(solver: OrientationSolver, direction: Array) -> KinematicsError:
    low, high = solver.reach
    return KinematicsError(
        "292014",
        "the rotary axes cannot bring the tool into this direction",
        hint=f"the angle between tool and first rotary axis can be {low:.4f} to {high:.4f} "
        f"degrees; here it is {solver.tilt(direction):.4f}",
    )


def pose_of(kinematics: UniversalKinematics, axes: ArrayLike) -> int:
    """Pose +1 or -1 of axis values (n,), with RTCP too (decision D-3)."""
    return int(_solver(kinematics).pose_of(_angles(kinematics, np.asarray(axes, dtype=float)))[0])


def _solver(kinematics: UniversalKinematics) -> OrientationSolver:
    chain = kinematics.chain
    return OrientationSolver.from_axes(chain.directions[list(chain.rotary)], chain.zero_orientation)


def _angles(kinematics: UniversalKinematics, axes: Array) -> Array:
    rotary = list(kinematics.chain.rotary)
    angles = np.zeros((1, 2))
    angles[0, : len(rotary)] = axes[rotary]
    return angles


def with_linear(
    kinematics: UniversalKinematics, axes: Array, tip_of: Array, tool_length: float
) -> Array:
    """`axes` (m, n) with X, Y, Z such that the tip is where `tip_of` (n,) puts it."""
    tip = kinematics.forward(tip_of, tool_length)[0]
    joints, flange, _, unlinkage = kinematics.packed
    status = np.zeros(len(axes), np.int8)
    target = np.tile(tip, (len(axes), 1))
    kernels.solve_rows(joints, flange, unlinkage, target, tool_length, axes, status)
    if status.any():
        raise KinematicsError("292016", "the linear axes cannot hold the tool tip there")
    return axes


@dataclass(frozen=True, slots=True, eq=False)
class LengthCorrection:
    """#TLC: machine axis values made for one tool length, run with a tool longer by `length` mm.

    kinematics: with RTCP and the position as programmed, so that it takes axis angles.
    """

    kinematics: UniversalKinematics
    length: float

    def inverse(self, axes: ArrayLike) -> Array:
        """Axis values (..., n) that put the longer tool where `axes` put the shorter one."""
        return self._carried(axes, 0.0, self.length)

    def program(self, axes: ArrayLike) -> Array:
        """The way back."""
        return self._carried(axes, self.length, 0.0)

    def _carried(self, axes: ArrayLike, before: float, after: float) -> Array:
        return self.kinematics.inverse(self.kinematics.program(axes, before), after)
