"""The kinematics that a command works with, from --machine and --id."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import typer

from ncscope.cli.inputs import read_machine
from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from ncscope.kinematics import UniversalKinematics
    from ncscope.machine import Machine

UNIVERSAL = 91


def chosen_kinematics(path: Path | None, id: int | None) -> UniversalKinematics:
    """The kinematics of a machine; ends the process with what is wrong when there is none."""
    from ncscope.kinematics import KinematicsError, UniversalKinematics

    if path is None:
        fail("which machine? give --machine with its folder of lists")
    machine, found = read_machine(path)
    show_diagnostics(d for d in found if d.severity != "note")
    if any(d.is_error for d in found):
        raise typer.Exit(1)
    id = _id(machine, path, id)
    try:
        kinematics = machine.kinematics[id]
    except KinematicsError as error:
        _explain(path, id, error)
    if not isinstance(kinematics, UniversalKinematics):
        fail(f"kinematics {id} is not of type 91, the universal kinematics")
    return kinematics


def _id(machine: Machine, path: Path, id: int | None) -> int:
    known = sorted(machine.kinematic_parameters)
    if not known:
        fail(f"the lists of {path} configure no kinematics")
    default = machine.settings.default_kinematic_id
    for candidate in (id,) if id is not None else (default, UNIVERSAL, *known[:1]):
        if candidate in known:
            return candidate
    fail(f"kinematics {id} is not configured; {path} has {', '.join(map(str, known))}")


def _explain(path: Path, id: int, error: Exception) -> NoReturn:
    """What `check` says about this kinematics, with the lines of the list."""
    from ncscope.lists import check_lists

    faults = [d for d in check_lists(path) if d.id == "N3009"]
    show_diagnostics(faults)
    fail(f"kinematics {id} cannot be used: {error}", code=1)
