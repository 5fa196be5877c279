"""What differs when one machine is driven by the kinematics of another.

Enters: two kinematics of one channel and programmed poses. Leaves: `Comparison`.
The usual pair is the nominal and the measured machine (FCT-C27 6): before the compensation the
control computes with the nominal data set and the machine is the measured one, after it both are
measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics.step import KinematicsError
from ncscope.kinematics.universal import UniversalKinematics

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """Rows of poses; mm and degrees; NaN where one of the two has no solution.

    program (m, n): the programmed values. axes (m, n): axis values of the second kinematics minus
    those of the first, rotary axes the short way round. Tip (m, 3) and angle (m,) of the tool
    direction tell how far the tool of the second machine is from where the first kinematics wants
    it: `before` with axis values of the first kinematics, `after` with those of the second.
    """

    axis_names: tuple[str, ...]
    rotary: tuple[bool, ...]
    program: Array
    axes: Array
    tip_before: Array
    angle_before: Array
    tip_after: Array
    angle_after: Array

    def __len__(self) -> int:
        return len(self.program)

    def summary(self) -> tuple[Extent, ...]:
        """Largest and mean size of every difference, the tool first, then each axis."""
        tools = [
            ("tip before", "mm", np.linalg.norm(self.tip_before, axis=1)),
            ("direction before", "deg", self.angle_before),
            ("tip after", "mm", np.linalg.norm(self.tip_after, axis=1)),
            ("direction after", "deg", self.angle_after),
        ]
        axes = [
            (f"axis {name}", "deg" if turns else "mm", np.abs(self.axes[:, i]))
            for i, (name, turns) in enumerate(zip(self.axis_names, self.rotary, strict=True))
        ]
        return tuple(_extent(*item) for item in [*tools, *axes])


@dataclass(frozen=True, slots=True)
class Extent:
    """The size of one difference over all poses; `worst` is the row of the largest, None when
    no row has a solution."""

    quantity: str
    unit: str
    largest: float
    rms: float
    worst: int | None


def compare(
    first: UniversalKinematics,
    second: UniversalKinematics,
    program: ArrayLike,
    tool_length: float = 0.0,
) -> Comparison:
    """Differences of two kinematics of one channel for programmed values (m, n_channel).

    The second takes the pose that lies next to the axis values of the first.
    Raises KinematicsError 292040 when the axes of the two differ.
    """
    _check_axes(first, second)
    rows = np.atleast_2d(np.asarray(program, np.float64))
    axes, status = first.inverse_rows(rows, tool_length)
    axes = np.where(status[:, None] != 0, np.nan, axes)
    own = _nearest(second, rows, axes, tool_length)
    tip, direction = first.forward(axes, tool_length)
    before, after = second.forward(axes, tool_length), second.forward(own, tool_length)
    rotary = tuple(a in first.chain.rotary for a in range(len(first.axis_names)))
    change = own - axes
    change[:, rotary] = _short_way(change[:, rotary])
    return Comparison(
        first.axis_names,
        rotary,
        rows,
        change,
        before[0] - tip,
        _angle_deg(before[1], direction),
        after[0] - tip,
        _angle_deg(after[1], direction),
    )


def _check_axes(first: UniversalKinematics, second: UniversalKinematics) -> None:
    if first.axis_names != second.axis_names:
        a, b = " ".join(first.axis_names), " ".join(second.axis_names)
        raise KinematicsError("292040", f"the first machine has the axes {a}, the second {b}")
    if first.chain.rotary != second.chain.rotary:
        raise KinematicsError("292040", "the rotary axes of the two stand in another order")


def _nearest(kin: UniversalKinematics, rows: Array, near: Array, tool_length: float) -> Array:
    """Axis values of the pose that lies nearer to `near` (m, n): measured axes move the border
    between the poses, so the rule of the selection could choose the other one."""
    start = np.where(np.isfinite(near), near, 0.0)
    solutions = []
    for pose in (1, -1):
        axes, status = kin.inverse_rows(rows, tool_length, start, np.full(len(rows), pose, np.int8))
        solutions.append(np.where(status[:, None] != 0, np.nan, axes))
    rotary = list(kin.chain.rotary)
    ways = [np.abs(_short_way((s - start)[:, rotary])).sum(axis=1) for s in solutions]
    chosen = np.where((ways[0] <= ways[1])[:, None], *solutions)
    return np.where(np.isfinite(near), chosen, np.nan)


def _short_way(degrees: Array) -> Array:
    return degrees - 360.0 * np.round(degrees / 360.0)


def _angle_deg(a: Array, b: Array) -> Array:
    crossed = np.linalg.norm(np.cross(a, b), axis=1)
    return np.degrees(np.arctan2(crossed, (a * b).sum(axis=1)))


def _extent(quantity: str, unit: str, sizes: Array) -> Extent:
    usable = np.isfinite(sizes)
    if not usable.any():
        return Extent(quantity, unit, np.nan, np.nan, None)
    worst = int(np.nanargmax(sizes))
    rms = float(np.sqrt(np.mean(sizes[usable] ** 2)))
    return Extent(quantity, unit, float(sizes[worst]), rms, worst)
