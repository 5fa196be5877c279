"""The state at program start (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.commands.transformation_stack import activate_at_start
from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.external_variables import External, external_variables
from ncscope.channel.given import GivenRows
from ncscope.channel.modulo import modulo_axes
from ncscope.channel.selection import activate
from ncscope.channel.state import (
    Kinematics,
    LengthAxis,
    Measuring,
    Position,
    State,
    SystemMode,
)
from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Span
from ncscope.machine import Machine, OffsetRecord


def start_state(
    machine: Machine,
    clamp_index: int | None = None,
    probe: GivenRows | None = None,
    external: External | None = None,
    manual: GivenRows | None = None,
) -> State:
    """The state at program start: all axes at 0, default zero offset, clamp offset if chosen.

    probe: the answers of the probe, a row for each measuring run. manual: jog increments, a row
    for each G200 and G201.
    external: values of V.E variables, see `external_variables`.
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
        variables=external_variables(machine, external or {}),
        macros=machine.settings.macros,
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


def with_stack(machine: Machine, state: State) -> tuple[State, tuple[Diagnostic, ...]]:
    """The start state under the transformation stack of P-CHAN-00757, and what is wrong with it."""
    start = machine.stack_at_start
    if start is None:
        return state, ()
    draft = Draft(machine, state, start.span)
    try:
        activate_at_start(draft, start.span, machine.stacks[start.name])
    except BlockError as error:
        return state, (error.diagnostic,)
    return draft.state, tuple(draft.diagnostics)
