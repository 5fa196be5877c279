"""`ncscope check`: lists and programs, without a look at positions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.inputs import run_program
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
    from ncscope.diagnostics import Diagnostic, Source
    from ncscope.trajectory import Trajectory


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
            found.extend(_nearest_to_pole(result, source.source))
    show_diagnostics(found)
    counts = {s: sum(d.severity == s for d in found) for s in ("error", "warning", "note")}
    typer.echo(", ".join(f"{n} {s}{'' if n == 1 else 's'}" for s, n in counts.items()))
    raise typer.Exit(1 if counts["error"] or (strict and counts["warning"]) else 0)


def _nearest_to_pole(result: Trajectory, source: Source) -> Iterator[Diagnostic]:
    """N4104 at the move whose end is nearest to the singular direction."""
    import numpy as np

    from ncscope.diagnostics import Span, diagnostic
    from ncscope.inspection import place, pole_distance

    distance = pole_distance(result)
    if np.isnan(distance).all():
        return
    nearest = int(np.nanargmin(distance))
    file, line, _ = place(result, nearest)
    span, where = None, f" ({file}:{line})"
    if file == source.name:
        start = source.line_start(line)
        span, where = Span(source, start, start + len(source.line_text(line))), ""
    message = (
        f"the tool comes nearest to its singular direction here: {distance[nearest]:.4f} degrees"
    )
    yield diagnostic("N4104", span, message + where)
