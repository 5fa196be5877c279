"""What the curves mark: travel limits, swings at the pole, turned-over axes, changes of the pose.

Moves are counted from 0 over the whole run.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ncscope.inspection import Inspection
from ncscope.kinematics import OrientationSolver, UniversalKinematics
from ncscope.trajectory import Trajectory

MOST_EVENTS = 5000
"""So many of each kind are marked."""


def events(result: Trajectory, found: Inspection) -> dict[str, Any]:
    """Every kind of event with its moves. result: without points on the way."""
    return {
        "limits": [
            {"axis": t.axis.name, "rows": rows[:MOST_EVENTS].tolist()}
            for t in found.travel
            for rows in (t.below, t.above)
            if len(rows)
        ],
        "swings": [
            {"axis": s.axis, "row": s.row, "last": s.last, "distance": s.distance, "swing": s.swing}
            for s in found.swings[:MOST_EVENTS]
        ],
        "wraps": [{"axis": w.axis.name, "row": w.row} for w in found.wraps[:MOST_EVENTS]],
        "poses": list(_pose_changes(result))[:MOST_EVENTS],
    }


def _pose_changes(result: Trajectory) -> Iterator[int]:
    """Moves at whose end the rotary axes stand in the other of their two poses."""
    row = 0
    for s in result.stretches:
        active = s.coordinates.kinematics
        if active is not None and isinstance(active.model, UniversalKinematics):
            chain, rotary = active.model.chain, list(active.model.chain.rotary)
            if len(rotary) == 2:
                solver = OrientationSolver.from_axes(
                    chain.directions[rotary], chain.zero_orientation
                )
                angles = np.vstack([s.start[rotary], s.acs[:, rotary]])
                changed = np.flatnonzero(np.diff(solver.pose_of(angles)))
                yield from (row + int(i) for i in changed)
        row += len(s)
