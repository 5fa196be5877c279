"""Compiled loops over rows: axis values -> tool, and the linear axes for given rotary axes.

Enters: a machine packed into small arrays (see `Chain`), rows of axis values in mm and degrees.
Leaves: tool tip and tool direction in the workpiece system, or axis values with a status per row.
One source serves one pose and a million. Knows no programming mode and no orientation search.

joints (n, 8), in chain order, the joint next to the workpiece first:
    kind (1 linear, 2 rotary), direction x y z (unit), point x y z (mm), axis index.
flange (2, 3): the unit vector from tool tip to flange, the flange position (mm), all axes at 0.
linkage (3, 4): displacement = linkage[:, :3] @ linear axes + linkage[:, 3].
unlinkage (3, 4): the way back, linear axes = unlinkage[:, :3] @ displacement + unlinkage[:, 3].
Source: FCT-C27 sections 3.1 to 3.4 and 9; P-CHAN-00285..00295.
"""

from __future__ import annotations

import math

import numpy as np

from ncscope.compilation import compiled

OK, SINGULAR, UNREACHABLE, ZERO_VECTOR, NOT_FINITE = 0, 1, 2, 3, 4
"""Status of a row."""

SINGULAR_DETERMINANT = 1e-9
"""Linear axes whose unit directions span less than this do not determine a position."""

_RAD_PER_DEG = math.pi / 180.0
_S6, _C6 = 1.58969099521155010221e-10, -1.13596475577881948265e-11


@compiled
def sincos_deg(angle):
    """Sine and cosine of degrees, exact at every multiple of 90."""
    turns = np.rint(angle / 90.0)
    x = (angle - 90.0 * turns) * _RAD_PER_DEG
    z = x * x
    # Minimax polynomials of fdlibm (k_sin.c, k_cos.c) for |x| <= pi/4, error below one ulp: here
    # they cost a third of two calls into the C library.
    s = z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * _S6))
    s = z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + s))
    s = x + x * z * (-1.66666666666666324348e-01 + s)
    c = z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * _C6))
    c = z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 + c))
    c = 1.0 - (0.5 * z - z * z * (4.16666666666666019037e-02 + c))
    quadrant = turns - 4.0 * np.floor(turns / 4.0)
    if quadrant == 1.0:
        return c, -s
    if quadrant == 2.0:
        return -s, -c
    if quadrant == 3.0:
        return -c, s
    return s, c


@compiled
def rotate(kx, ky, kz, s, c, x, y, z):
    """The vector (x, y, z) turned about the unit vector k, right-hand rule (Rodrigues)."""
    along = (kx * x + ky * y + kz * z) * (1.0 - c)
    return (
        c * x + s * (ky * z - kz * y) + along * kx,
        c * y + s * (kz * x - kx * z) + along * ky,
        c * z + s * (kx * y - ky * x) + along * kz,
    )


@compiled
def forward_rows(joints, flange, linkage, axes, tool_length, tip, direction):
    """Writes tool tip (m, 3) and tool direction (m, 3), workpiece system, for axes (m, >= n).

    The chain is walked from the tool to the workpiece; T(q) = E_chain[0] ... E_chain[n-1].
    """
    for row in range(axes.shape[0]):
        dx, dy, dz = flange[0, 0], flange[0, 1], flange[0, 2]
        x = flange[1, 0] - tool_length * dx
        y = flange[1, 1] - tool_length * dy
        z = flange[1, 2] - tool_length * dz
        for k in range(joints.shape[0] - 1, -1, -1):
            kx, ky, kz = joints[k, 1], joints[k, 2], joints[k, 3]
            axis = int(joints[k, 7])
            if joints[k, 0] == 1.0:
                moved = linkage[axis, 3]
                for j in range(3):
                    moved += linkage[axis, j] * axes[row, j]
                x += moved * kx
                y += moved * ky
                z += moved * kz
            else:
                s, c = sincos_deg(axes[row, axis])
                px, py, pz = joints[k, 4], joints[k, 5], joints[k, 6]
                x, y, z = rotate(kx, ky, kz, s, c, x - px, y - py, z - pz)
                x, y, z = x + px, y + py, z + pz
                dx, dy, dz = rotate(kx, ky, kz, s, c, dx, dy, dz)
        tip[row, 0], tip[row, 1], tip[row, 2] = x, y, z
        direction[row, 0], direction[row, 1], direction[row, 2] = dx, dy, dz


def solve_rows(joints, flange, unlinkage, target, tool_length, axes, status):
    """Writes columns 0..2 of axes (m, >= n) so that the tool tip is at target[:, :3].

    The rotary columns of `axes` are read. Rows that already have a status are left alone except
    that their linear columns become NaN; rows found unsolvable get SINGULAR or NOT_FINITE.
    Exact for every chain order and for skew axes: the tip is linear in the displacements, so
    walking the chain once gives the offset and the three columns of one 3x3 system.
    """
    columns = np.zeros((3, 3))
    _solve_rows(joints, flange, unlinkage, target, tool_length, axes, status, columns)


@compiled
def _solve_rows(joints, flange, unlinkage, target, tool_length, axes, status, columns):
    """`solve_rows`; columns (3, 3): room for the directions of the linear axes."""
    last = joints.shape[0] - 1
    for row in range(axes.shape[0]):
        x = flange[1, 0] - tool_length * flange[0, 0]
        y = flange[1, 1] - tool_length * flange[0, 1]
        z = flange[1, 2] - tool_length * flange[0, 2]
        for k in range(last, -1, -1):
            kx, ky, kz = joints[k, 1], joints[k, 2], joints[k, 3]
            axis = int(joints[k, 7])
            if joints[k, 0] == 1.0:
                columns[axis, 0], columns[axis, 1], columns[axis, 2] = kx, ky, kz
            else:
                s, c = sincos_deg(axes[row, axis])
                px, py, pz = joints[k, 4], joints[k, 5], joints[k, 6]
                x, y, z = rotate(kx, ky, kz, s, c, x - px, y - py, z - pz)
                x, y, z = x + px, y + py, z + pz
                for j in range(k + 1, last + 1):
                    if joints[j, 0] == 1.0:
                        a = int(joints[j, 7])
                        columns[a, 0], columns[a, 1], columns[a, 2] = rotate(
                            kx, ky, kz, s, c, columns[a, 0], columns[a, 1], columns[a, 2]
                        )
        if status[row] == OK:
            x, y, z = target[row, 0] - x, target[row, 1] - y, target[row, 2] - z
            status[row], x, y, z = _solve3(columns, x, y, z)
        if status[row] != OK:
            axes[row, 0], axes[row, 1], axes[row, 2] = np.nan, np.nan, np.nan
            continue
        for i in range(3):
            axes[row, i] = (
                unlinkage[i, 0] * x + unlinkage[i, 1] * y + unlinkage[i, 2] * z + unlinkage[i, 3]
            )


@compiled
def _solve3(columns, x, y, z):
    """Status and the factors of columns[0], columns[1], columns[2] that sum up to (x, y, z)."""
    ax, ay, az = columns[0, 0], columns[0, 1], columns[0, 2]
    bx, by, bz = columns[1, 0], columns[1, 1], columns[1, 2]
    cx, cy, cz = columns[2, 0], columns[2, 1], columns[2, 2]
    ux, uy, uz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
    vx, vy, vz = cy * az - cz * ay, cz * ax - cx * az, cx * ay - cy * ax
    wx, wy, wz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    det = ax * ux + ay * uy + az * uz
    if not math.isfinite(det + x + y + z):
        return NOT_FINITE, x, y, z
    if abs(det) < SINGULAR_DETERMINANT:
        return SINGULAR, x, y, z
    factor = 1.0 / det
    x, y, z = x * factor, y * factor, z * factor
    return (
        OK,
        ux * x + uy * y + uz * z,
        vx * x + vy * y + vz * z,
        wx * x + wy * y + wz * z,
    )
