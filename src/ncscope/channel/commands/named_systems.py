"""#CS ADD, SELECT, SET, TRACK, DEL: a stack of named systems, of which the lower part acts.

#CS SELECT makes the stack effective up to a name; the systems above are there for the display and
for #TRANSFORM. None of these commands moves an axis.
Source: TF5200 programming manual, #CS ADD and following
"""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.state import NamedSystem
from ncscope.channel.systems import SELECTED, check_axes, frame, link, text_of, unlink, values
from ncscope.coordinates import Coordinates, Level
from ncscope.frames import Array, Frame
from ncscope.language import tree

MAX_SYSTEMS = 5
NAME_LENGTH = 8
RESERVED = ("ACS", "IMCS", "MCS")
_FORM = "write for example #CS {} [PCS] [10,0,0,0,0,30]"


# --- the stack ---------------------------------------------------------------------------------


def add(draft: Draft, command: tree.HashCommand) -> None:
    """#CS ADD [name] [v1,v2,v3,f1,f2,f3]: on top of the stack; counts after #CS SELECT."""
    node = _name(draft, command, 2, _FORM.format("ADD"))
    name = text_of(node)
    state = draft.state
    check_axes(draft, command.span, "#CS ADD")
    if len(name) > NAME_LENGTH or not name:
        what = f"the name {name} is too long: it has at most {NAME_LENGTH} characters"
        draft.fail("20820", node.span, what)
    if name.upper() in RESERVED or any(system.name == name for system in state.systems):
        fixed = "has a fixed meaning" if name.upper() in RESERVED else "is in use"
        draft.fail("21599", node.span, f"the name {name} {fixed}", "choose another name")
    if len(state.systems) >= MAX_SYSTEMS:
        what = f"the stack has {MAX_SYSTEMS} coordinate systems; there is no place for {name}"
        draft.fail("21234", command.span, what, "take one away first (#CS DEL)")
    system = NamedSystem(name, _frame(draft, command, name), draft.place)
    draft.state = state.changed(systems=(*state.systems, system))


def select(draft: Draft, command: tree.HashCommand) -> None:
    """#CS SELECT [name]: all systems from the bottom up to this one act. [MCS]: none of them."""
    node = _name(draft, command, 1, "write for example #CS SELECT [PCS]")
    wanted = _wanted(draft, node)
    while draft.state.selected > wanted:
        _drop_top(draft, command)
    while draft.state.selected < wanted:
        system = draft.state.systems[draft.state.selected]
        link(draft, command.span, _level(system))
        draft.state = draft.state.changed(selected=draft.state.selected + 1)


def set_definition(draft: Draft, command: tree.HashCommand) -> None:
    """#CS SET [name] [..]: another definition in place, whether the system acts or not."""
    node = _name(draft, command, 2, _FORM.format("SET"))
    k = index_of(draft, node)
    name = draft.state.systems[k].name
    _change(draft, command, k, _frame(draft, command, name), draft.place)


def track(draft: Draft, command: tree.HashCommand) -> None:
    """#CS TRACK [name] [x,y,z]: shifts the system so that the present position reads x,y,z."""
    form = "write for example #CS TRACK [PCS] [40,30,0]"
    node = _name(draft, command, 2, form)
    k = index_of(draft, node)
    target = _point(draft, command.groups[1], form)
    system = draft.state.systems[k]
    chain = whole_stack(draft)
    coordinates = draft.state.coordinates
    place = len(chain.levels) - len(draft.state.systems) + k
    if place == len(coordinates.levels) - 1:  # the position reads what the program would write
        shown = np.array(draft.state.position.program)
        shown[:3] = target
        target = chain.at_level(place).program_from_mcs(coordinates.to_mcs(shown))[:3]
    tip = coordinates.mcs_from_axes(draft.state.position.axes)
    below = chain.at_level(place - 1).program_from_mcs(tip)[:3]
    own = chain.levels[place].total(coordinates.axis_count, coordinates.contour)[:3]
    shift = below - system.frame.rotation @ (own + target)
    tracked = replace(system.frame, shift=shift)
    _change(draft, command, k, tracked, f"{system.origin}, {draft.place}")


def delete(draft: Draft, command: tree.HashCommand) -> None:
    """#CS DEL: the topmost system; where it acts, the one below is selected."""
    if command.groups:
        what = "#CS DEL takes no name: only the topmost system can be taken away"
        draft.fail("20675", command.span, what)
    if not draft.state.systems:
        draft.warn("20824", command.span, "the stack is empty; #CS DEL does nothing")
        return
    _delete_top(draft, command)


def delete_all(draft: Draft, command: tree.HashCommand) -> None:
    """#CS DEL ALL"""
    while draft.state.systems:
        _delete_top(draft, command)


# --- the chain ---------------------------------------------------------------------------------


def whole_stack(draft: Draft) -> Coordinates:
    """The coordinates as they would be with the topmost system of the stack selected."""
    state = draft.state
    above = tuple(_level(system) for system in state.systems[state.selected :])
    return replace(state.coordinates, levels=(*state.coordinates.levels, *above))


def index_of(draft: Draft, node: tree.Name | tree.Text) -> int:
    """The place of a system in the stack; fails with the names that there are."""
    name = text_of(node)
    names = [system.name for system in draft.state.systems]
    if name in names:
        return names.index(name)
    other = next((n for n in names if n.lower() == name.lower()), None)
    hint = f"names are case-sensitive: write {other}" if other else ""
    has = ", ".join(names) or "none"
    hint = hint or "define it first, for example #CS ADD [PCS] [10,0,0]"
    draft.fail(
        "21601", node.span, f"coordinate system {name} is unknown; the stack has: {has}", hint
    )


def _level(system: NamedSystem) -> Level:
    return Level(f"#CS {system.name}", SELECTED, system.frame, id=system.name, origin=system.origin)


def _wanted(draft: Draft, node: tree.Name | tree.Text) -> int:
    """How many systems of the stack act after the selection of this name."""
    name = text_of(node)
    if name.upper() == "IMCS":
        refuse_intermediate(draft, node)
    if name.upper() != "MCS":
        return index_of(draft, node) + 1
    below = len(draft.state.coordinates.levels) - 1 - draft.state.selected
    if below:
        what = "MCS cannot be selected: a system that was switched on with #CS ON lies above it"
        draft.fail("N2051", node.span, what, "switch it off first (#CS OFF, #ACS OFF, #BCS OFF)")
    return 0


def refuse_intermediate(draft: Draft, node: tree.Name | tree.Text) -> NoReturn:
    """IMCS: the system between two kinematic steps."""
    if draft.state.kinematics.active[1]:
        what = "IMCS, the system between two kinematic steps, is not supported"
        draft.fail("N2001", node.span, what)
    what = "IMCS belongs to a kinematics of two steps, and none is active"
    draft.fail("21601", node.span, what)


def _drop_top(draft: Draft, command: tree.HashCommand) -> None:
    unlink(draft, command.span, (len(draft.state.coordinates.levels) - 1,))
    draft.state = draft.state.changed(selected=draft.state.selected - 1)


def _delete_top(draft: Draft, command: tree.HashCommand) -> None:
    if draft.state.selected == len(draft.state.systems):
        _drop_top(draft, command)
    draft.state = draft.state.changed(systems=draft.state.systems[:-1])


def _change(draft: Draft, command: tree.HashCommand, k: int, frame: Frame, origin: str) -> None:
    """Another frame for a system of the stack; the offsets in it and the axes stay."""
    state = draft.state
    system = NamedSystem(state.systems[k].name, frame, origin)
    draft.state = state.changed(systems=(*state.systems[:k], system, *state.systems[k + 1 :]))
    if k >= state.selected:
        return
    levels = list(state.coordinates.levels)
    place = len(levels) - state.selected + k
    levels[place] = replace(levels[place], frame=frame, origin=origin)
    draft.set_coordinates(replace(state.coordinates, levels=tuple(levels)), command.span)


# --- how they are written ----------------------------------------------------------------------


def _name(
    draft: Draft, command: tree.HashCommand, brackets: int, form: str
) -> tree.Name | tree.Text:
    groups = command.groups
    if len(groups) != brackets:
        draft.fail("20675", command.span, f"#{command.name} needs {_COUNTS[brackets]}", form)
    return name_in(draft, groups[0], form)


_COUNTS = {1: "a name in brackets", 2: "a name and its values, each in brackets"}


def name_in(draft: Draft, group: tree.Group, form: str) -> tree.Name | tree.Text:
    """The name that stands alone in a bracket."""
    items = group.items
    if len(items) == 1 and isinstance(items[0].value, (tree.Name, tree.Text)) and not items[0].key:
        return items[0].value
    draft.fail("20675", group.span, "a name of a coordinate system is needed here", form)


def _frame(draft: Draft, command: tree.HashCommand, name: str) -> Frame:
    form = _FORM.format(command.name.split(" ")[1])
    return frame(draft, f"#CS {name}", values(draft, command.groups[1], form))


def _point(draft: Draft, group: tree.Group, form: str) -> Array:
    """Three coordinates (3,) in mm."""
    places = group.places
    if len(places) != 3 or None in places or len(group.items) != 3:
        draft.fail("20675", group.span, "a position has three coordinates", form)
    factor = draft.modes.length_factor
    return np.array([evaluate_number(draft, p) * factor for p in places if p is not None])


COMMANDS = {
    "CS ADD": add,
    "CS SELECT": select,
    "CS SET": set_definition,
    "CS TRACK": track,
    "CS DEL": delete,
    "CS DEL ALL": delete_all,
}
