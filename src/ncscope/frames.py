"""Rigid transforms that know the two coordinate systems they link.

A `Frame` named `a_from_b` turns coordinates written in system b into coordinates of system a.
Neighbours must match: `a_from_b @ b_from_c` is `a_from_c`. Lengths mm, angles degrees,
positive rotations are right-handed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.compilation import compiled

Array = NDArray[np.float64]

ROTATION_SEQUENCES = (
    "XYZ", "XYX", "XZY", "XZX", "YXZ", "YXY", "YZX", "YZY", "ZXY", "ZXZ", "ZYX", "ZYZ",
)  # fmt: skip
"""The rotation sequences that a channel list may configure (P-CHAN-00394)."""


@dataclass(frozen=True)
class Frame:
    """Coordinates of `target` from coordinates of `origin`: target = rotation @ origin + shift.

    rotation: (3, 3) orthonormal, right-handed. shift: (3,) mm, in the axes of `target`.
    """

    target: str
    origin: str
    rotation: Array = field(default_factory=lambda: np.eye(3))
    shift: Array = field(default_factory=lambda: np.zeros(3))

    def __matmul__(self, other: Frame) -> Frame:
        """Raises ValueError when the inner names differ."""
        if self.origin != other.target:
            raise ValueError(
                f"{self.target}_from_{self.origin} cannot be followed by "
                f"{other.target}_from_{other.origin}: {self.origin} is not {other.target}"
            )
        return Frame(
            self.target,
            other.origin,
            self.rotation @ other.rotation,
            self.rotation @ other.shift + self.shift,
        )

    @property
    def inverse(self) -> Frame:
        back = self.rotation.T
        return Frame(self.origin, self.target, back, -back @ self.shift)

    def apply(self, points: ArrayLike) -> Array:
        """Points (..., 3) mm of `origin` as points (..., 3) mm of `target`."""
        return np.asarray(points, dtype=float) @ self.rotation.T + self.shift


def sin_cos(angle: float) -> tuple[float, float]:
    """Sine and cosine of degrees, exact at multiples of 90."""
    quarter, rest = divmod(angle, 90.0)
    if rest == 0.0:
        return ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))[int(quarter) % 4]
    angle_rad = math.radians(angle)
    return math.sin(angle_rad), math.cos(angle_rad)


def axis_rotation(axis: str, angle: float) -> Array:
    """Right-handed rotation (3, 3) about X, Y or Z; degrees."""
    s, c = sin_cos(angle)
    i = "XYZ".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    matrix = np.eye(3)
    matrix[j, j] = matrix[k, k] = c
    matrix[k, j], matrix[j, k] = s, -s
    return matrix


def sequence_rotation(angles: ArrayLike, sequence: str = "ZYX", fixed: bool = False) -> Array:
    """Rotation (3, 3) of a coordinate system given by three angles in degrees.

    angles: f1, f2, f3. With three different letters f1 belongs to X, f2 to Y, f3 to Z; with a
    repeated letter f3 turns first, f2 second, f1 third. fixed: each turn is about the axes of the
    starting system instead of the axes already turned.
    Source: #CS definition, P-CHAN-00393, P-CHAN-00394.
    """
    f = np.asarray(angles, dtype=float)
    by_axis = len(set(sequence)) == 3
    turns = [
        axis_rotation(letter, f["XYZ".index(letter)] if by_axis else f[2 - i])
        for i, letter in enumerate(sequence)
    ]
    first, second, third = turns
    return third @ second @ first if fixed else first @ second @ third


def tilt(direction: ArrayLike) -> Array:
    """The smallest rotation (3, 3) that turns Z into a unit vector (3,); against Z it is half a
    turn about X."""
    d = np.asarray(direction, dtype=float)
    axis = np.cross([0.0, 0.0, 1.0], d)
    sine2, cosine = float(axis @ axis), float(d[2])
    if sine2 < 1e-30:
        return np.diag([1.0, 1.0, 1.0] if cosine > 0.0 else [1.0, -1.0, -1.0])
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    # 1 / (1 + cosine), written so that it keeps its digits near the opposite of Z
    factor = 1.0 / (1.0 + cosine) if cosine > 0.0 else (1.0 - cosine) / sine2
    return np.eye(3) + cross + factor * (cross @ cross)


def axes_in_plane(direction: ArrayLike, kind: str, plane: str) -> Array:
    """Rotation (3, 3) that turns Z into a unit vector (3,) and lays X or Y (`kind`) into a plane.

    plane: `XY`, `ZX` or `YZ`. The remaining axis lies on the same side of the plane as Z. Where
    `direction` is perpendicular to the plane the smallest rotation is taken.
    Source: P-CHAN-00031, P-CHAN-00050.
    """
    z = np.asarray(direction, dtype=float)
    normal = np.zeros(3)
    normal[{"XY": 2, "ZX": 1, "YZ": 0}[plane]] = 1.0
    in_plane = np.cross(normal, z)
    length = np.linalg.norm(in_plane)
    if length < 1e-12:
        return tilt(z)
    side = 1.0 if normal @ z >= 0.0 else -1.0
    first = side * in_plane / length
    if kind == "X":
        return np.column_stack([first, np.cross(z, first), z])
    return np.column_stack([np.cross(-first, z), -first, z])


def transformed(points: ArrayLike, rotation: Array | None, shift: Array) -> Array:
    """rotation @ point + shift for points (..., n), a new array.

    rotation: (k, k) with k <= n; columns beyond it are shifted only. None turns nothing. shift:
    (n,). Summed in one order, so that one row and a million agree to the last bit.
    """
    values = np.asarray(points, dtype=float)
    if rotation is None:
        return values + shift
    rows = np.require(values, requirements=["C", "W"]).reshape(-1, values.shape[-1])
    result = np.empty(values.shape)
    _transform_rows(rows, np.array(rotation, order="C"), shift, result.reshape(rows.shape))
    return result


@compiled
def _transform_rows(rows, rotation, shift, result):
    turned, columns = rotation.shape[0], rows.shape[1]
    for row in range(rows.shape[0]):
        for i in range(turned):
            total = 0.0
            for j in range(turned):
                total += rotation[i, j] * rows[row, j]
            result[row, i] = total + shift[i]
        for i in range(turned, columns):
            result[row, i] = rows[row, i] + shift[i]
