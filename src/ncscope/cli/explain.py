"""`ncscope explain`: one block taken apart."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import read_inputs
from ncscope.cli.options import AnswerOptions, MachineOptions, StartOptions
from ncscope.cli.place import fail_without_block, read_place
from ncscope.cli.screen import console, show_table


class ExplainFormat(StrEnum):
    """How an explanation is written."""

    TEXT = "text"
    JSON = "json"


@with_groups
def explain_command(
    place: Annotated[str, typer.Argument(metavar="PROGRAM:LINE", help="Or PROGRAM:N40.")],
    *,
    setup: MachineOptions,
    format: Annotated[
        ExplainFormat, typer.Option("--format", help="text or json.")
    ] = ExplainFormat.TEXT,
    start: StartOptions,
    answers: AnswerOptions,
) -> None:
    """Take the axis positions of one block apart, each part with the line that set it."""
    import json

    from ncscope.views.table import explain_table

    asked = read_place(place)
    inputs = read_inputs(asked.path, setup, start, answers)
    result = inputs.run()
    try:
        line = asked.line_in(result)
        explanation = result.explain(line=line)
    except KeyError as error:
        fail_without_block(error, [*inputs.found, *result.diagnostics])
    if format is ExplainFormat.JSON:
        typer.echo(json.dumps(explanation.as_dict(), ensure_ascii=False, indent=1))
        return
    text = inputs.program.source.line_text(line)
    console().print(f"{explanation.file}:{line}  {text}", markup=False)
    show_table(explain_table(explanation))
