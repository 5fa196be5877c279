"""Both lanes have one meaning: the same moves, diagnostics and end, however a program is cut."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope
from ncscope.execution import Options
from ncscope.inspection import inspect
from ncscope.language.scanner import Scanner
from ncscope.machine import Axis, Machine, OffsetRecord, ZeroOffsets

MACHINES = Path(__file__).parents[1] / "examples" / "machines"
CA_HEAD, _ = ncscope.load_machine(MACHINES / "ca_head")
FLAT = Machine(
    axes=(Axis("X", 1), Axis("Y", 2), Axis("Z", 3), Axis("C", 4, rotary=True), Axis("A", 5, True)),
    zero_offsets=ZeroOffsets({1: OffsetRecord({0: 10.0, 1: -5.5, 4: 30.0})}),
)
TURNING = replace(
    FLAT,
    axes=(
        Axis("X", 1, face_turning=True, diameter_absolute=True),
        *FLAT.axes[1:3],
        Axis("C", 4, rotary=True, modulo_range=(0.0, 360.0)),
        FLAT.axes[4],
    ),
)

NUMBER = st.one_of(
    st.integers(-2000, 2000).map(str),
    st.floats(-500, 500).map(lambda v: f"{v:.4f}"),
    st.sampled_from(["0", "-0", "+1.5", ".5", "5.", "1.23456789012345", "1.234567890123456789"]),
)
AXIS_WORD = st.tuples(st.sampled_from("XYZAC"), NUMBER).map("".join)
PLAIN = st.tuples(
    st.sampled_from(["", "N10 ", "N20", "  "]),
    st.sampled_from(["", "G0 ", "G01", "G1 ", "G90 ", "G91 G1 ", "G91"]),
    st.lists(AXIS_WORD, min_size=0, max_size=4),
    st.sampled_from(["", "F1000", " F20.5", " (note)", "; note", "(open", "(a(b)c)", "(a) F5 (b)"]),
    st.sampled_from([" ", ""]),
).map(lambda p: p[0] + p[1] + p[4].join(p[2]) + p[3])
SYSTEMS = st.sampled_from(
    [
        "#TRAFO STACK OFF", "#TRANSFORM [B] [MCS] [1,2,3]", "XV.A.TRANSFORM.Y", "#CS DEL ALL",
        "#CS MODE OFF [AXES_OFFSETS_LAYER_SPECIFIC]", "G92 A5", "#CS OFF ALL", "#CS SELECT [A]",
        "#CS ADD [A] [1,2,3,0,10,0]", "#CS ADD [B] [0,0,5,0,0,40]", "#CS ON [1,2,3,4,5,6]",
    ]
)  # fmt: skip
OTHER = st.sampled_from(
    [
        "", "   ", "; comment", "(note)", " (a) ; b", "(a)(b)\\", "(a (b) c)", "(a))", "N7 (n)",
        "X1(c)2", "X(c)1", "X1(c)Y2", ";\\", "(a\\",
        "(open comment X1", "G54", "G53 X1", "G92 X5", "G70", "G71 Y2",
        "#PSET X3", "#CS ON [1,2,3,0,0,30]", "#CS OFF", "P1=4 XP1", "X[P1+1]", "X1 ; tail",
        "#COMMENT BEGIN", "#COMMENT END", "X1 X2", "G1 G0 X1", "x1", "X10 +5", "G4 X2", "D1",
        "#VAR", "#ENDVAR", "/X9", "N5 N6 X1", "X1\\", "%late", "M30", "X1 I2", "G02 X1 I4", "F0",
        "#ROTATION ON [ANGLE 30 CENTER1=5]", "#ROTATION OFF", "G68 R20", "G69", "G18", "G17", "G21",
        "G20", "G351 Y-1", "#SCALE ON X2 Y3", "#SCALE OFF", "#MCS ON", "#MCS OFF", "G100 X5",
        "#SUPPRESS OFFSETS X5", "#ACS ON [1,2,3,10]", "#ACS OFF", "G101 X1", "G74 X1", "G201 X1",
        "#TLAX [X+]", "#MEAS [TYPE=3]", "G100 G106 X5 F500", "G102", "#CHANNEL INIT [CMDPOS]",
        "#CS ADD [A] [1,2,3,0,10,0]", "#CS ADD [B] [0,0,5,0,0,40]", "#CS SELECT [A]", "#CS DEL",
        "#CS SELECT [B]", "#CS SELECT [MCS]", "#CS SET [A] [4,5,6]", "#CS TRACK [A] [1,2,3]",
        "#ECS ON", "#ECS OFF", "#BCS ON [K] [0,1,0,0,0,5]", "#BCS OFF",
        "G02 X10 I5 J5", "G03 X1 Y1 R900", "G2", "G3", "G18", "X4 Z2 I3 K4", "G161", "G163=700",
        "G41", "G40", "G33 Z1 K2", "G63", "G04 2.5", "G04 P1", "G98 X-5",
        "G51", "G52", "C+-20", "G91 C-700",
        "G301 I0.5", "G302 I0.1", "X5 #RND=0.2", "Y7 #CHF=1",
    ]
)  # fmt: skip
KINEMATIC = st.sampled_from(
    ["#TRAFO OFF", "#TRAFO ON", "#PTP ON", "#PTP OFF", "#TOOL ORI CS", "#TLC OFF", "#TLC ON [5]",
     "#TRAFO [OFF]", "V.G.KIN[91].ZERO_POSITION[1] = 5", "#CS ON [0,0,0,20]", "#KIN ID [91]"]
)  # fmt: skip
LINES = st.lists(st.one_of(PLAIN, PLAIN, PLAIN, OTHER), min_size=1, max_size=14)


def outcome(machine, text, bulk, **options):
    result = ncscope.run(machine, text, Options(bulk=bulk, **options))
    found = [(d.id, d.message, d.line, d.column) for d in result.diagnostics]
    return result, found


def assert_equal(machine, text, **options):
    fast, fast_found = outcome(machine, text, True, **options)
    slow, slow_found = outcome(machine, text, False, **options)
    assert fast_found == slow_found
    assert (fast.ok, fast.axes, len(fast)) == (slow.ok, slow.axes, len(slow))
    for name in ("line", "block", "motion"):
        assert getattr(fast, name).tolist() == getattr(slow, name).tolist(), name
    for name in ("feed", "pcs", "acs", "wcs", "mcs", "direction"):
        np.testing.assert_allclose(
            getattr(fast, name), getattr(slow, name), rtol=0, atol=1e-12, err_msg=name
        )


@settings(max_examples=300, deadline=None)
@given(LINES, st.sampled_from(["\n", "\r\n"]), st.booleans(), st.sampled_from([FLAT, TURNING]))
def test_lanes_agree_on_mixed_programs(lines, end, last, machine):
    assert_equal(machine, end.join(lines) + (end if last else ""))


COMPLETE = "V.G.KIN[91].RTCP = 0\n"
SLANTED = COMPLETE + "V.G.KIN[91].AXIS[4].ORIENTATION[1] = 1\n"
VECTOR = (
    "#SET AX [X,1,0] [Y,2,1] [Z,3,2] [A,4,3] [C,5,4] [W,9,5]\nV.G.KIN[91].PROGRAMMING_MODE = 10\n"
)


@settings(max_examples=120, deadline=None)
@given(
    st.lists(st.one_of(PLAIN, PLAIN, PLAIN, OTHER, KINEMATIC), min_size=1, max_size=14),
    st.integers(0, 6),
    st.sampled_from(["", COMPLETE, SLANTED, VECTOR]),
)
def test_lanes_agree_under_a_kinematics_and_a_block_limit(lines, limit, kinematics):
    """RTCP, complete, complete with directions out of reach, and a direction as a vector."""
    text = kinematics + "#KIN ID [91]\n#TRAFO ON\n" + "\n".join(lines) + "\n"
    assert_equal(CA_HEAD, text, max_blocks=limit and limit + 5)


MODULO_WORD = st.sampled_from(
    ["C350", "C-10", "C-350", "C+10", "C-0", "C 0", "C725", "C-.5", "C - 5", "C359.9999999999",
     "G91 C-700", "G91 C350", "G90 C180", "C-180", "C180.5", "X5", "A20", "G1 F100"]
)  # fmt: skip


@settings(max_examples=150, deadline=None)
@given(
    st.lists(st.one_of(MODULO_WORD, MODULO_WORD, PLAIN), min_size=1, max_size=12),
    st.sampled_from([(0.0, 360.0), (-180.0, 180.0)]),
    st.booleans(),
    st.sampled_from(["", "#KIN ID [91]\n#TRAFO ON\n", COMPLETE + "#KIN ID [91]\n#TRAFO ON\n"]),
    st.sampled_from([None, 0.5]),
)
def test_lanes_agree_on_modulo_axes(lines, turns, shortest, kinematics, sample):
    axes = tuple(replace(a, modulo_range=turns) if a.name == "C" else a for a in CA_HEAD.axes)
    settings = replace(CA_HEAD.settings, modulo_shortest=shortest)
    machine = replace(CA_HEAD, axes=axes, settings=settings)
    text = kinematics + "G90 F500 G1\n" + "\n".join(lines) + "\nM30\n"
    assert_equal(machine, text, sample=sample)


def test_modulo_axes_do_take_the_bulk_lane(stepped):
    text = "G1 F100 C0\n" + "".join(f"N{i} C{i * 7 % 360}\n" for i in range(200)) + "M30\n"
    result = ncscope.run(TURNING, text, Options(bulk=True))
    assert stepped == [202]
    assert result.pcs[200, 3] == 199 * 7 % 360


LIMITED = replace(
    FLAT, axes=tuple(replace(axis, limits=(-30.0, 30.0)) for axis in FLAT.axes[:3]) + FLAT.axes[3:]
)
SMALL = st.integers(-400, 400).map(lambda v: f"{v / 10:g}")
ANGLE = st.sampled_from([0, 30, 45, 90, 120, 180, 200, 270, 300, 359])


@st.composite
def circles(draw):
    """Blocks with arcs of which most are right: the ends lie on a circle about the centre, some a
    little beside it; the plane, G91, G161, G164 and inches change in between."""
    at, lines, absolute, inverted = [0.0, 0.0, 0.0], ["G90 G17 G1 X0 Y0 Z0 F100"], True, False
    axes = (0, 1)
    for _ in range(draw(st.integers(1, 8))):
        kind = draw(st.sampled_from(["arc", "arc", "arc", "arc", "other"]))
        if kind == "other":
            line = draw(st.sampled_from(MODES))
            lines.append(line)
            absolute = {"G91": False, "G90": True}.get(line, absolute)
            inverted = {"G161": True, "G162": False}.get(line, inverted)
            axes = {"G17": (0, 1), "G18": (2, 0), "G19": (1, 2)}.get(line, axes)
            continue
        radius, begin, turn = draw(st.integers(1, 20)), draw(ANGLE), draw(ANGLE)
        off = draw(st.sampled_from([0.0, 0.0, 0.0, 1e-3, 0.05, 0.3, 3.0]))
        back = [-radius * math.cos(math.radians(begin)), -radius * math.sin(math.radians(begin))]
        end = [b + (radius + off) * f(math.radians(begin + turn))
               for b, f in zip(back, (math.cos, math.sin), strict=True)]  # fmt: skip
        words = [f"{'XYZ'[a]}{(at[a] if absolute else 0.0) + e:.4f}"
                 for a, e in zip(axes, end, strict=True)]  # fmt: skip
        centre = [f"{'IJK'[a]}{(at[a] if inverted else 0.0) + b:.4f}"
                  for a, b in zip(axes, back, strict=True)]  # fmt: skip
        other = f"{'XYZ'[3 - sum(axes)]}{draw(SMALL)}"
        extra = draw(st.sampled_from(["", "", "", other, f"K{draw(SMALL)}", "F200", "A3 C-4"]))
        how = draw(
            st.sampled_from([centre, centre, centre[:1], [f"R{radius}"], [f"R-{radius}"], []])
        )
        code = draw(st.sampled_from(["G2", "G03", "G2", "G3", ""]))
        drop = draw(st.sampled_from([0, 0, 0, 0, 1, 2]))
        lines.append(" ".join(filter(None, [code, *words[drop:], *how, extra])))
        at = [float(v) for v in at]
        for a, e in zip(axes, end, strict=True):
            at[a] += e
    return lines


MODES = ["G91", "G90", "G161", "G162", "G164", "G165", "G17", "G18", "G19", "G163=7", "G70", "G71",
         "XV.G.I YV.G.R", "G1 X3 Y4", "G0 Z5", "", "(note)", "M8", "#SCALE ON X2 Y2", "G01 X1 I2",
         "G351 X-1", "#CS ON [1,2,3,20]", "#ROTATION ON [ANGLE 30]", "R5", "I3", "G2", "G41",
         "#PTP ON"]  # fmt: skip


@settings(max_examples=400, deadline=None)
@given(
    circles(),
    st.sampled_from([(LIMITED, ""), (LIMITED, ""), (CA_HEAD, "#KIN ID [91]\n#TRAFO ON\n")]),
    st.sampled_from([None, None, 0.5]),
)
def test_lanes_agree_on_arcs(lines, held, sample):
    machine, head = held
    text = head + "\n".join(lines) + "\nM30\n"
    assert_equal(machine, text, sample=sample)
    fast, slow = (ncscope.run(machine, text, Options(bulk=bulk)) for bulk in (True, False))
    for mine, other in zip(inspect(fast).travel, inspect(slow).travel, strict=True):
        assert (mine.axis, mine.low_row, mine.high_row) == (
            other.axis,
            other.low_row,
            other.high_row,
        )
        np.testing.assert_allclose([mine.low, mine.high], [other.low, other.high], atol=1e-12)


ARCS = {
    "inches": ("G70 G91", ["G2 X1 Y1 I1", "G3 X1 Y1 R1", "G3 X1 Y-1 R-1", "G2 I0.5"]),
    "plane of Z and X": ("G18", ["G2 Z5 X5 I5", "G3 Z0 X0 K-5", "G2 Z3 X3 Y4 R3", "G1 Z0 X0"]),
    "plane of Y and Z": ("G19 G91", ["G2 Y5 Z5 J5", "G3 Y-5 Z-5 K-5", "G3 Y2 Z2 X1 R2"]),
    "absolute centres": ("G161", ["G2 X10 Y0 I5 J0", "G3 X0 Y0 I5", "G2 X0 Y8 I0 J4", "G1 Y0"]),
    "centres as they are": ("G164", ["G2 X10 Y0.0005 I5 J0", "G3 X0 Y0 I-5"]),
    "stored radius": ("G163=7", ["G2 X1 Y1", "G3 X5 Y5", "G1 X0", "G2 X5 Y0 R9", "G3 X0 Y0"]),
    "full circles": ("G91", ["G3 I5", "G2 J-5 F200", "G3 X0 Y0 I1"]),
}


@pytest.mark.parametrize("name", ARCS)
def test_arcs_of_all_kinds_take_the_bulk_lane(stepped, name):
    head, lines = ARCS[name]
    text = f"G90 G1 X0 Y0 Z0 F100\n{head}\n" + "\n".join(lines * 3) + "\nG1 XV.G.I YV.G.R\nM30\n"
    assert_equal(LIMITED, text)
    stepped.clear()
    result = ncscope.run(LIMITED, text, Options(bulk=True)).check()
    assert stepped == [2, 3 + 3 * len(lines), 4 + 3 * len(lines)]
    assert len(result) == 2 + 3 * len(lines)


def test_arcs_do_take_the_bulk_lane(stepped):
    """Quarter circles about the origin: centre from the start, absolute end points."""
    quarter = ["X0 Y10 I-10", "X-10 Y0 J-10", "X0 Y-10 I10", "X10 Y0 J10"]
    text = "G1 F100 X10 Y0\nG3 X10 Y0 I-10\n" + "\n".join(quarter * 50) + "\nG3 X0 Y10 R-10\nM30\n"
    result = ncscope.run(LIMITED, text, Options(bulk=True)).check()
    assert stepped == [204]
    assert result.pcs[-1, :2].tolist() == [0.0, 10.0]
    reached = {t.axis.name: (t.low, t.high) for t in inspect(result).travel}
    np.testing.assert_allclose(
        reached["X"], (-10.0, 20.0), atol=1e-9
    )  # three quarters about (10, 10)
    np.testing.assert_allclose(reached["Y"], (-10.0, 20.0), atol=1e-9)


def test_a_swing_goes_on_from_one_stretch_to_the_next():
    """C turns 2 degrees to and fro while the tool stands 1 degree beside the pole: 11 moves with
    22 degrees, of which the loop lane takes all but the first."""
    loop = "$FOR P1=1,6,1\nX0 A1 C2\nC0\n$ENDFOR\nM30\n"
    text = "#KIN ID [91]\n#TRAFO ON\nG90 F100 G0\n" + loop
    assert_equal(CA_HEAD, text)
    found = ncscope.run(CA_HEAD, text).diagnostics
    assert "22.0 degrees in 11 blocks" in next(d.message for d in found if d.id == "N4102")


def test_free_axes_continue_from_row_to_row_in_both_lanes():
    """A vertical tool leaves C free: it keeps its place. Two rows of three are vertical."""
    rows = "".join(f"X{i} C{20 * i} A{0 if i % 3 else 10 + i}\n" for i in range(60))
    text = f"{COMPLETE}C33 A5\n#KIN ID [91]\n#TRAFO ON\n{rows}M30\n"
    assert_equal(CA_HEAD, text)
    result = ncscope.run(CA_HEAD, text, Options(bulk=True)).check()
    turning = result.acs[1:, 3].reshape(20, 3)
    expected = [(60 * k + 179) % 360 - 179 for k in range(20)]  # 60 k in (-180, 180]
    np.testing.assert_allclose(turning, np.repeat([expected], 3, axis=0).T, atol=1e-9)


def test_a_rounding_behind_a_long_run_begins_where_the_run_was_cut():
    """The last block of 5000 ends 1 mm before X10, and the rounding has the points of a quarter
    circle alone: the tool is vertical and no axis jumps."""
    rows = "".join(f"X{i % 2}\n" for i in range(5000))
    text = f"#KIN ID [91]\n#TRAFO ON\nG1 F100 X0 Y0\n{rows}X10\nG302 I1\nY10\nM30\n"
    assert_equal(CA_HEAD, text, sample=0.5)
    result = ncscope.run(CA_HEAD, text, Options(bulk=True, sample=0.5)).check()
    before, corner = result.stretches[-2:]
    assert before.pcs[-1, 0] == 9.0 and corner.start.tolist() == before.acs[-1].tolist()


@settings(max_examples=60, deadline=None)
@given(st.lists(st.one_of(PLAIN, PLAIN, SYSTEMS), min_size=1, max_size=14))
def test_lanes_agree_on_coordinate_systems(lines):
    assert_equal(FLAT, "\n".join(lines) + "\n")


CUT = "N10 G1 X1.5 Y-2 F100\r\n\r\nN20 X3 A4\nN30 G91 X1\nN40 G90 Z-.5 C10.25\nM30\n"


@pytest.mark.parametrize("cut", range(len(CUT)))
def test_a_program_may_be_cut_anywhere(cut):
    assert_equal(FLAT, CUT[:cut])


SLIP = st.tuples(
    st.integers(0, 200),
    st.integers(0, 1),
    st.sampled_from(list(" \tXGNFEIR19.-+()\r;#$=[]_x\x00\xff\\")),
)


@settings(max_examples=300, deadline=None)
@given(st.lists(PLAIN, min_size=1, max_size=4), st.lists(SLIP, min_size=1, max_size=3))
def test_lanes_agree_on_slips_of_a_finger(lines, slips):
    """A character too many, or another one, anywhere in plain blocks."""
    text = "G1 F100\n" + "\n".join(lines) + "\nM30\n"
    for place, instead, char in slips:
        at = place % len(text)
        text = text[:at] + char + text[at + instead :]
    assert_equal(FLAT, text)


def test_plain_blocks_do_take_the_bulk_lane(stepped):
    """Without this the tests above would compare the step lane with itself."""
    text = "G1 F100 X0\n" + "".join(f"N{i} X{i}.5 Y-{i}\n" for i in range(200)) + "M30\n"
    result = ncscope.run(FLAT, text, Options(bulk=True))
    assert stepped == [202]
    assert result.pcs[200, :2].tolist() == [199.5, -199.0]
    assert result.line[200] == 201


def test_blocks_for_the_step_lane_are_not_scanned_again_and_again(monkeypatch):
    """Each of these blocks is plain to the scanner, and the step lane warns of each."""
    scanned, scan = [], Scanner.scan

    def counted(self, *arguments):
        rows = scan(self, *arguments)
        scanned.append(len(rows))
        return rows

    monkeypatch.setattr(Scanner, "scan", counted)
    text = "G1 F100 X0\n" + "".join(f"G1 X{i} I2\n" for i in range(1000)) + "M30\n"
    result = ncscope.run(FLAT, text, Options(bulk=True))
    assert len(result) == 1001 and len(result.diagnostics) == 1000
    assert sum(scanned) < 5 * len(result)
