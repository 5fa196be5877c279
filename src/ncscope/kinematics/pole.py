"""How near a machine with two rotary axes is to its singular tool direction.

Enters: axis values (m, n), degrees in the rotary columns. Leaves: angles in degrees.
The tool is singular where it lies along the rotary axis nearest to the workpiece, in either sense:
that axis then turns without changing the tool direction, and a small change of the direction
beside it needs a large turn. Source: FCT-C27 section 7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.compilation import compiled
from ncscope.kinematics.kernels import sincos_deg
from ncscope.kinematics.orientation import OrientationSolver
from ncscope.kinematics.universal import UniversalKinematics

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

_SMALLEST_NORMAL = 1e-12
_ROUNDING_DEG = 1e-4
_DEG_PER_RAD = 180.0 / math.pi


@dataclass(frozen=True, slots=True, eq=False)
class Pole:
    """The singular direction of one machine.

    first, second: channel columns of the two rotary axes, the one nearest to the workpiece first.
    axis (3,): unit direction of the first one. between, lean: its angle to the second axis, and
    the angle of that to the tool, radians inside. turning_point: position of the second axis in
    degrees where the tool is closest to the first one.
    """

    model: UniversalKinematics
    first: int
    second: int
    axis: Array
    between_rad: float
    lean_rad: float
    turning_point: float

    @classmethod
    def of(cls, model: UniversalKinematics) -> Pole | None:
        """The pole of a kinematics; None when it does not have two rotary axes that tilt."""
        rotary = model.chain.rotary
        if len(rotary) != 2:
            return None
        directions = model.chain.directions[list(rotary)]
        solver = OrientationSolver.from_axes(directions, model.chain.zero_orientation)
        if solver.free:
            return None
        between, lean = solver.between_rad, solver.lean_rad
        return cls(model, *rotary, directions[0], between, lean, solver.turning_point)

    def distance(self, second: Array) -> Array:
        """Angle (...) between the tool and the first axis, 0 to 90 degrees, either sense.

        second: (...) positions of the second rotary axis, degrees. Good to 1e-6 degrees at the
        pole itself, where the cosine has lost half of its digits.
        """
        middle, sway = self._cosine
        cosine = middle + sway * np.cos(np.deg2rad(second - self.turning_point))
        return np.rad2deg(np.arccos(np.minimum(np.abs(cosine), 1.0)))

    def turning(
        self, start: Array, axes: Array, turn: float, near: float, ratio: float
    ) -> tuple[Rows, int]:
        """The moves (k,) that turn the first axis by `turn` degrees or more, or begin or end
        nearer than `near` degrees to the singular direction and may turn it `ratio` times more
        than they turn the tool.

        start: (n,) axis values before the first move. axes: (m, n) at the end of each. Where the
        tool turns at least as far as it comes nearer to the axis, only that is compared.
        The second result is the move whose end is nearest to the singular direction.
        """
        middle, sway = self._cosine
        found = np.zeros(len(axes), np.bool_)
        nearest = _turning(
            np.require(start, requirements=["C", "W"]),
            np.require(axes, requirements=["C", "W"]),
            (self.first, self.second),
            (self.turning_point, middle, sway, turn, math.cos(math.radians(near)), ratio),
            not self.model.rtcp,
            found,
        )
        return np.flatnonzero(found), int(nearest)

    @property
    def _cosine(self) -> tuple[float, float]:
        """The cosine of the angle between tool and first axis is the first of these, and the
        second times the cosine of the second axis beyond its turning point."""
        return (
            math.cos(self.between_rad) * math.cos(self.lean_rad),
            math.sin(self.between_rad) * math.sin(self.lean_rad),
        )

    def closest(self, start: Array, end: Array) -> Array:
        """Smallest distance (m,) on the way between axis values start and end, each (m, n).

        With RTCP the rotary axes move linearly. With the complete transformation the tool
        direction takes the shortest way.
        """
        a, b = start[:, self.second], end[:, self.second]
        near = np.minimum(self.distance(a), self.distance(b))
        if not self.model.rtcp:
            return np.minimum(near, self._closest_on_arc(start, end))
        for turning in (self.turning_point, self.turning_point + 180.0):
            passed = np.floor((a - turning) / 360.0) != np.floor((b - turning) / 360.0)
            there = self.distance(np.array(turning))
            near = np.where(passed, np.minimum(near, there), near)
        return near

    def tilt(self, start: Array, end: Array) -> Array:
        """Angle (m,) in degrees between the tool directions at axis values (m, n)."""
        a, b = self.model.forward(start)[1], self.model.forward(end)[1]
        sine = np.linalg.norm(np.cross(a, b), axis=1)
        return np.rad2deg(np.arctan2(sine, np.einsum("ij,ij->i", a, b)))

    def _closest_on_arc(self, start: Array, end: Array) -> Array:
        a, b = self.model.forward(start)[1], self.model.forward(end)[1]
        normal = np.cross(a, b)
        length = np.linalg.norm(normal, axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            height = (normal @ self.axis) / length
            foot = self.axis - (height / length)[:, None] * normal
        inside = np.zeros(len(a), dtype=bool)
        for sense in (1.0, -1.0):
            behind = np.einsum("ij,ij->i", np.cross(a, sense * foot), normal) >= 0
            before = np.einsum("ij,ij->i", np.cross(sense * foot, b), normal) >= 0
            inside |= behind & before
        inside &= length > _SMALLEST_NORMAL
        return np.where(inside, np.rad2deg(np.arcsin(np.minimum(np.abs(height), 1.0))), np.inf)


@compiled
def _turning(start, axes, columns, bounds, short_way, found):
    """Marks the moves of `Pole.turning`, and gives the one that ends nearest to the pole;
    short_way: a turn is never more than 180 degrees."""
    first, second = columns
    turning_point, middle, sway, far, near, ratio = bounds
    before, nearest, largest = start[first], 0, -1.0
    cosine_before = middle + sway * sincos_deg(start[second] - turning_point)[1]
    for row in range(axes.shape[0]):
        turn = axes[row, first] - before
        if short_way:
            turn -= 360.0 * np.rint(turn / 360.0)
        turn = abs(turn)
        cosine = middle + sway * sincos_deg(axes[row, second] - turning_point)[1]
        found[row] = turn >= far
        if turn > 0.0 and turn < far and max(abs(cosine), abs(cosine_before)) > near:
            nearer = _angle(cosine) - _angle(cosine_before)
            found[row] = turn + _ROUNDING_DEG >= ratio * abs(nearer)
        if abs(cosine) > largest:
            nearest, largest = row, abs(cosine)
        before, cosine_before = axes[row, first], cosine
    return nearest


@compiled
def _angle(cosine):
    """Degrees; good to 1e-6 where the cosine is 1."""
    return math.acos(min(max(cosine, -1.0), 1.0)) * _DEG_PER_RAD
