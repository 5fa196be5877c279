"""`ncscope report`: a run as one html document."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.extras import need_pictures
from ncscope.cli.files import check_target, write_document
from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import read_inputs
from ncscope.cli.options import (
    AnswerOptions,
    BlocksOption,
    MachineOptions,
    SampleOption,
    StartOptions,
    read_sample,
)
from ncscope.cli.place import Place, read_block
from ncscope.cli.screen import fail

if TYPE_CHECKING:
    from ncscope.execution import Program
    from ncscope.explanation import Explanation
    from ncscope.trajectory import Trajectory


@with_groups
def report_command(
    program: Annotated[Path, typer.Argument(help="NC program.")],
    out: Annotated[Path, typer.Option("--out", "-o", help="File: .html.")],
    *,
    setup: MachineOptions,
    explain: Annotated[
        str,
        typer.Option(
            "--explain", metavar="N40,N60", help="Blocks to explain: N40,N60 or lines: 12,15."
        ),
    ] = "",
    start: StartOptions,
    answers: AnswerOptions,
    max_blocks: BlocksOption = 0,
    sample: SampleOption = None,
) -> None:
    """Write a run as one document that opens without a network."""
    if out.suffix.lower() != ".html":
        fail(f"--out {out}: the name must end in .html")
    need_pictures()
    check_target(out, program, *setup.files, *answers.files)
    wanted = _read_blocks(program, explain)
    from ncscope.views.report import Subject, report_page

    inputs = read_inputs(
        program, setup, start, answers, max_blocks=max_blocks, sample=read_sample(sample, program)
    )
    result = inputs.run()
    subject = Subject(
        program.name,
        inputs.machine,
        result,
        inputs.faults,
        _lists(setup.machine),
        _in_words(start),
        [_explained(result, inputs.program, place) for place in wanted],
    )
    write_document(out, report_page(subject))
    raise typer.Exit(0 if result.ok and inputs.usable else 1)


def _read_blocks(program: Path, text: str) -> list[Place]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    places = [place for part in parts if (place := read_block(program, part))]
    if len(places) < len(parts):
        fail(f"--explain {text}: write blocks as N40,N60 or lines as 12,15")
    return places


def _explained(result: Trajectory, program: Program, place: Place) -> tuple[str, Explanation]:
    try:
        line = place.line_in(result)
        explanation = result.explain(line)
    except KeyError as error:
        fail(f"--explain {place.name}: {error.args[0]}", code=1)
    return program.source.line_text(line), explanation


def _lists(machine: Path | None) -> list[tuple[str, str]]:
    if machine is None:
        return []
    from ncscope.lists.files import find_lists
    from ncscope.lists.table import LIST_NAMES

    return [(f.document.name, LIST_NAMES[f.list_kind]) for f in find_lists(machine)[0]]


def _in_words(start: StartOptions) -> str:
    parts = [f"clamp position {start.clamp}"] if start.clamp is not None else []
    return ", ".join([*parts, *([f"skip levels {start.skip}"] if start.skip else [])])
