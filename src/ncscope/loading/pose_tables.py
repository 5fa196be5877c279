"""Tables of poses from CSV or Parquet files: a header of column names, then numbers.

CSV may be separated by commas, semicolons or tabs; behind a semicolon or tab a decimal comma is
a decimal point. Lines that are empty or begin with # are skipped. An empty cell is NaN.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.loading.content import content, refuse_device

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PoseTable:
    """The columns of a file by name; numbers are read when they are asked for."""

    path: Path
    names: tuple[str, ...]
    separator: str = ","

    @property
    def is_parquet(self) -> bool:
        return self.path.suffix.lower() == ".parquet"

    def numbers(self, names: Sequence[str]) -> tuple[Array, tuple[Diagnostic, ...]]:
        """The columns as an array (rows, len(names)), and the first cell that is no number.

        Raises OSError when the file cannot be read.
        """
        if self.is_parquet:
            return _parquet_numbers(self, names)
        return _csv_numbers(self, names)


def open_pose_table(path: str | Path) -> tuple[PoseTable | None, tuple[Diagnostic, ...]]:
    """The table of a file by its header; N4201 when it has none. Raises OSError."""
    path = Path(path)
    if path.suffix.lower() == ".parquet":
        return _open_parquet(path)
    source = _source(path)
    for _, line in _lines(source):
        separator = next((s for s in ";\t" if s in line), ",")
        names = tuple(name.strip() for name in _cells(line, separator))
        if not all(name.isprintable() for name in names):
            return None, (_unreadable(path, "it holds no text"),)
        return _checked(PoseTable(path, names, separator))
    return None, (_unreadable(path, "it is empty", "the first line names the columns"),)


def _checked(table: PoseTable) -> tuple[PoseTable | None, tuple[Diagnostic, ...]]:
    twice = {n for n in table.names if n and table.names.count(n) > 1}
    if twice:
        reason = f"it has the column {min(twice)} twice"
        return None, (_unreadable(table.path, reason),)
    if all(_number(name, table.separator) is not None for name in table.names):
        hint = "write the axis names into the first line, such as X,Y,Z,C,A"
        return None, (_unreadable(table.path, "its first line has no column names", hint),)
    return table, ()


def _csv_numbers(table: PoseTable, names: Sequence[str]) -> tuple[Array, tuple[Diagnostic, ...]]:
    columns = [table.names.index(name) for name in names]
    lines = _data_lines(table.path)
    if not lines:
        reason = _unreadable(table.path, "it has no rows below the names of its columns")
        return np.zeros((0, len(columns))), (reason,)
    try:
        # The compiled reader knows neither empty cells nor decimal commas: those take longer.
        values = np.loadtxt(
            lines, delimiter=table.separator, usecols=columns, ndmin=2,
            comments=None, quotechar='"',
        )  # fmt: skip
    except ValueError:
        return _careful_numbers(table, columns)
    return values.reshape(-1, len(columns)), ()


def _data_lines(path: Path) -> list[str]:
    return [line for _, line in _lines(_source(path))][1:]


def _careful_numbers(
    table: PoseTable, columns: Sequence[int]
) -> tuple[Array, tuple[Diagnostic, ...]]:
    rows: list[list[float]] = []
    source = _source(table.path)
    lines = _lines(source)
    next(lines)
    for offset, line in lines:
        cells = _cells(line, table.separator)
        row = []
        for column in columns:
            value = _number(cells[column], table.separator) if column < len(cells) else None
            if value is None:
                text = repr(cells[column].strip()) if column < len(cells) else "missing"
                message = f"column {table.names[column]}: {text} is not a number"
                if column >= len(cells):
                    message = f"the line ends before column {table.names[column]}"
                span = Span(source, offset, offset + len(line))
                return np.zeros((0, len(columns))), (diagnostic("N4201", span, message),)
            row.append(value)
        rows.append(row)
    return np.array(rows, np.float64).reshape(-1, len(columns)), ()


def _cells(line: str, separator: str) -> list[str]:
    """The cells of a line; what the reader of CSV takes for binary data is cut at separators."""
    try:
        return next(csv.reader([line], delimiter=separator))
    except csv.Error:
        return line.split(separator)


def _number(text: str, separator: str) -> float | None:
    text = text.strip()
    if not text:
        return math.nan
    if separator != ",":
        text = text.replace(",", ".", 1)
    try:
        return float(text)
    except ValueError:
        return None


def _source(path: Path) -> Source:
    return Source(path.name, content(path).decode("latin-1").removeprefix("\xef\xbb\xbf"))


def _lines(source: Source) -> Iterator[tuple[int, str]]:
    """Offset and text of each line that holds something."""
    offset = 0
    for line in source.text.split("\n"):
        text = line.rstrip("\r")
        if text.strip() and not text.lstrip().startswith("#"):
            yield offset, text
        offset += len(line) + 1


def _open_parquet(path: Path) -> tuple[PoseTable | None, tuple[Diagnostic, ...]]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        hint = "install the extra: pip install 'ncscope[table]'"
        return None, (_unreadable(path, "Parquet needs pyarrow", hint),)
    refuse_device(path)
    path.open("rb").close()
    try:
        names = tuple(pyarrow.parquet.read_schema(path).names)
    except (pyarrow.ArrowException, OSError):
        return None, (_unreadable(path, "it is no Parquet file"),)
    return _checked(PoseTable(path, names))


def _parquet_numbers(
    table: PoseTable, names: Sequence[str]
) -> tuple[Array, tuple[Diagnostic, ...]]:
    import pyarrow
    import pyarrow.parquet

    try:
        read = pyarrow.parquet.read_table(table.path, columns=list(names))
        columns = [
            read[name].cast(pyarrow.float64()).to_numpy(zero_copy_only=False) for name in names
        ]
    except (pyarrow.ArrowException, OSError) as error:
        reason = str(error).splitlines()[0]
        return np.zeros((0, len(names))), (_unreadable(table.path, reason),)
    return np.column_stack(columns).astype(np.float64), ()


def _unreadable(path: Path, reason: str, hint: str = "") -> Diagnostic:
    return diagnostic("N4201", None, f"{path.name} cannot be read as a table: {reason}", hint)
