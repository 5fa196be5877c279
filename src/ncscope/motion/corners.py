"""Chamfers and roundings: an inserted move between two moves that meet at a corner.

Enters: the two moves and what stands between them. Leaves: the first move up to the insertion, the
insertion, and the second move from there on. All in programmed values: a corner is one of the
programmed contour.
Source: TF5200 programming manual, G301 G302, #CHR #CHF #RND #FRC.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Span
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError
from ncscope.motion import Move
from ncscope.motion.arc import Arc, Point
from ncscope.motion.arcs import Arcs
from ncscope.motion.paths import Paths

CORNERED = {"G00", "G01", "G02", "G03"}
STRAIGHT = 1e-9
"""Sine of the angle between two moves that pass into each other without a corner."""
_SLACK = 1e-9
"""Share of a move by which an insertion may begin before it: rounding."""


@dataclass(frozen=True, slots=True)
class Corner:
    """What is inserted before the next move.

    size: mm; the radius of a rounding, else the distance from the corner on each side (a chord on
    arcs), or with `width` the length of the inserted line. plane: channel indices of its first,
    second and third axis. feed: mm per minute, None where none was programmed. span: the word.
    """

    rounding: bool
    size: float
    width: bool
    plane: tuple[int, int, int]
    feed: float | None
    block: int | None
    span: Span


class CornerError(Exception):
    """A chamfer or rounding that does not fit: id, message and hint of its diagnostic."""

    def __init__(self, id: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.id, self.message, self.hint = id, message, hint


def join(first: Move, second: Move, corner: Corner, chain: Coordinates) -> tuple[Move, ...]:
    """The moves that take the place of `first` and `second`, with the insertion between them.

    Two moves that pass into each other without a corner stay as they are.
    Raises CornerError where the insertion does not fit.
    """
    if not {first.motion, second.motion} <= CORNERED:
        what = "a chamfer or rounding stands between motions with G00, G01, G02 or G03 only"
        raise CornerError("N2032", what)
    if first.way is not None or second.way is not None:
        what = "a chamfer or rounding at a turn over the end of a modulo axis is not supported"
        raise CornerError("N2001", what)
    if corner.rounding:
        found = _rounding(first, second, corner, chain)
        if found is None:
            return first, second
        out, back, centre, clockwise = found
    else:
        _refuse_reversal(first, second)
        out, back = _chamfer(first, second, corner)
        centre, clockwise = None, False
    begin, end = _at(first, out), _at(second, back)
    arc = None
    if centre is not None:
        i, j, _ = corner.plane
        start, stop = (float(begin[i]), float(begin[j])), (float(end[i]), float(end[j]))
        arc = Arc.through((i, j), start, stop, centre, clockwise)
    motion = "G00" if second.motion == "G00" else "G01"
    if arc is not None:
        motion = "G02" if clockwise else "G03"
    try:
        positions = [chain.to_axes(point, near=first.axes) for point in (begin, end)]
    except KinematicsError as error:
        raise CornerError(error.id, error.message, error.hint) from error
    feed = corner.feed
    inserted = Move(
        motion, feed, begin, end, positions[1], corner.block, corner.span, None, arc
    )  # fmt: skip
    return (
        replace(first, program=begin, axes=positions[0], arc=_cut(first.arc, 0.0, out)),
        inserted,
        replace(second, start=end, arc=_cut(second.arc, back, 1.0)),
    )


# --- chamfer -----------------------------------------------------------------------------------


def _chamfer(first: Move, second: Move, corner: Corner) -> tuple[float, float]:
    """Shares of both moves at which the chamfer begins and ends."""
    longest = min(_reach(first, at_end=True), _reach(second, at_end=False))
    distance = corner.size
    if corner.width:
        distance = _distance_of_width(first, second, corner.size, longest)
    if distance > longest * (1 + _SLACK):
        raise _too_large(f"the chamfer needs {distance:.4f} mm of both motions", longest)
    return 1.0 - _share(first, distance, at_end=True), _share(second, distance, at_end=False)


def _refuse_reversal(first: Move, second: Move) -> None:
    """Fails where a straight move runs back over a straight one: there is no corner to cut."""
    if first.arc is not None or second.arc is not None:
        return
    before, behind = (first.program - first.start)[:3], (second.program - second.start)[:3]
    lengths = float(np.linalg.norm(before)), float(np.linalg.norm(behind))
    if min(lengths) > 0.0:
        apart = before / lengths[0] + behind / lengths[1]
        if float(np.linalg.norm(apart)) < STRAIGHT:
            raise CornerError("N2033", "the second motion runs back over the first", _NO_ROOM)


def _distance_of_width(first: Move, second: Move, width: float, longest: float) -> float:
    """The distance from the corner at which the inserted line has this length, by halving."""

    def length(distance: float) -> float:
        begin = _at(first, 1.0 - _share(first, distance, at_end=True))
        end = _at(second, _share(second, distance, at_end=False))
        return float(np.linalg.norm((end - begin)[:3]))

    if length(longest) < width * (1 - _SLACK):
        raise _too_large(f"a chamfer {width:.4f} mm wide does not fit", longest)
    low, high = 0.0, longest
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if length(middle) < width else (low, middle)
    return high


def _reach(move: Move, at_end: bool) -> float:
    """The largest distance from the corner to a point of the move, along it; a chord on arcs."""
    if move.arc is None:
        return float(np.linalg.norm((move.program - move.start)[:3]))
    radius = move.arc.end_radius if at_end else move.arc.start_radius
    return 2 * radius * math.sin(min(abs(move.arc.sweep_rad), math.pi) / 2)


def _share(move: Move, distance: float, at_end: bool) -> float:
    """The share of the move that lies between the corner and a point at this distance."""
    reach = _reach(move, at_end)
    if reach == 0.0:
        return 0.0
    if move.arc is None:
        return min(1.0, distance / reach)
    radius = move.arc.end_radius if at_end else move.arc.start_radius
    angle = 2 * math.asin(min(1.0, distance / (2 * radius)))
    return min(1.0, angle / abs(move.arc.sweep_rad))


# --- rounding ----------------------------------------------------------------------------------


def _rounding(
    first: Move, second: Move, corner: Corner, chain: Coordinates
) -> tuple[float, float, Point, bool] | None:
    """Shares of both moves at the tangent points, the centre, and whether it turns clockwise;
    None where the moves have no corner."""
    i, j, third = corner.plane
    for move in (first, second):
        if third < len(move.program) and move.program[third] != move.start[third]:
            what = "a rounding between motions that leave the plane is not supported"
            raise CornerError("N2001", what)
    factors = chain.contour.factors(len(first.program))
    if factors[i] != factors[j]:
        what = "a rounding needs the same scale factor (#SCALE) for both axes of its plane"
        raise CornerError("N2020", what)
    sides = _Side.before(first, i, j), _Side.behind(second, i, j)
    (ux, uy), (vx, vy) = sides[0].tangent, sides[1].tangent
    turn, along = ux * vy - uy * vx, ux * vx + uy * vy
    if abs(turn) < STRAIGHT:
        if along > 0:
            return None
        raise CornerError("N2033", "the second motion runs back over the first", _NO_ROOM)
    left = 1.0 if turn > 0 else -1.0
    at = sides[0].corner
    centres = _meet(sides[0].beside(left * corner.size), sides[1].beside(left * corner.size))
    for centre in sorted(centres, key=lambda point: math.dist(point, at)):
        out, back = sides[0].back_to(centre), sides[1].back_to(centre)
        if 0 <= out <= 1 + _SLACK and 0 <= back <= 1 + _SLACK:
            return max(0.0, 1 - out), min(1.0, back), centre, left < 0
    what = f"a rounding with radius {corner.size:.4f} mm does not fit between the motions"
    raise CornerError("N2033", what, _NO_ROOM)


_NO_ROOM = "one of the motions would have to run backwards; make the insertion smaller"


def _too_large(what: str, longest: float) -> CornerError:
    return CornerError("N2033", f"{what}; the shorter one has {longest:.4f} mm", _NO_ROOM)


@dataclass(frozen=True, slots=True)
class _Side:
    """A move in the plane, seen from the corner: the corner, the tangent there in the sense of
    motion, the length of a line, or the circle with the signed sweep of an arc."""

    corner: Point
    tangent: Point
    is_first: bool
    length: float
    circle: tuple[Point, float] | None
    sweep_rad: float

    @classmethod
    def before(cls, move: Move, i: int, j: int) -> _Side:
        return cls._of(move, i, j, True)

    @classmethod
    def behind(cls, move: Move, i: int, j: int) -> _Side:
        return cls._of(move, i, j, False)

    @classmethod
    def _of(cls, move: Move, i: int, j: int, is_first: bool) -> _Side:
        point = move.program if is_first else move.start
        corner = float(point[i]), float(point[j])
        arc = move.arc
        if arc is None:
            way = float(move.program[i] - move.start[i]), float(move.program[j] - move.start[j])
            length = math.hypot(*way)
            if length == 0.0:
                raise CornerError("N2033", "one of the motions does not move in the plane")
            return cls(corner, (way[0] / length, way[1] / length), is_first, length, None, 0.0)
        if arc.axes != (i, j):
            raise CornerError("N2001", "a rounding at an arc of another plane is not supported")
        radius = arc.end_radius if is_first else arc.start_radius
        angle = arc.start_rad + (arc.sweep_rad if is_first else 0.0)
        sense = math.copysign(1.0, arc.sweep_rad)
        tangent = -sense * math.sin(angle), sense * math.cos(angle)
        return cls(corner, tangent, is_first, 0.0, (arc.centre, radius), arc.sweep_rad)

    def beside(self, distance: float) -> tuple[Point, Point | float]:
        """The same path moved to its left: a point and direction, or a centre and radius."""
        if self.circle is None:
            x, y = self.corner
            return (x - distance * self.tangent[1], y + distance * self.tangent[0]), self.tangent
        centre, radius = self.circle
        return centre, radius - math.copysign(distance, self.sweep_rad * distance)

    def back_to(self, centre: Point) -> float:
        """The share of the move between the corner and where a circle about `centre` touches."""
        if self.circle is None:
            way = centre[0] - self.corner[0], centre[1] - self.corner[1]
            along = way[0] * self.tangent[0] + way[1] * self.tangent[1]
            return (-along if self.is_first else along) / self.length
        own, _ = self.circle
        touch = math.atan2(centre[1] - own[1], centre[0] - own[0])
        here = math.atan2(self.corner[1] - own[1], self.corner[0] - own[0])
        turned = here - touch if self.is_first else touch - here
        turned = math.copysign(1.0, self.sweep_rad) * turned % math.tau
        return (0.0 if math.tau - turned < _SLACK else turned) / abs(self.sweep_rad)


Beside = tuple[Point, Point | float]


def _meet(first: Beside, second: Beside) -> list[Point]:
    """Where two lines or circles meet."""
    (p, u), (q, v) = first, second
    if isinstance(u, float):
        return _meet_circles(p, u, q, v) if isinstance(v, float) else _meet_line(q, v, p, u)
    if isinstance(v, float):
        return _meet_line(p, u, q, v)
    across = u[0] * v[1] - u[1] * v[0]
    along = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / across
    return [(p[0] + along * u[0], p[1] + along * u[1])]


def _meet_line(point: Point, way: Point, centre: Point, radius: float) -> list[Point]:
    if radius <= 0.0:
        return []
    to = centre[0] - point[0], centre[1] - point[1]
    along, beside = to[0] * way[0] + to[1] * way[1], to[0] * way[1] - to[1] * way[0]
    square = radius * radius - beside * beside
    if square < 0.0:
        return []
    half = math.sqrt(square)
    return [(point[0] + d * way[0], point[1] + d * way[1]) for d in (along - half, along + half)]


def _meet_circles(first: Point, r: float, second: Point, s: float) -> list[Point]:
    distance = math.dist(first, second)
    if r <= 0.0 or s <= 0.0 or distance == 0.0:
        return []
    along = (r * r - s * s + distance * distance) / (2 * distance)
    square = r * r - along * along
    if square < 0.0:
        return []
    half = math.sqrt(square)
    way = (second[0] - first[0]) / distance, (second[1] - first[1]) / distance
    x, y = first[0] + along * way[0], first[1] + along * way[1]
    return [(x - h * way[1], y + h * way[0]) for h in (half, -half)]


# --- parts of moves ----------------------------------------------------------------------------


def _at(move: Move, share: float) -> Array:
    """Programmed values (n,) at a share of the move."""
    arcs = {} if move.arc is None else {0: move.arc}
    paths = Paths(move.start[None], move.program[None], Arcs.of(arcs))
    point = paths.at(np.zeros(1, dtype=np.int64), np.array([share]))[0]
    return np.array(move.start, dtype=float) if share == 0.0 else point


def _cut(arc: Arc | None, begin: float, end: float) -> Arc | None:
    """The part of an arc between two shares."""
    if arc is None:
        return None
    widening = arc.end_radius - arc.start_radius
    return replace(
        arc,
        start_rad=arc.start_rad + begin * arc.sweep_rad,
        sweep_rad=(end - begin) * arc.sweep_rad,
        start_radius=arc.start_radius + begin * widening,
        end_radius=arc.start_radius + end * widening,
    )
