"""Moves into a Parquet file while the program runs; memory does not grow with its length."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ncscope.trajectory import Stretch, Trajectory, parquet_options
from ncscope.views.records import NewAxis

ROWS = 65_536
"""Moves that are collected for one part of the file."""


class ParquetWriter:
    """The table of `Trajectory.to_arrow`, part by part. Raises OSError; `write` raises NewAxis
    for a stretch with an axis that is none of `axes`."""

    def __init__(self, path: Path, axes: tuple[str, ...], sampled: bool = False) -> None:
        from pyarrow.parquet import ParquetWriter as Arrow

        from ncscope.trajectory import no_moves

        self.axes, self.sampled = axes, sampled
        empty = no_moves(axes).to_arrow(axes, sampled)
        self._file = Arrow(path, empty.schema, **parquet_options(empty.schema))
        self._waiting: list[Any] = []
        self._rows = 0

    def write(self, stretch: Stretch) -> None:
        if not set(stretch.axes) <= set(self.axes):
            raise NewAxis
        self._waiting.append(stretch.to_arrow(self.axes, self.sampled))
        self._rows += len(stretch)
        if self._rows >= ROWS:
            self._flush()

    def finish(self, result: Trajectory | None, ok: bool) -> None:
        """Nothing follows the moves."""
        self._flush()
        self._file.close()

    def _flush(self) -> None:
        import pyarrow

        if self._waiting:
            self._file.write_table(pyarrow.concat_tables(self._waiting), row_group_size=1 << 20)
            self._waiting.clear()
            self._rows = 0
