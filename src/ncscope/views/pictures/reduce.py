"""Long runs on few pixels: what would be drawn over itself is left out, nothing that is seen.

Enters: columns of a run. Leaves: lines that look the same at the size of a picture.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.frames import Array

Rows = NDArray[np.int64]

CELLS = 2048
"""Cells of the grid along the longer edge of a picture; a screen shows fewer."""
FEWEST_CELLS = 512


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Points (k, d) with a row of NaN between parts, and the segment (k,) that ends at each.

    hidden: of how many segments one is drawn; 1 but for runs that no grid makes smaller.
    """

    points: Array
    rows: Rows
    hidden: int = 1


def polyline(start: Array, end: Array, limit: int) -> Line:
    """Segments (n, d) as one line of at most `limit` segments.

    A longer run is rounded to a grid; a segment inside one cell, and one that is drawn already,
    are left out. The grid becomes coarser while too many are left.
    """
    rows = np.arange(len(start))
    if len(start) <= limit:
        return _joined(start, end, rows)
    low = np.minimum(start.min(axis=0), end.min(axis=0))
    span = float((np.maximum(start.max(axis=0), end.max(axis=0)) - low).max()) or 1.0
    cells = CELLS if start.shape[1] == 2 else CELLS // 2
    while True:
        step = span / cells
        a, b = (np.rint((p - low) / step).astype(np.int64) for p in (start, end))
        rows = _distinct(a, b, cells + 1)
        if len(rows) <= limit or cells <= FEWEST_CELLS:
            break
        cells //= 2
    hidden = -(-len(rows) // limit)
    rows = rows[::hidden]
    return _joined(low + a[rows] * step, low + b[rows] * step, rows, hidden)


def _distinct(a: Rows, b: Rows, base: int) -> Rows:
    """Segments between cells, each once, in order; two corners have one number of 63 bits."""
    moved = np.flatnonzero((a != b).any(axis=1))
    if len(moved) == 0:
        return np.array([0])
    key = np.zeros(len(moved), dtype=np.int64)
    for cell in (a[moved], b[moved]):
        for column in cell.T:
            key = key * base + column
    return np.sort(moved[np.unique(key, return_index=True)[1]])


def _joined(a: Array, b: Array, rows: Rows, hidden: int = 1) -> Line:
    if len(rows) == 0:
        return Line(np.empty((0, a.shape[1])), rows, hidden)
    new = np.append(True, (a[1:] != b[:-1]).any(axis=1))
    last = np.cumsum(np.where(new, 3, 1)) - 1
    points = np.full((int(last[-1]) + 1, a.shape[1]), np.nan)
    owner = np.repeat(rows, np.where(new, 3, 1))
    points[last] = b
    points[last[new] - 1] = a[new]
    return Line(points[1:], owner[1:], hidden)


def envelope(values: Array, width: int) -> Rows:
    """Rows (k,) of a curve (n,) that show its lowest and highest value in each of `width` parts."""
    n = len(values)
    if n <= 4 * width:
        return np.arange(n)
    size = -(-n // width)
    padded = np.append(values, np.full(-n % size, values[-1])).reshape(-1, size)
    first = np.arange(len(padded)) * size
    low = first + np.where(np.isnan(padded), np.inf, padded).argmin(axis=1)
    high = first + np.where(np.isnan(padded), -np.inf, padded).argmax(axis=1)
    rows = np.unique(np.concatenate([[0], low, high, [n - 1]]))
    return rows[rows < n]
