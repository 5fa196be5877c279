"""Tool direction <-> the angles of at most two rotary axes.

Enters: unit directions of the rotary axes in chain order and the tool direction at angles 0.
Leaves: the two angle solutions ("poses") for any tool direction, in degrees, (-180, 180].
Linear axes and points do not matter here. The same solver serves the machine's own rotary axes
and the programming chains of the classic modes (AB, BA, AC, CA, BC, CB).

Source of the pose rule: FCT-C27 section 7 and decision D-3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.kinematics import turning
from ncscope.kinematics.turning import REACH_TOLERANCE_DEG, SINGULAR_SINE, SNAP_DEG

__all__ = ["REACH_TOLERANCE_DEG", "OrientationSolver"]

Array = NDArray[np.float64]

_VECTOR = np.arange(3)
_IN_ORDER = np.arange(2)


@dataclass(frozen=True, slots=True, eq=False)
class OrientationSolver:
    """Angles for tool directions, for one fixed pair of rotary axes.

    frame (3, 3), constants (6, 3): see `turning`. count: rotary axes really there (0..2); with
    fewer the missing ones are stand-ins. between_rad, lean_rad: angle of the first axis (on the
    tool's side of it) to the second, and of that to the tool. free: whether the direction leaves
    the second angle open.
    """

    frame: Array
    constants: Array
    count: int
    between_rad: float
    lean_rad: float
    free: bool

    @classmethod
    def from_axes(cls, directions: Array, zero: Array) -> OrientationSolver:
        """directions: (k, 3) unit, k = 0..2, in chain order; zero: (3,) unit tool direction."""
        count = len(directions)
        # With one axis the second is a copy that never turns; with none both lie in the tool.
        first = directions[0] if count > 0 else zero
        second = directions[1] if count > 1 else first
        side = 1.0 if first @ zero >= 0.0 else -1.0
        f12 = _angle_rad(side * first, second)
        fz = _angle_rad(second, zero)
        best = _turn_rad(second, zero, side * first)
        free = count < 2 or math.sin(f12) < SINGULAR_SINE or math.sin(fz) < SINGULAR_SINE
        frame = _frame(first)
        along = (second @ zero) * second
        lift = frame @ np.column_stack([zero - along, np.cross(second, zero), along])
        numbers = [
            [math.cos((f12 - fz) / 2) ** 2, math.sin((f12 - fz) / 2) ** 2, side],
            [math.cos((f12 + fz) / 2) ** 2, math.sin((f12 + fz) / 2) ** 2, float(free)],
            [math.degrees(best), math.cos(best), math.sin(best)],
        ]
        return cls(frame, np.vstack([lift, numbers]), count, f12, fz, free)

    @property
    def reach(self) -> tuple[float, float]:
        """Smallest and largest angle, degrees, between tool and first axis (tool's side of it)."""
        total = self.between_rad + self.lean_rad
        low, high = abs(self.between_rad - self.lean_rad), min(total, 2.0 * math.pi - total)
        return math.degrees(low), math.degrees(high)

    def tilt(self, direction: Array) -> float:
        """Angle in degrees between a direction (3,) and the first axis (tool's side of it)."""
        return math.degrees(_angle_rad(self.constants[3, 2] * self.frame[2], direction))

    @property
    def turning_point(self) -> float:
        """Second angle in degrees where the two poses meet: the tool is closest to axis one."""
        return float(self.constants[5, 0])

    def directions(self, angles: Array) -> Array:
        """Tool directions (m, 3) for angles (m, 2) in degrees."""
        out = np.empty((len(angles), 3))
        turning.direction_rows(self.frame, self.constants, angles, out)
        return out

    def pose_of(self, angles: Array) -> NDArray[np.int8]:
        """Pose +1 or -1 of each row of angles (m, 2) in degrees.

        On the two borders the pose is the one that a small positive turn leads into.
        """
        if self.free:
            return np.ones(len(angles), np.int8)
        turned = np.mod(angles[:, 1] - self.turning_point + SNAP_DEG, 360.0)
        return np.where(turned < 180.0, 1, -1).astype(np.int8)

    def solve(
        self, directions: Array, start: Array, pose: NDArray[np.int8]
    ) -> tuple[Array, NDArray[np.int8]]:
        """Angles (m, 2) in degrees and a status (m,) for directions (m, 3) of any length.

        start: (1, 2) or (m, 2) degrees. Angles that the direction leaves free keep this value;
            given once, each row continues from the row before.
        pose: (1,) or (m,): +1, -1, or 0 for the solution nearest to the start value.
        """
        m = len(directions)
        angles, status = np.zeros((m, 2)), np.zeros(m, np.int8)
        self.turn(directions, _VECTOR, self, self.frame, _IN_ORDER, start, pose, angles, status)
        return angles, status

    def turn(
        self,
        program: Array,
        columns: NDArray[np.int64],
        written: OrientationSolver,
        into: Array,
        rotary: NDArray[np.int64],
        start: Array,
        pose: NDArray[np.int8],
        axes: Array,
        status: NDArray[np.int8],
    ) -> None:
        """Writes rotary columns of `axes` and `status`; see `turning.turn_rows`."""
        numbers, start = written.constants, np.ascontiguousarray(start, np.float64)
        turning.turn_rows(
            program, columns, numbers, into, self.constants, rotary, start, pose, axes, status
        )


def _frame(axis: Array) -> Array:
    """Rows e1, e2, axis of a right-handed frame; along X, Y and Z its rows are these again."""
    helper = np.eye(3)[(int(np.argmax(np.abs(axis))) + 1) % 3]
    e1 = helper - (helper @ axis) * axis
    e1 /= np.linalg.norm(e1)
    return np.array([e1, np.cross(axis, e1), axis])


def _angle_rad(a: Array, b: Array) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))


def _turn_rad(k: Array, a: Array, b: Array) -> float:
    """Angle about k that turns a's component normal to k into that of b."""
    a, b = np.cross(k, a), np.cross(k, b)
    return math.atan2(float(k @ np.cross(a, b)), float(a @ b))
