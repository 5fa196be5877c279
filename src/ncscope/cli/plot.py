"""`ncscope plot`: the path of a program, or the chain of a machine, as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.extras import need_pictures
from ncscope.cli.files import check_target, write_document
from ncscope.cli.groups import with_groups
from ncscope.cli.inputs import Inputs, read_inputs, read_machine
from ncscope.cli.kin_options import finite_length
from ncscope.cli.kinematics import chosen_id, kinematics_of_any_step
from ncscope.cli.options import (
    AnswerOptions,
    BlocksOption,
    MachineOptions,
    SampleOption,
    StartOptions,
    read_sample,
)
from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from ncscope.kinematics import UniversalKinematics
    from ncscope.machine import Machine
    from ncscope.trajectory import Trajectory

FORMS = (".png", ".svg", ".html")


@with_groups
def plot_command(
    out: Annotated[Path, typer.Option("--out", "-o", help="File: .png, .svg or .html.")],
    program: Annotated[
        Path | None, typer.Argument(help="NC program; without it the machine is drawn.")
    ] = None,
    *,
    setup: MachineOptions,
    id: Annotated[int | None, typer.Option("--id", help="Id of the kinematics to draw.")] = None,
    tool_length: Annotated[
        float,
        typer.Option(
            "--tool-length", help="Length of the tool that is drawn, mm.", callback=finite_length
        ),
    ] = 0.0,
    start: StartOptions,
    answers: AnswerOptions,
    max_blocks: BlocksOption = 0,
    sample: SampleOption = None,
) -> None:
    """Draw the path of a program with its axes, or the chain of a machine."""
    form = _picture_form(out)
    if program is None:
        write_document(out, _machine_picture(setup, id, tool_length, form))
        return
    check_target(out, program, *setup.files, *answers.files)
    inputs = read_inputs(
        program, setup, start, answers, max_blocks=max_blocks, sample=read_sample(sample, program)
    )
    result = inputs.run()
    write_document(out, _path_picture(inputs, result, program, form))
    raise typer.Exit(0 if result.ok else 1)


def _picture_form(out: Path) -> str:
    """png, svg or html; ends the process for another suffix or without the libraries."""
    form = out.suffix.lower()
    if form not in FORMS:
        fail(f"--out {out}: the name must end in .png, .svg or .html")
    need_pictures()
    return form[1:]


def _path_picture(inputs: Inputs, result: Trajectory, program: Path, form: str) -> bytes:
    from ncscope.views.pictures.files import path_picture

    show_diagnostics(d for d in (*inputs.faults, *result.diagnostics) if d.severity != "note")
    if len(result) == 0:
        fail(f"{program} has no motion blocks to draw", code=1)
    return path_picture(result, program.name, form)


def _machine_picture(setup: MachineOptions, id: int | None, tool_length: float, form: str) -> bytes:
    from ncscope.views.pictures.files import chain_picture

    path = setup.machine
    if path is None:
        fail("plot needs a program, or --machine for a picture of the machine")
    if setup.kinematics is not None:
        fail("--kinematics FILE.py is for a program; --id chooses the chain to draw")
    lists, found = read_machine(path)
    show_diagnostics(d for d in found if d.severity != "note")
    chosen = chosen_id(lists, path, id)
    model = _chain(lists, path, chosen)
    known = sorted({**lists.second_step_parameters, **lists.kinematic_parameters})
    if len(known) > 1:
        others = ", ".join(map(str, known))
        typer.echo(f"kinematics {chosen} of {others} is drawn; --id chooses another", err=True)
    return chain_picture(model, lists.name, tool_length, form)


def _chain(lists: Machine, path: Path, id: int) -> UniversalKinematics:
    """The kinematics with this id; ends the process when it has no chain or a wrong one."""
    from ncscope.kinematics import KinematicsError, UniversalKinematics
    from ncscope.kinematics.building import UNIVERSAL, type_of

    parameters = {**lists.second_step_parameters, **lists.kinematic_parameters}[id]
    if type_of(parameters) != UNIVERSAL:
        fail(
            f"{path}: kinematics {id} is no universal kinematics (91), so it has no chain to draw",
            code=1,
        )
    try:
        model = kinematics_of_any_step(lists, id)
    except KinematicsError as error:
        fail(f"{path}: {error}", code=1)
    assert isinstance(model, UniversalKinematics)
    return model
