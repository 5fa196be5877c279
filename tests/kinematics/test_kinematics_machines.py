"""Machines with 3 to 6 axes, linkage, and other readings of the manual, as NC programs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from random_machines import Machine as Tree
from test_kinematics_commands import HEAD, LINEAR, axes, errors, machine, positions, run

import ncscope
from ncscope.kinematics import Reading
from ncscope.machine import Machine

EXAMPLES = Path(__file__).parents[2] / "examples" / "machines"


@pytest.mark.parametrize("rotary", [0, 1, 2, 3])
def test_rtcp_with_three_to_six_axes(rotary):
    """The programmed tip and the machine's own angles, put back into a physical tree."""
    rng = np.random.default_rng(rotary)
    for _ in range(5):
        tree = Tree(rng, rotary)
        names = "XYZABC"[: tree.n]
        own = Machine(axes=axes(names), kinematic_parameters={91: tree.parameters(17, 1)})
        values = rng.uniform(-200, 200, tree.n).round(4)
        words = " ".join(f"{a}{v:.4f}" for a, v in zip(names, values, strict=True))
        result = run(f"V.G.WZ_AKT.L=70\n#KIN ID [91]\n#TRAFO ON\n{words}\n#TRAFO OFF", own).check()
        tip, direction = tree.tool_pose(result.acs[-1], 70.0)
        np.testing.assert_allclose(tip, values[:3], atol=1e-9)
        np.testing.assert_allclose(result.direction[-1], direction, atol=1e-12)
        np.testing.assert_allclose(result.acs[-1, 3:], values[3:], atol=0)


def test_four_axes_in_space():
    """One rotary axis reaches one cone: A about X keeps the tool normal to X."""
    fields = HEAD | {"rtcp": 0, "number_of_axes": 4, "chain": [0, 1, 2, 3]}
    fields["axis"] = [*LINEAR, {"type": 2, "orientation": [1, 0, 0]}]
    own = machine(fields, "XYZAC")
    assert positions("V.G.WZ_AKT.L=10\n#TRAFO ON\nX0 Y0 Z0 C0 A90", own) == [[0, -10, 0, 90, 0]]
    assert errors("#TRAFO ON\nX1 C10 A30", own) == [("292014", 3, 4)]


def test_three_axes_in_space():
    """Without rotary axes only the direction at 0 can be programmed: C free, A0."""
    fields = HEAD | {"rtcp": 0, "number_of_axes": 3, "chain": [0, 1, 2], "axis": LINEAR}
    assert positions("#TRAFO ON\nX3 C77 A0", machine(fields))[0] == [3, 0, 0, 77, 0]
    assert errors("#TRAFO ON\nX3\nA10", machine(fields)) == [("292014", 4, 1)]


def test_too_few_axes_in_the_channel():
    assert errors("#SET AX [X,1,0] [Y,2,1] [Z,3,2]\n#TRAFO ON") == [("20658", 3, 1)]


def test_linkage_of_the_manual():
    """X = (X1 + X2) / 2 + 112, Z = 0.71 (X1 - X2) - 75, Y is the third axis (FCT-C27 9).

    X100 Z-60: X1 + X2 = -24, X1 - X2 = 15 / 0.71.
    """
    own, _ = ncscope.load_machine(EXAMPLES / "spline_linkage")
    difference = 15 / 0.71
    rows = positions("#TRAFO ON\nX100 Y5 Z-60", own)
    np.testing.assert_allclose(rows, [[(difference - 24) / 2, (-24 - difference) / 2, 5]])


def test_every_way_to_write_a_parameter_reaches_one_memory():
    """zero_position[0] by name, by index of param, and by the field of the list."""
    for name in ("ZERO_POSITION[0]", "PARAM[3]", "param[3]"):
        assert positions(f"V.G.KIN[91].{name}=20000\n#TRAFO ON\nX0")[0][0] == -2


# --- other readings -----------------------------------------------------------------------------


def read(fields, **switches) -> Machine:
    return replace(machine(fields), kinematic_reading=Reading(**switches))


def test_directions_of_linear_axes_may_scale():
    """An X direction of length 0.5: X moves two millimetres for one of the tip."""
    scaled = HEAD | {"axis": [{"type": 1, "orientation": [0.5, 0, 0]}, *HEAD["axis"][1:]]}
    assert positions("#TRAFO ON\nX3", machine(scaled))[0][0] == 3
    assert positions("#TRAFO ON\nX3", read(scaled, scaled_axes=True))[0][0] == 6


def test_conformal_position_through_the_chain():
    """The AC table of FCT-C27 at X100 Y-50 Z25 C30 A0 in both readings."""
    own, _ = ncscope.load_machine(EXAMPLES / "ac_table")
    text = "V.G.KIN[91].PROGRAMMING_MODE=13\n#TRAFO ON\nX100 Y-50 Z25 C30 A0"
    expected = {False: [110.473258, 6.994807, 24.95], True: [98.870718, -49.703923, 24.95]}
    for chained, values in expected.items():
        other = replace(own, kinematic_reading=Reading(conformal_chain=chained))
        result = run(
            f"#KIN ID [91]\n{text}\n#TRAFO OFF\n#TRAFO ON\nG91 X0\n#TRAFO OFF", other
        ).check()
        np.testing.assert_allclose(result.acs[-1, :3], values, atol=1e-6)
        np.testing.assert_allclose(result.pcs[-1, :3], [100, -50, 25], atol=1e-9)


def test_classic_zero_direction_along_z():
    """Mode AB: literally A0 B0 points along X; in the other reading along Z."""
    head = HEAD | {"rtcp": 0, "programming_mode": 14}
    rotary = [{"type": 2, "orientation": [1, 0, 0]}, {"type": 2, "orientation": [0, 1, 0]}]
    head["axis"] = [*LINEAR, *rotary]
    own = replace(machine(head, "XYZAB"), kinematic_reading=Reading(classic_z=True))
    assert positions("#TRAFO ON\nX1 A0 B0\nA20 B30", own) == [[1, 0, 0, 0, 0], [1, 0, 0, 20, 30]]
    literal = machine(head, "XYZAB")
    assert positions("#TRAFO ON\nA0 B-90\nX1", literal)[1] == [1, 0, 0, 0, 0]
