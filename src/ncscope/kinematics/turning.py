"""Compiled loops over rows: tool directions <-> the angles of two rotary axes.

One `OrientationSolver` packs the geometry of its two axes into two small arrays:

frame (3, 3): rows e1, e2, k1: a right-handed frame whose third axis is the first rotary axis.
    Directions are solved in it: there the first axis only turns the first two components.
constants (6, 3):
    0..2  components along e1, e2, k1 of the tool at the second angle t, as factors of
          cos t, sin t and 1
    3     cos^2 and sin^2 of half the difference of the fixed angles, side
    4     cos^2 and sin^2 of half their sum, 1 where only the first angle follows
    5     turning point in degrees, its cosine, its sine
The fixed angles are those between first axis (on the tool's side of it) and second axis, and
between second axis and tool; side is -1 where the first axis points away from the tool.

Method: Paden-Kahan subproblem 2 for directions. Half angles appear as squares only, so that it
stays accurate at both ends of the reach and needs few roots.
"""

from __future__ import annotations

import math

import numpy as np

from ncscope.compilation import compiled
from ncscope.kinematics.kernels import NOT_FINITE, OK, UNREACHABLE, ZERO_VECTOR, sincos_deg

REACH_TOLERANCE_DEG = 1e-4
"""Directions outside the reach by less than the control's angle resolution are clamped (D-2)."""

SINGULAR_SINE = 1e-9
"""Below this sine between tool and first axis the first angle is free and keeps its value (D-4)."""

SNAP_DEG = 1e-9
_SMALLEST_VECTOR = 1e-12
_TOLERANCE_RAD = REACH_TOLERANCE_DEG * math.pi / 180.0
_DEG_PER_RAD = 180.0 / math.pi


@compiled
def wrap_deg(angle):
    """The same angle in (-180, 180]; within 1e-9 of -180 it counts as 180."""
    if -180.0 + SNAP_DEG < angle <= 180.0:
        return angle
    wrapped = angle - 360.0 * np.floor((angle + 180.0) / 360.0)
    return 180.0 if wrapped <= -180.0 + SNAP_DEG else wrapped


@compiled
def tool_in_frame(constants, first, second):
    """Components along e1, e2, k1 of the tool at two angles in degrees."""
    s, c = sincos_deg(second)
    x = c * constants[0, 0] + s * constants[0, 1] + constants[0, 2]
    y = c * constants[1, 0] + s * constants[1, 1] + constants[1, 2]
    z = c * constants[2, 0] + s * constants[2, 1] + constants[2, 2]
    s, c = sincos_deg(first)
    return c * x - s * y, s * x + c * y, z


@compiled
def direction_rows(frame, constants, angles, out):
    """Writes the tool directions (m, 3) for angles (m, 2) in degrees."""
    for row in range(angles.shape[0]):
        x, y, z = tool_in_frame(constants, angles[row, 0], angles[row, 1])
        for i in range(3):
            out[row, i] = frame[0, i] * x + frame[1, i] * y + frame[2, i] * z


@compiled
def turn_rows(program, columns, written, into, constants, rotary, start, pose, axes, status):
    """Writes the rotary columns of `axes` that turn the tool into the programmed directions.

    program (m, k): columns[0..2] hold a vector of any length; with columns[2] < 0 columns[0..1]
        hold angles of the chain whose constants are `written` (a column below 0 counts as 0).
    into (3, 3): from the system of the vector, or from the frame of that chain, to `frame`.
    rotary (2,): where the two angles go, -1 for nowhere.
    start (1, 2) or (m, 2), degrees; pose (1,) or (m,): see `OrientationSolver.solve`.
    """
    keep1, keep2 = wrap_deg(start[0, 0]), wrap_deg(start[0, 1])
    wanted = pose[0]
    for row in range(program.shape[0]):
        if start.shape[0] > 1:
            keep1, keep2 = wrap_deg(start[row, 0]), wrap_deg(start[row, 1])
        if pose.shape[0] > 1:
            wanted = pose[row]
        if columns[2] >= 0:
            x, y, z = program[row, columns[0]], program[row, columns[1]], program[row, columns[2]]
        else:
            a = program[row, columns[0]] if columns[0] >= 0 else 0.0
            b = program[row, columns[1]] if columns[1] >= 0 else 0.0
            x, y, z = tool_in_frame(written, a, b)
        x, y, z = (
            into[0, 0] * x + into[0, 1] * y + into[0, 2] * z,
            into[1, 0] * x + into[1, 1] * y + into[1, 2] * z,
            into[2, 0] * x + into[2, 1] * y + into[2, 2] * z,
        )
        status[row], first, second = _angles(constants, x, y, z, wanted, keep1, keep2)
        if status[row] == OK:
            keep1, keep2 = first, second
        if rotary[0] >= 0:
            axes[row, rotary[0]] = first
        if rotary[1] >= 0:
            axes[row, rotary[1]] = second


@compiled
def _angles(constants, x, y, z, wanted, keep1, keep2):
    """Status and the two angles in degrees for a direction (x, y, z) in the frame."""
    across = x * x + y * y
    length = math.sqrt(across + z * z)
    if not math.isfinite(length):
        return NOT_FINITE, 0.0, 0.0
    if length < _SMALLEST_VECTOR:
        return ZERO_VECTOR, 0.0, 0.0
    z *= constants[3, 2]
    # cos^2 and sin^2 of half the angle to the first axis, both times 2 * length.
    if z >= 0.0:
        cosine = length + z
        sine = across / cosine
    else:
        sine = length - z
        cosine = across / sine
    # Products of sin((phi +- difference)/2) and sin((sum +- phi)/2): negative out of reach.
    near = sine * constants[3, 0] - cosine * constants[3, 1]
    far = cosine * constants[4, 1] - sine * constants[4, 0]
    if constants[4, 2] != 0.0 or near < 0.0 or far < 0.0:
        if _beyond(constants, math.atan2(math.sqrt(across), z)):
            return UNREACHABLE, 0.0, 0.0
        near, far = max(near, 0.0), max(far, 0.0)
    singular = across < SINGULAR_SINE * SINGULAR_SINE * length * length
    if constants[4, 2] != 0.0:
        s, c = sincos_deg(keep2)
        first = keep1 if singular else _first(constants, x, y, c, s, 1.0)
        return OK, first, keep2
    root, rest, total = 2.0 * math.sqrt(near * far), far - near, far + near
    half = _DEG_PER_RAD * math.atan2(root, rest)
    if wanted < 0:
        half, root = -half, -root
    first, second = _solution(constants, x, y, half, root, rest, total, keep1, singular)
    if wanted == 0:
        other1, other2 = _solution(constants, x, y, -half, -root, rest, total, keep1, singular)
        here = abs(wrap_deg(first - keep1)) + abs(wrap_deg(second - keep2))
        if abs(wrap_deg(other1 - keep1)) + abs(wrap_deg(other2 - keep2)) < here:
            return OK, other1, other2
    return OK, first, second


@compiled
def _beyond(constants, phi):
    """Whether an angle in radians to the first axis is outside the reach by more than allowed."""
    difference = 2.0 * math.atan2(math.sqrt(constants[3, 1]), math.sqrt(constants[3, 0]))
    total = 2.0 * math.atan2(math.sqrt(constants[4, 1]), math.sqrt(constants[4, 0]))
    high = min(total, 2.0 * math.pi - total)
    return phi < difference - _TOLERANCE_RAD or phi > high + _TOLERANCE_RAD


@compiled
def _solution(constants, x, y, half, root, rest, total, keep1, singular):
    """Both angles for the half angle whose sine and cosine are root/total and rest/total."""
    second = wrap_deg(constants[5, 0] + half)
    c = constants[5, 1] * rest - constants[5, 2] * root
    s = constants[5, 2] * rest + constants[5, 1] * root
    first = keep1 if singular else _first(constants, x, y, c, s, total)
    return first, second


@compiled
def _first(constants, x, y, c, s, one):
    """First angle from the tool at the second angle (cosine and sine times `one`) to (x, y)."""
    u = c * constants[0, 0] + s * constants[0, 1] + one * constants[0, 2]
    v = c * constants[1, 0] + s * constants[1, 1] + one * constants[1, 2]
    return wrap_deg(_DEG_PER_RAD * math.atan2(u * y - v * x, u * x + v * y))
