"""Moves of a running program into the columns of a trajectory.

Enters moves one by one or as stretches. Leaves stretches, each under one `Coordinates` and one
set of axes; with a tolerance they hold points along the moves too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, chain
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.explanation import Visit
from ncscope.frames import Array
from ncscope.machine import Axis
from ncscope.motion import MOTIONS, Move
from ncscope.motion.arcs import NO_ARCS, Arcs
from ncscope.motion.bulges import bulges
from ncscope.motion.paths import Paths
from ncscope.motion.sampling import needs_points, sample
from ncscope.motion.turning import TurningPoints, turning_points
from ncscope.trajectory import NO_BLOCK, Stretch

NO_WAYS: Mapping[int, Array] = MappingProxyType({})


@dataclass(frozen=True)
class _Part:
    """A stretch with what lies between its rows.

    start: programmed values before every row (m, n), or before the first one (n,) where each
    row begins at the end of the one before. ways: row -> programmed values where its path leads
    before modulo axes are wrapped. spans: (m,), empty where all lines are plain blocks, None for
    one that is.
    """

    stretch: Stretch
    start: Array
    arcs: Arcs = NO_ARCS
    spans: tuple[Span | None, ...] = ()
    ways: Mapping[int, Array] = field(default_factory=dict)

    @classmethod
    def of_moves(cls, opened: Opened, moves: Sequence[Move]) -> _Part:
        """Single moves as columns."""
        arcs = {i: m.arc for i, m in enumerate(moves) if m.arc is not None}
        starts = np.array([m.start for m in moves], dtype=float)
        ways = {i: m.way for i, m in enumerate(moves) if m.way is not None}
        spans = tuple(m.span for m in moves)
        return cls(_columns(opened, moves), starts, Arcs.of(arcs), spans, ways)

    @classmethod
    def joined(cls, parts: Sequence[_Part]) -> _Part:
        """Parts that follow each other under the same coordinates."""
        if len(parts) == 1:
            return parts[0]
        lengths = [len(part.stretch) for part in parts]
        first = [0, *accumulate(lengths)]
        columns = ("line", "block", "motion", "feed", "pcs", "acs")
        rows: dict[str, Any] = {
            c: np.concatenate([getattr(p.stretch, c) for p in parts]) for c in columns
        }
        spans = [p.spans or (None,) * n for p, n in zip(parts, lengths, strict=True)]
        return cls(
            replace(parts[0].stretch, **rows),
            np.concatenate([part.starts() for part in parts]),
            Arcs.joined((at, part.arcs) for at, part in zip(first, parts, strict=False)),
            tuple(chain.from_iterable(spans)),
            {at + i: way for at, p in zip(first, parts, strict=False) for i, way in p.ways.items()},
        )

    def starts(self) -> Array:
        """(m, n) programmed values before every row."""
        if self.start.ndim > 1:
            return self.start
        return np.concatenate([self.start[None], self.stretch.pcs[:-1]])

    def span(self, row: int, source: Source) -> Span | None:
        """The block of a row; None for a plain one in a file other than the source."""
        known = self.spans[row] if self.spans else None
        return known or _line_span(source, self.stretch.file, int(self.stretch.line[row]))

    def paths(self) -> Paths:
        stop = self.stretch.pcs
        if self.ways:
            stop = stop.copy()
            stop[list(self.ways)] = list(self.ways.values())
        return Paths(self.starts(), stop, self.arcs, self.stretch.motion == MOTIONS.index("G00"))

    def last(self, source: Source) -> tuple[Move, Coordinates]:
        s, row = self.stretch, len(self.stretch) - 1
        block, feed = int(s.block[-1]), float(s.feed[-1])
        move = Move(
            MOTIONS[s.motion[-1]],
            None if np.isnan(feed) else feed,
            self.paths().start[-1],
            s.pcs[-1],
            s.acs[-1],
            None if block == NO_BLOCK else block,
            self.span(row, source) or Span(source, 0, 0),
            None,
            self.arcs.at(row),
            self.ways.get(row),
        )
        return move, s.coordinates

    def with_last(self, move: Move) -> _Part:
        pcs, acs = self.stretch.pcs.copy(), self.stretch.acs.copy()
        pcs[-1], acs[-1] = move.program, move.axes
        arcs = self.arcs.with_arc(len(pcs) - 1, move.arc)
        return replace(self, stretch=replace(self.stretch, pcs=pcs, acs=acs), arcs=arcs)


class Opened(NamedTuple):
    """What the moves of a stretch have in common; start: (n,) axis positions before the first."""

    coordinates: Coordinates
    axes: tuple[str, ...]
    start: Array
    file: str

    def holds(self, coordinates: Coordinates, axes: tuple[str, ...], file: str) -> bool:
        """Whether a move under these can follow in the same stretch."""
        return self.coordinates is coordinates and self.axes == axes and self.file == file


LONGEST = 50_000
"""Moves after which a stretch is closed: as columns they need little memory."""
SHORT = 4_000
"""A run of plain blocks below this length is joined with the moves around it: the work for a
stretch hardly depends on its length."""


class Recorder:
    """Collects moves while a program runs, in growing columns, and closes a stretch whenever the
    coordinates or the axes change.

    tolerance: largest chord error between rows, mm and degrees; None for the ends of moves only.
    sink: gets each stretch when no move of it can change any more.
    """

    def __init__(
        self, source: Source, tolerance: float | None, sink: Callable[[Stretch], None]
    ) -> None:
        self.file = source.name
        self.axes: list[str] = []
        self.places: dict[int, Visit] = {}
        self.coarse: dict[tuple[str, int], Span | None] = {}
        self.moves = 0
        self._source = source
        self._tolerance = tolerance
        self._sink = sink
        self._open: Opened | None = None
        self._length = 0
        self._parts: list[_Part] = []
        self._moves: list[Move] = []
        self._pending: _Part | None = None
        self._done = 0
        self._rows = 0
        self._row_of_move: dict[int, int] = {}

    def add(
        self, coordinates: Coordinates, axes: tuple[str, ...], move: Move, start: Array
    ) -> None:
        """One move; `start` are the axis positions before it."""
        self._begin(Opened(coordinates, axes, start, move.span.source.name))
        self._moves.append(move)
        self._length += 1
        self.moves += 1

    def extend(
        self,
        stretch: Stretch,
        start: Array,
        ways: Mapping[int, Array] = NO_WAYS,
        arcs: Arcs = NO_ARCS,
    ) -> None:
        """Many moves at once; `start` are the programmed values before them, `ways` as in
        `_Part`."""
        part = _Part(stretch, start, arcs, ways=ways)
        if len(stretch) < SHORT:
            self._begin(Opened(stretch.coordinates, stretch.axes, stretch.start, stretch.file))
            self._gather()
            self._parts.append(part)
            self._length += len(stretch)
        else:
            self._close()
            self._push(part)
        self.moves += len(stretch)

    def last(self) -> tuple[Move, Coordinates] | None:
        """The last move with its chain; None before the first one."""
        if self._open is not None and self._moves:
            return self._moves[-1], self._open.coordinates
        if self._parts:
            return self._parts[-1].last(self._source)
        return None if self._pending is None else self._pending.last(self._source)

    def replace_last(self, move: Move) -> None:
        """Another end for the last move."""
        if self._moves:
            self._moves[-1] = move
        elif self._parts:
            self._parts[-1] = self._parts[-1].with_last(move)
        elif self._pending is not None:
            self._pending = self._pending.with_last(move)

    def visit(
        self, line: int, block: int | None, coordinates: Coordinates, axes: tuple[str, ...],
        program: Array, position: Array,
    ) -> None:  # fmt: skip
        """A block without motion: what `explain` of its line shows."""
        self.places[line] = Visit(coordinates, axes, self.file, block, program, position, position)

    def split(self) -> None:
        """The axes are others from here on, or their limits."""
        self._close()

    def finish(self) -> None:
        """Gives the last stretch to the sink."""
        self._close()
        self._push(None)

    def rows_of(self, moves: int) -> int:
        """Rows up to the end of so many moves, where a stretch ended there or nothing followed."""
        return self._row_of_move.get(moves, self._rows)

    def _begin(self, opened: Opened) -> None:
        """Opens a stretch where what the next move has in common with the last is not the same."""
        now = self._open
        same = now is not None and now.holds(opened.coordinates, opened.axes, opened.file)
        if not same or self._length >= LONGEST:
            self._close()
            self._open = opened

    def _gather(self) -> None:
        """Single moves into columns."""
        if self._moves:
            assert self._open is not None
            self._parts.append(_Part.of_moves(self._open, self._moves))
            self._moves = []

    def _close(self) -> None:
        self._gather()
        parts, self._parts, self._open, self._length = self._parts, [], None, 0
        if parts:
            self._push(_Part.joined(parts))

    def _push(self, part: _Part | None) -> None:
        """The next part waits, because its last move may yet be cut by a chamfer; the one before
        is done."""
        done, self._pending = self._pending, part
        if done is None:
            return
        stretch = self._sampled(done)
        self._row_of_move[self._done] = self._rows
        self._done += len(done.stretch)
        self._rows += len(stretch)
        self.axes.extend(a for a in stretch.axes if a not in self.axes)
        self._sink(stretch)

    def complaints(self) -> list[Diagnostic]:
        """N4004 for every line with a move whose points are farther apart than the tolerance."""
        what = "the points of the motion in {}:{} deviate from its path by more than the tolerance"
        hint = "an axis jumps there, or the machine cannot follow: the motion passes a pole"
        return [
            diagnostic("N4004", span, what.format(*place), hint)
            for place, span in self.coarse.items()
        ]

    def _sampled(self, part: _Part) -> Stretch:
        """The stretch of a part with points along its moves."""
        s = replace(part.stretch, between=part.paths)
        if self._tolerance is None and not len(part.arcs):
            return s
        paths = part.paths()
        s = replace(s, turning=turning_points(s.coordinates, paths, s.acs))
        if self._tolerance is None:
            return s
        if not needs_points(s.coordinates, paths):
            return replace(s, ends=s.end)
        points = sample(s.coordinates, paths, s.acs, s.start, self._tolerance)
        for index in points.coarse:
            line = int(s.line[index])
            block = part.span(index, self._source)
            span = block and _line_span(block.source, s.file, line)
            self.coarse.setdefault((s.file, line), span)
        row = points.row
        return replace(
            s,
            line=s.line[row],
            block=s.block[row],
            motion=s.motion[row],
            feed=s.feed[row],
            pcs=points.pcs,
            acs=points.acs,
            ends=points.share == 1.0,
        )


def _columns(opened: Opened, moves: Sequence[Move]) -> Stretch:
    blocks = [NO_BLOCK if m.block is None else m.block for m in moves]
    feeds = [np.nan if m.feed is None else m.feed for m in moves]
    return Stretch(
        opened.coordinates,
        opened.axes,
        opened.file,
        np.array([m.span.line for m in moves], dtype=np.int64),
        np.array(blocks, dtype=np.int64),
        np.array([MOTIONS.index(m.motion) for m in moves], dtype=np.int8),
        np.array(feeds, dtype=float),
        np.array([m.program for m in moves], dtype=float),
        np.array([m.axes for m in moves], dtype=float),
        opened.start,
    )


def with_bulges(stretch: Stretch, axes: tuple[Axis, ...]) -> Stretch:
    """The stretch without its paths, and with the points where straight moves leave the limits."""
    between, s = stretch.between, replace(stretch, between=None)
    if between is None or s.coordinates.kinematics is None or not any(a.limits for a in axes):
        return s
    limits = np.array([a.limits or (-np.inf, np.inf) for a in axes], dtype=float)
    found = bulges(s.coordinates, between(), s.start, s.at_ends().acs, limits)
    if found is None or s.turning is None:
        return s if found is None else replace(s, turning=found)
    row = np.concatenate([s.turning.row, found.row])
    return replace(s, turning=TurningPoints(row, np.concatenate([s.turning.acs, found.acs])))


def _line_span(source: Source, file: str, line: int) -> Span | None:
    """The line of a block without its indentation; None in a file other than the source."""
    if file != source.name:
        return None
    text = source.line_text(line)
    start = source.line_start(line)
    return Span(source, start + len(text) - len(text.lstrip()), start + len(text))
