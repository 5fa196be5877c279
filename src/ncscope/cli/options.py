"""Options that several commands share.

An option that every run needs is a field of one of the groups here; `inputs.read_inputs` says what
becomes of it. No other place names it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ncscope.cli.screen import fail


@dataclass(frozen=True)
class MachineOptions:
    """The machine."""

    machine: Annotated[
        Path | None,
        typer.Option("--machine", "-m", help="Folder of lists, start-up list, or one list."),
    ] = None
    kinematics: Annotated[
        Path | None,
        typer.Option("--kinematics", help="Python file with kinematics of the user; it is run."),
    ] = None

    @property
    def files(self) -> tuple[Path | None, ...]:
        """What no output may overwrite."""
        return self.machine, self.kinematics


@dataclass(frozen=True)
class StartOptions:
    """What the control is told when the program starts."""

    clamp: Annotated[
        int | None, typer.Option("--clamp", help="Clamp position handed over at program start.")
    ] = None
    skip: Annotated[
        str, typer.Option("--skip", help="Skip levels that are on, for example 1,3; / is level 1.")
    ] = ""


@dataclass(frozen=True)
class AnswerOptions:
    """What probe, operator, PLC and disk answer when the program asks them."""

    probe: Annotated[
        Path | None,
        typer.Option("--probe", help="CSV: a row for each measuring run, a column for each axis."),
    ] = None
    manual: Annotated[
        Path | None,
        typer.Option("--manual", help="CSV of jog increments: a row for each G200 and G201."),
    ] = None
    values: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="V.E.NAME=VALUE", help="Value of a variable of the PLC."),
    ] = None
    folders: Annotated[
        list[Path] | None,
        typer.Option("--subprograms", help="Another folder in which called files may lie."),
    ] = None

    @property
    def files(self) -> tuple[Path | None, ...]:
        """What no output may overwrite."""
        return self.probe, self.manual


BlocksOption = Annotated[
    int, typer.Option("--max-blocks", min=0, help="Stop after so many blocks; 0: no limit.")
]
SampleOption = Annotated[
    float | None,
    typer.Option(
        "--sample",
        help="Chord error of arcs and turns, mm and degrees; 0 for block ends only. 0.02 without "
        "this option, 0.1 for a program above 4 MB.",
    ),
]
FINE_SAMPLE = 0.02
"""mm and degrees: finer than a picture shows."""


def read_levels(text: str) -> frozenset[int]:
    """The levels of --skip; ends the process when the text is none."""
    try:
        levels = frozenset(int(part) for part in text.split(",") if part.strip())
    except ValueError:
        fail(f"--skip {text}: write levels from 1 to 10 with commas between them")
    if not all(1 <= level <= 10 for level in levels):
        fail(f"--skip {text}: levels are 1 to 10")
    return levels


COARSE_SAMPLE, LONG_PROGRAM = 0.1, 4_000_000
"""The same for a program of so many bytes, of which a picture shows a contour as a dot: a million
arcs drawn finely are 30 million points."""


def read_sample(tolerance: float | None, program: Path) -> float | None:
    """The tolerance for points along the moves of a picture, None for block ends only; ends the
    process for a wrong one."""
    if tolerance is None:
        long = program.is_file() and program.stat().st_size > LONG_PROGRAM
        return COARSE_SAMPLE if long else FINE_SAMPLE
    from ncscope.motion.sampling import FINEST

    if tolerance != 0 and not tolerance >= FINEST:
        fail(f"--sample {tolerance:g}: 0, or {FINEST:g} and more (mm and degrees)")
    return tolerance or None
