"""Options that several commands share: one group of them is one parameter of the command."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import pytest
import typer
from typer.main import get_command
from typer.testing import CliRunner

from ncscope.cli import app
from ncscope.cli.groups import with_groups

SHARED = "--machine --kinematics --clamp --skip --probe --manual --set --subprograms"


@dataclass(frozen=True)
class Size:
    width: Annotated[int, typer.Option("--width", help="In mm.")] = 7
    names: Annotated[list[str] | None, typer.Option("--name", help="Any.")] = None


def toy() -> typer.Typer:
    made = typer.Typer(add_completion=False)

    @made.command()
    @with_groups
    def show(
        what: Annotated[str, typer.Argument()],
        *,
        before: Annotated[int, typer.Option("--before")] = 1,
        size: Size,
        after: Annotated[int, typer.Option("--after")] = 2,
    ) -> None:
        """Says what it was given."""
        typer.echo(f"{what} {before} {size.width} {size.names or '-'} {after}")

    return made


def test_a_group_takes_the_place_of_its_parameter() -> None:
    options = [name for p in get_command(toy()).params for name in p.opts]
    assert options == ["what", "--before", "--width", "--name", "--after"]


def test_the_command_gets_the_group_as_a_value() -> None:
    run = CliRunner().invoke
    assert run(toy(), ["it"]).output == "it 1 7 - 2\n"
    given = ["it", "--name", "a", "--width", "3", "--name", "b", "--after", "5"]
    assert run(toy(), given).output == "it 1 3 ['a', 'b'] 5\n"


@pytest.mark.parametrize("name", ["run", "explain", "where", "plot", "report"])
def test_every_command_that_runs_a_program_has_the_same_options(name: str) -> None:
    command = get_command(app).commands[name]  # type: ignore[attr-defined]
    options = [o for p in command.params for o in p.opts if o in SHARED.split()]
    assert options == SHARED.split()
