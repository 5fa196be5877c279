"""#TRAFO STACK: coordinate systems and a kinematics that are switched together.

Source: TF5200 programming manual, #TRAFO STACK; P-CHAN-00752 to -00757, P-CHAN-00831
"""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

from ncscope.channel.commands import systems, transformation
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.systems import ID_LENGTH, Id, text_of
from ncscope.diagnostics import Span
from ncscope.language import tree
from ncscope.machine import TransformationStack

MAX_STACKS = 5
MAX_SYSTEMS = 10
MAX_IN_GROUP = 5
GROUPS = ("BCS", "ACS", "CS")
"""Groups from bottom to top."""
KEYS = ("NAME", "KINSTEP1", "KINSTEP2", "ID", "GRP", "IDX")
_FORM = "write for example #TRAFO STACK DEF [NAME=S1 KINSTEP1=91 ID=test1 GRP=CS]"


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO STACK DEF [NAME=.. KINSTEP1=.. KINSTEP2=.. {ID=.. GRP=.. IDX=..}]"""
    items = _items(draft, command)
    name = _stack_name(draft, command, items, _FORM)
    stacks = draft.state.stacks
    if name not in stacks and len(stacks) >= MAX_STACKS:
        what = f"only {MAX_STACKS} transformation stacks can be defined"
        draft.fail("22175", command.span, what, f"use one of the names {', '.join(stacks)} again")
    steps = (_kinematics(draft, items, 0), _kinematics(draft, items, 1))
    stack = TransformationStack(name, _systems(draft, items), steps, draft.place)
    draft.state = draft.state.changed(stacks={**stacks, name: stack})


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO STACK ON [NAME=..]: all that was active goes, the systems of the stack come."""
    form = "write for example #TRAFO STACK ON [NAME=S1]"
    items = _items(draft, command)
    name = _stack_name(draft, command, items, form)
    stacks = draft.state.stacks
    if name not in stacks:
        what = f"the transformation stack {name} does not exist; there are: "
        span = next(item.span for item in items if item.key == "NAME")
        draft.fail("22169", span, what + (", ".join(stacks) or "none"))
    activate(draft, command, stacks[name])


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#TRAFO STACK OFF: no coordinate system and no kinematics is active any more."""
    if command.groups:
        draft.fail("N1005", command.span, "#TRAFO STACK OFF takes no name")
    _clear(draft, command)


def activate(draft: Draft, command: tree.HashCommand, stack: TransformationStack) -> None:
    """Switches a stack on; the axes stay where they are."""
    _clear(draft, command)
    if any(stack.kinematics):
        kinematics = replace(draft.state.kinematics, ids=stack.kinematics)
        draft.state = draft.state.changed(kinematics=kinematics)
        transformation.on(draft, command)
    for kind, id in stack.systems:
        definition = systems.stored(draft, command.span, kind, id)
        systems.activate(draft, command.span, definition)


def activate_at_start(draft: Draft, span: Span, stack: TransformationStack) -> None:
    """Switches a stack on before the first block; `span` is the entry of the list."""
    activate(draft, tree.HashCommand("TRAFO STACK ON", (), (), (), None, True, span), stack)


def _clear(draft: Draft, command: tree.HashCommand) -> None:
    transformation.off(draft, command)
    coordinates = draft.state.coordinates
    for level in coordinates.levels:
        if level.temporary:
            systems.forget(draft, level.kind, level.id)
    bare = replace(coordinates, levels=coordinates.levels[:1])
    draft.set_coordinates(bare, command.span)
    draft.state = draft.state.changed(selected=0)


# --- how a stack is written --------------------------------------------------------------------


def _items(draft: Draft, command: tree.HashCommand) -> list[tree.Item]:
    items = [item for group in command.groups for item in group.items]
    for item in items:
        if item.key not in KEYS:
            what = f"{item.span.text.strip()} does not belong to a transformation stack"
            draft.fail("N1005", item.span, what, _FORM)
    return items


def _stack_name(draft: Draft, command: tree.HashCommand, items: list[tree.Item], form: str) -> str:
    item = next((item for item in items if item.key == "NAME"), None)
    if item is None:
        draft.fail("22172", command.span, "the name of the transformation stack is missing", form)
    name = str(_word(draft, item))
    if len(name) > ID_LENGTH:
        what = f"the name {name} is too long: it has at most {ID_LENGTH} characters"
        draft.fail("N1005", item.span, what)
    return name


def _kinematics(draft: Draft, items: list[tree.Item], step: int) -> int:
    """The id of the kinematics of a step, 0 where none is given."""
    item = next((item for item in items if item.key == f"KINSTEP{step + 1}"), None)
    if item is None:
        return 0
    id = _whole(draft, item)
    known = draft.state.kinematics.sets(step)
    if id and id not in known:
        has = ", ".join(str(i) for i in sorted(known)) or "none"
        draft.fail("22174", item.span, f"kinematics {id} is not configured; configured: {has}")
    return id


def _systems(draft: Draft, items: list[tree.Item]) -> tuple[tuple[str, Id], ...]:
    """The coordinate systems from bottom to top; ID, GRP and IDX belong together."""
    groups: dict[str, dict[int, Id]] = {group: {} for group in GROUPS}
    for part in _triplets(items):
        _place(draft, groups, part)
    return tuple(
        (f"#{group}", held[index]) for group, held in groups.items() for index in sorted(held)
    )


def _triplets(items: list[tree.Item]) -> list[dict[str, tree.Item]]:
    parts: list[dict[str, tree.Item]] = []
    for item in items:
        if item.key not in ("ID", "GRP", "IDX"):
            continue
        if not parts or item.key in parts[-1]:
            parts.append({})
        parts[-1][item.key] = item
    return parts


def _place(draft: Draft, groups: dict[str, dict[int, Id]], part: dict[str, tree.Item]) -> None:
    last = list(part.values())[-1].span
    if "ID" not in part or "GRP" not in part:
        _incomplete(draft, last, "a coordinate system of a stack needs ID=.. and GRP=..")
    group = str(_word(draft, part["GRP"])).upper()
    if group not in groups:
        _incomplete(draft, part["GRP"].span, f"{group} is no group: there are CS, ACS and BCS")
    held = groups[group]
    free = next(i for i in range(MAX_IN_GROUP + 1) if i not in held)
    index = _whole(draft, part["IDX"]) if "IDX" in part else free
    if index in held or not 0 <= index < MAX_IN_GROUP:
        _incomplete(draft, last, f"place {index} of the group {group} is not free")
    if sum(map(len, groups.values())) >= MAX_SYSTEMS:
        _incomplete(draft, last, f"a stack has at most {MAX_SYSTEMS} coordinate systems")
    id = _word(draft, part["ID"])
    if id not in draft.machine.systems:
        known = ", ".join(map(str, draft.machine.systems)) or "none"
        what = f"coordinate system {id} is not configured; configured: {known}"
        hint = "only systems of the channel list can be used (coordinate_system.def[].id)"
        draft.fail("22173", part["ID"].span, what, hint)
    held[index] = id


def _incomplete(draft: Draft, span: Span, message: str) -> NoReturn:
    draft.fail("22170", span, message, _FORM)


def _word(draft: Draft, item: tree.Item) -> Id:
    """A name, or a whole number."""
    if isinstance(item.value, (tree.Name, tree.Text)):
        return text_of(item.value)
    return _whole(draft, item)


def _whole(draft: Draft, item: tree.Item) -> int:
    if item.value is None or isinstance(item.value, tree.Name):
        draft.fail("N1005", item.span, f"{item.key} needs a number", _FORM)
    return round(evaluate_number(draft, item.value))


COMMANDS = {"TRAFO STACK DEF": define, "TRAFO STACK ON": on, "TRAFO STACK OFF": off}
