"""#KIN ID, #TRAFO, #TRAFO PCS, #PTP and tools under a transformation, one rule a test.

The head used here turns C, then A, about the tool tip's flange at 0: tip = q - L d with
d = (sinC sinA, -cosC sinA, cosA), so the axes stand at q = p + L d.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

import ncscope
from ncscope.kinematics import KinematicParameters
from ncscope.machine import Axis, ChannelSettings, Machine, Tool

LINEAR = [{"type": 1, "orientation": list(row)} for row in np.eye(3)]
HEAD = {
    "zero_orientation": [0, 0, 1],
    "number_of_axes": 5,
    "axis": [
        *LINEAR,
        {"type": 2, "orientation": [0, 0, 1]},
        {"type": 2, "orientation": [1, 0, 0]},
    ],
    "chain": [0, 1, 2, 3, 4],
    "programming_mode": 17,
    "rtcp": 1,
}
SKEW = {  # p = x (1, 1, 0) / sqrt(2) + y Y + z Z, so x = sqrt(2) px and y = py - px
    "zero_orientation": [0, 0, 1],
    "number_of_axes": 3,
    "axis": [{"type": 1, "orientation": [1, 1, 0]}, *LINEAR[1:]],
    "chain": [0, 1, 2],
    "programming_mode": 17,
    "rtcp": 1,
}
COMPLETE = HEAD | {"rtcp": 0}
ROOT = np.sqrt(2)


def axes(names: str) -> tuple[Axis, ...]:
    return tuple(Axis(name, i + 1, rotary=name in "ABC") for i, name in enumerate(names))


def machine(fields=HEAD, names="XYZCA", second=None, **more) -> Machine:
    sets = {91: KinematicParameters.from_fields(fields)}
    others = {51: replace(KinematicParameters.from_fields(second), id=51)} if second else {}
    return Machine(
        axes=axes(names), kinematic_parameters=sets, second_step_parameters=others, **more
    )


def run(text: str, on: Machine | None = None):
    return ncscope.run(on or machine(), text + "\nM30\n")


def positions(text: str, on: Machine | None = None):
    result = run("#KIN ID [91]\n" + text, on)
    errors = [ncscope.render(d) for d in result.diagnostics if d.is_error]
    assert not errors, errors
    return (result.acs + 0.0).round(9).tolist()


def errors(text: str, on: Machine | None = None):
    result = run("#KIN ID [91]\n" + text, on)
    return [(d.id, d.line, d.column) for d in result.diagnostics if d.is_error]


# --- complete transformation ---------------------------------------------------------------------


def test_trafo_on_moves_nothing_and_shows_the_direction():
    """A-30 C0 is the other pose of C180 A30; mode CA names the nearest pair, which is the same."""
    result = run("#KIN ID [91]\nA-30\n#TRAFO ON\nG91 X0\n", machine(COMPLETE))
    np.testing.assert_allclose(result.acs[1], result.acs[0], atol=1e-12)
    np.testing.assert_allclose(result.pcs[1], [0, 0, 0, 0, -30], atol=1e-12)


def test_pose_is_that_of_the_axes_at_trafo_on_and_stays():
    """In the pose with A below 0 the direction of C0 A45 is reached with C180 A-45."""
    rows = positions(
        "V.G.WZ_AKT.L=10\nA-1\n#TRAFO ON\nX0 Y0 Z0 C0 A45\nC0 A0\nC0 A45", machine(COMPLETE)
    )
    s = round(10 * np.sin(np.radians(45)), 9)
    assert rows[1] == [0, -s, s, 180, -45]
    assert rows[2] == [0, 0, 10, 180, 0]
    assert rows[3] == rows[1]


def test_pose_survives_mcs_and_ends_with_trafo_off():
    text = "A-1\n#TRAFO ON\n#MCS ON\nA50\n#MCS OFF\nC0 A45\n#TRAFO OFF\nC0 A1\n#TRAFO ON\nC0 A45"
    rows = positions(text, machine(COMPLETE))
    assert rows[2][3:] == [180, -45] and rows[4][3:] == [0, 45]


def test_a_free_axis_keeps_its_place_in_the_range():
    """D-4 and the range (-180, 180]: C at 215 is the same as C at -145."""
    rows = positions("C215 A10\n#TRAFO ON\nC0 A0\nC7", machine(COMPLETE))
    assert rows[1][3:] == [-145, 0] and rows[2][3:] == [-145, 0]


def test_words_that_mean_the_same_direction_stay_as_written():
    text = "#KIN ID [91]\nA10\n#TRAFO ON\nC200 A30\n#CS ON [1,2,3]\nG91 C10\n"
    result = run(text, machine(COMPLETE))
    np.testing.assert_allclose(result.pcs[-1, 3:], [210, 30], atol=1e-9)
    np.testing.assert_allclose(result.acs[-1, 3:], [-150, 30], atol=1e-9)


def test_a_modulo_range_does_not_limit_an_angle_in_space():
    own = machine(COMPLETE)
    turning = replace(own.axes[3], modulo_range=(0.0, 360.0))
    own = replace(own, axes=(*own.axes[:3], turning, own.axes[4]))
    result = run("#KIN ID [91]\nA10\n#TRAFO ON\nC-30 A20", own)
    np.testing.assert_allclose(result.pcs[-1, 3:], [-30, 20], atol=1e-9)
    np.testing.assert_allclose(result.acs[-1, 3:], [330, 20], atol=1e-9)


@pytest.mark.parametrize(("turns", "expected"), [(False, [0, 0]), (True, [90, 30])])
def test_coordinate_systems_turn_the_direction_as_the_parameter_says(turns, expected):
    """P-CHAN-00247. #CS turned by 30 about Y: its Z is (1/2, 0, cos30), which is C90 A30."""
    own = machine(COMPLETE, settings=ChannelSettings(direction_turns=turns))
    rows = positions("A1\n#TRAFO ON\n#CS ON [0,0,0,0,30,0]\nX0 Y0 Z0 C0 A0", own)
    assert rows[1][3:] == expected


def test_coordinate_systems_never_turn_programmed_angles_with_rtcp():
    own = machine(settings=ChannelSettings(direction_turns=True))
    assert positions("#TRAFO ON\n#CS ON [0,0,0,0,30,0]\nX0 Y0 Z0 C10 A20", own)[0][3:] == [10, 20]


def test_unreachable_direction_marks_its_word_and_says_what_can_be_reached():
    slanted = COMPLETE | {"axis": [*HEAD["axis"][:4], {"type": 2, "orientation": [0, 1, 1]}]}
    result = run("#KIN ID [91]\n#TRAFO ON\nN10 X5 C20 A120", machine(slanted))
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.id, error.line, error.column) == ("292014", 3, 8)
    assert "0.0000 to 90.0000 degrees; here it is 120.0000" in error.hint


def test_vector_mode_takes_numbers_without_unit():
    own = machine(HEAD | {"programming_mode": 10}, "XYZUVW")
    rows = positions("#TRAFO ON\nG70 U0 V-2 W2 X1", own)
    assert rows[0][:1] == [25.4] and rows[0][3:] == [0, 45, 0]


def test_zero_vector_is_an_error_at_its_word():
    own = machine(HEAD | {"programming_mode": 10}, "XYZUVW")
    assert errors("#TRAFO ON\nX1 W0", own) == [("292007", 3, 4)]


def test_offset_of_a_vector_axis_is_refused():
    own = machine(HEAD | {"programming_mode": 10}, "XYZUVW")
    assert errors("G92 W1\n#TRAFO ON\nX1", own) == [("N2001", 3, 1)]


def test_offset_of_an_angle_in_space_is_added_to_it():
    assert positions("A1\nG92 A5\n#TRAFO ON\nC0 A20", machine(COMPLETE))[1][3:] == [0, 25]


def test_channel_parameter_gives_the_mode_when_the_field_is_0():
    """P-CHAN-00112 = 19 (CB): the direction of C0 B30 is (1/2, 0, cos30), so C90 A30."""
    fields = COMPLETE | {"programming_mode": 0}
    own = machine(fields, "XYZCA", settings=ChannelSettings(orientation_mode=19))
    assert positions("A1\n#TRAFO ON\nC0 A30", own)[1][3:] == [90, 30]
    assert errors("#TRAFO ON", machine(fields)) == [("292045", 2, 1)]
    own = machine(COMPLETE, settings=ChannelSettings(orientation_mode=19))
    assert positions("A1\n#TRAFO ON\nC0 A30", own)[1][3:] == [0, 30]


def test_written_mode_counts_at_the_next_selection():
    text = "#TRAFO ON\nX1\n#TRAFO OFF\nV.G.KIN[91].RTCP=0\nA-1\n#TRAFO ON\nC0 A45"
    assert positions(text)[-1][3:] == [180, -45]


# --- steps -------------------------------------------------------------------------------------


def test_two_steps_programmed_values_go_through_the_second_first():
    own = machine(second=SKEW)
    text = "V.G.WZ_AKT.L=10\n#TRAFO [91,51]\nX2 Y5 Z1 C0 A90"
    assert positions(text, own) == [[round(2 * ROOT, 9), 3 - 10, 1, 0, 90]]
    assert positions("#KIN ID [91,51]\n#TRAFO ON\nX2 Y5", own)[0][:2] == [round(2 * ROOT, 9), 3]


def test_direction_of_two_steps_is_that_of_the_tool():
    """The first step has the tool: (0, -1, 0) at A90. X of the second step runs along (1, 1, 0), so
    a tool along X of the first, C90 A90, is seen along (1, 1, 0)."""
    result = run("#TRAFO [91,51]\nX2 Y5 Z1 C0 A90\nC90", machine(second=SKEW))
    expected = [[0, -1, 0], [1 / ROOT, 1 / ROOT, 0]]
    np.testing.assert_allclose(result.direction, expected, atol=1e-12)


def test_direction_below_a_table_is_turned_by_it():
    """First step: A tilts the tool. Second step: a table C, whose axis is entered inverted. At A90
    the tool lies along (0, -1, 0); the table at C90 turns the part under it, so that on the part
    it lies along Rz(-90) (0, -1, 0) = (-1, 0, 0)."""
    tilt = SKEW | {"axis": [*LINEAR, {"type": 2, "orientation": [1, 0, 0]}]}
    tilt |= {"number_of_axes": 4, "chain": [0, 1, 2, 3]}
    free = {"type": 2, "orientation": [1, 0, 0]}
    table = HEAD | {"axis": [*LINEAR, free, {"type": 2, "orientation": [0, 0, -1]}]}
    table |= {"chain": [4, 0, 1, 2, 3]}
    result = run("V.G.WZ_AKT.L=7\n#TRAFO [91,51]\nX1 A90 C90", machine(tilt, "XYZAC", table))
    np.testing.assert_allclose(result.direction[-1], [-1, 0, 0], atol=1e-12)


@pytest.mark.parametrize(
    ("command", "moved"),
    [
        ("#TRAFO [91]", False),
        ("#TRAFO [91,NONE]", False),
        ("#TRAFO [ON,OFF]", False),
        ("#TRAFO [ON,ON]", True),
        ("#TRAFO [ON]", True),
        ("#TRAFO ON", True),
        ("#TRAFO [DEFAULT,51]", True),
        ("#TRAFO [DEFAULT]", False),
        ("#KIN ID [91,NONE]\n#TRAFO ON", False),
        ("#KIN ID [DEFAULT,51]\n#TRAFO ON", True),
        ("#KIN ID\n#TRAFO ON", False),
    ],
)
def test_words_in_the_bracket(command, moved):
    """Whether the skew second step acts: X2 stays 2 without it."""
    own = machine(second=SKEW, settings=ChannelSettings(default_kinematic_id=91))
    x = positions(f"#KIN ID [91,51]\n{command}\nX2", own)[0][0]
    assert x == (round(2 * ROOT, 9) if moved else 2)


def test_off_keeps_the_id_and_none_drops_it():
    own = machine(second=SKEW)
    assert positions("#TRAFO [91,51]\n#TRAFO [OFF]\n#TRAFO ON\nX2", own)[0][0] == round(2 * ROOT, 9)
    assert errors("#TRAFO [91,51]\n#TRAFO [NONE]\n#TRAFO ON", own) == [("292005", 4, 1)]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("#TRAFO [91,52]", ("292005", 2, 1)),
        ("#TRAFO [91]\n#TRAFO [91,51]", ("20687", 3, 1)),
        ("#TRAFO [91]\n#KIN ID [91]", ("20687", 3, 1)),
        ("#TRAFO [91]\n#MCS ON\n#KIN ID [91]", ("20687", 4, 1)),
        ("#TRAFO [OFF,51]", ("N2001", 2, 1)),
        ("#TRAFO [91,51,7]", ("N1005", 2, 1)),
        ("#TRAFO [SOMETHING]", ("N1005", 2, 9)),
        ("#TLC ON [5]\n#KIN ID [91]", ("20687", 3, 1)),
        ("#TLC ON [5]\n#TRAFO ON", ("20669", 3, 1)),
    ],
)
def test_refused_selections(text, found):
    assert errors(text, machine(second=SKEW)) == [found]


def test_angles_in_space_below_a_second_step_are_refused():
    assert errors("#TRAFO [91,51]", machine(COMPLETE, second=SKEW)) == [("N2001", 2, 1)]


# --- transformation of programmed values -------------------------------------------------------


@dataclass(frozen=True)
class Polar:
    """X is a radius and Y an angle in degrees; they become X and Y."""

    id: int = 500
    name: str = "polar"
    orientation: tuple[int, ...] = ()

    def inverse(self, program, tool_length=0.0, near=None, pose=None, turn=None):
        out = np.array(program, float)
        angle = np.radians(out[..., 1])
        radius = out[..., 0].copy()
        out[..., 0], out[..., 1] = radius * np.cos(angle), radius * np.sin(angle)
        return out

    def program(self, axes, tool_length=0.0, near=None, turn=None):
        out = np.array(axes, float)
        x, y = out[..., 0].copy(), out[..., 1].copy()
        out[..., 0], out[..., 1] = np.hypot(x, y), np.degrees(np.arctan2(y, x))
        return out

    def forward(self, axes, tool_length=0.0):
        return self.program(axes)[..., :3], None

    def pose_of(self, axes):
        return np.ones(np.shape(axes)[:-1], np.int8)


def polar_machine(**more) -> Machine:
    own = KinematicParameters(id=500, type=500)
    types = {500: lambda parameters, names, mode: Polar()}
    return machine(program_step_parameters={500: own}, kinematic_types=types, **more)


def test_program_transformation_maps_before_systems_and_kinematics():
    """Radius 10 at 90 degrees is (0, 10); #CS turned by 90 about Z makes it (-10, 0).

    X1 then means (1, 10) in the #CS, which is (-10, 1).
    """
    text = "#CS ON [0,0,0,0,0,90]\n#TRAFO PCS ID [500]\n#TRAFO PCS ON\nX10 Y90\n#TRAFO PCS OFF\nX1"
    assert [row[:2] for row in positions(text, polar_machine())] == [[-10, 0], [-10, 1]]
    result = run("X3 Y4\n#TRAFO PCS ID [500]\n#TRAFO PCS ON\nG91 X0", polar_machine())
    np.testing.assert_allclose(result.pcs[-1, :2], [5, np.degrees(np.arctan2(4, 3))])
    layers = result.explain(4).layers
    assert layers[1].name == "#TRAFO PCS" and layers[1].origin == "program:3"
    np.testing.assert_allclose(
        sum(layer.change for layer in layers) + layers[0].values, [3, 4, 0, 0, 0], atol=1e-9
    )


def test_offsets_act_below_the_program_transformation():
    text = "#TRAFO PCS ID [500]\n#TRAFO PCS ON\nG92 X1\nX10 Y90"
    assert positions(text, polar_machine())[0][:2] == [1, 10]


def test_program_transformation_is_selected_by_the_lists_and_refused_by_name():
    settings = ChannelSettings(default_program_step_id=500)
    assert positions("#TRAFO PCS ON\nX10 Y90", polar_machine(settings=settings))[0][:2] == [0, 10]
    assert errors("#TRAFO PCS ON", polar_machine()) == [("292005", 2, 1)]
    assert errors("#TRAFO PCS ID [501]\n#TRAFO PCS ON", polar_machine()) == [("21630", 3, 1)]
    universal = machine(program_step_parameters={7: KinematicParameters(id=7, type=91)})
    assert errors("#TRAFO PCS ID [7]\n#TRAFO PCS ON", universal) == [("22287", 3, 1)]
    text = "#TRAFO PCS ID [500]\n#TRAFO PCS ON\n"
    assert errors(text + "#TRAFO PCS ID [500]", polar_machine()) == [("22282", 4, 1)]
    assert errors(text + "#SET AX [X,1,0]", polar_machine()) == [("22257", 4, 1)]


def test_a_kinematics_of_another_type_is_used_like_the_universal_one():
    own = KinematicParameters(id=600, type=500)
    types = {500: lambda parameters, names, mode: Polar()}
    other = Machine(axes=axes("XYZ"), kinematic_parameters={600: own}, kinematic_types=types)
    result = run("#TRAFO [600]\nX10 Y90", other)
    np.testing.assert_allclose(result.acs[-1], [0, 10, 0], atol=1e-12)
    assert errors("#TRAFO [600]", replace(other, kinematic_types={})) == [("N2001", 2, 1)]


# --- point to point ----------------------------------------------------------------------------


def test_point_to_point_has_the_same_end_points():
    text = "V.G.WZ_AKT.L=10\n#TRAFO ON\n{}X0 Y0 Z0 A90\n{}#TRAFO OFF"
    plain = positions(text.format("", ""))
    assert positions(text.format("#PTP ON\n", "#PTP OFF\n")) == plain == [[0, -10, 0, 0, 90]]
    assert run("#KIN ID [91]\n#TRAFO ON\n#PTP ON\nX1\n#PTP OFF\n#TRAFO OFF").diagnostics == ()


@pytest.mark.parametrize("fields", [HEAD, COMPLETE])
def test_point_to_point_moves_the_axes_straight(fields):
    """Every point lies on the straight line of the axes, and its words are those of the tip.

    Tool length 100, from C0 A0 to C80 A40 at one tip: the axes go from (0, 0, 100) to
    100 (sin80 sin40, -cos80 sin40, cos40). Half-way, at C40 A20, the tip is the middle of these
    minus 100 (sin40 sin20, -cos40 sin20, cos20).
    """
    text = "#KIN ID [91]\nV.G.WZ_AKT.L=100\n#TRAFO ON\nG0 X0 Y0 Z0 C0 A0\n{}\nC80 A40\n#{} OFF"
    options = ncscope.Options(sample=0.5)
    result = ncscope.run(machine(fields), text.format("#PTP ON", "PTP"), options)
    share = result.acs[1:, 4] / 40.0
    assert len(share) >= 8 and not result.end[1:-1].any()
    straight = result.acs[0] + share[:, None] * (result.acs[-1] - result.acs[0])
    np.testing.assert_allclose(result.acs[1:], straight, atol=1e-9)
    np.testing.assert_allclose(result.pcs[1:, 3:], result.acs[1:, 3:], atol=1e-9)
    middle = int(np.flatnonzero(np.isclose(share, 0.5))[0]) + 1

    def tool(c, a):
        c, a = np.radians([c, a])
        return 100 * np.array([np.sin(c) * np.sin(a), -np.cos(c) * np.sin(a), np.cos(a)])

    tip = (tool(0, 0) + tool(80, 40)) / 2 - tool(40, 20)
    np.testing.assert_allclose(result.pcs[middle, :3], tip, atol=1e-9)
    np.testing.assert_allclose(result.pcs[-1], [0, 0, 0, 80, 40], atol=0)
    plain = ncscope.run(machine(fields), text.format("", "TRAFO"), options)
    np.testing.assert_allclose(plain.mcs[:, :3], 0, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ("#PTP ON", "21527"),
        ("#PTP OFF", "21527"),
        ("#TRAFO ON\n#PTP ON\n#TRAFO ON", "21552"),
        ("#TRAFO ON\n#PTP ON\n#TRAFO OFF", "21528"),
        ("#TRAFO ON\n#PTP ON\n#CS ON [1,2,3]", "21550"),
        ("#TRAFO ON\n#CS ON [1,2,3]\n#PTP ON\n#CS OFF", "21529"),
        ("#TRAFO ON\n#PTP ON\n#MCS ON", "21531"),
        ("#TRAFO ON\n#PTP ON\nG41", "21525"),
        ("#TRAFO ON\nG42\n#PTP ON", "21525"),
        ("#TRAFO ON\n#PTP ON\nG02 F1000 X10 I5", "21530"),
        ("#TRAFO ON\nG02 F1000 X10 I5\n#PTP ON\nX20 I5", "21530"),
        ("#TRAFO ON\n#PTP ON\nG01 F1000 X10\nG302 I2\nY10", "21530"),
    ],
)
def test_point_to_point_excludes(text, id):
    assert [found[0] for found in errors(text)] == [id]


# --- the pose and #MCS -------------------------------------------------------------------------


def test_the_pose_stays_fixed_when_mcs_takes_the_axes_into_the_other_one():
    """C0 A40 and C180 A-40 are the same direction; only a new selection takes the second."""
    text = "#TRAFO ON\nX0 Y0 Z0 C0 A40\n#MCS ON\nC180 A-40\n#MCS OFF\n"
    assert positions(text + "X1 C0 A40", machine(COMPLETE))[-1][3:] == [0, 40]
    again = "#TRAFO OFF\n#TRAFO ON\nX1 C0 A40"
    assert positions(text + again, machine(COMPLETE))[-1][3:] == [180, -40]
    found = run("#KIN ID [91]\n" + text + "X1\n#TRAFO OFF", machine(COMPLETE)).diagnostics
    assert [(d.id, d.line) for d in found] == [("N2071", 6)]
    for rtcp_or_same in (machine(), machine(COMPLETE)):
        same = "#KIN ID [91]\n#TRAFO ON\nC0 A40\n#MCS ON\nX5 A30\n#MCS OFF\n#TRAFO OFF"
        assert run(same, rtcp_or_same).diagnostics == ()


# --- tools --------------------------------------------------------------------------------------


def test_tool_change_under_a_transformation_acts_with_the_next_word():
    """The axes stay at D; the longer tool counts when X is programmed."""
    tools = {1: Tool(length=10.0), 2: Tool(length=30.0)}
    text = "D1\n#TRAFO ON\nX0 Y0 Z0 A90\nD2\nG91 X0\nG90 Y0"
    rows = positions(text, machine(tools=tools))
    assert rows == [[0, -10, 0, 0, 90], [0, -10, 0, 0, 90], [0, -30, 0, 0, 90]]


def test_tool_parameters_shift_the_zero_position():
    """wz[].kinematic.param[4] 50000: the flange is 5 mm further along Y, so Y stands at -5."""
    tools = {1: Tool(kinematic_parameters={4: 50000.0})}
    own = machine(tools=tools)
    assert positions("D1\n#TRAFO ON\nX0 Y0 Z0", own)[0][:3] == [0, -5, 0]
    text = "#TRAFO ON\nX0 Y0 Z0\nD1\nG91 X0\nG90 Y0\nD0\nY0"
    assert [row[1] for row in positions(text, own)] == [0, 0, -5, 0]
    text = "#TRAFO ON\nX0 Y0 Z0\n#MCS ON\nD1\n#MCS OFF\nY0"
    assert [row[1] for row in positions(text, own)] == [0, -5]


def test_tool_parameters_that_change_the_structure_are_an_error():
    own = machine(tools={1: Tool(kinematic_parameters={49: 1.0})})
    assert errors("D1\n#TRAFO ON", own) == [("292010", 3, 1)]
    assert errors("#TRAFO ON\nD1", own) == [("292010", 3, 1)]
    own = machine(tools={1: Tool(kinematic_parameters={1: 1.0})})
    result = run("#KIN ID [91]\nD1\n#TRAFO ON\n#TRAFO OFF", own)
    assert [d.id for d in result.diagnostics] == ["N2029"]


def test_tool_preselects_its_kinematics():
    other = replace(KinematicParameters.from_fields(SKEW), id=7)
    own = machine(tools={1: Tool(kinematic_id=7)})
    own = replace(own, kinematic_parameters={**own.kinematic_parameters, 7: other})
    assert positions("D1\n#TRAFO ON\nX2", own)[0][0] == round(2 * ROOT, 9)
    assert errors("#TRAFO ON\nD1", own) == [("20990", 3, 1)]
    assert errors("#TRAFO ON\n#MCS ON\nD1", own) == [("20990", 4, 1)]


def test_older_names():
    assert positions("V.G.WZ_AKT.L=10\n#RTCP ON\nX0 Y0 Z0 A90\n#RTCP OFF\nY1")[1][1] == 1
    assert errors("#TLC ON [5]\n#RTCP ON") == [("20669", 3, 1)]


def test_transformation_at_program_start_and_end():
    """P-CHAN-00151 and P-CHAN-00152, with the default kinematics of P-CHAN-00032."""
    chosen = ChannelSettings(
        default_kinematic_id=91, transformation_at_start=True, transformation_ends=True
    )
    own = machine(settings=chosen, tools={1: Tool(length=10.0)})
    result = run("D1\nX0 Y0 Z0 A90", own)
    assert result.diagnostics == () and result.acs[-1].round(9).tolist() == [0, -10, 0, 0, 90]
    warned = run("X0", replace(own, settings=replace(chosen, transformation_ends=False)))
    assert [d.id for d in warned.diagnostics] == ["21247"]
    missing = replace(own, settings=replace(chosen, default_kinematic_id=92))
    assert [(d.id, d.line) for d in run("X0", missing).diagnostics] == [("292005", 1)]
