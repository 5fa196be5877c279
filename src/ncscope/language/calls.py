"""Calls of subprograms: `L`, `LL`, cycles and sequences.

Enters a cursor at an `L`. Leaves a `Call`; what it calls is found at the run.
Source: TF5200 programming manual.
"""

from __future__ import annotations

import re

from ncscope.language.cursor import Cursor
from ncscope.language.groups import group
from ncscope.language.terms import close, expression, starts_target, string, target
from ncscope.language.tree import Call, Expression, Group, Item, Macro, Name

_CALL = re.compile(r"(LL|L)(?=[ \t\0\r\"]|\Z)", re.IGNORECASE)
_SPECIAL_CALL = re.compile(r"(CYCLE|SEQUENCE)(?=[ \t\0\r]*\[)", re.IGNORECASE)
_WITHOUT_BRACKETS = re.compile(r"(CYCLE|SEQUENCE)[ \t\0\r]+(?=NAME\b|N[0-9]|@P)", re.IGNORECASE)
_FILE_NAME = re.compile(r'[^\s\0\[\]"#;,()]+')
_LABEL = re.compile(r"\[[ \t\0\r]*([^\s\0\[\]]+)[ \t\0\r]*\]")
_BLOCK = re.compile(r"[Nn](?=[0-9\[])")
_KEY = re.compile(r"(NAME|REPEAT|ENDTAG)(?![A-Za-z_])[ \t\0\r]*(=?)", re.IGNORECASE)


def call(cursor: Cursor) -> Call | None:
    """call = ( "L" | "LL" ) , sep , ( name | string | variable | "CYCLE" group | sequence ) ;

    None when the letter begins something else.
    """
    start = cursor.at
    found = cursor.match(_CALL)
    if found is None:
        return None
    kind = found.group().upper()
    cursor.skip()
    special = cursor.match(_SPECIAL_CALL)
    if special is None and (bare := cursor.looks_at(_WITHOUT_BRACKETS)) is not None:
        name = bare.group(1).upper()
        hint = f"write {kind} {name} [NAME=..]"
        raise cursor.mistake("N1005", f"{kind} {name} needs square brackets.", hint)
    if special is None:
        return Call(kind, _target(cursor, start), (), cursor.span(start))
    cursor.skip()
    if special.group().upper() == "SEQUENCE":
        arguments = _sequence(cursor)
        return Call("L SEQUENCE", _named(arguments), (arguments,), cursor.span(start))
    arguments = group(cursor)
    return Call(f"{kind} CYCLE", _named(arguments), (arguments,), cursor.span(start))


def _named(arguments: Group) -> Expression | None:
    return next((item.value for item in arguments.items if item.key == "NAME"), None)


def _target(cursor: Cursor, start: int) -> Expression:
    begin = cursor.at
    if cursor.char == '"':
        name = string(cursor)
        return Macro(name.value, name.span)
    if cursor.char in ("V", "v") and starts_target(cursor):
        return target(cursor)
    found = cursor.match(_FILE_NAME)
    if found is None:
        name_span = cursor.span(start, max(cursor.written_end(), start + 1))
        hint = "write the name of a subprogram, for example L drill.nc or LL DRILL"
        raise cursor.mistake("N1002", "The name of the subprogram is missing.", hint, name_span)
    return Name(found.group(), cursor.span(begin))


def _sequence(cursor: Cursor) -> Group:
    """sequence = "[" , { "NAME=" name | "N" expr | label | "REPEAT" expr | "ENDTAG" } , "]" ;

    Block numbers have the key N, labels the key LABEL.
    """
    opening = cursor.at
    cursor.at += 1
    items: list[Item] = []
    while cursor.skip() not in ("", "]"):
        items.append(_sequence_item(cursor))
        cursor.take(",")
    close(cursor, opening, "20198")
    return Group((tuple(items),), cursor.span(opening))


def _sequence_item(cursor: Cursor) -> Item:
    start = cursor.at
    label = cursor.match(_LABEL)
    if label is not None:
        return Item("LABEL", Name(label.group(1).upper(), cursor.span(start)), cursor.span(start))
    if cursor.match(_BLOCK):
        return Item("N", expression(cursor), cursor.span(start))
    key = cursor.match(_KEY)
    if key is None:
        hint = "write L SEQUENCE [NAME=file N10 N50 REPEAT=2]"
        raise cursor.mistake("N1005", "This cannot stand in L SEQUENCE.", hint)
    name = key.group(1).upper()
    cursor.skip()
    if name == "ENDTAG":
        return Item(name, None, cursor.span(start))
    content = _target(cursor, start) if name == "NAME" else expression(cursor)
    return Item(name, content, cursor.span(start))
