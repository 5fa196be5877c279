"""The command line: arguments to API to views, nothing else.

One module per command; `options`, `inputs`, `files` and `screen` hold what they share,
`ending` is how the process ends.
Exit codes: 0 the program ran, 1 it ended with an error, 2 the command was used wrongly.
"""

from __future__ import annotations

from typing import Annotated, NoReturn

import typer

from ncscope import __version__
from ncscope.cli.check import check_command
from ncscope.cli.convert import convert_command
from ncscope.cli.ending import end_with
from ncscope.cli.explain import explain_command
from ncscope.cli.kin import kin_app
from ncscope.cli.plot import plot_command
from ncscope.cli.report import report_command
from ncscope.cli.run import run_command
from ncscope.cli.screen import announce_compiling
from ncscope.cli.where import where_command
from ncscope.cli.workbench import workbench_command

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Where will my machine go, and why? Runs NC programs of the ISG-kernel dialect offline.",
)
app.command("run")(run_command)
app.command("explain")(explain_command)
app.command("where")(where_command)
app.command("check")(check_command)
app.command("convert")(convert_command)
app.add_typer(kin_app, name="kin")
app.command("workbench")(workbench_command)
app.command("plot")(plot_command)
app.command("report")(report_command)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"ncscope {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Options of ncscope itself."""


def main() -> NoReturn:
    """Entry point; a broken pipe, a full disk or Ctrl-C end without a traceback."""
    announce_compiling()
    end_with(app)
