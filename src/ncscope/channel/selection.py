"""From kinematic ids to a kinematics in use: data set, tool parameters, faults, steps.

Used where a transformation is switched on and where a tool changes the one that is on.
Source: FCT-C27; TF5200 #KIN ID, multi-step transformations; P-TOOL-00009, P-TOOL-00011.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.state import PROGRAM_STEP
from ncscope.coordinates import ActiveKinematics
from ncscope.diagnostics import Span
from ncscope.kinematics.building import UNIVERSAL, build, type_of
from ncscope.kinematics.faults import Fault, validate
from ncscope.kinematics.parameters import FIELD_OF_INDEX, INDEX_OF_FIELD, KinematicParameters
from ncscope.kinematics.step import KinematicsError, KinematicStep, TwoSteps
from ncscope.language import tree
from ncscope.machine import Tool

SHIFT_PARAMETERS = frozenset(range(3, 6))
"""What tools are expected to change: zero_position (decision D-17)."""
STRUCTURE = frozenset(
    index
    for name, index in INDEX_OF_FIELD.items()
    if name.endswith(".type") or name.startswith("chain") or ("." not in name and "[" not in name)
)
"""Numbers that say what kind of machine it is; a tool cannot add to them."""


def activate(draft: Draft, span: Span, ids: tuple[int, int]) -> None:
    """The kinematics of these ids is on from now, in the pose of the axes (D-3)."""
    held = draft.state.kinematics
    if held.is_on and held.active == ids:
        return
    refuse_unmodelled(draft, span)
    model = kinematics_of(draft, span, ids)
    pose = model.pose_of(draft.state.position.axes)
    settings = draft.machine.settings
    active = ActiveKinematics(
        model,
        pose,
        draft.place,
        turns_direction=settings.direction_turns,
        rapid_straight=settings.rapid_straight,
        turns_in_plane=settings.direction_path >= 0,
    )
    draft.state = draft.state.changed(kinematics=replace(held, active=ids))
    draft.set_coordinates(replace(draft.state.coordinates, kinematics=active), span)


def refuse_unmodelled(draft: Draft, span: Span) -> None:
    """Fails for settings of the channel that would give other positions than those computed."""
    settings, tool = draft.machine.settings, draft.state.tool.record
    if settings.orientation_words.upper() != "ANGLE":
        what = f"ori.mode {settings.orientation_words} (P-CHAN-00177) is not supported"
        draft.fail("N2001", span, what, "with ori.mode ANGLE the words A, B, C are angles")
    if settings.tool_offsets_stay and any(tool.axis_offsets.get(axis) for axis in range(3)):
        what = "ax_offsets_with_active_kin 1 (P-CHAN-00851) is not supported"
        hint = "a tool with ax_versatz[0] to [2] is selected; param[3] to [5] shift it, too"
        draft.fail("N2001", span, what, hint)


def kinematics_of(draft: Draft, span: Span, ids: tuple[int, int]) -> KinematicStep:
    """The kinematics of the preselected ids, first step and second step (0: without)."""
    first = step_of(draft, span, 0, ids[0])
    if not ids[1]:
        return first
    if len(first.orientation) == 2:
        draft.fail(
            "N2001",
            span,
            f"kinematics {ids[0]} as first of two steps with angles in space (rtcp 0) "
            "is not supported",
            "two angle pairs mean one direction, so the second step would have no definite values",
        )
    return TwoSteps(first, step_of(draft, span, 1, ids[1]))


def evaluate_id(draft: Draft, expression: tree.Expression) -> int:
    """A kinematic id as a program writes it; fails for a fraction."""
    value = evaluate_number(draft, expression)
    if not value.is_integer():
        what = f"{value:g} is no kinematic id"
        draft.fail("N1005", expression.span, what, "ids are whole numbers, for example 91")
    return int(value)


def step_of(draft: Draft, span: Span, step: int, id: int) -> KinematicStep:
    """One step, with the parameters of the tool where it is the first."""
    return checked(draft, span, parameters_of(draft, span, step, id))


def checked(draft: Draft, span: Span, parameters: KinematicParameters) -> KinematicStep:
    """The kinematics of a data set; fails with its first fault and the lines to blame."""
    machine, names = draft.machine, draft.state.axis_names
    mode = machine.settings.orientation_mode
    if type_of(parameters) == UNIVERSAL and UNIVERSAL not in machine.kinematic_types:
        for fault in validate(parameters, len(names), mode, names):
            _report(draft, span, parameters, fault)
    try:
        return build(parameters, names, mode, machine.kinematic_types, machine.kinematic_reading)
    except KinematicsError as error:
        message = f"kinematics {parameters.id} cannot be selected: {error.message}"
        draft.fail(error.id, span, message, error.hint)


def parameters_of(draft: Draft, span: Span, step: int, id: int) -> KinematicParameters:
    """The data set of an id, with the parameters of the tool where it is for the first step."""
    held = draft.state.kinematics.sets(step)
    if id == 0:
        command = "#TRAFO PCS ID [..]" if step == PROGRAM_STEP else "#KIN ID [91]"
        draft.fail("292005", span, "no kinematics is selected", f"write {command} before it")
    if id not in held:
        where = ("", " in the second step (kin_step[1])", " as a PCS transformation (trafo_pcs)")
        known = ", ".join(str(i) for i in sorted(held)) or "none"
        number = "21630" if step == PROGRAM_STEP else "292005"
        message = f"kinematics {id} is not configured{where[step]}; configured: {known}"
        draft.fail(number, span, message)
    parameters = held[id].corrected()
    return _with_tool(draft, span, parameters, draft.state.tool.record) if step == 0 else parameters


def _with_tool(
    draft: Draft, span: Span, parameters: KinematicParameters, tool: Tool
) -> KinematicParameters:
    """The data set with the tool's parameters added (wz[].kinematic.param[])."""
    added = {index: value for index, value in tool.kinematic_parameters.items() if value}
    if type_of(parameters) == UNIVERSAL:
        _check_added(draft, span, added)
    for index, value in added.items():
        parameters = parameters.with_value(index, parameters.values[index] + value)
    return parameters


def _check_added(draft: Draft, span: Span, added: Mapping[int, float]) -> None:
    for index in sorted(added):
        field = FIELD_OF_INDEX[index]
        if index in STRUCTURE:
            message = f"the tool adds {added[index]:g} to param[{index}], which is {field}"
            draft.fail("292010", span, message, "a tool may only change lengths and directions")
        if index not in SHIFT_PARAMETERS:
            message = f"the tool changes {field} of the kinematics (param[{index}])"
            draft.warn("N2029", span, message, "tools are expected to change param[3] to param[5]")


def _report(draft: Draft, span: Span, parameters: KinematicParameters, fault: Fault) -> None:
    """The fault at selection, with the lines that wrote the values to blame."""
    notes: list[tuple[str, Span]] = []
    for index in fault.indices:
        writers = [w for w in parameters.origins.get(index, ()) if isinstance(w, Span)]
        words = ("written here",) if len(writers) == 1 else ("written here first",)
        for i, writer in enumerate(writers[-6:]):
            notes.append((words[0] if i == 0 else "written again here", writer))
    draft.fail(
        fault.id,
        span,
        f"kinematics {parameters.id} cannot be selected: {fault.message}",
        fault.hint,
        notes=tuple(notes[:8]),
    )
