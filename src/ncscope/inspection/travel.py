"""How far every axis goes, and where it passes its software limits.

Limits hold for axis positions, never for the tool tip (P-AXIS-00177, P-AXIS-00178).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.frames import Array
from ncscope.machine import Axis
from ncscope.trajectory import Stretch

Rows = NDArray[np.int64]

TOLERANCE = 1e-6
"""mm or degrees that an axis may be beyond a limit: rounding, far below the control's 1e-4."""


@dataclass(frozen=True, slots=True)
class Travel:
    """Where one axis went: mm or degrees, and the rows of the trajectory where it was there.

    below, above: the rows of moves that go beyond a limit, in order. first_below, first_above:
    how far the first of them goes; NaN without. An arc goes as far as it bulges.
    """

    axis: Axis
    low: float
    high: float
    low_row: int
    high_row: int
    below: Rows
    above: Rows
    first_below: float = np.nan
    first_above: float = np.nan


def travel_of(axis: Axis, s: Stretch, column: int, row: int) -> Travel:
    """Where one axis goes in a stretch whose first row is `row` of the trajectory."""
    return _travel(axis, *_positions(s, column), row)


def _positions(s: Stretch, column: int) -> tuple[Array, Rows]:
    """Positions of one axis with the rows of the stretch that they belong to, arcs included."""
    values, rows = s.acs[:, column], np.arange(len(s))
    if s.turning is None:
        return values, rows
    ends = np.flatnonzero(s.end)
    return (
        np.append(values, s.turning.acs[:, column]),
        np.append(rows, ends[s.turning.row]),
    )


def _travel(axis: Axis, values: Array, rows: Rows, row: int) -> Travel:
    lowest, highest = int(values.argmin()), int(values.argmax())
    low, high = float(values[lowest]), float(values[highest])
    ends = (row + int(rows[lowest]), row + int(rows[highest]))
    below = above = (np.empty(0, dtype=np.int64), np.nan)
    if axis.limits is not None:
        if low < axis.limits[0] - TOLERANCE:
            below = _beyond(values < axis.limits[0] - TOLERANCE, values, rows + row)
        if high > axis.limits[1] + TOLERANCE:
            above = _beyond(values > axis.limits[1] + TOLERANCE, values, rows + row)
    return Travel(axis, low, high, *ends, below[0], above[0], below[1], above[1])


def _beyond(there: NDArray[np.bool_], values: Array, rows: Rows) -> tuple[Rows, float]:
    """The rows beyond a limit in order, and the position at the first of them."""
    found = np.flatnonzero(there)
    order = found[np.argsort(rows[found], kind="stable")]
    return rows[order], float(values[order[0]])


def joined(a: Travel, b: Travel) -> Travel:
    """Both travels of one axis; `a` came first."""
    low, high = (a if a.low <= b.low else b), (a if a.high >= b.high else b)
    return Travel(
        a.axis,
        low.low,
        high.high,
        low.low_row,
        high.high_row,
        np.concatenate([a.below, b.below]),
        np.concatenate([a.above, b.above]),
        a.first_below if len(a.below) else b.first_below,
        a.first_above if len(a.above) else b.first_above,
    )
