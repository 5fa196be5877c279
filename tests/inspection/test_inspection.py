"""Travel, software limits, swings at the pole and turned-over axes against hand calculations."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import ncscope
from ncscope.cli import app
from ncscope.coordinates import ActiveKinematics, Coordinates
from ncscope.execution import Options
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.pole import Pole
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.machine import Axis, Machine
from ncscope.trajectory import Stretch, Trajectory

AXES = (Axis("X", 1), Axis("Y", 2), Axis("Z", 3), Axis("C", 4, True), Axis("A", 5, True))
HEAD = KinematicParameters.from_fields(
    {
        "zero_orientation": [0, 0, 1],
        "number_of_axes": 5,
        "axis": [
            {"type": 1, "orientation": [1, 0, 0]},
            {"type": 1, "orientation": [0, 1, 0]},
            {"type": 1, "orientation": [0, 0, 1]},
            {"type": 2, "orientation": [0, 0, 1]},
            {"type": 2, "orientation": [1, 0, 0]},
        ],
        "chain": [0, 1, 2, 3, 4],
        "programming_mode": 17,
        "rtcp": 1,
    }
)
"""A head that turns about Z (C) and tilts about X (A): tool at angle |A| from the C axis."""
MACHINE = Machine("head", AXES, kinematic_parameters={91: HEAD})


def limited(**limits: tuple[float, float]) -> Machine:
    return replace(MACHINE, axes=tuple(replace(a, limits=limits.get(a.name)) for a in AXES))


def warnings(result):
    return [(d.id, d.line) for d in result.diagnostics if d.severity == "warning"]


def test_limits_hold_for_axes_and_not_for_the_tip():
    # Tool 100 long and tilted by 90 degrees: the axis stands 100 beside the tip in Y (d = -Y).
    text = (
        "V.G.WZ_AKT.L = 100\n#TRAFO [91]\nG00 X0 Y0 Z0 C0 A0\nG00 A90\nG00 Y60\n#TRAFO OFF\nM30\n"
    )
    result = ncscope.run(limited(Y=(-50.0, 50.0)), text)
    assert result.ok
    assert result.acs[:, 1] == pytest.approx([0, -100, -40], abs=1e-9)
    assert warnings(result) == [("N4101", 4)]
    y = next(t for t in ncscope.inspect(result).travel if t.axis.name == "Y")
    assert (y.low, y.high, y.low_row, y.high_row) == pytest.approx((-100, 0, 1, 0))
    assert y.below.tolist() == [1] and y.above.tolist() == []


def test_an_axis_may_stand_on_its_limit():
    result = ncscope.run(limited(X=(0.0, 10.0)), "G00 X10\nX0\nM30\n")
    assert warnings(result) == []


def test_one_warning_for_each_limit_with_the_number_of_blocks():
    text = "N10 G00 X11\nN20 X5\nN30 X12\nN40 X-3\nN50 X1\nM30\n"
    result = ncscope.run(limited(X=(0.0, 10.0)), text)
    first, second = (d for d in result.diagnostics if d.id == "N4101")
    assert (first.line, first.span.text) == (1, "N10 G00 X11")
    assert "goes to 11 mm" in first.message and "limit 10" in first.message
    assert "2 blocks are beyond it, at most 12" in first.message
    assert (second.line, "2 blocks" in second.message) == (4, False)


@pytest.mark.parametrize("bulk", [True, False])
def test_both_lanes_find_the_same(bulk):
    text = "#TRAFO [91]\nG00 C0 A5\nG01 F100 C180 A0.5\nX20\n#TRAFO OFF\nM30\n"
    result = ncscope.run(limited(X=(0.0, 10.0)), text, Options(bulk=bulk))
    assert warnings(result) == [("N4102", 3), ("N4101", 4)]


def test_strict_counts_a_limit_as_an_error():
    result = ncscope.run(limited(X=(0.0, 10.0)), "G00 X11\nM30\n", Options(strict=True))
    assert not result.ok and len(result) == 1


def test_limits_go_with_the_axis_through_an_axis_exchange():
    far = Axis("Q", 9, limits=(-1.0, 1.0))
    machine = replace(MACHINE, known_axes={9: far})
    text = "G00 X50\n#SET AX [X,9,0][Y,2,1][Z,3,2]\nX5\nM30\n"
    assert warnings(ncscope.run(machine, text)) == [("N4101", 3)]


def test_limit_in_a_subprogram_is_shown_there():
    sub = ncscope.diagnostics.Source("sub.nc", "%sub\nG00 X11\nM17\n")
    result = ncscope.run(limited(X=(0.0, 10.0)), "L sub.nc\nM30\n", Options(load=lambda name: sub))
    (found,) = (d for d in result.diagnostics if d.id == "N4101")
    assert (found.file, found.line) == ("sub.nc", 2)


# --- the pole ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("a", "expected"), [(0, 0), (5, 5), (-30, 30), (90, 90), (150, 30), (180, 0), (360, 0)]
)
def test_pole_distance_of_a_head_is_its_tilt(a, expected):
    pole = Pole.of(UniversalKinematics.from_parameters(HEAD, "XYZCA"))
    assert pole is not None
    assert pole.distance(np.array(float(a))) == pytest.approx(expected, abs=2e-6)


def test_pole_distance_is_the_angle_to_the_first_axis_on_skew_machines():
    rng = np.random.default_rng(7)
    for _ in range(20):
        fields = {f"{k}": v for k, v in {"number_of_axes": 5, "rtcp": 1}.items()}
        turning = rng.normal(size=(2, 3))
        linear = [{"type": 1, "orientation": list(row)} for row in np.eye(3)]
        rotary = [{"type": 2, "orientation": list(row)} for row in turning]
        fields |= {"axis": linear + rotary, "chain": [4, 0, 1, 2, 3]}
        fields["zero_orientation"] = list(rng.normal(size=3))
        model = UniversalKinematics.from_parameters(
            KinematicParameters.from_fields(fields), "XYZBC"
        )
        axes = np.column_stack([np.zeros((9, 3)), rng.uniform(-180, 180, (9, 2))])
        # chain 4 first: that axis is nearest to the workpiece; turning it does not move it.
        first = turning[1] / np.linalg.norm(turning[1])
        expected = np.degrees(np.arccos(np.abs(model.forward(axes)[1] @ first)))
        pole = Pole.of(model)
        assert (pole.first, pole.second) == (4, 3)
        assert pole.distance(axes[:, 3]) == pytest.approx(expected, abs=1e-6)


def test_swing_over_several_blocks_is_one_event():
    # At A = 0.5 a turn of C by 60 degrees changes the direction by about 0.5 degrees.
    text = "#TRAFO [91]\nG00 C0 A0.5\nG01 F100 C60\nC120\nC180\nA20\n#TRAFO OFF\nM30\n"
    result = ncscope.run(MACHINE, text)
    (swing,) = ncscope.inspect(result).swings
    assert (swing.axis, swing.row, swing.last) == ("C", 1, 3)
    assert (swing.distance, swing.swing) == pytest.approx((0.5, 180), abs=1e-6)
    assert warnings(result) == [("N4102", 3)]


def test_crossing_the_pole_in_a_complete_transformation_is_a_swing_however_far_the_tool_tilts():
    """The pose with A >= 0 is kept: from C0 A10 to C0 A-10 the axes go to C180 A10."""
    fields = (
        HEAD if isinstance(HEAD, KinematicParameters) else KinematicParameters.from_fields(HEAD)
    )
    complete = replace(MACHINE, kinematic_parameters={91: fields.with_value(56, 0.0)})
    text = "#TRAFO [91]\nG00 C0 A{}\nG01 F100 C{} A{}\n#TRAFO OFF\nM30\n"
    result = ncscope.run(complete, text.format(10, 0, -10))
    assert abs(result.acs[-1, 3:]).round(6).tolist() == [180, 10]
    (swing,) = ncscope.inspect(result).swings
    assert (swing.axis, swing.row, swing.last) == ("C", 1, 1)
    assert (swing.distance, swing.swing) == pytest.approx((0, 180), abs=1e-5)
    assert warnings(ncscope.run(complete, text.format(0, 120, 40))) == []  # begins on the pole
    assert warnings(ncscope.run(complete, text.format(40, 120, 40))) == []  # far beside the pole


@pytest.mark.parametrize(
    "blocks",
    [
        "G00 C90 A0\nG00 C0",  # turning on the pole itself: asked for
        "G00 C0 A0\nG01 F100 C30 A20",  # leaving the pole
        "G00 C0 A5\nG01 F100 A-5",  # through the pole without turning
        "G00 C0 A30\nG01 F100 C350",  # far from the pole
    ],
)
def test_no_swing(blocks):
    result = ncscope.run(MACHINE, f"#TRAFO [91]\n{blocks}\n#TRAFO OFF\nM30\n")
    assert warnings(result) == []


def test_shortest_distance_on_the_way():
    model = UniversalKinematics.from_parameters(HEAD, "XYZCA")
    pole = Pole.of(model)
    start = np.array([[0, 0, 0, 0, 30], [0, 0, 0, 0, 170], [0, 0, 0, 0, 4.0]])
    end = np.array([[0, 0, 0, 0, -10], [0, 0, 0, 0, 200], [0, 0, 0, 0, 40.0]])
    assert pole.closest(start, end) == pytest.approx([0, 0, 4], abs=2e-6)


def test_complete_transformation_passes_the_pole_on_the_shortest_way():
    # Same tilt on both sides, C turned by 180: the direction goes straight through the pole.
    # C turned by 90 at a tilt of 45: the middle of the arc is arctan(tan 45 cos 45) away.
    model = UniversalKinematics.from_parameters(HEAD.with_value(56, 0), "XYZCA")
    start = np.array([[0, 0, 0, 0, 5.0], [0, 0, 0, 0, 45.0]])
    end = np.array([[0, 0, 0, 180, 5.0], [0, 0, 0, 90, 45.0]])
    middle = np.degrees(np.arctan(np.cos(np.radians(45))))
    assert Pole.of(model).closest(start, end) == pytest.approx([0, middle], abs=1e-6)


def complete_run(c: list[float], axis: Axis) -> Trajectory:
    """A trajectory under the complete transformation with these positions of C, A at 40."""
    model = UniversalKinematics.from_parameters(HEAD.with_value(56, 0), "XYZCA")
    acs = np.array([[0, 0, 0, value, 40.0] for value in c])
    n = len(c) - 1
    stretch = Stretch(
        Coordinates(5, kinematics=ActiveKinematics(model, 1)), tuple("XYZCA"), "main.nc",
        np.arange(1, n + 1), np.full(n, -1), np.ones(n, np.int8), np.full(n, 100.0),
        acs[1:], acs[1:], acs[0],
    )  # fmt: skip
    axes = (*AXES[:3], axis, AXES[4])
    return Trajectory((stretch,), tuple("XYZCA"), channels=((0, axes),))


def test_a_computed_angle_that_turns_over():
    # From 170 on to 190, which is shown as -170; 10 to -10 is a short way.
    run = complete_run([170, -170, 10, -10, 175, -175], AXES[3])
    found = ncscope.inspect(run)
    assert [(w.row, w.before, w.after) for w in found.wraps] == [
        (0, 170, -170), (3, -10, 175), (4, 175, -175)
    ]  # fmt: skip
    # At A = 40 the shortest way of the direction from C 10 to C -170 leads over the pole.
    warning, swing = found.diagnostics()
    assert warning.id == "N4103" and "3 times" in warning.message and swing.id == "N4102"


def test_a_modulo_axis_takes_the_short_way():
    axis = replace(AXES[3], modulo_range=(0.0, 360.0))
    found = ncscope.inspect(complete_run([170, -170], axis))
    assert len(found.wraps) == 1 and found.diagnostics() == ()


def test_machines_without_a_pole():
    text = "G00 X1 A90\nM30\n"
    found = ncscope.inspect(ncscope.run(MACHINE, text))
    assert np.isnan(found.pole_distance).all() and found.swings == ()
    assert Pole.of(UniversalKinematics.from_parameters(HEAD.with_value(6, 4), "XYZCA")) is None


def test_a_run_without_moves():
    found = ncscope.inspect(ncscope.run(MACHINE, "M30\n"))
    assert (found.travel, found.swings, found.wraps, len(found.pole_distance)) == ((), (), (), 0)


# --- arcs --------------------------------------------------------------------------------------


def test_a_circle_bulges_over_a_limit_between_its_ends():
    # Half a circle about (0, 0) with radius 10, from -X over +Y to +X: Y reaches 10 in the middle.
    text = "G00 X-10 Y0\nN20 G02 X10 Y0 I10 J0 F100\nM30\n"
    result = ncscope.run(limited(Y=(-1.0, 9.5)), text)
    (found,) = (d for d in result.diagnostics if d.id == "N4101")
    assert found.line == 2 and "goes to 10 mm" in found.message
    y = next(t for t in ncscope.inspect(result).travel if t.axis.name == "Y")
    assert (y.low, y.high, y.high_row) == pytest.approx((0, 10, 1)) and y.above.tolist() == [1]
    inside = ncscope.run(limited(Y=(-1.0, 10.0), X=(-10.0, 10.0)), text)
    assert warnings(inside) == []


@pytest.mark.parametrize("sample", [None, 0.01])
def test_a_circle_in_a_turned_system(sample):
    # Full circle, radius 5, about (5, 0) in a system turned by 30 degrees: the centre stands at
    # (5 cos 30, 5 sin 30), and X and Y reach 5 to each side of it.
    text = "#CS ON [0,0,0,0,0,30]\nG00 X0 Y0\nG02 X0 Y0 I5 J0 F100\n#CS OFF\nM30\n"
    result = ncscope.run(limited(X=(-5.0, 9.0)), text, Options(sample=sample))
    x, y = (t for t in ncscope.inspect(result).travel if t.axis.name in "XY")
    cx, cy = 5 * np.cos(np.radians(30)), 2.5
    assert (x.low, x.high) == pytest.approx((cx - 5, cx + 5), abs=1e-9)
    assert (y.low, y.high) == pytest.approx((cy - 5, cy + 5), abs=1e-9)
    assert warnings(result) == [("N4101", 3)]
    assert "blocks" not in next(d for d in result.diagnostics if d.id == "N4101").message


@pytest.mark.parametrize("rise", [10.0, -12.0, 200.0])
def test_a_helix_whose_axis_is_tilted(rise):
    # One turn of radius 10 about (-10, 0) in a system tilted by 30 degrees about X: at the angle t
    # Y stands at 10 sin(t) cos(30) - rise t / 360 sin(30). It turns back where the derivative is
    # 0: cos(t) = rise tan(30) / (20 pi), which is never so for a rise of 200.
    text = f"#CS ON [0,0,0,30,0,0]\nG00 X0 Y0 Z0\nG03 I-10 Z{rise:g} F100\n#CS OFF\nM30\n"
    y = next(t for t in ncscope.inspect(ncscope.run(MACHINE, text)).travel if t.axis.name == "Y")
    cosine, reached = rise * np.tan(np.radians(30)) / (20 * np.pi), [0.0, -rise / 2]
    if abs(cosine) < 1:
        for t in (np.arccos(cosine), 2 * np.pi - np.arccos(cosine)):
            reached.append(10 * np.sin(t) * np.sqrt(3) / 2 - rise * t / (4 * np.pi))
    assert (y.low, y.high) == pytest.approx((min(reached), max(reached)), abs=1e-9)


def test_an_arc_under_a_transformation():
    text = "#TRAFO [91]\nG00 X-10 Y0 C0 A0\nG02 X10 Y0 I10 J0 F100\n#TRAFO OFF\nM30\n"
    result = ncscope.run(limited(Y=(-1.0, 9.5)), text)
    assert warnings(result) == [("N4101", 3)]


def test_a_quarter_that_does_not_reach_the_limit():
    # From (0, -10) to (10, 0) counter-clockwise: Y is never above 0 and X never below 0.
    text = "G00 X0 Y-10\nG03 X10 Y0 I0 J10 F100\nM30\n"
    result = ncscope.run(limited(Y=(-10.0, 0.0), X=(0.0, 10.0)), text)
    assert warnings(result) == []


def bulge(share, way, turn):
    """X of the head with a tool 100 long that lies flat: tip X plus 100 sin(C)."""
    return way * share + 100.0 * np.sin(np.radians(turn) * share)


@pytest.mark.parametrize(("way", "turn"), [(-30.0, 100.0), (-90.0, 60.0), (0.0, 720.0)])
@pytest.mark.parametrize("bulk", [True, False])
def test_limits_between_the_ends_of_a_block(way: float, turn: float, bulk: bool):
    highest = bulge(np.linspace(0.0, 1.0, 100_001), way, turn).max()
    text = (
        f"V.G.WZ_AKT.L = 100\n#TRAFO [91]\nG00 X0 C0 A90\nG01 F1 X{way} C{turn}\n#TRAFO OFF\nM30\n"
    )
    below, above = limited(X=(-1e4, highest - 0.01)), limited(X=(-1e4, highest + 0.01))
    found = ncscope.run(below, text, options=Options(bulk=bulk))
    assert warnings(found) == [("N4101", 4)]
    x = next(t for t in ncscope.inspect(found).travel if t.axis.name == "X")
    assert x.high == pytest.approx(highest, abs=1e-3) and set(x.above) == {1}
    assert warnings(ncscope.run(above, text, options=Options(bulk=bulk))) == []
    sampled = ncscope.run(below, text, options=Options(sample=1.0))
    assert warnings(sampled) == [("N4101", 4)]


def test_bulges_are_not_looked_for_where_axes_go_straight():
    text = "V.G.WZ_AKT.L = 100\n#TRAFO [91]\nG00 X0 C0 A90\n#PTP ON\nG01 F1 C180\n#PTP OFF\nM30\n"
    assert warnings(ncscope.run(limited(X=(-50.0, 50.0)), text))[:1] != [("N4101", 5)]
    text = "G00 X0 C0 A90\nG01 F1 X40 C180\nX-40 C0\nM30\n"
    assert warnings(ncscope.run(limited(X=(-41.0, 41.0)), text)) == []


def test_a_complete_transformation_turns_in_a_plane_between_the_ends():
    # The tool goes from direction +X to -X over +Z: the tip stays at 0 and axis Z goes from 0 to
    # 100 and back (L = 100). Turning C by 180 degrees instead would leave Z at 0.
    whole = replace(MACHINE, kinematic_parameters={91: HEAD.with_value(56, 0)})
    text = "V.G.WZ_AKT.L = 100\n#TRAFO [91]\nG00 X0 Y0 Z0 C90 A89\nG01 F1 A-89\n#TRAFO OFF\nM30\n"
    axes = tuple(replace(a, limits=(-150.0, 99.0) if a.name == "Z" else None) for a in AXES)
    result = ncscope.run(replace(whole, axes=axes), text)
    assert [w for w in warnings(result) if w[0] == "N4101"] == [("N4101", 4)]
    z = next(t for t in ncscope.inspect(result).travel if t.axis.name == "Z")
    assert z.high == pytest.approx(100.0, abs=1e-3)


def test_a_swing_over_several_blocks_says_so():
    # RTCP, A stays at 3 degrees: C turns 180 degrees in each of two blocks.
    text = "#TRAFO [91]\nG00 X0 C0 A3.1\nG01 F1 C180 A3\nC360 A3.1\n#TRAFO OFF\nM30\n"
    (found,) = [d for d in ncscope.run(MACHINE, text).diagnostics if d.id == "N4102"]
    assert found.line == 3 and "swings by 360.0 degrees in 2 blocks while" in found.message


@pytest.mark.parametrize("command", [["check"], ["run"], ["run", "--out", "p.csv"]])
def test_check_and_run_say_where_the_tool_is_nearest_to_the_pole(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("p.nc").write_text("#TRAFO [91]\nG00 X0 C0 A30\nG01 F1 A-12.5\nA40\n#TRAFO OFF\nM30\n")
    machine = Path(__file__).parents[2] / "examples" / "machines" / "kin9_head"
    done = CliRunner().invoke(app, [*command, "p.nc", "--machine", str(machine)])
    said = done.stderr + done.stdout
    assert "p.nc:3:1: note N4104: the tool comes nearest" in said and "here: 12.5000 deg" in said
    Path("p.nc").write_text("G00 X0\nM30\n")
    assert "N4104" not in CliRunner().invoke(app, [*command, "p.nc"]).stderr
