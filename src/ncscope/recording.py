"""Moves of a running program into the columns of a trajectory.

Enters moves one by one or as stretches. Leaves stretches, each under one `Coordinates` and one
set of axes; with a tolerance they hold points along the moves too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.explanation import Visit
from ncscope.frames import Array
from ncscope.machine import Axis
from ncscope.motion import MOTIONS, Move
from ncscope.motion.arc import Arc
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
    before modulo axes are wrapped. spans: None where the lines are plain blocks.
    """

    stretch: Stretch
    start: Array
    arcs: Mapping[int, Arc] = field(default_factory=dict)
    spans: list[Span] | None = None
    ways: Mapping[int, Array] = field(default_factory=dict)

    def paths(self) -> Paths:
        start = self.start
        if start.ndim == 1:
            start = np.concatenate([start[None], self.stretch.pcs[:-1]])
        stop = self.stretch.pcs
        if self.ways:
            stop = stop.copy()
            stop[list(self.ways)] = list(self.ways.values())
        return Paths(start, stop, self.arcs, self.stretch.motion == MOTIONS.index("G00"))

    def last(self, source: Source) -> tuple[Move, Coordinates]:
        s = self.stretch
        paths = self.paths()
        found = self.spans[-1] if self.spans else _line_span(source, s.file, int(s.line[-1]))
        span = found or Span(source, 0, 0)
        block, feed = int(s.block[-1]), float(s.feed[-1])
        move = Move(
            MOTIONS[s.motion[-1]],
            None if np.isnan(feed) else feed,
            paths.start[-1],
            s.pcs[-1],
            s.acs[-1],
            None if block == NO_BLOCK else block,
            span,
            None,
            self.arcs.get(len(s) - 1),
            self.ways.get(len(s) - 1),
        )
        return move, s.coordinates

    def with_last(self, move: Move) -> _Part:
        pcs, acs = self.stretch.pcs.copy(), self.stretch.acs.copy()
        pcs[-1], acs[-1] = move.program, move.axes
        arcs = dict(self.arcs)
        if move.arc is not None:
            arcs[len(pcs) - 1] = move.arc
        return replace(self, stretch=replace(self.stretch, pcs=pcs, acs=acs), arcs=arcs)


LONGEST = 50_000
"""Moves after which a stretch is closed: as columns they need little memory."""


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
        self._open: tuple[Coordinates, tuple[str, ...], Array, str] | None = None
        self._moves: list[Move] = []
        self._pending: _Part | None = None
        self._done = 0
        self._rows = 0
        self._row_of_move: dict[int, int] = {}

    def add(
        self, coordinates: Coordinates, axes: tuple[str, ...], move: Move, start: Array
    ) -> None:
        """One move; `start` are the axis positions before it."""
        file = move.span.source.name
        if self._open is None or (
            self._open[0] is not coordinates
            or self._open[1] != axes
            or self._open[3] != file
            or len(self._moves) == LONGEST
        ):
            self._close()
            self._open = (coordinates, axes, start, file)
        self._moves.append(move)
        self.moves += 1

    def extend(self, stretch: Stretch, start: Array, ways: Mapping[int, Array] = NO_WAYS) -> None:
        """Many straight moves at once; `start` are the programmed values before them, `ways` as
        in `_Part`."""
        self._close()
        self._push(_Part(stretch, start, ways=ways))
        self.moves += len(stretch)

    def last(self) -> tuple[Move, Coordinates] | None:
        """The last move with its chain; None before the first one."""
        if self._open is not None:
            return self._moves[-1], self._open[0]
        return None if self._pending is None else self._pending.last(self._source)

    def replace_last(self, move: Move) -> None:
        """Another end for the last move."""
        if self._open is not None:
            self._moves[-1] = move
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

    def _close(self) -> None:
        if self._open is None:
            return
        moves = self._moves
        arcs = {i: m.arc for i, m in enumerate(moves) if m.arc is not None}
        starts = np.array([m.start for m in moves], dtype=float)
        ways = {i: m.way for i, m in enumerate(moves) if m.way is not None}
        part = _Part(self._stretch(), starts, arcs, [m.span for m in moves], ways)
        self._open, self._moves = None, []
        self._push(part)

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

    def _stretch(self) -> Stretch:
        assert self._open is not None
        (coordinates, axes, start, file), moves = self._open, self._moves
        blocks = [NO_BLOCK if m.block is None else m.block for m in moves]
        feeds = [np.nan if m.feed is None else m.feed for m in moves]
        return Stretch(
            coordinates,
            axes,
            file,
            np.array([m.span.line for m in moves], dtype=np.int64),
            np.array(blocks, dtype=np.int64),
            np.array([MOTIONS.index(m.motion) for m in moves], dtype=np.int8),
            np.array(feeds, dtype=float),
            np.array([m.program for m in moves], dtype=float),
            np.array([m.axes for m in moves], dtype=float),
            start,
        )

    def _sampled(self, part: _Part) -> Stretch:
        """The stretch of a part with points along its moves."""
        s, spans = replace(part.stretch, between=part.paths), part.spans
        if self._tolerance is None and not part.arcs:
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
            source = spans[index].source if spans else self._source
            span = _line_span(source, s.file, line)
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
