"""Texts that are open in an editor: edited by change sets, kept apart from the file until saved.

The editor counts a line end as one character. So a text whose lines all end with CR LF is kept
with plain line feeds here, and gets its own line ends back when it is run or saved; any other text
is kept as it is, lone carriage returns included.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ncscope.views.workbench.files import ENCODING

CRLF = "\r\n"


class OutOfStep(Exception):
    """A change set that belongs to another version of the text."""


@dataclass(frozen=True, slots=True)
class Change:
    """Characters `start` to `end` become `insert`; offsets before any change of the set."""

    start: int
    end: int
    insert: str


@dataclass(frozen=True)
class Buffer:
    """One text. `saved`: the bytes of the file; `version` counts the change sets."""

    text: str
    line_end: str
    saved: bytes
    version: int = 0

    @classmethod
    def of(cls, data: bytes) -> Buffer:
        text = data.decode(ENCODING)
        count = text.count(CRLF)
        if count and count == text.count("\n") == text.count("\r"):
            return cls(text.replace(CRLF, "\n"), CRLF, data)
        return cls(text, "\n", data)

    @property
    def exact(self) -> str:
        """The text with its own line ends."""
        return self.text.replace("\n", CRLF) if self.line_end == CRLF else self.text

    @property
    def data(self) -> bytes:
        return self.exact.encode(ENCODING)

    @property
    def changed(self) -> bool:
        return self.version > 0 and self.data != self.saved

    def edited(self, version: int, changes: Iterable[Change]) -> Buffer:
        """The text after a change set. Raises OutOfStep, and ValueError for impossible changes."""
        if version != self.version:
            raise OutOfStep
        parts, at = [], 0
        for change in changes:
            if not at <= change.start <= change.end <= len(self.text):
                raise ValueError("the change lies outside of the text")
            change.insert.encode(ENCODING)
            parts += [self.text[at : change.start], change.insert]
            at = change.end
        text = "".join([*parts, self.text[at:]])
        return replace(self, text=text, version=version + 1)

    def replaced(self, text: str) -> Buffer:
        """Another text in the same file. Raises ValueError for characters beyond Latin-1."""
        text.encode(ENCODING)
        return replace(self, text=text, version=self.version + 1)

    def after_save(self, data: bytes) -> Buffer:
        return replace(self, saved=data)
