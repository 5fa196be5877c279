"""`ncscope where`: axis positions of the display, seen from a block of a program."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import read_inputs
from ncscope.cli.options import AnswerOptions, MachineOptions, StartOptions
from ncscope.cli.place import fail_without_block, read_place
from ncscope.cli.screen import console, fail, show_table
from ncscope.cli.words import read_positions

if TYPE_CHECKING:
    from ncscope.explanation import Whereabouts


class WhereFormat(StrEnum):
    """How the coordinates are written."""

    TABLE = "table"
    JSON = "json"


@with_groups
def where_command(
    at: Annotated[str, typer.Option("--at", metavar="PROGRAM:LINE", help="Or PROGRAM:N40.")],
    axes: Annotated[
        list[str], typer.Option("--axes", metavar="X=1 Y=2 ..", help="Axis positions.")
    ],
    more: Annotated[
        list[str] | None, typer.Argument(metavar="Y=2 ..", help="Further axes.", hidden=True)
    ] = None,
    *,
    setup: MachineOptions,
    format: Annotated[
        WhereFormat, typer.Option("--format", help="table or json.")
    ] = WhereFormat.TABLE,
    start: StartOptions,
    answers: AnswerOptions,
) -> None:
    """Where axis positions are in PCS, WCS and MCS under the state of a block."""
    from ncscope.kinematics.universal import KinematicsError

    positions = read_positions([*axes, *(more or ())])
    asked = read_place(at)
    inputs = read_inputs(asked.path, setup, start, answers)
    result = inputs.run()
    try:
        line = asked.line_in(result)
        place = result.where(positions, line=line)
    except KeyError as error:
        fail_without_block(error, [*inputs.found, *result.diagnostics])
    except KinematicsError as error:
        fail(f"the axis positions have no programmed values: {error.message}", code=1)
    _show(place, f"{place.file}:{line}  {inputs.program.source.line_text(line)}", format)


def _show(place: Whereabouts, block: str, format: WhereFormat) -> None:
    import json

    from ncscope.views.table import where_table

    if format is WhereFormat.JSON:
        typer.echo(json.dumps(place.as_dict(), ensure_ascii=False, indent=1))
        return
    terminal = console()
    terminal.print(block, markup=False)
    show_table(where_table(place))
    if place.assumed:
        names = " ".join(place.assumed)
        terminal.print(f"not given, as the block left it: {names}", markup=False)
