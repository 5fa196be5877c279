"""#TLC ON [15], #TLC OFF: the tool is longer than its data say (TF5200 #TLC).

Counts from the next absolute word. Not together with a transformation. With a preselected
kinematics the difference acts along the tool, wherever the rotary axes turn it.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.selection import checked, parameters_of
from ncscope.coordinates import ActiveLengthCorrection
from ncscope.kinematics.alignment import LengthCorrection
from ncscope.kinematics.building import UNIVERSAL, type_of
from ncscope.kinematics.parameters import INDEX_OF_FIELD
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.language import tree

CLASSIC_CA = 17
"""A programming mode in which the position is X, Y, Z; with RTCP its angles do not matter."""


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TLC ON [dL]: new minus old length, mm or inches."""
    if draft.state.coordinates.kinematics is not None:
        what = "#TLC is not allowed while a transformation is active"
        draft.fail("20669", command.span, what, "switch it off first (#TRAFO OFF)")
    tool = draft.state.tool
    if tool.correction_at is not None:
        what = "a correction of the tool length is active"
        draft.fail("N2028", command.span, what, "switch it off first (#TLC OFF)")
    places = command.groups[0].places if len(command.groups) == 1 else ()
    if len(places) != 1 or places[0] is None:
        form = "write for example #TLC ON [0.5]"
        draft.fail("N1005", command.span, "#TLC ON needs the difference of length", form)
    length = evaluate_number(draft, places[0]) * draft.modes.length_factor
    id = draft.state.kinematics.ids[0]
    if id == 0:
        tool = tool.changed(correction=length, correction_at=draft.place)
        draft.state = offsets.with_tool(draft.state, tool)
        return
    step = ActiveLengthCorrection(_along_the_tool(draft, command, id, length), draft.place)
    draft.state = draft.state.changed(tool=tool.changed(correction_at=draft.place))
    draft.set_coordinates(replace(draft.state.coordinates, length_step=step), command.span)


def _along_the_tool(
    draft: Draft, command: tree.HashCommand, id: int, length: float
) -> LengthCorrection:
    """The correction by the preselected kinematics, taken as RTCP: words are axis angles."""
    parameters = parameters_of(draft, command.span, 0, id)
    if type_of(parameters) != UNIVERSAL:
        what = f"#TLC with kinematics {id} of type {parameters.type} is not supported"
        draft.fail("N2001", command.span, what, "only type 91 is; #KIN ID [0] corrects one axis")
    for name, value in (("programming_mode", CLASSIC_CA), ("rtcp", 1)):
        parameters = parameters.with_value(INDEX_OF_FIELD[name], value)
    model = checked(draft, command.span, parameters)
    assert isinstance(model, UniversalKinematics)
    return LengthCorrection(model, length)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TLC OFF"""
    tool = draft.state.tool.changed(correction=0.0, correction_at=None)
    if draft.state.coordinates.length_step is not None:
        coordinates = replace(draft.state.coordinates, length_step=None)
        draft.set_coordinates(coordinates, command.span)
    draft.state = offsets.with_tool(draft.state, tool)


COMMANDS = {"TLC ON": on, "TLC OFF": off}
