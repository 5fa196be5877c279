"""Derivatives and condition numbers against differences of an independent machine model."""

from __future__ import annotations

import numpy as np
import pytest
from random_machines import Machine

from ncscope.kinematics import UniversalKinematics
from ncscope.kinematics.jacobian import conditions, jacobian
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.poses import poses_of_axes, poses_of_program, poses_of_tool

STEP = 1e-5


def linear_axis(axis: int) -> dict:
    return {"type": 1, "orientation": [float(axis == k) for k in range(3)]}


def head(rtcp: int = 1, mode: int = 17) -> UniversalKinematics:
    """CA head: C about Z, A about X at (0, 20, 0) mm, flange at (10, 0, -30) mm."""
    fields = {
        "zero_orientation": [0, 0, 1],
        "zero_position": [100_000, 0, -300_000],
        "number_of_axes": 5,
        "axis": [
            *(linear_axis(axis) for axis in range(3)),
            {"type": 2, "orientation": [0, 0, 1]},
            {"type": 2, "orientation": [1, 0, 0], "point": [0, 200_000, 0]},
        ],
        "chain": [0, 1, 2, 3, 4],
        "programming_mode": mode,
        "rtcp": rtcp,
    }
    return UniversalKinematics.from_parameters(KinematicParameters.from_fields(fields), "XYZCA")


@pytest.mark.parametrize("rotary", [1, 2, 3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_columns_are_differences_of_a_physical_tree(rotary: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    machine = Machine(rng, rotary)
    chain = UniversalKinematics.from_parameters(
        machine.parameters(mode=13, rtcp=1), [f"X{i}" for i in range(machine.n)]
    ).chain
    q = rng.uniform(-100, 100, machine.n)
    tip, direction = jacobian(chain, q, 50.0)
    for axis in range(machine.n):
        # Lists turn in degrees; the derivative is asked for per radian.
        step = STEP if axis < 3 else np.degrees(STEP)
        up, down = q.copy(), q.copy()
        up[axis] += step
        down[axis] -= step
        (tip_up, d_up), (tip_down, d_down) = (machine.tool_pose(v, 50.0) for v in (up, down))
        assert tip[:, axis] == pytest.approx((tip_up - tip_down) / (2 * STEP), abs=1e-4)
        assert direction[:, axis] == pytest.approx((d_up - d_down) / (2 * STEP), abs=1e-6)


def test_linkage_multiplies_the_linear_columns() -> None:
    # Two parallel drives: X = (x1 + x2) / 2, Z = 0.5 (x1 - x2); the third drive moves Y.
    fields = {
        "zero_orientation": [0, 0, 1],
        "number_of_axes": 3,
        "axis": [linear_axis(axis) for axis in range(3)],
        "chain": [0, 1, 2],
        "programming_mode": 13,
        "rtcp": 1,
        "linkage_mode": 1,
        "linkage": [[0.5, 0.5, 0, 7e4], [0, 0, 1, 0], [0.5, -0.5, 0, 0]],
    }
    parameters = KinematicParameters.from_fields(fields)
    chain = UniversalKinematics.from_parameters(parameters, "XYZ").chain
    tip, _ = jacobian(chain, [1.0, 2.0, 3.0])
    assert tip.tolist() == [[0.5, 0.5, 0], [0, 0, 1], [0.5, -0.5, 0]]
    linear, rotary = conditions(chain, [1.0, 2.0, 3.0])
    # Singular values 1, sqrt(1/2), sqrt(1/2).
    assert linear == pytest.approx(np.sqrt(2))
    assert rotary == 1.0


def test_condition_of_a_head_is_one_by_the_sine_of_the_tilt() -> None:
    tilts = np.array([90.0, 30.0, 1.0, -2.0])
    axes = np.zeros((4, 5))
    axes[:, 4] = tilts
    linear, rotary = conditions(head().chain, axes, 80.0)
    assert linear == pytest.approx(np.ones(4))
    assert rotary == pytest.approx(1 / np.abs(np.sin(np.radians(tilts))))
    assert conditions(head().chain, np.zeros(5))[1] == np.inf
    assert np.isnan(conditions(head().chain, np.full(5, np.nan))[1])


def test_both_poses_reach_the_same_tool() -> None:
    found = poses_of_tool(
        head(), [[10, 20, 30]], [[0.3, -0.4, 0.8]], 60.0, near=[0, 0, 0, 0, -1.0], both=True
    )
    assert found.pose.tolist() == [-1, 1]
    assert found.row.tolist() == [0, 0]
    assert found.tip == pytest.approx(np.array([[10, 20, 30]] * 2))
    assert found.direction == pytest.approx(
        np.array([[0.3, -0.4, 0.8]] * 2) / np.linalg.norm([0.3, -0.4, 0.8])
    )
    # The twins of a head: C turned by half a turn and A with the other sign.
    assert found.axes[0, 4] == pytest.approx(-found.axes[1, 4])
    assert abs(found.axes[0, 3] - found.axes[1, 3]) == pytest.approx(180)


@pytest.mark.parametrize("rtcp", [0, 1])
def test_program_gives_its_pose_and_the_other(rtcp: int) -> None:
    found = poses_of_program(head(rtcp), [[1, 2, 3, 30, 40], [0, 0, 0, -20, -10]], both=True)
    assert found.row.tolist() == [0, 0, 1, 1]
    again = poses_of_axes(head(rtcp), found.axes)
    assert again.tip[0::2] == pytest.approx(again.tip[1::2])
    assert again.direction[0::2] == pytest.approx(again.direction[1::2])
    assert (found.pose[0::2] == -found.pose[1::2]).all()


def test_a_row_without_solution_leaves_the_others_alone() -> None:
    found = poses_of_tool(head(), [[0, 0, 0]] * 3, [[0, 0, 1], [0, 0, 0], [0, 1, 0]])
    assert (found.status != 0).tolist() == [False, True, False]
    assert np.isnan(found.axes[1]).all()
    assert np.isfinite(found.axes[[0, 2]]).all()
