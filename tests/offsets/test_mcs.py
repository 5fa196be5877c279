"""#MCS ON [EX TOOL] .. #MCS OFF: TF5200 coordinate systems and offsets"""

import pytest

import ncscope
from ncscope.machine import Machine, Tool

MACHINE = Machine(tools={1: Tool(length=5.0), 2: Tool(length=12.5, axis_offsets={0: 1.0})})
BEFORE = "D1\nG92 X10\n#CS ON [100,0,0,0,0,90]\n#ROTATION ON [ANGLE=90]\nX1 Y2 Z3\n"


def result_of(text):
    return ncscope.run(MACHINE, text + "\nM30\n")


def axes_of(text):
    return result_of(text).check().acs


def test_values_are_axis_positions_and_everything_comes_back():
    rows = axes_of(BEFORE + "#MCS ON\nX7 Y8 Z9\nG91 Y1\nG90\n#MCS OFF\nX1 Y2 Z3")
    # rotation: (-2, 1); #CS: (100 - 1, -2); G92 X10; tool: + 5 in Z
    assert rows[0] == pytest.approx([109, -2, 8])
    assert rows[1] == pytest.approx([7, 8, 9])
    assert rows[2] == pytest.approx([7, 9, 9])
    assert rows[3] == pytest.approx([109, -2, 8])


def test_switching_moves_nothing():
    rows = axes_of(BEFORE + "#MCS ON\nG91 X0\n#MCS OFF\nX0 Y0 Z0")
    assert rows[1] == pytest.approx(rows[0])
    assert rows[2] == pytest.approx(rows[0])


def test_offsets_inside_end_with_it():
    rows = axes_of("G92 X10\n#MCS ON\nG92 X1\nX5\n#PSET X0\nX1\n#MCS OFF\nX5")
    assert rows[:, 0] == pytest.approx([6, 7, 15])


def test_tool_chosen_inside_is_valid_afterwards():
    rows = axes_of("D1 Z0\n#MCS ON\nZ1\nD2\nX0 Z1\n#MCS OFF\nX0 Z1")
    assert rows[:, 2] == pytest.approx([5, 1, 13.5, 13.5])
    assert rows[:, 0] == pytest.approx([0, 0, -1, -1])


def test_ex_tool_leaves_the_tool_out_until_off():
    rows = axes_of("D1 Z0\n#MCS ON [EX TOOL]\nD2\nG18\nG17\nZ1\n#MCS OFF\nZ1")
    assert rows[:, 2] == pytest.approx([5, 1, 13.5])


def test_mirror_and_scale_stay():
    rows = axes_of("G21\n#MCS ON\nX5\n#SCALE ON X2\nX5\n#MCS OFF\nX5")
    assert rows[:, 0] == pytest.approx([-5, -10, -10])


@pytest.mark.parametrize(
    "name",
    ["#CS ON [1,2,3]", "#ACS ON [1,2,3]", "#BCS ON [1,2,3]", "#ECS ON", "#TLC ON [1]", "#TRAFO ON"],
)
def test_commands_that_cannot_stand_inside(name):
    found = result_of(f"#MCS ON\n{name}").diagnostics
    assert [(d.id, d.line, d.column) for d in found] == [("20805", 2, 1)]


def test_nested_and_lonely():
    assert [d.id for d in result_of("#MCS ON\n#MCS ON\nX1\n#MCS OFF\n#MCS OFF").diagnostics] == [
        "N2023",
        "N2023",
    ]


def test_plane_change_inside_ends_the_suspended_rotation():
    result = result_of("#ROTATION ON [ANGLE=90]\n#MCS ON\nG18\nG17\n#MCS OFF\nX5")
    assert [d.id for d in result.diagnostics] == ["21143"]
    assert result.acs[-1] == pytest.approx([5, 0, 0])


@pytest.mark.parametrize("line", ["#ROTATION OFF", "G69", "G68 R3", "#ROTATION ON"])
def test_contour_rotation_inside_is_refused(line):
    result = result_of(f"#ROTATION ON [ANGLE=90]\n#MCS ON\n{line}")
    assert [d.id for d in result.diagnostics] == ["N2022"]
