"""`ncscope kin compare`: two machines for the same programmed poses."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.files import text_output
from ncscope.cli.groups import with_groups
from ncscope.cli.kin_options import KinOptions, PosesOption, output_form
from ncscope.cli.kinematics import computing, universal_kinematics
from ncscope.cli.pose_input import grid_rows, poses_file
from ncscope.cli.screen import console, fail

if TYPE_CHECKING:
    from ncscope.frames import Array
    from ncscope.kinematics.comparison import Comparison


@with_groups
def compare_command(
    first: Annotated[Path, typer.Argument(metavar="A", help="Machine of the control's data set.")],
    second: Annotated[Path, typer.Argument(metavar="B", help="The real, measured machine.")],
    poses: PosesOption = None,
    grid: Annotated[
        list[str] | None,
        typer.Option("--grid", metavar="X=-100:100:5 ..", help="FROM:TO:COUNT or one value."),
    ] = None,
    rows: Annotated[bool, typer.Option("--rows", help="Every pose, not only the worst.")] = False,
    *,
    asked: KinOptions,
) -> None:
    """How far machine B is from A at the tool tip and per axis, before and after compensation."""
    from ncscope.kinematics.comparison import compare

    shape = output_form(asked, poses)
    if shape == "parquet":
        fail("kin compare writes csv or jsonl")
    if poses is not None and grid:
        fail("give one of --poses and --grid")
    if poses is None and not grid:
        fail("which poses? give --poses FILE, or --grid X=-100:100:5 C=-180:180:7 ..")
    a, b = universal_kinematics(first, asked.id), universal_kinematics(second, asked.id)
    program = _rows(poses, grid, a.axis_names)
    with computing():
        item = compare(a, b, program, asked.tool_length)
    _write(shape, asked.out, item, rows)
    _say_unsolved(item)


def _rows(poses: Path | None, grid: list[str] | None, names: tuple[str, ...]) -> Array:
    """Programmed values (n_poses, n_channel), mm and degrees."""
    if poses is not None:
        return poses_file(poses).rows(names, "pcs_")
    return grid_rows(grid or (), names)


def _write(shape: str, out: Path | None, item: Comparison, rows: bool) -> None:
    from ncscope.views import comparison as view

    if shape == "table":
        terminal = console()
        if rows:
            terminal.print(view.differences_table(item))
        terminal.print(view.comparison_table(item))
        return
    with text_output(out) as stream:
        if shape == "csv":
            view.write_comparison_csv(stream, item)
        else:
            view.write_comparison_jsonl(stream, item, rows)


def _say_unsolved(item: Comparison) -> None:
    import numpy as np

    missing = int(np.isnan(item.axes).any(axis=1).sum())
    if missing:
        typer.echo(f"{missing} of {len(item)} poses have no solution on one machine", err=True)
        raise typer.Exit(1)
