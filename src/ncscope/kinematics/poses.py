"""Axis values and tool poses side by side, for tables of poses.

Enters: a kinematics and rows of axis values, of programmed values, or of tool tip and direction.
Leaves: `Poses`, which knows all of them with the pose number and the condition numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics import kernels
from ncscope.kinematics.jacobian import conditions
from ncscope.kinematics.orientation import OrientationSolver
from ncscope.kinematics.step import KinematicsError, KinematicStep
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.kinematics.user import NO_SOLUTION

Array = NDArray[np.float64]

SAME_AXES = 1e-9
"""mm and degrees: axis values that differ by less are one solution."""


@dataclass(frozen=True, slots=True, eq=False)
class Poses:
    """Rows of poses; mm, degrees, unit vectors; NaN where a row has no solution.

    row (m,): which row of the input, counted from 0. program (m, n_channel): the programmed
    values. axes (m, n_channel). tip (m, 3) and direction (m, 3) tip -> flange, workpiece system.
    pose (m,): +1 or -1. linear, rotary (m,): condition numbers, see `jacobian.conditions`.
    status (m,): 0, or why there is no solution (`kernels`, `explain_status`).
    """

    axis_names: tuple[str, ...]
    row: NDArray[np.int64]
    program: Array
    axes: Array
    tip: Array
    direction: Array
    pose: NDArray[np.int8]
    linear: Array
    rotary: Array
    status: NDArray[np.int8]

    def __len__(self) -> int:
        return len(self.row)


def poses_of_axes(kin: UniversalKinematics, axes: ArrayLike, tool_length: float = 0.0) -> Poses:
    """The poses that axis values (m, n_channel) give."""
    rows = np.atleast_2d(np.asarray(axes, np.float64))
    return _poses(kin, rows, np.zeros(len(rows), np.int8), tool_length)


def poses_of_program(
    kin: UniversalKinematics,
    program: ArrayLike,
    tool_length: float = 0.0,
    near: ArrayLike | None = None,
    both: bool = False,
) -> Poses:
    """The poses that programmed values (m, n_channel) give; with `both` the other one as well."""
    rows = np.atleast_2d(np.asarray(program, np.float64))
    axes, status = kin.inverse_rows(rows, tool_length, near)
    found = _poses(kin, axes, status, tool_length, rows)
    if not both:
        return found
    other, other_status = _turned(kin, found.tip, found.direction, tool_length, near, -found.pose)
    other_status = np.where(status, status, other_status).astype(np.int8)
    _keep_other_axes(kin, other, rows)
    # Angles in space mean the same direction in both poses; with RTCP they are axis angles.
    same = None if kin.rtcp else rows
    return _together(found, _poses(kin, other, other_status, tool_length, same))


def poses_of_tool(
    kin: UniversalKinematics,
    tip: ArrayLike,
    direction: ArrayLike,
    tool_length: float = 0.0,
    near: ArrayLike | None = None,
    both: bool = False,
) -> Poses:
    """The poses that bring the tool tip (m, 3) and the direction tip -> flange (m, 3) about.

    Independent of the programming mode. near: axis values (n_channel,); the pose of these is
    taken, and an angle that the direction leaves free keeps their value.
    Raises KinematicsError 292009 for more than two rotary axes: they have no unique solution.
    """
    points, vectors = np.atleast_2d(tip), np.atleast_2d(direction)
    start = np.zeros(len(kin.axis_names)) if near is None else np.asarray(near, np.float64)
    pose = _solver(kin).pose_of(_angles(kin, np.atleast_2d(start)))
    pose = np.broadcast_to(pose, (len(points),))
    found = [_turned(kin, points, vectors, tool_length, near, pose)]
    if both:
        found.append(_turned(kin, points, vectors, tool_length, near, -pose))
    parts = [_poses(kin, axes, status, tool_length) for axes, status in found]
    return _together(*parts) if both else parts[0]


def poses_of_step(
    step: KinematicStep,
    names: Sequence[str],
    axes: ArrayLike | None = None,
    program: ArrayLike | None = None,
    tool_length: float = 0.0,
    near: ArrayLike | None = None,
) -> Poses:
    """The poses of any kinematics for axis values or programmed values (m, n_channel).

    Condition numbers are NaN, the direction too where the kinematics has no tool.
    Raises KinematicsError for a faulty kinematics; a row without a solution has a status.
    """
    if axes is None:
        programmed = np.atleast_2d(np.asarray(program, np.float64))
        values, status = _of_rows(lambda r: step.inverse(r, tool_length, near), programmed)
    else:
        values = np.atleast_2d(np.asarray(axes, np.float64))
        programmed, status = _of_rows(lambda r: step.program(r, tool_length), values)
    values = np.where(status[:, None] != 0, np.nan, values)
    tip, direction = step.forward(values, tool_length)
    count = len(values)
    nothing = np.full(count, np.nan)
    return Poses(
        tuple(names),
        np.arange(count),
        programmed,
        values,
        tip,
        np.full((count, 3), np.nan) if direction is None else direction,
        np.ones(count, np.int8),
        nothing,
        nothing,
        status,
    )


def _of_rows(solve: Callable[[Array], Array], rows: Array) -> tuple[Array, NDArray[np.int8]]:
    """What a kinematics answers for rows (m, n), NaN where it has no solution, and a status."""
    status = np.zeros(len(rows), np.int8)
    try:
        return solve(rows), status
    except KinematicsError as error:
        if not error.rows or error.id != NO_SOLUTION:
            raise
        status[list(error.rows)] = kernels.UNREACHABLE
    answer = np.full(rows.shape, np.nan)
    answer[status == 0] = solve(rows[status == 0])
    return answer, status


def _solver(kin: UniversalKinematics) -> OrientationSolver:
    """The machine's own rotary axes, also when its programming mode does not ask for angles."""
    rotary = list(kin.chain.rotary)
    if len(rotary) > 2:
        raise KinematicsError(
            "292009", f"{len(rotary)} rotary axes have no unique position for a tool direction"
        )
    return OrientationSolver.from_axes(kin.chain.directions[rotary], kin.chain.zero_orientation)


def _angles(kin: UniversalKinematics, rows: Array) -> Array:
    out = np.zeros((len(rows), 2))
    for k, axis in enumerate(kin.chain.rotary[:2]):
        out[:, k] = rows[:, axis]
    return out


def _turned(
    kin: UniversalKinematics,
    tip: ArrayLike,
    direction: ArrayLike,
    tool_length: float,
    near: ArrayLike | None,
    pose: NDArray[np.int8],
) -> tuple[Array, NDArray[np.int8]]:
    """Axis values (m, n_channel) for tip and direction in the given pose, and a status."""
    target = np.ascontiguousarray(tip, np.float64)
    vectors = np.ascontiguousarray(direction, np.float64)
    start = np.zeros(len(kin.axis_names)) if near is None else np.asarray(near, np.float64)
    solved, status = _solver(kin).solve(
        vectors, _angles(kin, np.atleast_2d(start)), np.ascontiguousarray(pose)
    )
    axes = np.zeros((len(target), len(kin.axis_names)))
    for k, axis in enumerate(kin.chain.rotary):
        axes[:, axis] = solved[:, k]
    joints, flange, _, unlinkage = kin.packed
    kernels.solve_rows(joints, flange, unlinkage, target, float(tool_length), axes, status)
    return axes, status


def _keep_other_axes(kin: UniversalKinematics, axes: Array, program: Array) -> None:
    """Axes outside the chain pass through, as `inverse_rows` lets them."""
    if len(kin.axis_names) > kin.chain.n and program.shape[1] > kin.chain.n:
        axes[:, kin.chain.n :] = program[:, kin.chain.n :]


def _poses(
    kin: UniversalKinematics,
    axes: Array,
    status: NDArray[np.int8],
    tool_length: float,
    program: Array | None = None,
) -> Poses:
    axes = np.where(status[:, None] != 0, np.nan, axes)
    tip, direction = kin.forward(axes, tool_length)
    safe = np.where(status[:, None] != 0, 0.0, axes)
    if program is None:
        program = np.where(status[:, None] != 0, np.nan, kin.program(safe, tool_length))
    pose = np.ones(len(axes), np.int8)
    if len(kin.chain.rotary) <= 2:
        pose = _solver(kin).pose_of(_angles(kin, safe))
    linear, rotary = conditions(kin.chain, axes, tool_length)
    row = np.arange(len(axes))
    return Poses(kin.axis_names, row, program, axes, tip, direction, pose, linear, rotary, status)


def _together(first: Poses, second: Poses) -> Poses:
    """Both poses of a row one behind the other; a row once where the two are one."""
    apart = np.abs(first.axes - second.axes).max(axis=1, initial=0.0) > SAME_AXES
    kept = np.column_stack([np.ones(len(first), bool), apart]).reshape(-1)

    def merge(name: str) -> Any:
        a, b = getattr(first, name), getattr(second, name)
        return np.stack([a, b], axis=1).reshape(2 * len(a), *a.shape[1:])[kept]

    names = (field.name for field in fields(Poses) if field.name != "axis_names")
    return Poses(first.axis_names, *(merge(name) for name in names))
