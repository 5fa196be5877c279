"""Labels beside points, none over another, and beside lines where there is room.

Enters: a drawn view and texts with their points. The view must have its final scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ncscope.frames import Array

HEIGHT, WIDTH = 0.042, 0.0165
"""Room of a line and of one letter, parts of the height and width of a view."""
STEPS = 14
DENSE = 60
"""Points of a line that a label may cover."""
COVERING = 4.0
"""Covering a line is as bad as standing so many heights away from the point."""
LEFT = 0.5
"""Standing left of the point is as bad as so many heights away from it."""


class Label(NamedTuple):
    """A text beside a point (2,) in picture coordinates."""

    at: Array
    text: str
    colour: str


def plain(text: str) -> str:
    """Control characters have no picture."""
    return "".join(c if c.isprintable() else " " for c in text)


def draw_labels(
    axes: Axes,
    labels: list[Label],
    size: float = 8.0,
    left_below: bool = False,
    lines: Sequence[Array] = (),
) -> None:
    """Each label right above its point, or left below it; one that would cover another moves, and
    one that would cover one of `lines` (k, 2) where a free place is near."""
    axes.apply_aspect()
    low, high = np.array(axes.get_xlim()), np.array(axes.get_ylim())
    origin, scale = np.array([low[0], high[0]]), np.array([np.ptp(low), np.ptp(high)])
    placed: list[tuple[float, float, float]] = []
    drawn = _dense([(line - origin) / scale for line in lines])
    for label in labels:
        width = WIDTH * len(label.text) * size / 8.0
        columns, y = _beside((label.at - origin) / scale, width, left_below)
        x, y = _free_place(placed, drawn, columns, y, width, -HEIGHT if left_below else HEIGHT)
        placed.append((x, y, width))
        ends = x in columns[1:]  # left of the point: the text ends there
        corner = origin + scale * (x + width * ends, y)
        _write(axes, label, corner, "right" if ends else "left", size)


def _beside(at: Array, width: float, left_below: bool) -> tuple[tuple[float, ...], float]:
    """Where a label of a point (2,) may begin, best first, and its height; parts of the view."""
    shift = (-0.012 - width, -0.012 - 0.7 * HEIGHT) if left_below else (0.014, 0.014)
    x, y = (float(value) for value in at + shift)
    x, y = min(max(x, 0.005), 1.0 - width), min(max(y, 0.005), 1.0 - HEIGHT)
    left = float(at[0]) - 0.014 - width
    return ((x,) if left_below or left < 0.005 else (x, left)), y


def _write(axes: Axes, label: Label, corner: Array, side: str, size: float) -> None:
    axes.annotate(
        plain(label.text),
        tuple(label.at),
        xytext=tuple(corner),
        ha=side,
        fontsize=size,
        color=label.colour,
        zorder=8,
        parse_math=False,
        bbox={"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.6},
    )


def _dense(lines: Sequence[Array]) -> Array:
    """Points (k, 2) close to each other on all lines, parts of the view."""
    share = np.linspace(0.0, 1.0, DENSE)[:, None]
    pieces = [a + share * (b - a) for line in lines for a, b in pairwise(line)]
    return np.concatenate([np.empty((0, 2)), *pieces])


def _free_place(
    placed: list[tuple[float, float, float]],
    drawn: Array,
    columns: Sequence[float],
    y: float,
    width: float,
    step: float,
) -> tuple[float, float]:
    """The best place: over no other label, over no line, near the point, right of it."""
    best, least = (columns[0], y), np.inf
    for cost, x, height in _places(columns, y, step):
        if cost >= least:
            break
        if any(
            abs(height - other) < HEIGHT and x < left + w and left < x + width
            for left, other, w in placed
        ):
            continue
        inside = (drawn >= (x, height)) & (drawn <= (x + width, height + HEIGHT))
        total = cost + COVERING * bool(inside.all(axis=1).any())
        if total < least:
            best, least = (x, height), total
    return best


def _places(
    columns: Sequence[float], y: float, step: float
) -> Iterator[tuple[float, float, float]]:
    """What is bad about a place, and the place, best first; inside of the view."""
    for count in range(2 * STEPS):
        for place, x in enumerate(columns):
            for height in {y + count * step / 2, y - count * step / 2}:
                if count == 0 or 0.0 <= height <= 1.0 - HEIGHT:
                    yield count / 2 + LEFT * place, x, height
