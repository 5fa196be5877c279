"""# commands and the declarations between #VAR and #ENDVAR.

Enters a cursor at `#`, or at the begin of a declaration. Leaves a `HashCommand` or a
`Declaration`. The names and their kinds are in `commands`.
"""

from __future__ import annotations

import re

from ncscope.language.commands import Command, lookup, similar
from ncscope.language.cursor import Cursor, Mistake
from ncscope.language.groups import comma_list, groups
from ncscope.language.terms import arguments_in_brackets, close, expression, starts_target, target
from ncscope.language.terms import value as value_of
from ncscope.language.tree import (
    CycleParameter,
    Declaration,
    Expression,
    Group,
    HashCommand,
    Parameter,
    Variable,
    Word,
)
from ncscope.language.words import word

TYPES = (
    "BOOLEAN",
    "SGN08",
    "UNS08",
    "SGN16",
    "UNS16",
    "SGN32",
    "UNS32",
    "REAL64",
    "REAL",
    "STRING",
)

_KEYWORD = re.compile(r"[ \t\0\r]*([A-Za-z]\w*|2ROT)", re.IGNORECASE)
_MODIFIER = re.compile(r"[A-Za-z_][A-Za-z_]\w*(?![ \t\0\r]*=)(?!\.)")
_EQUALS = re.compile(r"[ \t\0\r]*=(?!=)")
_MOST_KEYWORDS = 5
_FILE_NAMES = ("FILE NAME", "FILENAME")


def hash_command(cursor: Cursor) -> HashCommand:
    """hashcmd = "#" , keyword , { keyword } , { group } , [ "=" , expr ] , { word } ;"""
    start = cursor.at
    cursor.at += 1
    keywords = _keywords(cursor)
    command = lookup([text for text, _ in keywords])
    if command is None:
        raise _unknown(cursor, start, keywords)
    cursor.at = keywords[len(command.name.split()) - 1][1]
    if command.kind in ("no effect", "refused") and not command.words:
        return _unread(cursor, command, start)
    return _content(cursor, command, start)


def _keywords(cursor: Cursor) -> list[tuple[str, int]]:
    """Each keyword with the index after it; does not move."""
    result: list[tuple[str, int]] = []
    at = cursor.at
    while len(result) < _MOST_KEYWORDS:
        found = _KEYWORD.match(cursor.code, at)
        if found is None:
            break
        at = found.end()
        result.append((found.group(1), at))
    return result


def _unknown(cursor: Cursor, start: int, keywords: list[tuple[str, int]]) -> Exception:
    end = keywords[0][1] if keywords else start + 1
    name = cursor.code[start:end]
    guess = similar(" ".join(text for text, _ in keywords[:2])) or similar(name[1:])
    hint = f"did you mean #{guess}?" if guess else ""
    cursor.at = end
    message = f"The command {name} is unknown."
    return cursor.mistake("20509", message, hint, cursor.span(start, end))


def unknown_command(cursor: Cursor, start: int) -> HashCommand:
    """What stands in the tree for a command whose name is unknown."""
    cursor.at = start + 1
    keywords = _keywords(cursor)
    name = keywords[0][0].upper() if keywords else ""
    end = keywords[0][1] if keywords else start + 1
    cursor.at = len(cursor.code)
    return HashCommand(name, (), (), (), None, False, cursor.span(start, end))


def _unread(cursor: Cursor, command: Command, start: int) -> HashCommand:
    """A command that is not modelled: its brackets and all that follows are not judged."""
    cursor.at = len(cursor.code)
    end = cursor.written_end()
    return HashCommand(command.name, (), (), (), None, True, cursor.span(start, end))


def _content(cursor: Cursor, command: Command, start: int) -> HashCommand:
    if command.name == "DELETE":
        return _made(cursor, command, start, arguments=(comma_list(cursor),))
    if command.name == "IF":
        return _made(cursor, command, start, value=value_of(cursor))
    modifiers = () if command.words else _modifiers(cursor)
    arguments = groups(cursor, raw=command.name in _FILE_NAMES)
    modifiers += () if command.words else _modifiers(cursor)
    value = expression(cursor) if cursor.match(_EQUALS) else None
    words = _words(cursor) if command.words and value is None else ()
    return _made(cursor, command, start, modifiers, arguments, words, value)


def _made(
    cursor: Cursor,
    command: Command,
    start: int,
    modifiers: tuple[str, ...] = (),
    arguments: tuple[Group, ...] = (),
    words: tuple[Word, ...] = (),
    value: Expression | None = None,
) -> HashCommand:
    span = cursor.span(start, cursor.written_end())
    return HashCommand(command.name, modifiers, arguments, words, value, True, span)


def _modifiers(cursor: Cursor) -> tuple[str, ...]:
    result: list[str] = []
    cursor.skip()
    while (found := cursor.match(_MODIFIER)) is not None:
        result.append(found.group().upper())
        cursor.skip()
    return tuple(result)


def _words(cursor: Cursor) -> tuple[Word, ...]:
    result = []
    while cursor.skip() not in ("", "#", "$"):
        result.append(word(cursor))
    return tuple(result)


def declaration(cursor: Cursor) -> Declaration:
    """decl = target , [ ":" , type ] , [ "=" , initial ] ;"""
    start = cursor.at
    if not starts_target(cursor):
        message = "Between #VAR and #ENDVAR only declarations of variables V... and P.. stand."
        raise cursor.mistake("20394", message, "#ENDVAR on a line of its own ends them")
    left = target(cursor)
    if isinstance(left, CycleParameter):
        raise cursor.mistake("20908", "A cycle parameter may not be declared.")
    kind, length = _type(cursor) if cursor.take(":") else (None, None)
    initial = _values(cursor, left) if cursor.match(_EQUALS) else ()
    return Declaration(left, kind, length, initial, cursor.span(start, cursor.written_end()))


def _type(cursor: Cursor) -> tuple[str, Expression | None]:
    """type = "BOOLEAN" | .. | "STRING" , "[" , expr , "]" ;"""
    cursor.skip()
    name = cursor.word()
    if name.upper() not in TYPES:
        hint = f"the types are {', '.join(TYPES)}"
        what = repr(name or cursor.char) if cursor.char else "nothing"
        raise cursor.mistake("N1005", f"A type must follow the colon, not {what}.", hint)
    cursor.at += len(name)
    if name.upper() != "STRING" or cursor.skip() != "[":
        return name.upper(), None
    return "STRING", arguments_in_brackets(cursor, "21217")[0]


def _values(cursor: Cursor, left: Variable | Parameter) -> tuple[Expression, ...]:
    """initial = expr | list ;  a list for arrays, an expression for others"""
    parts = left.parts if isinstance(left, Variable) else (left,)
    bracket = cursor.skip() == "["
    if any(part.indices for part in parts):
        if not bracket:
            hint = "write the values in square brackets, for example [1, 2, 3]"
            raise cursor.mistake("21920", "The values of an array begin with '['.", hint)
        return _list(cursor)
    return _item(cursor)


def _list(cursor: Cursor) -> tuple[Expression, ...]:
    """list = "[" , ( expr | list ) , { "," , .. } , "]" ;"""
    opening = cursor.at
    cursor.at += 1
    if cursor.skip() == "]":
        cursor.at += 1
        raise cursor.mistake("20480", "The brackets are empty.", span=cursor.span(opening))
    cursor.deeper(1)
    result = _item(cursor)
    while cursor.take(","):
        if cursor.skip() == "]":
            raise cursor.mistake("20483", "A comma stands before the closing bracket.")
        result += _item(cursor)
    cursor.deeper(-1)
    if cursor.skip() not in ("", "]"):
        message = "A comma or the closing bracket ']' is missing here."
        raise cursor.mistake("20198", message, "commas stand between values: [1, 2, 3]")
    close(cursor, opening, "20198")
    return result


def _item(cursor: Cursor) -> tuple[Expression, ...]:
    """item = expr | list ;  [P1 + 2] / 3 is an expression, [1, 2] is none"""
    bracket = cursor.skip() == "["
    start = cursor.at, cursor.depth, cursor.operators
    try:
        return (expression(cursor),)
    except Mistake:
        if not bracket:
            raise
    cursor.at, cursor.depth, cursor.operators = start
    return _list(cursor)
