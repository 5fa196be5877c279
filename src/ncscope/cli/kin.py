"""`ncscope kin`: axis values to tool poses and back through the kinematics of a machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.compare import compare_command
from ncscope.cli.extras import need_parquet
from ncscope.cli.files import text_output, writing
from ncscope.cli.groups import with_groups
from ncscope.cli.kin_options import KinOptions, PosesOption, output_form
from ncscope.cli.kinematics import chosen_kinematics, computing
from ncscope.cli.options import MachineOptions
from ncscope.cli.pose_input import near_values, poses_file, word_row
from ncscope.cli.screen import console, fail
from ncscope.cli.words import WordsCommand, read_words

if TYPE_CHECKING:
    from ncscope.frames import Array
    from ncscope.kinematics import KinematicStep
    from ncscope.kinematics.poses import Poses
    from ncscope.views.poses import Explain

kin_app = typer.Typer(
    no_args_is_help=True, help="Axis values and tool poses through a machine's kinematics."
)
kin_app.command("compare", cls=WordsCommand)(compare_command)


Words = Annotated[list[str] | None, typer.Argument(metavar="[X=.. Y=..]", show_default=False)]
NearOption = Annotated[
    list[str] | None,
    typer.Option("--near", metavar="A=.. C=..", help="Axis values nearby; they choose the pose."),
]


@kin_app.command("forward", cls=WordsCommand)
@with_groups
def forward_command(
    words: Words = None,
    axes: Annotated[
        list[str] | None, typer.Option("--axes", metavar="X=.. Y=..", help="Axis values.")
    ] = None,
    poses: PosesOption = None,
    *,
    setup: MachineOptions,
    asked: KinOptions,
) -> None:
    """Where the tool is for given axis values (mm, degrees)."""
    from ncscope.kinematics import UniversalKinematics
    from ncscope.kinematics.poses import poses_of_axes, poses_of_step

    shape = output_form(asked, poses)
    kin, names = chosen_kinematics(setup.machine, asked.id, setup.kinematics)
    given = [*(words or []), *(axes or [])]
    if poses is not None:
        _one_source(bool(given))
        rows = poses_file(poses).rows(names, "acs_")
    else:
        rows = word_row(given, names, "--axes")
    with computing():
        if isinstance(kin, UniversalKinematics):
            found = poses_of_axes(kin, rows, asked.tool_length)
        else:
            found = poses_of_step(kin, names, axes=rows, tool_length=asked.tool_length)
    _write(shape, asked, kin, found)


@kin_app.command("inverse", cls=WordsCommand)
@with_groups
def inverse_command(
    words: Words = None,
    program: Annotated[
        list[str] | None, typer.Option("--program", metavar="X=.. C=..", help="Programmed words.")
    ] = None,
    tip: Annotated[
        list[str] | None, typer.Option("--tip", metavar="X=.. Y=.. Z=..", help="Tool tip.")
    ] = None,
    direction: Annotated[
        tuple[float, float, float] | None,
        typer.Option("--direction", metavar="I J K", help="Tool direction, from tip to flange."),
    ] = None,
    poses: PosesOption = None,
    near: NearOption = None,
    both: Annotated[bool, typer.Option("--both", help="Both poses of the rotary axes.")] = False,
    *,
    setup: MachineOptions,
    asked: KinOptions,
) -> None:
    """Where the axes go for programmed words, or for a tool tip and direction (mm, degrees)."""
    shape = output_form(asked, poses)
    kin, names = chosen_kinematics(setup.machine, asked.id, setup.kinematics)
    given = [*(words or []), *(program or [])]
    start = near_values(near, names)
    by_tool = tip is not None or direction is not None
    _one_source(sum((bool(given), by_tool, poses is not None)) > 1)
    table = None if poses is None else poses_file(poses)
    with computing():
        if by_tool or (table is not None and table.has_tool(names)):
            tool = table.tool() if table else _tool(tip, direction)
            found = _of_tool(kin, tool, asked.tool_length, start, both)
        else:
            rows = table.rows(names, "pcs_") if table else word_row(given, names, "--program")
            found = _of_program(kin, names, rows, asked.tool_length, start, both)
    _write(shape, asked, kin, found)


def _of_tool(
    kin: KinematicStep,
    tool: tuple[Array, Array],
    tool_length: float,
    near: Array | None,
    both: bool,
) -> Poses:
    from ncscope.kinematics import UniversalKinematics
    from ncscope.kinematics.poses import poses_of_tool

    if not isinstance(kin, UniversalKinematics):
        fail("tool tip and direction are solved for type 91 only; give the programmed words")
    return poses_of_tool(kin, *tool, tool_length, near, both)


def _of_program(
    kin: KinematicStep,
    names: tuple[str, ...],
    rows: Array,
    tool_length: float,
    near: Array | None,
    both: bool,
) -> Poses:
    from ncscope.kinematics import UniversalKinematics
    from ncscope.kinematics.poses import poses_of_program, poses_of_step

    if isinstance(kin, UniversalKinematics):
        return poses_of_program(kin, rows, tool_length, near, both)
    if both:
        fail("--both: this kinematics has one pose")
    return poses_of_step(kin, names, program=rows, tool_length=tool_length, near=near)


def _tool(
    tip: list[str] | None, direction: tuple[float, float, float] | None
) -> tuple[Array, Array]:
    """Tip (1, 3) and direction (1, 3) of the options."""
    import numpy as np

    if tip is None or direction is None:
        fail("--tip and --direction belong together: --tip X=1 Y=2 Z=3 --direction 0 0 1")
    named = read_words(tip, "XYZ", "--tip")
    if len(named) < 3:
        fail("--tip: write all of X, Y and Z")
    if not np.isfinite(direction).all() or not any(direction):
        fail("--direction: write a vector other than 0 0 0")
    return np.array([[named[c] for c in "XYZ"]]), np.array([direction])


def _one_source(several: bool) -> None:
    if several:
        fail("give one of words, --tip with --direction, and --poses")


def _write(shape: str, asked: KinOptions, kin: KinematicStep, found: Poses) -> None:
    from ncscope.kinematics import UniversalKinematics, explain_status
    from ncscope.views import poses as view

    def explain(status: int) -> tuple[str, str]:
        if isinstance(kin, UniversalKinematics):
            return explain_status(kin, status)
        return "N2602", "the kinematics has no solution for this position"

    failed = int((found.status != 0).sum())
    if shape == "table":
        terminal = console()
        kind = kin.name
        if isinstance(kin, UniversalKinematics):
            kind = f"{'RTCP' if kin.rtcp else 'complete transformation'}, mode {kin.mode}"
        terminal.print(f"kinematics {kin.id}, {kind}, tool length {asked.tool_length:g} mm")
        terminal.print(view.poses_table(found, explain))
    else:
        _write_file(shape, asked.out, found, explain)
    if failed and (shape != "jsonl" or asked.out is not None):
        typer.echo(f"{failed} of {len(found)} poses have no solution", err=True)
    raise typer.Exit(1 if failed else 0)


def _write_file(shape: str, out: Path | None, found: Poses, explain: Explain) -> None:
    from ncscope.views import poses as view

    if shape == "parquet" and out is not None:
        need_parquet()
        with writing(out):
            view.write_poses_parquet(out, found, explain)
        return
    write = {"csv": view.write_poses_csv, "jsonl": view.write_poses_jsonl}[shape]
    with text_output(out) as stream:
        write(stream, found, explain)
