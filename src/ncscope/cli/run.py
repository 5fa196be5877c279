"""`ncscope run`: an NC program as a table, as records, or as a file of columns."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.inputs import run_program
from ncscope.cli.options import (
    ClampOption,
    FoldersOption,
    KinematicsOption,
    MachineOption,
    ProbeOption,
    SetOption,
    SkipOption,
    read_levels,
    read_settings,
)
from ncscope.cli.screen import console, fail, show_diagnostics, show_table

if TYPE_CHECKING:
    from ncscope.diagnostics import Diagnostic
    from ncscope.trajectory import Trajectory


class Format(StrEnum):
    """How a run is written."""

    TABLE = "table"
    JSONL = "jsonl"
    CSV = "csv"


def run_command(
    program: Annotated[Path, typer.Argument(help="NC program.")],
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    format: Annotated[Format | None, typer.Option("--format", help="table, jsonl or csv.")] = None,
    out: Annotated[Path | None, typer.Option("--out", help="File instead of the screen.")] = None,
    messages: Annotated[
        Path, typer.Option("--messages", help="Folder for the files of #MSG SAVE.")
    ] = Path("."),
    clamp: ClampOption = None,
    skip: SkipOption = "",
    probe: ProbeOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
    max_blocks: Annotated[
        int, typer.Option("--max-blocks", min=0, help="Stop after so many blocks; 0: no limit.")
    ] = 0,
    strict: Annotated[bool, typer.Option("--strict", help="A warning stops the run.")] = False,
    sample: Annotated[
        float | None,
        typer.Option(
            "--sample", help="Points along the moves, with this chord error: mm, degrees."
        ),
    ] = None,
) -> None:
    """Run an NC program and show where the tool and every axis go."""
    from ncscope.execution import Options
    from ncscope.motion.sampling import FINEST
    from ncscope.views.message_files import write_messages

    shape = _format(format, out)
    if out is not None and out.exists() and program.exists() and out.samefile(program):
        fail(f"--out {out} is the program itself")
    if sample is not None and not sample >= FINEST:
        fail(f"--sample {sample:g}: the tolerance has to be {FINEST:g} or more (mm and degrees)")
    external = read_settings(values)
    options = Options(
        clamp, read_levels(skip), max_blocks, strict, external=external, sample=sample
    )
    result, found, _ = run_program(program, machine, options, probe, folders or (), kinematics)
    found = [d for d in found if d.severity != "note"]
    errors = write_messages(messages, result.messages, (program,))
    ok = result.ok and not any(d.is_error for d in (*found, *errors))
    if shape is Format.TABLE:
        show_diagnostics([*found, *result.diagnostics, *errors])
        _show_run(result, ok)
    else:
        _write(shape, out, result, [*found, *errors], ok)
    raise typer.Exit(0 if ok else 1)


def _format(format: Format | None, out: Path | None) -> Format:
    shape = format or Format.TABLE
    if out is not None and format is None and out.suffix in (".csv", ".jsonl"):
        shape = Format(out.suffix[1:])
    if out is not None and shape is Format.TABLE:
        fail("--out writes csv or jsonl: give --format csv or --format jsonl")
    return shape


def _write(
    shape: Format,
    out: Path | None,
    result: Trajectory,
    found: list[Diagnostic],
    ok: bool,
) -> None:
    from ncscope.views.records import write_csv, write_jsonl

    def write(stream) -> None:
        if shape is Format.JSONL:
            write_jsonl(stream, result, found, ok)
        else:
            write_csv(stream, result)

    if shape is Format.CSV:
        show_diagnostics([*found, *result.diagnostics])
    if out is None:
        write(sys.stdout)
        return
    try:
        with out.open("w", encoding="utf-8", newline="") as stream:
            write(stream)
    except OSError as error:
        fail(f"cannot write {out}: {error.strerror}")


def _show_run(result: Trajectory, ok: bool) -> None:
    from ncscope.views.table import run_table

    terminal = console()
    if len(result):
        show_table(run_table(result))
    for message in result.messages:
        terminal.print(f"message  {message.text}", markup=False, highlight=False)
    status = "ok" if ok else "stopped by an error"
    points = len(result) - int(result.end.sum())
    count = f"{len(result) - points} moves" + (f" and {points} points between" if points else "")
    terminal.print(f"{count}, {status}", style="green" if ok else "red")
