"""What goes to the terminal: colours there, plain text in a pipe, progress, and the last word."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

import typer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from rich.console import Console
    from rich.segment import Segment
    from rich.table import Table

    from ncscope.diagnostics import Diagnostic

LONG_PROGRAM = 200_000
"""Characters from which a run shows its progress."""
SHOWN_TOGETHER = 500
"""Diagnostics that are printed in one go; one at a time takes ten times as long."""
SHOWN_EVERY = 1000
"""Blocks between two looks at the progress."""


def show_diagnostics(items: Iterable[Diagnostic]) -> None:
    """Diagnostics with their place on standard error."""
    items = tuple(items)
    if not items:  # rich is not loaded for nothing
        return
    from rich.segment import Segments

    terminal = console(stderr=True)
    for first in range(0, len(items), SHOWN_TOGETHER):
        lines = _coloured(items[first : first + SHOWN_TOGETHER])
        terminal.print(Segments(lines, new_lines=True), soft_wrap=True)


def _coloured(items: Iterable[Diagnostic]) -> list[Segment]:
    """The lines of diagnostics, each in the colour of its severity; nothing in them is markup."""
    from rich.control import strip_control_codes
    from rich.segment import Segment
    from rich.style import Style

    from ncscope.diagnostics import render

    colours = {"error": "red", "warning": "yellow", "note": "cyan"}
    styles = {severity: Style(color=colour) for severity, colour in colours.items()}
    return [
        Segment(line, styles[str(item.severity)])
        for item in items
        for line in strip_control_codes(render(item)).expandtabs().split("\n")
    ]


def console(stderr: bool = False) -> Console:
    """Colours on a terminal; in a pipe plain text of any width."""
    from rich.console import Console

    stream = sys.stderr if stderr else sys.stdout
    width = None if stream.isatty() else 200
    return Console(stderr=stderr, width=width, highlight=False, emoji=False)  # a.nc:100:3 is text


def show_table(table: Table) -> None:
    """A table in its whole width: a number that is cut off would be a wrong number."""
    from rich.measure import Measurement

    terminal = console()
    wide = Measurement.get(terminal, terminal.options.update(width=1000), table).maximum
    terminal.width = max(terminal.width, wide)
    terminal.print(table)


@contextmanager
def progress_bar(total: int) -> Iterator[Callable[[int, int], None] | None]:
    """Blocks, blocks a second and time left of a long program, on a terminal only."""
    if total < LONG_PROGRAM or not sys.stderr.isatty():
        yield None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.fields[blocks]:,} blocks"),
        BarColumn(),
        TextColumn("{task.fields[rate]:,.0f} blocks/s"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console(stderr=True), transient=True) as bar:
        task = bar.add_task("run", total=total, blocks=0, rate=0.0)
        shown = 0

        def show(offset: int, blocks: int) -> None:
            nonlocal shown
            if blocks - shown < SHOWN_EVERY:
                return
            shown = blocks
            rate = blocks / max(bar.tasks[0].elapsed or 0.0, 1e-3)
            bar.update(task, completed=offset, blocks=blocks, rate=rate)

        yield show


def announce_compiling() -> None:
    """Says once, on a terminal, why the first run on a machine takes some seconds longer."""
    from ncscope.compilation import when_compiling

    def say() -> None:
        when_compiling(None)
        typer.echo("compiling the inner loops, once on this machine ...", err=True)

    if sys.stderr.isatty():
        when_compiling(say)


def fail(message: str, code: int = 2) -> NoReturn:
    """Ends the process with a message on standard error."""
    typer.echo(f"ncscope: {message}", err=True)
    raise typer.Exit(code)
