"""#KIN ID and #TRAFO: which kinematics, on and off, in one step or two.

Source: FCT-C27; TF5200 #KIN ID, #TRAFO, multi-step transformations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ncscope.channel.draft import Draft
from ncscope.channel.selection import activate, evaluate_id
from ncscope.language import tree

FORM = "write for example #TRAFO [91], #TRAFO [87,51], #TRAFO [ON,OFF] or #TRAFO [OFF]"


@dataclass(frozen=True, slots=True)
class Choice:
    """What a command says of one step: its id, and whether it is on afterwards."""

    id: int
    on: bool


def select(draft: Draft, command: tree.HashCommand) -> None:
    """#KIN ID [91], #KIN ID [87,51]; without bracket the defaults (P-CHAN-00032, P-CHAN-00264)."""
    tool = draft.state.tool.correction_at is not None
    if draft.state.kinematics.is_on or tool:
        what = "#TLC" if tool else "a transformation"
        draft.fail(
            "20687",
            command.span,
            f"the kinematics cannot be changed while {what} is active",
            f"switch it off first ({'#TLC OFF' if tool else '#TRAFO OFF'})",
        )
    settings = draft.machine.settings
    ids = (settings.default_kinematic_id, settings.default_second_id)
    if command.groups:
        first, second = _choices(draft, command, switching=False)
        ids = (first.id, second.id)
    _preselect(draft, ids)


def trafo(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO [91], #TRAFO [87,51], #TRAFO [ON,OFF]: preselection and switch in one."""
    held = draft.state.kinematics
    first, second = _choices(draft, command, switching=True)
    if not first.on and not second.on:
        off(draft, command)
        _preselect(draft, (first.id, second.id))
        return
    active = draft.state.coordinates.kinematics is not None
    changed = [
        old
        for choice, old in zip((first, second), held.ids, strict=True)
        if choice.id not in (0, old)
    ]
    if active and changed:
        message = "the kinematics of a step cannot be changed while a transformation is active"
        draft.fail("20687", command.span, message, "switch it off first (#TRAFO [OFF])")
    _preselect(draft, (first.id, second.id))
    _switch_on(draft, command, first, second)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO ON: both preselected steps; the axes stay, positions are read through them."""
    _refuse_point_to_point(draft, command, "21552")
    if draft.state.coordinates.kinematics is not None:
        return
    first, second = draft.state.kinematics.ids
    _switch_on(draft, command, Choice(first, first > 0 or not second), Choice(second, second > 0))


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO OFF: the axes stay where they are."""
    _refuse_point_to_point(draft, command, "21528")
    draft.state = draft.state.changed(kinematics=replace(draft.state.kinematics, active=(0, 0)))
    draft.set_coordinates(replace(draft.state.coordinates, kinematics=None), command.span)


def _switch_on(draft: Draft, command: tree.HashCommand, first: Choice, second: Choice) -> None:
    """The steps that are on become the kinematics; its pose is that of the axes."""
    _refuse_point_to_point(draft, command, "21552")
    if draft.state.tool.correction_at is not None:
        what = "a transformation is not allowed while #TLC is active"
        draft.fail("20669", command.span, what, "switch it off first (#TLC OFF)")
    if not first.on:
        what = "the second step of a transformation without the first is not supported"
        draft.fail("N2001", command.span, what, "switch the first step on, too")
    activate(draft, command.span, (first.id, second.id if second.on else 0))


def _refuse_point_to_point(draft: Draft, command: tree.HashCommand, id: str) -> None:
    if draft.state.coordinates.point_to_point:
        what = f"#{command.name} is not allowed while #PTP is active"
        draft.fail(id, command.span, what, "write #PTP OFF before it")


def _preselect(draft: Draft, ids: tuple[int, int]) -> None:
    held = draft.state.kinematics
    draft.state = draft.state.changed(kinematics=replace(held, ids=ids))


def _choices(draft: Draft, command: tree.HashCommand, switching: bool) -> tuple[Choice, Choice]:
    """Both places of the bracket; the second left out is NONE, for ON and OFF the same word."""
    if len(command.groups) != 1 or any(len(cell) > 1 for cell in command.groups[0].cells):
        draft.fail("N1005", command.span, f"#{command.name} is written wrongly", FORM)
    places = list(command.groups[0].places)
    if not places or len(places) > 2 or places[0] is None:
        draft.fail("N1005", command.span, f"#{command.name} takes one id or two", FORM)
    if len(places) == 1:
        places.append(places[0] if _word(places[0]) in ("ON", "OFF", "DEFAULT") else None)
    first, second = (_choice(draft, command, i, p, switching) for i, p in enumerate(places))
    if len(command.groups[0].places) == 1 and not draft.state.kinematics.ids[1]:
        second = replace(second, on=second.on and second.id > 0)
    return first, second


def _word(place: tree.Expression | None) -> str:
    return place.text.upper() if isinstance(place, tree.Name) else ""


def _choice(
    draft: Draft,
    command: tree.HashCommand,
    step: int,
    place: tree.Expression | None,
    switching: bool,
) -> Choice:
    settings, held = draft.machine.settings, draft.state.kinematics.ids[step]
    word = _word(place)
    if place is None or word == "NONE":
        return Choice(0, on=False)
    if word == "DEFAULT":
        id = (settings.default_kinematic_id, settings.default_second_id)[step]
        return Choice(id, on=id > 0)
    if switching and word in ("ON", "OFF"):
        return Choice(held, on=word == "ON")
    if isinstance(place, tree.Name):
        words = "ON, OFF, NONE and DEFAULT" if switching else "NONE and DEFAULT"
        draft.fail("N1005", place.span, f"{place.text} is no kinematic id", f"words are {words}")
    id = evaluate_id(draft, place)
    return Choice(id, on=id > 0)


COMMANDS = {
    "KIN ID": select,
    "TRAFO ON": on,
    "TRAFO OFF": off,
    "TRAFO": trafo,
    "RTCP ON": on,
    "RTCP OFF": off,
}
