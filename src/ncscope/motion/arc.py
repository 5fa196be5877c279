"""Circular paths in the plane of two axes.

Points and centres are pairs (first, second axis of the plane) of programmed values in mm; angles
count from the first axis to the second. Seen against the third axis of the plane, positive angles
turn counter-clockwise, so G03 has a positive sweep and G02 a negative one.
Source: TF5200 programming manual, G02 G03, G164 G165, radius programming.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

Point = tuple[float, float]

SAME_POINT = 1e-6
"""mm; start and end of an arc that are nearer than this are the same point."""
HALF_CIRCLE_SLACK = 1e-3
"""mm; a radius that is so much shorter than half the chord is one of a rounded half circle."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A path in the plane; the radius runs linearly from start to end (they differ with G164 only).

    axes: channel indices of the plane. sweep_rad: turned angle with its sign, more than a full
    turn for a helix of several turns.
    """

    axes: tuple[int, int]
    centre: Point
    start_rad: float
    sweep_rad: float
    start_radius: float
    end_radius: float

    @classmethod
    def through(
        cls,
        axes: tuple[int, int],
        start: Point,
        end: Point,
        centre: Point,
        clockwise: bool,
        turns: int = 0,
    ) -> Arc:
        """The arc about `centre`; a full circle where start and end are the same point.

        turns: full turns beside the arc (helix).
        """
        begin = math.atan2(start[1] - centre[1], start[0] - centre[0])
        finish = math.atan2(end[1] - centre[1], end[0] - centre[0])
        sweep = (begin - finish if clockwise else finish - begin) % math.tau
        if math.dist(start, end) < SAME_POINT or sweep == 0.0:
            sweep = math.tau
        sweep += turns * math.tau
        radii = math.dist(start, centre), math.dist(end, centre)
        return cls(axes, centre, begin, -sweep if clockwise else sweep, *radii)

    @property
    def radius(self) -> float:
        """The larger radius, mm."""
        return max(self.start_radius, self.end_radius)

    @property
    def is_spiral(self) -> bool:
        return abs(self.start_radius - self.end_radius) > SAME_POINT


def fitting_centre(start: Point, end: Point, centre: Point) -> Point:
    """The nearest point to `centre` from which start and end are equally far: its foot on the
    perpendicular bisector. The centre itself where start and end are the same point."""
    length = math.dist(start, end)
    if length < SAME_POINT:
        return centre
    along = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    off = (centre[0] - middle[0]) * along[0] + (centre[1] - middle[1]) * along[1]
    return centre[0] - off * along[0], centre[1] - off * along[1]


def centre_of_radius(start: Point, end: Point, radius: float, clockwise: bool) -> Point | None:
    """The centre of the arc with this radius; None where the points are too far apart.

    A positive radius gives the arc up to half a turn, a negative one the arc beyond.
    """
    half = math.dist(start, end) / 2
    if abs(radius) < half - HALF_CIRCLE_SLACK:
        return None
    height = math.sqrt(max(0.0, radius * radius - half * half))
    left = (start[1] - end[1]) / (2 * half), (end[0] - start[0]) / (2 * half)
    side = height if clockwise == (radius < 0) else -height
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    return middle[0] + side * left[0], middle[1] + side * left[1]
