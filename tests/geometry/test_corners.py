"""Laws of inserted chamfers and roundings: no corner is left, the ends stay, hostile input."""

import math

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import ncscope

quick = settings(max_examples=80, deadline=None)
small = st.floats(-50, 50, allow_nan=False).map(lambda v: round(v, 2))
points = st.tuples(small, small)


def run(text, sample=None):
    return ncscope.run(ncscope.Machine(), text + "\nM30\n", ncscope.Options(sample=sample))


def element(kind, end, radius):
    sense = {"line": "G01", "cw": "G02", "ccw": "G03"}[kind]
    return f"{sense} X{end[0]} Y{end[1]}" + ("" if kind == "line" else f" R{radius}")


KIND = st.sampled_from(["line", "cw", "ccw"])


@quick
@given(points, points, KIND, KIND, st.floats(75, 120), st.floats(75, 120), st.floats(0.1, 20))
def test_a_rounding_leaves_no_corner(corner, end, before, behind, first, second, radius):
    assume(math.hypot(*corner) > 1 and math.dist(corner, end) > 1)
    into, out = element(before, corner, round(first, 2)), element(behind, end, round(second, 2))
    text = f"G01 F100 X0 Y0\n{into}\nG302 I{radius:.3f}\n{out}"
    result = run(text, 0.001)
    if not result.ok:
        assert [d.id for d in result.diagnostics if d.is_error] == ["N2033"]
        return
    np.testing.assert_allclose(result.acs[-1, :2], end, atol=1e-9)
    arc = result.acs[result.line == 3][:, :2]
    if len(arc) == 0:
        return
    way = np.diff(np.vstack([[0.0, 0.0], result.acs[:, :2]]), axis=0)
    way = way[np.hypot(*way.T) > 1e-6]
    heading = np.unwrap(np.arctan2(way[:, 1], way[:, 0]))
    widest = 2 * math.acos(1 - 0.001 / round(radius, 3))
    assert np.abs(np.diff(heading)).max() < 1.1 * widest + 1e-3


@quick
@given(points, points, st.floats(0.1, 20), st.booleans())
def test_a_chamfer_is_as_far_from_the_corner_on_both_sides(corner, end, size, width):
    assume(math.hypot(*corner) > 1 and math.dist(corner, end) > 1)
    word = f"#CHF={size:.3f}" if width else f"#CHR={size:.3f}"
    result = run("G01 F100 X{} Y{} {}\nX{} Y{}".format(*corner, word, *end))
    if not result.ok:
        assert [d.id for d in result.diagnostics if d.is_error] == ["N2033"]
        return
    begin, stop = result.acs[:2, :2]
    sides = math.dist(begin, corner), math.dist(stop, corner)
    assert math.isclose(*sides, abs_tol=1e-9)
    assert math.isclose(math.dist(begin, stop) if width else sides[0], round(size, 3), abs_tol=1e-6)
    assert abs(begin[0] * corner[1] - begin[1] * corner[0]) < 1e-6  # still on the first line


def test_feed_and_motion_of_an_insertion():
    text = "G01 F100 X10\nG302 I1 #FRC=20\nY10\nG301 I2\nG00 X0\nM30"
    result = run(text)
    assert result.motion.tolist() == ["G01", "G03", "G01", "G00", "G00"]
    assert result.feed.tolist() == [100, 20, 100, 100, 100]
    assert result.line.tolist() == [1, 2, 3, 4, 5]


def test_a_corner_behind_bulk_blocks_is_the_same():
    lines = "".join(f"N{i} X{i} Y{i % 7}\n" for i in range(1, 60))
    text = f"G01 F100\n{lines}G302 I0.1\nX61 Y9\n{lines}X5 #CHR=0.2\nY40\n{lines}M30\n"
    fast, slow = (
        ncscope.run(ncscope.Machine(), text, ncscope.Options(bulk=bulk)) for bulk in (True, False)
    )
    assert fast.ok and slow.ok and len(fast) == len(slow) == 3 * 59 + 5
    np.testing.assert_array_equal(fast.acs, slow.acs)


WORDS = st.sampled_from(
    ["G01 X10", "Y5", "X-3 Y4", "G02 X5 Y5 R9", "G03 X1 Y1 I3", "G301 I2", "G302 I1", "G301",
     "X8 #RND=1", "Y9 #CHF=2 #FRC=5", "#FRC=1", "#CHR=0", "#RND=-1", "G302 I99999", "Z4", "G18",
     "G91 X0", "X0 Y0", "#CS ON [1,2,3,0,0,30]", "G54", "#SCALE ON X2", "G302", "M17", "G302 I0"]
)  # fmt: skip


@settings(max_examples=200, deadline=None)
@given(st.lists(WORDS, min_size=2, max_size=8), st.booleans())
def test_any_corner_ends_in_positions_or_a_diagnostic(blocks, sampled):
    result = run("F100\n" + "\n".join(blocks), 1.0 if sampled else None)
    assert np.isfinite(result.acs).all()
    assert result.ok or any(d.is_error and d.span is not None for d in result.diagnostics)
