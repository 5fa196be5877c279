"""Every axis over the blocks, with its software limits, and the distance to the pole.

Enters: a run and its inspection. Leaves: curves of at most a few thousand points.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ncscope.frames import Array
from ncscope.inspection import Inspection, Travel, place
from ncscope.trajectory import Trajectory
from ncscope.views.pictures.reduce import Rows, envelope

WIDTH = 1100
FEW = 60
"""Blocks up to which each one gets a mark."""
FEW_BLOCKS = 24
"""Blocks up to which each one is named on the scale."""
NEAR = 0.6
"""A limit is drawn when it is no farther from the curve than this part of the height."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One axis. blocks, values: its points, blocks counted from 1. limits: those to draw.

    note: range and travel in words. beyond: points beyond a limit. block_names: label of each
    block of a short run.
    """

    name: str
    blocks: Array
    values: Array
    limits: tuple[float, ...]
    note: str
    beyond: tuple[Array, Array]
    marker: str
    block_names: tuple[str, ...] = ()


def curves(result: Trajectory, inspection: Inspection, width: int = WIDTH) -> list[Curve]:
    """A curve for each axis in the order of the channel, then the distance to the pole."""
    acs = result.acs
    count = int(result.end.sum())
    names = _block_names(result) if count <= FEW else ()
    blocks = block_numbers(result)
    found = []
    for column, name in enumerate(result.axes):
        travel = [t for t in inspection.travel if t.axis.name == name]
        found.append(_curve(name, blocks, acs[:, column], travel, names, width))
    pole = inspection.pole_distance
    if np.isfinite(pole).any():
        rows = envelope(pole, width)
        nearest = inspection.nearest_to_pole or (0.0, 0)
        note = f"tool to singular direction: {nearest[0]:.4f} degrees and more"
        marker = "o" if len(pole) <= FEW and not result.sampled else ""
        none = (np.empty(0), np.empty(0))
        found.append(Curve("pole °", blocks[rows], pole[rows], (), note, none, marker, names))
    return found


def block_numbers(result: Trajectory) -> Array:
    """(rows,) where a row stands on the scale of blocks: the end of the first one at 1."""
    end = result.end
    if not result.sampled:
        return np.arange(1.0, len(end) + 1)
    move: Rows = np.cumsum(end) - end
    first = np.flatnonzero(np.append(True, end[:-1]))
    rows = np.diff(np.append(first, len(end)))
    return move + (np.arange(len(end)) - first[move] + 1) / rows[move]


def _curve(
    name: str,
    blocks: Array,
    values: Array,
    travel: list[Travel],
    names: tuple[str, ...],
    width: int,
) -> Curve:
    rows = envelope(values, width) if len(values) else np.empty(0, dtype=np.int64)
    outside = _beyond(travel)
    outside = outside[envelope(values[outside], width // 4)] if len(outside) else outside
    return Curve(
        name,
        blocks[rows],
        values[rows],
        limits=tuple(limit for t in travel for limit in _limits(t)),
        note=_note(travel[-1]) if travel else "",
        beyond=(blocks[outside], values[outside]),
        marker="o" if len(values) <= FEW and len(values) == len(names) else "",
        block_names=names,
    )


def _limits(travel: Travel) -> Iterator[float]:
    """The software limits that are near enough to be drawn."""
    if travel.axis.limits is None:
        return
    low, high = travel.axis.limits
    reach = NEAR * max(travel.high - travel.low, 1e-9)
    if travel.low - low < reach:
        yield low
    if high - travel.high < reach:
        yield high


def _note(travel: Travel) -> str:
    unit = "°" if travel.axis.rotary else "mm"
    note = f"{travel.low:.4f} to {travel.high:.4f} {unit}"
    if travel.axis.limits is not None:
        low, high = travel.axis.limits
        note += f"; travel {low:g} to {high:g} {unit}"
    return note


def _beyond(travel: list[Travel]) -> Rows:
    """The rows of the run that lie beyond a limit."""
    limited = [t for t in travel if t.axis.limits is not None]
    found = [np.unique(rows) for t in limited for rows in (t.below, t.above)]
    return np.concatenate([np.empty(0, dtype=np.int64), *found])


def _block_names(result: Trajectory) -> tuple[str, ...]:
    """`N40`, or `L7` for line 7 without a number."""
    places = [place(result, int(row)) for row in np.flatnonzero(result.end)]
    return tuple(f"L{line}" if block is None else f"N{block}" for _, line, block in places)
