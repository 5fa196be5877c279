"""Where axes turn back on arcs: the points between the ends of moves that reach farthest.

Enters: paths under one `Coordinates`. Leaves: axis positions with the path each belongs to.
A software limit is crossed in the middle of a circle as often as at its ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError
from ncscope.motion.arc import Arc
from ncscope.motion.paths import Paths

EVEN_POINTS = 24
"""Points of an arc under a kinematics, beside those where the tool tip turns back."""
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
    if not paths.arcs:
        return None
    n, paths = coordinates.axis_count, paths.under(coordinates)
    slopes = coordinates.to_mcs(np.eye(n)) - coordinates.to_mcs(np.zeros(n))
    place, share = _shares(list(paths.arcs.values()), slopes[:, :3])
    if coordinates.kinematics is not None:
        even = np.arange(1, EVEN_POINTS) / EVEN_POINTS
        place = np.append(place, np.repeat(np.arange(len(paths.arcs)), len(even)))
        share = np.append(share, np.tile(even, len(paths.arcs)))
    if len(place) == 0:
        return None
    row = np.array(list(paths.arcs), dtype=np.int64)[place]
    try:
        return TurningPoints(row, coordinates.to_axes(paths.at(row, share), near=near[row]))
    except KinematicsError:  # the ends can be reached, so the block was accepted
        return None


def _shares(arcs: list[Arc], slopes: Array) -> tuple[NDArray[np.int64], Array]:
    """Arcs (k,) and shares (k,) of them, ends left out, at which a main axis turns back.

    slopes: (n, 3) how far the main axes go for one millimetre of each programmed axis.
    """
    begin, sweep = np.array([(arc.start_rad, arc.sweep_rad) for arc in arcs]).T
    plane = np.array([arc.axes for arc in arcs])
    low = np.minimum(begin, begin + sweep)
    most = math.ceil(float(np.abs(sweep).max()) / math.pi) + 1
    places, shares = [], []
    for along, across in zip(slopes[plane[:, 0]].T, slopes[plane[:, 1]].T, strict=True):
        farthest = np.arctan2(across, along)
        first = farthest + np.ceil((low - farthest) / math.pi) * math.pi
        share = (first[:, None] + np.arange(most) * math.pi - begin[:, None]) / sweep[:, None]
        inside = (share > 0.0) & (share < 1.0) & (np.hypot(along, across) > SMALLEST)[:, None]
        places.append(np.nonzero(inside)[0])
        shares.append(share[inside])
    return np.concatenate(places), np.concatenate(shares)
