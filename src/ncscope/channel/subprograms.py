"""Subprograms: found, entered and left.

Enters the walker of a program and the requests of a block. Leaves the walker in the subprogram, or
back behind the call, and the state with what a return brings back.
Source: TF5200 programming manual; P-CHAN-00210 (modal state behind a cycle).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ncscope.channel import contour, offsets
from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.state import CallRequest, Return, Running, State, Stored
from ncscope.channel.unfolding import unfold
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.language import tree
from ncscope.language.structure import Layout, Level

if TYPE_CHECKING:
    from ncscope.channel.flow import Walker

Load = Callable[[str], Source | None]
Found = tuple[Diagnostic, ...]
MOST_CALLS = 20
"""Deepest nesting of subprogram calls."""
LEVEL_GROUPS = ("V.L.", "V.CYC.")
"""Variables that belong to a program level."""


@dataclass(frozen=True, slots=True)
class Frame:
    """Where a call came from, and what the return brings back.

    at: the block behind the call. request: what was called. waiting: further calls of the same
    block. then: what that block does behind its calls: a return, or the end of the program.
    before: the state at the call. left: passes of a sequence that are still to run.
    """

    layout: Layout
    level: Level
    at: int
    request: CallRequest
    waiting: tuple[CallRequest, ...]
    then: Return | str
    before: State
    left: int = 0


@dataclass(frozen=True, slots=True)
class Passage:
    """The state behind a call or return. ended: the program has come to its end."""

    state: State
    diagnostics: Found = ()
    ended: bool = False


def call(
    walker: Walker, state: State, requests: tuple[CallRequest, ...], then: Return | str = ""
) -> Passage:
    """Enters the first of the subprograms; the others follow when it returns."""
    draft = Draft(walker.machine, state, requests[0].span)
    try:
        _enter(walker, draft, requests[0], requests[1:], then, requests[0].repeat - 1)
    except BlockError as error:
        return Passage(state, (*draft.diagnostics, error.diagnostic))
    return Passage(draft.state, tuple(draft.diagnostics))


def leave(walker: Walker, state: State, order: Return | None = None) -> Passage:
    """Back to the line behind the call, or as far as the brackets of M17 say."""
    span = order.span if order is not None else walker.calls[-1].request.span
    draft = Draft(walker.machine, state, span)
    draft.diagnostics.extend(walker.open_warnings())
    try:
        if order is not None and (order.levels != 1 or order.label):
            return _leave_far(walker, draft, order)
        return _leave_one(walker, draft, span)
    except BlockError as error:
        return Passage(state, (*draft.diagnostics, error.diagnostic))


def _leave_far(walker: Walker, draft: Draft, order: Return) -> Passage:
    count = order.levels or len(walker.calls)
    if count > len(walker.calls):
        what = f"M17 cannot leave {count} levels: there are {len(walker.calls)}"
        draft.fail("N1005", order.span, what)
    for _ in range(count):
        _pop(walker, draft, order.span)
    if order.label:
        walker.at = walker.find_label(draft, order.label, order.span)
    return Passage(draft.state, tuple(draft.diagnostics))


def _leave_one(walker: Walker, draft: Draft, span: Span) -> Passage:
    frame = _pop(walker, draft, span)
    if frame.left:
        _enter(walker, draft, frame.request, frame.waiting, frame.then, frame.left - 1)
    elif frame.waiting:
        first, *rest = frame.waiting
        _enter(walker, draft, first, tuple(rest), frame.then, first.repeat - 1)
    elif isinstance(frame.then, Return):
        found = tuple(draft.diagnostics)
        passage = leave(walker, draft.state, frame.then)
        return replace(passage, diagnostics=found + passage.diagnostics)
    return Passage(draft.state, tuple(draft.diagnostics), frame.then == "end" and not frame.waiting)


def _pop(walker: Walker, draft: Draft, span: Span) -> Frame:
    """The walker behind the call, and the state with what belongs to the caller."""
    frame = walker.calls.pop()
    walker.layout, walker.level, walker.at = frame.layout, frame.level, frame.at
    inner, outer = draft.state.running, frame.before.running
    state = _without_level(draft.state, inner.level)
    draft.state = state.changed(running=replace(outer, modal=inner.modal))
    keeps = inner.retain or draft.machine.settings.cycle_changes_stay
    if frame.request.parameters is not None and not keeps:
        _restore(draft, frame.before, span)
    return frame


def _restore(draft: Draft, before: State, span: Span) -> None:
    """The modal functions as they were before the cycle; offset and axis values stay.

    Zero offset and mirror come back where the coordinate systems are those of the call.
    """
    if draft.modes.plane != before.modal.plane:
        contour.plane(draft, before.modal.plane, span)
        draft.state = offsets.with_tool(draft.state, draft.state.tool)
    draft.modal(**_modes(before, draft.state))
    old, new = before.coordinates, draft.state.coordinates
    same = len(old.levels) == len(new.levels) and before.suspended is draft.state.suspended
    if not same or draft.state.axes is not before.axes:
        return
    if draft.state.zero_index != before.zero_index:
        held = old.top.offset("zero")
        place = held.selected_at if held is not None and held.selected_at else draft.place
        draft.state = offsets.select_zero(draft.state, before.zero_index, place)
    if (old.contour.mirror, old.contour.mirror_shift) != (
        new.contour.mirror,
        new.contour.mirror_shift,
    ):
        mirror = {
            name: getattr(old.contour, name) for name in ("mirror", "mirror_shift", "mirror_origin")
        }
        contour.set_contour(draft, replace(draft.state.coordinates.contour, **mirror))


def _modes(before: State, after: State) -> dict:
    """The modal values at the call; that a warning was given is not forgotten."""
    names = before.modal.__dataclass_fields__
    values = {name: getattr(before.modal, name) for name in names}
    values["feed_warned"] = after.modal.feed_warned
    return values


def _without_level(state: State, level: int) -> State:
    """Without the variables of a program level; those that they hid appear again."""
    own = [
        key
        for key, stored in state.variables.items()
        if stored.level == level and key.startswith(LEVEL_GROUPS)
    ]
    if not own:
        return state
    variables = dict(state.variables)
    for key in own:
        outer: Stored | None = variables[key].outer
        if outer is None:
            del variables[key]
        else:
            variables[key] = outer
    return state.changed(variables=variables)


# --- entering ----------------------------------------------------------------------------------


def _enter(
    walker: Walker,
    draft: Draft,
    request: CallRequest,
    waiting: tuple[CallRequest, ...],
    then: Return | str,
    left: int,
) -> None:
    if len(walker.calls) >= MOST_CALLS:
        message = f"subprogram calls are nested more than {MOST_CALLS} deep"
        draft.fail("20371", request.span, message)
    aim, level, at = _found(walker, draft, request)
    frame = Frame(walker.layout, walker.level, walker.at, request, waiting, then, draft.state, left)
    walker.calls.append(frame)
    old = draft.state.running
    running = Running(
        old.level + 1,
        aim.source.name,
        old.parameters if request.parameters is None else request.parameters,
        old.modal,
        old.in_modal or bool(request.modal),
    )
    draft.state = draft.state.changed(running=running)
    walker.layout, walker.level, walker.at = aim, level, at


def _found(walker: Walker, draft: Draft, request: CallRequest) -> tuple[Layout, Level, int]:
    """The source, its part that runs, and the first block."""
    if request.kind == "SEQUENCE":
        return _sequence(walker, draft, request)
    aim, level = (
        _local(walker, draft, request)
        if request.kind == "LL"
        else global_file(walker, draft, request)
    )
    return aim, level, level[0]


def _local(walker: Walker, draft: Draft, request: CallRequest) -> tuple[Layout, Level]:
    here = walker.layouts.get(request.home, walker.layout) if request.home else walker.layout
    level = here.subprograms.get(request.name)
    if level is None:
        has = ", ".join(sorted(here.subprograms)) or "none"
        message = f"the local subprogram {request.name} is not found; the file has: {has}"
        draft.fail("20373", request.span, message, f"write %L {request.name} before its blocks")
    return here, level


def global_file(walker: Walker, draft: Draft, request: CallRequest) -> tuple[Layout, Level]:
    """The main part of a subprogram file; read once."""
    name = request.name
    found = walker.layouts.get(name)
    if found is None:
        source = walker.load(name) if walker.load is not None else None
        if source is None:
            hint = (
                "it must lie in the folder of the program, in one of --subprograms, or below them"
            )
            draft.fail("20369", request.span, f"the subprogram file {name} is not found", hint)
        found = walker.layouts[name] = walker.table(source)
        walker.layouts.setdefault(source.name, found)
    if found.diagnostics:
        raise BlockError(found.diagnostics[0])
    if found.main is None:
        draft.fail("20369", request.span, f"the file {name} has no blocks outside of %L")
    return found, found.main


def _sequence(walker: Walker, draft: Draft, request: CallRequest) -> tuple[Layout, Level, int]:
    """The blocks of a sequence as a level of its own, which ends behind its last block."""
    unfold(walker)  # it may begin and end at any block
    aim, level = walker.layout, _whole(walker.layout, walker.level)
    if request.name:
        aim, level = global_file(walker, draft, request)
    first = _marked(draft, aim, level, request, request.first)
    stop = level[1]
    if request.last:
        stop = _marked(draft, aim, level, request, request.last) + 1
    own = next((i for i, e in enumerate(aim.entries) if _holds(e.block.span, request.span)), None)
    if request.endtag and own is not None and first <= own < stop:
        stop = own
    if stop <= first:
        message = f"{request.last} stands before {request.first}"
        draft.fail("N1005", request.span, message)
    return aim, (level[0], stop), first


def _whole(aim: Layout, level: Level) -> Level:
    """The level of a program or subprogram of which a sequence runs a part."""
    levels = [*([aim.main] if aim.main else []), *aim.subprograms.values()]
    return next((whole for whole in levels if whole[0] == level[0]), level)


def _holds(block: Span, part: Span) -> bool:
    return block.source is part.source and block.start <= part.start < block.end


def _marked(draft: Draft, aim: Layout, level: Level, request: CallRequest, mark: str) -> int:
    """The block with this label, or with this block number."""
    found = aim.labels.get((level[0], mark))
    if found is not None:
        return found
    for at in range(*level):
        if f"N{_number(draft, aim.entries[at].block)}" == mark:
            return at
    draft.fail("20840", request.span, f"the block {mark} is not found in {aim.source.name}")


def _number(draft: Draft, block: tree.Block) -> int | None:
    """The block number as it is now; None without one, or where it has no value yet."""
    if block.number is None:
        return None
    try:
        return round(evaluate_number(draft, block.number))
    except BlockError:
        return None


def nesting_warning(span: Span) -> Diagnostic:
    """20377 for M30 inside a subprogram."""
    return diagnostic("20377", span, "the program ends inside a subprogram")


def return_in_main(span: Span) -> Diagnostic:
    """20376 for M17 or M29 in the main program."""
    hint = "the main program ends with M30"
    return diagnostic("20376", span, "M17 and M29 return from a subprogram", hint)
