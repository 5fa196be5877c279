"""G100, G106, G101, G102: measured positions and the offset made of them.

The answers of the probe are given as rows (`--probe`), one for each measuring run: the value that
V.A.MESS reads at the contact. Without them the probe triggers at the target, so the measured
offset is 0, and a note says so.
Source: TF5200 measuring functions; TF5200 coordinate systems and offsets; P-CHAN-00057.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.given import GivenRow
from ncscope.channel.state import Measured, Position, State
from ncscope.coordinates import Offset
from ncscope.diagnostics import Span

if TYPE_CHECKING:
    from ncscope.channel.words import Words

SINGLE, THROUGH, MAIN_AXES = 2, 3, 4
INTERRUPTIBLE = (5, 6)
LAST_TYPE = 7


class Run(NamedTuple):
    """A measuring run that begins. through: the motion goes on to its target (G106)."""

    span: Span
    through: bool
    start: Position


def begin(draft: Draft, words: Words) -> Run:
    """G100 with its axes, checked against the measuring type."""
    span = words.gfunctions.pop(100).span
    if not words.axes:
        draft.fail("N2025", span, "G100 needs at least one axis with its target")
    kind = draft.state.measuring.type
    if not 1 <= kind <= LAST_TYPE:
        what = f"measuring type {kind} does not exist; types are 1 to {LAST_TYPE}"
        draft.fail("20138", span, what, "set P-CHAN-00057, or write #MEAS [TYPE=1]")
    if kind in INTERRUPTIBLE:
        what = f"measuring type {kind} (interruptible) is not supported"
        draft.fail("N2001", span, what)
    through = words.gfunctions.pop(106, None)
    if through is not None and kind != THROUGH:
        what = f"G106 needs measuring type {THROUGH}; the type is {kind}"
        draft.fail("20772", through.span, what, f"write #MEAS [TYPE={THROUGH}] before it")
    _check_axes(draft, words, kind)
    return Run(span, through is not None, draft.state.position)


def _check_axes(draft: Draft, words: Words, kind: int) -> None:
    places = [place for _, place in words.axes.values()]
    most = {SINGLE: 1, MAIN_AXES: 3}.get(kind, len(places))
    if len(places) > most:
        what = f"measuring type {kind} measures with {most} axes at most"
        draft.fail("50061", places[most], what.replace("1 axes", "one axis"))
    for index, (_, place) in words.axes.items():
        axis = draft.state.axes[index]
        if kind == MAIN_AXES and index > 2:
            what = f"measuring type {kind} measures with the main axes only, not with {axis.name}"
            draft.fail("20138", place, what)
        if not axis.measuring:
            what = f"axis {axis.name} is not marked as a measuring axis"
            hint = f"set kenngr.messachse of axis {axis.number} to 1 (P-AXIS-00118)"
            draft.fail("50059", place, what, hint)


def record(draft: Draft, axes: Iterable[int], run: Run) -> None:
    """After the motion of G100 to its target: the axes stop where the probe triggered."""
    names = {axis: draft.state.axis_names[axis] for axis in axes}
    if draft.state.probe is None:
        draft.warn("N2024", run.span, "no probe answers here: it triggers at the target of G100")
        return _remember(draft, names, draft.state.position, draft.state.position)
    row = _answer(draft, names, run.span)
    if not row.values:
        return _no_signal(draft, names, run.span)
    target, target_move = draft.state.position, draft.moves[-1]
    contact = _contact(draft.state, {axis: row.values[name] for axis, name in names.items()})
    _go_back(draft, run.start)
    draft.move_to(contact, run.span)
    _remember(draft, names, draft.state.position, target)
    if run.through:
        _go_back(draft, target)
        draft.moves.append(target_move)
    return None


def _go_back(draft: Draft, position: Position) -> None:
    draft.moves.pop()
    draft.state = draft.state.changed(position=position)


def _answer(draft: Draft, names: Mapping[int, str], span: Span) -> GivenRow:
    """The next row of the probe; it answers for the axes of this run and for no other."""
    given = draft.state.probe
    assert given is not None
    row = given.next
    if row is None:
        count = len(given.rows)
        what = f"{given.name} has no row for this measuring run; it has {count} rows"
        draft.fail("N2042", span, what, "add a row with the positions of the contact")
    draft.state = draft.state.changed(probe=given.taken())
    for name, cell in row.cells.items():
        if name not in names.values():
            what = f"{cell.place} has a value for axis {name}, which this block does not measure"
            draft.fail("N2043", span, what, notes=(("the value", cell),))
    missing = [name for name in names.values() if name not in row.values]
    if row.values and missing:
        what = f"{row.span.place} has no value for axis {missing[0]}, which this block measures"
        draft.fail("N2043", span, what, notes=(("the row", row.span),))
    return row


def _no_signal(draft: Draft, names: Mapping[int, str], span: Span) -> None:
    """The run ends at its target without a measured value."""
    measuring = draft.state.measuring
    if measuring.type == SINGLE or measuring.must_answer:
        draft.fail("N2041", span, "the probe gave no signal in this measuring run")
    kept = {n: m for n, m in draft.state.measured.items() if n not in names.values()}
    draft.state = draft.state.changed(measured=kept)


def _is_plain(state: State) -> bool:
    """Measured values are axis positions; in a coordinate system or kinematics programmed ones."""
    chain = state.coordinates
    return len(chain.levels) == 1 and chain.kinematics is None


def _contact(state: State, values: Mapping[int, float]) -> np.ndarray:
    """Programmed values (n,) where the probe triggers, from the position at the target."""
    plain = _is_plain(state)
    point = np.array(state.position.axes if plain else state.position.program)
    for axis, value in values.items():
        point[axis] = value
    return state.coordinates.to_program(point) if plain else point


def _remember(draft: Draft, names: Mapping[int, str], contact: Position, target: Position) -> None:
    plain = _is_plain(draft.state)
    value, wanted = (p.axes if plain else p.program for p in (contact, target))
    new = {
        name: Measured(
            float(value[axis]),
            float(value[axis] - wanted[axis]),
            float(contact.program[axis]),
            float(contact.axes[axis]),
        )
        for axis, name in names.items()
    }
    draft.state = draft.state.changed(measured={**draft.state.measured, **new})


def offset(draft: Draft, words: Words) -> None:
    """G101 X1: include factor times (measured - target); G102: take it out."""
    if 106 in words.gfunctions and 100 not in words.gfunctions:
        span = words.gfunctions[106].span
        draft.fail("N2003", span, "G106 is not used by any command in this block", "write G100 too")
    for number in (101, 102):
        if number in words.gfunctions:
            rule = _include if number == 101 else _exclude
            rule(draft, words, words.gfunctions[number].span)
            words.axes.clear()


def _include(draft: Draft, words: Words, span: Span) -> None:
    if not words.axes:
        draft.fail("N2025", span, "G101 needs an axis with its factor", "write for example G101 X1")
    values = {}
    for axis, (factor, place) in words.axes.items():
        name = draft.state.axis_names[axis]
        if name not in draft.state.measured:
            what = f"axis {name} has not been measured"
            draft.fail("N2025", place, what, f"write G100 {name}.. before it")
        values[axis] = factor * draft.state.measured[name].offset
    draft.state = with_measured(draft.state, values, draft.place)


def _exclude(draft: Draft, words: Words, span: Span) -> None:
    held = draft.state.coordinates.levels[0].offset("measure")
    included = {i for i, o in enumerate(held.origins) if o} if held else set()
    for axis, (_, place) in words.axes.items():
        if axis not in included:
            name = draft.state.axis_names[axis]
            draft.fail("N2025", place, f"axis {name} has no measuring offset that G102 could end")
    axes = set(words.axes) or included
    draft.state = with_measured(draft.state, dict.fromkeys(axes, 0.0), None)


def with_measured(state: State, values: Mapping[int, float], place: str | None) -> State:
    """The measuring offset of these axes, mm and degrees, in the workpiece level; nothing moves.

    place: None takes the offset out.
    """
    base, *rest = state.coordinates.levels
    n = len(state.axes)
    held = base.offset("measure") or Offset("G101", (0.0,) * n, (None,) * n)
    new, origins = list(held.values), list(held.origins)
    for axis, value in values.items():
        new[axis], origins[axis] = value, place
    offset = replace(held, values=tuple(new), origins=tuple(origins)) if any(origins) else None
    levels = (base.with_offset("measure", offset), *rest)
    coordinates = replace(state.coordinates, levels=levels)
    return state.with_coordinates(coordinates, keep="axes" if rest else "level")
