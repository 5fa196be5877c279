"""Pictures of a run and of a machine as png and svg, drawn by matplotlib.

Enters: a `ToolPath` with its run, or a `ChainScene`. Leaves: the bytes of a file.
Text from programs and lists is drawn letter by letter: no formulas, no markup.
"""

from __future__ import annotations

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from ncscope.frames import Array
from ncscope.inspection import Inspection
from ncscope.trajectory import Trajectory
from ncscope.views.pictures.curves import FEW_BLOCKS, Curve, curves
from ncscope.views.pictures.labels import Label, draw_labels, plain
from ncscope.views.pictures.path import ToolPath, Triad
from ncscope.views.pictures.projection import VIEWS, View
from ncscope.views.pictures.reduce import polyline

FEED, RAPID, LIMIT, MARK = "#1f5f9e", "#d9730d", "#c62828", "#2e7d32"
TRIAD_COLOURS = ("#c62828", "#2e7d32", "#1565c0")
SEGMENTS = 400_000
"""Most segments of one kind in one view."""
VECTORS = 15_000
"""Segments up to which a line of an svg is drawn as a line; longer ones become pixels in it."""
STYLE: Any = {
    "svg.hashsalt": "ncscope",
    "svg.fonttype": "none",
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": "#888888",
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.5,
    "path.simplify": True,
    "agg.path.chunksize": 20_000,
}
DPI = 110


def path_image(
    result: Trajectory, inspection: Inspection, path: ToolPath, title: str, form: str
) -> bytes:
    """The path in four views, and each axis over the blocks. form: png or svg."""
    with matplotlib.rc_context(STYLE):
        rows = curves(result, inspection)
        figure, upper, lower = _sheet(title, 0.95 * len(rows))
        hidden = 1
        for place, view in enumerate(VIEWS):
            axes = figure.add_subplot(upper[place // 2, place % 2])
            hidden = max(hidden, _draw_path(axes, view, path, SEGMENTS))
        _legend(figure, path, hidden)
        _draw_curves(figure, lower, rows, int(result.end.sum()))
        return picture_bytes(figure, form)


def _sheet(title: str, curves_height: float) -> tuple[Figure, Any, Any]:
    """A figure with its title, the grid of the four views, and the cell of the curves; inches."""
    top = 8.2
    height = top + curves_height + 0.6
    figure = Figure(figsize=(11.0, height))
    grid = figure.add_gridspec(
        2,
        1,
        height_ratios=[top, curves_height + 0.3],
        hspace=0.9 / top,
        left=0.075,
        right=0.975,
        top=1 - 0.75 / height,
        bottom=0.5 / height,
    )
    figure.suptitle(plain(title), y=1 - 0.2 / height, parse_math=False)
    return figure, grid[0].subgridspec(2, 2, wspace=0.14, hspace=0.2), grid[1]


def _draw_path(axes: Axes, view: View, path: ToolPath, limit: int) -> int:
    start, end = view.flat(path.start), view.flat(path.end)
    hidden = 1
    for rapid, colour, style, width in ((True, RAPID, (0, (4, 2)), 0.8), (False, FEED, "-", 0.9)):
        kind = path.rapid == rapid
        line = polyline(start[kind], end[kind], limit)
        hidden = max(hidden, line.hidden)
        (drawn,) = axes.plot(*line.points.T, color=colour, linestyle=style, linewidth=width)
        drawn.set_rasterized(len(line.rows) > VECTORS)
        drawn.set_gid(f"{view.name}-{'rapid' if rapid else 'feed'}")
    if len(start):
        axes.plot(*start[0], "o", color=MARK, markersize=5, zorder=5)
        axes.plot(*end[-1], "s", color="black", markersize=4, zorder=5)
    for triad in path.triads:
        _draw_triad(axes, view, triad, 0.13 * path.size)
    frame(axes, view)
    names = [Label(view.flat(t.origin), t.name, "#444444") for t in path.triads]
    draw_labels(axes, names, 7.0, left_below=True)
    return hidden


def _draw_triad(axes: Axes, view: View, triad: Triad, length: float) -> None:
    origin = view.flat(triad.origin)
    for row, colour in zip(triad.axes, TRIAD_COLOURS, strict=True):
        tip = view.flat(triad.origin + length * row)
        axes.plot(*np.array([origin, tip]).T, color=colour, linewidth=1.6, zorder=4)


def frame(axes: Axes, view: View) -> None:
    """Scale, title and edges of a view."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.set_title(view.name, loc="left", pad=3)
    axes.set_gid(f"view-{view.name}")
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.tick_params(length=2, labelsize=7, color="#888888")
    if view.labels == ("", ""):
        axes.set_xticks([])
        axes.set_yticks([])
        return
    axes.set_xlabel(f"{view.labels[0]} mm", labelpad=1, fontsize=8)
    axes.set_ylabel(f"{view.labels[1]} mm", labelpad=1, fontsize=8)


def _legend(figure: Figure, path: ToolPath, hidden: int) -> None:
    line = matplotlib.lines.Line2D
    handles = [
        line([], [], color=FEED, label="feed"),
        line([], [], color=RAPID, linestyle=(0, (4, 2)), label="rapid (G00)"),
        line([], [], color=MARK, marker="o", linestyle="", label="start"),
        line([], [], color="black", marker="s", linestyle="", markersize=4, label="end"),
    ]
    notes = []
    if hidden > 1:
        notes.append(f"one of {hidden} segments is drawn")
    if path.more_triads:
        notes.append(f"{path.more_triads} more coordinate systems")
    handles += [line([], [], linestyle="", label=note) for note in notes]
    figure.legend(
        handles=handles,
        loc="upper center",
        ncols=len(handles),
        frameon=False,
        fontsize=8,
        bbox_to_anchor=(0.5, 1 - 0.3 / figure.get_figheight()),
    )


def _draw_curves(figure: Figure, cell: Any, rows: list[Curve], count: int) -> None:
    """The axes below each other with one scale of blocks, which the last one carries."""
    if not rows:
        return
    grid = cell.subgridspec(len(rows), 1, hspace=0.28)
    first: Axes | None = None
    for curve, place in zip(rows, grid, strict=True):
        axes = figure.add_subplot(place, sharex=first)
        first = first or axes
        _draw_curve(axes, curve)
        axes.tick_params(length=2, labelsize=7, labelbottom=curve is rows[-1], color="#888888")
        axes.margins(x=0.01, y=0.12)
    assert first is not None
    first.set_xlim(0.5, max(count, 1) + 0.5)
    first.ticklabel_format(axis="x", style="plain", useOffset=False)
    axes.set_xlabel("motion blocks in the order in which they run", fontsize=8, labelpad=1)
    if count <= FEW_BLOCKS:
        axes.set_xticks(range(1, count + 1), rows[0].block_names, fontsize=7)


def _draw_curve(axes: Axes, curve: Curve) -> None:
    axes.set_gid(f"curve-{curve.name}")
    axes.plot(
        curve.blocks, curve.values, color=FEED, linewidth=0.9, marker=curve.marker, markersize=2.5
    )
    for value in curve.limits:
        axes.axhline(value, color=LIMIT, linewidth=0.9, linestyle=(0, (5, 2)))
    if len(curve.beyond[0]):
        axes.plot(*curve.beyond, ".", color=LIMIT, markersize=5, zorder=5)
    axes.set_ylabel(plain(curve.name), rotation=0, ha="right", va="center", parse_math=False)
    axes.text(
        1.0,
        1.03,
        curve.note,
        transform=axes.transAxes,
        ha="right",
        fontsize=7,
        color="#555555",
        parse_math=False,
    )
    axes.grid(True)


def arrow(axes: Axes, start: Array, end: Array, colour: str, width: float, name: str) -> None:
    """An arrow in picture coordinates that keeps its head at any scale."""
    patch = FancyArrowPatch(
        tuple(start),
        tuple(end),
        arrowstyle="-|>",
        mutation_scale=9,
        shrinkA=0,
        shrinkB=0,
        color=colour,
        linewidth=width,
        zorder=4,
    )
    patch.set_gid(name)
    axes.add_patch(patch)
    axes.update_datalim([tuple(start), tuple(end)])


def picture_bytes(figure: Figure, form: str) -> bytes:
    """The file; the same figure gives the same bytes."""
    stream = io.BytesIO()
    metadata = {"Date": None, "Creator": "ncscope"} if form == "svg" else {"Software": "ncscope"}
    figure.savefig(stream, format=form, dpi=DPI, metadata=metadata)
    return stream.getvalue()
