"""One move as the page shows it: the record of `run --format jsonl`, the layers, the systems."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import orjson

from ncscope.coordinates import Coordinates
from ncscope.trajectory import Explanation, Trajectory
from ncscope.views.records import move_record


def move_view(result: Trajectory, index: int) -> dict[str, Any]:
    """The move at a row of the run. Raises IndexError without such a row."""
    stretch, _ = result.locate(index)
    return {
        "move": orjson.loads(move_record(result, index)),
        "explanation": result.explain_move(index).as_dict(),
        "systems": systems(stretch.coordinates),
    }


def line_view(result: Trajectory, line: int) -> dict[str, Any]:
    """A line of the main program without moves. Raises KeyError when it was not executed."""
    explanation: Explanation = result.explain(line=line)
    return {"move": None, "explanation": explanation.as_dict(), "systems": []}


def systems(coordinates: Coordinates) -> list[dict[str, Any]]:
    """Every active coordinate system in the MCS, from the outermost in: origin in mm and the
    matrix (3, 3) whose columns are its axes."""
    found = [_system("MCS", None, [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0])]
    if coordinates.axis_count < 3:
        return found
    for count, level in enumerate(coordinates.levels, start=1):
        frame = replace(coordinates, levels=coordinates.levels[:count]).mcs_frame
        name = level.name if count > 1 else "WCS"
        found.append(_system(name, level.origin, frame.rotation.tolist(), frame.shift.tolist()))
    return found


def _system(name: str, origin: str | None, rotation: Any, shift: Any) -> dict[str, Any]:
    return {"name": name, "origin": origin, "rotation": rotation, "shift": shift}
