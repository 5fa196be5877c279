"""A run as a table for people: per move one row for each coordinate system that differs.

The row `dir` is the tool direction (tip to flange, in the MCS) below X, Y and Z.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from rich.table import Table

from ncscope.explanation import Explanation, Whereabouts
from ncscope.frames import Array
from ncscope.motion import MOTIONS
from ncscope.trajectory import NO_BLOCK, Stretch, Trajectory

FIRST, LAST = 40, 10
"""A long run is shortened to its first and last moves."""
HUGE = 1e9
"""mm and degrees; numbers from here on are no positions and would only widen the column."""
BETWEEN = "-"
"""In the column of the block number: a point on the way to the end of the block."""


def run_table(
    result: Trajectory, whole: bool = False, first: int = FIRST, last: int = LAST
) -> Table:
    """Line, block number, motion, feed, then the axes in PCS, WCS, MCS and ACS."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("line", "N", "G", "F"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("", style="bold", no_wrap=True)
    for axis in result.axes:
        table.add_column(axis, justify="right", no_wrap=True)
    systems = _systems(result)
    count = len(result)
    hidden = 0 if whole or count <= first + last else count - first - last
    shown = (*range(first), *range(count - last, count)) if hidden else range(count)
    for index, stretch, i in _rows(result, shown):
        if hidden and index == count - last:
            table.add_row("", "", "", "", f"... {hidden} more", style="dim")
        for cells in _cells(result.axes, stretch, i, systems):
            table.add_row(*cells)
    return table


def _rows(result: Trajectory, shown: Iterable[int]) -> Iterator[tuple[int, Stretch, int]]:
    """The moves with these indices, in rising order."""
    wanted = iter(shown)
    index, first = next(wanted, None), 0
    for stretch in result.stretches:
        while index is not None and index < first + len(stretch):
            yield index, stretch, index - first
            index = next(wanted, None)
        first += len(stretch)


def _systems(result: Trajectory) -> tuple[str, ...]:
    """The systems that differ from the one above somewhere in the run; PCS and ACS always."""
    names = ["PCS"]
    pcs, wcs, mcs, acs = result.pcs, result.wcs, result.mcs, result.acs
    if not np.array_equal(pcs, wcs, equal_nan=True):
        names.append("WCS")
    if not np.array_equal(wcs, mcs, equal_nan=True) and not np.array_equal(
        mcs, acs, equal_nan=True
    ):
        names.append("MCS")
    return (*names, "ACS")


def _cells(
    axes: tuple[str, ...], s: Stretch, i: int, systems: tuple[str, ...]
) -> Iterator[list[str]]:
    """A row for each system, and one for the tool direction below X, Y and Z."""
    block = "" if s.block[i] == NO_BLOCK else str(s.block[i])
    block = block if s.end[i] else BETWEEN
    feed = "" if np.isnan(s.feed[i]) else f"{s.feed[i]:g}"
    head = [str(s.line[i]), block, MOTIONS[s.motion[i]], feed]
    for k, system in enumerate(systems):
        values = getattr(s, system.lower())[i]
        yield [*(head if k == 0 else [""] * 4), system, *_numbers(axes, s.axes, values)]
    if s.direction is not None:
        yield ["", "", "", "", "dir", *_numbers(axes, s.axes[:3], s.direction[i])]


def _numbers(axes: tuple[str, ...], present: tuple[str, ...], values: Array) -> list[str]:
    return [number(values[present.index(a)]) if a in present else "" for a in axes]


def number(value: float) -> str:
    """Four decimals: the resolution of the control; never a negative zero."""
    if abs(value) < 5e-5:
        return "0.0000"
    return f"{value:.6g}" if abs(value) >= HUGE else f"{value:.4f}"


def explain_table(item: Explanation) -> Table:
    """The layers from the programmed word to the axes: contribution and value after it."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("layer", no_wrap=True)
    for axis in item.axes:
        table.add_column(axis, justify="right", no_wrap=True)
    table.add_column("set at")
    ends = ("programmed", "axes")
    for layer in item.layers:
        if layer.name not in ends:
            change = [f"{v:+.4f}" if abs(v) >= 5e-5 else "" for v in layer.change]
            table.add_row(layer.name, *change, layer.origin or "")
        values = [number(v) for v in layer.values]
        label = layer.name if layer.name in ends else ""
        table.add_row(label, *values, "", style="bold" if label else "dim")
    return table


def where_table(item: Whereabouts) -> Table:
    """One row for each coordinate system, programmed values first, axis positions last."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("", style="bold", no_wrap=True)
    for axis in item.axes:
        table.add_column(axis, justify="right", no_wrap=True)
    for name in ("pcs", "wcs", "mcs", "acs"):
        table.add_row(name.upper(), *(number(v) for v in getattr(item, name)))
    if item.direction is not None:
        table.add_row("dir", *(number(v) for v in item.direction))
    return table
