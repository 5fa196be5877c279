"""Tokens of one logical line, and the line with its comments blanked out.

Enters a text and the offset where a line begins. Leaves tokens that cover every character of that
line, and `Line`, the code that the parser reads. Knows nothing of words or commands.
Source: TF5200 programming manual, comments and continuation of blocks.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from ncscope.diagnostics import Source

BLANKS = " \t\0\r"
LONGEST_LINE = 4000
_WINDOW = 3 * LONGEST_LINE
"""Characters that are read at first; joined lines may need more."""

_PIECE = re.compile(
    r"""(?P<blank>[ \t\0\r]+)
      | (?P<end>\n)
      | (?P<remark>[;(])
      | (?P<string>"(?:\\"|[^"\n])*")
      | (?P<number>[0-9]+(?:\.[0-9]*)?|\.[0-9]+)
      | (?P<word>[^\W0-9]\w*)
      | (?P<operator>\*\*|&&|\|\||[=!<>]=|[-+*/]=|[-+*/&|^=<>\[\],.:@\#$%])
      | (?P<join>\\)
      | (?P<open_string>"[^\n]*)
      | (?P<stray>.)""",
    re.VERBOSE,
)
_COARSE = re.compile(
    r"""(?P<plain>[^\\(;"\n]+)
      | (?P<end>\n)
      | (?P<remark>[;(])
      | (?P<string>"(?:\\"|[^"\n])*")
      | (?P<join>\\)
      | (?P<open_string>"[^\n]*)""",
    re.VERBOSE,
)
"""Code as long pieces, where only comments and joins are looked for."""
_BRACKET = re.compile(r"[()]")
_AFTER_JOIN = re.compile(r"\\[ \t\0\r]*(?=[;(\n]|\Z)")
_NEEDS_TOKENS = re.compile(r"[\\(;\"]")
_JOINS_OR_QUOTES = re.compile(r"[\\\"]")


class Token(NamedTuple):
    """`kind` is blank, comment, join, end, string, number, word, operator or stray."""

    kind: str
    text: str
    start: int


class Line(NamedTuple):
    """One logical line: `code` has a blank for every character of a comment or a join.

    `code[i]` stands at offset `start + i` of the source; the next line begins at `stop`.
    """

    code: str
    start: int
    stop: int
    too_long: bool


def tokens(text: str, start: int = 0) -> Iterator[Token]:
    """The tokens of the logical line at `start`; their texts joined are the source text.

    A backslash before the end of the line, or before a comment that runs to it, joins the next
    line. Inside an open bracket, empty and commented lines after a join belong to the line too.
    """
    return _pieces(text, start, _PIECE)


def _pieces(text: str, start: int, pattern: re.Pattern[str]) -> Iterator[Token]:
    at, depth, joined, written = start, 0, False, True
    while at < len(text):
        token = _token(text, at, joined, pattern)
        yield token
        at = token.start + len(token.text)
        if token.kind in ("operator", "plain"):
            depth += token.text.count("[") - token.text.count("]")
        if token.kind == "join":
            joined, written = True, False
        elif token.kind == "end":
            if written or depth <= 0 or not joined:
                return
        elif token.kind not in ("blank", "comment") and token.text.strip(BLANKS):
            written = True


def read_line(source: Source, start: int) -> Line:
    """The logical line at `start`. Most lines have no comment and are taken as they are."""
    code = source.rest_of_line(start)
    stop = start + len(code)
    found = _NEEDS_TOKENS.search(code)
    if found is None:
        return Line(code, start, min(stop + 1, len(source)), len(code) > LONGEST_LINE)
    if _JOINS_OR_QUOTES.search(code) is None:
        end = min(stop + 1, len(source))
        shown = _without_comments(code, found.start()) + " " * (end - stop)
        return Line(shown, start, end, len(code) > LONGEST_LINE)
    size = _WINDOW
    while True:
        text = source.part(start, start + size)
        line = _joined_line(text, start)
        if line.stop < start + len(text) or start + len(text) >= len(source):
            return line
        size *= 4


def _without_comments(code: str, at: int) -> str:
    """A line without joins and strings, with a blank for each character of its comments; the
    first one begins at `at`."""
    while at < len(code):
        end = _line_end(code, at) if code[at] == ";" else _closing(code, at)
        code = code[:at] + " " * (end - at) + code[end:]
        found = _NEEDS_TOKENS.search(code, end)
        at = len(code) if found is None else found.start()
    return code


def _joined_line(text: str, offset: int) -> Line:
    """The logical line at the beginning of the text, which stands at `offset` of the source."""
    pieces = []
    length = longest = 0
    for token in _pieces(text, 0, _COARSE):
        hidden = token.kind in ("comment", "join", "end")
        pieces.append(" " * len(token.text) if hidden else token.text)
        length = 0 if "\n" in token.text else length + len(token.text)
        longest = max(longest, length)
    code = "".join(pieces)
    return Line(code, offset, offset + len(code), longest > LONGEST_LINE)


def _token(text: str, at: int, joined: bool, pattern: re.Pattern[str]) -> Token:
    match = pattern.match(text, at)
    assert match is not None and match.lastgroup is not None
    kind = match.lastgroup
    if kind == "remark":
        return _comment(text, at, joined)
    if kind == "join":
        return _join(text, at)
    if kind == "open_string":
        kind = "stray"
    return Token(kind, match.group(), at)


def _comment(text: str, at: int, joined: bool) -> Token:
    end = _line_end(text, at) if text[at] == ";" else _closing(text, at)
    comment = text[at:end]
    if joined and text[at] == ";" and comment.rstrip(BLANKS).endswith("\\"):
        return Token("join", text[at : end + 1], at)
    return Token("comment", comment, at)


def _closing(text: str, at: int) -> int:
    """The offset after the bracket that closes the comment, or the end of the line."""
    depth, end = 0, _line_end(text, at)
    if text.find(")", at, end) < 0:
        return end
    for match in _BRACKET.finditer(text, at, end):
        depth += 1 if match.group() == "(" else -1
        if depth == 0:
            return match.end()
    return end


def _join(text: str, at: int) -> Token:
    """A backslash joins only if nothing but comments follows in its line."""
    match = _AFTER_JOIN.match(text, at)
    end = match.end() if match else -1
    while 0 <= end < len(text) and text[end] in ";(":
        end = _line_end(text, end) if text[end] == ";" else _closing(text, end)
        while end < len(text) and text[end] in BLANKS:
            end += 1
    if end < 0 or (end < len(text) and text[end] != "\n"):
        return Token("stray", text[at], at)
    return Token("join", text[at : end + 1], at)


def _line_end(text: str, at: int) -> int:
    end = text.find("\n", at)
    return len(text) if end < 0 else end
