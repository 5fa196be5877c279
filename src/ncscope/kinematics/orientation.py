"""Tool direction <-> the angles of at most two rotary axes.

Enters: unit directions of the rotary axes in chain order and the tool direction at angles 0.
Leaves: the two angle solutions ("poses") for any tool direction, in degrees, (-180, 180].
Linear axes and points do not matter here. The same solver serves the machine's own rotary axes
and the programming chains of the classic modes (AB, BA, AC, CA, BC, CB).

Method: Paden-Kahan subproblem 2 for directions, written with half angles so that it stays accurate
at both ends of the reach. Source of the pose rule: FCT-C27 section 7 and decision D-3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.compilation import compiled
from ncscope.kinematics.kernels import (
    NOT_FINITE,
    OK,
    UNREACHABLE,
    ZERO_VECTOR,
    rotate,
    sincos_deg,
)

Array = NDArray[np.float64]

REACH_TOLERANCE_DEG = 1e-4
"""Directions outside the reach by less than the kernel's angle resolution are clamped (D-2)."""

SINGULAR_SINE = 1e-9
"""Below this sine between tool and first axis the first angle is free and keeps its value (D-4)."""

_SNAP_DEG = 1e-9
_SMALLEST_VECTOR = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class OrientationSolver:
    """Angles for tool directions, for one fixed pair of rotary axes.

    geometry (3, 3): direction of the first and second rotary axis, tool direction at angles 0.
    angles (5,), radians except where named otherwise: [0] first axis (turned to the side of the
    tool) to second axis, [1] second axis to tool, [2] +1/-1 whether the first axis was turned,
    [3] the second angle in degrees that brings the tool closest to the first axis,
    [4] 1 when only the first angle follows from the direction.
    count: rotary axes really there (0..2); with fewer the missing ones are stand-ins.
    """

    geometry: Array
    angles: Array
    count: int

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
        best_deg = math.degrees(_turn_rad(second, zero, side * first))
        free = count < 2 or math.sin(f12) < SINGULAR_SINE or math.sin(fz) < SINGULAR_SINE
        angles = np.array([f12, fz, side, best_deg, float(free)])
        return cls(np.array([first, second, zero]), angles, count)

    @property
    def reach(self) -> tuple[float, float]:
        """Smallest and largest angle, degrees, between tool and first axis (tool's side of it)."""
        low, high = _reach_rad(self.angles[0], self.angles[1])
        return math.degrees(low), math.degrees(high)

    def tilt(self, direction: Array) -> float:
        """Angle in degrees between a direction (3,) and the first axis (tool's side of it)."""
        return math.degrees(_angle_rad(self.angles[2] * self.geometry[0], direction))

    @property
    def turning_point(self) -> float:
        """Second angle in degrees where the two poses meet: the tool is closest to axis one."""
        return float(self.angles[3])

    def directions(self, angles: Array) -> Array:
        """Tool directions (m, 3) for angles (m, 2) in degrees."""
        out = np.empty((len(angles), 3))
        _direction_rows(self.geometry, angles, out)
        return out

    def pose_of(self, angles: Array) -> NDArray[np.int8]:
        """Pose +1 or -1 of each row of angles (m, 2) in degrees.

        On the two borders the pose is the one that a small positive turn leads into.
        """
        if self.angles[4]:
            return np.ones(len(angles), np.int8)
        turned = np.mod(angles[:, 1] - self.turning_point + _SNAP_DEG, 360.0)
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
        start = np.ascontiguousarray(start, np.float64)
        _orient_rows(self.geometry, self.angles, directions, start, pose, angles, status)
        return angles, status


def _angle_rad(a: Array, b: Array) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))


def _turn_rad(k: Array, a: Array, b: Array) -> float:
    """Angle about k that turns a's component normal to k into that of b."""
    a, b = np.cross(k, a), np.cross(k, b)
    return math.atan2(float(k @ np.cross(a, b)), float(a @ b))


@compiled
def _reach_rad(f12, fz):
    return abs(f12 - fz), min(f12 + fz, 2.0 * math.pi - f12 - fz)


@compiled
def wrap_deg(angle):
    """The same angle in (-180, 180]; within 1e-9 of -180 it counts as 180."""
    wrapped = angle - 360.0 * math.floor((angle + 180.0) / 360.0)
    return 180.0 if wrapped <= -180.0 + _SNAP_DEG else wrapped


@compiled
def _direction_rows(geometry, angles, out):
    for row in range(angles.shape[0]):
        x, y, z = geometry[2, 0], geometry[2, 1], geometry[2, 2]
        for k in range(1, -1, -1):
            s, c = sincos_deg(angles[row, k])
            x, y, z = rotate(geometry[k, 0], geometry[k, 1], geometry[k, 2], s, c, x, y, z)
        out[row, 0], out[row, 1], out[row, 2] = x, y, z


@compiled
def _half_sincos(sine, cosine):
    """Sine and cosine of phi/2 from those of phi in [0, pi], accurate at both ends."""
    if cosine >= 0.0:
        c = math.sqrt(0.5 * (1.0 + cosine))
        return 0.5 * sine / c, c
    s = math.sqrt(0.5 * (1.0 - cosine))
    return s, 0.5 * sine / s


@compiled
def _first_angle(geometry, second_angle, x, y, z):
    """Angle of the first axis that turns the tool, set by the second angle, into (x, y, z)."""
    kx, ky, kz = geometry[0, 0], geometry[0, 1], geometry[0, 2]
    s, c = sincos_deg(second_angle)
    wx, wy, wz = rotate(
        geometry[1, 0], geometry[1, 1], geometry[1, 2], s, c,
        geometry[2, 0], geometry[2, 1], geometry[2, 2],
    )  # fmt: skip
    # Both are crossed with the axis first: the parts normal to it may be tiny, and forming them
    # as differences of products of whole vectors would lose their digits.
    ax, ay, az = ky * wz - kz * wy, kz * wx - kx * wz, kx * wy - ky * wx
    bx, by, bz = ky * z - kz * y, kz * x - kx * z, kx * y - ky * x
    sine = kx * (ay * bz - az * by) + ky * (az * bx - ax * bz) + kz * (ax * by - ay * bx)
    cosine = ax * bx + ay * by + az * bz
    return wrap_deg(math.degrees(math.atan2(sine, cosine)))


@compiled
def _orient_rows(geometry, numbers, directions, start, pose, angles, status):
    f12, fz, side, best, free = numbers
    low, high = _reach_rad(f12, fz)
    tolerance_rad = REACH_TOLERANCE_DEG * math.pi / 180.0
    # Sines and cosines of half the difference and half the sum of the fixed angles.
    sd, cd = math.sin((f12 - fz) / 2), math.cos((f12 - fz) / 2)
    sa, ca = math.sin((f12 + fz) / 2), math.cos((f12 + fz) / 2)
    kx, ky, kz = side * geometry[0, 0], side * geometry[0, 1], side * geometry[0, 2]
    keep1, keep2 = wrap_deg(start[0, 0]), wrap_deg(start[0, 1])
    for row in range(directions.shape[0]):
        if start.shape[0] > 1:
            keep1, keep2 = wrap_deg(start[row, 0]), wrap_deg(start[row, 1])
        x, y, z = directions[row, 0], directions[row, 1], directions[row, 2]
        length = math.sqrt(x * x + y * y + z * z)
        if not math.isfinite(length):
            status[row] = NOT_FINITE
            continue
        if length < _SMALLEST_VECTOR:
            status[row] = ZERO_VECTOR
            continue
        x, y, z = x / length, y / length, z / length
        cx, cy, cz = ky * z - kz * y, kz * x - kx * z, kx * y - ky * x
        sine = math.sqrt(cx * cx + cy * cy + cz * cz)
        cosine = kx * x + ky * y + kz * z
        sp, cp = _half_sincos(sine, cosine)
        # Products of sin((phi +- difference)/2) and sin((sum +- phi)/2): negative out of reach.
        near = (sp * cd + cp * sd) * (sp * cd - cp * sd)
        far = (sa * cp + ca * sp) * (sa * cp - ca * sp)
        if free or near < 0.0 or far < 0.0:
            phi = math.atan2(sine, cosine)
            if phi < low - tolerance_rad or phi > high + tolerance_rad:
                status[row] = UNREACHABLE
                continue
        half = 0.0
        if not free:
            half_rad = 2.0 * math.atan2(math.sqrt(max(near, 0.0)), math.sqrt(max(far, 0.0)))
            half = math.degrees(half_rad)
        wanted = pose[row] if pose.shape[0] > 1 else pose[0]
        second = keep2 if free else wrap_deg(best + (half if wanted >= 0 else -half))
        first = keep1 if sine < SINGULAR_SINE else _first_angle(geometry, second, x, y, z)
        if wanted == 0 and not free:
            other2 = wrap_deg(best - half)
            other1 = keep1 if sine < SINGULAR_SINE else _first_angle(geometry, other2, x, y, z)
            here = abs(wrap_deg(first - keep1)) + abs(wrap_deg(second - keep2))
            if abs(wrap_deg(other1 - keep1)) + abs(wrap_deg(other2 - keep2)) < here:
                first, second = other1, other2
        keep1, keep2 = first, second
        angles[row, 0], angles[row, 1] = first, second
        status[row] = OK
