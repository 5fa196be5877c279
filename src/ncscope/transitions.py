"""Between the channel and the columns: what needs more than one move to know where a move ends.

Enters: the moves of each block, under the coordinates of the block. Leaves: recorded moves.
Chamfers and roundings are inserted here; the path of the cutter radius compensation has its place
here too.
"""

from __future__ import annotations

from collections.abc import Iterable

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.frames import Array
from ncscope.motion import Move
from ncscope.motion.corners import Corner, CornerError, join
from ncscope.recording import Recorder


class Transitions:
    """Hands moves on to the recorder; `waiting` is what is to be inserted before the next one."""

    def __init__(self, recorder: Recorder) -> None:
        self.recorder = recorder
        self.waiting: Corner | None = None

    def take(
        self,
        coordinates: Coordinates,
        axes: tuple[str, ...],
        moves: Iterable[Move],
        start: Array,
    ) -> tuple[Diagnostic, ...]:
        """The moves of one block; `start` are the axis positions before it. Nothing is recorded
        when something is wrong."""
        moves = tuple(moves)
        if self.waiting is not None and moves:
            chain = moves[0].coordinates or coordinates
            try:
                first, *rest = self._joined(moves[0], self.waiting, chain)
            except CornerError as error:
                return (diagnostic(error.id, self.waiting.span, error.message, error.hint),)
            self.waiting, start, moves = None, first.axes, (*rest, *moves[1:])
        for move in moves:
            before = start if len(start) == len(move.axes) else move.axes
            self.recorder.add(move.coordinates or coordinates, axes, move, before)
            start = move.axes
        return ()

    def insert(self, corner: Corner) -> tuple[Diagnostic, ...]:
        """A chamfer or rounding before the next move."""
        if self.waiting is not None:
            what = (
                "a second chamfer or rounding without a motion between; the first one is left out"
            )
            self.waiting = corner
            return (diagnostic("20701", corner.span, what),)
        if self.recorder.last() is None:
            what = "no motion stands before this chamfer or rounding; it is left out"
            return (diagnostic("20351", corner.span, what),)
        self.waiting = corner
        return ()

    def finish(self) -> tuple[Diagnostic, ...]:
        """At the end of the program."""
        if self.waiting is None:
            return ()
        what = "no motion follows this chamfer or rounding; it is left out"
        return (diagnostic("20351", self.waiting.span, what),)

    def _joined(self, second: Move, corner: Corner, chain: Coordinates) -> tuple[Move, ...]:
        """The first move, shortened where it stands, and what takes the place of the second."""
        last = self.recorder.last()
        assert last is not None
        first, before = last
        if before is not chain or len(first.program) != len(second.program):
            what = "offsets, coordinate system or axes change between the motions of this corner"
            raise CornerError("N2034", what, "change them before the first or after the second")
        moves = join(first, second, corner, chain)
        self.recorder.replace_last(moves[0])
        return moves
