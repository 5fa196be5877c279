"""G74, G200 to G202 and #TLC: TF5200 coordinate systems and offsets"""

import pytest

import ncscope
from ncscope.machine import Axis, Machine, Tool

MACHINE = Machine(
    axes=(Axis("X", 1, reference=500.0), Axis("Y", 2), Axis("Z", 3)),
    tools={1: Tool(length=5.0), 2: Tool(length=7.0, radius=3.0, axis_offsets={1: 2.5})},
)


def result_of(text):
    return ncscope.run(MACHINE, text + "\nM30\n")


def axes_of(text):
    return result_of(text).check().acs


def ids_of(text):
    return [d.id for d in result_of(text).diagnostics]


def test_homing_goes_to_the_reference_and_ends_the_preset():
    rows = axes_of("G92 X10\nX1 Y2\n#PSET X0 Y0\nG74 X1\nX3 Y4")
    assert rows[0] == pytest.approx([11, 2, 0])
    assert rows[1] == pytest.approx([500, 2, 0])
    assert rows[2] == pytest.approx([13, 6, 0])
    assert ids_of("G74") == ["N2027"]


def test_manual_mode_moves_nothing():
    result = result_of("X5\nG201 X1 Y1\nG202 X1\n#GET MANUAL OFFSETS\nX[6 + V.A.MANUAL_OFFSETS.X]")
    assert result.check().acs[:, 0] == pytest.approx([5, 6])
    assert ids_of("G201") == ["20038"]
    assert ids_of("G200") == ["N2026"]


def test_length_correction_counts_from_the_next_absolute_word():
    text = "D1 Z0\n#TLC ON [15]\nG91 Z1\nG90 Z0\nD2\nZ0\n#TLC OFF\nX1\nZ0"
    rows = axes_of(text)
    assert rows[:, 2] == pytest.approx([5, 6, 20, 22, 22, 7])
    assert ids_of("#TLC ON [1]\n#TLC ON [2]") == ["N2028"]
    assert ids_of("#TLC ON [1]\n#TRAFO ON") == ["20669"]
    assert axes_of("G18\n#TLC ON [-2]\nX0 Y0 Z0")[-1] == pytest.approx([0, -2, 0])


@pytest.mark.parametrize(
    ("name", "value"), [("L", 7), ("R", 3), ("V.Y", 2.5), ("V[1]", 2.5), ("V.X", 0)]
)
def test_tool_records_can_be_read(name, value):
    result = result_of(f'#MSG SAVE EXCLUSIVE ["%f", V.G.WZ[2].{name}]').check()
    assert float(result.messages[0].text) == pytest.approx(value)
    assert ids_of(f"P1 = V.G.WZ[3].{name}") == ["20172"]
