"""Circular paths in the plane of two axes.

Points and centres are pairs (first, second axis of the plane) of programmed values in mm; angles
count from the first axis to the second. Seen against the third axis of the plane, positive angles
turn counter-clockwise, so G03 has a positive sweep and G02 a negative one. The compiled functions
take the coordinates of points one by one.
Source: TF5200 programming manual, G02 G03, G164 G165, radius programming.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ncscope.compilation import compiled

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
        cls, axes: tuple[int, int], start: Point, end: Point, centre: Point, clockwise: bool
    ) -> Arc:
        """The arc about `centre`; a full circle where start and end are the same point."""
        return cls(axes, centre, *angles_and_radii(*start, *end, *centre, clockwise))

    @property
    def radius(self) -> float:
        """The larger radius, mm."""
        return max(self.start_radius, self.end_radius)


@compiled
def distance(x0, y0, x1, y1):
    return math.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))


@compiled
def angles_and_radii(x0, y0, x1, y1, cx, cy, clockwise):
    """Start angle and sweep (radians), start and end radius of the arc about a centre."""
    begin = math.atan2(y0 - cy, x0 - cx)
    finish = math.atan2(y1 - cy, x1 - cx)
    sweep = (begin - finish if clockwise else finish - begin) % math.tau
    if distance(x0, y0, x1, y1) < SAME_POINT or sweep == 0.0:
        sweep = math.tau
    first, last = distance(x0, y0, cx, cy), distance(x1, y1, cx, cy)
    return begin, -sweep if clockwise else sweep, first, last


@compiled
def fitting_centre(x0, y0, x1, y1, cx, cy):
    """The nearest point to the centre from which start and end are equally far: its foot on the
    perpendicular bisector. The centre itself where start and end are the same point."""
    length = distance(x0, y0, x1, y1)
    if length < SAME_POINT:
        return cx, cy
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    off = (cx - (x0 + x1) / 2) * ux + (cy - (y0 + y1) / 2) * uy
    return cx - off * ux, cy - off * uy


@compiled
def centre_of_radius(x0, y0, x1, y1, radius, clockwise):
    """Whether there is an arc with this radius, and its centre: none where the points are too far
    apart. A positive radius gives the arc up to half a turn, a negative one the arc beyond."""
    half = distance(x0, y0, x1, y1) / 2
    if abs(radius) < half - HALF_CIRCLE_SLACK:
        return False, 0.0, 0.0
    height = math.sqrt(max(0.0, radius * radius - half * half))
    ux, uy = (y0 - y1) / (2 * half), (x1 - x0) / (2 * half)
    side = height if clockwise == (radius < 0) else -height
    return True, (x0 + x1) / 2 + side * ux, (y0 + y1) / 2 + side * uy
