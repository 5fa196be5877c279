"""`ncscope explain`: one block taken apart."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from ncscope.cli.inputs import run_program
from ncscope.cli.options import (
    ClampOption,
    FoldersOption,
    KinematicsOption,
    MachineOption,
    ManualOption,
    ProbeOption,
    SetOption,
    SkipOption,
    read_levels,
    read_place,
)
from ncscope.cli.screen import console, fail, show_diagnostics, show_table
from ncscope.cli.settings import read_settings


class ExplainFormat(StrEnum):
    """How an explanation is written."""

    TEXT = "text"
    JSON = "json"


def explain_command(
    place: Annotated[str, typer.Argument(metavar="PROGRAM:LINE", help="Or PROGRAM:N40.")],
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    format: Annotated[
        ExplainFormat, typer.Option("--format", help="text or json.")
    ] = ExplainFormat.TEXT,
    clamp: ClampOption = None,
    skip: SkipOption = "",
    probe: ProbeOption = None,
    manual: ManualOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
) -> None:
    """Take the axis positions of one block apart, each part with the line that set it."""
    import json

    from ncscope.execution import Options
    from ncscope.views.table import explain_table

    path, line, number = read_place(place)
    options = Options(clamp, read_levels(skip), external=read_settings(values))
    result, found, source = run_program(
        path, machine, options, probe, folders or (), kinematics, manual
    )
    try:
        if number is not None:
            line = result.line_of_block(number)
        explanation = result.explain(line=line)
    except KeyError as error:
        show_diagnostics(d for d in [*found, *result.diagnostics] if d.is_error)
        fail(str(error.args[0]), code=1)
    if format is ExplainFormat.JSON:
        typer.echo(json.dumps(explanation.as_dict(), ensure_ascii=False, indent=1))
        return
    terminal = console()
    terminal.print(f"{explanation.file}:{line}  {source.source.line_text(line)}", markup=False)
    show_table(explain_table(explanation))
