"""Laws over random machines, against a physical tree that shares no code with the package."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_machines import Machine, unit

from ncscope.kinematics import KinematicsError, OrientationSolver, UniversalKinematics
from ncscope.kinematics.kernels import OK, SINGULAR, UNREACHABLE, sincos_deg

NAMES = "XYZCBA"


def build(machine: Machine, mode: int, rtcp: int) -> UniversalKinematics:
    names = "XYZUVW" if mode == 10 else NAMES[: machine.n]
    return UniversalKinematics.from_parameters(machine.parameters(mode, rtcp, 1.7), names)


@pytest.mark.parametrize("seed", range(4))
def test_forward_equals_the_physical_tree(seed):
    rng = np.random.default_rng(seed)
    for _ in range(500):
        machine = Machine(rng, int(rng.integers(0, 4)))
        q = np.where(rng.random((2, 6)) < 0.2, 90.0, rng.uniform(-400, 400, (2, 6)))
        length = rng.uniform(-50, 300)
        tip, direction = build(machine, 13, 1).forward(q, length)
        for row in range(2):
            expected = machine.tool_pose(q[row], length)
            np.testing.assert_allclose(tip[row], expected[0], rtol=0, atol=2e-9)
            np.testing.assert_allclose(direction[row], expected[1], rtol=0, atol=1e-12)


@pytest.mark.parametrize("mode", [12, 13, 17])
def test_rtcp_there_and_back(mode):
    rng = np.random.default_rng(mode)
    for _ in range(300):
        machine = Machine(rng, int(rng.integers(0, 4)))
        kin = build(machine, mode, 1)
        program = rng.uniform(-200, 200, (3, machine.n))
        axes, status = kin.inverse_rows(program, 55.0)
        ok = status == OK
        assert ok.all() or set(status) <= {OK, SINGULAR}
        back = kin.program(axes[ok], 55.0)
        np.testing.assert_allclose(back, program[ok], rtol=0, atol=1e-6)
        np.testing.assert_array_equal(axes[:, 3:], program[:, 3:])
        if mode == 12:
            bare, bare_status = kin.inverse_rows(program, 0.0)
            rows = bare_status == OK
            np.testing.assert_allclose(bare[rows], program[rows], rtol=0, atol=1e-6)
        else:
            tip, _ = kin.forward(axes[ok], 55.0)
            np.testing.assert_allclose(tip, program[ok, :3], rtol=0, atol=1e-6)


def test_complete_finds_both_poses_of_every_reachable_direction():
    rng = np.random.default_rng(7)
    for _ in range(400):
        machine = Machine(rng, 2, linear_first=True)
        kin = build(machine, 10, 0)
        axes = np.zeros((4, 6))
        axes[:, :5] = rng.uniform(-180, 180, (4, 5))
        program = kin.program(axes, 70.0)
        pose = kin.pose_of(axes)
        same = kin.inverse(program, 70.0, pose=pose)
        np.testing.assert_allclose(same, axes, rtol=0, atol=1e-5)
        other = kin.inverse(program, 70.0, pose=-pose)
        np.testing.assert_array_equal(kin.pose_of(other), -pose)
        for row in range(4):
            tip, direction = machine.tool_pose(other[row], 70.0)
            np.testing.assert_allclose(tip, program[row, :3], rtol=0, atol=1e-6)
            np.testing.assert_allclose(direction, program[row, 3:6], rtol=0, atol=1e-9)


@pytest.mark.parametrize("mode", range(14, 20))
def test_classic_angles_there_and_back(mode):
    rng = np.random.default_rng(mode)
    machine = Machine(rng, 2, linear_first=True)
    names = {14: "AB", 15: "BA", 16: "AC", 17: "CA", 18: "BC", 19: "CB"}[mode]
    kin = UniversalKinematics.from_parameters(machine.parameters(mode, 0), ["X", "Y", "Z", *names])
    axes = rng.uniform(-179, 179, (200, 5))
    program = kin.program(axes, 33.0, near=axes)
    again = kin.inverse(program, 33.0, pose=kin.pose_of(axes))
    np.testing.assert_allclose(again, axes, rtol=0, atol=1e-6)
    np.testing.assert_allclose(kin.program(axes, 33.0, near=program), program, atol=1e-9)
    _, direction = kin.forward(axes)
    np.testing.assert_allclose(kin.programmed_direction(program), direction, atol=1e-9)


def test_reach_is_exactly_what_turning_the_axes_can_reach():
    rng = np.random.default_rng(5)
    for _ in range(200):
        k1, k2, zero = unit(rng), unit(rng), unit(rng)
        solver = OrientationSolver.from_axes(np.array([k1, k2]), zero)
        k1 = k1 if k1 @ zero >= 0 else -k1
        angles = np.column_stack([np.zeros(721), np.linspace(-180, 180, 721)])
        tilt = np.degrees(np.arccos(np.clip(solver.directions(angles) @ k1, -1, 1)))
        assert tilt.min() == pytest.approx(solver.reach[0], abs=0.3)
        assert tilt.max() == pytest.approx(solver.reach[1], abs=0.3)


@given(st.floats(-720, 720), st.integers(-40, 40))
@settings(max_examples=200, deadline=None)
def test_sine_and_cosine(angle, quarter):
    s, c = sincos_deg(angle)
    assert s == pytest.approx(np.sin(np.radians(angle)), abs=1e-14)
    assert c == pytest.approx(np.cos(np.radians(angle)), abs=1e-14)
    assert sincos_deg(90.0 * quarter) == ((0, 1), (1, 0), (0, -1), (-1, 0))[quarter % 4]


def test_linkage_is_undone():
    machine = Machine(np.random.default_rng(3), 2)
    parameters = machine.parameters(13, 1)
    table = [1, 0, 0, 5000, 0, 0.5, 0.5, -20000, 0, -1, 1, 0]
    for index, value in enumerate([1, *table], start=57):
        parameters = parameters.with_value(index, value)
    kin = UniversalKinematics.from_parameters(parameters, NAMES[:5])
    plain = build(machine, 13, 1)
    q = np.array([10.0, 20, 30, 40, 50])
    u = np.array([10 + 0.5, 25 - 2.0, 10.0, 40, 50])
    np.testing.assert_allclose(kin.forward(q, 9.0)[0], plain.forward(u, 9.0)[0], atol=1e-9)
    np.testing.assert_allclose(kin.inverse(kin.program(q, 9.0), 9.0), q, atol=1e-9)


def test_shapes_and_extra_axes():
    machine = Machine(np.random.default_rng(1), 2, linear_first=True)
    kin = UniversalKinematics.from_parameters(machine.parameters(17, 1), "XYZCAS")
    grid = np.random.default_rng(2).uniform(-90, 90, (2, 3, 6))
    grid.flags.writeable = False
    axes = kin.inverse(grid, 10.0)
    assert axes.shape == (2, 3, 6)
    assert kin.inverse_rows(grid)[1].shape == (2, 3)
    np.testing.assert_array_equal(axes[..., 5], grid[..., 5])
    np.testing.assert_array_equal(kin.inverse(grid[1, 2], 10.0), axes[1, 2])
    assert kin.forward(axes)[0].shape == (2, 3, 3)
    assert kin.inverse(np.zeros((0, 6))).shape == (0, 6)
    with pytest.raises(ValueError, match="at least 5"):
        kin.inverse(np.zeros(4))


def test_rows_without_solution_are_named():
    machine = Machine(np.random.default_rng(1), 1, linear_first=True)
    kin = build(machine, 10, 0)
    axes = np.zeros((4, 6))
    axes[:, 3] = [10, 20, 30, 40]
    program = kin.program(axes, 5.0)
    np.testing.assert_allclose(kin.inverse(program, 5.0), axes, atol=1e-6)
    program[1:3, 3:6] = -program[1:3, 3:6]
    solved, status = kin.inverse_rows(program, 5.0)
    np.testing.assert_array_equal(status, [OK, UNREACHABLE, UNREACHABLE, OK])
    assert np.isnan(solved[1, :3]).all() and np.isfinite(solved[3]).all()
    with pytest.raises(KinematicsError) as caught:
        kin.inverse(program, 5.0)
    assert (caught.value.id, caught.value.rows) == ("292014", (1, 2))
    program[1, 0] = np.nan
    assert kin.inverse_rows(program[1])[1] != OK


def test_free_angle_continues_from_the_row_before():
    rng = np.random.default_rng(1)
    machine = Machine(rng, 2, linear_first=True)
    machine.zero = np.array([0.0, 0, 1])
    machine.table, machine.tool = [], machine.chain
    first, second = (a for a in machine.chain if a >= 3)
    machine.directions[first], machine.directions[second] = [0, 0, 1], [1, 0, 0]
    kin = build(machine, 10, 0)
    program = np.zeros((3, 6))
    program[:, 3:6] = [[0, 0, 1], [1, 0, 1], [0, 0, 1]]
    axes = kin.inverse(program, near=[0, 0, 0, 33, 33])
    np.testing.assert_allclose(axes[:, first], [33, 90, 90])
    np.testing.assert_allclose(axes[:, second], [0, 45, 0], atol=1e-12)


@pytest.mark.parametrize("tilt", [1e-6, 1e-5, 1e-3, 1.0, 90.0, 179.0, 179.9999, 180 - 1e-6])
def test_angles_stay_accurate_near_the_pole(tilt):
    solver = OrientationSolver.from_axes(np.array([[0, 0, 1.0], [1, 0, 0]]), np.array([0, 0, 1.0]))
    direction = solver.directions(np.array([[33.0, tilt]]))
    angles, _ = solver.solve(direction, np.zeros((1, 2)), np.ones(1, np.int8))
    np.testing.assert_allclose(angles, [[33.0, tilt]], rtol=0, atol=1e-10)
