"""Expressions: text to tree.

Enters a cursor before an expression. Leaves the tree of the expression; the cursor stands behind
it. The expression ends where no operator follows (TF5200 programming manual).
"""

from __future__ import annotations

import math
import re

from ncscope.diagnostics import Source, Span
from ncscope.language.cursor import DEEPEST, Cursor
from ncscope.language.functions import FUNCTIONS
from ncscope.language.tree import (
    Binary,
    CycleParameter,
    Expression,
    Function,
    Macro,
    Number,
    Parameter,
    Part,
    Text,
    Unary,
    Variable,
)

# Higher binds tighter. All are left associative but `**`.
PRECEDENCE: dict[str, int] = {
    "||": 1,
    "XOR": 2,
    "&&": 3,
    "|": 4,
    "^": 5,
    "&": 6,
    "==": 7,
    "!=": 7,
    "<": 8,
    "<=": 8,
    ">": 8,
    ">=": 8,
    "+": 9,
    "-": 9,
    "*": 10,
    "/": 10,
    "MOD": 10,
    "**": 12,
}
_SIGN_PRECEDENCE = 11
CONSTANTS: dict[str, float] = {"TRUE": 1.0, "FALSE": 0.0, "PI": 3.141592653589793}
_BY_NAME = ("EXIST", "SIZEOF")
_BY_MACRO = {"MACRO_LENGTH": "22254", "MACRO_CONTENT": "22275"}

_OPERATOR = re.compile(
    r"[ \t\0\r]*(\*\*(?!=)|&&|\|\||[=!<>]=|[-+*/](?!=)|[&|^>]|<(?!>)|(?:MOD|XOR)(?!\w))",
    re.IGNORECASE,
)
_ENDS = frozenset(("", ",", "]"))
CONTINUED = "a backslash at the end of a line joins the next line to it"
WORD_OPERATORS = {"AND": "&& (or & for bits)", "OR": "|| (or | for bits)", "<>": "!="}
_WORD_OPERATOR = re.compile(r"[ \t\0\r]+(AND|OR)(?![\w=])|[ \t\0\r]*(<>)", re.IGNORECASE)
_NUMBER = re.compile(r"[0-9]+(?:\.[0-9]*)?|\.[0-9]+")
_NUMBER_ALONE = re.compile(
    rf"[ \t\0\r]*({_NUMBER.pattern})"
    r"(?=[ \t\0\r]*(?:[\],:#]|\Z|(?!(?:MOD|XOR|AND|OR)(?!\w))[A-Z]))",
    re.IGNORECASE,
)
"""A number behind which the expression ends: most expressions are no more."""
_STRING = re.compile(r'"((?:\\"|[^"])*)"')
_PARAMETER = re.compile(r"[Pp](?=[0-9]|\[|[Pp][0-9\[])")
_PLAIN_PARAMETER = re.compile(r"[Pp]([0-9]+)(?![0-9\[])")
"""A parameter without indices."""
_DIGITS = re.compile(r"[0-9]+")
_VARIABLE = re.compile(r"[Vv](?=\.[^\W0-9]|\.@)")
_PLAIN_VARIABLE = re.compile(r"[Vv]\.[^\W0-9]\w*(?:\.\w+)*(?![\w.\[])")
"""A variable without indices."""
_CYCLE = re.compile(r"@[Pp](?=[0-9]|\[)")
_TARGET = re.compile("|".join(p.pattern for p in (_PARAMETER, _VARIABLE, _CYCLE)))
_PART = re.compile(r"\.(@?\w+)")
_SIGNED_PART = re.compile(r"\.([-+]?@?\w+)")
_OPENS_FUNCTION = re.compile(r"([A-Za-z_]\w*)[ \t\0\r]*\[")
_VALUE_START = re.compile(r'[-+\["]|\.?[0-9]|[Pp][0-9\[]|[Pp][Pp][0-9\[]|[Vv]\.|@[Pp][0-9\[]')


def starts_value(cursor: Cursor) -> bool:
    """Whether an expression can begin at the next character."""
    if cursor.looks_at(_VALUE_START):
        return True
    name = cursor.word().upper()
    return name in CONSTANTS or name in FUNCTIONS or bool(cursor.looks_at(_OPENS_FUNCTION))


def starts_target(cursor: Cursor) -> bool:
    """Whether something that can be assigned to begins at the next character."""
    return cursor.looks_at(_TARGET) is not None


def expression(cursor: Cursor) -> Expression:
    """expr = term , { operator , term } ;"""
    if cursor.depth < DEEPEST and (alone := cursor.match(_NUMBER_ALONE)) is not None:
        return _literal(cursor, alone.group(1), alone.start(1))
    outer = cursor.operators
    if cursor.depth == 0:
        outer = cursor.operators = 0
    cursor.deeper(1)
    result = _binary(cursor, 1)
    cursor.deeper(-1)
    if cursor.depth == 0:
        cursor.operators = outer
    return result


def value(cursor: Cursor) -> Expression:
    """value = expr ;  a string alone is the name of a macro."""
    result = expression(cursor)
    return Macro(result.value, result.span) if isinstance(result, Text) else result


def _binary(cursor: Cursor, lowest: int) -> Expression:
    """binary = unary , { operator , binary } ;  (precedence climbing)"""
    cursor.skip()
    start = cursor.at
    left = _unary(cursor)
    while (found := _operator(cursor)) is not None:
        operator = found.group(1).upper()
        strength = PRECEDENCE[operator]
        if strength < lowest:
            break
        cursor.at = found.end()
        cursor.count_operator()
        right = _right_side(cursor, operator, strength)
        left = Binary(operator, left, right, cursor.span(start))
    return left


def _operator(cursor: Cursor) -> re.Match[str] | None:
    """The operator behind a term; a word that other languages have for one is a mistake."""
    if cursor.char in _ENDS:
        return None
    found = cursor.looks_at(_OPERATOR)
    if found is None and (other := cursor.looks_at(_WORD_OPERATOR)) is not None:
        name = other.group(other.lastindex or 0).upper()
        hint = f"write {WORD_OPERATORS[name]}"
        span = cursor.span(other.end() - len(name), other.end())
        raise cursor.mistake("20392", f"{name} is no operator.", hint, span)
    return found


def _right_side(cursor: Cursor, operator: str, strength: int) -> Expression:
    if operator != "**":
        return _binary(cursor, strength + 1)
    cursor.deeper(1)
    right = _binary(cursor, strength)
    cursor.deeper(-1)
    return right


def _unary(cursor: Cursor) -> Expression:
    """unary = [ "+" | "-" ] , ( unary | primary ) ;  `**` binds tighter than the sign before it."""
    sign = cursor.skip()
    if sign not in ("+", "-") or not sign:
        return primary(cursor)
    start = cursor.at
    cursor.at += 1
    cursor.deeper(1)
    operand = _binary(cursor, _SIGN_PRECEDENCE)
    cursor.deeper(-1)
    return Unary(sign, operand, cursor.span(start))


def primary(cursor: Cursor) -> Expression:
    """primary = number | "[" expr "]" | string | target | constant | function ;"""
    start = cursor.at
    number = cursor.match(_NUMBER)
    if number:
        return _literal(cursor, number.group(), start)
    if cursor.char == "[":
        return _bracket(cursor)
    if cursor.char == '"':
        return string(cursor)
    if starts_target(cursor):
        return target(cursor)
    return _named(cursor)


def _literal(cursor: Cursor, digits: str, start: int) -> Number:
    """number = digits , [ "." , [ digits ] ] | "." , digits ;"""
    result = float(digits)
    if math.isinf(result):
        raise cursor.mistake("21883", "The number is too large.", span=cursor.span(start))
    return Number(result, cursor.span(start))


def _bracket(cursor: Cursor) -> Expression:
    """bracket = "[" , expr , "]" ;"""
    opening = cursor.at
    cursor.at += 1
    if cursor.skip() == "]":
        raise cursor.mistake("20480", "The brackets are empty.", span=cursor.span(opening))
    result = expression(cursor)
    close(cursor, opening, "20397")
    return result


def _named(cursor: Cursor) -> Expression:
    """named = "TRUE" | "FALSE" | "PI" | function , "[" , expr , { "," , expr } , "]" ;"""
    start, word = cursor.at, cursor.word()
    name = word.upper()
    if name in CONSTANTS:
        cursor.at += len(word)
        return Number(CONSTANTS[name], cursor.span(start))
    if name not in FUNCTIONS:
        shown = word or cursor.char
        message = f"{shown!r} is no term of an expression." if shown else "A term is missing here."
        hint = "write a number, a parameter P.., a variable V... or a function such as SIN[..]"
        if not shown.strip():
            hint = CONTINUED
        raise cursor.mistake("20392", message, hint)
    cursor.at += len(word)
    if cursor.skip() != "[":
        hint = f"write {name}[..]"
        raise cursor.mistake("20387", f"The function {name} needs a bracket.", hint)
    return _function(cursor, name, start)


def _function(cursor: Cursor, name: str, start: int) -> Function:
    arguments = arguments_in_brackets(cursor)
    span = cursor.span(start)
    least, most = FUNCTIONS[name].least, FUNCTIONS[name].most
    if len(arguments) < least:
        raise cursor.mistake("21471", f"{name} needs {least} arguments.", span=span)
    if len(arguments) > most:
        raise cursor.mistake("21474", f"{name} has at most {most} arguments.", span=span)
    if name in _BY_NAME and not isinstance(arguments[0], Variable | Parameter | CycleParameter):
        message = f"{name} needs a variable or parameter in brackets."
        raise cursor.mistake("20868", message, span=span)
    if name in _BY_MACRO and not isinstance(arguments[0], Text):
        message = f"{name} needs the name of a macro in quotation marks."
        hint = f'write {name}["NAME"]'
        raise cursor.mistake(_BY_MACRO[name], message, hint, arguments[0].span)
    return Function(name, arguments, span)


def arguments_in_brackets(cursor: Cursor, unclosed: str = "20397") -> tuple[Expression, ...]:
    """arguments = "[" , expr , { "," , expr } , "]" ;

    unclosed: number of the mistake that the last bracket is missing.
    """
    opening = cursor.at
    cursor.at += 1
    if cursor.skip() == "]":
        cursor.at += 1
        raise cursor.mistake("20480", "The brackets are empty.", span=cursor.span(opening))
    result = [expression(cursor)]
    while cursor.take(","):
        if cursor.skip() == "]":
            raise cursor.mistake("20483", "A comma stands before the closing bracket.")
        result.append(expression(cursor))
    close(cursor, opening, unclosed)
    return tuple(result)


def close(cursor: Cursor, opening: int, id: str) -> None:
    """Takes the closing bracket, or blames the opening one."""
    if not cursor.take("]"):
        line, column = cursor.source.position(cursor.base + opening)
        hint = f"the bracket was opened at line {line}, column {column}"
        if cursor.at_end:
            hint += f"; {CONTINUED}"
        elif cursor.char == "=":
            hint = "two equals signs compare: =="
        raise cursor.mistake(id, "A closing bracket ']' is missing here.", hint)


def string(cursor: Cursor) -> Text:
    r"""string = '"' , { character | '\"' } , '"' ;"""
    start = cursor.at
    found = cursor.match(_STRING)
    if found is None:
        end = len(cursor.code.rstrip())
        raise cursor.mistake("N1003", "The string is not closed.", span=cursor.span(start, end))
    return Text(found.group(1).replace('\\"', '"'), cursor.span(start))


def target(cursor: Cursor) -> Variable | Parameter | CycleParameter:
    """target = parameter | cycle parameter | variable ;"""
    start = cursor.at
    plain = cursor.match(_PLAIN_PARAMETER)
    if plain is not None:
        number = _literal(cursor, plain.group(1), start + 1)
        return Parameter(number, (), cursor.span(start))
    if cursor.match(_PARAMETER):
        return Parameter(_parameter_number(cursor), _indices(cursor), cursor.span(start))
    if cursor.match(_CYCLE):
        return CycleParameter(_parameter_number(cursor), cursor.span(start))
    return _variable(cursor)


def _parameter_number(cursor: Cursor) -> Expression:
    """parameter = "P" , ( digits | "[" expr "]" | parameter ) ;"""
    start = cursor.at
    digits = cursor.match(_DIGITS)
    if digits:
        return _literal(cursor, digits.group(), start)
    cursor.deeper(1)
    result = _bracket(cursor) if cursor.char == "[" else target(cursor)
    cursor.deeper(-1)
    return result


def _variable(cursor: Cursor) -> Variable:
    """variable = "V" , { "." , name , { "[" , expr , { "," , expr } , "]" } } ;"""
    start = cursor.at
    plain = cursor.match(_PLAIN_VARIABLE)
    if plain is not None:
        names = plain.group().split(".")
        return Variable(tuple(Part(name, ()) for name in names), cursor.span(start))
    found = cursor.match(_VARIABLE)
    if found is None:
        raise cursor.mistake("20394", "A variable or parameter was expected.")
    parts = [Part(found.group(), ())]
    while cursor.char == ".":
        pattern = _SIGNED_PART if parts[-1].name.upper() == "A" else _PART
        name = cursor.match(pattern)
        if name is None:
            message = "The name of the variable ends with a dot."
            raise cursor.mistake("20394", message, span=cursor.span(start, cursor.at + 1))
        parts.append(Part(name.group(1), _indices(cursor)))
    return Variable(tuple(parts), cursor.span(start))


def _indices(cursor: Cursor) -> tuple[Expression, ...]:
    """indices = { "[" , expr , { "," , expr } , "]" } ;  no blank before the bracket"""
    result: tuple[Expression, ...] = ()
    while cursor.char == "[":
        result += arguments_in_brackets(cursor, "21217")
    return result


def parse_expression(text: str, span: Span) -> Expression:
    """The expression that is the whole of `text`, such as the content of a macro.

    `span` is where the text is used; it is named in the source of the result. Raises Mistake.
    """
    cursor = Cursor(Source(f"{span.source.name}, text of {span.text}", text), text, 0)
    result = expression(cursor)
    if cursor.skip():
        raise cursor.mistake("20392", "The text is not one complete expression.")
    return result
