"""The loop lane: compiled steps of blocks that are executed again and again.

Enters the walker and the state. Leaves both some blocks further, with the moves as stretches. The
meaning is that of the step lane, block by block: whatever a compiled step cannot do, and every
mistake, is left to it. Axis positions are computed many at a time; where that fails, the blocks
since the last computation are made again by the step lane.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ncscope.channel.flow import Walker
from ncscope.channel.loop_plans import LoopState, Step, StepLane, Units, plan
from ncscope.channel.state import Modal, Position, State
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError
from ncscope.language.functions import NoValue
from ncscope.language.structure import Layout
from ncscope.motion import LINEAR, MOTIONS
from ncscope.trajectory import NO_BLOCK, Stretch

CHUNK = 4096
"""Moves between two computations of axis positions."""
MOST_ENTRIES = 50_000
"""Entries of one visit: whoever watches the run is asked in between."""
HOT = 2
"""Executions of a block by the step lane before it is compiled."""
SHORTEST = 8
"""Blocks that a visit should bring; blocks where it brings less are left to the step lane."""
PATIENCE = 3
FREE = ("motion", "plane", "absolute", "inch", "feed", "feed_warned", "radius", "centre_absolute",
        "centre_fits", "corner_size")  # fmt: skip
"""Modal values that do not change what a straight motion means, or that this lane knows."""


NOT_MADE = (StepLane, NoValue, ArithmeticError, ValueError, LookupError)
"""What a compiled step raises that the step lane has to make."""


@dataclass(frozen=True, slots=True)
class Visited:
    """An entry without motion: the values that `explain` of its line shows."""

    at: int
    block: int | None
    program: Array
    axes: Array


@dataclass(frozen=True, slots=True)
class Piece:
    """What the lane did: executed entries, the state behind them, moves and visited entries."""

    count: int
    state: State
    stretch: Stretch | None = None
    visits: tuple[Visited, ...] = ()


class _Plans:
    """The compiled steps of one layout for one channel configuration.

    layout is kept, because plans are found by its identity.
    """

    def __init__(self, layout: Layout, units: Units) -> None:
        self.layout, self.units = layout, units
        self.steps: list[Step | None] = [None] * len(layout.entries)
        self.heat = [0] * len(layout.entries)
        self._lines: dict[int, int] = {}

    def line(self, layout: Layout, at: int) -> int:
        """The source line of an entry."""
        line = self._lines.get(at)
        if line is None:
            line = self._lines[at] = layout.entries[at].block.span.line
        return line


class LoopLane:
    """Compiled steps of all layouts of a run, and which blocks are worth it."""

    def __init__(self) -> None:
        self._plans: dict[tuple[int, Units], _Plans] = {}
        self._short: dict[tuple[int, int], int] = {}

    def advance(self, walker: Walker, state: State, limit: int) -> Piece | None:
        """Makes steps from the next entry of the walker on; None where it is for the step lane.

        limit: most entries to execute. Whatever happens here is as if the step lane had made it.
        """
        layout, at = walker.layout, walker.at
        here = (id(layout), at)
        if self._short.get(here, 0) >= PATIENCE or not _is_plain(state):
            return None
        plans = self._of(layout, state)
        if plans is None or self._step(plans, layout, at) is None:
            return None
        piece = self._run(walker, plans, state, limit)
        if piece is None or piece.count < SHORTEST:
            self._short[here] = self._short.get(here, 0) + 1
        return piece

    def _of(self, layout: Layout, state: State) -> _Plans | None:
        units = _units(state)
        key = (id(layout), units)
        if key not in self._plans:
            if len(self._plans) > 100:
                return None
            self._plans[key] = _Plans(layout, units)
        return self._plans[key]

    def _step(self, plans: _Plans, layout: Layout, at: int) -> Step | None:
        """The compiled step of a block that has been executed often enough."""
        heat = plans.heat[at]
        if heat > HOT:
            return plans.steps[at]
        plans.heat[at] = heat + 1
        if heat == HOT:
            plans.steps[at] = plan(layout, at, plans.units)
        return plans.steps[at]

    def _run(self, walker: Walker, plans: _Plans, state: State, limit: int) -> Piece | None:
        """Some entries; again with fewer moves where the axis positions of one are not found."""
        passes, at, most = dict(walker.passes), walker.at, CHUNK
        while most > 0:
            loop = _entered(walker, state)
            count, walker.at = self._repeat(walker, plans, loop, min(limit, MOST_ENTRIES), most)
            if count == 0:
                return None
            program, axes, good = _axes(state, loop)
            if good == len(loop.rows):
                return _left(plans, walker.layout, state, loop, program, axes, count)
            walker.at, most = at, good
            walker.passes.clear()
            walker.passes.update(passes)
        return None

    def _repeat(
        self, walker: Walker, plans: _Plans, loop: LoopState, limit: int, most: int
    ) -> tuple[int, int]:
        """Executed entries, and the entry where the step lane goes on."""
        layout, at, count = walker.layout, walker.at, 0
        (first, stop), steps, rows = walker.level, plans.steps, loop.rows
        while count < limit and len(rows) < most and first <= at < stop:
            step = steps[at] or self._step(plans, layout, at)
            if step is None:
                break
            try:
                at = step(loop)
            except NOT_MADE:
                break
            count += 1
        return count, at


def _is_plain(state: State) -> bool:
    """Whether straight motions mean what the compiled steps make of them."""
    modes = state.modal
    if modes.motion not in MOTIONS[:LINEAR] or state.running.modal is not None:
        return False
    return all(getattr(modes, name) == value for name, value in _OTHER_MODES)


_OTHER_MODES = tuple(
    (name, getattr(Modal(), name)) for name in Modal.__dataclass_fields__ if name not in FREE
)


def _units(state: State) -> Units:
    axes = tuple((a.name, i) for i, a in enumerate(state.axes) if a.modulo_range is None)
    factors = tuple(state.unit(i) for i in range(len(state.axes)))
    return Units(axes, factors, state.modal.length_factor)


def _entered(walker: Walker, state: State) -> LoopState:
    modes = state.modal
    plain = {
        key: stored.value
        for key, stored in state.variables.items()
        if stored.type == "REAL64" and isinstance(stored.value, float) and key[:4] != "V.E."
    }
    return LoopState(
        plain,
        state.position.program.tolist(),
        walker.passes,
        MOTIONS.index(modes.motion),
        modes.absolute,
        modes.feed,
        modes.feed_warned,
        state.block,
    )


def _axes(state: State, loop: LoopState) -> tuple[Array, Array, int]:
    """Programmed values, axis positions, and how many moves before the first that has none."""
    near = state.position.axes
    program = np.array(loop.rows, dtype=float).reshape(len(loop.rows), len(near))
    if not len(program):
        return program, program, 0
    try:
        axes = state.coordinates.to_axes(program, near=near)
    except KinematicsError as error:
        return program, program, min(error.rows)
    wild = np.flatnonzero(~np.isfinite(axes).all(axis=1))
    return program, axes, int(wild[0]) if len(wild) else len(axes)


def _left(
    plans: _Plans, layout: Layout, state: State, loop: LoopState, program: Array, axes: Array,
    count: int,
) -> Piece:  # fmt: skip
    stretch = None
    if loop.rows:
        at, motion, feed, block = zip(*loop.info, strict=True)
        stretch = Stretch(
            state.coordinates,
            state.axis_names,
            layout.source.name,
            np.array([plans.line(layout, i) for i in at], dtype=np.int64),
            np.array([NO_BLOCK if b is None else b for b in block], dtype=np.int64),
            np.array(motion, dtype=np.int8),
            np.array([np.nan if f is None else f for f in feed], dtype=float),
            program,
            axes,
            state.position.axes,
        )
    visits = tuple(
        Visited(i, number, *_place(state, program, axes, n))
        for i, (n, number) in loop.visits.items()
    )
    return Piece(count, _state_after(state, loop, program, axes), stretch, visits)


def _place(state: State, program: Array, axes: Array, moves: int) -> tuple[Array, Array]:
    """Programmed values and axis positions behind so many moves."""
    if moves == 0:
        return state.position.program, state.position.axes
    return program[moves - 1].copy(), axes[moves - 1].copy()


def _state_after(state: State, loop: LoopState, program: Array, axes: Array) -> State:
    variables = dict(state.variables)
    for key, value in loop.v.items():
        old = variables[key]
        if old.value != value:
            variables[key] = old._replace(value=value)
    modal = replace(
        state.modal, motion=MOTIONS[loop.motion], absolute=loop.absolute, feed=loop.feed
    )
    position = Position(*reversed(_place(state, program, axes, len(program))))
    return state.changed(variables=variables, modal=modal, position=position, block=loop.block)
