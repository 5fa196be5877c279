"""The state at program start (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.given import GivenRows
from ncscope.channel.state import Kinematics, LengthAxis, Measuring, Position, State
from ncscope.coordinates import Coordinates
from ncscope.machine import Machine, OffsetRecord


def start_state(
    machine: Machine, clamp_index: int | None = None, probe: GivenRows | None = None
) -> State:
    """The state at program start: all axes at 0, default zero offset, clamp offset if chosen.

    probe: the answers of the probe, a row for each measuring run.
    Raises KeyError when the machine has no clamp position with this index.
    """
    n = len(machine.axes)
    zeros = np.zeros(n)
    state = State(
        axes=machine.axes,
        coordinates=Coordinates(n),
        position=Position(zeros, zeros),
        kinematics=_kinematics(machine),
        zero_offsets=machine.zero_offsets,
        tools=machine.tools,
        measuring=Measuring(machine.settings.measuring_type, machine.settings.probe_must_answer),
        probe=probe,
        length_axis=LengthAxis(2, 1.0) if machine.settings.tool_length_stays else None,
    )
    if clamp_index is not None:
        record: OffsetRecord = machine.clamp_positions[clamp_index]
        state = offsets.select_clamp(state, clamp_index, record)
    return offsets.select_zero(state, machine.zero_offsets.default_index, "program start")


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
