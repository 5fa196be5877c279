"""Options that the commands of `ncscope kin` share, and the form of their output."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ncscope.cli.files import same_file
from ncscope.cli.screen import fail


class KinFormat(StrEnum):
    """How poses are written."""

    TABLE = "table"
    JSONL = "jsonl"
    CSV = "csv"


def finite_length(value: float) -> float:
    """The length of --tool-length; ends the process for nan and infinity."""
    if not math.isfinite(value):
        fail(f"--tool-length {value:g}: write a length in mm")
    return value


PosesOption = Annotated[
    Path | None, typer.Option("--poses", help="CSV or Parquet file with a column for each axis.")
]


@dataclass(frozen=True)
class KinOptions:
    """Which kinematics of the machine, with which tool, and where the poses go."""

    id: Annotated[
        int | None, typer.Option("--id", help="Kinematic id; needed where there are several.")
    ] = None
    tool_length: Annotated[
        float, typer.Option("--tool-length", help="Tool length, mm.", callback=finite_length)
    ] = 0.0
    format: Annotated[KinFormat | None, typer.Option("--format", help="table, jsonl or csv.")] = (
        None
    )
    out: Annotated[Path | None, typer.Option("--out", help="File: .csv, .jsonl or .parquet.")] = (
        None
    )


def output_form(options: KinOptions, poses: Path | None) -> str:
    """The form of the output: that of --format, else of the file's name."""
    format, out = options.format, options.out
    if out is None:
        return str(format or KinFormat.TABLE)
    if poses is not None and same_file(out, poses):
        fail(f"--out {out} is the table that is read")
    shape = str(format) if format else out.suffix.lower().removeprefix(".")
    if shape not in ("csv", "jsonl", "parquet"):
        fail(f"--out {out}: name it .csv, .jsonl or .parquet, or give --format csv or jsonl")
    return shape
