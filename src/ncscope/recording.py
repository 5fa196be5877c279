"""Moves of a running program into the columns of a trajectory.

Enters moves one by one or as stretches. Leaves stretches, each under one `Coordinates` and one
set of axes; with a tolerance they hold points along the moves too.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.explanation import Visit
from ncscope.frames import Array
from ncscope.motion import MOTIONS, Move
from ncscope.motion.sampling import Paths, needs_points, sample
from ncscope.trajectory import NO_BLOCK, Stretch


class Recorder:
    """Collects moves while a program runs, in growing columns, and closes a stretch whenever the
    coordinates or the axes change.

    tolerance: largest chord error between rows, mm and degrees; None for the ends of moves only.
    """

    def __init__(self, source: Source, tolerance: float | None = None) -> None:
        self.file = source.name
        self.stretches: list[Stretch] = []
        self.axes: list[str] = []
        self.places: dict[int, Visit] = {}
        self.coarse: dict[tuple[str, int], Span] = {}
        self._source = source
        self._tolerance = tolerance
        self._open: tuple[Coordinates, tuple[str, ...], Array, str] | None = None
        self._moves: list[Move] = []

    @property
    def rows(self) -> int:
        """Rows of the trajectory so far."""
        self.close()
        return sum(len(stretch) for stretch in self.stretches)

    def add(
        self, coordinates: Coordinates, axes: tuple[str, ...], move: Move, start: Array
    ) -> None:
        """One move; `start` are the axis positions before it."""
        file = move.span.source.name
        if self._open is None or (
            self._open[0] is not coordinates or self._open[1] != axes or self._open[3] != file
        ):
            self.close()
            self._open = (coordinates, axes, start, file)
        self._moves.append(move)

    def extend(self, stretch: Stretch, start: Array) -> None:
        """Many straight moves at once; `start` are the programmed values before them."""
        self.close()
        if self._tolerance is not None:
            starts = np.concatenate([start[None], stretch.pcs[:-1]])
            stretch = self._sampled(stretch, Paths(starts, stretch.pcs, {}))
        self._name_axes(stretch.axes)
        self.stretches.append(stretch)

    def visit(
        self, line: int, block: int | None, coordinates: Coordinates, axes: tuple[str, ...],
        program: Array, position: Array,
    ) -> None:  # fmt: skip
        """A block without motion: what `explain` of its line shows."""
        self.places[line] = Visit(coordinates, axes, self.file, block, program, position, position)

    def close(self) -> None:
        if self._open is None:
            return
        moves, stretch = self._moves, self._stretch()
        if self._tolerance is not None:
            starts = np.array([m.start for m in moves], dtype=float)
            arcs = {i: m.arc for i, m in enumerate(moves) if m.arc is not None}
            spans = [m.span for m in moves]
            stretch = self._sampled(stretch, Paths(starts, stretch.pcs, arcs), spans)
        self._name_axes(stretch.axes)
        self.stretches.append(stretch)
        self._open, self._moves = None, []

    def complaints(self) -> list[Diagnostic]:
        """N4004 for every line with a move whose points are farther apart than the tolerance."""
        what = "the points of this motion deviate from its path by more than the tolerance"
        hint = "an axis jumps there, or the machine cannot follow: the motion passes a pole"
        return [diagnostic("N4004", span, what, hint) for span in self.coarse.values()]

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

    def _sampled(self, s: Stretch, paths: Paths, spans: list[Span] | None = None) -> Stretch:
        """The stretch with points along its moves."""
        if not needs_points(s.coordinates, paths) or self._tolerance is None:
            return replace(s, ends=s.end)
        points = sample(s.coordinates, paths, s.acs, s.start, self._tolerance)
        for index in points.coarse:
            line = int(s.line[index])
            span = spans[index] if spans else self._line_span(line)
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

    def _line_span(self, line: int) -> Span:
        start = self._source.line_start(line)
        return Span(self._source, start, start + len(self._source.line_text(line)))

    def _name_axes(self, axes: tuple[str, ...]) -> None:
        self.axes.extend(a for a in axes if a not in self.axes)
