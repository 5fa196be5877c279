"""Differences of two kinematics as a table, as jsonl, and pose by pose as csv."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from typing import TextIO

import numpy as np
import orjson
from rich.table import Table

from ncscope.frames import Array
from ncscope.kinematics.comparison import Comparison, Extent
from ncscope.views.table import FIRST, LAST, number

MEANING = {
    "tip before": "tool tip, computed with A, on machine B",
    "direction before": "tool direction, computed with A, on machine B",
    "tip after": "tool tip, computed with B, on machine B",
    "direction after": "tool direction, computed with B, on machine B",
}


def comparison_table(item: Comparison) -> Table:
    """Largest, rms and worst pose of every difference."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("difference", "largest", "rms"):
        table.add_column(name, justify="left" if name == "difference" else "right", no_wrap=True)
    table.add_column("")
    table.add_column("at")
    for extent in item.summary():
        label = MEANING.get(extent.quantity, f"{extent.quantity}, B - A")
        worst = _words(item, extent)
        table.add_row(label, _size(extent.largest), _size(extent.rms), extent.unit, worst)
    return table


def _size(value: float) -> str:
    return f"{value:.6f}" if np.isfinite(value) else "-"


def _words(item: Comparison, extent: Extent) -> str:
    """The programmed words of the worst pose; none where there is no difference to speak of."""
    if extent.worst is None or extent.largest < 1e-9:
        return ""
    values = item.program[extent.worst]
    return " ".join(f"{a}{v:g}" for a, v in zip(item.axis_names, values, strict=False))


def differences_table(item: Comparison) -> Table:
    """One row a pose: programmed words, tool tip before and after, axes."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    names = [*item.axis_names, "tip before", "tip after", *(f"d{a}" for a in item.axis_names)]
    for name in names:
        table.add_column(name, justify="right", no_wrap=True)
    matrix = np.column_stack(
        [
            item.program[:, : len(item.axis_names)],
            np.linalg.norm(item.tip_before, axis=1),
            np.linalg.norm(item.tip_after, axis=1),
            item.axes,
        ]
    )
    count = len(item)
    hidden = count - FIRST - LAST if count > FIRST + LAST else 0
    for i in range(count):
        if hidden and i == FIRST:
            table.add_row(f"... {hidden} more", style="dim")
        if not hidden or i < FIRST or i >= count - LAST:
            table.add_row(*("-" if np.isnan(v) else number(v) for v in matrix[i]))
    return table


def write_comparison_csv(out: TextIO, item: Comparison) -> None:
    """A header line, then a line a pose; empty where one of the two has no solution."""
    names, matrix = _columns(item)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(names)
    for row in matrix.tolist():
        writer.writerow(["" if value != value else value for value in row])


def write_comparison_jsonl(out: TextIO, item: Comparison, rows: bool) -> None:
    """One object a difference; with `rows` one object a pose before them."""
    for record in _records(item, rows):
        out.write(orjson.dumps(record, option=orjson.OPT_APPEND_NEWLINE).decode())


def _records(item: Comparison, rows: bool) -> Iterator[dict[str, object]]:
    names, matrix = _columns(item)
    for row in matrix.tolist() if rows else ():
        yield {"kind": "pose", **dict(zip(names, row, strict=True))}
    for extent in item.summary():
        worst = None
        if extent.worst is not None:
            values = item.program[extent.worst].tolist()
            worst = dict(zip(item.axis_names, values, strict=False))
        yield {
            "kind": "difference",
            "quantity": extent.quantity,
            "unit": extent.unit,
            "largest": extent.largest,
            "rms": extent.rms,
            "worst": worst,
        }


def _columns(item: Comparison) -> tuple[list[str], Array]:
    names = [f"pcs_{a}" for a in item.axis_names]
    names += [f"tip_before_{c}" for c in "XYZ"] + ["direction_before"]
    names += [f"tip_after_{c}" for c in "XYZ"] + ["direction_after"]
    names += [f"acs_{a}" for a in item.axis_names]
    parts = [
        item.program[:, : len(item.axis_names)],
        item.tip_before,
        item.angle_before,
        item.tip_after,
        item.angle_after,
        item.axes,
    ]
    return names, np.column_stack(parts)
