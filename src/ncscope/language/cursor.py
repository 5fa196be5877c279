"""The place in a line up to which the parser has read.

Enters a source and one line of it. Leaves pieces of that line and their spans. A mistake raises
`Mistake`, which only `parser` catches: the rest of the block is skipped.
"""

from __future__ import annotations

import re

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.language.lexer import BLANKS

_BLANK_RUN = re.compile(r"[ \t\0\r]*")
_BLANK_OR_END = frozenset(("", *BLANKS))
_RUN = re.compile(r"\w+")
_WORD = re.compile(r"[A-Za-z_]\w*")

# More brackets or operators than this in one expression are 20386; it bounds the recursion.
DEEPEST = 40
MOST_OPERATORS = 150


class Mistake(Exception):
    """A block cannot be read; carries the diagnostic."""

    def __init__(self, item: Diagnostic) -> None:
        super().__init__(item.message)
        self.item = item


class Cursor:
    """`code` is the line, `at` the index of the next character in it."""

    __slots__ = ("at", "base", "code", "depth", "operators", "source")

    def __init__(self, source: Source, code: str, base: int) -> None:
        self.source = source
        self.code = code
        self.base = base
        self.at = 0
        self.depth = 0
        self.operators = 0

    @property
    def char(self) -> str:
        """The next character, '' at the end."""
        return self.code[self.at : self.at + 1]

    @property
    def at_end(self) -> bool:
        return self.at >= len(self.code)

    def skip(self) -> str:
        """Skips blanks; returns the next character."""
        char = self.code[self.at : self.at + 1]
        if char not in _BLANK_OR_END:
            return char
        match = _BLANK_RUN.match(self.code, self.at)
        assert match is not None
        self.at = match.end()
        return self.char

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """The pattern at the next character, which is then behind us."""
        found = pattern.match(self.code, self.at)
        if found is not None:
            self.at = found.end()
        return found

    def looks_at(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """The pattern at the next character, without moving."""
        return pattern.match(self.code, self.at)

    def take(self, text: str) -> bool:
        """Skips blanks and `text`, if it stands there."""
        self.skip()
        if not self.code.startswith(text, self.at):
            return False
        self.at += len(text)
        return True

    def word(self) -> str:
        """The identifier at the next character, '' if none; does not move."""
        found = _WORD.match(self.code, self.at)
        return found.group() if found else ""

    def span(self, start: int, end: int | None = None) -> Span:
        """The span from index `start` of the line to `end`, by default up to here."""
        stop = self.at if end is None else end
        return Span(self.source, self.base + start, self.base + stop)

    def here(self) -> Span:
        """The next word or character; an empty span at the end of the line."""
        found = _RUN.match(self.code, self.at)
        width = len(found.group()) if found else len(self.char)
        return self.span(self.at, self.at + width)

    def written_end(self) -> int:
        """The index after the last character before here that is no blank."""
        return len(self.code[: self.at].rstrip(BLANKS))

    def deeper(self, levels: int) -> None:
        self.depth += levels
        if self.depth > DEEPEST:
            raise self.mistake("20386", "The expression is nested too deeply.")

    def count_operator(self) -> None:
        self.operators += 1
        if self.operators > MOST_OPERATORS:
            raise self.mistake("20386", "The expression has too many terms.")

    def mistake(self, id: str, message: str, hint: str = "", span: Span | None = None) -> Mistake:
        """The exception to raise; without a span the next word is to blame."""
        return Mistake(diagnostic(id, span or self.here(), message, hint))
