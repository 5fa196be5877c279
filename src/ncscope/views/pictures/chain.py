"""What is to be seen of a universal kinematics: its axes, points, zero position and tool.

Enters: a `UniversalKinematics`. Leaves: parts in mm, all axes at 0, in the system of the list.
Directions are drawn as they are entered: axes on the workpiece side point against the motion of
the part (FCT-C27 section 4.1), so a forgotten sign shows as an arrow that points the wrong way.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ncscope.frames import Array, axis_rotation
from ncscope.kinematics.chain import ROTARY
from ncscope.kinematics.universal import UniversalKinematics

SMALLEST_SIZE = 50.0
"""mm; a machine whose points all fall together is drawn this large."""
ALIGNED = 1e-6
_NO_LINE = np.empty((0, 3))
LETTERS = {"X": 0, "Y": 1, "Z": 2, "A": 0, "B": 1, "C": 2, "U": 0, "V": 1, "W": 2}


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One thing to draw.

    id: stable name (`axis-C`, `tool`). kind: linear, rotary, tool, flange, base.
    line (k, 3): drawn through, empty for a point. arrow: a head at the end of the line.
    point: a mark, None without. turn (m, 3): the sense of a positive turn, empty without.
    """

    id: str
    kind: str
    label: str
    line: Array
    arrow: bool = True
    point: Array | None = None
    turn: Array | None = None


@dataclass(frozen=True, slots=True)
class Box:
    """One axis in words. remark: its direction, `+Z`. side: what the sign says, `doubtful` marks
    it."""

    name: str
    kind: str
    direction: str
    point: str
    remark: str
    side: str = ""
    doubtful: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class ChainScene:
    """A machine to draw. size: mm, the longest edge of the box around its points."""

    name: str
    parts: tuple[Part, ...]
    boxes: tuple[Box, ...]
    size: float


def chain_scene(model: UniversalKinematics, tool_length: float = 0.0) -> ChainScene:
    """The chain of a machine; tool_length in mm."""
    chain, names = model.chain, model.axis_names
    tip = chain.zero_position - tool_length * chain.zero_orientation
    rotary = [chain.points[a] for a in chain.rotary]
    corners = np.array([np.zeros(3), chain.zero_position, tip, *rotary])
    size = max(SMALLEST_SIZE, float(np.ptp(corners, axis=0).max()))
    compass = corners.min(axis=0) - (0.5 * size, 0.5 * size, 0.0)
    parts = [*_base(compass, size), Part("origin", "base", "origin", _NO_LINE, point=np.zeros(3))]
    parts += _tool(chain.zero_position, chain.zero_orientation, tip, size)
    for place, a in enumerate(int(a) for a in chain.order):
        direction, name = chain.directions[a], names[a]
        if chain.types[a] == ROTARY:
            parts.append(_rotary(name, direction, chain.points[a], corners, size, place))
        else:
            line = np.array([compass, compass + 0.36 * size * direction])
            parts.append(Part(f"axis-{name}", "linear", name, line))
    return ChainScene(model.name or f"kinematics {model.id}", tuple(parts), _boxes(model), size)


def _base(compass: Array, size: float) -> list[Part]:
    """The axes of the system of the list, beside the machine: linear axes have no place."""
    return [
        Part(f"base-{n}", "base", n, np.array([compass, compass + 0.48 * size * row]))
        for n, row in zip("xyz", np.eye(3), strict=True)
    ]


def _tool(zero: Array, orientation: Array, tip: Array, size: float) -> list[Part]:
    arrow = np.array([zero, zero + 0.22 * size * orientation])
    parts = [
        Part("zero-orientation", "flange", "zero orientation", arrow),
        Part("zero-position", "flange", "zero position", _NO_LINE, point=zero),
    ]
    if np.any(tip != zero):
        parts.append(Part("tool", "tool", "", np.array([zero, tip]), arrow=False))
        parts.append(Part("tool-tip", "tool", "tool tip", _NO_LINE, point=tip))
    return parts


def _rotary(
    name: str, direction: Array, point: Array, corners: Array, size: float, place: int
) -> Part:
    along = (corners - point) @ direction
    low, high = min(0.0, float(along.min())), max(0.0, float(along.max()))
    # Axes that share a line end at different places, so that their arrows do not cover each other.
    end = high + (0.2 + 0.09 * place) * size
    line = point + np.array([[low - 0.1 * size], [end]]) * direction
    centre = point + (end - 0.07 * size) * direction
    turn = centre + _circle(direction, 0.09 * size)
    return Part(f"axis-{name}", "rotary", name, line, point=point, turn=turn)


def _circle(direction: Array, radius: float) -> Array:
    """Points (m, 3) of three quarters of a turn about a direction, right-handed."""
    side = np.eye(3)[int(np.argmin(np.abs(direction)))]
    e1 = np.cross(direction, side)
    e1 /= np.linalg.norm(e1)
    e2 = np.cross(direction, e1)
    turns = [axis_rotation("Z", angle)[:2, 0] for angle in np.linspace(0.0, 285.0, 39)]
    return radius * np.array([c * e1 + s * e2 for c, s in turns])


def _boxes(model: UniversalKinematics) -> tuple[Box, ...]:
    chain = model.chain
    boxes, before_linear = [], True
    for a in (int(a) for a in chain.order):
        turns = bool(chain.types[a] == ROTARY)
        before_linear &= turns
        direction = chain.directions[a]
        remark, side, doubtful = _remark(model.axis_names[a], direction, before_linear)
        boxes.append(
            Box(
                model.axis_names[a],
                "rotary" if turns else "linear",
                _triple(direction),
                _triple(chain.points[a]) if turns else "",
                remark,
                side,
                doubtful,
            )
        )
    return tuple(boxes)


def _remark(name: str, direction: Array, workpiece_side: bool) -> tuple[str, str, bool]:
    """The direction in words, what its sign says, and whether that is to be looked at."""
    column = LETTERS.get(name[:1].upper(), int(np.argmax(np.abs(direction))))
    letter, share = "XYZ"[column], float(direction[column])
    sign = "+" if share > 0 else "−"
    off = float(np.degrees(np.arctan2(np.linalg.norm(np.delete(direction, column)), abs(share))))
    text = f"{sign}{letter}" if off < ALIGNED else f"{off:.3g}° off {sign}{letter}"
    if workpiece_side and share > 0:
        return text, "not inverted?", True
    if workpiece_side:
        return text, "workpiece side", False
    return (text, "", False) if share > 0 else (text, f"against {letter}?", True)


def _triple(values: Array) -> str:
    return "(" + ", ".join(f"{v + 0.0:.5g}" for v in np.round(values, 6)) + ")"
