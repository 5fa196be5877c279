"""`ncscope run`: an NC program as a table, as records, or as a file of columns."""

from __future__ import annotations

import os
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.extras import need_parquet
from ncscope.cli.files import check_target
from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import Inputs, pole_note, read_inputs
from ncscope.cli.options import AnswerOptions, BlocksOption, MachineOptions, StartOptions
from ncscope.cli.screen import console, fail, show_diagnostics, show_table
from ncscope.cli.writing import Format, write_run

if TYPE_CHECKING:
    from ncscope.trajectory import Trajectory


@with_groups
def run_command(
    program: Annotated[Path, typer.Argument(help="NC program.")],
    *,
    setup: MachineOptions,
    format: Annotated[
        Format | None, typer.Option("--format", help="table, jsonl, csv or parquet.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", help="File instead of the screen.")] = None,
    messages: Annotated[
        Path, typer.Option("--messages", help="Folder for the files of #MSG SAVE.")
    ] = Path("."),
    start: StartOptions,
    answers: AnswerOptions,
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
    shape = _format(format, out)
    if out is not None:
        check_target(out, program, *setup.files, *answers.files)
    _check_sample(sample)
    inputs = read_inputs(
        program, setup, start, answers, max_blocks=max_blocks, strict=strict, sample=sample
    )
    if shape is Format.TABLE:
        result, ok = _judge(inputs, messages, program, inputs.run())
        _say(inputs, result)
        _show_run(result, ok)
    else:
        judge = partial(_judge, inputs, messages, program)
        cores = jobs or min(2, os.cpu_count() or 1)
        result, ok = write_run(shape, out, cores, inputs, judge)
        if shape is not Format.JSONL:
            _say(inputs, result)
    raise typer.Exit(0 if ok else 1)


def _format(format: Format | None, out: Path | None) -> Format:
    shape = format or Format.TABLE
    if out is not None and format is None and out.suffix in (".csv", ".jsonl", ".parquet"):
        shape = Format(out.suffix[1:])
    if out is not None and shape is Format.TABLE:
        fail("--out writes csv, jsonl or parquet: give --format csv, or name the file x.csv")
    if out is None and shape is Format.PARQUET:
        fail("--format parquet needs --out FILE")
    if shape is Format.PARQUET:
        need_parquet()
    return shape


def _check_sample(tolerance: float | None) -> None:
    from ncscope.motion.sampling import FINEST

    if tolerance is not None and not tolerance >= FINEST:
        fail(f"--sample {tolerance:g}: the tolerance has to be {FINEST:g} or more (mm and degrees)")


def _judge(
    inputs: Inputs, messages: Path, program: Path, result: Trajectory
) -> tuple[Trajectory, bool]:
    """The result with what its messages have wrong, which are written here; whether it is ok."""
    from ncscope.views.message_files import write_messages

    said = (*result.diagnostics, *write_messages(messages, result.messages, (program,)))
    ok = result.ok and not any(d.is_error for d in (*inputs.faults, *said))
    return replace(result, diagnostics=said), ok


def _say(inputs: Inputs, result: Trajectory) -> None:
    near = pole_note(result, inputs.program.source)
    show_diagnostics([*inputs.faults, *result.diagnostics, *near])


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
