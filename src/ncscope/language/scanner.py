"""The bulk scanner: plain motion blocks straight from bytes to columns.

Enters the bytes of a program and an offset at the start of a line. Leaves columns for the run of
plain blocks that begins there, and the offset of the first line that is none. A plain block is
`N` first, then G0 G1 G90 G91, one-letter axis words and F, each at most once and with a literal
number, and nothing else. Every other line is left to the parser, so nothing has to be decided
twice: what could be wrong is not plain.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.compilation import compiled

CHUNK = 65_536
"""Rows of one scan: bounds the memory of a run."""
LONGEST_LINE = 4000
"""A longer block is a mistake that the parser reports."""
_UNKNOWN = -1
_DIGITS = 15
"""So many digits, divided by a power of ten, give the same double as the parser's `float`."""
_POWERS = 10.0 ** np.arange(_DIGITS + 1)


@dataclass(frozen=True, slots=True)
class PlainRows:
    """Columns of plain blocks, one row each, in the units of the program.

    line: from 1. block, motion (0, 1), absolute (1 for G90, 0 for G91): -1 where not programmed.
    feed, values: NaN where not programmed. values: (rows, axes). stops: offset behind each row.
    """

    line: NDArray[np.int64]
    block: NDArray[np.int64]
    motion: NDArray[np.int8]
    absolute: NDArray[np.int8]
    feed: NDArray[np.float64]
    values: NDArray[np.float64]
    stops: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.line)


class Scanner:
    """Scans one program for one set of axes; its buffers serve every call."""

    def __init__(self, data: NDArray[np.uint8], axis_names: tuple[str, ...]) -> None:
        self.data = data
        self._size = _whole_lines(data)
        self.columns = np.full(256, _UNKNOWN, dtype=np.int64)
        for index, name in enumerate(axis_names):
            if len(name) == 1 and name in "ABCQUVWXYZ":
                self.columns[ord(name)] = index
        n = len(axis_names)
        self._line = np.empty(CHUNK, dtype=np.int64)
        self._block = np.empty(CHUNK, dtype=np.int64)
        self._codes = np.empty((CHUNK, 2), dtype=np.int8)
        self._feed = np.empty(CHUNK)
        self._values = np.empty((CHUNK, n))
        self._stops = np.empty(CHUNK, dtype=np.int64)

    def scan(self, offset: int, line: int) -> PlainRows:
        """The plain blocks from `offset`, which begins line `line`, up to CHUNK rows."""
        count = _scan(
            self.data, self._size, offset, line, self.columns, _POWERS, self._line, self._block,
            self._codes, self._feed, self._values, self._stops,
        )  # fmt: skip
        return PlainRows(
            self._line[:count],
            self._block[:count],
            self._codes[:count, 0],
            self._codes[:count, 1],
            self._feed[:count],
            self._values[:count],
            self._stops[:count],
        )


@compiled
def _whole_lines(data):
    """Offset behind the last line feed: a line without one is left to the parser."""
    size = len(data)
    while size > 0 and data[size - 1] != 10:
        size -= 1
    return size


@compiled
def _scan(data, size, at, line, columns, powers, lines, blocks, codes, feeds, values, stops):
    """Rows read; a blank line between plain blocks belongs to the run. Each line before `size`
    ends with a line feed, so that no loop below it needs another end."""
    count = 0
    while at < size and count < len(lines):
        stop = _read_line(data, at, columns, powers, blocks, codes, feeds, values, count)
        if stop < 0:
            break
        if stop > 0:
            lines[count], stops[count] = line, stop
            count += 1
            at = stop
        else:  # a blank line
            while data[at] != 10:
                at += 1
            at += 1
        line += 1
    return count


@compiled
def _read_line(data, at, columns, powers, blocks, codes, feeds, values, row):
    """Offset behind the line when it is plain, 0 for a blank line, -1 for any other."""
    longest = at + LONGEST_LINE - 40
    blocks[row], codes[row, 0], codes[row, 1] = -1, -1, -1
    feeds[row] = np.nan
    for k in range(values.shape[1]):
        values[row, k] = np.nan
    words, axes = 0, 0
    while True:
        char = data[at]
        if char == 32 or char == 9 or (char == 13 and data[at + 1] == 10):
            at += 1
            continue
        if char == 10:
            break
        if at > longest:
            return -1
        mantissa, digits, decimals, negative, at = _number(data, at + 1)
        if at < 0:
            return -1
        whole = decimals < 0 and not negative
        if char == 78:  # N
            if words > 0 or not whole or digits > 9:
                return -1
            blocks[row] = mantissa
        elif char == 71:  # G
            if not whole or not _set_code(codes, row, mantissa):
                return -1
        elif char == 70:  # F
            feed = mantissa / powers[max(decimals, 0)]
            if negative or feed <= 0.0 or not np.isnan(feeds[row]):
                return -1
            feeds[row] = feed
        else:
            column = columns[char]
            if column < 0 or not np.isnan(values[row, column]):
                return -1
            value = mantissa / powers[max(decimals, 0)]
            values[row, column] = -value if negative else value
            axes += 1
        words += 1
    if words == 0:
        return 0
    return at + 1 if axes else -1


@compiled
def _set_code(codes, row, number):
    """G0 G1 G90 G91, one of each group; False for any other."""
    if number == 0 or number == 1:
        if codes[row, 0] >= 0:
            return False
        codes[row, 0] = number
        return True
    if number == 90 or number == 91:
        if codes[row, 1] >= 0:
            return False
        codes[row, 1] = 91 - number
        return True
    return False


@compiled
def _number(data, at):
    """Digits at `at` after blanks and one sign: mantissa, digit count, decimals (-1 without a
    point), sign, and the offset behind; offset -1 when this is no literal or too long to be exact.
    """
    while data[at] == 32 or data[at] == 9:
        at += 1
    negative = data[at] == 45
    if negative or data[at] == 43:
        at += 1
    first, mantissa = at, np.int64(0)
    while 48 <= data[at] <= 57:
        mantissa = mantissa * 10 + np.int64(data[at] - 48)
        at += 1
    digits, decimals = at - first, -1
    if data[at] == 46:
        at += 1
        first = at
        while 48 <= data[at] <= 57:
            mantissa = mantissa * 10 + np.int64(data[at] - 48)
            at += 1
        decimals = at - first
        digits += decimals
    if digits == 0 or digits > _DIGITS or not _ends_number(data[at]):
        return mantissa, digits, decimals, negative, -1
    return mantissa, digits, decimals, negative, at


@compiled
def _ends_number(char):
    """A blank, an end of line, or a letter that begins the next word."""
    return char == 32 or char == 9 or char == 10 or char == 13 or 65 <= char <= 90
