"""What is run, and how: a program and the options of its run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ncscope.channel.given import GivenRows
from ncscope.channel.subprograms import Load
from ncscope.diagnostics import Source
from ncscope.motion.sampling import FINEST
from ncscope.trajectory import Stretch

Progress = Callable[[int, int], None]
"""Called now and then with the offset in the main program and the number of executed blocks."""
Sink = Callable[[Stretch], None]
"""Called with the moves of a running program, stretch by stretch."""


@dataclass(frozen=True, slots=True)
class Options:
    """How a program is run.

    clamp: clamp position handed over at program start. skip: skip levels that are switched on.
    max_blocks: blocks after which the run stops, 0 for no limit. strict: a warning stops too.
    sample: largest chord error (mm and degrees) of points along the moves, in the workpiece and
    per axis; None for the ends of moves only. See `motion.sampling`.
    bulk: whether plain blocks are taken many at a time; None leaves it to the length
    of the program. The result is the same.
    load: the text of a subprogram file that the program calls, None where there is none; without
    it no file is found. external: values of the PLC's variables by name, `V.E.NAME` or
    `V.E.NAME[2]`; a tuple for a whole array.
    probe: the answers of the probe (`load_rows`), a row for each measuring run; without them it
    triggers at the target. manual: jog increments, a row for each G200 and G201; without them
    nobody jogs.
    """

    clamp: int | None = None
    skip: frozenset[int] = frozenset()
    max_blocks: int = 0
    strict: bool = False
    bulk: bool | None = None
    load: Load | None = None
    external: Mapping[str, float | str | tuple[float | str, ...]] = field(default_factory=dict)
    sample: float | None = None
    probe: GivenRows | None = None
    manual: GivenRows | None = None

    def __post_init__(self) -> None:
        """Raises ValueError for a tolerance below the resolution of the control."""
        if self.sample is not None and not self.sample >= FINEST:
            raise ValueError(f"sample has to be {FINEST:g} or more")


@dataclass(frozen=True, slots=True)
class Program:
    """An NC program: its text under the name that the user gave."""

    source: Source
