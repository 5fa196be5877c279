"""Expressions: tree to value.

Enters the tree of an expression and an `Environment` that knows the variables. Leaves a number or
a string. The one exception is `EvaluationError`, which carries a diagnostic.
Source: TF5200 programming manual; the conventions there are marked as ours.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

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


Compiled = Callable[[Environment], Value]


def evaluate(expression: Expression, environment: Environment) -> Value:
    """The value of an expression: a number, or a string."""
    if type(expression) is Number:
        return expression.value
    return compile_expression(expression)(environment)


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


_COMPILED: dict[int, tuple[Expression, Compiled]] = {}


def compile_expression(expression: Expression) -> Compiled:
    """A function from environment to value. The last some thousand are kept."""
    known = _COMPILED.get(id(expression))
    if known is not None:
        return known[1]
    if len(_COMPILED) > 8000:
        _COMPILED.clear()
    compiled = _compile(expression)
    _COMPILED[id(expression)] = (expression, compiled)
    return compiled


def _compile(node: Expression) -> Compiled:
    match node:
        case Number(value) | Text(value):
            return lambda environment: value
        case Name(text):
            return lambda environment: text
        case Macro():
            return _macro(node)
        case Unary():
            return _unary(node)
        case Binary():
            return _binary(node)
        case Function():
            return _function(node)
        case _:
            return _read(node)


def _compile_number(node: Expression) -> Callable[[Environment], float]:
    if isinstance(node, Text):
        node = Macro(node.value, node.span)
    inner = _compile(node)

    def apply(environment: Environment) -> float:
        value = inner(environment)
        if isinstance(value, str):
            raise _not_a_number(node, value)
        return value

    return inner if isinstance(node, Number) else apply  # type: ignore[return-value]


def _unary(node: Unary) -> Compiled:
    operand = _compile_number(node.operand)
    if node.operator == "-":
        return lambda environment: -operand(environment)
    return operand


def _binary(node: Binary) -> Compiled:
    if node.operator in _ON_STRINGS and not _has_number_literal(node):
        return _binary_on_values(node)
    left, right = _compile_number(node.left), _compile_number(node.right)
    apply, span = ARITHMETIC[node.operator], node.span

    def run(environment: Environment) -> float:
        return _checked(apply, (left(environment), right(environment)), span)

    return run


def _has_number_literal(node: Binary) -> bool:
    return isinstance(node.left, Number) or isinstance(node.right, Number)


def _binary_on_values(node: Binary) -> Compiled:
    """`+` and the comparisons take two strings too.

    A string beside a number names a macro, and so do two strings that both are names of macros.
    """
    left, right, span = _compile(node.left), _compile(node.right), node.span
    on_numbers, on_strings = ARITHMETIC[node.operator], _ON_STRINGS[node.operator]
    literals = [n.value for n in (node.left, node.right) if isinstance(n, Text)]

    def macros(environment: Environment) -> bool:
        return len(literals) == 2 and all(environment.macro(n) is not None for n in literals)

    def run(environment: Environment) -> Value:
        a, b = left(environment), right(environment)
        if isinstance(a, str) and isinstance(b, str) and not macros(environment):
            try:
                return on_strings(a, b)
            except NoValue as error:
                raise failure(error.id, span, error.message) from None
        pair = (_as_number(node.left, a, environment), _as_number(node.right, b, environment))
        return _checked(on_numbers, pair, span)

    return run


def _as_number(node: Expression, value: Value, environment: Environment) -> float:
    if not isinstance(value, str):
        return value
    if isinstance(node, Text):
        return number(Macro(node.value, node.span), environment)
    raise _not_a_number(node, value)


def _checked(apply: Callable[..., float], values: tuple[Value, ...], span: Span) -> float:
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


def _function(node: Function) -> Compiled:
    if node.name in ("EXIST", "SIZEOF"):
        return _query(node)
    entry = FUNCTIONS[node.name]
    compiled = [
        _compile_number(argument) if kind == "n" else _compile(argument)
        for argument, kind in zip(node.arguments, entry.kinds, strict=False)
    ]
    apply, span = entry.apply, node.span

    def run(environment: Environment) -> Value:
        values = tuple(argument(environment) for argument in compiled)
        _check_strings(node, values, entry.kinds)
        if apply is None and node.name == "MACRO_CONTENT":
            return content(str(values[0]), environment.macro, span)
        if apply is None:
            return float(len(_macro_text(environment, str(values[0]), span)))
        result: Value = _checked(apply, values, span)
        return result if isinstance(result, str) else float(result)

    return run


def _check_strings(node: Function, values: tuple[Value, ...], kinds: str) -> None:
    for argument, value, kind in zip(node.arguments, values, kinds, strict=False):
        if kind == "s" and not isinstance(value, str):
            raise failure("N1006", argument.span, f"{node.name} needs a string here.")


def _query(node: Function) -> Compiled:
    target = node.arguments[0]
    assert isinstance(target, Variable | Parameter | CycleParameter)
    if node.name == "EXIST":
        return lambda environment: float(
            environment.exists(target, indices_of(target, environment))
        )
    dimension = _compile_number(node.arguments[1]) if len(node.arguments) > 1 else None

    def size(environment: Environment) -> float:
        wanted = rounded(dimension(environment)) if dimension else 1
        return float(environment.size(target, indices_of(target, environment), wanted))

    return size


def _index_nodes(node: Readable) -> tuple[Expression, ...]:
    if isinstance(node, Variable):
        return tuple(index for part in node.parts for index in part.indices)
    if isinstance(node, Parameter):
        return (node.number, *node.indices)
    return (node.number,)


def _read(node: Readable) -> Compiled:
    nodes = _index_nodes(node)
    if all(isinstance(index, Number) for index in nodes):
        fixed = tuple(rounded(index.value) for index in nodes if isinstance(index, Number))
        return lambda environment: environment.read(node, fixed)
    compiled = [_compile_number(index) for index in nodes]
    return lambda environment: environment.read(
        node, tuple(rounded(index(environment)) for index in compiled)
    )


def _macro(node: Macro) -> Compiled:
    def run(environment: Environment) -> Value:
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
            return _compile(tree)(_InMacro(inside, depth, uses))
        except EvaluationError as error:
            raise EvaluationError(used_at(error.diagnostic, node.span)) from None

    return run


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
