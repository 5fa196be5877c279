"""FCT-C27 6: measured axis directions and points compensate; compared with a physical tree.

The measured machine is a tree of joints that shares no code with ncscope: the axis values that
come out are put into it, and the tool has to be where the program wants it.
"""

from __future__ import annotations

import copy

import numpy as np
import pytest
from random_machines import Machine, unit

from ncscope.kinematics import KinematicsError, UniversalKinematics
from ncscope.kinematics.comparison import compare

NAMES = "XYZCA"
LENGTH = 70.0


def measured(nominal: Machine, rng: np.random.Generator) -> Machine:
    """The same machine as built: axes out of true by some 0.1 degrees, points by 0.05 mm."""
    real = copy.deepcopy(nominal)
    real.directions = nominal.directions + rng.normal(scale=2e-3, size=nominal.directions.shape)
    real.directions /= np.linalg.norm(real.directions, axis=1)[:, None]
    real.points = nominal.points + rng.normal(scale=0.05, size=nominal.points.shape)
    return real


def kinematics(machine: Machine, rtcp: int) -> UniversalKinematics:
    return UniversalKinematics.from_parameters(machine.parameters(mode=13, rtcp=rtcp), NAMES)


def pair(seed: int, rtcp: int):
    """Nominal and measured machine, and programmed poses that both can reach."""
    rng = np.random.default_rng(seed)
    nominal = Machine(rng, 2, linear_first=True)
    real = measured(nominal, rng)
    a, b = kinematics(nominal, rtcp), kinematics(real, rtcp)
    program = np.column_stack([rng.uniform(-200, 200, (40, 3)), rng.uniform(-150, 150, (40, 2))])
    return nominal, real, a, b, program


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_complete_mode_corrects_all_axes(seed: int) -> None:
    _, real, _, b, program = pair(seed, rtcp=0)
    for row in program:
        # Mode 13 programs the angles of the measured chain; what they ask for comes from the tree.
        wanted = real.tool_pose([0, 0, 0, *row[3:]], 0.0)[1]
        tip, direction = real.tool_pose(b.inverse(row, LENGTH), LENGTH)
        assert tip == pytest.approx(row[:3], abs=1e-9)
        assert direction == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_vector_programs_are_met_in_position_and_direction(seed: int) -> None:
    """Mode 10 says the direction in space, so rotary axes have to move for the compensation."""
    rng = np.random.default_rng(seed)
    # A head with axes at right angles reaches every direction; so does one nearly so, almost.
    nominal = Machine(rng, 2, linear_first=True)
    nominal.zero = np.array([0.0, 0.0, 1.0])
    nominal.directions[3:] = [[0, 0, 1.0], [1.0, 0, 0]]
    nominal.chain, nominal.table, nominal.tool = [0, 1, 2, 3, 4], [], [0, 1, 2, 3, 4]
    real = measured(nominal, rng)
    kin = UniversalKinematics.from_parameters(real.parameters(mode=10, rtcp=0), "XYZUVW")
    ideal = UniversalKinematics.from_parameters(nominal.parameters(mode=10, rtcp=0), "XYZUVW")
    moved = False
    for _ in range(20):
        vector = unit(rng)
        if abs(vector[2]) > 0.95:
            continue
        row = [*rng.uniform(-200, 200, 3), *vector]
        axes = kin.inverse(row, LENGTH, pose=1)
        tip, direction = real.tool_pose(axes, LENGTH)
        assert tip == pytest.approx(row[:3], abs=1e-9)
        assert direction == pytest.approx(vector, abs=1e-9)
        moved |= bool(np.abs(axes - ideal.inverse(row, LENGTH, pose=1))[3:5].max() > 0.01)
    assert moved


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_rtcp_corrects_the_linear_axes_and_leaves_the_angles(seed: int) -> None:
    _, real, _, b, program = pair(seed, rtcp=1)
    for row in program:
        axes = b.inverse(row, LENGTH)
        assert axes[3:] == pytest.approx(row[3:], abs=0)
        assert real.tool_pose(axes, LENGTH)[0] == pytest.approx(row[:3], abs=1e-9)


@pytest.mark.parametrize("seed", [1, 2])
def test_comparison_is_the_error_of_the_tree(seed: int) -> None:
    nominal, real, a, b, program = pair(seed, rtcp=1)
    found = compare(a, b, program, LENGTH)
    tips, angles = [], []
    for row in program:
        axes = a.inverse(row, LENGTH)
        tip, direction = real.tool_pose(axes, LENGTH)
        tips.append(tip - row[:3])
        ideal = nominal.tool_pose(axes, LENGTH)[1]
        angles.append(np.degrees(2 * np.arcsin(np.linalg.norm(direction - ideal) / 2)))
    assert found.tip_before == pytest.approx(np.array(tips), abs=1e-9)
    assert found.angle_before == pytest.approx(np.array(angles), abs=1e-8)
    assert found.tip_after == pytest.approx(np.zeros((40, 3)), abs=1e-9)
    assert found.angle_after == pytest.approx(found.angle_before, abs=1e-9)
    extents = {e.quantity: e for e in found.summary()}
    lengths = np.linalg.norm(tips, axis=1)
    assert extents["tip before"].largest == pytest.approx(lengths.max())
    assert extents["tip before"].rms == pytest.approx(np.sqrt(np.mean(lengths**2)))
    assert extents["tip before"].worst == int(lengths.argmax())
    assert extents["axis C"].largest == 0


def test_the_skewed_x_axis_of_the_document() -> None:
    """X along (0.99953, 0.0002, -0.0004): 1 m of travel is 0.2 mm off in Y and 0.4 in Z."""

    def machine(direction: list[float]) -> UniversalKinematics:
        from ncscope.kinematics import KinematicParameters

        axes = [direction, [0, 1, 0], [0, 0, 1]]
        fields = {
            "zero_orientation": [0, 0, 1],
            "number_of_axes": 3,
            "axis": [{"type": 1, "orientation": v} for v in axes],
            "chain": [0, 1, 2],
            "rtcp": 1,
            "programming_mode": 13,
        }
        return UniversalKinematics.from_parameters(KinematicParameters.from_fields(fields), "XYZ")

    found = compare(machine([1, 0, 0]), machine([0.99953, 0.0002, -0.0004]), [[1000, 0, 0]])
    # Length of the direction 0.9995301; the unit vector is (0.99999990, 0.000200094, -0.000400188).
    assert found.tip_before[0] == pytest.approx([-1.0e-4, 0.200094, -0.400188], abs=1e-6)
    # q = (1000 / 0.9999999, -0.2001, 0.4002): the other axes take the skew out.
    assert found.axes[0] == pytest.approx([1.0e-4, -0.200094, 0.400188], abs=1e-6)
    assert found.tip_after[0] == pytest.approx([0, 0, 0], abs=1e-12)


def test_the_pose_next_to_the_first_machine_is_taken() -> None:
    """At A = 0 a measured head may count axes at 0 to the other pose; C must not turn by 180."""
    rng = np.random.default_rng(5)
    nominal = Machine(rng, 2, linear_first=True)
    nominal.zero = np.array([0.0, 0.0, 1.0])
    nominal.directions = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 1.0], [1, 0, 0]])
    nominal.chain, nominal.table, nominal.tool = [0, 1, 2, 3, 4], [], [0, 1, 2, 3, 4]
    for tilt in (-0.01, 0.01):
        real = copy.deepcopy(nominal)
        real.zero = np.array([0.0, np.sin(np.radians(tilt)), np.cos(np.radians(tilt))])
        a, b = kinematics(nominal, 0), kinematics(real, 0)
        found = compare(a, b, [[0, 0, 0, 20.0, 30.0], [0, 0, 0, -100, 5]], LENGTH)
        assert np.abs(found.axes[:, 3:]).max() < 1


def test_other_axes_are_refused() -> None:
    _, _, a, _, program = pair(1, rtcp=1)
    other = UniversalKinematics.from_parameters(
        Machine(np.random.default_rng(1), 1).parameters(mode=13, rtcp=1), "XYZA"
    )
    with pytest.raises(KinematicsError, match="292040"):
        compare(a, other, program)
