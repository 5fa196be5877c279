"""20,000 machines and poses against plain 4x4 matrices with scipy's rotations.

The model here is the physical machine: a table branch and a tool branch from the machine base,
each axis with its physical direction, inv(W) @ T. It shares no code with the package, and it only
ever goes forward: what the package solves is put back into it. Agreement: 1e-9 mm.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from random_machines import Machine
from scipy.spatial.transform import Rotation

from ncscope.kinematics import UniversalKinematics
from ncscope.kinematics.kernels import OK, SINGULAR

MACHINES, POSES = 200, 10
"""For each of the eleven cases below."""
AGREEMENT = 1e-9


def branch(machine: Machine, indices, q: np.ndarray) -> np.ndarray:
    """Product (m, 4, 4) of the axes, the one at the machine base first."""
    out = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    for axis in indices:
        step = np.broadcast_to(np.eye(4), (len(q), 4, 4)).copy()
        direction, point = machine.directions[axis], machine.points[axis]
        if axis < 3:
            step[:, :3, 3] = q[:, axis, None] * direction
        else:
            turn = Rotation.from_rotvec(np.radians(q[:, axis, None]) * direction).as_matrix()
            step[:, :3, :3] = turn
            step[:, :3, 3] = point - turn @ point
        out = out @ step
    return out


def tool(machine: Machine, q: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray]:
    """Tool tip (m, 3) and direction (m, 3) in the workpiece system."""
    pose = np.linalg.inv(branch(machine, machine.table, q)) @ branch(machine, machine.tool, q)
    tip = machine.flange - length * machine.zero
    return (pose @ [*tip, 1.0])[:, :3], pose[:, :3, :3] @ machine.zero


def classic_angles(letters: str, d: np.ndarray) -> np.ndarray:
    """Angles (m, 2) of directions (m, 3); from the table of directions of modes 14 to 19.

    The zero direction is that of the first letter, so the second angle tilts away from it.
    """
    first, second = ("ABC".index(letter) for letter in letters)
    third = 3 - first - second
    sign = 1.0 if (second - first) % 3 == 1 else -1.0  # whether first, second, third is cyclic
    tilt = np.arccos(np.clip(d[:, first], -1, 1))
    # A turn by +tilt about the second axis takes `first` towards -sign times `third`.
    across = np.arctan2(d[:, second], -sign * d[:, third])
    return np.degrees(np.column_stack([across, tilt]))


@pytest.mark.parametrize(
    ("letters", "row"),
    [
        ("AB", lambda s1, c1, s2, c2: (c2, s1 * s2, -c1 * s2)),
        ("BA", lambda s1, c1, s2, c2: (s1 * s2, c2, c1 * s2)),
        ("AC", lambda s1, c1, s2, c2: (c2, c1 * s2, s1 * s2)),
        ("CA", lambda s1, c1, s2, c2: (s1 * s2, -c1 * s2, c2)),
        ("BC", lambda s1, c1, s2, c2: (-c1 * s2, c2, s1 * s2)),
        ("CB", lambda s1, c1, s2, c2: (c1 * s2, s1 * s2, c2)),
    ],
)
def test_classic_angles_of_this_model(letters, row):
    """The directions that the manual tabulates for the six modes."""
    s1, c1, s2, c2 = 0.6, 0.8, np.sin(0.4), np.cos(0.4)
    expected = [np.degrees(np.arcsin(s1)), np.degrees(0.4)]
    found = classic_angles(letters, np.array([row(s1, c1, s2, c2)]))
    np.testing.assert_allclose(found, [expected], atol=1e-9)


def as_vector(machine, q, tip, d):
    program = np.zeros((len(q), 6))
    program[:, :3], program[:, 3:] = tip, d * 3.7
    return program


def as_angles(letters, machine, q, tip, d):
    return np.column_stack([tip, classic_angles(letters, d), np.zeros(len(q))])


def as_axis_angles(machine, q, tip, d):
    return np.column_stack([tip, q[:, 3:]])


def as_axes(machine, q, tip, d):
    return np.array(q)


def names_of(mode: int) -> str:
    letters = {14: "AB", 15: "BA", 16: "AC", 17: "CA", 18: "BC", 19: "CB"}.get(mode, "")
    return "XYZUVW" if mode == 10 else f"XYZ{letters or 'CA'}S"


CLASSIC = {14: "AB", 15: "BA", 16: "AC", 17: "CA", 18: "BC", 19: "CB"}
COMPLETE = [
    (10, as_vector),
    (12, as_axes),
    (13, as_axis_angles),
    *((mode, partial(as_angles, letters)) for mode, letters in CLASSIC.items()),
]


@pytest.mark.parametrize(
    ("mode", "written"), COMPLETE, ids=lambda v: v if isinstance(v, int) else ""
)
def test_complete_transformation(mode, written):
    """Directions that the machine itself makes, with 1 or 2 rotary axes and in both poses.

    In mode 12 the program has axis values of the machine with tool length 0.
    """
    rng = np.random.default_rng(mode)
    for count in range(MACHINES):
        rotary = 1 if count % 5 == 0 else 2
        machine = Machine(rng, rotary)
        kin = UniversalKinematics.from_parameters(machine.parameters(mode, 0, 1.3), names_of(mode))
        q = np.zeros((POSES, 6))
        q[:, :3] = rng.uniform(-1000, 1000, (POSES, 3))
        q[:, 3 : 3 + rotary] = rng.uniform(-180, 180, (POSES, rotary))
        length = rng.uniform(0, 300)
        tip, d = tool(machine, q, 0.0 if mode == 12 else length)
        program = written(machine, q, tip, d)
        pose = kin.pose_of(q)
        for wanted in (pose, -pose) if rotary == 2 else (pose,):
            axes, status = kin.inverse_rows(program, length, near=q, pose=wanted)
            assert set(status) <= {OK, SINGULAR}
            good = status == OK
            assert good.mean() > 0.8
            got_tip, got_d = tool(machine, axes[good], length)
            assert (np.abs(got_tip - tip[good]) <= AGREEMENT).all()
            np.testing.assert_allclose(got_d, d[good], rtol=0, atol=AGREEMENT)
            if rotary == 2:
                np.testing.assert_array_equal(kin.pose_of(axes[good]), wanted[good])


@pytest.mark.parametrize("mode", [12, 17])
def test_rtcp(mode):
    """Any programmed values, with 0 to 3 rotary axes; mode 12 positions through the chain."""
    rng = np.random.default_rng(100 + mode)
    for count in range(MACHINES):
        machine = Machine(rng, count % 4)
        kin = UniversalKinematics.from_parameters(machine.parameters(mode, 1, 0.7), "XYZABC")
        program = np.zeros((POSES, 6))
        program[:, :3] = rng.uniform(-1000, 1000, (POSES, 3))
        program[:, 3 : machine.n] = rng.uniform(-720, 720, (POSES, machine.n - 3))
        length = rng.uniform(0, 300)
        axes, status = kin.inverse_rows(program, length)
        good = status == OK
        assert set(status) <= {OK, SINGULAR} and good.mean() > 0.8
        asked = tool(machine, program, 0.0)[0] if mode == 12 else program[:, :3]
        tip, d = tool(machine, axes[good], length)
        assert (np.abs(tip - asked[good]) <= AGREEMENT).all()
        np.testing.assert_array_equal(axes[:, 3:], program[:, 3:])
        got_tip, got_d = kin.forward(axes[good], length)
        assert (np.abs(got_tip - tip) <= AGREEMENT).all()
        np.testing.assert_allclose(got_d, d, rtol=0, atol=1e-12)


def test_misaligned_axes_are_compensated_in_both_kinds():
    """A machine measured 0.1 degrees off, programmed as if it were straight: the tip is there."""
    rng = np.random.default_rng(6)
    for _ in range(50):
        machine = Machine(rng, 2, linear_first=True)
        straight = np.vstack([np.eye(3), [[0, 0, 1.0], [1.0, 0, 0]]])
        machine.directions = straight + rng.uniform(-2e-3, 2e-3, (5, 3))
        machine.directions /= np.linalg.norm(machine.directions, axis=1)[:, None]
        machine.zero = np.array([0, 0, 1.0])
        machine.chain, machine.table, machine.tool = [0, 1, 2, 3, 4], [], [0, 1, 2, 3, 4]
        kin = UniversalKinematics.from_parameters(machine.parameters(17, 0), "XYZCA")
        angles = np.column_stack([rng.uniform(-170, 170, 20), rng.uniform(5, 80, 20)])
        program = np.column_stack([rng.uniform(-500, 500, (20, 3)), angles])
        axes = kin.inverse(program, 100.0, pose=1)
        tip, d = tool(machine, axes, 100.0)
        c, a = np.radians(angles).T
        asked = np.column_stack([np.sin(c) * np.sin(a), -np.cos(c) * np.sin(a), np.cos(a)])
        np.testing.assert_allclose(tip, program[:, :3], rtol=0, atol=1e-9)
        np.testing.assert_allclose(d, asked, rtol=0, atol=1e-9)
        assert np.abs(axes[:, 3:] - angles).max() < 5 and np.abs(axes[:, 3:] - angles).max() > 1e-3
