"""A stretch of plain motion blocks in one step: the bulk lane.

The meaning is that of `block.execute`, block by block: words that are not programmed are filled
down, G91 is added up, and one call turns the whole stretch into axis positions. What the step
lane would say something about is cut off here and left to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ncscope.channel.modulo import way_to
from ncscope.channel.plain_arcs import ArcTerms, PlainArcs, arcs_among, radius_and_circle
from ncscope.channel.state import Position, State
from ncscope.compilation import compiled
from ncscope.diagnostics import Source
from ncscope.frames import Array
from ncscope.kinematics.step import KinematicsError
from ncscope.language import BlockReader
from ncscope.language.scanner import CHUNK, PlainRows, Scanner
from ncscope.levels import in_range
from ncscope.machine import Axis, ChannelSettings
from ncscope.motion import MOTIONS
from ncscope.motion.arcs import Arcs
from ncscope.trajectory import Stretch

FEWEST = 64
"""Rows that are scanned at least."""
WORTH = 8
"""Rows that are taken faster together than one by one."""
MOST_VAIN = 6
"""So many attempts in vain double the number of blocks that are left to the step lane."""


class Taken(NamedTuple):
    """Some plain blocks: their moves and the state behind them.

    ways: row -> where the path leads before modulo axes are wrapped, where that differs.
    arcs: the rows that are arcs. more: whether the next block may be a plain one too.
    """

    state: State
    stretch: Stretch
    ways: Mapping[int, Array]
    arcs: Arcs
    more: bool = False


class _Terms(NamedTuple):
    """What plain words mean while coordinates, axes and modal functions stay.

    factors (n,): millimetres or degrees of one programmed unit. ranges (n, 2): of modulo axes, NaN
    for others. wraps: whether there are any. held: what this was made for.
    """

    factors: Array
    ranges: Array
    wraps: bool
    arcs: ArcTerms | None
    held: tuple[object, ...]

    @classmethod
    def of(cls, state: State, settings: ChannelSettings) -> _Terms:
        n, active = len(state.axes), state.coordinates.kinematics
        directions = () if active is None else active.model.orientation
        ranges = np.full((n, 2), np.nan)
        for axis, low, high in state.coordinates.modulo.ranges:
            if axis not in directions:
                ranges[axis] = low, high
        wraps, factors = not np.isnan(ranges).all(), np.array([state.unit(i) for i in range(n)])
        return cls(factors, ranges, wraps, ArcTerms.of(state, settings), _held(state))


def _held(state: State) -> tuple[object, ...]:
    modes = state.modal
    rules = modes.plane, modes.inch, modes.centre_absolute, modes.centre_fits
    return id(state.coordinates), id(state.axes), *rules


class BulkLane:
    """Takes the plain blocks of one program."""

    def __init__(self, source: Source, settings: ChannelSettings) -> None:
        self._source, self._settings = source, settings
        self._axes: tuple[Axis, ...] = ()
        self._scanner: Scanner | None = None
        self._terms: tuple[_Terms, State] | None = None
        self._most, self._pause, self._vain = CHUNK, 0, 0

    def take(self, reader: BlockReader, state: State, limit: int | None) -> Taken | None:
        """The plain blocks where the reader stands, at most `limit`; None where the next block is
        for the step lane. The reader goes on behind them."""
        if not state.modal.plain or self._pauses():
            return None
        begin, most = reader.at, self._most
        first = self._source.position(begin)[0]
        rows = self._scanner_for(state).scan(begin, first, most)
        left = len(rows) if limit is None else min(len(rows), limit)
        taken = self._advance(state, rows, left) if left else None
        n = 0 if taken is None else len(taken.stretch)
        self._learn(n, len(rows), most)
        if taken is None:
            return None
        reader.skip_to(rows.end if n == len(rows) else int(rows.stops[n - 1]))
        if int(rows.line[n - 1]) - first == n - 1:  # every line is a row
            self._source.learn(begin, rows.stops[:n], first)
        return taken._replace(more=n == most)

    def _pauses(self) -> bool:
        self._pause -= self._pause > 0
        return self._pause > 0

    def _learn(self, taken: int, scanned: int, most: int) -> None:
        """How many rows are scanned next, and how many blocks are left to the step lane before:
        what is scanned and not taken is scanned once more."""
        if taken == scanned:
            self._most, self._vain = min(CHUNK, 2 * most), 0
            return
        self._most = min(CHUNK, max(FEWEST, 2 * taken))
        self._vain = 0 if taken >= WORTH else min(self._vain + 1, MOST_VAIN)
        self._pause = 2**self._vain

    def _scanner_for(self, state: State) -> Scanner:
        if self._scanner is None or self._axes is not state.axes:
            turning = [axis for axis, _, _ in state.coordinates.modulo.ranges]
            self._axes = state.axes
            self._scanner = Scanner(self._source.data, state.axis_names, turning)
        return self._scanner

    def _terms_for(self, state: State) -> _Terms:
        if self._terms is None or self._terms[0].held != _held(state):
            terms = _Terms.of(state, self._settings)
            self._terms = terms, state  # keeps what is known by its identity
        return self._terms[0]

    def _advance(self, state: State, rows: PlainRows, n: int) -> Taken | None:
        """The first n rows; the stretch says how many were taken, None stands for none."""
        terms = self._terms_for(state)
        motion = _filled_codes(rows.motion[:n], MOTIONS.index(state.modal.motion))
        absolute = _filled_codes(rows.absolute[:n], int(state.modal.absolute))
        feed = _filled_feed(state, rows.feed[:n])
        n = _before_warning(state, motion, feed, n)
        shortest = self._settings.modulo_shortest
        program, ways = _programmed(terms, state, rows.values[:n], absolute[:n], shortest)
        found = arcs_among(terms.arcs, state, rows, motion[:n], program)
        axes, n = _axes(state, program[: found.rows])
        if n == 0:
            return None
        found = found.before(n)
        stretch = Stretch(
            state.coordinates,
            state.axis_names,
            self._source.name,
            rows.line[:n].copy(),
            rows.block[:n].copy(),
            motion[:n],
            feed[:n],
            program[:n],
            axes[:n],
            state.position.axes,
        )
        turned = np.flatnonzero((ways[:n] != program[:n]).any(axis=1)) if terms.wraps else ()
        after = _state_after(state, stretch, bool(absolute[n - 1]), found)
        return Taken(after, stretch, {int(r): ways[r] for r in turned}, found.arcs)


def _programmed(
    terms: _Terms, state: State, values: Array, absolute, shortest: bool
) -> tuple[Array, Array]:
    """Programmed values (m, n), and the same before modulo axes are wrapped."""
    program = np.empty((len(values), len(state.axes)))
    ways = np.empty_like(program) if terms.wraps else program
    start = state.position.program
    _fill_program(values, absolute, terms.factors, start, terms.ranges, shortest, program, ways)
    return program, ways


def _filled_codes(codes, before: int):
    filled = np.empty(len(codes), dtype=np.int8)
    _fill_codes(codes, before, filled)
    return filled


def _filled_feed(state: State, feed: Array) -> Array:
    filled = np.empty(len(feed))
    before = np.nan if state.modal.feed is None else state.modal.feed
    _fill_feed(feed, state.modal.length_factor, before, filled)
    return filled


def _before_warning(state: State, motion, feed: Array, n: int) -> int:
    """Rows before the first feed motion without a feed, of which the step lane warns once."""
    if state.modal.feed_warned or state.modal.feed is not None:
        return n
    bare = np.flatnonzero((motion[:n] != MOTIONS.index("G00")) & np.isnan(feed[:n]))
    return int(bare[0]) if len(bare) else n


def _axes(state: State, program: Array) -> tuple[Array, int]:
    """Axis positions and how many rows have one: an error is reported by the step lane."""
    near = state.position.axes
    if len(program) == 0:
        return program, 0
    try:
        axes = state.coordinates.to_axes(program, near=near)
        n = len(axes)
    except KinematicsError as error:
        n = min(error.rows)
        axes = state.coordinates.to_axes(program[:n], near=near) if n else program[:0]
    finite = np.isfinite(axes)
    return axes, n if finite.all() else int(np.argmin(finite.all(axis=1)))


def _state_after(state: State, stretch: Stretch, absolute: bool, found: PlainArcs) -> State:
    feed, block = float(stretch.feed[-1]), int(stretch.block[-1])
    radius, circle = radius_and_circle(state, found, stretch.pcs)
    modal = state.modal.changed(
        motion=MOTIONS[stretch.motion[-1]],
        absolute=absolute,
        feed=None if np.isnan(feed) else feed,
        radius=radius,
    )
    return state.changed(
        modal=modal,
        position=Position(stretch.acs[-1].copy(), stretch.pcs[-1].copy()),
        circle=circle,
        block=None if block < 0 else block,
    )


@compiled
def _fill_codes(codes, before, filled):
    for i in range(len(codes)):
        if codes[i] >= 0:
            before = codes[i]
        filled[i] = before


@compiled
def _fill_feed(feed, factor, before, filled):
    for i in range(len(feed)):
        if not np.isnan(feed[i]):
            before = feed[i] * factor
        filled[i] = before


@compiled
def _fill_program(values, absolute, factors, start, ranges, shortest, program, ways):
    """Programmed absolute values: words as they are under G90, added up under G91.

    ranges (n, 2): of modulo axes, NaN for others. A minus on a modulo axis is its turning
    direction under G90 (see `modulo.travel`).
    """
    for j in range(values.shape[1]):
        at = start[j]
        low, high = ranges[j]
        for i in range(values.shape[0]):
            if not np.isnan(values[i, j]):
                length = values[i, j] * factors[j]
                if not absolute[i]:
                    at += length
                elif np.isnan(low):
                    at = length
                elif shortest or not np.signbit(length):
                    at += way_to(length, at, high - low, 0)
                else:
                    at += way_to(-length, at, high - low, -1)
            ways[i, j] = at
            if not np.isnan(low):
                at = in_range(at, low, high)
            program[i, j] = at
