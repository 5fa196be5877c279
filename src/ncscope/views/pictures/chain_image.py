"""The chain of a machine as png and svg: four views, and the axes in words from workpiece to tool.

Enters: a `ChainScene`. Leaves: the bytes of a file.
"""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from ncscope.frames import Array
from ncscope.views.pictures.chain import Box, ChainScene, Part
from ncscope.views.pictures.image import STYLE, arrow, frame, picture_bytes
from ncscope.views.pictures.labels import Label, draw_labels, plain
from ncscope.views.pictures.projection import VIEWS, View

COLOURS = {
    "base": "#9a9a9a",
    "linear": "#1f5f9e",
    "rotary": "#d9730d",
    "flange": "#2e7d32",
    "tool": "#111111",
}
DOUBT = "#c62828"
WIDTHS = {"base": 0.7, "linear": 2.2, "rotary": 1.5, "flange": 1.6, "tool": 3.0}
FLAT = 0.03
"""An arrow shorter than this part of the size is seen from its end and drawn as a symbol."""


def chain_image(scene: ChainScene, title: str, note: str, form: str) -> bytes:
    """form: png or svg. note: one line under the title."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(11.0, 10.4))
        figure.suptitle(plain(title), y=0.985, parse_math=False)
        figure.text(
            0.5, 0.955, plain(note), ha="center", fontsize=8, color="#555555", parse_math=False
        )
        grid = figure.add_gridspec(
            2,
            1,
            height_ratios=[8.2, 1.25],
            left=0.06,
            right=0.98,
            top=0.93,
            bottom=0.015,
            hspace=0.09,
        )
        views = grid[0].subgridspec(2, 2, wspace=0.12, hspace=0.17)
        for place, view in enumerate(VIEWS):
            _draw_view(figure.add_subplot(views[place // 2, place % 2]), view, scene)
        _draw_boxes(figure.add_subplot(grid[1]), scene.boxes)
        return picture_bytes(figure, form)


def _draw_view(axes: Axes, view: View, scene: ChainScene) -> None:
    labels: list[Label] = []
    for part in scene.parts:
        labels += _draw_part(axes, view, part, scene.size)
    frame(axes, view)
    axes.margins(0.12)
    draw_labels(axes, labels, lines=[line for part in scene.parts for line in _lines(view, part)])


def _lines(view: View, part: Part) -> list[Array]:
    """What of a part a label should not cover, picture coordinates."""
    drawn = [part.line if part.kind != "base" else part.line[:0], part.turn, _dot(part.point)]
    return [view.flat(line) for line in drawn if line is not None and len(line) > 1]


def _dot(point: Array | None) -> Array | None:
    return None if point is None else np.array([point, point])


def _draw_part(axes: Axes, view: View, part: Part, size: float) -> list[Label]:
    """Point, line and turn of a part; its label stands at the end of the line, or at the point."""
    colour, name = COLOURS[part.kind], f"{view.name}-{part.id}"
    spot: Array | None = None
    if part.point is not None:
        spot = view.flat(part.point)
        shape = "o" if part.kind == "rotary" else "D"
        (mark,) = axes.plot(*spot, shape, color=colour, markersize=5, zorder=6)
        mark.set_gid(f"{name}-point")
    if len(part.line):
        spot = view.flat(part.line[-1])
        _draw_line(axes, view, part, size, name)
    if part.turn is not None:
        _draw_turn(axes, view.flat(part.turn), colour, f"{name}-turn")
    return [] if spot is None or not part.label else [Label(spot, part.label, colour)]


def _draw_line(axes: Axes, view: View, part: Part, size: float, name: str) -> None:
    """The line of a part: seen from its end, with an arrow, or plain."""
    colour, width = COLOURS[part.kind], WIDTHS[part.kind]
    start, end = view.flat(part.line[0]), view.flat(part.line[-1])
    if float(np.linalg.norm(end - start)) < FLAT * size:
        _end_on(axes, end, float((part.line[-1] - part.line[0]) @ view.toward), colour, name)
    elif part.arrow and part.kind != "base":
        arrow(axes, start, end, colour, width, name)
    else:
        both = np.array([start, end]).T
        (line,) = axes.plot(*both, color=colour, linewidth=width, solid_capstyle="butt")
        line.set_gid(name)


def _end_on(axes: Axes, at: Array, toward: float, colour: str, name: str) -> None:
    """A circle with a dot for an arrow to the eye, with a cross for one away from it."""
    ring, inner = axes.plot(*at, "o", *at, "." if toward > 0 else "x", color=colour, zorder=7)
    ring.set(markersize=11, markerfacecolor="white", markeredgewidth=1.4)
    ring.set_gid(f"{name}-{'toward' if toward > 0 else 'away'}")
    inner.set(markersize=5)


def _draw_turn(axes: Axes, points: Array, colour: str, name: str) -> None:
    (line,) = axes.plot(*points[:-2].T, color=colour, linewidth=1.1)
    line.set_gid(name)
    if np.ptp(points, axis=0).min() > 0.02 * np.ptp(points, axis=0).max():
        arrow(axes, points[-4], points[-1], colour, 1.1, f"{name}-head")


def _draw_boxes(axes: Axes, boxes: tuple[Box, ...]) -> None:
    axes.set_axis_off()
    axes.set_gid("chain")
    count = len(boxes) + 2
    axes.set_xlim(0, count)
    axes.set_ylim(0, 1)
    _box(axes, 0, "workpiece", ["", "", "", "", "chain begins"], COLOURS["flange"])
    for place, box in enumerate(boxes, start=1):
        lines = [
            box.kind,
            box.direction,
            f"at {box.point}" if box.point else "",
            box.remark,
            box.side,
        ]
        colour = DOUBT if box.doubtful else COLOURS[box.kind]
        _box(axes, place, box.name, lines, colour)
    _box(axes, count - 1, "tool", ["", "", "", "", "chain ends"], COLOURS["tool"])


def _box(axes: Axes, place: int, name: str, lines: list[str], colour: str) -> None:
    """A box of the chain with its name and lines, linked to the one before it."""
    patch = FancyBboxPatch(
        (place + 0.05, 0.04),
        0.84,
        0.9,
        boxstyle="round,pad=0,rounding_size=0.05",
        facecolor="white",
        edgecolor=colour,
        linewidth=1.3,
    )
    patch.set_gid(f"box-{place}")
    axes.add_patch(patch)
    _write(axes, place, 0.83, name, colour, fontsize=10, weight="bold")
    for row, line in enumerate(lines):
        shade = colour if row >= 3 else "#333333"
        _write(axes, place, 0.66 - 0.135 * row, line, shade, fontsize=6.8)
    if place:
        start, end = np.array([place - 0.1, 0.5]), np.array([place + 0.05, 0.5])
        arrow(axes, start, end, "#888888", 1.0, f"link-{place}")


def _write(axes: Axes, place: int, height: float, text: str, colour: str, **font: Any) -> None:
    """A text in the middle of a box."""
    axes.text(
        place + 0.47, height, plain(text), ha="center", va="center", color=colour,
        parse_math=False, **font,
    )  # fmt: skip
