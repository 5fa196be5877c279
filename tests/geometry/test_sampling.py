"""Sampled runs: the chord error really stays below the tolerance, ends stay, and lanes agree.

The error is measured here against paths of this module: linear interpolation of the programmed
values, turned into axes by the kinematics, which has tests of its own.
"""

from pathlib import Path

import numpy as np
import pytest

import ncscope
from ncscope.coordinates import ActiveKinematics, Coordinates
from ncscope.kinematics import UniversalKinematics
from ncscope.kinematics.parameters import field_index
from ncscope.motion.arcs import NO_ARCS
from ncscope.motion.paths import Paths
from ncscope.motion.sampling import sample

MACHINES = Path(__file__).parents[2] / "examples" / "machines"
HEADS = ("ca_head", "cb_head", "ac_table", "compensated_head")
PROGRAM = """#KIN ID [91]
#TRAFO ON
N10 G01 F1000 X50 Y0 Z20 {c}0 {t}0
N20 X0 Y60 {c}90 {t}30
N30 X-80 Y-40 Z-10 {c}200 {t}-25
N40 {c}170 {t}10
N50 X10 Y10 Z10
#TRAFO OFF
M30
"""


def machine_of(name):
    machine = ncscope.load_machine(MACHINES / name)[0]
    return machine, UniversalKinematics.from_parameters(
        machine.kinematic_parameters[91], machine.axis_names, machine.settings.orientation_mode
    )


def run(machine, text, sample, bulk=None):
    return ncscope.run(machine, text, ncscope.Options(sample=sample, bulk=bulk)).check()


def worst_chord_error(kinematics, pcs, acs):
    """The largest deviation between neighbouring rows: of axes, tip on the line, carried tip."""
    worst = 0.0
    for share in np.linspace(0.05, 0.95, 19):
        program = pcs[:-1] + share * np.diff(pcs, axis=0)
        true = kinematics.inverse(program)
        chord = acs[:-1] + share * np.diff(acs, axis=0)
        tips = kinematics.forward(acs)[0]
        line = tips[:-1] + share * np.diff(tips, axis=0)
        tip, carried = kinematics.forward(true)[0], kinematics.forward(chord)[0]
        errors = [true - chord, *(np.linalg.norm(tip - o, axis=1) for o in (line, carried))]
        worst = max(worst, *(float(np.abs(e).max()) for e in errors))
    return worst


@pytest.mark.parametrize("name", HEADS)
@pytest.mark.parametrize("tolerance", [1.0, 0.01])
def test_chord_error_under_a_kinematics(name, tolerance):
    machine, kinematics = machine_of(name)
    first, second = machine.axis_names[3:5]
    text = PROGRAM.format(c=first if first == "C" else second, t=second if first == "C" else first)
    result = run(machine, text, tolerance)
    assert worst_chord_error(kinematics, result.pcs, result.acs) < tolerance
    ends = ncscope.run(machine, text).check()
    assert len(result) > 2 * len(ends)
    for column in ("line", "block", "pcs", "acs", "feed"):
        np.testing.assert_array_equal(getattr(result, column)[result.end], getattr(ends, column))
        np.testing.assert_array_equal(getattr(result.at_ends(), column), getattr(ends, column))
    assert result.at_ends().channels == ends.channels
    assert result.diagnostics == ends.diagnostics


@pytest.mark.parametrize("tolerance", [5.0, 0.1, 0.001])
def test_chord_error_of_arcs(tolerance):
    result = run(
        ncscope.Machine(), "G01 F1 X-30\nG02 X30 I30\nG03 X10 R-70\nG02 I-5 Z8\nM30\n", tolerance
    )
    middles = (result.pcs[1:] + result.pcs[:-1]) / 2
    turned = 2 * np.pi - 2 * np.arcsin(10 / 70)
    for line, radius, angle in ((2, 30, np.pi), (3, 70, turned), (4, 5, 2 * np.pi)):
        own = np.flatnonzero(result.line == line)
        points = result.pcs[own[0] - 1 : own[-1] + 1]
        sagitta = radius - np.linalg.norm(middles[own - 1, :2] - centre_of(points), axis=1)
        assert 0 < sagitta.max() <= tolerance
        few = angle / (2 * np.arccos(1 - tolerance / radius))
        assert len(own) <= max(np.ceil(few) + 1, 4)


def centre_of(points):
    """The centre of the circle through points (k, >=2): equal distances, as linear equations."""
    flat = points[:, :2]
    system = np.column_stack([2 * flat, np.ones(len(flat))])
    return np.linalg.lstsq(system, (flat**2).sum(axis=1), rcond=None)[0][:2]


def test_lanes_agree_on_sampled_programs():
    machine, _ = machine_of("ca_head")
    text = PROGRAM.format(c="C", t="A").replace("M30", "G02 X20 I5\nX30 I5\nG01 X40\nX50\nM30")
    fast, slow = run(machine, text, 0.01, bulk=True), run(machine, text, 0.01, bulk=False)
    assert len(fast) == len(slow)
    for column in ("line", "block", "motion", "end"):
        assert getattr(fast, column).tolist() == getattr(slow, column).tolist()
    np.testing.assert_allclose(fast.acs, slow.acs, atol=1e-12)


def test_straight_moves_need_no_points_without_a_kinematics():
    result = run(ncscope.Machine(), "G01 F1 X1\n#CS ON [0,0,0,10,20,30]\nX100 Y50\nM30\n", 0.01)
    assert result.sampled
    assert result.end.tolist() == [True, True]


def test_an_unsampled_run_has_only_ends_and_no_such_column():
    result = ncscope.run(ncscope.Machine(), "G02 X10 I5 F1\nM30\n").check()
    assert (result.sampled, result.end.tolist()) == (False, [True])
    assert "end" not in result.to_arrow().column_names
    sampled = run(ncscope.Machine(), "G02 X10 I5 F1\nM30\n", 1.0).to_arrow()
    assert sampled.column("end").to_pylist()[-2:] == [False, True]


def complete(name):
    """The coordinates of a head whose programmed angles are a direction in space."""
    machine, _ = machine_of(name)
    held = machine.kinematic_parameters[91]
    index = field_index("RTCP")
    model = UniversalKinematics.from_parameters(held.with_value(index, 0), machine.axis_names)
    return Coordinates(5, kinematics=ActiveKinematics(model))


def test_a_pole_is_passed_with_a_jump_of_one_axis():
    """Complete transformation through the pole: an axis jumps there, the points end nearby."""
    chain = complete("ca_head")
    start, end = np.array([[0.0, 0, 0, 0, 20]]), np.array([[10.0, 0, 0, 0.01, -20]])
    near = chain.to_axes(start[0])
    ends = chain.to_axes(end, near=near)
    points = sample(chain, Paths(start, end, NO_ARCS), ends, near, 0.01)
    assert np.isfinite(points.acs).all()
    assert (np.diff(points.share) > 0).all()
    assert len(points.row) < 3000
    tips = chain.kinematics.model.forward(points.acs)[0]
    np.testing.assert_allclose(tips[:, 0], 10 * points.share, atol=1e-9)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan"), 1e-5])
def test_a_tolerance_below_the_resolution_is_the_callers_mistake(tolerance):
    with pytest.raises(ValueError, match="sample"):
        ncscope.Options(sample=tolerance)


def test_an_arc_with_too_many_points_is_reported():
    text = "G01 F1 X0\nG02 I100000000\nM30\n"
    result = ncscope.run(ncscope.Machine(), text, ncscope.Options(sample=0.0001))
    assert [d.id for d in result.diagnostics] == ["N4004"]
    assert (result.diagnostics[0].line, len(result)) == (2, 100_001)
