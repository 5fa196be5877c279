"""#CS, #ACS, #BCS and #CS MODE against the TF5200 definitions and hand-computed positions."""

import numpy as np
import pytest

import ncscope


def result_of(text):
    return ncscope.run(ncscope.Machine(), text + "\nM30\n")


def axes_of(text):
    return result_of(text).check().acs


def ids_of(text):
    return [d.id for d in result_of(text).diagnostics]


@pytest.mark.parametrize("kind", ["CS", "ACS", "BCS"])
def test_e6_chain(kind):
    text = f"#{kind} ON [0,0,0,0,0,20]\n#{kind} ON [0,0,0,0,0,30]\nX10 Y0\n#{kind} OFF\nX10 Y0\n"
    rows = axes_of(text + f"#{kind} OFF\nX10 Y0")
    expected = [(6.427876, 7.660444, 0), (9.396926, 3.420201, 0), (10, 0, 0)]
    assert rows == pytest.approx(np.array(expected), abs=1e-6)


@pytest.mark.parametrize("kind", ["CS", "ACS", "BCS"])
def test_e7_angles_and_e8_shift(kind):
    rows = axes_of(f"#{kind} ON [2,15,5,20,30,45]\nX1 Y2 Z3")
    assert rows[-1] == pytest.approx([3.247520, 17.454303, 7.533789], abs=1e-6)
    rows = axes_of(f"#{kind} ON [10,0,0,0,0,90]\n#{kind} ON [5,0,0]\nX1 Y2")
    assert rows[-1] == pytest.approx([8, 6, 0])


SYSTEMS = ["#BCS ON [1,0,0,0,0,90]", "#ACS ON [0,2,0,90,0,0]", "#CS ON [0,0,3,0,90,0]"]


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2), (2, 0, 1)])
def test_bcs_below_acs_below_cs_in_any_order(order):
    text = "\n".join(SYSTEMS[i] for i in order)
    # #CS: (z, y, -x) + (0, 0, 3) = (7, 6, -2); #ACS: (x, -z, y) + (0, 2, 0) = (7, 4, 6);
    # #BCS: (-y, x, z) + (1, 0, 0) = (-3, 7, 6)
    assert axes_of(text + "\nX5 Y6 Z7")[-1] == pytest.approx([-3, 7, 6])


def test_acs_below_a_running_cs_moves_nothing_and_goes_alone():
    text = "X1 Y2 Z3\n#CS ON [10,0,0]\nG92 X4\n#ACS ON [0,0,0,0,0,90]\nG91 X0\nG90 X1 Y0 Z0\n"
    rows = axes_of(text + "#ACS OFF\nX1 Y0 Z0")
    assert rows[1] == pytest.approx([1, 2, 3])
    assert rows[2] == pytest.approx([0, 15, 0])
    assert rows[3] == pytest.approx([15, 0, 0])


def test_offsets_of_acs_die_with_it():
    rows = axes_of("#ACS ON [10,0,0]\nG92 X5\nX1\n#ACS OFF\nX1\n#ACS ON [10,0,0]\nX1")
    assert rows[:, 0] == pytest.approx([16, 1, 11])


def test_ids_and_limits_of_each_kind():
    assert ids_of("#CS DEF [1] [1,0,0]\n#ACS ON [1]") == ["20821"]
    full = "\n".join(f"#{k} DEF [{i}] [{i},0,0]" for k in ("CS", "ACS", "BCS") for i in range(1, 6))
    assert ids_of(full) == []
    assert ids_of(full + "\n#ACS DEF [6] [1,0,0]") == ["21234"]
    assert ids_of("#ACS ON [2] [1,0,0]\n#ACS DEF [2] [3,0,0]") == ["20825"]
    assert ids_of("#ACS ON [2] [1,0,0]\n#CS DEF [2] [3,0,0]") == []
    assert ids_of("#BCS DEF [1] [1,0,0]\n" + "#BCS ON [1]\n" * 6) == ["20826"]


def test_off_all_takes_one_kind():
    text = "#ACS ON [1,0,0]\n#ACS ON [2,0,0]\n#CS ON [10,0,0]\nX0\n#ACS OFF ALL\nX0\n#CS OFF\nX0"
    assert axes_of(text)[:, 0] == pytest.approx([13, 10, 0])
    assert ids_of("#ACS OFF") == ["20824"]


@pytest.mark.parametrize(
    "option", ["ROTATION_MODE_FIXED", "ROTATION_SEQUENCE=ZYX ROTATION_MODE_FIXED"]
)
def test_fixed_rotation_of_e7(option):
    text = f"#CS MODE ON [{option}]\n#CS ON [2,15,5,20,30,45]\n"
    assert axes_of(text + "X1 Y2 Z3")[-1] == pytest.approx(
        [2.887628, 15.983872, 8.499159], abs=1e-6
    )
    assert axes_of(text + "X10 Y0 Z0")[-1] == pytest.approx(
        [8.123724, 22.853854, 4.096133], abs=1e-6
    )


@pytest.mark.parametrize("sequence", ["ROTATION_SEQUENCE=XYZ", "ROTATION_SEQUENCE XYZ"])
def test_sequence_xyz(sequence):
    text = f"#CS MODE ON [{sequence}]\n#CS ON [2,15,5,20,30,45]\nX1 Y2 Z3\n#CS OFF\n"
    rows = axes_of(text + "#CS MODE OFF [ROTATION_SEQUENCE]\n#CS ON [2,15,5,20,30,45]\nX1 Y2 Z3")
    assert rows[0] == pytest.approx([2.887628, 15.983872, 8.499159], abs=1e-6)
    assert rows[1] == pytest.approx([3.247520, 17.454303, 7.533789], abs=1e-6)


@pytest.mark.parametrize("text", ["#CS MODE ON [ROTATION_SEQUENCE=ABC]", "#CS MODE ON [NOTHING]"])
def test_mode_written_wrongly(text):
    assert ids_of(text) == ["20675"]
