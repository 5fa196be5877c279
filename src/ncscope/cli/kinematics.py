"""The kinematics that a command works with, from --machine and --id."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import typer

from ncscope.cli.inputs import read_machine
from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from ncscope.kinematics import KinematicsError, KinematicStep, UniversalKinematics
    from ncscope.machine import Machine

UNIVERSAL = 91


def universal_kinematics(path: Path | None, id: int | None) -> UniversalKinematics:
    """`chosen_kinematics` that has to be of type 91."""
    from ncscope.kinematics import UniversalKinematics

    kinematics, _ = chosen_kinematics(path, id)
    if not isinstance(kinematics, UniversalKinematics):
        fail(f"kinematics {kinematics.id} is not of type 91, the universal kinematics")
    return kinematics


@contextmanager
def computing() -> Iterator[None]:
    """Ends the process where the kinematics cannot do what is asked inside."""
    from ncscope.kinematics import KinematicsError

    try:
        yield
    except KinematicsError as error:
        fail(f"{error.id}: {error.message}", code=1)


def chosen_kinematics(
    path: Path | None, id: int | None, own: Path | None = None
) -> tuple[KinematicStep, tuple[str, ...]]:
    """The kinematics of a machine and the axis names of its channel; ends the process with what
    is wrong when there is none. own: file with kinematics of the user."""
    from ncscope.kinematics import KinematicsError

    if path is None:
        fail("which machine? give --machine with its folder of lists")
    machine, found = read_machine(path, own)
    show_diagnostics(d for d in found if d.severity != "note")
    if any(d.is_error for d in found):
        raise typer.Exit(1)
    id = chosen_id(machine, path, id)
    try:
        return kinematics_of_any_step(machine, id), machine.axis_names
    except KinematicsError as error:
        _explain(path, id, error)


def chosen_id(machine: Machine, path: Path, id: int | None) -> int:
    """The id of --id, else the default of the lists, else 91, else the first one; ends the
    process when there is none."""
    known = sorted({**machine.second_step_parameters, **machine.kinematic_parameters})
    if not known:
        fail(f"the lists of {path} configure no kinematics")
    default = machine.settings.default_kinematic_id
    first = sorted(machine.kinematic_parameters)
    for candidate in (default, UNIVERSAL, *first, *known) if id is None else (id,):
        if candidate in known:
            return candidate
    fail(f"kinematics {id} is not configured; {path} has {', '.join(map(str, known))}")


def kinematics_of_any_step(machine: Machine, id: int) -> KinematicStep:
    """The kinematics of the first step with this id, else that of the second. Raises
    KinematicsError for parameters that describe none."""
    if id not in machine.kinematic_parameters:
        machine = replace(machine, kinematic_parameters=machine.second_step_parameters)
    return machine.kinematics[id]


def _explain(path: Path, id: int, error: KinematicsError) -> NoReturn:
    """What `check` says about this kinematics, with the lines of the list."""
    from ncscope.lists import check_lists

    faults = [d for d in check_lists(path) if d.id == "N3009"]
    show_diagnostics(faults)
    hint = f"; {error.hint}" if error.hint and not faults else ""
    fail(f"kinematics {id} cannot be used: {error}{hint}", code=1)
