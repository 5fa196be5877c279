"""`ncscope where`: axis positions of the display, seen from a block of a program."""

from __future__ import annotations

import json
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
from ncscope.cli.words import read_positions


class WhereFormat(StrEnum):
    """How the coordinates are written."""

    TABLE = "table"
    JSON = "json"


def where_command(
    at: Annotated[str, typer.Option("--at", metavar="PROGRAM:LINE", help="Or PROGRAM:N40.")],
    axes: Annotated[
        list[str], typer.Option("--axes", metavar="X=1 Y=2 ..", help="Axis positions.")
    ],
    more: Annotated[
        list[str] | None, typer.Argument(metavar="Y=2 ..", help="Further axes.", hidden=True)
    ] = None,
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    format: Annotated[
        WhereFormat, typer.Option("--format", help="table or json.")
    ] = WhereFormat.TABLE,
    clamp: ClampOption = None,
    skip: SkipOption = "",
    probe: ProbeOption = None,
    manual: ManualOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
) -> None:
    """Where axis positions are in PCS, WCS and MCS under the state of a block."""
    from ncscope.execution import Options
    from ncscope.kinematics.universal import KinematicsError
    from ncscope.views.table import where_table

    positions = read_positions([*axes, *(more or ())])
    path, line, number = read_place(at)
    options = Options(clamp, read_levels(skip), external=read_settings(values))
    result, found, source = run_program(
        path, machine, options, probe, folders or (), kinematics, manual
    )
    try:
        if number is not None:
            line = result.line_of_block(number)
        place = result.where(positions, line=line)
    except KeyError as error:
        show_diagnostics(d for d in [*found, *result.diagnostics] if d.is_error)
        fail(str(error.args[0]), code=1)
    except KinematicsError as error:
        fail(f"the axis positions have no programmed values: {error.message}", code=1)
    if format is WhereFormat.JSON:
        typer.echo(json.dumps(place.as_dict(), ensure_ascii=False, indent=1))
        return
    terminal = console()
    terminal.print(f"{place.file}:{line}  {source.source.line_text(line)}", markup=False)
    show_table(where_table(place))
    if place.assumed:
        names = " ".join(place.assumed)
        terminal.print(f"not given, as the block left it: {names}", markup=False)
