"""Configured coordinate systems and transformation stacks of the channel list.

Shifts are in mm and angles in degrees here, not in list units. A system without an id and a stack
without a name cannot be used; the second path is for two-path machines.
Source: P-CHAN-00490 to -00496, P-CHAN-00752 to -00757, P-CHAN-00831
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.lists.values import Reading
from ncscope.machine import ConfiguredSystem, StackAtStart, TransformationStack

Id = int | str

DEFINITION, STACK = "coordinate_system.def[].", "trafo_stack[]."
START = "trafo_stack_name_active_prog_start"
PLACES = {"t1": 0, "t2": 1, "t3": 2, "a1": 3, "a2": 4, "a3": 5}
GROUPS = {"bcs": "#BCS", "acs": "#ACS", "cs": "#CS"}
"""Groups of a stack from bottom to top."""
MOST_IN_STACK = 10
LONGEST_ID = 7
_NUMBER = re.compile(r"[0-9]{1,18}")


@dataclass
class Configured:
    """What the channel list configures, and what is wrong with it."""

    systems: dict[Id, ConfiguredSystem] = field(default_factory=dict)
    stacks: dict[str, TransformationStack] = field(default_factory=dict)
    start: StackAtStart | None = None
    diagnostics: list[Diagnostic] = field(default_factory=list)


def configured(readings: Iterable[Reading]) -> Configured:
    """The systems by id and the stacks by name; of two with one name the first counts."""
    given = [reading for reading in readings if reading.value is not None]
    result = Configured()
    for parts in _grouped(given, DEFINITION):
        _add_system(result, parts)
    for parts in _grouped(given, STACK):
        _add_stack(result, parts)
    for reading in given:
        if reading.row.key == START:
            _start(result, reading)
    return result


def _grouped(readings: list[Reading], prefix: str) -> list[list[Reading]]:
    """The readings of each index, in the order of the indices; the last of a key counts."""
    slots: dict[int, dict[str, Reading]] = defaultdict(dict)
    for reading in readings:
        if reading.row.key.startswith(prefix):
            slots[reading.indices[0]][reading.entry.key.lower()] = reading
    return [list(slots[index].values()) for index in sorted(slots)]


def _one(parts: list[Reading], name: str) -> Reading | None:
    return next((reading for reading in parts if reading.field == name), None)


def _add_system(result: Configured, parts: list[Reading]) -> None:
    name = _one(parts, "id")
    if name is None:
        what = "a coordinate system without an id cannot be used"
        hint = f"write coordinate_system.def[{parts[0].indices[0]}].id and a name"
        result.diagnostics.append(diagnostic("N3003", parts[0].entry.key_span, what, hint))
        return
    id = id_of(str(name.value))
    fault = _bad_id(id, name, result)
    if fault is not None:
        result.diagnostics.append(fault)
        return
    values = [0.0] * 6
    for reading in parts:
        if reading.field not in PLACES:
            continue
        if reading.indices[1] == 0:
            values[PLACES[reading.field]] = float(reading.value or 0)
        else:
            what = "the second path of a coordinate system has no effect here"
            result.diagnostics.append(diagnostic("N3003", reading.entry.key_span, what))
    result.systems[id] = ConfiguredSystem(tuple(values), name.entry.place)


def _bad_id(id: Id, name: Reading, result: Configured) -> Diagnostic | None:
    """What is wrong with the id of a coordinate system."""
    if isinstance(id, str) and len(id) > LONGEST_ID:
        what = f"the id {id} is too long; the coordinate system is not taken over"
        hint = f"an id has at most {LONGEST_ID} characters"
        return diagnostic("110552", name.entry.value_span, what, hint)
    if id in result.systems:
        what = f"a coordinate system {id} is configured already; this one is not taken over"
        return diagnostic("22163", name.entry.value_span, what)
    return None


def id_of(text: str) -> Id:
    """A number as the program writes it, or a name; a number too long for one stays a text."""
    return int(text) if _NUMBER.fullmatch(text) else text


# --- stacks ------------------------------------------------------------------------------------


def _add_stack(result: Configured, parts: list[Reading]) -> None:
    name = _one(parts, "name")
    if name is None:
        what = "a transformation stack without a name cannot be used"
        hint = f"write trafo_stack[{parts[0].indices[0]}].name and a name"
        result.diagnostics.append(diagnostic("N3003", parts[0].entry.key_span, what, hint))
        return
    text = str(name.value)
    if text in result.stacks:
        what = f"a transformation stack {text} is configured already; this one is not taken over"
        result.diagnostics.append(diagnostic("22164", name.entry.value_span, what))
        return
    kinematics = [0, 0]
    for reading in parts:
        if reading.row.key == "trafo_stack[].kin_id[]":
            kinematics[reading.indices[1]] = int(float(reading.value or 0))
    systems = tuple(_stack_systems(result, parts))
    stack = TransformationStack(text, systems, (kinematics[0], kinematics[1]), name.entry.place)
    result.stacks[text] = stack


def _stack_systems(result: Configured, parts: list[Reading]) -> Iterable[tuple[str, Id]]:
    count = 0
    for group, kind in GROUPS.items():
        own = [r for r in parts if r.row.key == f"trafo_stack[].{group}.id[]"]
        for reading in sorted(own, key=lambda reading: reading.indices[1]):
            id = id_of(str(reading.value))
            count += 1
            if id not in result.systems:
                what = f"the coordinate system {id} of the stack is not configured; it is left out"
                known = ", ".join(map(str, result.systems)) or "none"
                hint = f"configured ids (coordinate_system.def[].id): {known}"
                result.diagnostics.append(diagnostic("22166", reading.entry.value_span, what, hint))
            elif count > MOST_IN_STACK:
                what = f"a stack has at most {MOST_IN_STACK} coordinate systems; {id} is left out"
                result.diagnostics.append(diagnostic("22168", reading.entry.value_span, what))
            else:
                yield kind, id


def _start(result: Configured, reading: Reading) -> None:
    name = str(reading.value)
    if name in result.stacks:
        result.start = StackAtStart(name, reading.entry.value_span)
        return
    known = ", ".join(result.stacks) or "none"
    what = f"the transformation stack {name} for the program start is not configured"
    hint = f"configured (trafo_stack[].name): {known}"
    result.diagnostics.append(diagnostic("22169", reading.entry.value_span, what, hint))
