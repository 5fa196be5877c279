"""#KIN ID and #TRAFO: which kinematics, on and off (FCT-C27; TF5200 #KIN ID, #TRAFO)."""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.tools import with_tool_parameters
from ncscope.coordinates import ActiveKinematics
from ncscope.diagnostics import Span
from ncscope.kinematics.chain import Fault, validate
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.language import tree

UNIVERSAL = 91


def select(draft: Draft, command: tree.HashCommand) -> None:
    """#KIN ID [91]; without bracket the default of P-CHAN-00032."""
    if draft.state.coordinates.kinematics is not None:
        draft.fail(
            "20687",
            command.span,
            "the kinematics cannot be changed while a transformation is active",
            "switch it off first (#TRAFO OFF)",
        )
    id = draft.machine.settings.default_kinematic_id
    if command.groups:
        places = command.groups[0].places
        if len(places) != 1 or places[0] is None:
            draft.fail("N2001", command.span, "a kinematics of two steps is not supported yet")
        id = round(evaluate_number(draft, places[0]))
    draft.state = replace(draft.state, kinematics=replace(draft.state.kinematics, selected=id))


def trafo(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO [91]: preselection and switch in one."""
    if len(command.groups) != 1 or len(command.groups[0].items) != 1:
        draft.fail("N2001", command.span, "this form of #TRAFO is not supported yet")
    item = command.groups[0].items[0]
    if isinstance(item.value, tree.Name):
        word = item.value.text.upper()
        if word == "ON":
            return on(draft, command)
        if word in ("OFF", "NONE"):
            return off(draft, command)
        draft.fail("N2001", command.span, f"#TRAFO [{word}] is not supported yet")
    select(draft, command)
    return on(draft, command)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO ON: the axes stay where they are; positions are read through the kinematics."""
    held = draft.state.kinematics
    if draft.state.coordinates.kinematics is not None:
        return
    if draft.state.tool.correction_at is not None:
        what = "a transformation is not allowed while #TLC is active"
        draft.fail("20669", command.span, what, "switch it off first (#TLC OFF)")
    parameters = _parameters(draft, command.span, held.selected)
    parameters = with_tool_parameters(parameters, draft.state.tool.record)
    settings = draft.machine.settings
    names = draft.state.axis_names
    for fault in validate(parameters, len(names), settings.orientation_mode, names):
        _report(draft, command.span, parameters, fault)
    model = UniversalKinematics.from_parameters(parameters, names, settings.orientation_mode)
    pose = model.pose_of(draft.state.position.axes)
    active = ActiveKinematics(model, pose, draft.place, settings.direction_turns)
    draft.set_coordinates(replace(draft.state.coordinates, kinematics=active), command.span)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO OFF: the axes stay where they are."""
    draft.set_coordinates(replace(draft.state.coordinates, kinematics=None), command.span)


def _parameters(draft: Draft, span: Span, id: int) -> KinematicParameters:
    held = draft.state.kinematics.parameters
    if id == 0:
        draft.fail(
            "292005", span, "no kinematics is selected", "write #KIN ID [91] before #TRAFO ON"
        )
    if id not in held:
        known = ", ".join(str(i) for i in sorted(held)) or "none"
        draft.fail("292005", span, f"kinematics {id} is not configured; configured: {known}")
    parameters = held[id]
    if (parameters.type or parameters.id) != UNIVERSAL:
        draft.fail(
            "N2001",
            span,
            f"kinematics {id} of type {parameters.type} is not supported; only type 91 is",
        )
    return parameters


def _report(draft: Draft, span: Span, parameters: KinematicParameters, fault: Fault) -> None:
    """The fault at #TRAFO ON, with the lines that wrote the values to blame."""
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


COMMANDS = {"KIN ID": select, "TRAFO ON": on, "TRAFO OFF": off, "TRAFO": trafo}
