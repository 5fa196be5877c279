"""The bulk scanner: plain motion blocks straight from bytes to columns.

Enters the bytes of a program and an offset at the start of a line. Leaves columns for the run of
plain blocks that begins there, and the offset of the first line that is none. A plain block is
`N` first, then G0 to G3, G90 G91, one-letter axis words, I J K R and F, each at most once and with
a literal number, and nothing else but comments. Every other line is left to the parser, so nothing
has to be decided twice: what could be wrong is not plain.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.compilation import compiled

AXIS_LETTERS = tuple("ABCQUVWXYZ")
"""The axis names of plain blocks."""
CHUNK = 65_536
"""Rows of one scan: bounds the memory of a run."""
LONGEST_LINE = 4000
"""A longer block is a mistake that the parser reports."""
_UNKNOWN = -1
_DIGITS = np.uint64(15)
"""So many digits, divided by a power of ten, give the same double as the parser's `float`."""
_POWERS = 10.0 ** np.arange(int(_DIGITS) + 1)
_HIGHEST_BLOCK = 999_999_999

# Offsets and counts are unsigned: a signed index would be compared with zero at each character.
_NONE, _ONE, _TEN, _ZERO = np.uint64(0), np.uint64(1), np.uint64(10), np.uint64(48)
_LONGEST = np.uint64(LONGEST_LINE - 40)


@dataclass(frozen=True, slots=True)
class PlainRows:
    """Columns of plain blocks, one row each, in the units of the program.

    line: from 1. block, motion (0 to 3), absolute (1 for G90, 0 for G91): -1 where not programmed.
    feed, values: NaN where not programmed. values: (rows, axes). circular: which of I, J, K and R
    are programmed, as bits 1, 2, 4 and 8; centre (rows, 4): their values there. stops: offset
    behind each row. end: of the first line that is none of these, behind lines without words.
    """

    line: NDArray[np.int64]
    block: NDArray[np.int64]
    motion: NDArray[np.int8]
    absolute: NDArray[np.int8]
    feed: NDArray[np.float64]
    values: NDArray[np.float64]
    circular: NDArray[np.uint8]
    centre: NDArray[np.float64]
    stops: NDArray[np.int64]
    end: int

    def __len__(self) -> int:
        return len(self.line)


class Scanner:
    """Scans one program for one set of axes; its buffers serve every call.

    signed: axes on which a plus is more than nothing; a word with one is left to the parser.
    """

    def __init__(
        self, data: NDArray[np.uint8], axis_names: tuple[str, ...], signed: Iterable[int] = ()
    ) -> None:
        self.data = data
        self._signed = np.isin(np.arange(len(axis_names)), list(signed))
        self._size = np.uint64(_whole_lines(data))
        self.columns = np.full(256, _UNKNOWN, dtype=np.int64)
        for index, name in enumerate(axis_names):
            if name in AXIS_LETTERS:
                self.columns[ord(name)] = index
        n = len(axis_names)
        self._line = np.empty(CHUNK, dtype=np.int64)
        self._block = np.empty(CHUNK, dtype=np.int64)
        self._codes = np.empty((CHUNK, 2), dtype=np.int8)
        self._feed = np.empty(CHUNK)
        self._values = np.empty((CHUNK, n))
        self._circular, self._centre = np.empty(CHUNK, dtype=np.uint8), np.empty((CHUNK, 4))
        self._stops = np.empty(CHUNK, dtype=np.int64)

    def scan(self, offset: int, line: int, most: int = CHUNK) -> PlainRows:
        """The plain blocks from `offset`, which begins line `line`, up to `most` rows."""
        count, end = _scan(
            self.data, self._size, np.uint64(offset), np.uint64(most), line, self.columns,
            self._signed, _POWERS,
            self._line, self._block, self._codes, self._feed, self._values, self._circular,
            self._centre, self._stops,
        )  # fmt: skip
        return PlainRows(
            self._line[:count],
            self._block[:count],
            self._codes[:count, 0],
            self._codes[:count, 1],
            self._feed[:count],
            self._values[:count],
            self._circular[:count],
            self._centre[:count],
            self._stops[:count],
            int(end),
        )


@compiled
def _whole_lines(data):
    """Offset behind the last line feed: a line without one is left to the parser."""
    size = len(data)
    while size > 0 and data[size - 1] != 10:
        size -= 1
    return size


@compiled
def _scan(
    data, size, at, most, line, columns, signed, powers, lines, blocks, codes, feeds, values,
    circular, centre, stops
):  # fmt: skip
    """Rows read, at most so many, and the offset behind them. A line without words between plain
    blocks belongs to the run. Each line before `size` ends with a line feed, so that no loop below
    it needs another end."""
    count = _NONE
    while at < size and count < most:
        stop, axes = _read_line(
            data, at, columns, signed, powers, blocks, codes, feeds, values, circular, centre, count
        )
        if stop == _NONE:
            break
        at = stop
        if axes:
            lines[count], stops[count] = line, at
            count += _ONE
        line += 1
    return count, at


@compiled
def _behind_comment(data, at):
    """Offset behind the comment at `at`: that of its bracket or of the line feed; 0 for one that
    has another bracket in it."""
    bracket = data[at] == 40
    at += _ONE
    while data[at] != 10:
        if bracket and data[at] == 40:
            return _NONE
        if bracket and data[at] == 41:
            return at + _ONE
        at += _ONE
    return at


@compiled
def _read_line(
    data, at, columns, signed, powers, blocks, codes, feeds, values, circular, centre, row
):
    """Offset behind the line and its number of words that make a motion, those of axes and of the
    centre of an arc; offset 0 when it is not plain. A line without any word is."""
    longest = at + _LONGEST
    block, motion, absolute, feed = -1, -1, -1, np.nan
    for axis in range(values.shape[1]):
        values[row, np.uint64(axis)] = np.nan
    words, axes, given = 0, 0, 0
    while True:
        char = data[at]
        if char < 65:
            if char == 32 or char == 9 or (char == 13 and data[at + _ONE] == 10):
                at += _ONE
                continue
            if char == 10:
                break
            at = _behind_comment(data, at) if char == 40 or char == 59 else _NONE
            if at == _NONE:
                return _NONE, 0
            continue
        number, decimals, whole, sign, at = _number(data, at + _ONE)
        if at == _NONE:
            return _NONE, 0
        known = columns[char]
        if known >= 0:
            column = np.uint64(known)
            if not np.isnan(values[row, column]) or (sign > 0 and signed[column]):
                return _NONE, 0
            value = number / powers[decimals]
            values[row, column] = -value if sign < 0 else value
            axes += 1
        elif char == 78:  # N
            if words > 0 or not whole or number > _HIGHEST_BLOCK:
                return _NONE, 0
            block = number
        elif char == 71 and whole and number <= 3:  # G0 to G3
            if motion >= 0:
                return _NONE, 0
            motion = number
        elif char == 71 and whole and 90 <= number <= 91:  # G90, G91
            if absolute >= 0:
                return _NONE, 0
            absolute = 91 - number
        elif char == 70:  # F
            if sign < 0 or number == 0 or not np.isnan(feed):
                return _NONE, 0
            feed = number / powers[decimals]
        elif 73 <= char <= 75 or char == 82:  # I, J, K, R
            place = 3 if char == 82 else int(char) - 73
            if given & (1 << place):
                return _NONE, 0
            given |= 1 << place
            value = number / powers[decimals]
            centre[row, np.uint64(place)] = -value if sign < 0 else value
            axes += place < 3
        else:
            return _NONE, 0
        words += 1
    if at > longest or (words > 0 and axes == 0):
        return _NONE, 0
    blocks[row], feeds[row], codes[row, 0], codes[row, 1] = block, feed, motion, absolute
    circular[row] = given
    return at + _ONE, axes


@compiled
def _number(data, at):
    """Digits at `at` after blanks and one sign: their value without the point, decimals, whether
    there is neither sign nor point, the sign (-1, 0, 1), and the offset behind; offset 0 when
    this is no literal or too long to be exact."""
    while data[at] == 32 or data[at] == 9:
        at += _ONE
    sign = 0
    if data[at] == 45:
        sign = -1
    elif data[at] == 43:
        sign = 1
    if sign != 0:
        at += _ONE
    number, first = _NONE, at
    digit = data[at] - _ZERO
    while digit < _TEN:
        number = number * _TEN + digit
        at += _ONE
        digit = data[at] - _ZERO
    digits, decimals = at - first, _NONE
    point = data[at] == 46
    if point:
        at += _ONE
        first = at
        digit = data[at] - _ZERO
        while digit < _TEN:
            number = number * _TEN + digit
            at += _ONE
            digit = data[at] - _ZERO
        decimals = at - first
        digits += decimals
    if digits == _NONE or digits > _DIGITS or not _ends_number(data[at]):
        at = _NONE
    return np.int64(number), decimals, sign == 0 and not point, sign, at


@compiled
def _ends_number(char):
    """A blank, an end of line, a comment, or a letter that begins the next word."""
    blank = char == 32 or char == 9 or char == 10 or char == 13
    return blank or 65 <= char <= 90 or char == 40 or char == 59
