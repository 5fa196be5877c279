"""`ncscope check`: lists and programs, without a look at positions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.inputs import pole_note, run_program
from ncscope.cli.options import (
    FoldersOption,
    KinematicsOption,
    MachineOption,
    ManualOption,
    ProbeOption,
    SetOption,
)
from ncscope.cli.screen import fail, show_diagnostics
from ncscope.cli.settings import read_settings

if TYPE_CHECKING:
    from ncscope.diagnostics import Diagnostic


def check_command(
    paths: Annotated[list[Path], typer.Argument(help="Lists, folders of lists, programs.")],
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    probe: ProbeOption = None,
    manual: ManualOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
    strict: Annotated[bool, typer.Option("--strict", help="A warning counts as an error.")] = False,
) -> None:
    """Check lists and programs; exit code 1 on errors."""
    from ncscope.lists import check_lists

    found: list[Diagnostic] = []
    for path in paths:
        if not path.exists():
            fail(f"{path} does not exist")
        if path.is_dir() or path.suffix.lower() == ".lis":
            found.extend(check_lists(path))
        else:
            from ncscope.execution import Options

            options = Options(external=read_settings(values))
            result, more, source = run_program(
                path, machine, options, probe, folders or (), kinematics, manual
            )
            found.extend([*(d for d in more if d.severity != "note"), *result.diagnostics])
            found.extend(pole_note(result, source.source))
    show_diagnostics(found)
    counts = {s: sum(d.severity == s for d in found) for s in ("error", "warning", "note")}
    typer.echo(", ".join(f"{n} {s}{'' if n == 1 else 's'}" for s, n in counts.items()))
    raise typer.Exit(1 if counts["error"] or (strict and counts["warning"]) else 0)
