"""G04 and the time behind it, which no letter need announce.

Enters a cursor behind the number of a dwell. Leaves the word with its time.
Source: TF5200 programming manual, dwell time.
"""

from __future__ import annotations

import re

from ncscope.language.cursor import Cursor
from ncscope.language.functions import FUNCTIONS
from ncscope.language.terms import starts_target, starts_value, target, value
from ncscope.language.tree import Expression, GWord

DWELL = 4
"""The G function whose value may follow it without an address letter."""
ASSIGN = re.compile(r"[ \t\0\r]*([-+*/]?=)(?!=)")
EQUALS = re.compile(r"[ \t\0\r]*=(?!=)")


def dwell(cursor: Cursor, number: Expression, start: int) -> GWord:
    """dwell = "G04" , [ [ "=" ] , expr ] ;  the time, where what follows is no other word"""
    after = cursor.at
    written = cursor.match(EQUALS) is not None
    cursor.skip()
    if written or _starts_time(cursor):
        return GWord(number, value(cursor), None, cursor.span(start))
    cursor.at = after
    return GWord(number, None, None, cursor.span(start))


def _starts_time(cursor: Cursor) -> bool:
    """Whether a value follows, and neither a word nor an assignment."""
    if not starts_target(cursor):
        named = cursor.char.isalpha()
        known = cursor.word().upper() in FUNCTIONS
        return starts_value(cursor) and (known or not named)
    start = cursor.at
    target(cursor)
    found = cursor.looks_at(ASSIGN) is None
    cursor.at = start
    return found
