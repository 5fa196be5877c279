"""NC programs for measuring: the same bytes on every machine.

`write(kind, blocks, path)` writes a program with so many motion blocks. `five_axis` and
`complete` differ in the machine only; `three_axis` runs under a zero offset and a turned
coordinate system; `peers` is the five-axis program without the lines that other tools do not read.
`contour` is 2.5-axis milling that every tool reads: half of its moves are arcs, each contour of 50
moves begins with a comment, and every 40 contours there are a spindle and a coolant word.
"""

from __future__ import annotations

import math
from pathlib import Path

HEADS = {
    "five_axis": "%MAIN\nN1 G54 G90 F2000\nN2 #KIN ID [91]\nN3 #TRAFO ON\n",
    "complete": "%MAIN\nN1 G54 G90 F2000\nN2 #KIN ID [91]\nN3 #TRAFO ON\n",
    "three_axis": "%MAIN\nN1 G54 G90 F2000\nN2 #CS ON [10,20,30,5,10,15]\n",
    "peers": "G90\n",
    "contour": "G90 G17 G54 G1 F2000\n",
}
TAILS = {"five_axis": "#TRAFO OFF\nM30\n", "complete": "#TRAFO OFF\nM30\n", "three_axis": "M30\n"}


def write(kind: str, blocks: int, path: Path) -> None:
    """A spiral with a swinging tool, or contours; 25 to 60 bytes a block."""
    with path.open("w", encoding="ascii", newline="\n") as out:
        out.write(HEADS[kind])
        for first in range(0, blocks, 50_000):
            out.writelines(_line(kind, i) for i in range(first, min(first + 50_000, blocks)))
        out.write(TAILS.get(kind, "M30\n"))


def _line(kind: str, i: int) -> str:
    if kind == "contour":
        return _contour_line(i)
    turn = i * 1e-4
    x, y, z = 100 * math.cos(turn), 100 * math.sin(turn), (0.001 * i) % 50
    tilt = 20 * math.sin(turn / 3)
    if kind == "complete":
        tilt = 25 + 0.75 * tilt  # a machine with skew axes cannot reach the pole
    rotary = f" A{tilt:.3f} C{90 * math.cos(turn / 7):.3f}" if kind != "three_axis" else ""
    return f"N{(10 * i + 10) % 10**8} G1 X{x:.3f} Y{y:.3f} Z{z:.3f}{rotary} F2000\n"


def _contour_line(i: int) -> str:
    """Slots with round ends in turn, each 0.05 mm deeper than the one before."""
    contour, side = divmod(i, 50)
    x, y, z = contour % 40 * 25.0, contour // 40 % 40 * 25.0, -0.05 * ((side + 3) // 4)
    lines = (
        f"G1 X{x + 10:.3f} Y{y:.3f} Z{z:.3f}\n",
        f"G3 X{x + 10:.3f} Y{y + 8:.3f} I0 J4\n",
        f"G1 X{x:.3f}\n",
        f"G3 X{x:.3f} Y{y:.3f} R4\n",
    )
    if side:
        return lines[(side - 1) % 4]
    words = "S8000 M3\nM8\n" if contour % 40 == 0 else ""
    return f"; contour {contour}\n{words}G0 X{x:.3f} Y{y:.3f}\n"
