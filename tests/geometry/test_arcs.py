"""Laws of arcs: points on the circle, sense, mirrors, both ways of writing, hostile input."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope

quick = settings(max_examples=80, deadline=None)
coordinates = st.floats(-500, 500, allow_nan=False).map(lambda v: round(v, 3))
points = st.tuples(coordinates, coordinates)
senses = st.sampled_from(["G02", "G03"])


def path(program, sample=1.0, machine=None):
    """Axis positions (k, n) of a program that ends well, with the points between."""
    machine = machine or ncscope.Machine()
    options = ncscope.Options(sample=sample)
    return ncscope.run(machine, program + "\nM30\n", options).check().acs


def on_circle(centre, radius, angle_rad):
    return centre[0] + radius * math.cos(angle_rad), centre[1] + radius * math.sin(angle_rad)


@quick
@given(points, st.floats(1, 400), st.floats(-180, 180), st.floats(1, 359), senses)
def test_points_lie_on_the_circle_in_the_right_sense(centre, radius, begin, sweep, sense):
    """An independent description: centre, radius, start angle and turned angle."""
    turned = math.radians(begin + (sweep if sense == "G03" else -sweep))
    start, end = on_circle(centre, radius, math.radians(begin)), on_circle(centre, radius, turned)
    way = centre[0] - start[0], centre[1] - start[1]
    words = "X{:.12f} Y{:.12f} I{:.12f} J{:.12f}".format(*end, *way)
    acs = path("G01 F100 X{:.12f} Y{:.12f}\n{} {}".format(*start, sense, words))[:, :2]
    distance = np.hypot(*(acs - centre).T)
    np.testing.assert_allclose(distance, radius, atol=1e-6)
    angles = np.unwrap(np.arctan2(acs[:, 1] - centre[1], acs[:, 0] - centre[0]))
    sign = 1 if sense == "G03" else -1
    assert (np.diff(angles) * sign > 0).all()
    assert math.isclose((angles[-1] - angles[0]) * sign, math.radians(sweep), abs_tol=1e-6)


@quick
@given(points, points, st.floats(1.001, 5), st.booleans(), senses)
def test_a_radius_gives_the_short_or_the_long_arc(start, end, factor, long, sense):
    distance = math.dist(start, end)
    if distance < 0.01:
        return
    radius = factor * distance / 2
    word = f"R{-radius if long else radius:.9f}"
    acs = path("G01 F1 X{} Y{}\n{} X{} Y{} {}".format(*start, sense, *end, word), 0.01)[:, :2]
    half = math.asin(1 / factor)
    turned = 2 * math.pi - 2 * half if long else 2 * half
    length = np.hypot(*np.diff(acs, axis=0).T).sum()
    assert math.isclose(length, radius * turned, rel_tol=2e-2, abs_tol=0.02)
    side = (end[0] - start[0]) * (acs[:, 1] - start[1]) - (end[1] - start[1]) * (
        acs[:, 0] - start[0]
    )
    # counter-clockwise arcs stay on the right of their chord
    assert side.max() <= 1e-6 * distance if sense == "G03" else side.min() >= -1e-6 * distance


@pytest.mark.parametrize(
    ("mirror", "signs"), [("G21", (-1, 1)), ("G22", (1, -1)), ("G23", (-1, -1))]
)
def test_a_mirrored_arc_is_the_mirror_of_its_points(mirror, signs):
    arc = "G01 F100 X3 Y4\nG02 X13 Y-6 I8 J-2\nG03 X20 Y0 R40"
    plain, mirrored = path(arc), path(f"{mirror}\n{arc}")
    np.testing.assert_allclose(mirrored[:, :2], plain[:, :2] * signs, atol=1e-12)


@quick
@given(st.tuples(*[st.floats(-180, 180)] * 3), st.tuples(*[coordinates] * 3))
def test_an_arc_in_a_system_is_the_arc_moved(angles, shift):
    arc = "G01 F100 X3 Y4 Z5\nG02 X13 Y-6 Z7 I8 J-2"
    values = ",".join(f"{v:.6f}" for v in (*shift, *angles))
    a, b, c = (math.radians(round(v, 6)) for v in angles)
    rz = np.array([[math.cos(c), -math.sin(c), 0], [math.sin(c), math.cos(c), 0], [0, 0, 1]])
    ry = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    rx = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    wanted = path(arc) @ (rz @ ry @ rx).T + shift
    np.testing.assert_allclose(path(f"#CS ON [{values}]\n{arc}"), wanted, atol=1e-9)


VALUE = st.one_of(
    st.floats(-300, 300, allow_nan=False).map(lambda v: f"{v:.3f}"),
    st.sampled_from(["0", "-0", "0.0001", "9" * 200, "-" + "9" * 320, "1" + "0" * 15]),
)
WORD = st.tuples(st.sampled_from("XYZIJKRF"), VALUE).map("".join)
BLOCK = st.tuples(
    st.sampled_from(["", "G02 ", "G03 ", "G01 ", "G17 ", "G18 G02 ", "G19 ", "G161 ", "G162 G03 ",
                     "G163=5 ", "G163 ", "G164 ", "G165 ", "G70 ", "G91 G02 ", "G21 ",
                     "#SCALE ON X2 Y3\n", "#CS ON [1,2,3,40]\n", "#ROTATION ON [ANGLE 20]\n"]),
    st.lists(WORD, max_size=5),
).map(lambda parts: parts[0] + " ".join(parts[1]))  # fmt: skip


@settings(max_examples=300, deadline=None)
@given(st.lists(BLOCK, min_size=1, max_size=6), st.booleans())
def test_any_circle_words_end_in_positions_or_a_diagnostic(blocks, sampled):
    text = "\n".join(blocks) + "\nM30\n"
    result = ncscope.run(ncscope.Machine(), text, ncscope.Options(sample=5.0 if sampled else None))
    assert np.isfinite(result.acs).all()
    assert result.ok or any(d.is_error and d.span is not None for d in result.diagnostics)


def test_a_plane_that_the_channel_does_not_have():
    machine = ncscope.Machine(axes=ncscope.Machine().axes[:2])
    result = ncscope.run(machine, "G18 G02 X1 I1\nM30\n")
    assert [d.id for d in result.diagnostics if d.is_error] == ["20010"]


def test_arc_is_refused_with_suppressed_offsets():
    result = ncscope.run(ncscope.Machine(), "G02 #SUPPRESS OFFSETS X5\nM30\n")
    assert [d.id for d in result.diagnostics] == ["N2001"]
