"""Machine and program from the paths of the command line, and the run of both."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ncscope.cli.files import exists, reading
from ncscope.cli.options import AnswerOptions, MachineOptions, StartOptions, read_levels
from ncscope.cli.screen import fail, progress_bar
from ncscope.cli.settings import Values, read_settings, typed_settings

if TYPE_CHECKING:
    from ncscope.channel.given import GivenRows
    from ncscope.diagnostics import Diagnostic, Source
    from ncscope.machine import Machine
    from ncscope.program import Options, Program, Sink
    from ncscope.trajectory import Trajectory


@dataclass(frozen=True)
class Inputs:
    """A machine and a program, ready to run; found: what its files have wrong."""

    machine: Machine
    found: list[Diagnostic]
    program: Program
    options: Options

    @property
    def faults(self) -> list[Diagnostic]:
        """The errors and warnings of the files."""
        return [d for d in self.found if d.severity != "note"]

    @property
    def usable(self) -> bool:
        """False where the lists have errors: on the wrong machine every number is wrong."""
        return not any(d.is_error for d in self.found)

    def run(self, sink: Sink | None = None) -> Trajectory:
        """The run, with a progress bar for a long program."""
        from ncscope.execution import run
        from ncscope.trajectory import Trajectory

        if not self.usable:
            return Trajectory((), self.machine.axis_names, ok=False)
        with progress_bar(len(self.program.source)) as progress:
            return run(self.machine, self.program, self.options, progress, sink)


def read_inputs(
    path: Path,
    setup: MachineOptions,
    start: StartOptions,
    answers: AnswerOptions,
    *,
    max_blocks: int = 0,
    strict: bool = False,
    sample: float | None = None,
) -> Inputs:
    """Machine, program and options; ends the process when a file or an option cannot be read."""
    from ncscope.loading import load_program, subprogram_loader
    from ncscope.program import Options

    skip, values = read_levels(start.skip), read_settings(answers.values)
    machine, found = read_machine(setup.machine, setup.kinematics)
    _check_clamp(machine, start.clamp)
    external = _checked_values(machine, values)
    with reading(path):
        program = load_program(path)
    folders = [path.parent, *_folders(answers.folders)]
    options = Options(
        clamp=start.clamp,
        skip=skip,
        max_blocks=max_blocks,
        strict=strict,
        load=subprogram_loader(folders, machine.settings.search_paths),
        external=external,
        sample=sample,
        probe=_read_rows(answers.probe, found),
        manual=_read_rows(answers.manual, found),
    )
    return Inputs(machine, found, program, options)


def _folders(paths: list[Path] | None) -> list[Path]:
    """The folders of --subprograms; ends the process for what is none."""
    for path in paths or ():
        if not exists(path):
            fail(f"--subprograms {path}: there is no such folder")
        if not path.is_dir():
            fail(f"--subprograms {path}: it is no folder; give the folder of the file")
    return paths or []


def _check_clamp(machine: Machine, clamp: int | None) -> None:
    if clamp is not None and clamp not in machine.clamp_positions:
        has = ", ".join(str(i) for i in sorted(machine.clamp_positions)) or "none"
        fail(f"clamp position {clamp} does not exist; the lists have: {has}")


def _checked_values(machine: Machine, values: Values) -> Values:
    """The values of --set as the machine declares their variables."""
    from ncscope.channel.start import start_state

    values = typed_settings(machine, values)
    try:
        start_state(machine, external=values)
    except KeyError as error:
        fail(f"--set: {error.args[0]}")
    return values


def _read_rows(path: Path | None, found: list[Diagnostic]) -> GivenRows | None:
    from ncscope.loading import load_rows

    if path is None:
        return None
    with reading(path):
        rows, problems = load_rows(path)
    found.extend(problems)
    return rows


def read_machine(
    path: Path | None, kinematics: Path | None = None
) -> tuple[Machine, list[Diagnostic]]:
    """The machine with the user's kinematics, and what lists and classes have wrong."""
    from ncscope.machine import Machine

    machine, found = Machine(), []
    if path is not None:
        from ncscope.lists import load_machine

        if not exists(path):
            fail(f"machine {path} does not exist")
        machine, problems = load_machine(path)
        found = list(problems)
    if kinematics is None and not machine.kinematic_ids_of_user:
        return machine, found
    from ncscope.loading.user_kinematics import with_user_kinematics

    with reading(kinematics):
        machine, problems = with_user_kinematics(machine, kinematics)
    return machine, [*found, *problems]


def pole_note(result: Trajectory, source: Source) -> tuple[Diagnostic, ...]:
    """N4104 at the move whose end is nearest to the singular direction; nothing without one."""
    from ncscope.diagnostics import Span, diagnostic

    if result.nearest_to_pole is None:
        return ()
    distance, (file, line) = result.nearest_to_pole
    span, where = None, f" ({file}:{line})"
    if file == source.name:
        start = source.line_start(line)
        span, where = Span(source, start, start + len(source.line_text(line))), ""
    message = f"the tool comes nearest to its singular direction here: {distance:.4f} degrees"
    return (diagnostic("N4104", span, message + where),)
