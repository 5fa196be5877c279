"""Labels beside points, none over another.

Enters: a drawn view and texts with their points. The view must have its final scale.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ncscope.frames import Array

HEIGHT, WIDTH = 0.042, 0.0165
"""Room of a line and of one letter, parts of the height and width of a view."""
STEPS = 14


class Label(NamedTuple):
    """A text beside a point (2,) in picture coordinates."""

    at: Array
    text: str
    colour: str


def plain(text: str) -> str:
    """Control characters have no picture."""
    return "".join(c if c.isprintable() else " " for c in text)


def draw_labels(
    axes: Axes, labels: list[Label], size: float = 8.0, left_below: bool = False
) -> None:
    """Each label right above its point, or left below it; one that would cover another moves."""
    axes.apply_aspect()
    low, high = np.array(axes.get_xlim()), np.array(axes.get_ylim())
    origin, scale = np.array([low[0], high[0]]), np.array([np.ptp(low), np.ptp(high)])
    placed: list[tuple[float, float, float]] = []
    for at, text, colour in labels:
        width = WIDTH * len(text) * size / 8.0
        shift = (-0.012 - width, -0.012 - 0.7 * HEIGHT) if left_below else (0.014, 0.014)
        x, y = (float(v) for v in (at - origin) / scale + shift)
        x = min(max(x, 0.005), 1.0 - width)
        step = -HEIGHT if left_below else HEIGHT
        y = _free_height(placed, x, min(max(y, 0.005), 1.0 - HEIGHT), width, step)
        placed.append((x, y, width))
        axes.annotate(
            plain(text),
            tuple(at),
            xytext=tuple(origin + scale * (x, y)),
            fontsize=size,
            color=colour,
            zorder=8,
            parse_math=False,
            bbox={"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.6},
        )


def _free_height(
    placed: list[tuple[float, float, float]], x: float, y: float, width: float, step: float
) -> float:
    for count in range(STEPS):
        for candidate in (y + count * step, y - count * step):
            if not any(
                abs(candidate - other) < HEIGHT and x < left + w and left < x + width
                for left, other, w in placed
            ):
                return candidate
    return y
