"""Points along many paths at once, so close that straight lines between them stay in a tolerance.

Enters: paths under one `Coordinates`. Leaves: rows with the path each belongs to, ordered along
the paths. The chord error is the largest of three: between the tool tip and a straight line
between points in the machine system, between each axis and the straight line between its values,
and between the tool tip and where the tool would be if the axes ran on those straight lines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.universal import KinematicsError
from ncscope.motion.arcs import NO_ARCS, Arcs
from ncscope.motion.paths import Paths

FINEST = 1e-4
"""mm and degrees; the smallest tolerance: the resolution of the control."""
MOST_POINTS = 100_000
"""Points of one arc; an arc that needs more is sampled coarser, and reported."""
DEEPEST = 16
"""Halvings of a motion; what still deviates then jumps, as an axis does near a pole."""
_PROBES = np.array([0.25, 0.5, 0.75])


@dataclass(frozen=True)
class Points:
    """row: (k,) the path of each point. share: (k,) 1 at the end of a path. pcs, acs: (k, n).
    coarse: paths whose chord error could not be brought below the tolerance."""

    row: NDArray[np.int64]
    share: Array
    pcs: Array
    acs: Array
    coarse: tuple[int, ...]


def needs_points(coordinates: Coordinates, paths: Paths) -> bool:
    """Whether a straight line between the ends of some path is not the path itself."""
    return len(paths.arcs) > 0 or _bent(coordinates)


def _bent(coordinates: Coordinates) -> bool:
    """Whether straight lines of the program are none of the axes."""
    steps = coordinates.kinematics, coordinates.program_step, coordinates.length_step
    return any(step is not None for step in steps)


def sample(
    coordinates: Coordinates, paths: Paths, acs: Array, near: Array, tolerance: float
) -> Points:
    """Points along the paths with a chord error below `tolerance` (mm and degrees).

    acs: (m, n) axis positions at the ends; near: (n,) before the first path.
    Raises ValueError for a tolerance below FINEST.
    """
    if not tolerance >= FINEST:
        raise ValueError(f"the tolerance has to be {FINEST:g} or more")
    before = np.concatenate([near[None], acs[:-1]])
    paths = paths.under(coordinates)
    active, rapid = coordinates.kinematics, paths.rapid
    if active is None or not active.rapid_straight or rapid is None or not rapid.any():
        return _sample(coordinates, paths, acs, before, tolerance)
    straight = replace(coordinates, kinematics=replace(active, point_to_point=True))
    parts = []
    for chain, rows in ((coordinates, ~rapid), (straight, rapid)):
        own = np.flatnonzero(rows)
        if len(own):
            points = _sample(chain, paths.part(own), acs[own], before[own], tolerance)
            coarse = tuple(int(own[i]) for i in points.coarse)
            parts.append(replace(points, row=own[points.row], coarse=coarse))
    return _merged(parts)


def _merged(parts: list[Points]) -> Points:
    """The points of disjoint paths, in the order of the paths."""
    row = np.concatenate([p.row for p in parts])
    order = np.lexsort((np.concatenate([p.share for p in parts]), row))
    share, pcs, acs = (
        np.concatenate([getattr(p, name) for p in parts])[order] for name in ("share", "pcs", "acs")
    )
    return Points(row[order], share, pcs, acs, tuple(sorted(i for p in parts for i in p.coarse)))


def _sample(
    coordinates: Coordinates, paths: Paths, acs: Array, before: Array, tolerance: float
) -> Points:
    """As `sample`, with the axis positions (m, n) before each path."""
    written = paths
    if coordinates.point_to_point:
        paths = _axis_paths(coordinates, paths, before, acs)
    row, share, coarse = _breaks(coordinates, paths, tolerance)
    start = np.concatenate([[0.0], share[:-1]]) * (share > np.roll(share, 1))
    open_, done = _Segments.between(coordinates, paths, row, start, share, before), []
    curved = _bent(coordinates) or paths.arcs.any_spiral
    for depth in range(DEEPEST if curved else 0):
        bad, broken = _deviating(coordinates, paths, open_, tolerance)
        coarse |= set(open_.row[broken].tolist())
        done.append(open_.part(~bad))
        open_ = open_.part(bad)
        if not len(open_):
            break
        if depth == DEEPEST - 1:
            coarse |= set(open_.row.tolist())
        else:
            open_ = open_.halved(coordinates, paths)
    points = _ordered([*done, open_], acs, tuple(sorted(coarse)))
    if coordinates.point_to_point:
        return _read_back(coordinates, written, points)
    return replace(points, pcs=coordinates.shown(points.pcs))


def _axis_paths(coordinates: Coordinates, paths: Paths, before: Array, acs: Array) -> Paths:
    """Straight ways (m) of the axes under #PTP, as paths in axis positions.

    A modulo axis goes as far as it is programmed, an angle that the kinematics computes the short
    way if its axis is a modulo axis.
    """
    active = coordinates.kinematics
    asked = paths.end - paths.start
    if active is not None:
        asked[:, list(active.model.orientation)] = 0.0
    way = acs - before
    way -= coordinates.modulo.whole_turns(way - asked)
    return Paths(before, before + way, NO_ARCS)


def _read_back(coordinates: Coordinates, paths: Paths, points: Points) -> Points:
    """Points of axis paths with the programmed values that belong to them."""
    acs = coordinates.modulo.wrap(points.acs)
    ends = points.share == 1.0
    acs[ends] = points.acs[ends]
    pcs = paths.at(points.row, points.share)
    try:
        pcs[~ends] = coordinates.to_program(acs[~ends], near=pcs[~ends])
    except KinematicsError:  # no words lead to some position on the way: the ends alone are sure
        coarse = tuple(sorted({*points.coarse, *points.row[~ends].tolist()}))
        pcs, acs, row = pcs[ends], acs[ends], points.row[ends]
        points = Points(row, points.share[ends], pcs, acs, coarse)
    return replace(points, pcs=coordinates.shown(pcs), acs=acs)


@dataclass(frozen=True)
class _Segments:
    """k pieces of paths between two shares, with the values at both."""

    row: NDArray[np.int64]
    start: Array
    stop: Array
    pcs: tuple[Array, Array]
    acs: tuple[Array, Array]

    def __len__(self) -> int:
        return len(self.row)

    @classmethod
    def between(
        cls,
        coordinates: Coordinates,
        paths: Paths,
        row: NDArray[np.int64],
        start: Array,
        stop: Array,
        near: Array,
    ) -> _Segments:
        """The pieces from `start` to `stop` of each row; near: (m, n) axes before each path."""
        pcs = paths.at(row, start), paths.at(row, stop)
        after = _axes(coordinates, pcs[1], near[row])
        before = np.where((start == 0.0)[:, None], near[row], np.roll(after, 1, axis=0))
        return cls(row, start, stop, pcs, (before, after))

    def part(self, wanted: NDArray[np.bool_]) -> _Segments:
        pcs = self.pcs[0][wanted], self.pcs[1][wanted]
        acs = self.acs[0][wanted], self.acs[1][wanted]
        return _Segments(self.row[wanted], self.start[wanted], self.stop[wanted], pcs, acs)

    def halved(self, coordinates: Coordinates, paths: Paths) -> _Segments:
        middle = (self.start + self.stop) / 2
        pcs = paths.at(self.row, middle)
        acs = _axes(coordinates, pcs, self.acs[0])
        return _Segments(
            np.concatenate([self.row, self.row]),
            np.concatenate([self.start, middle]),
            np.concatenate([middle, self.stop]),
            (np.concatenate([self.pcs[0], pcs]), np.concatenate([pcs, self.pcs[1]])),
            (np.concatenate([self.acs[0], acs]), np.concatenate([acs, self.acs[1]])),
        )


def _breaks(
    coordinates: Coordinates, paths: Paths, tolerance: float
) -> tuple[NDArray[np.int64], Array, set[int]]:
    """The first points: the ends of straight paths, equal angles on arcs."""
    counts, arcs = np.ones(len(paths), dtype=np.int64), paths.arcs
    scale = coordinates.contour.factors(coordinates.axis_count)[arcs.axes[:, 0]]
    wanted = _arc_points(arcs, scale * arcs.radius, tolerance)
    coarse = set(arcs.row[wanted > MOST_POINTS].tolist())
    counts[arcs.row] = np.minimum(wanted, MOST_POINTS)
    row = np.repeat(np.arange(len(paths)), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    share = (np.arange(len(row)) - first + 1) / counts[row]
    return row, share, coarse


def _arc_points(arcs: Arcs, radius: Array, tolerance: float) -> Array:
    """Segments of arcs whose sagitta is below the tolerance; at least four a full turn."""
    flat = np.maximum(-1.0, 1.0 - tolerance / radius)
    step = np.minimum(math.pi / 2 * (1 + 1e-9), 2 * np.arccos(flat) * (1 - 1e-6))
    return np.maximum(1, np.ceil(np.abs(arcs.sweep_rad) / np.maximum(step, 1e-9)))


def _deviating(
    coordinates: Coordinates, paths: Paths, pieces: _Segments, tolerance: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which pieces deviate too much between their ends, and which cannot be followed there."""
    error = np.zeros(len(pieces))
    tips = _tips(coordinates, pieces.acs[0]), _tips(coordinates, pieces.acs[1])
    turned = _whole_turns(coordinates, pieces.acs[1] - pieces.acs[0])
    for share in _PROBES:
        at = pieces.start + share * (pieces.stop - pieces.start)
        acs = _axes(coordinates, paths.at(pieces.row, at), pieces.acs[0])
        chord = pieces.acs[0] + share * (pieces.acs[1] - turned - pieces.acs[0])
        apart = acs - chord
        apart -= _whole_turns(coordinates, apart)
        tip = _tips(coordinates, acs)
        line = tips[0] + share * (tips[1] - tips[0])
        for other in (line, _tips(coordinates, chord)):
            error = np.maximum(error, np.sqrt(((tip - other) ** 2).sum(axis=1)))
        error = np.maximum(error, np.abs(apart).max(axis=1))
    broken = ~np.isfinite(error)
    return (error > tolerance) & ~broken, broken


def _tips(coordinates: Coordinates, acs: Array) -> Array:
    """Tool tip (k, 3) in the workpiece of the kinematics; the main axes without a kinematics."""
    active = coordinates.kinematics
    if active is None:
        return acs[:, :3]
    return active.model.forward(acs, tool_length=coordinates.tool.length)[0]


def _whole_turns(coordinates: Coordinates, difference: Array) -> Array:
    """Full turns in a difference of axis values: of modulo axes, and of angles that the
    kinematics computes, which are only defined up to full turns."""
    result = coordinates.modulo.whole_turns(difference)
    active = coordinates.kinematics
    if active is not None and active.model.orientation:
        result[:, 3:] = 360.0 * np.round(difference[:, 3:] / 360.0)
    return result


def _axes(coordinates: Coordinates, pcs: Array, near: Array) -> Array:
    """Axis positions (k, n), each near its own row; NaN where the machine cannot get."""
    if coordinates.point_to_point:
        return pcs  # paths of axis positions, see `_axis_paths`
    try:
        return coordinates.to_axes(pcs, near=near)
    except KinematicsError as error:
        good = np.ones(len(pcs), dtype=bool)
        good[list(error.rows)] = False
    result = np.full(pcs.shape, np.nan)
    if good.any():
        result[good] = coordinates.to_axes(pcs[good], near=near[good])
    return result


def _ordered(parts: list[_Segments], acs: Array, coarse: tuple[int, ...]) -> Points:
    """The ends of all pieces along the paths, without those that have no axis position."""
    row = np.concatenate([p.row for p in parts])
    share = np.concatenate([p.stop for p in parts])
    pcs = np.concatenate([p.pcs[1] for p in parts])
    positions = np.concatenate([p.acs[1] for p in parts])
    ends = share == 1.0
    positions[ends] = acs[row[ends]]
    order = np.lexsort((share, row))
    order = order[np.isfinite(positions[order]).all(axis=1)]
    return Points(row[order], share[order], pcs[order], positions[order], coarse)
