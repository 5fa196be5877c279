"""Options that several commands share, and how their texts are read."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ncscope.cli.screen import fail

MachineOption = Annotated[
    Path | None,
    typer.Option("--machine", "-m", help="Folder of lists, start-up list, or one list."),
]
KinematicsOption = Annotated[
    Path | None,
    typer.Option("--kinematics", help="Python file with kinematics of the user; it is run."),
]
ClampOption = Annotated[
    int | None, typer.Option("--clamp", help="Clamp position handed over at program start.")
]
SkipOption = Annotated[
    str, typer.Option("--skip", help="Skip levels that are on, for example 1,3; / is level 1.")
]

ProbeOption = Annotated[
    Path | None,
    typer.Option("--probe", help="CSV: a row for each measuring run, a column for each axis."),
]

ManualOption = Annotated[
    Path | None,
    typer.Option("--manual", help="CSV of jog increments: a row for each G200 and G201."),
]

SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="V.E.NAME=VALUE", help="Value of a variable of the PLC."),
]
FoldersOption = Annotated[
    list[Path] | None,
    typer.Option("--subprograms", help="Another folder in which called files may lie."),
]
BlocksOption = Annotated[
    int, typer.Option("--max-blocks", min=0, help="Stop after so many blocks; 0: no limit.")
]


def read_levels(text: str) -> frozenset[int]:
    """The levels of --skip; ends the process when the text is none."""
    try:
        levels = frozenset(int(part) for part in text.split(",") if part.strip())
    except ValueError:
        fail(f"--skip {text}: write levels from 1 to 10 with commas between them")
    if not all(1 <= level <= 10 for level in levels):
        fail(f"--skip {text}: levels are 1 to 10")
    return levels


def read_place(text: str) -> tuple[Path, int, int | None]:
    """PROGRAM:LINE or PROGRAM:N40 as path, line and block number."""
    name, _, where = text.rpartition(":")
    number = where[1:] if where[:1] in ("N", "n") else None
    if not name or not (number or where).isdigit():
        fail(f"{text}: write PROGRAM:LINE or PROGRAM:N40")
    return Path(name), 0 if number else int(where), int(number) if number else None
