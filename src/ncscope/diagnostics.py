"""Where a text is wrong, and what would have been right.

Enters: source text and offsets into it. Leaves: frozen `Diagnostic` values and their rendering.
Knows nothing of NC blocks or machines. The ids and their explanations are in `catalogue`.
"""

from __future__ import annotations

import mmap
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ncscope.catalogue import CATALOGUE


class Severity(StrEnum):
    """How a diagnostic ends the run: an error stops it, the other two do not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


_MOST_LINES = 160
"""Characters that a line of a program hardly has."""
_SEVERITIES = {severity.value: severity for severity in Severity}
_PIECE = 2048
"""Characters between two known line numbers of a source."""
AHEAD = 1024
"""Pieces whose lines are counted in one go: not far ahead, for a mapped file comes into memory."""


@dataclass(frozen=True)
class Source:
    """A text and the name that the user knows it by.

    content: the characters, or Latin-1 bytes such as a mapped file, of which only the parts that
    are looked at become text. Offsets count characters from 0.
    """

    name: str
    content: str | NDArray[np.uint8] = field(repr=False)

    def __len__(self) -> int:
        return len(self.content)

    @cached_property
    def text(self) -> str:
        """All characters; a file of many millions of lines is better read with `part`."""
        return self.content if isinstance(self.content, str) else self.part(0, len(self))

    @cached_property
    def data(self) -> NDArray[np.uint8]:
        """The text as bytes, one a character; `?` for a character beyond Latin-1."""
        if not isinstance(self.content, str):
            return self.content.view(np.ndarray)
        return np.frombuffer(self.content.encode("latin-1", "replace"), dtype=np.uint8)

    def part(self, start: int, stop: int) -> str:
        """The characters from `start` up to `stop`; fewer where the text ends before."""
        if isinstance(self.content, str):
            return self.content[start:stop]
        return self.data[start:stop].tobytes().decode("latin-1")

    def forget(self, stop: int) -> None:
        """The characters before `stop` are not needed soon: a mapped file leaves the memory."""
        mapped = self.content.base if isinstance(self.content, np.memmap) else None
        if isinstance(mapped, mmap.mmap) and hasattr(mmap, "MADV_DONTNEED"):
            mapped.madvise(mmap.MADV_DONTNEED, 0, stop // mmap.PAGESIZE * mmap.PAGESIZE)

    def rest_of_line(self, offset: int) -> str:
        """The characters from `offset` up to the next line feed or the end of the text."""
        if isinstance(self.content, str):
            return self.content[offset : self.end_of_line(offset)]
        text = self.part(offset, offset + _MOST_LINES)
        end = text.find("\n")
        return text[:end] if end >= 0 else self.part(offset, self.end_of_line(offset))

    def end_of_line(self, offset: int) -> int:
        """Offset of the next line feed at or behind `offset`, or of the end of the text."""
        if isinstance(self.content, str):
            at = self.content.find("\n", offset)
            return at if at >= 0 else len(self)
        while offset < len(self):
            at = self.part(offset, offset + _PIECE).find("\n")
            if at >= 0:
                return offset + at
            offset += _PIECE
        return len(self)

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of a character, both counted from 1."""
        piece = offset // _PIECE
        before = self.data[piece * _PIECE : offset].tobytes()
        line = self._line_index.before(piece) + before.count(b"\n") + 1
        start = before.rfind(b"\n")
        if start >= 0:
            return line, len(before) - start
        return line, offset - self._start_of_line(piece * _PIECE) + 1

    def line(self, offset: int) -> int:
        """Line of a character, counted from 1: from the last one that was asked for, if near."""
        known, line = self.__dict__.get("_near", (0, 1))
        if not known <= offset < known + _PIECE:
            line = self.position(offset)[0]
        elif isinstance(self.content, str):
            line += self.content.count("\n", known, offset)
        else:
            line += self.data[known:offset].tobytes().count(b"\n")
        self.__dict__["_near"] = offset, line
        return line

    def learn(self, start: int, stops: NDArray[np.int64], line: int) -> None:
        """What a reader of lines knows already: line `line` begins at `start`, and each stop is
        the offset behind one of the lines from there on, without a gap."""
        self._line_index.learn(start, stops, line)

    def line_text(self, line: int) -> str:
        """The text of line `line` (from 1) without its end-of-line characters."""
        start = self.line_start(line)
        return self.part(start, self.end_of_line(start)).rstrip("\r\n")

    def line_start(self, line: int) -> int:
        """Offset of the first character of line `line` (from 1)."""
        piece = self._line_index.piece_of_line(line)
        start = piece * _PIECE
        for _ in range(line - 1 - self._line_index.before(piece)):
            start = self.end_of_line(start) + 1
        return start

    def _start_of_line(self, offset: int) -> int:
        while offset > 0:
            first = max(0, offset - _PIECE)
            at = self.data[first:offset].tobytes().rfind(b"\n")
            if at >= 0:
                return first + at + 1
            offset = first
        return 0

    @cached_property
    def _line_index(self) -> _LineIndex:
        return _LineIndex(self.data, self.forget)


class _LineIndex:
    """How many line feeds stand before each piece of a text; counted as far as was asked for."""

    def __init__(self, data: NDArray[np.uint8], forget: Callable[[int], None]) -> None:
        self.data, self.forget = data, forget
        self.counts = np.zeros(1, dtype=np.int64)

    def before(self, piece: int) -> int:
        """Line feeds before the piece, which begins at `piece * _PIECE`."""
        if piece >= len(self.counts):
            self._count(max(piece, len(self.counts) + AHEAD))
        return int(self.counts[piece])

    def piece_of_line(self, line: int) -> int:
        """The last piece that begins before the line does, or the first."""
        pieces = len(self.data) // _PIECE
        while self.counts[-1] < line - 1 and len(self.counts) <= pieces:
            self._count(len(self.counts) + AHEAD)
        return max(0, int(np.searchsorted(self.counts, line - 1, side="left")) - 1)

    def learn(self, start: int, stops: NDArray[np.int64], line: int) -> None:
        """See `Source.learn`; lines behind a part that is not counted yet are left alone."""
        known, last = len(self.counts), int(stops[-1]) // _PIECE
        if start <= known * _PIECE and known <= last:
            begins = np.arange(known, last + 1) * _PIECE
            counts = line - 1 + np.searchsorted(stops, begins, side="right")
            self.counts = np.concatenate([self.counts, counts])

    def _count(self, last: int) -> None:
        known, last = len(self.counts), min(last, len(self.data) // _PIECE)
        counts = np.empty(last + 1, dtype=np.int64)
        counts[:known] = self.counts
        for first in range(known - 1, last, 1024):  # all at once would double the memory
            stop = min(first + 1024, last)
            rows = self.data[first * _PIECE : stop * _PIECE].reshape(-1, _PIECE)
            lines = np.count_nonzero(rows == 10, axis=1)
            counts[first + 1 : stop + 1] = counts[first] + np.cumsum(lines)
            self.forget(stop * _PIECE)
        self.counts = counts


class Span(NamedTuple):
    """The characters `start` to `end` (end not included) of a source."""

    source: Source
    start: int
    end: int

    @property
    def line(self) -> int:
        return self.source.line(self.start)

    @property
    def column(self) -> int:
        return self.source.position(self.start)[1]

    @property
    def text(self) -> str:
        return self.source.part(self.start, self.end)

    @property
    def place(self) -> str:
        """`file:line`, the form in which origins are printed."""
        return f"{self.source.name}:{self.line}"


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """What the user wrote wrong: a stable id, a sentence, a place, and what would be right.

    `id` is the control's own number where it has one for the same mistake, else an `N` number of
    ours; both are explained in `catalogue`. `span` is None only where no text is to blame.
    """

    id: str
    message: str
    span: Span | None = None
    hint: str = ""
    severity: Severity = Severity.ERROR
    notes: tuple[tuple[str, Span], ...] = ()

    @property
    def is_error(self) -> bool:
        return self.severity is Severity.ERROR

    @property
    def file(self) -> str | None:
        return self.span.source.name if self.span else None

    @property
    def line(self) -> int | None:
        return self.span.line if self.span else None

    @property
    def column(self) -> int | None:
        return self.span.column if self.span else None


def diagnostic(
    id: str,
    span: Span | None,
    message: str,
    hint: str = "",
    *,
    severity: Severity | None = None,
    notes: tuple[tuple[str, Span], ...] = (),
) -> Diagnostic:
    """A diagnostic whose severity, unless given, is the one of the catalogue.

    Raises KeyError for an id that the catalogue does not explain.
    """
    entry = CATALOGUE[id]
    return Diagnostic(id, message, span, hint, severity or _SEVERITIES[entry.severity], notes)


def render(item: Diagnostic) -> str:
    """The diagnostic as plain text: place, sentence, the line with a marker, the repair.

    Tabs of the line are shown as one blank so that the marker stands under its character.
    """
    head = f"{item.severity} {item.id}: {item.message}"
    if item.span is None:
        return head + (f"\n  help: {item.hint}" if item.hint else "")
    parts = [f"{item.span.place}:{item.span.column}: {head}", *_excerpt(item.span)]
    for text, span in item.notes:
        parts.append(f"  note: {text} ({span.place})")
        parts.extend(_excerpt(span))
    if item.hint:
        parts.append(f"  help: {item.hint}")
    return "\n".join(parts)


def _excerpt(span: Span) -> list[str]:
    line, column = span.source.position(span.start)
    start = span.start - (column - 1)
    text = span.source.part(start, span.source.end_of_line(start)).rstrip("\r\n")
    text = _printable(text)
    width = max(1, min(span.end - span.start, len(text) - column + 1))
    first, text, column = _window(text, column)
    number = str(line)
    return [
        f"  {number} | {first}{text}",
        f"  {' ' * len(number)} | {' ' * (len(first) + column - 1)}^{'~' * (min(width, 60) - 1)}",
    ]


def _window(text: str, column: int, width: int = 120) -> tuple[str, str, int]:
    """A very long line is cut to the part around the column."""
    if len(text) <= width:
        return "", text, column
    start = max(0, column - 1 - width // 2)
    return ("..." if start else ""), text[start : start + width], column - start


def _printable(text: str) -> str:
    """Control characters of a hostile file must not reach the terminal."""
    return "".join(c if c.isprintable() else " " for c in text)
