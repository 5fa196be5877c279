"""#TRAFO PCS: a transformation of what the program writes, above all coordinate systems.

Its types are kinematics of the user (500 to 999); the universal kinematics is none.
Source: TF5200 #TRAFO PCS; P-CHAN-00262, P-CHAN-00829, P-CHAN-00854; error ids 22282, 22287.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.selection import evaluate_id, step_of
from ncscope.channel.state import PROGRAM_STEP
from ncscope.coordinates import ActiveKinematics
from ncscope.kinematics.building import can_be_pcs, type_of
from ncscope.language import tree


def select(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS ID [500]; without bracket the default of P-CHAN-00854."""
    given = _id_in(draft, command)
    id = draft.machine.settings.default_program_step_id if given is None else given
    _preselect(draft, command, id)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS ON: the axes stay; programmed values go through the transformation from now.

    #TRAFO PCS ON [500] chooses the transformation as well.
    """
    given = _id_in(draft, command)
    if given is not None and given != draft.state.kinematics.program_id:
        _preselect(draft, command, given)
    state = draft.state
    if state.coordinates.program_step is not None:
        return
    id = state.kinematics.program_id
    parameters = state.kinematics.sets(PROGRAM_STEP).get(id)
    if parameters is not None and not can_be_pcs(type_of(parameters)):
        what = f"type {type_of(parameters)} (trafo_pcs with id {id}) is no PCS transformation"
        draft.fail("22287", command.span, what, "PCS transformations have types 500 to 999")
    model = step_of(draft, command.span, PROGRAM_STEP, id)
    pose = model.pose_of(state.position.program)
    active = ActiveKinematics(model, pose, draft.place)
    draft.set_coordinates(replace(state.coordinates, program_step=active), command.span)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS OFF: the axes stay where they are."""
    draft.set_coordinates(replace(draft.state.coordinates, program_step=None), command.span)


def _preselect(draft: Draft, command: tree.HashCommand, id: int) -> None:
    if draft.state.coordinates.program_step is not None:
        what = "the PCS transformation cannot be changed while it is active"
        draft.fail("22282", command.span, what, "switch it off first (#TRAFO PCS OFF)")
    held = draft.state.kinematics
    draft.state = draft.state.changed(kinematics=replace(held, program_id=id))


def _id_in(draft: Draft, command: tree.HashCommand) -> int | None:
    """The id in the bracket, None without a bracket."""
    if not command.groups:
        return None
    places = command.groups[0].places
    if len(command.groups) != 1 or len(places) != 1 or places[0] is None:
        form = f"write for example #{command.name} [500]"
        draft.fail("N1005", command.span, f"#{command.name} takes one id", form)
    return evaluate_id(draft, places[0])


COMMANDS = {"TRAFO PCS ID": select, "TRAFO PCS ON": on, "TRAFO PCS OFF": off}
