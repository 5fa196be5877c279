"""The words of a block.

Enters a cursor before a word. Leaves the word. Which words make sense together is the channel's.
Source: TF5200 programming manual
"""

from __future__ import annotations

import re
from collections.abc import Callable

from ncscope.diagnostics import Span
from ncscope.language.calls import call
from ncscope.language.cursor import Cursor
from ncscope.language.dwell import ASSIGN, DWELL, EQUALS, dwell
from ncscope.language.groups import groups
from ncscope.language.terms import (
    close,
    expression,
    starts_target,
    starts_value,
    string,
    target,
    value,
)
from ncscope.language.tree import (
    AddressWord,
    Assignment,
    AxisCommand,
    AxisWord,
    Call,
    Expression,
    Group,
    GWord,
    Item,
    Macro,
    MacroDefinition,
    MWord,
    Number,
    Parameter,
    SpindleWord,
    Unary,
    Word,
)
from ncscope.language.vocabulary import axis_commands

AXIS_LETTERS = frozenset("ABCQUVWXYZabcquvwxyz")
_ADDRESSES = frozenset("DEFHIJKRTdefhijkrt")
AXIS_COMMANDS = axis_commands()

_SIMPLE = re.compile(
    r"([A-KMQRT-Za-kmqrt-z])([-+]?)([0-9]{1,15}(?:\.[0-9]{0,15})?|\.[0-9]{1,15})"
    r"(?:[ \t\0\r]*\Z|[ \t\0\r]+(?!(?:MOD|XOR)(?!\w))(?=[A-Za-z]))",
    re.IGNORECASE,
)
"""Letter, sign, digits and the blanks behind them."""
_SIGNED_DWELL = re.compile(r"[Gg]0*4(?=[ \t\0\r]+[-+])")
"""G04 -1 is a time, not G3."""
_LONG_NAME = re.compile(r"([A-Za-z]\w*)[ \t\0\r]*=(?!=)", re.ASCII)
_AXIS_COMMAND = re.compile(r"([A-Za-z]\w*)[ \t\0\r]*\[[ \t\0\r]*([A-Za-z]\w*)", re.ASCII)
_NOASSIGNMENT = re.compile(r"[ \t\0\r]*([-+*/%&|^<>!:=]+)")
_OPERATOR_END = re.compile(r"\s*[-+*/]?=\s*$")
_SPINDLE = re.compile(r"[Ss](?:\.[A-Za-z_]\w*|\w+(?=[ \t\0\r]*=(?!=))|[0-9]+(?=[ \t\0\r]*\[))")
_SPINDLE_BRACKET = re.compile(r"[Ss][ \t\0\r]*\[")
_CYCLE_WORD = re.compile(r"@[XYZIJKSxyzijks](?![A-Za-z_])")
_RUN = re.compile(r"[^\W0-9]\w*")


def word(cursor: Cursor) -> Word:
    """word = gword | mword | axisword | addrword | assign | call | macro ;"""
    simple = cursor.looks_at(_SIMPLE)
    if simple is not None:
        return _simple(cursor, simple)
    letter = cursor.char
    if letter == '"':
        return _macro(cursor)
    if starts_target(cursor):
        return _assignment(cursor)
    if letter == "@":
        start = cursor.at
        named = cursor.match(_CYCLE_WORD)
        if named is not None:
            return _cycle_word(cursor, named.group()[1], start)
    if letter in AXIS_LETTERS:
        return _axis(cursor)
    handler = _BY_LETTER.get(letter.upper())
    if handler is not None:
        return handler(cursor)
    raise _unknown(cursor)


def simple_words(cursor: Cursor, words: list[Word]) -> None:
    """Reads the simple words up to the next one that is not; the cursor then stands there."""
    while (found := _SIMPLE.match(cursor.code, cursor.at)) is not None:
        words.append(_simple(cursor, found))
        if cursor.at == found.end(3):
            cursor.at = found.end()
        else:
            cursor.skip()


def _simple(cursor: Cursor, found: re.Match[str]) -> Word:
    """A letter with a number behind it, which most words are."""
    letter, sign, digits = found.groups()
    start, cursor.at = found.start(), found.end(3)
    source, begin, end = cursor.source, cursor.base + start, cursor.base + cursor.at
    span = Span(source, begin, end)
    number: Expression = Number(float(digits), Span(source, end - len(digits), end))
    if sign:
        number = Unary(sign, number, Span(source, begin + 1, end))
    if letter in AXIS_LETTERS:
        return AxisWord(letter, number, sign, span)
    if letter in "Gg":
        if float(digits) == DWELL:
            return dwell(cursor, number, start)
        return GWord(number, None, None, span)
    if letter in "Mm":
        return MWord(number, (), span)
    return AddressWord(letter.upper(), number, span)


def _axis(cursor: Cursor) -> Word:
    """axisword = name , "=" , expr | letter , value | name , "[" , keyword , .. , "]" ;

    The longest name counts: X50P1=7 is the axis X50P1.
    """
    start = cursor.at
    named = cursor.match(_LONG_NAME)
    if named is not None:
        name = named.group(1)
        return _axis_word(cursor, name, start)
    command = cursor.looks_at(_AXIS_COMMAND)
    if command is not None and _is_axis_command(command.group(2).upper()):
        return _axis_command(cursor, command)
    _need_value(cursor)
    return _axis_word(cursor, cursor.code[start], start)


def _axis_word(cursor: Cursor, name: str, start: int) -> AxisWord:
    first = cursor.skip()
    sign = first if len(name) == 1 and first in ("+", "-") else ""
    content = _value_after(cursor, start)
    return AxisWord(name, content, sign, cursor.span(start))


def _is_axis_command(keyword: str) -> bool:
    return keyword in AXIS_COMMANDS or keyword.startswith("MC_")


def _axis_command(cursor: Cursor, found: re.Match[str]) -> AxisCommand:
    start = cursor.at
    cursor.at += len(found.group(1))
    cursor.skip()
    _skip_brackets(cursor)
    return AxisCommand(found.group(1), found.group(2).upper(), cursor.span(start))


def _skip_brackets(cursor: Cursor) -> None:
    """Brackets whose content nobody reads yet."""
    opening, depth = cursor.at, 0
    for at in range(cursor.at, len(cursor.code)):
        depth += (cursor.code[at] == "[") - (cursor.code[at] == "]")
        if depth == 0:
            cursor.at = at + 1
            return
    cursor.at = len(cursor.code)
    close(cursor, opening, "20198")


def _need_value(cursor: Cursor) -> None:
    """A value must follow the letter; the cursor is then behind the letter."""
    start = cursor.at
    cursor.at += 1
    cursor.skip()
    if starts_value(cursor):
        return
    run = _RUN.match(cursor.code, start)
    if run is not None and run.end() > start + 1:
        cursor.at = start
        raise _unknown(cursor)
    cursor.at = start + 1
    raise _no_value(cursor, start)


def _value_after(cursor: Cursor, start: int) -> Expression:
    if not cursor.skip() or not starts_value(cursor):
        raise _no_value(cursor, start)
    return value(cursor)


def _no_value(cursor: Cursor, start: int) -> Exception:
    end = max(cursor.written_end(), start + 1)
    name = cursor.code[start:end]
    hint = f"write a number or an expression behind {_OPERATOR_END.sub('', name)}"
    if "(" in cursor.span(start, cursor.at + 1).text:
        hint = "round brackets hold comments; write square brackets: [ ]"
    message = f"A value is missing after {name!r}."
    return cursor.mistake("N1002", message, hint, cursor.span(start, end))


def _unknown(cursor: Cursor) -> Exception:
    run = cursor.looks_at(_RUN)
    if run is not None and run.group()[0].isascii():
        message = f"{run.group()!r} is neither an NC command nor an axis."
        return cursor.mistake("20200", message, span=cursor.span(cursor.at, run.end()))
    if cursor.char.isprintable() and cursor.char.isascii():
        return cursor.mistake(
            "20200", f"An NC command or an axis was expected, not {cursor.char!r}."
        )
    return cursor.mistake("N1001", f"The character {cursor.char!r} does not belong here.")


def _g_word(cursor: Cursor) -> GWord:
    """gword = "G" , expr , [ "=" , expr ] , [ "[" , [ expr ] , { "," , [ expr ] } , "]" ] ;"""
    start = cursor.at
    signed = cursor.match(_SIGNED_DWELL)
    if signed is not None:
        return dwell(cursor, Number(float(DWELL), cursor.span(start + 1)), start)
    _need_value(cursor)
    number = value(cursor)
    if isinstance(number, Number) and number.value == DWELL:
        return dwell(cursor, number, start)
    content = value(cursor) if cursor.match(EQUALS) else None
    after, arguments = cursor.at, None
    if cursor.skip() == "[":
        arguments = _places(cursor)
    else:
        cursor.at = after
    return GWord(number, content, arguments, cursor.span(start))


def _places(cursor: Cursor) -> tuple[Expression | None, ...]:
    opening = cursor.at
    cursor.at += 1
    places = [_place(cursor)]
    while cursor.take(","):
        places.append(_place(cursor))
    if cursor.skip() not in ("", "]"):
        hint = "values stand between commas, for example G82 [5, 7.5]"
        raise cursor.mistake("22151", f"{cursor.char!r} cannot stand between values.", hint)
    close(cursor, opening, "20198")
    return tuple(places)


def _place(cursor: Cursor) -> Expression | None:
    return None if cursor.skip() in (",", "]") else expression(cursor)


def _m_word(cursor: Cursor) -> MWord:
    """mword = "M" , expr , { group } ;"""
    start = cursor.at
    _need_value(cursor)
    number = value(cursor)
    arguments = groups(cursor)
    if arguments and cursor.skip() in ("N", "n"):  # M17 [JUMPS=2] N20
        begin = cursor.at
        cursor.at += 1
        label = Item("N", expression(cursor), cursor.span(begin))
        arguments += (Group(((label,),), label.span),)
    return MWord(number, arguments, cursor.span(start, cursor.written_end()))


def _address(cursor: Cursor) -> AddressWord:
    """addrword = letter , [ "=" ] , value ;"""
    start = cursor.at
    letter = cursor.char.upper()
    cursor.at += 1
    if cursor.match(EQUALS) is None:
        cursor.at = start
        _need_value(cursor)
    return AddressWord(letter, _value_after(cursor, start), cursor.span(start))


def _spindle(cursor: Cursor) -> Word:
    """spindle = "S" , [ digits | "." , name ] , ( "=" , value | brackets ) | "S" , value ;"""
    start = cursor.at
    named = cursor.match(_SPINDLE)
    if named is None:
        return _spindle_bracket(cursor) or _address(cursor)
    if cursor.match(EQUALS):
        _value_after(cursor, start)
    elif cursor.skip() == "[":
        _skip_brackets(cursor)
    else:
        raise _no_value(cursor, start)
    return SpindleWord(named.group(), cursor.span(start))


def _spindle_bracket(cursor: Cursor) -> SpindleWord | None:
    """`S[..]` that does not hold an expression is a command for the spindle."""
    start = cursor.at
    found = cursor.match(_SPINDLE_BRACKET)
    if found is None:
        return None
    cursor.skip()
    if starts_value(cursor):
        cursor.at = start
        return None
    cursor.at = found.end() - 1
    _skip_brackets(cursor)
    return SpindleWord(cursor.code[start], cursor.span(start))


def _assignment(cursor: Cursor) -> Assignment:
    """assign = target , ( "=" | "+=" | "-=" | "*=" | "/=" ) , expr ;"""
    start = cursor.at
    left = target(cursor)
    found = cursor.match(ASSIGN)
    if found is None:
        raise _not_assigned(cursor, left, start)
    if cursor.skip() == "" or (not starts_value(cursor) and not cursor.word()):
        raise _no_value(cursor, start)
    return Assignment(left, found.group(1), expression(cursor), cursor.span(start))


def _not_assigned(cursor: Cursor, left: Expression, start: int) -> Exception:
    name = cursor.code[start : cursor.at]
    operator = cursor.looks_at(_NOASSIGNMENT)
    if operator is not None:
        message = f"{operator.group(1)} does not assign a value to {name}."
        span = cursor.span(operator.start(1), operator.end())
        return cursor.mistake("20573", message, "=, +=, -=, *= and /= assign", span)
    id = "20182" if isinstance(left, Parameter) else "20194"
    message = f"{name} stands alone, without an assignment."
    return cursor.mistake(id, message, f"write {name} = and a value", cursor.span(start))


def _parameter(cursor: Cursor) -> Word:
    """A P that no number follows."""
    if cursor.code[cursor.at + 1 : cursor.at + 2].isalnum():
        raise _unknown(cursor)
    hint = "write P1, without a blank and without a sign, or P[expression]"
    raise cursor.mistake("20400", "P needs its number, which is greater than 0.", hint)


def _macro(cursor: Cursor) -> Macro | MacroDefinition:
    """macro = string , [ "=" , string ] ;"""
    start = cursor.at
    name = string(cursor).value
    if cursor.match(EQUALS) is None:
        return Macro(name, cursor.span(start))
    if cursor.skip() != '"':
        message = f"The text of the macro {name!r} must stand in quotation marks."
        hint = f'write "{name}" = "text"'
        raise cursor.mistake("N1002", message, hint, cursor.span(start, cursor.written_end()))
    text = string(cursor).value
    return MacroDefinition(name, text, cursor.span(start))


def _call(cursor: Cursor) -> Call:
    found = call(cursor)
    if found is None:
        raise _unknown(cursor)
    return found


def _cycle_word(cursor: Cursor, letter: str, start: int) -> Word:
    """cycleword = "@" , ( "X" | "Y" | "Z" | "I" | "J" | "K" | "S" ) , [ "=" ] , value ;"""
    cursor.match(EQUALS)
    sign = cursor.skip() if cursor.char in ("+", "-") else ""
    content = _value_after(cursor, start)
    name, span = f"@{letter.upper()}", cursor.span(start)
    if letter in "XYZxyz":
        return AxisWord(name, content, sign, span)
    return AddressWord(name, content, span)


_BY_LETTER: dict[str, Callable[[Cursor], Word]] = {
    "G": _g_word,
    "M": _m_word,
    "S": _spindle,
    "L": _call,
    "P": _parameter,
    **{letter: _address for letter in _ADDRESSES if letter.isupper()},
}
