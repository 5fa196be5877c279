"""The state at program start (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.commands.transformation_stack import activate_at_start
from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.given import GivenRows
from ncscope.channel.modulo import modulo_axes
from ncscope.channel.selection import activate
from ncscope.channel.state import (
    Kinematics,
    LengthAxis,
    Measuring,
    Position,
    State,
    Stored,
    SystemMode,
)
from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Span
from ncscope.machine import Machine, OffsetRecord

EXTERNAL_NAME = re.compile(r"V\.E\.([^\s\[\]=]+)(?:\[(\d{1,6})\])?")


def start_state(
    machine: Machine,
    clamp_index: int | None = None,
    probe: GivenRows | None = None,
    external: Mapping[str, float | str] | None = None,
    manual: GivenRows | None = None,
) -> State:
    """The state at program start: all axes at 0, default zero offset, clamp offset if chosen.

    probe: the answers of the probe, a row for each measuring run. manual: jog increments, a row
    for each G200 and G201.
    external: values of V.E variables, as `V.E.NAME` or `V.E.NAME[2]`.
    Raises KeyError when the machine has no clamp position with this index, or no V.E element.
    """
    n = len(machine.axes)
    zeros = np.zeros(n)
    state = State(
        axes=machine.axes,
        coordinates=Coordinates(n, modulo=modulo_axes(machine.axes)),
        position=Position(zeros, zeros),
        kinematics=_kinematics(machine),
        zero_offsets=machine.zero_offsets,
        tools=machine.tools,
        measuring=Measuring(machine.settings.measuring_type, machine.settings.probe_must_answer),
        probe=probe,
        stacks=machine.stacks,
        system_mode=SystemMode(per_level=machine.settings.offsets_per_level),
        manual=manual,
        length_axis=LengthAxis(2, 1.0) if machine.settings.tool_length_stays else None,
        variables=_external(machine, external or {}),
    )
    if clamp_index is not None:
        record: OffsetRecord = machine.clamp_positions[clamp_index]
        state = offsets.select_clamp(state, clamp_index, record)
    return offsets.select_zero(state, machine.zero_offsets.default_index, "program start")


def switch_on(machine: Machine, state: State, span: Span) -> tuple[State, tuple[Diagnostic, ...]]:
    """The default kinematics switched on at program start where P-CHAN-00151 says so."""
    ids = state.kinematics.ids
    wanted = machine.settings.transformation_at_start and ids[0]
    if not wanted or state.coordinates.kinematics is not None:
        return state, ()
    draft = Draft(machine, state, "program start")
    try:
        activate(draft, span, ids)
    except BlockError as error:
        return state, (*draft.diagnostics, error.diagnostic)
    return draft.state, tuple(draft.diagnostics)


def _kinematics(machine: Machine) -> Kinematics:
    """The data sets of the lists with the default ids (P-CHAN-00032, -00264, -00854)."""
    settings = machine.settings
    return Kinematics(
        machine.kinematic_parameters,
        ids=(settings.default_kinematic_id, settings.default_second_id),
        second=machine.second_step_parameters,
        program=machine.program_step_parameters,
        program_id=settings.default_program_step_id,
    )


def _external(machine: Machine, values: Mapping[str, float | str]) -> dict[str, Stored]:
    """The V.E variables: declared ones start at 0 or empty, a value that is set declares too."""
    variables: dict[str, Stored] = {}
    for name, row in machine.external.items():
        start: float | str = "" if row.type == "STRING" else 0.0
        dimensions = (row.elements,) if row.elements else ()
        value = (start,) * row.elements if row.elements else start
        variables[f"V.E.{name}"] = Stored(value, dimensions, row.type, row.length)
    for text, value in values.items():
        match = EXTERNAL_NAME.fullmatch(text)
        if match is None:
            raise KeyError(f"{text} is no external variable: write V.E.NAME")
        name, index = f"V.E.{match.group(1)}", match.group(2)
        variables[name] = _with_value(variables.get(name), name, index, value)
    return variables


def _with_value(old: Stored | None, name: str, index: str | None, value: float | str) -> Stored:
    if old is None and index is None:
        return Stored(value, type="STRING" if isinstance(value, str) else "REAL64")
    if old is None or bool(old.dimensions) != (index is not None):
        raise KeyError(f"{name} is {'an array' if old and old.dimensions else 'no array'}")
    if isinstance(value, str) != (old.type == "STRING"):
        raise KeyError(f"{name} is of type {old.type}")
    if index is None or not isinstance(old.value, tuple):
        return replace(old, value=value)
    if int(index) >= len(old.value):
        raise KeyError(f"{name} has the elements 0 to {len(old.value) - 1}")
    items = list(old.value)
    items[int(index)] = value
    return replace(old, value=tuple(items))


def with_stack(machine: Machine, state: State) -> tuple[State, tuple[Diagnostic, ...]]:
    """The start state under the transformation stack of P-CHAN-00757, and what is wrong with it."""
    start = machine.stack_at_start
    if start is None:
        return state, ()
    draft = Draft(machine, state, start.span.place)
    try:
        activate_at_start(draft, start.span, machine.stacks[start.name])
    except BlockError as error:
        return state, (error.diagnostic,)
    return draft.state, tuple(draft.diagnostics)
