"""Scale, contour rotation, mirror and #SUPPRESS OFFSETS: TF5200 coordinate systems and offsets"""

import numpy as np
import pytest

import ncscope

TWO_OFFSETS = "V.G.NP[1].V.X=11\nV.G.NP[1].V.Y=22\nG54\nG92 X10 Y20\n"


def result_of(text, **options):
    machine = options.pop("machine", None) or ncscope.Machine()
    return ncscope.run(machine, text + "\nM30\n")


def axes_of(text, **options):
    return result_of(text, **options).check().acs


def ids_of(text):
    return [d.id for d in result_of(text).diagnostics]


def message_of(expression, before):
    text = f'{before}\n#MSG SAVE EXCLUSIVE ["%f", {expression}]'
    return float(result_of(text).check().messages[0].text)


# --- E14 and the simple case -------------------------------------------------------------------

E14 = [
    ("X0 Y0", -67.781746, 36.360390),
    ("X0 Y50", -32.426407, 71.715729),
    ("X75 Y50", 20.606602, 18.682720),
    ("X75 Y-50", -50.104076, -52.027958),
    ("X0 Y-50", -103.137085, 1.005051),
]
TURNED = "G01 F1000\n#ROTATION ON [ANGLE -45 CENTER1=10 CENTER2=100]\n"


@pytest.mark.parametrize(("words", "x", "y"), E14)
def test_e14_rotation_about_a_centre(words, x, y):
    assert axes_of(TURNED + words)[-1] == pytest.approx([x, y, 0], abs=1e-6)


@pytest.mark.parametrize(("words", "x", "y"), E14)
def test_e14_with_mirror(words, x, y):
    assert axes_of(TURNED + "G21\n" + words)[-1] == pytest.approx([-x, y, 0], abs=1e-6)


def test_e14_plane_change_switches_the_rotation_off():
    result = result_of(TURNED + "X10\nG18\nX7 Y8 Z9")
    assert [d.id for d in result.diagnostics] == ["21143"]
    assert result.diagnostics[0].line == 4
    assert result.acs[-1] == pytest.approx([7, 8, 9])


def test_the_same_plane_again_keeps_the_rotation():
    assert ids_of("#ROTATION ON [ANGLE=30]\nG17") == []


def test_a_quarter_turn_does_not_turn_the_offset():
    assert axes_of("#ROTATION ON [ANGLE=90]\nX10 Y0")[-1] == pytest.approx([0, 10, 0])
    text = "V.G.NP[1].V.X=100\nG54\n#ROTATION ON [ANGLE=90]\nX10 Y0"
    assert axes_of(text)[-1] == pytest.approx([100, 10, 0])


def test_one_word_moves_both_axes_of_the_plane():
    rows = axes_of("#ROTATION ON [ANGLE=30]\nX10 Y4\nX20")
    s, c = 0.5, np.sqrt(3) / 2
    assert rows[0] == pytest.approx([10 * c - 4 * s, 10 * s + 4 * c, 0])
    assert rows[1] - rows[0] == pytest.approx([10 * c, 10 * s, 0])


def test_a_relative_word_follows_the_turned_axis():
    rows = axes_of("X3 Y5\n#ROTATION ON [ANGLE=90]\nG91 X10")
    assert rows[-1] == pytest.approx([3, 15, 0])


def test_planes_g18_and_g19_turn_their_own_axes():
    assert axes_of("G18\n#ROTATION ON [ANGLE=90]\nZ10 X0")[-1] == pytest.approx([10, 0, 0])
    assert axes_of("G19\n#ROTATION ON [ANGLE=90]\nY10 Z0")[-1] == pytest.approx([0, 0, 10])


def test_on_without_bracket_takes_the_last_values():
    text = "#ROTATION ON [ANGLE=90 CENTER1=5]\n#ROTATION OFF\nX0 Y0\n#ROTATION ON\nX10 Y0"
    rows = axes_of(text)
    assert rows[0] == pytest.approx([0, 0, 0])
    assert rows[1] == pytest.approx([5, 5, 0])


def test_rotation_inside_a_coordinate_system():
    text = "#CS ON [100,0,0,0,0,90]\n#ROTATION ON [ANGLE=90]\nX10 Y0 Z1"
    assert axes_of(text)[-1] == pytest.approx([90, 0, 1])


# --- G68, G69 ----------------------------------------------------------------------------------


def test_g68_missing_centre_is_the_present_position():
    rows = axes_of("X10 Y20\nG68 R90\nX15 Y20\nG69\nX15 Y20")
    assert rows[1] == pytest.approx([10, 25, 0])
    assert rows[2] == pytest.approx([15, 20, 0])


def test_g68_after_g68_is_absolute_about_the_unturned_position():
    rows = axes_of("G68 R90 X0 Y0\nX10 Y0\nG68 R0 X0\nX1 Y2")
    assert rows[0] == pytest.approx([0, 10, 0])
    assert rows[1] == pytest.approx([1, 2, 0])
    rows = axes_of("G68 R90 X0 Y0\nX10 Y0\nG68 R90 X0\nX0 Y10")  # centre (0, 10)
    assert rows[1] == pytest.approx([0, 10, 0])


def test_g68_with_the_third_axis():
    result = result_of("G68 R30 X1 Z2")
    assert [(d.id, d.line, d.column) for d in result.diagnostics] == [("22156", 1, 12)]


def test_rotation_variables():
    before = "G70\n#ROTATION ON [ANGLE=-45 CENTER1=1 CENTER2=2]\nX1"
    found = [
        message_of(f"V.G.ROT_{name}", before) for name in ("ACTIVE", "ANGLE", "CENTER1", "CENTER2")
    ]
    assert found == pytest.approx([1, -45, 1, 2])
    assert message_of("V.G.ROT_ACTIVE", "#ROTATION ON\n#ROTATION OFF") == 0


def test_written_and_mapped_coordinate():
    before = "#ROTATION ON [ANGLE=90]\nG22\nX10 Y3"
    assert message_of("V.A.MENT.X", before) == pytest.approx(10)
    assert message_of("V.A.PROG.X", before) == pytest.approx(-3)
    assert message_of("V.A.PROG.Y", before) == pytest.approx(-10)


# --- mirror ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("g", "expected"), [("G21", (-1, 2, 3)), ("G22", (1, -2, 3)), ("G23", (-1, -2, 3))]
)
def test_mirror_of_the_plane(g, expected):
    assert axes_of(f"{g} X1 Y2 Z3")[-1] == pytest.approx(expected)
    assert axes_of(f"{g}\nG20\nX1 Y2 Z3")[-1] == pytest.approx([1, 2, 3])


def test_mirror_leaves_offsets_and_relative_words_turn_their_sign():
    rows = axes_of("G92 X10\nX5\nG21\nX5\nG91 X1")
    assert rows[:, 0] == pytest.approx([15, 5, 4])


def test_g351_mirrors_the_value_of_g92_too():
    rows = axes_of("V.G.NP[1].V.X=100\nG54\nG92 X10\nX5\nG351 X-1\nX5\nG351 X1\nX5")
    assert rows[:, 0] == pytest.approx([115, 85, 115])


@pytest.mark.parametrize("text", ["G351 X2", "G351", "G351 X-1 F100", "G90 G351 X-1"])
def test_g351_written_wrongly(text):
    assert ids_of(text) == ["20860"]


def test_preset_under_contour_functions():
    assert ids_of("G21\n#PSET X5") == ["20612"]
    assert ids_of("#ROTATION ON [ANGLE=5]\n#PSET X5") == ["N2005"]
    assert axes_of("X10\n#SCALE ON X2\n#PSET X1\nX2")[-1][0] == pytest.approx(12)


# --- scale -------------------------------------------------------------------------------------


def test_scale_leaves_offsets():
    rows = axes_of("G92 X10\nX5\n#SCALE X2\nX5\n#SCALE ON\nX5\nG91 X1\nG90\n#SCALE OFF\nX5")
    assert rows[:, 0] == pytest.approx([15, 15, 20, 22, 15])


@pytest.mark.parametrize("text", ["#SCALE ON X0", "#SCALE X-1", "#SCALE ON X2\n#SCALE X3"])
def test_scale_factors_refused(text):
    assert ids_of(text) == ["N2020"]


# --- suppress ----------------------------------------------------------------------------------


def test_e2_suppress():
    text = TWO_OFFSETS + (
        "X100 Y150\n#SUPPRESS OFFSETS X50 Y100\n#SUPPRESS OFFSETS [ZERO] X50 Y100\n"
        "#SUPPRESS OFFSETS [ADD_ZERO] X50 Y100\nX50 Y100"
    )
    expected = [(121, 192), (50, 100), (60, 120), (61, 122), (71, 142)]
    assert axes_of(text)[:, :2] == pytest.approx(np.array(expected))


def test_suppress_leaves_the_other_axes_where_they_are():
    rows = axes_of(TWO_OFFSETS + "X100 Y150\n#SUPPRESS OFFSETS X50\nG91 Y1")
    assert rows[1] == pytest.approx([50, 192, 0])
    assert rows[2] == pytest.approx([50, 193, 0])


def test_suppress_keeps_coordinate_system_and_takes_all_levels():
    text = "G92 X10\n#CS ON [100,0,0,0,0,90]\nG92 X5\n#SUPPRESS OFFSETS X1 Y0 Z0"
    assert axes_of(text)[-1] == pytest.approx([100, 1, 0])


def test_suppress_acts_after_the_words_of_its_block():
    result = result_of("G91 X1\nG90 G01 F100 #SUPPRESS OFFSETS X7")
    assert result.check().acs[-1][0] == 7
    assert result.motion[-1] == "G01"
    assert ids_of("G91 #SUPPRESS OFFSETS X7") == ["20985"]


def test_explain_shows_the_contour_and_sums_up():
    text = "G92 X10\n#SCALE ON X2\n#ROTATION ON [ANGLE=30]\nG21\nX5 Y1\n#SUPPRESS OFFSETS X5"
    result = result_of(text).check()
    layers = result.explain(5).layers
    assert [layer.name for layer in layers] == [
        "programmed", "scale", "contour rotation", "mirror", "G92", "axes",
    ]  # fmt: skip
    assert [layer.origin for layer in layers[1:4]] == ["program:2", "program:3", "program:4"]
    total = layers[0].values + np.sum([layer.change for layer in layers], axis=0)
    assert total == pytest.approx(result.acs[-2], abs=1e-12)
    assert "G92" not in [layer.name for layer in result.explain(6).layers]
