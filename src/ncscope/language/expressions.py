"""Expressions: tree to value.

Enters the tree of an expression and an `Environment` that knows the variables. Leaves a number or
a string. The one exception is `EvaluationError`, which carries a diagnostic.
Source: TF5200 programming manual; the conventions there are marked as ours.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol

from ncscope.diagnostics import Span
from ncscope.language.cursor import Mistake
from ncscope.language.failures import EvaluationError, failure, used_at
from ncscope.language.functions import FUNCTIONS, NoValue, quotient, rounded
from ncscope.language.macro_texts import DEEPEST_MACRO, LONGEST_TEXT, MOST_USES, content
from ncscope.language.terms import parse_expression
from ncscope.language.tree import (
    Binary,
    CycleParameter,
    Expression,
    Function,
    Macro,
    Name,
    Number,
    Parameter,
    Text,
    Unary,
    Variable,
)

Value = float | str
Readable = Variable | Parameter | CycleParameter


class Environment(Protocol):
    """What an expression may ask.

    `indices` are the evaluated indices, rounded to whole numbers, in the order in which they are
    written: of a variable all brackets of all parts, of a P parameter its number and then its
    brackets, of a cycle parameter its number. `read` may raise `EvaluationError`.
    """

    def read(self, node: Readable, indices: tuple[int, ...]) -> Value: ...

    def exists(self, node: Readable, indices: tuple[int, ...]) -> bool: ...

    def size(self, node: Readable, indices: tuple[int, ...], dimension: int) -> int: ...

    def macro(self, name: str) -> str | None: ...


def evaluate(expression: Expression, environment: Environment) -> Value:
    """The value of an expression: a number, or a string."""
    return _VALUES[type(expression)](expression, environment)


def number(expression: Expression, environment: Environment) -> float:
    """The value of an expression that must be a number."""
    value = evaluate(expression, environment)
    if isinstance(value, str):
        raise _not_a_number(expression, value)
    return value


def indices_of(node: Readable, environment: Environment) -> tuple[int, ...]:
    """The evaluated indices of a node, as `Environment.read` takes them."""
    return tuple(rounded(number(index, environment)) for index in _index_nodes(node))


def is_true(value: float) -> bool:
    """Truth of the language: at least one half away from 0."""
    return abs(value) >= 0.5


# --- by kind of node: an operand is evaluated by its own function, one frame for each level ----


def _literal(node: Number | Text, environment: Environment) -> Value:
    return node.value


def _name(node: Name, environment: Environment) -> Value:
    return node.text


def _unary(node: Unary, environment: Environment) -> Value:
    inner = node.operand
    operand = _as_number(inner, _VALUES[type(inner)](inner, environment), environment)
    return -operand if node.operator == "-" else operand


def _binary(node: Binary, environment: Environment) -> Value:
    """`+` and the comparisons take two strings too."""
    left, right = node.left, node.right
    if node.operator in _ON_STRINGS and not _has_number_literal(node):
        a = _VALUES[type(left)](left, environment)
        b = _VALUES[type(right)](right, environment)
        if isinstance(a, str) and isinstance(b, str) and not _are_macros(node, environment):
            return _on_strings(node, a, b)
        pair = _as_number(left, a, environment), _as_number(right, b, environment)
    else:
        x = _as_number(left, _VALUES[type(left)](left, environment), environment)
        pair = x, _as_number(right, _VALUES[type(right)](right, environment), environment)
    return _checked(ARITHMETIC[node.operator], pair, node.span)


def _has_number_literal(node: Binary) -> bool:
    return isinstance(node.left, Number) or isinstance(node.right, Number)


def _are_macros(node: Binary, environment: Environment) -> bool:
    """Whether two strings are literals that both name macros: these stand for numbers."""
    sides = (node.left, node.right)
    return all(isinstance(n, Text) and environment.macro(n.value) is not None for n in sides)


def _on_strings(node: Binary, left: str, right: str) -> Value:
    try:
        return _ON_STRINGS[node.operator](left, right)
    except NoValue as error:
        raise failure(error.id, node.span, error.message) from None


def _as_number(node: Expression, value: Value, environment: Environment) -> float:
    """The value of an operand that must be a number; a string literal names a macro."""
    if not isinstance(value, str):
        return value
    if isinstance(node, Text):
        return number(Macro(node.value, node.span), environment)
    raise _not_a_number(node, value)


def _checked(apply: Callable[..., float], values: Iterable[Value], span: Span) -> float:
    """Calls the function; its failure, and any result that is not finite, becomes a diagnostic."""
    try:
        result = apply(*values)
    except NoValue as error:
        raise failure(error.id, span, error.message) from None
    except (OverflowError, ValueError, ZeroDivisionError):
        raise failure("21883", span, "The value of the expression overflows.") from None
    if isinstance(result, str) or math.isfinite(result):
        return result
    raise failure("21883", span, "The value of the expression overflows.")


def _function(node: Function, environment: Environment) -> Value:
    if node.name in ("EXIST", "SIZEOF"):
        return _query(node, environment)
    entry = FUNCTIONS[node.name]
    values: list[Value] = []
    for argument, kind in zip(node.arguments, entry.kinds, strict=False):
        value = _VALUES[type(argument)](argument, environment)
        values.append(_as_number(argument, value, environment) if kind == "n" else value)
    _check_strings(node, values, entry.kinds)
    if entry.apply is None and node.name == "MACRO_CONTENT":
        return content(str(values[0]), environment.macro, node.span)
    if entry.apply is None:
        return float(len(_macro_text(environment, str(values[0]), node.span)))
    result: Value = _checked(entry.apply, values, node.span)
    return result if isinstance(result, str) else float(result)


def _check_strings(node: Function, values: Sequence[Value], kinds: str) -> None:
    for argument, value, kind in zip(node.arguments, values, kinds, strict=False):
        if kind == "s" and not isinstance(value, str):
            raise failure("N1006", argument.span, f"{node.name} needs a string here.")


def _query(node: Function, environment: Environment) -> Value:
    target = node.arguments[0]
    assert isinstance(target, Variable | Parameter | CycleParameter)
    wanted = 1
    if len(node.arguments) > 1:
        dimension = node.arguments[1]
        wanted = rounded(_as_number(dimension, evaluate(dimension, environment), environment))
    indices = indices_of(target, environment)
    if node.name == "EXIST":
        return float(environment.exists(target, indices))
    return float(environment.size(target, indices, wanted))


def _index_nodes(node: Readable) -> tuple[Expression, ...]:
    if isinstance(node, Variable):
        return tuple(index for part in node.parts for index in part.indices)
    if isinstance(node, Parameter):
        return (node.number, *node.indices)
    return (node.number,)


def _read(node: Readable, environment: Environment) -> Value:
    numbers = (
        rounded(_as_number(index, _VALUES[type(index)](index, environment), environment))
        for index in _index_nodes(node)
    )
    return environment.read(node, tuple(numbers))


def _macro(node: Macro, environment: Environment) -> Value:
    depth = environment.depth + 1 if isinstance(environment, _InMacro) else 1
    if depth > DEEPEST_MACRO:
        hint = "a macro cannot stand in its own text, nor in the text of a macro that it uses"
        raise failure("20734", node.span, f"The macro {node.name!r} contains itself.", hint)
    uses = environment.uses if isinstance(environment, _InMacro) else [0]
    uses[0] += 1
    if uses[0] > MOST_USES:
        raise failure("20734", node.span, f"More than {MOST_USES} macros are used.")
    text = _macro_text(environment, node.name, node.span)
    inside = environment.outer if isinstance(environment, _InMacro) else environment
    try:
        tree = parse_expression(text, node.span)
    except Mistake as mistake:
        message = f"The macro {node.name!r} is no expression: {mistake.item.message}"
        raise failure(mistake.item.id, node.span, message) from None
    try:
        return evaluate(tree, _InMacro(inside, depth, uses))
    except EvaluationError as error:
        raise EvaluationError(used_at(error.diagnostic, node.span)) from None


_VALUES: dict[type, Callable[[Any, Environment], Value]] = {
    Number: _literal,
    Text: _literal,
    Name: _name,
    Unary: _unary,
    Binary: _binary,
    Function: _function,
    Macro: _macro,
    Variable: _read,
    Parameter: _read,
    CycleParameter: _read,
}


def _macro_text(environment: Environment, name: str, span: Span) -> str:
    text = environment.macro(name)
    if text is None:
        raise failure("20619", span, f"The macro {name!r} is not defined.")
    return text


class _InMacro:
    """The environment of a macro's text; counts macros, and how deep they stand in macros."""

    def __init__(self, outer: Environment, depth: int, uses: list[int]) -> None:
        self.outer = outer
        self.depth = depth
        self.uses = uses
        self.read = outer.read
        self.exists = outer.exists
        self.size = outer.size
        self.macro = outer.macro


def _not_a_number(node: Expression, value: str) -> EvaluationError:
    return failure("20392", node.span, f"A number was expected, not the string {value!r}.")


def _power(base: float, exponent: float) -> float:
    if base == 0 and exponent < 0:
        raise NoValue("20396", "Division by zero.")
    if base < 0 and exponent != math.floor(exponent):
        raise NoValue("20398", f"The root of {base:g} was asked for.")
    return math.pow(base, exponent)


def _joined(left: str, right: str) -> str:
    if len(left) + len(right) > LONGEST_TEXT:
        raise NoValue("N1008", f"A text has at most {LONGEST_TEXT} characters.")
    return left + right


def _remainder(dividend: float, divisor: float) -> float:
    quotient(dividend, divisor)
    return math.fmod(dividend, divisor)


ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": quotient,
    "**": _power,
    "MOD": _remainder,
    "&": lambda a, b: float(rounded(a) & rounded(b)),
    "|": lambda a, b: float(rounded(a) | rounded(b)),
    "^": lambda a, b: float(rounded(a) ^ rounded(b)),
    "&&": lambda a, b: float(is_true(a) and is_true(b)),
    "||": lambda a, b: float(is_true(a) or is_true(b)),
    "XOR": lambda a, b: float(is_true(a) != is_true(b)),
    "==": lambda a, b: float(a == b),
    "!=": lambda a, b: float(a != b),
    "<": lambda a, b: float(a < b),
    "<=": lambda a, b: float(a <= b),
    ">": lambda a, b: float(a > b),
    ">=": lambda a, b: float(a >= b),
}
_ON_STRINGS: dict[str, Callable[[str, str], Value]] = {
    "+": _joined,
    "==": lambda a, b: float(a == b),
    "!=": lambda a, b: float(a != b),
    "<": lambda a, b: float(a < b),
    "<=": lambda a, b: float(a <= b),
    ">": lambda a, b: float(a > b),
    ">=": lambda a, b: float(a >= b),
}
