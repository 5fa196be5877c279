"""#CS, #ACS and #BCS DEF, ON, OFF: coordinate systems that stack, and #CS MODE.

A definition is a shift in the axes of the level below and three angles, f3 about the third axis
first, then f2, then f1 about the axes already turned. Shift and angles always follow the order of
the main axes in G17. From bottom to top lie #BCS, #ACS, #CS, whichever was switched on first.
Source: #CS seed; TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.state import SystemDefinition
from ncscope.coordinates import Level
from ncscope.diagnostics import Span
from ncscope.frames import ROTATION_SEQUENCES, Frame, sequence_rotation
from ncscope.language import tree

MAX_DEFINITIONS = 5
MAX_LEVELS = 5
ORDER = ("base", "#BCS", "#ACS", "#CS")
"""Kinds of level from bottom to top."""


def _kind(command: tree.HashCommand) -> str:
    """`#ACS` for `#ACS ON`."""
    return "#" + command.name.split(" ")[0]


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#CS DEF [id] [v1,v2,v3,f1,f2,f3]"""
    id, values = _arguments(draft, command)
    if values is None:
        draft.fail("20675", command.span, f"{_kind(command)} DEF needs a shift and angles", _FORM)
    _store(draft, command, id, values, temporary=False)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#CS ON [id] [..] | #CS ON [..] | #CS ON [id] | #CS ON"""
    id, values = _arguments(draft, command)
    if values is not None:
        definition = _store(draft, command, id, values, temporary=id is None)
    else:
        definition = _stored(draft, command, id)
    _activate(draft, command.span, definition)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF: the system of this kind that was activated last, with the offsets in it."""
    kind = _kind(command)
    if command.groups:
        what = f"{kind} OFF takes no id: only the last system can be switched off"
        draft.fail("20675", command.span, what)
    if not _active(draft, kind):
        what = f"no coordinate system is active; {kind} OFF does nothing"
        draft.warn("20824", command.span, what)
        return
    _deactivate(draft, command.span, kind)


def off_all(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF ALL"""
    kind = _kind(command)
    if not _active(draft, kind):
        what = f"no coordinate system is active; {kind} OFF does nothing"
        draft.warn("20824", command.span, what)
    while _active(draft, kind):
        _deactivate(draft, command.span, kind)


def mode_on(draft: Draft, command: tree.HashCommand) -> None:
    """#CS MODE ON [ROTATION_SEQUENCE=XYZ ROTATION_MODE_FIXED]: for systems switched on later."""
    items = _mode_items(draft, command)
    mode = draft.state.system_mode
    if "ROTATION_SEQUENCE" in items:
        sequence = items["ROTATION_SEQUENCE"].upper()
        if sequence not in ROTATION_SEQUENCES:
            what = f"{sequence or 'nothing'} is no rotation sequence"
            draft.fail("20675", command.span, what, "known are " + " ".join(ROTATION_SEQUENCES))
        mode = replace(mode, sequence=sequence)
    if "ROTATION_MODE_FIXED" in items:
        mode = replace(mode, fixed=True)
    if "AXES_OFFSETS_LAYER_SPECIFIC" in items and not draft.machine.settings.offsets_per_level:
        _global_offsets(draft, command)
    draft.state = replace(draft.state, system_mode=mode)


def mode_off(draft: Draft, command: tree.HashCommand) -> None:
    """#CS MODE OFF [..]: the sequence of the channel parameter; turns about the new axes."""
    items = _mode_items(draft, command)
    mode = draft.state.system_mode
    if "ROTATION_SEQUENCE" in items:
        mode = replace(mode, sequence=None)
    if "ROTATION_MODE_FIXED" in items:
        mode = replace(mode, fixed=False)
    if "AXES_OFFSETS_LAYER_SPECIFIC" in items:
        _global_offsets(draft, command)
    draft.state = replace(draft.state, system_mode=mode)


MODES = ("ROTATION_SEQUENCE", "ROTATION_MODE_FIXED", "AXES_OFFSETS_LAYER_SPECIFIC")


def _mode_items(draft: Draft, command: tree.HashCommand) -> dict[str, str]:
    """Option -> its word, '' without; `ROTATION_SEQUENCE=XYZ` and `ROTATION_SEQUENCE XYZ`."""
    found: dict[str, str] = {}
    last = ""
    for item in (i for group in command.groups for i in group.items):
        word = item.value.text if isinstance(item.value, tree.Name) else ""
        key = item.key or word.upper()
        if key in MODES:
            found[key], last = word if item.key else "", key
        elif last == "ROTATION_SEQUENCE" and not found[last] and not item.key:
            found[last] = word
        else:
            what = f"{item.span.text.strip()} is no option of #CS MODE"
            draft.fail("20675", item.span, what, "known are " + " ".join(MODES))
    if not found:
        draft.fail("20480", command.span, "#CS MODE needs an option", "known: " + " ".join(MODES))
    return found


def _global_offsets(draft: Draft, command: tree.HashCommand) -> None:
    what = "one offset of the further axes for all systems is not supported yet"
    draft.fail("N2001", command.span, what, "leave AXES_OFFSETS_LAYER_SPECIFIC switched on")


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
        what = "a coordinate system has three shifts and three angles"
        draft.fail("20675", group.span, what, _FORM)
    if any(item.key for item in group.items):
        draft.fail("20675", group.span, "a coordinate system is given by numbers alone", _FORM)
    numbers = [0.0 if p is None else evaluate_number(draft, p) for p in group.places]
    numbers += [0.0] * (6 - len(numbers))
    factor = draft.modes.length_factor
    return (*(v * factor for v in numbers[:3]), *numbers[3:])


def _store(
    draft: Draft,
    command: tree.HashCommand,
    id: int | None,
    values: tuple[float, ...],
    temporary: bool,
) -> SystemDefinition:
    kind = _kind(command)
    held = _definitions(draft, kind)
    if id is None:
        id = next(i for i in range(1, len(held) + 2) if i not in held)
    if any(level.id == id for level in _active(draft, kind)):
        draft.fail(
            "20825",
            command.span,
            f"coordinate system {id} is active and cannot be defined anew",
            f"switch it off first ({kind} OFF)",
        )
    if id not in held and len(held) >= MAX_DEFINITIONS:
        what = f"only {MAX_DEFINITIONS} coordinate systems can be defined"
        draft.fail("21234", command.span, what)
    definition = SystemDefinition(kind, id, values, draft.place, temporary)
    _forget(draft, kind, id)
    definitions = {**draft.state.definitions, (kind, id): definition}
    draft.state = replace(draft.state, definitions=definitions)
    return definition


def _definitions(draft: Draft, kind: str) -> dict[int, SystemDefinition]:
    """The stored systems of a kind by id, in the order of their definition."""
    return {id: d for (k, id), d in draft.state.definitions.items() if k == kind}


def _active(draft: Draft, kind: str) -> list[Level]:
    """The active systems of a kind, from bottom to top."""
    return [level for level in draft.state.coordinates.levels if level.kind == kind]


def _forget(draft: Draft, kind: str, id: int) -> None:
    kept = {key: d for key, d in draft.state.definitions.items() if key != (kind, id)}
    draft.state = replace(draft.state, definitions=kept)


def _stored(draft: Draft, command: tree.HashCommand, id: int | None) -> SystemDefinition:
    held = _definitions(draft, _kind(command))
    if not held:
        draft.fail("20821", command.span, "no coordinate system has been defined", _FORM)
    if id is None:
        return list(held.values())[-1]
    if id not in held:
        has = ", ".join(str(i) for i in sorted(held))
        what = f"coordinate system {id} is not defined; defined: {has}"
        draft.fail("20821", command.span, what)
    return held[id]


def _activate(draft: Draft, span: Span, definition: SystemDefinition) -> None:
    """On top of the systems of its kind, below those of a higher kind; the axes stay."""
    kind = definition.kind
    if len(_active(draft, kind)) >= MAX_LEVELS:
        draft.fail("20826", span, f"only {MAX_LEVELS} coordinate systems can be linked")
    _check_axes(draft, span, kind)
    coordinates = draft.state.coordinates
    rank = ORDER.index(kind)
    place = sum(ORDER.index(level.kind) <= rank for level in coordinates.levels)
    level = Level(
        f"{kind} {definition.id}",
        kind,
        _frame(draft, definition),
        id=definition.id,
        temporary=definition.temporary,
        origin=definition.origin,
    )
    levels = (*coordinates.levels[:place], level, *coordinates.levels[place:])
    draft.set_coordinates(replace(coordinates, levels=levels), span)


def _check_axes(draft: Draft, span: Span, kind: str) -> None:
    n = len(draft.state.axes)
    if n < 3:
        draft.fail("20010", span, f"{kind} needs three main axes; the channel has {n}")
    if n > 3 and not draft.machine.settings.offsets_per_level:
        draft.fail(
            "N2001",
            span,
            f"{kind} with one common offset for the axes beyond the third "
            "(axes_offsets_layer_specific 0, P-CHAN-00397) is not supported",
        )


def _frame(draft: Draft, definition: SystemDefinition) -> Frame:
    """The level below from this system, by the rotation sequence that is valid now."""
    settings, mode = draft.machine.settings, draft.state.system_mode
    sequence = mode.sequence or settings.rotation_sequence
    fixed = settings.rotation_fixed if mode.fixed is None else mode.fixed
    rotation = sequence_rotation(definition.values[3:], sequence, fixed)
    name = f"{definition.kind} {definition.id}"
    return Frame(f"below {name}", name, rotation, np.array(definition.values[:3]))


def _deactivate(draft: Draft, span: Span, kind: str) -> None:
    coordinates = draft.state.coordinates
    gone = _active(draft, kind)[-1]
    levels = tuple(level for level in coordinates.levels if level is not gone)
    draft.set_coordinates(replace(coordinates, levels=levels), span)
    if gone.temporary:
        _forget(draft, kind, gone.id)


_VERBS = {"DEF": define, "ON": on, "OFF": off, "OFF ALL": off_all}
COMMANDS = {
    **{f"{kind} {verb}": rule for kind in ("CS", "ACS", "BCS") for verb, rule in _VERBS.items()},
    "CS MODE ON": mode_on,
    "CS MODE OFF": mode_off,
}
