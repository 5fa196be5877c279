"""One motion of the machine: where it begins and ends, and the path between.

Enters: what the channel computed. Leaves: `Move` values, and points along moves.
`arc` holds the geometry of circular paths, `sampling` the points along many paths at once.
"""

from __future__ import annotations

from dataclasses import dataclass

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Span
from ncscope.frames import Array
from ncscope.motion.arc import Arc

MOTIONS = ("G00", "G01", "G02", "G03", "G33", "G63", "G331", "G332")
"""The path conditions that a move can have."""
LINEAR = 2
"""So many of MOTIONS, from the first on, are plain straight motions."""


@dataclass(frozen=True, slots=True)
class Move:
    """A motion block at its end point.

    motion: one of MOTIONS, as programmed (a mirror turns the sense of an arc, not this name).
    feed: mm or degrees per minute, None where no F was programmed.
    start, program, axes: (n,) by channel axis, mm and degrees: programmed values before and after
    the motion, axis positions after it. block: the N number, None without.
    coordinates: the chain of this motion alone (#SUPPRESS OFFSETS), None for that of the channel.
    arc: the path in the plane, None for a straight one. way: (n,) where the path leads before
    modulo axes are wrapped into their ranges, None where that is `program`.
    """

    motion: str
    feed: float | None
    start: Array
    program: Array
    axes: Array
    block: int | None
    span: Span
    coordinates: Coordinates | None = None
    arc: Arc | None = None
    way: Array | None = None
