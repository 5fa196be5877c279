"""A list file as text and entries: read without loss, edited in place, written back unchanged.

Enters: the bytes of a list. Leaves: `ListDocument`. Knows the syntax of lists and no key of them.
Source: ZERO 1.3 and 1.4.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cached_property

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic

ENCODING = "latin-1"
"""Every byte is one character, so that any file can be written back unchanged."""

_INDICES = r"(?:\[\d{1,9}\])*"
_KEY = rf"[A-Za-z_]\w*{_INDICES}(?:\.\w+{_INDICES})*"
_ENTRY = re.compile(rf"[ \t]*(?P<key>{_KEY})(?=[ \t\r\f\v]|$)[ \t]*", re.ASCII)
_TOKEN = r"(?:(?!/\*)[^\s(#])+"
_VALUE = re.compile(rf"{_TOKEN}(?:[ \t]*\|[ \t]*{_TOKEN})*")
_FILLER = re.compile(r"\.{2,}|:+|\u2026|\x85|\xe2\x80\xa6")
_FENCE = re.compile(r"```.*|~~~.*")
_NUMBER_ALONE = re.compile(r"[+-]?\d[\d.,eExX+-]*")
BYTE_ORDER_MARKS = ("\xef\xbb\xbf", "\xff\xfe", "\xfe\xff")


@dataclass(frozen=True, slots=True)
class Entry:
    """One `key value` line. `indices` are all index numbers of the key from left to right.

    `value_span` is empty, at the end of the key, when the value is missing. `rest` is what stands
    behind the value.
    """

    key: str
    indices: tuple[int, ...]
    value_text: str
    key_span: Span
    value_span: Span
    rest: str = ""

    @property
    def place(self) -> str:
        return self.key_span.place


@dataclass(frozen=True)
class ListDocument:
    """A list: its whole text, its entries in file order, and what is wrong with its lines."""

    source: Source
    entries: tuple[Entry, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = field(default=(), repr=False)

    @property
    def name(self) -> str:
        return self.source.name

    @property
    def text(self) -> str:
        return self.source.text

    @classmethod
    def from_text(cls, text: str, name: str = "list") -> ListDocument:
        """The document of a text; never fails."""
        return _Parser(Source(name, text)).document()

    @classmethod
    def from_bytes(cls, data: bytes, name: str = "list") -> ListDocument:
        """The document of a file's bytes; never fails."""
        return cls.from_text(data.decode(ENCODING), name)

    def to_bytes(self) -> bytes:
        """The bytes that the document was read from, or that it was edited to."""
        return self.text.encode(ENCODING)

    def get(self, key: str) -> Entry | None:
        """The entry that counts for a key: the last one."""
        return self._last.get(key)

    def with_value(self, key: str, value: str) -> ListDocument:
        """The document with another value for a key; every other character stays.

        Where the key stands more than once, the last entry is changed, since it counts.
        Raises KeyError without such an entry, ValueError for text that is not one list value.
        """
        if not _VALUE.fullmatch(value):
            raise ValueError(f"{value!r} cannot be a list value: it must be one word without '('")
        value.encode(ENCODING)
        entry = self._last[key]
        span = entry.value_span
        new = value if entry.value_text else " " + value
        text = self.text[: span.start] + new + self.text[span.end :]
        return ListDocument.from_text(text, self.name)

    @cached_property
    def _last(self) -> dict[str, Entry]:
        return {entry.key: entry for entry in self.entries}


class _Parser:
    """One pass over the lines of a source."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.entries: list[Entry] = []
        self.found: list[Diagnostic] = []
        self.without_value: Entry | None = None

    def document(self) -> ListDocument:
        offset = self._after_mark()
        if self._is_no_text(offset) or self._has_no_line_end(offset):
            return ListDocument(self.source, (), tuple(self.found))
        for line in self.source.text[offset:].split("\n"):
            if not self._line(line.rstrip("\r"), offset):
                break
            offset += len(line) + 1
        self._close_missing_value(None)
        return ListDocument(self.source, tuple(self.entries), tuple(self.found))

    def _after_mark(self) -> int:
        mark = next((m for m in BYTE_ORDER_MARKS if self.source.text.startswith(m)), "")
        if mark:
            span = Span(self.source, 0, len(mark))
            message = "the file begins with a byte order mark, which the control rejects"
            hint = "save the list as ANSI (Latin-1) text"
            self.found.append(diagnostic("21798", span, message, hint))
        return len(mark)

    def _is_no_text(self, offset: int) -> bool:
        """Reports zero bytes, which no text has; behind its end old editors filled up with them."""
        at = self.source.text.rstrip("\0\x1a").find("\0", offset)
        if at < 0:
            return False
        hint = "save the list as ANSI (Latin-1) text"
        span = Span(self.source, at, at + 1)
        self.found.append(
            diagnostic("N3006", span, "the list is no text: it holds zero bytes", hint)
        )
        return True

    def _has_no_line_end(self, offset: int) -> bool:
        """Reports lines that end with CR alone: all of them are one line to the control."""
        text = self.source.text[offset:].strip()
        if "\n" in text or "\r" not in text:
            return False
        hint = "save the list with line ends CR LF or LF; in this one they are CR alone"
        span = Span(self.source, offset, offset + 1)
        self.found.append(diagnostic("20301", span, "the list has no end of line", hint))
        return True

    def _line(self, line: str, offset: int) -> bool:
        """Take one line; False when it ends the list."""
        text = line.strip()
        if not text or text.startswith("#"):
            return True
        word = text.split(None, 1)[0]
        if word.lower() == "ende":
            return False
        match = _ENTRY.match(line)
        if match:
            self._close_missing_value(None)
            self._entry(line, offset, match)
        elif self.without_value and _NUMBER_ALONE.fullmatch(word):
            self._close_missing_value(self._span(line, offset))
        else:
            self._not_an_entry(line, offset)
        return True

    def _entry(self, line: str, offset: int, match: re.Match[str]) -> None:
        key = match["key"]
        start, end = match.span("key")
        value = _VALUE.match(line, match.end())
        first, last = value.span() if value else (end, end)
        entry = Entry(
            key,
            tuple(int(n) for n in re.findall(r"\[(\d+)\]", key)),
            value.group() if value else "",
            Span(self.source, offset + start, offset + end),
            Span(self.source, offset + first, offset + last),
            line[last:],
        )
        self.entries.append(entry)
        self.without_value = None if value else entry

    def _close_missing_value(self, next_line: Span | None) -> None:
        """Report the entry whose value is missing, now that the line after it is known."""
        entry, self.without_value = self.without_value, None
        if entry is None:
            return
        message = f"the value of {entry.key} is missing; the default is used"
        hint = f"write {entry.key} and its value in one line"
        notes = (("the value seems to stand here", next_line),) if next_line else ()
        self.found.append(diagnostic("1028", entry.key_span, message, hint, notes=notes))

    def _not_an_entry(self, line: str, offset: int) -> None:
        span = self._span(line, offset)
        if _FILLER.fullmatch(span.text):
            shown = span.text if span.text.isascii() else "..."
            message = f"'{shown}' stands for lines that were left out; it is skipped"
        elif _FENCE.fullmatch(span.text):
            message = f"'{span.text[:3]}' marks printed text and is no entry; it is skipped"
        else:
            message = "the line is not an entry 'key value'; it is skipped"
        self.found.append(diagnostic("N3001", span, message, "begin comment lines with '# '"))

    def _span(self, line: str, offset: int) -> Span:
        start = len(line) - len(line.lstrip())
        return Span(self.source, offset + start, offset + len(line.rstrip()))
