"""The brackets of # commands and cycle calls.

Enters a cursor at `[`. Leaves a `Group`: cells between commas, items between blanks.
"""

from __future__ import annotations

import re

from ncscope.language.cursor import Cursor
from ncscope.language.functions import FUNCTIONS
from ncscope.language.terms import CONSTANTS, close, expression, starts_target, string
from ncscope.language.tree import Expression, Group, Item, Name

_KEY = re.compile(r"(@[Pp][0-9]+|[A-Za-z_][\w.]*(?:\[[0-9]+\])*)[ \t\0\r]*=(?!=)")
_VARIABLE_KEY = re.compile(r"[Vv]\.")
_NAME = re.compile(r"[^\W0-9][\w./\\:-]*(?:[ \t]*[-+](?=[ \t]*\]))?")
"""A name, a file name, or an axis with a sign before the closing bracket (`[Z+]`)."""
_RAW_NAME = re.compile(r'[^\s\0\[\],"=]+')
_FUNCTION = re.compile(r"([A-Za-z_]\w*)[ \t\0\r]*\[")
_FILE_LIKE = re.compile(r"[Pp][0-9]+[./\\][A-Za-z]")
_PLAIN_KEY = re.compile(
    r"([A-Za-z_]\w*)[ \t\0\r]+(?![-+][ \t]*\])(?=[-+.0-9\"]|[Pp][0-9\[]|[Vv]\.)"
)
_NUMBER_OR_SIGN = re.compile(r'[-+.0-9"@\[]')


def groups(cursor: Cursor, *, raw: bool = False) -> tuple[Group, ...]:
    """groups = { group } ;  `raw`: the values behind `=` are file names"""
    result = []
    while cursor.skip() == "[":
        result.append(group(cursor, raw=raw))
    return tuple(result)


def group(cursor: Cursor, *, raw: bool = False) -> Group:
    """group = "[" , cell , { "," , cell } , "]" ;"""
    opening = cursor.at
    cursor.at += 1
    cells = [_cell(cursor, raw)]
    while cursor.take(","):
        cells.append(_cell(cursor, raw))
    close(cursor, opening, "20198")
    if len(cells) == 1 and not cells[0]:
        cells = []
    return Group(tuple(cells), cursor.span(opening))


def comma_list(cursor: Cursor) -> Group:
    """list = value , { "," , value } ;  a group that is written without brackets"""
    start = cursor.at
    cells = [_cell(cursor, False)]
    while cursor.take(","):
        cells.append(_cell(cursor, False))
    return Group(tuple(cells), cursor.span(start, cursor.written_end()))


def _cell(cursor: Cursor, raw: bool) -> tuple[Item, ...]:
    """cell = { item } ;"""
    items = []
    while cursor.skip() not in ("", ",", "]"):
        items.append(_item(cursor, raw))
    return tuple(items)


def _item(cursor: Cursor, raw: bool) -> Item:
    """item = key , "=" , value | key , value | value ;"""
    start = cursor.at
    key = cursor.match(_KEY)
    if key is not None:
        written = key.group(1)
        name = written if _VARIABLE_KEY.match(written) else written.upper()
        item_value = _keyed_value(cursor, raw or name == "NAME")
        return Item(name, item_value, cursor.span(start))
    plain = None if _starts_expression(cursor) else cursor.match(_PLAIN_KEY)
    if plain is not None:
        return Item(plain.group(1).upper(), _value(cursor), cursor.span(start))
    return Item(None, _value(cursor), cursor.span(start))


def _keyed_value(cursor: Cursor, raw: bool) -> Expression:
    start = cursor.at
    if cursor.skip() in ("", ",", "]"):
        raise cursor.mistake("N1002", "A value is missing after '='.", span=cursor.span(start - 1))
    if not raw or cursor.char == '"' or (starts_target(cursor) and not _is_file(cursor)):
        return _value(cursor)
    begin = cursor.at
    found = cursor.match(_RAW_NAME)
    return Name(found.group(), cursor.span(begin)) if found else _value(cursor)


def _is_file(cursor: Cursor) -> bool:
    return cursor.looks_at(_FILE_LIKE) is not None


def _value(cursor: Cursor) -> Expression:
    """value = expr | name ;"""
    if _starts_expression(cursor):
        return _expression(cursor)
    start = cursor.at
    found = cursor.match(_NAME)
    if found is None:
        shown = cursor.char
        raise cursor.mistake("N1005", f"{shown!r} is not expected in these brackets.")
    return Name(found.group(), cursor.span(start))


def _expression(cursor: Cursor) -> Expression:
    if cursor.char == '"':
        start = cursor.at
        text = string(cursor)
        if cursor.skip() in (",", "]", ""):
            return text
        cursor.at = start
    return expression(cursor)


def _starts_expression(cursor: Cursor) -> bool:
    if cursor.looks_at(_NUMBER_OR_SIGN):
        return True
    if starts_target(cursor):
        return not _is_file(cursor)
    found = cursor.looks_at(_FUNCTION)
    if found is not None and found.group(1).upper() in FUNCTIONS:
        return True
    return cursor.word().upper() in CONSTANTS
