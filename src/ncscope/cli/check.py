"""`ncscope check`: lists and programs, without a look at positions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.files import exists
from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import pole_note, read_inputs
from ncscope.cli.options import AnswerOptions, MachineOptions, StartOptions
from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from ncscope.diagnostics import Diagnostic


@with_groups
def check_command(
    paths: Annotated[list[Path], typer.Argument(help="Lists, folders of lists, programs.")],
    *,
    setup: MachineOptions,
    answers: AnswerOptions,
    strict: Annotated[bool, typer.Option("--strict", help="A warning counts as an error.")] = False,
) -> None:
    """Check lists and programs; exit code 1 on errors."""
    from ncscope.lists import check_lists

    found: list[Diagnostic] = []
    for path in paths:
        if not exists(path):
            fail(f"{path} does not exist")
        if path.is_dir() or path.suffix.lower() == ".lis":
            found.extend(check_lists(path))
        else:
            found.extend(_program_faults(path, setup, answers))
    show_diagnostics(found)
    counts = {s: sum(d.severity == s for d in found) for s in ("error", "warning", "note")}
    typer.echo(", ".join(f"{n} {s}{'' if n == 1 else 's'}" for s, n in counts.items()))
    raise typer.Exit(1 if counts["error"] or (strict and counts["warning"]) else 0)


def _program_faults(
    path: Path, setup: MachineOptions, answers: AnswerOptions
) -> tuple[Diagnostic, ...]:
    inputs = read_inputs(path, setup, StartOptions(), answers)
    result = inputs.run()
    near = pole_note(result, inputs.program.source)
    return (*inputs.faults, *result.diagnostics, *near)
