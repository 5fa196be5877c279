"""How the tool moves with each axis, and how well that can be turned round.

Enters: a chain and rows of axis values in mm and degrees. Leaves: partial derivatives of tool tip
and tool direction, and condition numbers. Follows from the product of exponentials of FCT-C27 3;
no differences are taken.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics.chain import LINEAR, Chain

Array = NDArray[np.float64]


def jacobian(chain: Chain, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array]:
    """Derivatives of tool tip and tool direction, both (..., 3, n), workpiece system.

    axes: (..., >= n) mm and degrees. tool_length: mm.
    Tip: mm per mm and mm per radian. Direction: per mm (always 0) and per radian.
    Columns are in axis index order.
    """
    values = np.asarray(axes, np.float64)[..., : chain.n]
    rows = values.reshape(-1, chain.n)
    tip = np.broadcast_to(
        chain.zero_position - tool_length * chain.zero_orientation, (len(rows), 3)
    )
    direction = np.broadcast_to(chain.zero_orientation, (len(rows), 3))
    columns = np.zeros((2, len(rows), chain.n, 3))
    moved = _displacements(chain, rows)
    for axis in reversed(chain.order):  # from the tool to the workpiece
        k = chain.directions[axis]
        if chain.types[axis] == LINEAR:
            tip = tip + moved[:, axis, None] * k
            columns[0, :, axis] = k
            continue
        turn = _rotations(k, rows[:, axis])
        point = chain.points[axis]
        tip = np.einsum("mij,mj->mi", turn, tip - point) + point
        direction = np.einsum("mij,mj->mi", turn, direction)
        columns = np.einsum("mij,smaj->smai", turn, columns)
        columns[0, :, axis] = np.cross(k, tip - point)
        columns[1, :, axis] = np.cross(k, direction)
    if chain.linkage is not None:
        columns[0, :, :3] = np.einsum("mki,kj->mji", columns[0, :, :3], chain.linkage)
    shape = (*values.shape[:-1], 3, chain.n)
    tip_part, direction_part = np.swapaxes(columns, 2, 3)
    return tip_part.reshape(shape), direction_part.reshape(shape)


def conditions(chain: Chain, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array]:
    """Condition numbers (...) of the linear and of the rotary axes: 1 is best, infinite singular.

    The Jacobian is block triangular, since linear axes never turn the tool: it can be inverted
    exactly when both blocks can, and each block has a condition number without a choice of units.
    Linear: tool tip by the three linear axes. Rotary: tool direction by the rotary axes; next to
    the singular direction it is 1 / sine of the angle between tool and first rotary axis on a
    machine with axes at right angles, and 1 with less than two rotary axes. NaN where an
    axis value that counts is NaN.
    """
    tip, direction = jacobian(chain, axes, tool_length)
    linear = _condition(tip[..., :3], 3)
    rotary = _condition(direction[..., list(chain.rotary)], min(2, len(chain.rotary)))
    return linear, rotary


def _displacements(chain: Chain, rows: Array) -> Array:
    """Travel along the directions of the linear axes: the axis values, or what a linkage makes."""
    if chain.linkage is None or chain.linkage_offset is None:
        return rows
    moved = rows.copy()
    moved[:, :3] = rows[:, :3] @ chain.linkage.T + chain.linkage_offset
    return moved


def _rotations(k: Array, degrees: Array) -> Array:
    """Rotation matrices (m, 3, 3) about the unit vector k (Rodrigues)."""
    angle_rad = np.radians(degrees)[:, None, None]
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1 - np.cos(angle_rad)) * (cross @ cross)


def _condition(matrices: Array, rank: int) -> Array:
    """Largest singular value by the one at place `rank`; 1 for a matrix without columns."""
    shape = matrices.shape[:-2]
    if rank == 0:
        return np.ones(shape)
    usable = np.asarray(np.isfinite(matrices).all(axis=(-2, -1)))
    values = np.linalg.svd(np.where(usable[..., None, None], matrices, 0.0), compute_uv=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = values[..., 0] / values[..., rank - 1]
    singular = values[..., rank - 1] < 1e-12
    return np.where(usable, np.where(singular, np.inf, ratio), np.nan)
