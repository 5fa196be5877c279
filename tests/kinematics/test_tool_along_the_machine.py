"""#TOOL ORI CS and #TLC, with the head of test_kinematics_commands: q = p + L d."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_kinematics_commands import (
    COMPLETE,
    HEAD,
    LINEAR,
    SKEW,
    errors,
    machine,
    polar_machine,
    positions,
    run,
)

from ncscope.machine import ChannelSettings

TILTED = "V.G.WZ_AKT.L=10\n{start}\n#TRAFO ON\nX0 Y0 Z0\n#CS ON [0,0,0,0,30,0]\n#TOOL ORI CS"
"""#CS turned by 30 degrees about Y: its Z is (1/2, 0, cos30), the direction of C90 A30."""
Z30 = [5, 0, round(10 * np.cos(np.radians(30)), 9)]


def tilted(start="C0 A1", fields=HEAD, axis=0, mode=0, limits=None):
    own = machine(
        fields, settings=ChannelSettings(tool_orientation_axis=axis, tool_orientation_mode=mode)
    )
    if limits:
        own = replace(own, axes=(*own.axes[:3], replace(own.axes[3], limits=limits), own.axes[4]))
    return positions(TILTED.format(start=start), own)[-1]


def test_tool_turns_onto_the_third_axis_and_the_tip_stays():
    assert tilted() == [*Z30, 90, 30]
    assert tilted(axis=3) == [*Z30, 90, 30]


def test_other_axes_of_the_system():
    """X of the system is (cos30, 0, -1/2), which is C90 A120; Y is (0, 1, 0), C180 A90."""
    assert tilted(axis=1)[3:] == [90, 120]
    assert tilted(axis=2)[3:] == [180, 90]


@pytest.mark.parametrize(
    ("mode", "start", "expected"),
    [
        (0, "C0 A-1", [-90, -30]),
        (1, "C-80 A-20", [-90, -30]),
        (1, "C80 A-20", [90, 30]),
        (3, "C0 A-1", [90, 30]),
        (4, "C0 A1", [-90, -30]),
    ],
)
def test_which_of_two_solutions(mode, start, expected):
    """P-CHAN-00189: the pose of the axes, the shortest way, pose 1, pose 2."""
    assert tilted(start, mode=mode)[3:] == expected


def test_the_shortest_way_of_a_modulo_axis_may_cross_the_end_of_its_range():
    """From C170 A-20 to C90 A30 it is 80 + 50 degrees. To C-90 A-30 it is 260 + 10, where C is a
    modulo axis 100 + 10."""
    assert tilted("C170 A-20", mode=1)[3:] == [90, 30]
    own = machine(settings=ChannelSettings(tool_orientation_mode=1))
    turning = replace(own.axes[3], modulo_range=(-180.0, 180.0))
    own = replace(own, axes=(*own.axes[:3], turning, own.axes[4]))
    assert positions(TILTED.format(start="C170 A-20"), own)[-1][3:] == [-90, -30]


def test_limits_come_before_the_shortest_way():
    assert tilted("C80 A20", mode=2)[3:] == [90, 30]
    assert tilted("C80 A20", mode=2, limits=(-180.0, 85.0))[3:] == [-90, -30]


def test_a_complete_transformation_stays_in_its_pose():
    assert tilted("C0 A-1", COMPLETE, mode=3) == [*Z30, -90, -30]


def test_errors_of_tool_ori_cs():
    assert errors("#TOOL ORI CS") == [("21323", 2, 1)]
    assert errors("#TRAFO ON\n#TOOL ORI CS", machine(SKEW, "XYZ")) == [("20662", 3, 1)]
    six = HEAD | {
        "number_of_axes": 6,
        "axis": [*HEAD["axis"], {"type": 2, "orientation": [0, 1, 0]}],
        "chain": [0, 1, 2, 3, 4, 5],
    }
    assert errors("#TRAFO ON\n#TOOL ORI CS", machine(six, "XYZCAB")) == [("292006", 3, 1)]
    one = HEAD | {"number_of_axes": 4, "axis": HEAD["axis"][:4], "chain": [0, 1, 2, 3]}
    text = "#TRAFO ON\n#CS ON [0,0,0,0,30,0]\n#TOOL ORI CS"
    assert errors(text, machine(one, "XYZC")) == [("292014", 4, 1)]
    two_steps = machine(second=SKEW)
    assert errors("#TRAFO [91,51]\n#TOOL ORI CS", two_steps) == [("292006", 3, 1)]


def test_tlc_acts_along_the_tool():
    """Longer by 5: with A90 the tool lies along -Y, so Y goes to -5. #TLC ON moves nothing."""
    text = "X1 Y2 Z3 A90\n#TLC ON [5]\nG91 X0\nG90 X1 Y2 Z3\n#TLC OFF\nY2 Z3\nA0"
    expected = [[1, 2, 3], [1, 2, 3], [1, -3, 3], [1, 2, 3], [1, 2, 3]]
    assert [row[:3] for row in positions(text)] == expected


def test_tlc_adds_to_the_axis_of_the_tool_without_a_kinematics():
    assert positions("#KIN ID [0]\n#TLC ON [5]\nX1 Z3 A90")[0] == [1, 0, 8, 0, 90]


def test_tlc_under_a_program_of_machine_axes_is_the_same_at_angle_0():
    assert positions("#TLC ON [5]\nX1 Z3")[0] == [1, 0, 8, 0, 0]


def test_tlc_shows_its_part_in_explain():
    result = run("#KIN ID [91]\n#TLC ON [5]\nX1 Y2 Z3 A90")
    layers = {layer.name: layer for layer in result.explain(3).layers}
    np.testing.assert_allclose(layers["#TLC"].change, [0, -5, -0, 0, 0], atol=1e-12)
    assert layers["#TLC"].origin == "program:2"


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(-300, 300), min_size=5, max_size=5),
    st.floats(0, 200),
    st.floats(-50, 50),
)
def test_tlc_holds_the_tip_of_a_table_machine(values, length, longer):
    """The tip of the longer tool is where the shorter one would be; the length does not matter."""
    table = HEAD | {
        "axis": [
            *LINEAR,
            {"type": 2, "orientation": [0, 0, -1], "point": [800, 1200, 0]},
            {"type": 2, "orientation": [-1, 0, 0], "point": [0, 55000, -730000]},
        ],
        "chain": [3, 4, 0, 1, 2],
    }
    own = machine(table)
    words = " ".join(f"{a}{v:.6f}" for a, v in zip("XYZCA", values, strict=True))
    result = run(f"#KIN ID [91]\n#TLC ON [{longer:.6f}]\n{words}", own).check()
    kin = own.kinematics[91]
    before = kin.forward(result.pcs[-1], length)[0]
    after = kin.forward(result.acs[-1], length + float(f"{longer:.6f}"))[0]
    np.testing.assert_allclose(after, before, atol=1e-9)


def test_refusals_of_tlc():
    assert errors("#TRAFO ON\n#TLC ON [5]") == [("20669", 3, 1)]
    assert errors("#TLC ON [5]\n#TLC ON [5]") == [("N2028", 3, 1)]
    assert errors("#TLC ON [5]\n#SET AX [X,1,0] [Y,2,1] [Z,3,2]") == [("20683", 3, 1)]
    assert errors("#KIN ID [92]\n#TLC ON [5]", polar_machine()) == [("292005", 3, 1)]
