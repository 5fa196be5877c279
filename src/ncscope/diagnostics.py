"""Where a text is wrong, and what would have been right.

Enters: source text and offsets into it. Leaves: frozen `Diagnostic` values and their rendering.
Knows nothing of NC blocks or machines. The ids and their explanations are in `catalogue`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ncscope.catalogue import CATALOGUE


class Severity(StrEnum):
    """How a diagnostic ends the run: an error stops it, the other two do not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True)
class Source:
    """A text and the name that the user knows it by."""

    name: str
    text: str = field(repr=False)

    @cached_property
    def data(self) -> NDArray[np.uint8]:
        """The text as bytes, one a character; `?` for a character beyond Latin-1."""
        return np.frombuffer(self.text.encode("latin-1", "replace"), dtype=np.uint8)

    @cached_property
    def line_starts(self) -> NDArray[np.int64]:
        """Offset of the first character of every line; line 1 is at index 0."""
        return np.concatenate(([0], np.flatnonzero(self.data == 10) + 1))

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of a character, both counted from 1."""
        line = int(np.searchsorted(self.line_starts, offset, side="right"))
        return line, offset - int(self.line_starts[line - 1]) + 1

    def line_text(self, line: int) -> str:
        """The text of line `line` (from 1) without its end-of-line characters."""
        start = int(self.line_starts[line - 1])
        end = int(self.line_starts[line]) if line < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")


@dataclass(frozen=True, slots=True)
class Span:
    """The characters `start` to `end` (end not included) of a source."""

    source: Source
    start: int
    end: int

    @property
    def line(self) -> int:
        return self.source.position(self.start)[0]

    @property
    def column(self) -> int:
        return self.source.position(self.start)[1]

    @property
    def text(self) -> str:
        return self.source.text[self.start : self.end]

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
    return Diagnostic(id, message, span, hint, severity or Severity(entry.severity), notes)


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
    text = _printable(span.source.line_text(line))
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
