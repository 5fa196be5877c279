"""`ncscope plot`: the path of a program, or the chain of a machine, as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ncscope.cli.inputs import read_machine, run_program
from ncscope.cli.kin_options import finite_length
from ncscope.cli.kinematics import chosen_id, kinematics_of_any_step
from ncscope.cli.options import (
    BlocksOption,
    ClampOption,
    FoldersOption,
    KinematicsOption,
    MachineOption,
    ManualOption,
    ProbeOption,
    SetOption,
    SkipOption,
    read_levels,
)
from ncscope.cli.screen import fail, show_diagnostics
from ncscope.cli.settings import read_settings

FORMS = (".png", ".svg", ".html")
SAMPLE = 0.02
"""mm and degrees: finer than a picture shows."""
SampleOption = Annotated[
    float,
    typer.Option(
        "--sample", help="Chord error of arcs and turns, mm and degrees; 0 for block ends only."
    ),
]


def plot_command(
    out: Annotated[Path, typer.Option("--out", "-o", help="File: .png, .svg or .html.")],
    program: Annotated[
        Path | None, typer.Argument(help="NC program; without it the machine is drawn.")
    ] = None,
    machine: MachineOption = None,
    kinematics: KinematicsOption = None,
    id: Annotated[int | None, typer.Option("--id", help="Id of the kinematics to draw.")] = None,
    tool_length: Annotated[
        float,
        typer.Option(
            "--tool-length", help="Length of the tool that is drawn, mm.", callback=finite_length
        ),
    ] = 0.0,
    clamp: ClampOption = None,
    skip: SkipOption = "",
    probe: ProbeOption = None,
    manual: ManualOption = None,
    values: SetOption = None,
    folders: FoldersOption = None,
    max_blocks: BlocksOption = 0,
    sample: SampleOption = SAMPLE,
) -> None:
    """Draw the path of a program with its axes, or the chain of a machine."""
    form = picture_form(out)
    if program is None:
        if machine is None:
            fail("plot needs a program, or --machine for a picture of the machine")
        if kinematics is not None:
            fail("--kinematics FILE.py is for a program; --id chooses the chain to draw")
        write_picture(out, _machine_picture(machine, id, tool_length, form))
        return
    check_target(out, program)
    from ncscope.execution import Options
    from ncscope.views.pictures.files import path_picture

    tolerance = read_sample(sample)
    options = Options(
        clamp, read_levels(skip), max_blocks, sample=tolerance, external=read_settings(values)
    )
    result, found, _ = run_program(
        program, machine, options, probe, folders or (), kinematics, manual
    )
    found = [d for d in (*found, *result.diagnostics) if d.severity != "note"]
    show_diagnostics(found)
    if len(result) == 0:
        fail(f"{program} has no motion blocks to draw", code=1)
    write_picture(out, path_picture(result, program.name, form))
    raise typer.Exit(0 if result.ok else 1)


def picture_form(out: Path) -> str:
    """png, svg or html; ends the process for another suffix or without the libraries."""
    form = out.suffix.lower()
    if form not in FORMS:
        fail(f"--out {out}: the name must end in .png, .svg or .html")
    need_libraries()
    return form[1:]


def need_libraries() -> None:
    """Ends the process with what to install when the extra `plot` is missing."""
    from importlib.util import find_spec

    missing = [name for name in ("matplotlib", "plotly", "jinja2") if find_spec(name) is None]
    if missing:
        fail(f'pictures need {" and ".join(missing)}: pip install "ncscope[plot]"')


def read_sample(tolerance: float) -> float | None:
    """The tolerance for points along the moves, None for 0; ends the process for a wrong one."""
    from ncscope.motion.sampling import FINEST

    if tolerance != 0 and not tolerance >= FINEST:
        fail(f"--sample {tolerance:g}: 0, or {FINEST:g} and more (mm and degrees)")
    return tolerance or None


def check_target(out: Path, program: Path) -> None:
    """Ends the process when the output would overwrite the program."""
    if out.exists() and program.exists() and out.samefile(program):
        fail(f"--out {out} is the program itself")


def write_picture(out: Path, data: bytes) -> None:
    """Writes the file and names it; ends the process when it cannot be written."""
    try:
        out.write_bytes(data)
    except OSError as error:
        fail(f"cannot write {out}: {error.strerror}")
    typer.echo(f"wrote {out}")


def _machine_picture(path: Path, id: int | None, tool_length: float, form: str) -> bytes:
    from ncscope.kinematics import KinematicsError
    from ncscope.kinematics.building import UNIVERSAL, type_of
    from ncscope.kinematics.universal import UniversalKinematics
    from ncscope.views.pictures.files import chain_picture

    lists, found = read_machine(path)
    show_diagnostics(d for d in found if d.severity != "note")
    chosen = chosen_id(lists, path, id)
    sets = {**lists.second_step_parameters, **lists.kinematic_parameters}
    if type_of(sets[chosen]) != UNIVERSAL:
        fail(
            f"{path}: kinematics {chosen} is no universal kinematics (91), so it has no chain to "
            "draw",
            code=1,
        )
    try:
        model = kinematics_of_any_step(lists, chosen)
    except KinematicsError as error:
        fail(f"{path}: {error}", code=1)
    assert isinstance(model, UniversalKinematics)
    if len(sets) > 1:
        known = ", ".join(map(str, sorted(sets)))
        typer.echo(f"kinematics {chosen} of {known} is drawn; --id chooses another", err=True)
    return chain_picture(model, lists.name, tool_length, form)
