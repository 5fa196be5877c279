"""Moves into a file or a pipe while the program runs."""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from ncscope.cli.files import text_output, writing

if TYPE_CHECKING:
    from concurrent.futures import Future

    from ncscope.cli.inputs import Inputs
    from ncscope.trajectory import Stretch, Trajectory

    Judge = Callable[[Trajectory], tuple[Trajectory, bool]]

WAITING = 3
"""Stretches that may wait for a writer in the background: bounds the memory."""


class Format(StrEnum):
    """How a run is written."""

    TABLE = "table"
    JSONL = "jsonl"
    CSV = "csv"
    PARQUET = "parquet"


class Writer(Protocol):
    """Takes the moves of a run in order."""

    def write(self, stretch: Stretch) -> None:
        """Some moves."""

    def finish(self, result: Trajectory | None, ok: bool) -> None:
        """What follows the moves; called once, also when the run was broken off."""


class InBackground:
    """A writer in a thread of its own: while it writes, the program runs on."""

    def __init__(self, writer: Writer) -> None:
        from concurrent.futures import ThreadPoolExecutor

        self._writer = writer
        self._thread = ThreadPoolExecutor(1)
        self._waiting: deque[Future[None]] = deque()

    def write(self, stretch: Stretch) -> None:
        _ = stretch.wcs, stretch.mcs, stretch.direction  # here, because the writer has more to do
        self._waiting.append(self._thread.submit(self._writer.write, stretch))
        while len(self._waiting) > WAITING:
            self._waiting.popleft().result()

    def finish(self, result: Trajectory | None, ok: bool) -> None:
        try:
            while self._waiting and result is not None:  # else broken off: nobody waits for more
                self._waiting.popleft().result()
        finally:
            self._thread.shutdown(cancel_futures=True)
            self._writer.finish(result, ok)


def write_run(
    shape: Format, out: Path | None, jobs: int, inputs: Inputs, judge: Judge
) -> tuple[Trajectory, bool]:
    """Runs and writes what the run gives; returns the result without its moves, and the judgment.

    judge: the result with all that is to be said, and whether it is ok. When an axis turns up that
    the first columns do not have, the program is run once more with all of its axes.
    """
    from ncscope.views.records import NewAxis, write_csv

    if out is None and shape is Format.CSV:  # what is in a pipe cannot be taken back
        result, ok = judge(inputs.run())
        write_csv(sys.stdout, result)
        return result, ok
    try:
        return _written(shape, out, jobs, inputs, inputs.machine.axis_names, judge)
    except NewAxis:
        return _written(shape, out, jobs, inputs, inputs.run().axes, judge)


def _written(
    shape: Format, out: Path | None, jobs: int, inputs: Inputs, axes: tuple[str, ...], judge: Judge
) -> tuple[Trajectory, bool]:
    result, ok = None, False
    with _writer(shape, out, axes, inputs) as plain:
        writer = InBackground(plain) if jobs > 1 else plain
        try:
            result, ok = judge(inputs.run(writer.write))
        finally:
            writer.finish(result, ok)
    return result, ok


@contextmanager
def _writer(
    shape: Format, out: Path | None, axes: tuple[str, ...], inputs: Inputs
) -> Iterator[Writer]:
    from ncscope.views.records import CsvWriter, JsonlWriter

    sampled = inputs.options.sample is not None

    if shape is Format.PARQUET and out is not None:
        from ncscope.views.parquet import ParquetWriter

        with writing(out):
            yield ParquetWriter(out, axes, sampled)
        return
    with text_output(out) as stream:
        if shape is Format.JSONL:
            yield JsonlWriter(stream, inputs.faults)
        else:
            yield CsvWriter(stream, axes, sampled)
