"""Programs as a workshop writes them, each with every position that it reaches.

The expected positions are computed here, from the drawing that the program follows and not from its
text: by hand, or by a few lines of plain Python that share nothing with ncscope. Five-axis programs
are checked with the textbook equation of the head: the tip has to be where the program says.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import ncscope
from ncscope.execution import Options
from ncscope.loading import load_program, subprogram_loader
from ncscope.machine import Axis, Machine

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from test_large_program import tip  # noqa: E402

CALLED = {"drill82", "change", "side"}
"""Files that other programs call."""
CA_HEAD = HERE.parents[1] / "examples" / "machines" / "ca_head"
FIVE = Machine(
    axes=(Axis("X", 1), Axis("Y", 2), Axis("Z", 3)),
    known_axes={1: Axis("X", 1), 2: Axis("Y", 2), 3: Axis("Z", 3), 6: Axis("C", 6, True)},
)
Points = list[tuple[float, ...]]
Path3 = Callable[[], Points]


def sin(degrees: float) -> float:
    return math.sin(math.radians(degrees))


def cos(degrees: float) -> float:
    return math.cos(math.radians(degrees))


class Pen:
    """Notes a position whenever some axis is told to go somewhere."""

    def __init__(self, *start: float) -> None:
        self.at = list(start or (0.0, 0.0, 0.0))
        self.points: Points = []

    def go(self, x=None, y=None, z=None) -> Pen:
        for axis, value in enumerate((x, y, z)):
            if value is not None:
                self.at[axis] = value
        self.points.append(tuple(self.at))
        return self

    def by(self, x=0.0, y=0.0, z=0.0) -> Pen:
        return self.go(self.at[0] + x, self.at[1] + y, self.at[2] + z)


def hole_circle() -> Points:
    pen = Pen()
    for angle in range(0, 360, 60):
        pen.go(40 * cos(angle), 40 * sin(angle), 2).go(z=-10).go(z=2)
    return pen.go(z=100).points


def hole_grid() -> Points:
    pen = Pen().go(10, 20, 5)
    for _ in range(3):
        for column in range(4):
            pen.go(z=-3).go(z=5)
            if column < 3:
                pen.go(10 + 15 * (column + 1))
        pen.go(10).by(y=12)
    return pen.points


def hole_row_modal_cycle() -> Points:
    pen = Pen().go(0, 0, 3)
    for place in (None, (20, 0), (40, 0), (60, 10)):
        if place:
            pen.go(*place)
        pen.go(z=-12).go(z=3)
    return pen.go(z=50).points


def deep_hole() -> Points:
    pen = Pen().go(5, 5, 2)
    for depth in (-7, -14, -21, -28, -30):
        pen.go(z=depth).go(z=2)
    return pen.points


def flange_polar() -> Points:
    pen = Pen().go(z=5)
    for k in range(5):
        pen.go(100 + 35.5 * cos(15 + 72 * k), 50 + 35.5 * sin(15 + 72 * k))
    return pen.points


def drill_table() -> Points:
    pen = Pen().go(z=5)
    for x, y in ((12, 8), (30, 8), (55, 20), (55, 42), (12, 42)):
        pen.go(x, y).go(z=-6.5).go(z=5)
    return pen.points


def hole_kinds() -> Points:
    pen = Pen().go(z=1)
    for i, depths in enumerate(((-2,), (-20,), (-20, -5), ())):
        pen.go(10 * i)
        for depth in depths:
            pen.go(z=depth)
        pen.go(z=1)
    return pen.points


def rectangular_pocket() -> Points:
    """Three rings out to 25 x 15 (half lengths without the tool), at two depths."""
    pen = Pen().go(100, 50, 2)
    for depth in (-2, -4):
        pen.go(z=depth)
        for ring in (1, 2, 3):
            a, b = 25 * ring / 3, 15 * ring / 3
            pen.go(100 - a, 50 - b).go(100 + a).go(y=50 + b).go(100 - a).go(y=50 - b)
    return pen.go(z=50).points


def zigzag_slot() -> Points:
    pen, right = Pen().go(0, 0, -1), True
    for y in (3, 6, 9, 12, 15):
        pen.go(100 if right else 0).go(y=y)
        right = not right
    return pen.points


def facing() -> Points:
    return Pen().go(-20, 0, 0).go(120, 0).go(-20, 16).go(120, 16).go(-20, 32).go(120, 32).points


def rounded_rectangle() -> Points:
    pen = Pen().go(0, -25, 5).go(z=-3).go(32).go(40, -17).go(y=17).go(32, 25).go(-32)
    return pen.go(-40, 17).go(y=-17).go(-32, -25).go(0).go(z=50).points


def helix_into_bore() -> Points:
    return Pen().go(15, 0, 1).go(z=-1).go(z=-3).go(z=-5).go(15, 0).go(0).go(z=50).points


def polygon_bore() -> Points:
    return [(12 * cos(15 * k), 12 * sin(15 * k), 0.0) for k in range(25)]


def mirrored_part() -> Points:
    """As drawn, with X against X (G21), with both against (G23)."""
    pen = Pen().go(0, 0)
    for sx, sy in ((1, 1), (-1, 1), (-1, -1)):
        for x, y in ((10, 5), (30, 5), (30, 25)):
            pen.go(sx * x, sy * y)
    return pen.go(0, 0).points


def rotated_pattern() -> Points:
    pen = Pen().go(0, 0)
    for angle in (0, 120, 240):
        for x, y in ((20, 0), (20, 10)):
            pen.go(x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle))
    return pen.points


def pallet_of_four() -> Points:
    """Zero offsets (100, 50), (300, 50), (100, 250, 1.5), (300, 250)."""
    points = []
    for x, y, z in ((100, 50, 0), (300, 50, 0), (100, 250, 1.5), (300, 250, 0)):
        points += [(x, y, 10 + z), (x + 25, y + 15, 10 + z)]
    return [*points, (0, 0, 200)]


def tilted_plane() -> Points:
    """Y' and Z' of the plane are (cos 30, sin 30) and (-sin 30, cos 30) in Y and Z."""

    def machine(x, y, z):
        return (x, 100 + y * cos(30) - z * sin(30), 20 + y * sin(30) + z * cos(30))

    inside = [(10, 0, 5), (10, 0, -8), (10, 0, 5), (10, 25, 5)]
    points = [(0.0, 0.0, 50.0), *(machine(*p) for p in inside)]
    return [*points, (*points[-1][:2], 100.0)]


def turned_fixture() -> Points:
    """X' = Y, Y' = -X around (200, 40); then X'' = -X, Y'' = -Y around (200 - 2, 40 + 1, 3)."""
    return [(0, 0, 0), (200, 50, 0), (195, 50, 0), (188, 41, 3)]


def safe_retract() -> Points:
    return [(10, 10, 47), (10, 10, 300), (20, 10, 300)]


def tool_change() -> Points:
    """Tip + length = Z axis; change.nc goes to Z400 and X-50 with length 0."""
    pen = Pen().go(0, 0, 250).go(z=400).go(-50).go(10, z=85).go(z=75)
    return pen.go(z=400).go(-50).go(20, z=130).points


def probe_cycle() -> Points:
    pen = Pen().go(0, 0, -10).go(-20).go(-31).go(-20).go(20).go(37).go(20)
    return pen.go((37 - 31) / 2).points


def rough_turning() -> Points:
    pen = Pen().go(32, z=2)
    for x in (30, 28, 26, 24, 22):
        pen.go(x).go(z=-40).go(x + 1).go(z=2)
    return pen.go(60, z=60).points


def grooves() -> Points:
    pen = Pen().go(25, z=5)
    for z in (-10, -20, -30, -40):
        pen.go(z=z).go(18).go(25)
    return pen.points


def cone_levels() -> Points:
    pen = Pen()
    for level in range(5):
        w = 20 - 2 * level
        pen.go(-w, -w, -level).go(w).go(y=w).go(-w).go(y=-w)
    return pen.go(z=20).points


def finishing_twice() -> Points:
    pen = Pen().go(0, 0)
    for k in (1, 2, 3):
        pen.go(10 * k).go(y=k).go(0, 0)
    return pen.go(99).points


def nested_subprograms() -> Points:
    """The second call leaves both levels from the inner one."""
    pen = Pen()
    pen.by(1).by(y=1).by(y=1).by(1)
    pen.by(1).by(y=1)
    pen.by(1).by(y=1).by(y=1).by(1)
    return pen.go(z=9).points


def wear_compensation() -> Points:
    pen = Pen().go(0, z=5)
    for wear in ((0.01, 0.02, 0.03), (0.1, 0.2, 0.3)):
        for k in range(3):
            pen.go(z=-k - wear[k])
        pen.go(z=5)
    return pen.points


def approach_angle() -> Points:
    x, y = 5 + 12.5 * cos(37), 5 + 12.5 * sin(37)
    return [(5, 5, 0), (x, y, 0), (5, 5, 0), (9, 8, 0)]


EXPECTED: dict[str, Path3] = {
    "hole_circle": hole_circle,
    "hole_grid": hole_grid,
    "hole_row_modal_cycle": hole_row_modal_cycle,
    "deep_hole": deep_hole,
    "flange_polar": flange_polar,
    "drill_table": drill_table,
    "hole_kinds": hole_kinds,
    "skipped_holes": lambda: [(0, 0, 5), (10, 0, 5), (40, 0, 5), (40, 99, 5)],
    "retry_with_goto": lambda: [(0, 0, 0), *((2.5 * k, 0, 0) for k in (1, 2, 3, 4)), (10, 7, 0)],
    "holes_in_inches": lambda: [
        (25.4, 12.7, 2.54), (31.75, 12.7, 2.54), (38.1, 9.525, 2.54), (10, 9.525, 2.54)
    ],
    "drill_file_cycle": lambda: (
        Pen().go(10, 10, 5).go(z=-14).go(z=5).go(20).go(z=-7).go(z=5).points
    ),
    "rectangular_pocket": rectangular_pocket,
    "zigzag_slot": zigzag_slot,
    "facing": facing,
    "rounded_rectangle": rounded_rectangle,
    "helix_into_bore": helix_into_bore,
    "arc_with_radius": lambda: [(0, 0, 0), (20, 0, 0), (40, 0, 0), (40, 20, 0)],
    "polygon_bore": polygon_bore,
    "mirrored_part": mirrored_part,
    "rotated_pattern": rotated_pattern,
    "scaled_logo": lambda: [(4, 2, 0), (12, 6, 0), (15, 6, 0), (4, 2, 0)],
    "pallet_of_four": pallet_of_four,
    "pallet_by_index": lambda: [*((60 * k + 1, 7, 0) for k in range(4)), (0, 0, 0)],
    "shifted_row": lambda: [(0, 0, 0), (105, 0, 0), (125, 0, 0), (5, 0, 0)],
    "touched_edge": lambda: [(50, 20, 0), (53.2, 20, 0), (63.2, 20, 0), (10, 20, 0)],
    "tilted_plane": tilted_plane,
    "turned_fixture": turned_fixture,
    "safe_retract": safe_retract,
    "tool_change": tool_change,
    "tool_by_data": lambda: [(0, 0, 100), (8.75, 0, 73.5), (10, 0, 10)],
    "probe_edge": lambda: [(20, 0, -5), (-10, 0, -5), (20, 0, -5), (-10, 0, -5)],
    "probe_cycle": probe_cycle,
    "length_check": lambda: [(1, 0, 0)],
    "rough_turning": rough_turning,
    "grooves": grooves,
    "turned_contour": lambda: (
        Pen().go(10, z=2).go(z=-10).go(15, z=-15).go(25).go(30, z=-20).go(z=-35).go(40).points
    ),
    "recipe": lambda: [(0, 0, 0), (0, 100, 0), (12.5, 100, 0), (25, 100, 0), (37.5, 100, 0)],
    "protocol": lambda: [(2.5, 0, 0)],
    "texts": lambda: [(42, 8, 0), (42, 8, 5)],
    "macros": lambda: [(0, 0, 50), (14, 15, 50), (20, 21, 50), (0, 21, 50)],
    "finishing_twice": finishing_twice,
    "computed_jump": lambda: [(0, 0, 0), (2, 0, 0), (2, 5, 0)],
    "nested_subprograms": nested_subprograms,
    "spiral": lambda: [
        (0, 0, 0), *((k / 72 * cos(10 * k), k / 72 * sin(10 * k), 0) for k in range(1, 73))
    ],
    "parabola": lambda: [(k / 2, 0, k * k / 16) for k in range(-10, 11)],
    "sine_wall": lambda: [
        (0, 0, 0), *((a / 10, 8 * sin(a) + 3 * cos(2 * a), 0) for a in range(0, 361, 5))
    ],
    "cone_levels": cone_levels,
    "old_conditions": lambda: [(0, 0, 0), (10, 0, 0), (10, 1, 0)],
    "comment_forms": lambda: [(1, 2, 0), (3, 2, 0)],
    "axis_exchange": lambda: [(1, 2, 3), (5, 2, 3), (5, 7, 3), (8, 7, 3)],
    "flags_and_bits": lambda: [(0, 0, 0), (0, 3, 0), (20, 3, 0), (30, 3, 0)],
    "safety_checks": lambda: [(5, 0, 0)],
    "back_to_back": lambda: [(1, 0, 0), (2, 0, 0), (2, 3, 0), (1, 3, 0)],
    "approach_angle": approach_angle,
    "wear_compensation": wear_compensation,
    "subprogram_files": lambda: (
        Pen().go(1).by(y=1).by(y=1).by(10).by(y=1).by(y=1).by(10).go(3).points
    ),
    "acs_fixture": lambda: [(0, 0, 0), (9, 25, 0), (8, 26, 0)],
}  # fmt: skip
OPTIONS = {
    "skipped_holes": {"skip": frozenset((2,))},
    "recipe": {"external": {"V.E.PART": "LONG", "V.E.COUNT": 3.0, "V.E.LENGTH": 12.5,
                            "V.E.DONE": 0.0}},
}  # fmt: skip
MESSAGES = {
    "hole_kinds": [(None, "hole 3 has an unknown kind")],
    "probe_cycle": [("message.txt", "centre 3.000000")],
    "protocol": [
        ("protocol.txt", "part 3: width 10.000000"), ("protocol.txt", "end"), (None, "done")
    ],
}  # fmt: skip
WARNINGS = {"length_check": ["N2090"]}


def _swarf_ruled_wall() -> Points:
    return [(10 * k, 0.05 * k * k, -2 - 0.2 * k, 1.5 * k, -2 * k) for k in range(11)]


def _swarf_circle() -> Points:
    return [(60 * cos(a), 60 * sin(a), -4, 12, a - 180) for a in range(0, 351, 10)]


def _five_axis_subprogram() -> Points:
    return [(5 * k, -3, 1, 2 * k, 10 * k) for k in range(1, 6)]


def _five_axis_offset() -> Points:
    """The zero offset is added to the tip: (50, 0, -10)."""
    return [(50, 0, -10, 20, 30), (60, 5, -10, 20, 30)]


TIPS: dict[str, Path3] = {
    "swarf_ruled_wall": _swarf_ruled_wall,
    "swarf_circle": _swarf_circle,
    "five_axis_subprogram": _five_axis_subprogram,
    "five_axis_offset": _five_axis_offset,
    "indexed_faces": lambda: [
        p for c in (0, 90, 180, 270) for p in ((10, 20, 30, 45, c), (10, 20, 25, 45, c))
    ],
}
"""Tip and angles of every motion under RTCP: X, Y, Z in the machine system, A, C."""


def run(name: str, machine: Machine | None = None) -> ncscope.Trajectory:
    options = Options(load=subprogram_loader([HERE]), **OPTIONS.get(name, {}))
    machine = machine or (FIVE if name == "axis_exchange" else Machine())
    result = ncscope.run(machine, load_program(HERE / f"{name}.nc"), options)
    errors = [ncscope.render(d) for d in result.diagnostics if d.severity != "note"]
    found = [d.id for d in result.diagnostics if d.severity != "note"]
    assert found == WARNINGS.get(name, []), "\n".join(errors)
    return result


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_program_reaches_every_position(name: str) -> None:
    result = run(name)
    columns = [result.axes.index(axis) for axis in "XYZ"]
    expected = np.array(EXPECTED[name](), dtype=float)
    found = result.acs[:, columns]
    assert found.shape == expected.shape, found.tolist()
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)
    assert [(m.file, m.text) for m in result.messages] == MESSAGES.get(name, [])


@pytest.mark.parametrize("name", sorted(TIPS))
def test_five_axis_program_brings_the_tip_there(name: str) -> None:
    machine, _ = ncscope.load_machine(CA_HEAD)
    result = run(name, machine)
    column = {axis: i for i, axis in enumerate(result.axes)}
    active = np.isfinite(result.direction).all(axis=1)
    acs = result.acs[active]
    expected = np.array(TIPS[name](), dtype=float)
    np.testing.assert_allclose(tip(acs, column), expected[:, :3], rtol=0, atol=1e-9)
    np.testing.assert_allclose(acs[:, [column["A"], column["C"]]], expected[:, 3:], atol=1e-9)


def test_every_program_has_its_positions() -> None:
    programs = {path.stem for path in HERE.glob("*.nc")} - CALLED
    assert programs == set(EXPECTED) | set(TIPS)
    assert len(programs) >= 60
