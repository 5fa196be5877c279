"""Programs of 40 lines and more that lean on the language: cycles, jumps, macros, arrays.

The expected positions are computed by Python that follows the drawing of each part and shares
nothing with ncscope. Each program runs through the command line, with the files beside it.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from test_corpus import Pen, Points
from typer.testing import CliRunner

from ncscope.cli import app

HERE = Path(__file__).parent / "shop"


def drilled(
    pen: Pen, axis: str, depth: float, plane: float, step: float, less: float, least: float,
    full: bool,
) -> int:  # fmt: skip
    """Deep hole with infeeds that grow smaller; chips are broken by 0.5 mm or cleared."""
    pen.go(**{axis: plane})
    at, strokes = plane, 0
    while at > depth:
        at = max(at - step, depth)
        pen.go(**{axis: at})
        strokes += 1
        if at > depth:
            if full:
                pen.go(**{axis: plane})
            pen.go(**{axis: at + 0.5})
        step = max(step - less, least)
    pen.go(**{axis: plane})
    return strokes


def drill_plate() -> tuple[Points, list[str]]:
    pen = Pen().go(-20, -20, 50).go(10, 10)
    hole = ("z", -12, 2, 6, 2, 1, False)
    strokes = drilled(pen, *hole)
    for row in range(2):
        for column in range(3):
            if (row, column) not in ((0, 0), (0, 2)):
                pen.go(10 + 15 * column, 10 + 12 * row)
                strokes += drilled(pen, *hole)
    pen.go(z=50).go(0, 30, 0)
    drilled(pen, "y", 15, 25, 4, 1, 3, True)
    return pen.go(0, 40).points, [f"strokes {strokes}"]


def pallets() -> tuple[Points, list[str]]:
    """Nests 1, 4 and 5 are machined; nest 2 holds a part of no known kind."""
    pen = Pen().go(z=200)
    for nest, kind in ((1, 1), (4, 2), (5, 3)):
        row, column = divmod(nest, 3)
        x, y, z = 50 + 120.5 * column, 40 + 200 * row, 12.75 if row else 12.25
        if kind == 1:
            pen.go(x, y, z + 5).go(z=z - 1).by(x=20).by(y=10).by(x=-20).by(y=-10).go(z=z + 5)
            continue
        pen.go(x, y).go(z=z + 1)
        for _ in range(2):
            pen.by(x=10 * kind).by(y=2.5).go(x)
        pen.go(z=z + 5)
    pen.go(z=200).go(0, 0)
    return pen.points, ["nest 2: kind 7 unknown", "3 done, 1 unknown"]


def three_tools() -> tuple[Points, list[str]]:
    """Z is that of the spindle: the programmed one, the zero offset of 55 and the tool."""
    length = {0: 0.0, 1: 80.0, 2: 125.5, 7: 150.3}
    pen, held, texts = Pen(), 0, []
    holes = iter([(10, 0), (20.5 - 0.2, 1), (31 - 0.2, 4)])  # tool 7 sits 0.2 mm beside
    for hole, tool in enumerate((2, 7, 7, 1)):
        if tool != held:
            pen.go(z=400 + length[held])  # the old tool still counts
            for pocket in (held, tool):
                if pocket:
                    pen.go(100 + 80 * (pocket - 1), -200).go(z=350).go(y=-300).go(z=400)
                    pen.go(y=-200)
            texts.append(f"T{held} -> T{tool}, length {length[tool]:f}")
            held = tool
        zero = 55 + length[held]
        if tool == 1:
            pen.go(0, 0).go(z=10 + zero)
        else:
            pen.go(*next(holes)).go(z=3 + zero).go(z=-5.5 - hole + zero).go(z=3 + zero)
    return pen.go(z=400 + length[held]).points, texts


def macro_part() -> tuple[Points, list[str]]:
    pen, texts = Pen().go(z=50).go(0, 0), []
    for depth, wall in ((2.5, 3.25), (5, 3.75), (6, 3.75)):
        half = (60 - 2 * wall) / 2
        pen.go(-half, -half).go(z=-depth).go(half, -half).go(half, half).go(-half, half)
        pen.go(-half, -half).go(z=50)
        texts.append(f"pocket 52.50 at {depth:f}")  # the wall is 3.75 by then
    return pen.go(z=75).go(3, 65).go(z=100).points, texts


def align() -> tuple[Points, list[str]]:
    """Four points, each touched until two touches agree to 0.01 mm, three times at most."""
    rows = [[11.69, 11.8, 11.9], [11.15, 11.155], [10.6, 10.7, 10.705], [10.1, 10.104]]
    pen = Pen().go(10, -5, -4)
    for point, touches in enumerate(rows):
        pen.go(10 + 30 * point)
        for y in touches:
            pen.go(y=y).go(y=-5)
    pen.go(10)
    last = [touches[-1] for touches in rows]
    slope, level = np.polyfit([0, 30, 60, 90], last, 1)
    angle = np.arctan(slope)
    pen.go(10, level, 2).go(10 + 90 * np.cos(angle), level + 90 * np.sin(angle)).go(0, 0)
    spread = max(last) - min(last)
    return pen.points, [
        "touch 0 not stable",
        f"angle {np.degrees(angle):f}, range {spread:f}",
    ]


PROGRAMS = {
    "drill_plate": (drill_plate, []),
    "pallets": (
        pallets,
        ["--set", "V.E.OCCUPIED=[0,1,1,0,1,1]", "--set", "V.E.KIND=[1,1,7,1,2,3]"],
    ),
    "three_tools": (three_tools, ["--machine", str(HERE)]),
    "macro_part": (macro_part, []),
    "align": (align, ["--probe", str(HERE / "align.csv")]),
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_program_reaches_every_position(name: str) -> None:
    expected, options = PROGRAMS[name]
    arguments = ["run", str(HERE / f"{name}.nc"), "--format", "jsonl", *options]
    result = CliRunner().invoke(app, arguments)
    rows = [json.loads(line) for line in result.stdout.splitlines()]
    wrong = [r for r in rows if r["kind"] == "diagnostic" and r["severity"] != "note"]
    assert result.exit_code == 0 and not wrong, wrong
    points, texts = expected()
    found = [list(r["acs"].values()) for r in rows if r["kind"] == "move"]
    assert len(found) == len(points)
    np.testing.assert_allclose(found, points, rtol=0, atol=1e-9)
    assert [r["text"] for r in rows if r["kind"] == "message"] == texts
