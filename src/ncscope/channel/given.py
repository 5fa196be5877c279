"""What the machine would answer, given by the user: probe positions and jog increments.

A table of text: the first line names axes, every further line is one row; commas or semicolons
between the cells, decimal points, mm and degrees. An empty cell, or `-`, gives nothing. Lines that
begin with `#` and empty lines are skipped. The rows are taken one after the other.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic

_AXIS = re.compile(r"[A-Za-z]\w*", re.ASCII)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class GivenRow:
    """One row: values by axis name, mm and degrees, and where each stands."""

    values: Mapping[str, float]
    cells: Mapping[str, Span]
    span: Span


@dataclass(frozen=True, slots=True)
class GivenRows:
    """All rows of a table; `used` of them have been taken. name: of the file."""

    name: str
    rows: tuple[GivenRow, ...]
    used: int = 0

    @property
    def next(self) -> GivenRow | None:
        """The row that is taken next, None behind the last."""
        return self.rows[self.used] if self.used < len(self.rows) else None

    def taken(self) -> GivenRows:
        return replace(self, used=self.used + 1)


def read_rows(source: Source) -> tuple[GivenRows, tuple[Diagnostic, ...]]:
    """The rows of a table and what is wrong with it; a wrong row is left out."""
    lines = [line for line in _lines(source) if _content(line)]
    if not lines:
        hint = "write a line with axis names, for example X,Y,Z, and a line for each row"
        empty = diagnostic("N4010", Span(source, 0, 0), "the file has no line of axis names", hint)
        return GivenRows(source.name, ()), (empty,)
    mark = ";" if ";" in lines[0].text else ","
    names = list(_cells(lines[0], mark))
    found = list(_wrong_names(names))
    rows = []
    for line in lines[1:]:
        row, problems = _row(line, mark, names)
        found.extend(problems)
        rows.append(row)
    return GivenRows(source.name, tuple(rows)), tuple(found)


def _lines(source: Source) -> Iterator[Span]:
    start = 0
    for text in source.text.splitlines(keepends=True):
        yield Span(source, start, start + len(text.rstrip("\r\n")))
        start += len(text)


def _content(line: Span) -> bool:
    return bool(line.text.strip()) and not line.text.lstrip().startswith("#")


def _cells(line: Span, mark: str) -> Iterator[Span]:
    """The cells of a line without the blanks around them."""
    start = line.start
    for text in line.text.split(mark):
        left = len(text) - len(text.lstrip())
        yield Span(line.source, start + left, start + max(left, len(text.rstrip())))
        start += len(text) + 1


def _wrong_names(names: list[Span]) -> Iterator[Diagnostic]:
    seen = set()
    for name in names:
        if not _AXIS.fullmatch(name.text):
            what = f"{name.text!r} is not the name of an axis"
            yield diagnostic("N4010", name, what, "the first line names axes, for example X,Y,Z")
        elif name.text in seen:
            yield diagnostic("N4010", name, f"axis {name.text} has two columns")
        seen.add(name.text)


def _row(line: Span, mark: str, names: list[Span]) -> tuple[GivenRow, list[Diagnostic]]:
    values, places, found = {}, {}, []
    cells = list(_cells(line, mark))
    if len(cells) > len(names):
        what = f"the row has {len(cells)} cells, but the first line names {len(names)} axes"
        hint = "decimals have a point, not a comma" if mark == "," else ""
        found.append(diagnostic("N4010", cells[len(names)], what, hint))
    for name, cell in zip(names, cells, strict=False):
        text = cell.text
        if text in ("", "-"):
            continue
        value = float(text) if _NUMBER.fullmatch(text) else math.nan
        if not math.isfinite(value):
            hint = "decimals have a point, not a comma" if "," in text else "write for example 98.5"
            found.append(diagnostic("N4010", cell, f"{text!r} is not a number", hint))
        values[name.text], places[name.text] = value, cell
    return GivenRow(values, places, line), found


def unused(given: GivenRows | None) -> list[Diagnostic]:
    """Rows that nobody asked for: the table was made for another program."""
    row = given.next if given is not None else None
    if given is None or row is None:
        return []
    left = len(given.rows) - given.used
    message = f"{left} of {len(given.rows)} rows of {given.name} were not used"
    return [diagnostic("N2044", row.span, message, "the first of them stands here")]
