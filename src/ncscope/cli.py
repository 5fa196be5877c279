"""The command line: arguments to API to views, nothing else.

Exit codes: 0 the program ran, 1 it ended with an error, 2 the command was used wrongly.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from ncscope import __version__

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from rich.console import Console

    from ncscope.diagnostics import Diagnostic
    from ncscope.execution import Program
    from ncscope.machine import Machine
    from ncscope.trajectory import Trajectory

LONG_PROGRAM = 200_000
"""Characters from which a run shows its progress."""

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Where will my machine go, and why? Runs NC programs of the ISG-kernel dialect offline.",
)


class Format(StrEnum):
    """How a run is written."""

    TABLE = "table"
    JSONL = "jsonl"
    CSV = "csv"


class ExplainFormat(StrEnum):
    """How an explanation is written."""

    TEXT = "text"
    JSON = "json"


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


MachineOption = Annotated[
    Path | None,
    typer.Option("--machine", "-m", help="Folder of lists, start-up list, or one list."),
]
ClampOption = Annotated[
    int | None, typer.Option("--clamp", help="Clamp position handed over at program start.")
]
SkipOption = Annotated[
    str, typer.Option("--skip", help="Skip levels that are on, for example 1,3; / is level 1.")
]


@app.command("run")
def run_command(
    program: Annotated[Path, typer.Argument(help="NC program.")],
    machine: MachineOption = None,
    format: Annotated[Format | None, typer.Option("--format", help="table, jsonl or csv.")] = None,
    out: Annotated[Path | None, typer.Option("--out", help="File instead of the screen.")] = None,
    messages: Annotated[
        Path, typer.Option("--messages", help="Folder for the files of #MSG SAVE.")
    ] = Path("."),
    clamp: ClampOption = None,
    skip: SkipOption = "",
    max_blocks: Annotated[
        int, typer.Option("--max-blocks", min=0, help="Stop after so many blocks; 0: no limit.")
    ] = 0,
    strict: Annotated[bool, typer.Option("--strict", help="A warning stops the run.")] = False,
) -> None:
    """Run an NC program and show where the tool and every axis go."""
    from ncscope.execution import Options
    from ncscope.views.message_files import write_messages

    shape = _format(format, out)
    if out is not None and out.exists() and program.exists() and out.samefile(program):
        _fail(f"--out {out} is the program itself")
    options = Options(clamp, _levels(skip), max_blocks, strict)
    result, found, _ = _run(program, machine, options, strict)
    found = [d for d in found if d.severity != "note"]
    errors = write_messages(messages, result.messages, (program,))
    ok = result.ok and not any(d.is_error for d in (*found, *errors))
    if shape is Format.TABLE:
        _show_diagnostics([*found, *result.diagnostics, *errors])
        _show_run(result, ok)
    else:
        _write(shape, out, result, [*found, *errors], ok)
    raise typer.Exit(0 if ok else 1)


@app.command("explain")
def explain_command(
    place: Annotated[str, typer.Argument(metavar="PROGRAM:LINE", help="Or PROGRAM:N40.")],
    machine: MachineOption = None,
    format: Annotated[
        ExplainFormat, typer.Option("--format", help="text or json.")
    ] = ExplainFormat.TEXT,
    clamp: ClampOption = None,
    skip: SkipOption = "",
) -> None:
    """Take the axis positions of one block apart, each part with the line that set it."""
    import json

    from ncscope.execution import Options
    from ncscope.views.table import explain_table

    path, line, number = _place(place)
    result, found, source = _run(path, machine, Options(clamp, _levels(skip)))
    try:
        if number is not None:
            line = result.line_of_block(number)
        explanation = result.explain(line=line)
    except KeyError as error:
        _show_diagnostics(d for d in [*found, *result.diagnostics] if d.is_error)
        _fail(str(error.args[0]), code=1)
    if format is ExplainFormat.JSON:
        typer.echo(json.dumps(explanation.as_dict(), ensure_ascii=False, indent=1))
        return
    console = _console()
    console.print(f"{explanation.file}:{line}  {source.source.line_text(line)}", markup=False)
    console.print(explain_table(explanation))


@app.command("check")
def check_command(
    paths: Annotated[list[Path], typer.Argument(help="Lists, folders of lists, programs.")],
    machine: MachineOption = None,
    strict: Annotated[bool, typer.Option("--strict", help="A warning counts as an error.")] = False,
) -> None:
    """Check lists and programs; exit code 1 on errors."""
    from ncscope.lists import check_lists

    found: list[Diagnostic] = []
    for path in paths:
        if not path.exists():
            _fail(f"{path} does not exist")
        if path.is_dir() or path.suffix.lower() == ".lis":
            found.extend(check_lists(path))
        else:
            from ncscope.execution import Options

            result, more, _ = _run(path, machine, Options(max_blocks=1_000_000))
            found.extend([*(d for d in more if d.severity != "note"), *result.diagnostics])
    _show_diagnostics(found)
    counts = {s: sum(d.severity == s for d in found) for s in ("error", "warning", "note")}
    typer.echo(", ".join(f"{n} {s}{'' if n == 1 else 's'}" for s, n in counts.items()))
    raise typer.Exit(1 if counts["error"] or (strict and counts["warning"]) else 0)


# --- parts -------------------------------------------------------------------------------------


def _run(
    path: Path, machine_path: Path | None, options, strict: bool = False
) -> tuple[Trajectory, list[Diagnostic], Program]:
    from dataclasses import replace

    from ncscope.execution import run
    from ncscope.loading import load_program, subprogram_loader
    from ncscope.trajectory import Trajectory

    machine, found = _machine(machine_path)
    if options.clamp is not None and options.clamp not in machine.clamp_positions:
        has = ", ".join(str(i) for i in sorted(machine.clamp_positions)) or "none"
        _fail(f"clamp position {options.clamp} does not exist; the lists have: {has}")
    try:
        program = load_program(path)
    except OSError as error:
        _fail(f"cannot read {path}: {error.strerror}")
    if any(d.is_error for d in found):  # on the wrong machine every number would be wrong
        return Trajectory((), machine.axis_names, ok=False), found, program
    options = replace(options, load=subprogram_loader([path.parent]))
    with _progress(len(program.source.text)) as progress:
        result = run(machine, program, options, progress)
    return result, found, program


def _machine(path: Path | None) -> tuple[Machine, list[Diagnostic]]:
    if path is None:
        from ncscope.machine import Machine

        return Machine(), []
    if not path.exists():
        _fail(f"machine {path} does not exist")
    from ncscope.lists import load_machine

    machine, found = load_machine(path)
    return machine, list(found)


def _place(text: str) -> tuple[Path, int, int | None]:
    name, _, where = text.rpartition(":")
    number = where[1:] if where[:1] in ("N", "n") else None
    if not name or not (number or where).isdigit():
        _fail(f"{text}: write PROGRAM:LINE or PROGRAM:N40")
    return Path(name), 0 if number else int(where), int(number) if number else None


def _levels(text: str) -> frozenset[int]:
    try:
        levels = frozenset(int(part) for part in text.split(",") if part.strip())
    except ValueError:
        _fail(f"--skip {text}: write levels from 1 to 10 with commas between them")
    if not all(1 <= level <= 10 for level in levels):
        _fail(f"--skip {text}: levels are 1 to 10")
    return levels


def _format(format: Format | None, out: Path | None) -> Format:
    shape = format or Format.TABLE
    if out is not None and format is None and out.suffix in (".csv", ".jsonl"):
        shape = Format(out.suffix[1:])
    if out is not None and shape is Format.TABLE:
        _fail("--out writes csv or jsonl: give --format csv or --format jsonl")
    return shape


def _write(
    shape: Format,
    out: Path | None,
    result: Trajectory,
    found: list[Diagnostic],
    ok: bool,
) -> None:
    from ncscope.views.records import write_csv, write_jsonl

    def write(stream) -> None:
        if shape is Format.JSONL:
            write_jsonl(stream, result, found, ok)
        else:
            write_csv(stream, result)

    if shape is Format.CSV:
        _show_diagnostics([*found, *result.diagnostics])
    if out is None:
        write(sys.stdout)
        return
    try:
        with out.open("w", encoding="utf-8", newline="") as stream:
            write(stream)
    except OSError as error:
        _fail(f"cannot write {out}: {error.strerror}")


def _show_run(result: Trajectory, ok: bool) -> None:
    from ncscope.views.table import run_table

    console = _console()
    if len(result):
        console.print(run_table(result))
    for message in result.messages:
        console.print(f"message  {message.text}", markup=False, highlight=False)
    status = "ok" if ok else "stopped by an error"
    console.print(f"{len(result)} moves, {status}", style="green" if ok else "red")


def _show_diagnostics(items: Iterable[Diagnostic]) -> None:
    from ncscope.diagnostics import render

    colours = {"error": "red", "warning": "yellow", "note": "cyan"}
    console = _console(stderr=True)
    for item in items:
        console.print(
            render(item), style=colours[str(item.severity)], markup=False, highlight=False,
            soft_wrap=True,
        )  # fmt: skip


def _console(stderr: bool = False) -> Console:
    """Colours on a terminal; in a pipe plain text of any width."""
    from rich.console import Console

    stream = sys.stderr if stderr else sys.stdout
    width = None if stream.isatty() else 200
    return Console(stderr=stderr, width=width, highlight=False)


@contextmanager
def _progress(total: int) -> Iterator[Callable[[int], None] | None]:
    """A progress bar on standard error for long programs, when that is a terminal."""
    if total < LONG_PROGRAM or not sys.stderr.isatty():
        yield None
        return
    from rich.progress import Progress

    with Progress(console=_console(stderr=True), transient=True) as bar:
        task = bar.add_task("running", total=total)
        yield lambda offset: bar.update(task, completed=offset)


def _fail(message: str, code: int = 2) -> NoReturn:
    typer.echo(f"ncscope: {message}", err=True)
    raise typer.Exit(code)


def main() -> None:
    """Entry point; a broken pipe or Ctrl-C ends without a traceback."""
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(130)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)


if __name__ == "__main__":
    main()
