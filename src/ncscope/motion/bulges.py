"""Where straight moves lead axes beyond their limits between the ends of blocks.

Under a kinematics the tip goes straight and the axes do not: a turn of 180 degrees takes X out and
back although both ends of the block are inside. Enters: paths under one `Coordinates`, and
limits of axes. Leaves: axis positions with the path each belongs to.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError, KinematicStep
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.motion.paths import Paths
from ncscope.motion.turning import CHUNK, TurningPoints

Rows = NDArray[np.int64]

SMALL_TURN = 1.0
"""Degrees in a block below which an axis bulges by less than MARGIN, with levers up to 10 m."""
MARGIN = 1.0
"""mm or degrees from a limit inside which every turn is looked at."""
SLOPE = 0.01
"""The same for a block that is long: part of its length that it may bulge with a small turn."""
STEP = 7.5
"""Degrees between two points of a turn; the farthest are then found between them."""
FEWEST, MOST = 24, 2_000
"""Points of one path."""
HALF_TURN = 180.0
"""Degrees up to which PROBES of a path show at least half of its bulge."""
PROBES = (0.25, 0.5, 0.75)


def bulges(
    coordinates: Coordinates, paths: Paths, start: Array, acs: Array, limits: Array
) -> TurningPoints | None:
    """Points of straight paths where an axis is beyond a limit and farther than at both ends.

    start: (n,) axis positions before the first path. acs: (m, n) at the ends. limits: (n, 2) mm
    and degrees, infinite without one. None where there is nothing to look at.
    """
    active = coordinates.kinematics
    columns = np.flatnonzero(np.isfinite(limits).any(axis=1))
    if active is None or coordinates.point_to_point or len(columns) == 0 or len(acs) == 0:
        return None
    before, paths = np.concatenate([start[None], acs[:-1]]), paths.under(coordinates)
    turn = _turn(active.model, paths, acs - before)
    if active.rapid_straight and paths.rapid is not None:
        turn[paths.rapid] = 0.0
    rows = _candidates(paths, turn, before[:, columns], acs[:, columns], limits[columns])
    if len(rows) == 0:
        return None
    wide = np.isfinite(turn[rows]) & (turn[rows] > HALF_TURN)
    few, many = rows[~wide], rows[wide]
    parts = np.array_split(few, max(1, math.ceil(len(PROBES) * len(few) / CHUNK)))
    kept = [_may_leave(coordinates, paths, part, before, acs, limits) for part in parts]
    rows = np.sort(np.concatenate([many, *kept]))
    found = [
        _beyond(coordinates, paths, part, counts, before, acs, limits)
        for part, counts in _chunks(rows, _counts(turn[rows]))
    ]
    row = np.concatenate([np.empty(0, np.int64), *(r for r, _ in found)])
    return TurningPoints(row, np.concatenate([a for _, a in found])) if len(row) else None


def _turn(model: KinematicStep, paths: Paths, way: Array) -> Array:
    """(m,) degrees that the axes turn in a path; infinite where that says nothing of its shape.

    way: (m, n) from the axis positions at its start to those at its end.
    """
    if not isinstance(model, UniversalKinematics):
        return np.full(len(paths), np.inf)
    rotary = list(model.chain.rotary)
    columns = sorted({*rotary, *model.orientation}) if model.orientation else rotary
    asked = np.abs(paths.end[:, columns] - paths.start[:, columns]).max(axis=1, initial=0.0)
    if not model.orientation:
        return asked
    short = np.abs(way[:, rotary] - 360.0 * np.round(way[:, rotary] / 360.0))
    return np.maximum(asked, short.max(axis=1, initial=0.0))


def _candidates(paths: Paths, turn: Array, before: Array, acs: Array, limits: Array) -> Rows:
    """Paths that may leave the limits between their ends."""
    length = np.linalg.norm(paths.end - paths.start, axis=1)
    margin = (MARGIN + SLOPE * length)[:, None]
    low, high = np.minimum(before, acs) - margin, np.maximum(before, acs) + margin
    near = ((low < limits[:, 0]) | (high > limits[:, 1])).any(axis=1)
    bent = (turn > 0.0) & (length > 0.0)
    bent[paths.arcs.row] = False
    return np.flatnonzero(bent & (near | (turn >= SMALL_TURN)))


def _may_leave(
    coordinates: Coordinates, paths: Paths, rows: Rows, before: Array, acs: Array, limits: Array
) -> Rows:
    """The paths of `rows` that come near a limit if they bulge twice as far as at PROBES."""
    if len(rows) == 0:
        return rows
    row, share = np.repeat(rows, len(PROBES)), np.tile(PROBES, len(rows))
    try:
        points = coordinates.to_axes(paths.at(row, share), near=acs[row])
    except KinematicsError:  # the ends can be reached, so the blocks were accepted
        return rows[:0]
    chord = before[row] + share[:, None] * (acs[row] - before[row])
    bulge = np.abs(points - chord).reshape(len(rows), len(PROBES), -1).max(axis=1, initial=0.0)
    low = np.minimum(before[rows], acs[rows]) - 2.0 * bulge
    high = np.maximum(before[rows], acs[rows]) + 2.0 * bulge
    return rows[((low < limits[:, 0]) | (high > limits[:, 1])).any(axis=1)]


def _counts(turn: Array) -> Rows:
    """Points of each path between its ends."""
    wanted = np.where(np.isfinite(turn), turn, 0.0) / STEP
    return np.clip(np.ceil(wanted), FEWEST, MOST).astype(np.int64)


def _chunks(rows: Rows, counts: Rows) -> list[tuple[Rows, Rows]]:
    parts = max(1, math.ceil(int(counts.sum()) / CHUNK))
    return list(zip(np.array_split(rows, parts), np.array_split(counts, parts), strict=True))


def _beyond(
    coordinates: Coordinates,
    paths: Paths,
    rows: Rows,
    counts: Rows,
    before: Array,
    acs: Array,
    limits: Array,
) -> tuple[Rows, Array]:
    """Paths (k,) and axis positions (k, n) of the farthest points beyond a limit."""
    nothing = np.empty(0, np.int64), np.empty((0, acs.shape[1]))
    if len(rows) == 0:
        return nothing
    first = np.cumsum(counts) - counts
    row = np.repeat(rows, counts)
    share = (np.arange(len(row)) - np.repeat(first, counts) + 1) / np.repeat(counts + 1, counts)
    try:
        points = coordinates.to_axes(paths.at(row, share), near=acs[row])
        tops = _tops(points, first, counts, before[rows], acs[rows], limits)
        if not tops:
            return nothing
        place, shift = (np.array(c) for c in zip(*tops, strict=True))
        top_row = row[place]
        top_share = share[place] + shift / (np.repeat(counts + 1, counts)[place])
        farthest = coordinates.to_axes(paths.at(top_row, top_share), near=acs[top_row])
    except KinematicsError:  # the ends can be reached, so the blocks were accepted
        return nothing
    return np.append(top_row, row[place]), np.concatenate([farthest, points[place]])


def _tops(
    points: Array, first: Rows, counts: Rows, before: Array, acs: Array, limits: Array
) -> list[tuple[int, float]]:
    """The place of the point of each path and axis that goes farthest beyond a limit, and how many
    steps from there a parabola through it and its neighbours turns back."""
    tops = []
    for column in np.flatnonzero(np.isfinite(limits).any(axis=1)):
        for sign, limit in ((-1.0, limits[column, 0]), (1.0, limits[column, 1])):
            values, ends = (
                sign * points[:, column],
                (sign * before[:, column], sign * acs[:, column]),
            )
            most = np.maximum.reduceat(values, first)
            near = most + np.abs(most - np.maximum(*ends)) * 0.1
            for path in np.flatnonzero((near > sign * limit) & (most > np.maximum(*ends))):
                inside = slice(first[path], first[path] + counts[path])
                own = np.concatenate(
                    [ends[0][path : path + 1], values[inside], ends[1][path : path + 1]]
                )
                at = 1 + int(own[1:-1].argmax())
                a, b, c = own[at - 1 : at + 2]
                bend = a - 2.0 * b + c
                shift = 0.5 * (a - c) / bend if bend < 0.0 else 0.0
                tops.append((int(first[path]) + at - 1, float(np.clip(shift, -1.0, 1.0))))
    return tops
