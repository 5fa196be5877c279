"""The tool between two directions: it turns in the plane of both (P-CHAN-00417 = 0).

Enters: programmed values at both ends of paths of a complete transformation, and points between
with angles that run linearly. Leaves: the points with the angles of the direction in the plane.
Source: P-CHAN-00417 (ori_interpolation_mode).
"""

from __future__ import annotations

import numpy as np

from ncscope.kinematics.step import Array, KinematicStep, TwoSteps
from ncscope.kinematics.universal import UniversalKinematics

SAME_PLANE = 1e-9
"""Sine between two directions below which they span no plane: equal or opposite ones."""


def turned_in_plane(
    step: KinematicStep, start: Array, end: Array, share: Array, points: Array
) -> Array:
    """`points` (m, n) with the angles that the direction has at `share` (m,) of its way.

    start, end: (m, n) programmed values. The way is the shorter one, at constant rate. Of several
    angles for a direction those nearest to `points` are taken; NaN where no angles give it.
    Unchanged where the tool is opposite at both ends, where no angle changes, where the direction
    is programmed as a vector (its straight line lies in the plane), and with RTCP.
    """
    step = step.second if isinstance(step, TwoSteps) else step
    if not isinstance(step, UniversalKinematics) or step.direction is None:
        return points
    columns = list(step.direction.columns)
    rows = np.flatnonzero((start[:, columns] != end[:, columns]).any(axis=1))
    if step.direction.is_vector or not len(rows):
        return points
    first, last = step.programmed_direction(start[rows]), step.programmed_direction(end[rows])
    way, between = _between(first, last, share[rows])
    result = points.copy()
    rows = rows[between]
    result[rows] = step.direction.with_direction(points[rows], way[between])
    return result


def _between(a: Array, b: Array, share: Array) -> tuple[Array, Array]:
    """Unit directions (m, 3) at shares of the way from a to b; which of them (m,) are definite."""
    sine = np.linalg.norm(np.cross(a, b), axis=1)
    angle = np.arctan2(sine, (a * b).sum(axis=1))
    flat = sine < SAME_PLANE
    with np.errstate(invalid="ignore", divide="ignore"):
        before, after = np.sin((1 - share) * angle) / sine, np.sin(share * angle) / sine
    before, after = np.where(flat, 1 - share, before), np.where(flat, share, after)
    way = before[:, None] * a + after[:, None] * b
    return way, ~flat | (angle < 1.0)
