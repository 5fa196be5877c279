"""The path of the tool tip in the machine system, and the coordinate systems it was programmed in.

Enters: a `Trajectory`. Leaves: segments and triads in mm, MCS.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ncscope.contour import NO_CONTOUR
from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.trajectory import MOTIONS, Trajectory

MOST_TRIADS = 12
SAME = 1e-6
"""mm or parts of a unit vector below which two coordinate systems are drawn as one."""


@dataclass(frozen=True, slots=True, eq=False)
class Triad:
    """A coordinate system: its name, its origin (3,) and its axes (3, 3), one a row."""

    name: str
    origin: Array
    axes: Array

    def same_place(self, other: Triad) -> bool:
        return bool(
            np.abs(self.origin - other.origin).max() < SAME
            and np.abs(self.axes - other.axes).max() < SAME
        )


@dataclass(frozen=True, slots=True, eq=False)
class ToolPath:
    """Segments start -> end (n, 3), one for each row of the run; rapid (n,): G00.

    triads: the machine system first, then every other one that was in use, each once.
    more_triads: how many were left out.
    """

    start: Array
    end: Array
    rapid: NDArray[np.bool_]
    triads: tuple[Triad, ...]
    more_triads: int = 0

    @property
    def size(self) -> float:
        """Longest edge of the box around the path, mm; at least 1."""
        if len(self.end) == 0:
            return 1.0
        both = np.concatenate([self.start, self.end])
        return max(1.0, float(np.ptp(both, axis=0).max()))


def tool_path(result: Trajectory) -> ToolPath:
    """The path of a run."""
    starts, ends, rapid = [np.empty((0, 3))], [np.empty((0, 3))], [np.empty(0, dtype=bool)]
    for s in result.stretches:
        points = _three(s.mcs)
        first = _three(s.coordinates.mcs_from_axes(s.start)[None])
        starts.append(np.concatenate([first, points[:-1]]))
        ends.append(points)
        rapid.append(s.motion == MOTIONS.index("G00"))
    triads = _triads(result)
    shown = triads[:MOST_TRIADS]
    return ToolPath(
        np.concatenate(starts),
        np.concatenate(ends),
        np.concatenate(rapid),
        shown,
        len(triads) - len(shown),
    )


def _three(points: Array) -> Array:
    """The main axes; 0 for those that the channel does not have."""
    full = np.zeros((len(points), 3))
    full[:, : min(3, points.shape[1])] = points[:, :3]
    return full


def _triads(result: Trajectory) -> tuple[Triad, ...]:
    found = [Triad("MCS", np.zeros(3), np.eye(3))]
    seen: set[int] = set()
    for s in result.stretches:
        if id(s.coordinates) in seen or s.coordinates.axis_count < 3:
            continue
        seen.add(id(s.coordinates))
        for triad in _levels(s.coordinates):
            if not any(triad.same_place(other) for other in found):
                found.append(triad)
    return tuple(found)


def _levels(coordinates: Coordinates) -> list[Triad]:
    """Each level with its own offsets; level 0 is the workpiece system."""
    found = []
    for count, level in enumerate(coordinates.levels, start=1):
        alone = replace(coordinates, levels=coordinates.levels[:count], contour=NO_CONTOUR)
        points = np.zeros((4, coordinates.axis_count))
        points[1:, :3] = np.eye(3)
        corners = alone.to_mcs(points)[:, :3]
        offsets = "+".join(offset.name for _, offset in level.offsets)
        name = "WCS" if count == 1 else level.name
        found.append(Triad(f"{name} {offsets}".strip(), corners[0], corners[1:] - corners[0]))
    return found
