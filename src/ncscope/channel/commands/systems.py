"""#CS, #ACS and #BCS DEF, ON, OFF: coordinate systems that stack.

Each kind counts its own ids. A configured system (P-CHAN-00490) can be used by all three kinds.
Source: definition of #CS; TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from ncscope.channel.draft import Draft
from ncscope.channel.state import SystemDefinition
from ncscope.channel.systems import FORM, Id, active, frame, identifier, link, unlink, values
from ncscope.coordinates import Level
from ncscope.diagnostics import Span
from ncscope.language import tree

MAX_DEFINITIONS = 5


def _kind(command: tree.HashCommand) -> str:
    """`#ACS` for `#ACS ON`."""
    return "#" + command.name.split(" ")[0]


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#CS DEF [id] [v1,v2,v3,f1,f2,f3]"""
    id, numbers = _arguments(draft, command)
    if numbers is None:
        draft.fail("20675", command.span, f"{_kind(command)} DEF needs a shift and angles", FORM)
    _store(draft, command, id, numbers, temporary=False)


def on(draft: Draft, command: tree.HashCommand) -> None:
    """#CS ON [id] [..] | #CS ON [..] | #CS ON [id] | #CS ON"""
    id, numbers = _arguments(draft, command)
    if numbers is not None:
        definition = _store(draft, command, id, numbers, temporary=id is None)
    else:
        definition = stored(draft, command.span, _kind(command), id)
    activate(draft, command.span, definition)


def activate(draft: Draft, span: Span, definition: SystemDefinition) -> None:
    """Links a stored system to the chain, as #CS ON does."""
    name = f"{definition.kind} {definition.id}"
    level = Level(
        name,
        definition.kind,
        frame(draft, name, definition.values),
        id=definition.id,
        temporary=definition.temporary,
        origin=definition.origin,
    )
    link(draft, span, level)


def off(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF: the system of this kind that was activated last, with the offsets in it."""
    kind = _kind(command)
    if command.groups:
        what = f"{kind} OFF takes no id: only the last system can be switched off"
        draft.fail("20675", command.span, what)
    _deactivate(draft, command.span, kind, 1)


def off_all(draft: Draft, command: tree.HashCommand) -> None:
    """#CS OFF ALL"""
    kind = _kind(command)
    _deactivate(draft, command.span, kind, len(active(draft, kind)))


def _deactivate(draft: Draft, span: Span, kind: str, count: int) -> None:
    held = active(draft, kind)
    if not held:
        what = f"no coordinate system is active; {kind} OFF does nothing"
        draft.warn("20824", span, what)
        return
    levels = draft.state.coordinates.levels
    places = [k for k, level in enumerate(levels) if level.kind == kind][-count:]
    unlink(draft, span, places)
    for level in held[-count:]:
        if level.temporary:
            forget(draft, kind, level.id)


def _arguments(
    draft: Draft, command: tree.HashCommand
) -> tuple[Id | None, tuple[float, ...] | None]:
    """Id and values; a bracket with one number is an id, with commas it is a definition."""
    groups = command.groups
    if len(groups) > 2:
        draft.fail("20675", groups[2].span, "there are too many brackets", FORM)
    if not groups:
        return None, None
    if len(groups) == 2:
        return identifier(draft, groups[0]), values(draft, groups[1])
    if len(groups[0].cells) == 1:
        return identifier(draft, groups[0]), None
    return None, values(draft, groups[0])


# --- definitions -------------------------------------------------------------------------------


def _store(
    draft: Draft,
    command: tree.HashCommand,
    id: Id | None,
    numbers: tuple[float, ...],
    temporary: bool,
) -> SystemDefinition:
    kind = _kind(command)
    held = _definitions(draft, kind)
    if id is None:
        id = next(i for i in range(1, len(held) + 2) if i not in held)
    if any(level.id == id for level in active(draft, kind)):
        draft.fail(
            "20825",
            command.span,
            f"coordinate system {id} is active and cannot be defined anew",
            f"switch it off first ({kind} OFF)",
        )
    if id not in held and len(held) >= MAX_DEFINITIONS:
        what = f"only {MAX_DEFINITIONS} coordinate systems can be defined"
        draft.fail("21234", command.span, what, f"use one of the ids {_listed(held)} again")
    definition = SystemDefinition(kind, id, numbers, draft.place, temporary)
    forget(draft, kind, id)
    definitions = {**draft.state.definitions, (kind, id): definition}
    draft.state = draft.state.changed(definitions=definitions)
    return definition


def _definitions(draft: Draft, kind: str) -> dict[Id, SystemDefinition]:
    """The stored systems of a kind by id, in the order of their definition."""
    return {id: d for (k, id), d in draft.state.definitions.items() if k == kind}


def forget(draft: Draft, kind: str, id: Id) -> None:
    """Without the stored definition, if there is one."""
    kept = {key: d for key, d in draft.state.definitions.items() if key != (kind, id)}
    draft.state = draft.state.changed(definitions=kept)


def stored(draft: Draft, span: Span, kind: str, id: Id | None) -> SystemDefinition:
    """What the program defined, else what the channel list configures under this id."""
    held = _definitions(draft, kind)
    if id is None:
        if not held:
            draft.fail("20821", span, "no coordinate system has been defined", FORM)
        return list(held.values())[-1]
    if id in held:
        return held[id]
    configured = draft.machine.systems
    if id not in configured:
        known = _listed([*held, *(i for i in configured if i not in held)])
        what = f"coordinate system {id} is not defined; defined: {known or 'none'}"
        draft.fail("20821", span, what, FORM)
    return SystemDefinition(kind, id, configured[id].values, configured[id].origin)


def _listed(ids) -> str:
    return ", ".join(map(str, sorted(ids, key=lambda id: (isinstance(id, str), id))))


_VERBS = {"DEF": define, "ON": on, "OFF": off, "OFF ALL": off_all}
COMMANDS = {
    f"{kind} {verb}": rule for kind in ("CS", "ACS", "BCS") for verb, rule in _VERBS.items()
}
