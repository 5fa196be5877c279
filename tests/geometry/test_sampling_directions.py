"""Points between block ends under a complete transformation, and G00 with P-CHAN-00423.

The head of the tests turns C, then A; its tool at C, A is d = (sinC sinA, -cosC sinA, cosA).
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import ncscope
from ncscope.kinematics import KinematicParameters
from ncscope.machine import Axis, ChannelSettings, Machine

HEAD = {
    "zero_orientation": [0, 0, 1],
    "number_of_axes": 5,
    "axis": [
        *({"type": 1, "orientation": list(row)} for row in np.eye(3)),
        {"type": 2, "orientation": [0, 0, 1]},
        {"type": 2, "orientation": [1, 0, 0]},
    ],
    "chain": [0, 1, 2, 3, 4],
    "programming_mode": 17,
    "rtcp": 0,
}
BEGIN = "V.G.WZ_AKT.L=50\n{start}\n#TRAFO [91]\nG01 F100 X0\n"


def run(text: str, start: str = "C0 A30", rtcp: int = 0, names: str = "XYZCA", **settings):
    mode = 10 if "U" in names else 17
    fields = HEAD | {"rtcp": rtcp, "programming_mode": mode}
    own = Machine(
        axes=tuple(Axis(name, i + 1, rotary=name in "ABC") for i, name in enumerate(names)),
        kinematic_parameters={91: KinematicParameters.from_fields(fields)},
        settings=ChannelSettings(**settings),
    )
    program = BEGIN.format(start=start) + text + "\n#TRAFO OFF\nM30\n"
    return ncscope.run(own, program, ncscope.Options(sample=0.05)).check()


def tool(c: float, a: float) -> np.ndarray:
    c, a = np.radians([c, a])
    return np.array([np.sin(c) * np.sin(a), -np.cos(c) * np.sin(a), np.cos(a)])


def last_move(result):
    """Shares of the way by X, directions, and rows of the last block."""
    rows = np.flatnonzero(result.line == result.line[-1])
    before = result.pcs[rows[0] - 1, 0]
    share = (result.pcs[rows, 0] - before) / (result.pcs[rows[-1], 0] - before)
    return share, result.direction[rows], rows


def test_the_tool_turns_in_the_plane_of_both_ends_at_constant_rate():
    """C0 A30 to C90 A60: cos of the whole angle is (0, -1/2, .866) (.866, 0, 1/2) = .433."""
    share, directions, rows = last_move(run("X10 C90 A60"))
    first, last = tool(0, 30), tool(90, 60)
    angle = np.arccos(0.75**0.5 / 2)
    expected = np.sin((1 - share) * angle)[:, None] * first + np.sin(share * angle)[:, None] * last
    assert len(rows) > 8
    np.testing.assert_allclose(directions, expected / np.sin(angle), atol=1e-12)


def test_programmed_values_between_mean_the_directions_there():
    result = run("X10 C90 A60")
    for pcs, direction in zip(result.pcs[1:], result.direction[1:], strict=True):
        np.testing.assert_allclose(tool(*pcs[3:]), direction, atol=1e-12)
    assert result.pcs[-1].tolist()[3:] == [90, 60]


def test_offsets_of_an_angle_and_turned_systems_change_no_plane():
    """G92 C20 with C70 means C90; a system turned by 25 about X turns the whole way (ori_wcs)."""
    plain = run("X10 C90 A60")
    expected = last_move(plain)[1]
    shifted = run("X10 C70 A60", start="C0 A30\nG92 C20")
    np.testing.assert_allclose(last_move(shifted)[1], expected, atol=1e-12)
    text = "#CS ON [0,0,0,25,0,0]\nX5 C0 A30\nX10 C90 A60\n#CS OFF"
    turned = last_move(run(text, direction_turns=True))
    s, c = np.sin(np.radians(25)), np.cos(np.radians(25))
    ends = np.array([tool(0, 30), tool(90, 60)]) @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    normal = np.cross(*ends)
    np.testing.assert_allclose(turned[1] @ normal, 0, atol=1e-12)
    np.testing.assert_allclose(turned[1][-1], ends[1], atol=1e-12)


def test_angles_run_linearly_where_the_channel_says_so():
    """P-CHAN-00417 = -1."""
    share, _, rows = last_move(run("X10 C90 A60", direction_path=-1))
    result = run("X10 C90 A60", direction_path=-1)
    expected = np.column_stack([90 * share, 30 + 30 * share])
    np.testing.assert_allclose(result.pcs[rows, 3:], expected, atol=1e-9)


def test_a_whole_turn_of_the_words_turns_no_tool():
    """C360 is the direction of C0; the plane way is the shortest, so the axes stay."""
    result = run("X10 C360")
    np.testing.assert_allclose(result.acs[:, 3:], np.tile([0, 30], (len(result), 1)), atol=1e-9)


def test_opposite_directions_span_no_plane_and_keep_their_angles():
    share, directions, _ = last_move(run("X10 A-150"))
    expected = np.array([tool(0, 30 - 180 * s) for s in share])
    np.testing.assert_allclose(directions, expected, atol=1e-9)


def test_vectors_run_straight():
    result = run("X10 U1 W1", start="V30", names="XYZUVW")
    share, _, rows = last_move(result)
    first = np.array([0, -0.5, 0.75**0.5])
    expected = first + share[:, None] * (np.array([1, -0.5, 1]) - first)
    np.testing.assert_allclose(result.pcs[rows, 3:], expected, atol=1e-9)


@pytest.mark.parametrize("rtcp", [0, 1])
def test_rapid_motion_may_run_point_to_point(rtcp):
    """P-CHAN-00423: axes run straight with G00 and not with G01; the ends are the same."""
    text = "G00 X10 C90 A60\nG01 X20 C0 A30\nG00 X30 C40"
    plain, straight = run(text, rtcp=rtcp), run(text, rtcp=rtcp, rapid_straight=True)
    np.testing.assert_array_equal(plain.acs[plain.end], straight.acs[straight.end])
    for result, bent in ((plain, [True] * 3), (straight, [False, True, False])):
        moves = itertools.pairwise(np.flatnonzero(result.end)[1:])
        found = [_is_bent(result.acs[first : last + 1]) for first, last in moves]
        assert found == bent
    assert (np.diff(straight.line) >= 0).all()


def _is_bent(part: np.ndarray) -> bool:
    """Whether axis positions are more than a millimetre or degree off the line of their ends."""
    way = part[-1] - part[0]
    share = (part[:, 3] - part[0, 3]) / way[3]
    return bool(np.abs(part - part[0] - share[:, None] * way).max() > 1)
