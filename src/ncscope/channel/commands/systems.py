"""#CS DEF, #CS ON, #CS OFF: machining coordinate systems that stack.

A definition is a shift in the axes of the level below and three angles, f3 about the third axis
first, then f2, then f1 about the axes already turned. Shift and angles always follow the order of
the main axes in G17.
Source: #CS seed; offsets sheet 3.9.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.state import SystemDefinition
from ncscope.channel.variables import evaluate_number
from ncscope.coordinates import Level
from ncscope.diagnostics import Span
from ncscope.frames import Frame, sequence_rotation
from ncscope.language import tree

MAX_DEFINITIONS = 5
MAX_LEVELS = 5


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#CS DEF [id] [v1,v2,v3,f1,f2,f3]"""
    id, values = _arguments(draft, command)
    if values is None:
        draft.fail("20675", command.span, "#CS DEF needs a shift and angles", _FORM)
    _store(draft, command.span, id, values, temporary=False)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#CS ON [id] [..] | #CS ON [..] | #CS ON [id] | #CS ON"""
    id, values = _arguments(draft, command)
    if values is not None:
        definition = _store(draft, command.span, id, values, temporary=id is None)
    else:
        definition = _stored(draft, command.span, id)
    _activate(draft, command.span, definition)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF: the system activated last goes, with the offsets programmed in it."""
    if command.groups:
        draft.fail(
            "20675", command.span, "#CS OFF takes no id: only the last system can be switched off"
        )
    if draft.state.coordinates.top.kind != "#CS":
        draft.warn("20824", command.span, "no coordinate system is active; #CS OFF does nothing")
        return
    _deactivate(draft, command.span)


def off_all(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF ALL"""
    if draft.state.coordinates.top.kind != "#CS":
        draft.warn("20824", command.span, "no coordinate system is active; #CS OFF does nothing")
    while draft.state.coordinates.top.kind == "#CS":
        _deactivate(draft, command.span)


_FORM = "write for example #CS DEF [1] [10,0,0,0,0,30]: shift X Y Z, angles about X Y Z"


def _arguments(
    draft: Draft, command: tree.HashCommand
) -> tuple[int | None, tuple[float, ...] | None]:
    """Id and values; a bracket with one number is an id, with commas it is a definition."""
    groups = command.groups
    if len(groups) > 2:
        draft.fail("20675", groups[2].span, "there are too many brackets", _FORM)
    if not groups:
        return None, None
    if len(groups) == 2:
        return _id(draft, groups[0]), _values(draft, groups[1])
    if len(groups[0].cells) == 1:
        return _id(draft, groups[0]), None
    return None, _values(draft, groups[0])


def _id(draft: Draft, group: tree.Group) -> int:
    places = group.places
    if len(places) != 1 or places[0] is None or len(group.items) != 1 or group.items[0].key:
        draft.fail("20820", group.span, "the id of a coordinate system is one number", _FORM)
    value = evaluate_number(draft, places[0])
    if value <= 0 or abs(value - round(value)) > 1e-9:
        draft.fail("20820", group.span, f"{value:g} is not an id; ids are whole numbers from 1")
    return round(value)


def _values(draft: Draft, group: tree.Group) -> tuple[float, ...]:
    """Shift in mm and angles in degrees; empty and missing places are 0."""
    if len(group.cells) > 6 or any(len(cell) > 1 for cell in group.cells):
        draft.fail(
            "20675", group.span, "a coordinate system has three shifts and three angles", _FORM
        )
    if any(item.key for item in group.items):
        draft.fail("20675", group.span, "a coordinate system is given by numbers alone", _FORM)
    numbers = [0.0 if p is None else evaluate_number(draft, p) for p in group.places]
    numbers += [0.0] * (6 - len(numbers))
    factor = draft.modes.length_factor
    return (*(v * factor for v in numbers[:3]), *numbers[3:])


def _store(
    draft: Draft, span: Span, id: int | None, values: tuple[float, ...], temporary: bool
) -> SystemDefinition:
    held = draft.state.definitions
    if id is None:
        id = next(i for i in range(1, len(held) + 2) if i not in held)
    if any(level.id == id for level in draft.state.coordinates.levels if level.kind == "#CS"):
        draft.fail(
            "20825",
            span,
            f"coordinate system {id} is active and cannot be defined anew",
            "switch it off first (#CS OFF)",
        )
    if id not in held and len(held) >= MAX_DEFINITIONS:
        draft.fail("21234", span, f"only {MAX_DEFINITIONS} coordinate systems can be defined")
    definition = SystemDefinition(id, values, draft.place, temporary)
    rest = {k: d for k, d in held.items() if k != id}
    draft.state = replace(draft.state, definitions={**rest, id: definition})
    return definition


def _stored(draft: Draft, span: Span, id: int | None) -> SystemDefinition:
    held = draft.state.definitions
    if not held:
        draft.fail("20821", span, "no coordinate system has been defined", _FORM)
    if id is None:
        return list(held.values())[-1]
    if id not in held:
        has = ", ".join(str(i) for i in sorted(held))
        draft.fail("20821", span, f"coordinate system {id} is not defined; defined: {has}")
    return held[id]


def _activate(draft: Draft, span: Span, definition: SystemDefinition) -> None:
    coordinates = draft.state.coordinates
    depth = len(coordinates.levels)
    if depth > MAX_LEVELS:
        draft.fail("20826", span, f"only {MAX_LEVELS} coordinate systems can be linked")
    settings = draft.machine.settings
    rotation = sequence_rotation(
        definition.values[3:], settings.rotation_sequence, settings.rotation_fixed
    )
    frame = Frame(f"level {depth - 1}", f"level {depth}", rotation, np.array(definition.values[:3]))
    level = Level(
        f"#CS {definition.id}",
        "#CS",
        frame,
        id=definition.id,
        temporary=definition.temporary,
        origin=definition.origin,
    )
    draft.set_coordinates(replace(coordinates, levels=(*coordinates.levels, level)), span)


def _deactivate(draft: Draft, span: Span) -> None:
    coordinates = draft.state.coordinates
    gone = coordinates.top
    draft.set_coordinates(replace(coordinates, levels=coordinates.levels[:-1]), span)
    if gone.temporary:
        kept = {k: d for k, d in draft.state.definitions.items() if k != gone.id}
        draft.state = replace(draft.state, definitions=kept)


COMMANDS = {"CS DEF": define, "CS ON": on, "CS OFF": off, "CS OFF ALL": off_all}
