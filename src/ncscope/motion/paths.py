"""Many paths at once, in programmed values: where each is at a share of its way.

Straight lines and arcs of the tool tip. The tool direction of a complete transformation turns in
the plane of its two ends (P-CHAN-00417).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.plane import turned_in_plane
from ncscope.motion.arcs import Arcs


@dataclass(frozen=True)
class Paths:
    """m paths in programmed values. start, end: (m, n) mm and degrees, modulo axes not wrapped.

    rapid: (m,) whether it is G00, None where that does not matter.
    turning: the chain under which programmed directions turn in a plane, None where angles run
    linearly.
    """

    start: Array
    end: Array
    arcs: Arcs
    rapid: NDArray[np.bool_] | None = None
    turning: Coordinates | None = None

    def __len__(self) -> int:
        return len(self.end)

    def under(self, coordinates: Coordinates) -> Paths:
        """The same paths with the way that directions take under this chain."""
        active = coordinates.kinematics
        if active is None or not active.turns_in_plane or not active.model.orientation:
            return self
        return replace(self, turning=coordinates)

    def part(self, rows: NDArray[np.int64]) -> Paths:
        """These rows alone."""
        arcs, rapid = self.arcs.of_rows(rows), None if self.rapid is None else self.rapid[rows]
        return replace(self, start=self.start[rows], end=self.end[rows], arcs=arcs, rapid=rapid)

    @cached_property
    def _arc_of_row(self) -> NDArray[np.int64]:
        """Which of the arcs each row is, -1 for a straight path."""
        places = np.full(len(self), -1, dtype=np.int64)
        places[self.arcs.row] = np.arange(len(self.arcs))
        return places

    def at(self, row: NDArray[np.int64], share: Array) -> Array:
        """Programmed values (k, n) at shares (k,) of the paths `row` (k,); 1 is exactly the end."""
        column = share[:, None]
        points = self.start[row] + column * (self.end[row] - self.start[row])
        if len(self.arcs):
            self._bend(points, row, share)
        if self.turning is not None:
            points = self._turned(self.turning, points, row, share)
        return np.where(column == 1.0, self.end[row], points)

    def _bend(self, points: Array, row: NDArray[np.int64], share: Array) -> None:
        """Writes the plane coordinates of the points that lie on arcs."""
        own = np.flatnonzero(self._arc_of_row[row] >= 0)
        place = self._arc_of_row[row[own]]
        axes = self.arcs.axes
        first, second, begin, sweep, radius, last = self.arcs.values[place].T
        angle = begin + share[own] * sweep
        radius = radius + share[own] * (last - radius)
        points[own, axes[place, 0]] = first + radius * np.cos(angle)
        points[own, axes[place, 1]] = second + radius * np.sin(angle)

    def _turned(
        self, chain: Coordinates, points: Array, row: NDArray[np.int64], share: Array
    ) -> Array:
        """The points with the directions of a complete transformation in their plane."""
        assert chain.kinematics is not None
        model, columns = chain.kinematics.model, list(chain.kinematics.model.orientation)
        turning = np.flatnonzero((self.start[row] != self.end[row])[:, columns].any(axis=1))
        if not len(turning):
            return points
        row, near = row[turning], points[turning]
        start, end = chain.asked(self.start[row]), chain.asked(self.end[row])
        words = turned_in_plane(model, start, end, share[turning], chain.asked(near))
        points[turning[:, None], columns] = chain.program_from_asked(words, near)[:, columns]
        return points
