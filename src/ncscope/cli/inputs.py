"""Machine and program from the paths of the command line, and the run of both."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ncscope.cli.screen import fail, progress_bar
from ncscope.cli.settings import typed_settings

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    machine_path: Path | None,
    options: Options,
    probe: Path | None = None,
    folders: Sequence[Path] = (),
    kinematics: Path | None = None,
    manual: Path | None = None,
) -> Inputs:
    """Machine, program and answers; ends the process when a file cannot be read."""
    from ncscope.channel.start import start_state
    from ncscope.loading import load_program, subprogram_loader

    machine, found = read_machine(machine_path, kinematics)
    if options.clamp is not None and options.clamp not in machine.clamp_positions:
        has = ", ".join(str(i) for i in sorted(machine.clamp_positions)) or "none"
        fail(f"clamp position {options.clamp} does not exist; the lists have: {has}")
    options = replace(options, external=typed_settings(machine, options.external))
    try:
        start_state(machine, external=options.external)
    except KeyError as error:
        fail(f"--set: {error.args[0]}")
    try:
        program = load_program(path)
    except OSError as error:
        fail(f"cannot read {path}: {error.strerror}")
    load = subprogram_loader([path.parent, *folders], machine.settings.search_paths)
    rows = _read_rows(probe, found), _read_rows(manual, found)
    options = replace(options, probe=rows[0], manual=rows[1], load=load)
    return Inputs(machine, found, program, options)


def run_program(
    path: Path,
    machine_path: Path | None,
    options: Options,
    probe: Path | None = None,
    folders: Sequence[Path] = (),
    kinematics: Path | None = None,
    manual: Path | None = None,
) -> tuple[Trajectory, list[Diagnostic], Program]:
    """The run of a program, what its files have wrong, and the program."""
    inputs = read_inputs(path, machine_path, options, probe, folders, kinematics, manual)
    return inputs.run(), inputs.found, inputs.program


def _read_rows(path: Path | None, found: list[Diagnostic]) -> GivenRows | None:
    from ncscope.loading import load_rows

    if path is None:
        return None
    try:
        rows, problems = load_rows(path)
    except OSError as error:
        fail(f"cannot read {path}: {error.strerror}")
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

        if not path.exists():
            fail(f"machine {path} does not exist")
        machine, problems = load_machine(path)
        found = list(problems)
    if kinematics is None and not machine.kinematic_ids_of_user:
        return machine, found
    from ncscope.loading.user_kinematics import with_user_kinematics

    try:
        machine, problems = with_user_kinematics(machine, kinematics)
    except OSError as error:
        fail(f"cannot read {kinematics}: {error.strerror}")
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
