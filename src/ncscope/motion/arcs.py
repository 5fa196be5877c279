"""The arcs among many paths, as columns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ncscope.frames import Array
from ncscope.motion.arc import SAME_POINT, Arc

Rows = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Arcs:
    """k arcs. row (k,): the path of each, ascending. axes (k, 2): channel indices of its plane.
    values (k, 6): centre (mm), start angle and sweep (radians), start and end radius (mm)."""

    row: Rows
    axes: Rows
    values: Array

    @classmethod
    def of(cls, arcs: Mapping[int, Arc]) -> Arcs:
        """From single arcs by their path, in order."""
        if not arcs:
            return NO_ARCS
        values = [
            (*arc.centre, arc.start_rad, arc.sweep_rad, arc.start_radius, arc.end_radius)
            for arc in arcs.values()
        ]
        axes = [arc.axes for arc in arcs.values()]
        return cls(np.array(list(arcs)), np.array(axes), np.array(values, dtype=float))

    @classmethod
    def joined(cls, parts: Iterable[tuple[int, Arcs]]) -> Arcs:
        """Arcs of paths that follow each other, each part with the row where its paths begin."""
        parts = [(first, arcs) for first, arcs in parts if len(arcs)]
        if not parts:
            return NO_ARCS
        return cls(
            np.concatenate([first + arcs.row for first, arcs in parts]),
            np.concatenate([arcs.axes for _, arcs in parts]),
            np.concatenate([arcs.values for _, arcs in parts]),
        )

    def __len__(self) -> int:
        return len(self.row)

    def at(self, row: int) -> Arc | None:
        """The arc of one path, None where it is straight."""
        place = int(np.searchsorted(self.row, row))
        if place == len(self) or self.row[place] != row:
            return None
        (first, second), values = self.axes[place].tolist(), self.values[place].tolist()
        return Arc((first, second), (values[0], values[1]), *values[2:])

    def before(self, row: int) -> Arcs:
        """The arcs of the paths before one."""
        return self._part(slice(0, int(np.searchsorted(self.row, row))))

    def of_rows(self, rows: Rows) -> Arcs:
        """The arcs among these paths (ascending), which are counted anew."""
        kept = np.flatnonzero(np.isin(self.row, rows))
        return replace(self._part(kept), row=np.searchsorted(rows, self.row[kept]))

    def with_arc(self, row: int, arc: Arc | None) -> Arcs:
        """Another arc for the last path."""
        if arc is None:
            return self
        return Arcs.joined([(0, self.before(row)), (row, Arcs.of({0: arc}))])

    @property
    def sweep_rad(self) -> Array:
        return self.values[:, 3]

    @property
    def radius(self) -> Array:
        """(k,) the larger radius, mm."""
        return self.values[:, 4:].max(axis=1, initial=0.0)

    @property
    def any_spiral(self) -> bool:
        """Whether the radius of some arc changes on its way."""
        return bool((np.abs(self.values[:, 5] - self.values[:, 4]) > SAME_POINT).any())

    def _part(self, kept: slice | Rows) -> Arcs:
        return Arcs(self.row[kept], self.axes[kept], self.values[kept])


NO_ARCS = Arcs(np.empty(0, np.int64), np.empty((0, 2), np.int64), np.empty((0, 6)))
