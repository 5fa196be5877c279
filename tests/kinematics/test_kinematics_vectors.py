"""The oracle file: expected axis values from an independent method, plus faults and poses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from ncscope.kinematics import (
    FIELD_OF_INDEX,
    Chain,
    KinematicParameters,
    KinematicsError,
    OrientationSolver,
    UniversalKinematics,
    validate,
)

DATA = json.loads((Path(__file__).parents[1] / "data" / "kinematics.json").read_text())
TOLERANCE = DATA["tolerance"]


def machine(name: str) -> UniversalKinematics:
    entry = DATA["machines"][name]
    parameters = KinematicParameters.from_fields(entry["param"])
    return UniversalKinematics.from_parameters(parameters, entry["channel_axes"])


def parametrise(group: str):
    return pytest.mark.parametrize("case", DATA[group], ids=lambda c: c.get("id", c.get("machine")))


def solve(kin: UniversalKinematics, case: dict, pose: int | None) -> np.ndarray:
    """Axis values of a vector; a coordinate system moves X, Y, Z and maybe the direction."""
    program = np.array(case["pcs"])
    turn = None
    if "cs" in case:
        rotation = np.array(case["cs"]["R"])
        turn = rotation if case["cs"]["ori_wcs"] else None
        program[:3] = rotation @ program[:3] + case["cs"]["t"]
    near = case.get("prev_acs")
    return kin.inverse(program, case["tool_length_mm"], near=near, pose=pose, turn=turn)


@parametrise("vectors")
def test_program_to_axes(case):
    kin = machine(case["machine"])
    axes = solve(kin, case, case.get("pose"))
    n = len(case["acs"])
    np.testing.assert_allclose(axes[:n], case["acs"], rtol=0, atol=TOLERANCE)
    assert not axes[n:].any()
    if "acs_other_pose" in case:
        other = solve(kin, case, -case["pose"])
        np.testing.assert_allclose(other[:n], case["acs_other_pose"], rtol=0, atol=TOLERANCE)


@parametrise("vectors")
def test_axes_to_tool_and_back_to_program(case):
    kin = machine(case["machine"])
    length = case["tool_length_mm"]
    axes = np.zeros(len(kin.axis_names))
    axes[: len(case["acs"])] = case["acs"]
    tip, direction = kin.forward(axes, length)
    np.testing.assert_allclose(tip, case["tcp"], rtol=0, atol=TOLERANCE)
    np.testing.assert_allclose(direction, case["orientation"], rtol=0, atol=TOLERANCE)
    program = kin.program(axes, length, near=case["pcs"])
    again = kin.inverse(program, length, near=axes)
    np.testing.assert_allclose(again, axes, rtol=0, atol=1e-7 if kin.mode == 10 else TOLERANCE)
    if "cs" not in case and kin.mode != 10 and kin.rtcp:
        np.testing.assert_allclose(program, case["pcs"], rtol=0, atol=TOLERANCE)


@parametrise("vectors")
def test_programmed_direction(case):
    if "programming_chain_orientation" in case and not machine(case["machine"]).rtcp:
        direction = machine(case["machine"]).programmed_direction(case["pcs"])
        np.testing.assert_allclose(direction, case["programming_chain_orientation"], atol=1e-12)


@parametrise("errors")
def test_errors(case):
    parameters = KinematicParameters.from_fields(case["param"])
    faults = validate(parameters, len(case["channel_axes"]), axis_names=case["channel_axes"])
    if faults:
        assert {fault.id for fault in faults} == {str(case["error"])}
        return
    kin = UniversalKinematics.from_parameters(parameters, case["channel_axes"])
    with pytest.raises(KinematicsError) as caught:
        kin.inverse(case["pcs"], case["tool_length_mm"])
    assert caught.value.id == str(case["error"])
    assert caught.value.rows == (0,)


@parametrise("pose_at_selection")
def test_pose_at_selection(case):
    if case["machine"] not in DATA["machines"]:
        if not case["machine"].startswith("head45"):
            pytest.skip("the data file does not describe this machine")
        slant = np.sqrt(0.5)
        solver = OrientationSolver.from_axes(
            np.array([[0, 0, 1.0], [0, slant, slant]]), np.array([0, 0, 1.0])
        )
    else:
        solver = machine(case["machine"]).rotary_solver
    angles = np.array([case["acs_rotary_by_index_3_4"]], float)
    assert solver.pose_of(angles)[0] == case["pose"]
    assert solver.turning_point == pytest.approx(case["th2_star_deg"], abs=1e-9)
    assert solver.reach == pytest.approx(tuple(case["reach_deg"]), abs=1e-9)


def test_parameter_map_is_ours():
    assert {int(k): v for k, v in DATA["param_map"].items()}.items() <= FIELD_OF_INDEX.items()


def test_lists_are_in_tenths_of_a_micrometre():
    chain = Chain.from_parameters(
        KinematicParameters.from_fields(DATA["machines"]["fct_c27_8_KIN9_sim"]["param"])
    )
    np.testing.assert_allclose(chain.zero_position, [5.4, -39.5, -95.0])
    np.testing.assert_allclose(chain.points[4], [0, 16.5, -70.0])
