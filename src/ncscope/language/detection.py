"""Whether a text holds control flow or calls, so that its blocks do not just follow each other.

Enters a source. Leaves a yes or a no, quickly: programs of millions of lines are asked. Marks in
comments and in texts do not count, so a remark about a price keeps a program plain.
Source: TF5200 programming manual, comments and subprograms.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from ncscope.compilation import compiled, load
from ncscope.diagnostics import Source
from ncscope.language.lexer import tokens

PIECE = 4_000_000
"""Characters that are looked at together, and a little more up to the end of the line."""

_MARKS = (
    re.compile(r"\$"),
    re.compile(r"#[ \t\0\r]*(?:IF|ELSE|ENDIF)(?![A-Za-z])", re.IGNORECASE),
    re.compile(r"%[ \t\0\r]*L[ \t\0\r]", re.IGNORECASE),
)
_DOLLAR, _HASH, _PERCENT, _L, _CASE = (np.uint8(ord(char)) for char in "$#%l ")
"""A capital letter is the small one without the bit of the blank."""
_CALL = re.compile(r"LL?(?=[ \t\0\r\n\"]|\Z)", re.IGNORECASE)


def needs_layout(source: Source) -> bool:
    """Whether the text may hold control flow or calls; never wrong with False."""
    start, data = 0, None
    if len(source) > PIECE:
        load()
        data = source.data
    while start < len(source):
        stop = source.end_of_line(start + PIECE) + 1
        if data is None or _holds_mark(data, start, min(stop, len(data))):
            text = source.part(start, stop)
            if any(not _is_hidden(text, at, start == 0) for at in _marks(text)):
                return True
        start = stop
        source.forget(start)
    return False


def _marks(text: str) -> Iterator[int]:
    """Offsets of what looks like control flow, found by plain search first."""
    for letter, pattern in zip("$#%", _MARKS, strict=True):
        for at in _occurrences(text, letter):
            if pattern.match(text, at):
                yield at
    for letter in "Ll":
        for at in _occurrences(text, letter):
            if _CALL.match(text, at) and not _inside_word(text, at):
                yield at


def _occurrences(text: str, letter: str) -> Iterator[int]:
    at = text.find(letter)
    while at >= 0:
        yield at
        at = text.find(letter, at + 1)


def _inside_word(text: str, at: int) -> bool:
    before = text[at - 1 : at]
    return before.isalpha() or before in ("_", ".")


def _is_hidden(text: str, at: int, is_first: bool) -> bool:
    """Whether the character stands in a comment or a text of its line.

    A line behind one with a backslash may continue it, with an open text or comment: nothing in it
    counts as hidden. The same holds for the first line of a piece that is not the first.
    """
    start = text.rfind("\n", 0, at) + 1
    if start == 0 and not is_first:
        return False
    before = text.rfind("\n", 0, max(start - 1, 0)) + 1
    if "\\" in text[before:start]:
        return False
    for token in tokens(text, start):
        if at < token.start + len(token.text):
            return token.kind in ("comment", "string")
    return False


@compiled
def _holds_mark(data, start, stop):
    """Whether a character that `_marks` looks for is in these bytes: $ # % L l."""
    found = 0
    for char in data[start:stop]:  # counted without a branch, so that many are looked at in one
        found += (char == _DOLLAR) | (char == _HASH) | (char == _PERCENT) | (char | _CASE == _L)
    return found > 0
