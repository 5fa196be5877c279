"""Rows of numbers and the text between them, joined byte by byte.

A row of output is a fixed text with numbers in its gaps. The digits come from orjson, a whole
array in one call; here they are copied into their gaps. The one function runs as it is for a few
rows and compiled for many, so that a short run does not wait for the compiler to load.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from ncscope.compilation import compiled
from ncscope.frames import Array

COMPILED_FROM = 300
"""Rows from which the compiled function is worth its loading."""
_DIGITS = 20
_ZERO, _MINUS, _COMMA, _OPEN, _CLOSE, _N = (ord(c) for c in "0-,[]n")


@dataclass(frozen=True)
class Template:
    """The fixed text of a row: `pieces[k]` stands before the k-th gap, the last one at the end.

    The gaps are: whole numbers, one code (as its word of `words`), real numbers. `none` stands for
    a real number that is NaN and for a last whole number below zero.
    """

    pieces: tuple[str, ...]
    words: tuple[str, ...]
    none: str

    def rows(self, whole: NDArray[np.int64], codes: NDArray[np.int8], real: Array) -> str:
        """One line of text for each row of the arrays (m, i), (m,) and (m, f)."""
        digits = orjson.dumps(np.ascontiguousarray(real), option=orjson.OPT_SERIALIZE_NUMPY)
        pieces, words, none = (_packed(t) for t in (self.pieces, self.words, (self.none,)))
        fixed = len(pieces[0]) + max(map(len, self.words)) + whole.shape[1] * _DIGITS
        gaps = real.size * max(0, len(self.none) - 4)
        out = np.empty(len(whole) * (fixed + len(none[0])) + len(digits) + gaps, dtype=np.uint8)
        join = _compiled() if len(whole) >= COMPILED_FROM else splice
        text = np.frombuffer(digits, dtype=np.uint8)
        size = join(out, text, whole, codes, *pieces, *words, none[0])
        return out[:size].tobytes().decode()


def _packed(texts: tuple[str, ...]) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """All texts as bytes, and the offset where each begins; the last offset is the end."""
    parts = [text.encode() for text in texts]
    offsets = np.cumsum([0, *map(len, parts)])
    return np.frombuffer(b"".join(parts), dtype=np.uint8), offsets


@cache
def _compiled() -> Any:
    return compiled(splice)


def splice(out, digits, whole, codes, pieces, piece_at, words, word_at, none):
    """Fills `out` and returns its used length; `digits` is `[[1.5,null],[2.0,3.25]]`."""
    at, source, gaps = 0, 2, len(piece_at) - 1
    wholes = whole.shape[1]
    for row in range(len(whole)):
        for gap in range(gaps):
            for k in range(piece_at[gap], piece_at[gap + 1]):
                out[at] = pieces[k]
                at += 1
            if gap < wholes:
                value = whole[row, gap]
                if value < 0:
                    for k in range(len(none)):
                        out[at] = none[k]
                        at += 1
                    continue
                length = 1
                rest = value // 10
                while rest > 0:
                    length += 1
                    rest //= 10
                for k in range(length):
                    out[at + length - 1 - k] = _ZERO + value % 10
                    value //= 10
                at += length
            elif gap == wholes:
                for k in range(word_at[codes[row]], word_at[codes[row] + 1]):
                    out[at] = words[k]
                    at += 1
            elif gap < gaps - 1:
                if digits[source] == _N:
                    for k in range(len(none)):
                        out[at] = none[k]
                        at += 1
                    source += 4
                while digits[source] != _COMMA and digits[source] != _CLOSE:
                    out[at] = digits[source]
                    at += 1
                    source += 1
                source += 1
        source += 2
    return at
