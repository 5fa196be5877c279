"""Rows of numbers and the text between them, joined byte by byte.

A row of output is a fixed text with numbers in its gaps. The digits come from orjson, a whole
array in one call; here they are copied into their gaps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import orjson
from numpy.typing import NDArray

from ncscope.compilation import compiled
from ncscope.frames import Array

_DIGITS = 20
_ZERO, _COMMA, _CLOSE, _N = (ord(c) for c in "0,]n")
_NOTHING, _ONE, _TWO, _FOUR = (np.uint64(k) for k in (0, 1, 2, 4))


@dataclass(frozen=True)
class Template:
    """The fixed text of a row: `pieces[k]` stands before the k-th gap, the last one at the end.

    The gaps are: whole numbers, one code (as its word of `words`), real numbers. `none` stands for
    a real number that is NaN and for a last whole number below zero.
    """

    pieces: tuple[str, ...]
    words: tuple[str, ...]
    none: str

    def rows(
        self, whole: NDArray[np.int64], codes: NDArray[np.int8], real: Array
    ) -> NDArray[np.uint8]:
        """One line of UTF-8 text for each row of the arrays (m, i), (m,) and (m, f)."""
        digits = orjson.dumps(np.ascontiguousarray(real), option=orjson.OPT_SERIALIZE_NUMPY)
        pieces, words, none = (_packed(t) for t in (self.pieces, self.words, (self.none,)))
        fixed = len(pieces[0]) + max(map(len, self.words)) + whole.shape[1] * _DIGITS
        gaps = real.size * max(0, len(self.none) - 4)
        out = np.empty(len(whole) * (fixed + len(none[0])) + len(digits) + gaps, dtype=np.uint8)
        text = np.frombuffer(digits, dtype=np.uint8)
        size = splice(out, text, whole, codes, *pieces, *words, none[0])
        return out[: int(size)]


def _packed(texts: tuple[str, ...]) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """All texts as bytes, and the offset where each begins; the last offset is the end."""
    parts = [text.encode() for text in texts]
    offsets = np.cumsum([0, *map(len, parts)])
    return np.frombuffer(b"".join(parts), dtype=np.uint8), offsets


@compiled
def splice(out, digits, whole, codes, pieces, piece_at, words, word_at, none):
    """Fills `out` and returns its used length; `digits` is `[[1.5,null],[2.0,3.25]]`.

    Places are unsigned: a signed index would be compared with zero at each character.
    """
    at, source, gaps = _NOTHING, _TWO, len(piece_at) - 1
    wholes = whole.shape[1]
    for row in range(len(whole)):
        for gap in range(gaps):
            at = _copied(out, at, pieces, piece_at[gap], piece_at[gap + 1])
            if gap < wholes:
                at = _written(out, at, whole[row, gap], none)
            elif gap == wholes:
                code = codes[row]
                at = _copied(out, at, words, word_at[code], word_at[code + 1])
            elif gap < gaps - 1:
                if digits[source] == _N:
                    at = _copied(out, at, none, 0, len(none))
                    source += _FOUR
                char = digits[source]
                while char != _COMMA and char != _CLOSE:
                    out[at] = char
                    at += _ONE
                    source += _ONE
                    char = digits[source]
                source += _ONE
        source += _TWO
    return at


@compiled
def _copied(out, at, text, start, stop):
    for place in range(np.uint64(start), np.uint64(stop)):
        out[at] = text[place]
        at += _ONE
    return at


@compiled
def _written(out, at, value, none):
    """The digits of a whole number; `none` for one below zero."""
    if value < 0:
        return _copied(out, at, none, 0, len(none))
    rest, length = value // 10, _ONE
    while rest > 0:
        length += _ONE
        rest //= 10
    end = at + length
    for k in range(_ONE, length + _ONE):
        out[end - k] = _ZERO + value % 10
        value //= 10
    return end
