"""Where axes turn back on arcs: the points between the ends of moves that reach farthest.

Enters: paths under one `Coordinates`. Leaves: axis positions with the path each belongs to.
A software limit is crossed in the middle of a circle as often as at its ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.compilation import compiled
from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError
from ncscope.motion.arcs import Arcs
from ncscope.motion.paths import Paths

EVEN_POINTS = 24
"""Points of an arc under a kinematics, beside those where the tool tip turns back."""
CHUNK = 200_000
"""Points that are computed together: bounds the memory."""
SMALLEST = 1e-9
"""Parts of the radius below which an axis does not take part in an arc."""


@dataclass(frozen=True, slots=True, eq=False)
class TurningPoints:
    """row (k,): the path; acs (k, n): axis positions there, mm and degrees."""

    row: NDArray[np.int64]
    acs: Array


def turning_points(coordinates: Coordinates, paths: Paths, near: Array) -> TurningPoints | None:
    """The points of all arcs where an axis turns back; None without arcs.

    near: (m, n) axis positions at the ends of the paths. Exact without a kinematics on arcs whose
    radius stays; else the points are close to the farthest ones.
    """
    if not len(paths.arcs):
        return None
    n, paths = coordinates.axis_count, paths.under(coordinates)
    slopes = coordinates.to_mcs(np.eye(n)) - coordinates.to_mcs(np.zeros(n))
    place, share = _shares(paths.arcs, slopes[:, :3], _beside(paths) @ slopes[:, :3])
    if coordinates.kinematics is not None:
        even = np.arange(1, EVEN_POINTS) / EVEN_POINTS
        place = np.append(place, np.repeat(np.arange(len(paths.arcs)), len(even)))
        share = np.append(share, np.tile(even, len(paths.arcs)))
    if len(place) == 0:
        return None
    row = paths.arcs.row[place]
    parts = np.array_split(np.arange(len(row)), math.ceil(len(row) / CHUNK))
    try:
        acs = [
            coordinates.to_axes(paths.at(row[part], share[part]), near=near[row[part]])
            for part in parts
        ]
    except KinematicsError:  # the ends can be reached, so the block was accepted
        return None
    return TurningPoints(row, np.concatenate(acs))


def _beside(paths: Paths) -> Array:
    """(k, n) how far the axes outside of its plane go on each arc: straight, as on a helix."""
    arcs = paths.arcs
    way = paths.end[arcs.row] - paths.start[arcs.row]
    way[np.arange(len(arcs))[:, None], arcs.axes] = 0.0
    return way


def _shares(arcs: Arcs, slopes: Array, beside: Array) -> tuple[NDArray[np.int64], Array]:
    """Arcs (k,) and shares (k,) of them, ends left out, at which a main axis turns back.

    slopes: (n, 3) how far the main axes go for one millimetre of each programmed axis. beside:
    (k, 3) how far each arc takes them straight on.
    """
    half_turns = np.ceil(np.abs(arcs.sweep_rad) / math.pi).astype(np.int64) + 3
    room = 3 * int(half_turns.sum())
    place, share = np.empty(room, np.int64), np.empty(room)
    count = _turns_back(
        arcs.axes, arcs.values, arcs.radius, half_turns, slopes, beside, place, share
    )
    return place[:count], share[:count]


@compiled
def _turns_back(axes, values, radius, half_turns, slopes, beside, place, share):
    """Writes `_shares`; how many there are.

    Where an arc takes an axis straight on, as a helix does, it turns back later or earlier than at
    its farthest point of the circle, by the same angle before each half turn and behind the next;
    or never, where it is faster than the circle.
    """
    count = 0
    for i in range(len(axes)):
        begin, sweep = values[i, 2], values[i, 3]
        low = min(begin, begin + sweep)
        for axis in range(3):
            along, across = slopes[axes[i, 0], axis], slopes[axes[i, 1], axis]
            size = math.sqrt(along * along + across * across)
            if size <= SMALLEST:
                continue
            straight = beside[i, axis] / (radius[i] * size * sweep)
            if not abs(straight) <= 1.0:
                continue
            later, farthest = math.asin(straight), math.atan2(across, along)
            first = math.ceil((low - farthest) / math.pi) - 1
            for turn in range(first, first + half_turns[i]):
                angle = farthest + turn * math.pi + (-later if turn % 2 else later)
                part = (angle - begin) / sweep
                if 0.0 < part < 1.0:
                    place[count], share[count] = i, part
                    count += 1
    return count
