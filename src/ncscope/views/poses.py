"""Poses as a table for people, as jsonl or csv, and as columns of a Parquet file.

Names of columns are those of a run: `pcs_` programmed values, `mcs_` tool tip, `direction_` the
unit vector tip -> flange, `acs_` axis values. So a file written here can be read back.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

import numpy as np
import orjson
from rich.table import Table

from ncscope.frames import Array
from ncscope.kinematics.poses import Poses
from ncscope.views.records import ROWS
from ncscope.views.table import FIRST, LAST, number

Explain = Callable[[int], tuple[str, str]]
"""Error number and sentence for a status other than 0."""


def poses_table(poses: Poses, explain: Explain) -> Table:
    """Three rows a pose: programmed (PCS), tool tip and direction (MCS), axes (ACS)."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("row", justify="right", no_wrap=True)
    table.add_column("pose", justify="right", no_wrap=True)
    table.add_column("", style="bold", no_wrap=True)
    for axis in poses.axis_names:
        table.add_column(axis, justify="right", no_wrap=True)
    table.add_column("tool direction", justify="right", no_wrap=True)
    table.add_column("condition", justify="right", no_wrap=True)
    count = len(poses)
    hidden = count - FIRST - LAST if count > FIRST + LAST else 0
    for i in range(count):
        if hidden and i == FIRST:
            table.add_row("", "", f"... {hidden} more", style="dim")
        if not hidden or i < FIRST or i >= count - LAST:
            _add_pose(table, poses, i, explain)
    return table


def _add_pose(table: Table, poses: Poses, i: int, explain: Explain) -> None:
    empty = [""] * len(poses.axis_names)
    pcs = [number(v) for v in poses.program[i, : len(empty)]]
    if poses.status[i]:
        id, message = explain(int(poses.status[i]))
        shown = ["" if v == "nan" else v for v in pcs]
        table.add_row(str(poses.row[i] + 1), "", "PCS", *shown, f"{id}: {message}", style="red")
        return
    tip = [*(number(v) for v in poses.tip[i]), *empty][: len(empty)]
    acs = [number(v) for v in poses.axes[i, : len(empty)]]
    direction = " ".join(f"{number(c):>7}" for c in poses.direction[i] if not np.isnan(c))
    condition = _condition(max(poses.linear[i], poses.rotary[i]))
    table.add_row(str(poses.row[i] + 1), f"{poses.pose[i]:+d}", "PCS", *pcs)
    table.add_row("", "", "MCS", *tip, direction)
    table.add_row("", "", "ACS", *acs, "", condition)


def _condition(value: float) -> str:
    if np.isnan(value):
        return ""
    return "singular" if not value < 1e9 else f"{value:.4g}"


def write_poses_jsonl(out: TextIO, poses: Poses, explain: Explain) -> None:
    """One object a pose; null where a row has no solution."""
    for i in range(len(poses)):
        error = None
        if poses.status[i]:
            id, message = explain(int(poses.status[i]))
            error = {"id": id, "message": message}
        record = {
            "kind": "pose",
            "row": int(poses.row[i]) + 1,
            "pose": int(poses.pose[i]),
            "pcs": dict(zip(poses.axis_names, poses.program[i].tolist(), strict=False)),
            "mcs": dict(zip("XYZ", poses.tip[i].tolist(), strict=True)),
            "direction": poses.direction[i].tolist(),
            "acs": dict(zip(poses.axis_names, poses.axes[i].tolist(), strict=False)),
            "condition": {"linear": float(poses.linear[i]), "rotary": float(poses.rotary[i])},
            "error": error,
        }
        out.write(orjson.dumps(record, option=orjson.OPT_APPEND_NEWLINE).decode())


def write_poses_csv(out: TextIO, poses: Poses, explain: Explain) -> None:
    """A header line, then a line a pose; empty where a row has no solution."""
    names, matrix = pose_columns(poses)
    csv.writer(out, lineterminator="\n").writerow(["row", "pose", *names, "error"])
    errors = [""] + [explain(s)[0] for s in range(1, int(poses.status.max(initial=0)) + 1)]
    for start in range(0, len(poses), ROWS):
        part = slice(start, start + ROWS)
        rows = _number_rows(matrix[part])
        heads = zip(poses.row[part].tolist(), poses.pose[part].tolist(), strict=True)
        out.write(
            "".join(
                f"{row + 1},{pose},{text.replace('null', '')},{errors[status]}\n"
                for (row, pose), text, status in zip(
                    heads, rows, poses.status[part].tolist(), strict=True
                )
            )
        )


def write_poses_parquet(path: Path, poses: Poses, explain: Explain) -> None:
    """The columns of the csv form. Raises ImportError without pyarrow, OSError."""
    import pyarrow
    import pyarrow.parquet

    names, matrix = pose_columns(poses)
    columns: dict[str, object] = {"row": poses.row + 1, "pose": poses.pose}
    columns |= {name: np.ascontiguousarray(matrix[:, i]) for i, name in enumerate(names)}
    errors = [None] + [explain(s)[0] for s in range(1, int(poses.status.max(initial=0)) + 1)]
    columns["error"] = pyarrow.array([errors[s] for s in poses.status.tolist()], pyarrow.string())
    pyarrow.parquet.write_table(pyarrow.table(columns), path)


def pose_columns(poses: Poses) -> tuple[list[str], Array]:
    """Column names and the matrix (m, columns) of all numbers."""
    axes = poses.axis_names
    names = [f"pcs_{a}" for a in axes] + [f"mcs_{a}" for a in "XYZ"]
    names += [f"direction_{c}" for c in "ijk"] + [f"acs_{a}" for a in axes]
    names += ["condition_linear", "condition_rotary"]
    n = len(axes)
    parts = [poses.program[:, :n], poses.tip, poses.direction, poses.axes[:, :n]]
    conditions = np.column_stack([poses.linear, poses.rotary])
    return names, np.ascontiguousarray(np.concatenate([*parts, conditions], axis=1))


def _number_rows(matrix: Array) -> list[str]:
    """Each row as text with commas: the shortest digits that read back as the same number."""
    text = orjson.dumps(np.ascontiguousarray(matrix), option=orjson.OPT_SERIALIZE_NUMPY)
    return text.decode()[2:-2].split("],[")
