"""`ncscope run`: an NC program as a table, as records, or as a file of columns."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.inputs import pole_note, read_inputs
from ncscope.cli.options import (
    BlocksOption,
    ClampOption,
    FoldersOption,
    KinematicsOption,
    MachineOption,
    ManualOption,
    ProbeOption,
    SetOption,
    SkipOption,
    read_levels,
)
from ncscope.cli.screen import console, fail, show_diagnostics, show_table
from ncscope.cli.settings import read_settings
from ncscope.cli.writing import Format, write_run

if TYPE_CHECKING:
    from ncscope.trajectory import Trajectory


def run_command(
    program: Annotated[Path, typer.Argument(help="NC program.")],
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    format: Annotated[
        Format | None, typer.Option("--format", help="table, jsonl, csv or parquet.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", help="File instead of the screen.")] = None,
    messages: Annotated[
        Path, typer.Option("--messages", help="Folder for the files of #MSG SAVE.")
    ] = Path("."),
    clamp: ClampOption = None,
    skip: SkipOption = "",
    probe: ProbeOption = None,
    manual: ManualOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
    max_blocks: BlocksOption = 0,
    strict: Annotated[bool, typer.Option("--strict", help="A warning stops the run.")] = False,
    sample: Annotated[
        float | None,
        typer.Option(
            "--sample", help="Points along the moves, with this chord error: mm, degrees."
        ),
    ] = None,
    jobs: Annotated[
        int, typer.Option("--jobs", min=0, help="Cores for a run with --out; 0: up to two.")
    ] = 0,
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
    inputs = read_inputs(program, machine, options, probe, folders or (), kinematics, manual)
    found = [d for d in inputs.found if d.severity != "note"]

    def judge(result: Trajectory) -> tuple[Trajectory, bool]:
        said = (*result.diagnostics, *write_messages(messages, result.messages, (program,)))
        ok = result.ok and not any(d.is_error for d in (*found, *said))
        return replace(result, diagnostics=said), ok

    if shape is Format.TABLE:
        result, ok = judge(inputs.run())
    else:
        cores = jobs or min(2, os.cpu_count() or 1)
        axes, sampled = inputs.machine.axis_names, sample is not None
        result, ok = write_run(shape, out, cores, axes, sampled, found, inputs.run, judge)
    if shape is not Format.JSONL:
        near = pole_note(result, inputs.program.source)
        show_diagnostics([*found, *result.diagnostics, *near])
    if shape is Format.TABLE:
        _show_run(result, ok)
    raise typer.Exit(0 if ok else 1)


def _format(format: Format | None, out: Path | None) -> Format:
    shape = format or Format.TABLE
    if out is not None and format is None and out.suffix in (".csv", ".jsonl", ".parquet"):
        shape = Format(out.suffix[1:])
    if out is not None and shape is Format.TABLE:
        fail("--out writes csv, jsonl or parquet: give --format csv, or name the file x.csv")
    if out is None and shape is Format.PARQUET:
        fail("--format parquet needs --out FILE")
    return shape


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
