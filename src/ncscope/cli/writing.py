"""Moves into a file or a pipe while the program runs."""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TextIO

from ncscope.cli.screen import fail

if TYPE_CHECKING:
    from ncscope.diagnostics import Diagnostic
    from ncscope.trajectory import Stretch, Trajectory

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
            while self._waiting:
                self._waiting.popleft().result()
        finally:
            self._thread.shutdown(cancel_futures=True)
            self._writer.finish(result, ok)


def write_run(
    shape: Format,
    out: Path | None,
    jobs: int,
    axes: tuple[str, ...],
    sampled: bool,
    before: list[Diagnostic],
    run: Callable[[Callable[[Stretch], None] | None], Trajectory],
    judge: Callable[[Trajectory], tuple[Trajectory, bool]],
) -> tuple[Trajectory, bool]:
    """Runs and writes what the run gives; returns the result without its moves, and the judgment.

    run: the run for a sink of moves. judge: the result with all that is to
    be said, and whether it is ok. When an axis turns up that
    the first columns do not have, the program is run once more with all of its axes.
    """
    from ncscope.views.records import NewAxis, write_csv

    if out is None and shape is Format.CSV:  # what is in a pipe cannot be taken back
        result, ok = judge(run(None))
        write_csv(sys.stdout, result)
        return result, ok
    try:
        return _written(shape, out, jobs, axes, sampled, before, run, judge)
    except NewAxis:
        all_axes = run(None).axes
        return _written(shape, out, jobs, all_axes, sampled, before, run, judge)


def _written(shape, out, jobs, axes, sampled, before, run, judge) -> tuple[Trajectory, bool]:
    result, ok = None, False
    with _writer(shape, out, axes, sampled, before) as plain:
        writer = InBackground(plain) if jobs > 1 else plain
        try:
            result, ok = judge(run(writer.write))
        finally:
            writer.finish(result, ok)
    return result, ok


@contextmanager
def _writer(
    shape: Format, out: Path | None, axes: tuple[str, ...], sampled: bool, before: list[Diagnostic]
) -> Iterator[Writer]:
    from ncscope.views.records import CsvWriter, JsonlWriter

    def of_text(stream: TextIO) -> Writer:
        if shape is Format.JSONL:
            return JsonlWriter(stream, before)
        return CsvWriter(stream, axes, sampled)

    try:
        if out is None:
            yield of_text(sys.stdout)
        elif shape is Format.PARQUET:
            from ncscope.views.parquet import ParquetWriter

            yield ParquetWriter(out, axes, sampled)
        else:
            with out.open("w", encoding="utf-8", newline="") as stream:
                yield of_text(stream)
    except BrokenPipeError:
        raise
    except OSError as error:
        fail(f"cannot write {out or 'the output'}: {error.strerror or error}")
