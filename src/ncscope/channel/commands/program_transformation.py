"""#TRAFO PCS: a transformation of what the program writes, above all coordinate systems.

Its types are kinematics of the user (500 to 999); the universal kinematics is none.
Source: TF5200 #TRAFO PCS; P-CHAN-00854.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.selection import step_of
from ncscope.channel.state import PROGRAM_STEP
from ncscope.coordinates import ActiveKinematics
from ncscope.kinematics.building import UNIVERSAL, type_of
from ncscope.language import tree


def select(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS ID [500]; without bracket the default of P-CHAN-00854."""
    if draft.state.coordinates.program_step is not None:
        what = "the PCS transformation cannot be changed while it is active"
        draft.fail("20687", command.span, what, "switch it off first (#TRAFO PCS OFF)")
    id = draft.machine.settings.default_program_step_id
    if command.groups:
        places = command.groups[0].places
        if len(places) != 1 or places[0] is None or isinstance(places[0], tree.Name):
            form = "write for example #TRAFO PCS ID [500]"
            draft.fail("N1005", command.span, "#TRAFO PCS ID takes one id", form)
        id = round(evaluate_number(draft, places[0]))
    held = draft.state.kinematics
    draft.state = replace(draft.state, kinematics=replace(held, program_id=id))


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS ON: the axes stay; programmed values go through the transformation from now."""
    state = draft.state
    if state.coordinates.program_step is not None:
        return
    id = state.kinematics.program_id
    parameters = state.kinematics.sets(PROGRAM_STEP).get(id)
    if parameters is not None and type_of(parameters) == UNIVERSAL:
        what = f"type {UNIVERSAL} (trafo_pcs with id {id}) is no PCS transformation"
        draft.fail("22287", command.span, what, "PCS transformations have types 500 to 999")
    model = step_of(draft, command.span, PROGRAM_STEP, id)
    pose = model.pose_of(state.position.program)
    active = ActiveKinematics(model, pose, draft.place)
    draft.set_coordinates(replace(state.coordinates, program_step=active), command.span)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO PCS OFF: the axes stay where they are."""
    draft.set_coordinates(replace(draft.state.coordinates, program_step=None), command.span)


COMMANDS = {"TRAFO PCS ID": select, "TRAFO PCS ON": on, "TRAFO PCS OFF": off}
