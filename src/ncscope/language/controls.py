"""Control statements: `$IF`, `$FOR`, `$GOTO` and their kin.

Enters a cursor at `$`. Leaves a `Control`. Which statements belong together is found at the run.
Source: TF5200 programming manual
"""

from __future__ import annotations

import re

from ncscope.language.cursor import Cursor, Mistake
from ncscope.language.terms import expression, starts_target, target, value
from ncscope.language.tree import (
    Assignment,
    Control,
    CycleParameter,
    Expression,
    Name,
    Number,
    Parameter,
    Variable,
)

WITH_CONDITION = frozenset(["IF", "ELSEIF", "IFELSE", "SWITCH", "CASE", "WHILE", "ENDDO", "UNTIL"])
ALONE = frozenset(
    (
        "ELSE",
        "ENDIF",
        "DEFAULT",
        "ENDSWITCH",
        "ENDFOR",
        "ENDWHILE",
        "DO",
        "REPEAT",
        "BREAK",
        "CONTINUE",
    )
)

BEHIND: dict[str, str] = {
    "IF": "20212",
    "ELSE": "20215",
    "ELSEIF": "20217",
    "IFELSE": "20217",
    "ENDIF": "20219",
    "SWITCH": "20220",
    "CASE": "20222",
    "DEFAULT": "20224",
    "WHILE": "20235",
    "ENDWHILE": "20238",
    "DO": "20239",
    "ENDDO": "20241",
    "BREAK": "20242",
    "CONTINUE": "20245",
    "REPEAT": "21468",
    "UNTIL": "21470",
}
"""Numbers for what stands behind a control statement in its line; 20206 for the others."""

_KEYWORD = re.compile(r"\$([A-Za-z]+)")
_GOTO = re.compile(r"\$GOTO(?![A-Za-z])", re.IGNORECASE)
_LABEL = re.compile(r"\[[ \t\0\r]*([^\s\0\[\]]+)[ \t\0\r]*\]")
_EXTERNAL = re.compile(r"(?=V\.E\.)", re.IGNORECASE)
_EQUALS = re.compile(r"[ \t\0\r]*=(?!=)")

Jump = tuple[tuple[Expression, ...], Name | Number | None]


def control(cursor: Cursor) -> tuple[Control, Assignment | None]:
    """control = "$" , keyword , [ expr | jump | forhead ] ;

    The assignment is the one in `$SWITCH P1 = ..`.
    """
    start = cursor.at
    found = cursor.match(_KEYWORD)
    keyword = found.group(1).upper() if found else ""
    if keyword == "GOTO":
        values, aim = _jump(cursor)
        return Control("GOTO", values, aim, cursor.span(start)), None
    if keyword == "FOR":
        return _for(cursor, start), None
    if keyword == "SWITCH":
        return _switch(cursor, start)
    if keyword in WITH_CONDITION:
        return _condition(cursor, keyword, start), None
    if keyword in ALONE:
        return Control(keyword, (), None, cursor.span(start)), None
    end = max(cursor.at, start + 1)
    message = f"The control statement ${keyword} is unknown."
    hint = "" if keyword else "the keyword follows $ without a blank, for example $IF"
    raise cursor.mistake("20209", message, hint, cursor.span(start, end))


def broken(cursor: Cursor, start: int) -> Control | None:
    """What stands in the tree for a statement that cannot be read: it still has its end."""
    cursor.at = start
    found = cursor.match(_KEYWORD)
    keyword = found.group(1).upper() if found else ""
    known = keyword == "FOR" or keyword in WITH_CONDITION
    return Control(keyword, (), None, cursor.span(start)) if known else None


def behind(cursor: Cursor, statement: Control) -> Mistake:
    """The mistake of a word or command behind a control statement."""
    message = f"${statement.keyword} must stand alone in its block."
    if statement.values:
        message = f"Behind ${statement.keyword} only its condition may stand."
    compares = statement.keyword in WITH_CONDITION and cursor.char == "="
    hint = "two equals signs compare: ==" if compares else "put it on a line of its own"
    return cursor.mistake(BEHIND.get(statement.keyword, "20206"), message, hint)


def _condition(cursor: Cursor, keyword: str, start: int) -> Control:
    """condition = keyword , expr , [ "$GOTO" , aim ] ;"""
    condition = value(cursor)
    end = cursor.at
    cursor.skip()
    if keyword == "IF" and cursor.match(_GOTO):
        values, aim = _jump(cursor)
        return Control("IF", (condition, *values), aim, cursor.span(start))
    cursor.at = end
    return Control(keyword, (condition,), None, cursor.span(start))


def _jump(cursor: Cursor) -> Jump:
    """aim = "N" , expr | "[" , name , "]" | external ;  the case of names does not count

    An external variable V.E of the type STRING holds the label.
    """
    if cursor.skip() == "[":
        begin = cursor.at
        label = cursor.match(_LABEL)
        if label is not None:
            return (), Name(label.group(1).upper(), cursor.span(begin))
    if cursor.match(_EXTERNAL):
        return (target(cursor),), None
    if cursor.char.upper() != "N":
        hint = "write $GOTO N20 or $GOTO [NAME]"
        raise cursor.mistake("20839", "$GOTO needs a label.", hint)
    cursor.at += 1
    number = value(cursor)
    return ((), number) if isinstance(number, Number) else ((number,), None)


def _for(cursor: Cursor, start: int) -> Control:
    """forhead = target , "=" , expr , "," , expr , "," , expr ;"""
    cursor.skip()
    counter = _target(cursor)
    if not cursor.match(_EQUALS):
        raise cursor.mistake(
            "20228", "$FOR needs '=' behind its variable.", "write $FOR P1 = 1,5,1"
        )
    values = [value(cursor)]
    for _ in range(2):
        if not cursor.take(","):
            message = "$FOR needs a first value, a last value and a step, with commas between."
            raise cursor.mistake("20229", message, "write $FOR P1 = 1,5,1")
        values.append(value(cursor))
    return Control("FOR", tuple(values), counter, cursor.span(start))


def _target(cursor: Cursor) -> Variable | Parameter:
    found = target(cursor) if starts_target(cursor) else None
    if found is None or isinstance(found, CycleParameter):
        raise cursor.mistake("N1005", "$FOR counts in a parameter P.. or a variable V...")
    return found


def _switch(cursor: Cursor, start: int) -> tuple[Control, Assignment | None]:
    """switch = "SWITCH" , [ target , "=" ] , expr ;"""
    cursor.skip()
    begin = cursor.at
    if starts_target(cursor):
        left = target(cursor)
        if cursor.match(_EQUALS):
            assigned = Assignment(left, "=", expression(cursor), cursor.span(begin))
            return Control("SWITCH", (left,), None, cursor.span(start)), assigned
        cursor.at = begin
    return Control("SWITCH", (value(cursor),), None, cursor.span(start)), None
