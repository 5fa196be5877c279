"""One motion of the machine: where it ends, in programmed values and in axis positions.

Enters: what the channel computed. Leaves: `Move` values. Arcs and points along a motion have
their place here.
"""

from __future__ import annotations

from dataclasses import dataclass

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Span
from ncscope.frames import Array


@dataclass(frozen=True, slots=True)
class Move:
    """A motion block at its end point.

    motion: `G00` or `G01`. feed: mm or degrees per minute, None where no F was programmed.
    program, axes: (n,) by channel axis, mm and degrees. block: the N number, None without.
    coordinates: the chain of this motion alone (#SUPPRESS OFFSETS), None for that of the channel.
    """

    motion: str
    feed: float | None
    program: Array
    axes: Array
    block: int | None
    span: Span
    coordinates: Coordinates | None = None
