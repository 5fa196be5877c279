"""Expressions as Python source: what a loop repeats is compiled once and not walked each pass.

Enters the tree of an expression over plain numbers. Leaves a Python expression that has the value
of `expressions.evaluate`, bit for bit, or raises; whoever runs it falls back to `evaluate` then,
which says what is wrong. What is not over plain numbers is `NotInline`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ncscope.language.expressions import ARITHMETIC
from ncscope.language.functions import FUNCTIONS
from ncscope.language.tree import (
    Binary,
    CycleParameter,
    Expression,
    Function,
    Number,
    Parameter,
    Unary,
    Variable,
)

USER_GROUPS = ("P", "S", "L", "CYC")
PLAIN = {"+": "+", "-": "-", "*": "*"}
COMPARISONS = {"==": "==", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
BOUNDED = frozenset(("SIN", "COS", "INT", "FRACT", "ROUND", "CEIL", "FLOOR", "ABS", "ATAN", "NOT"))
"""Functions that give a finite number for a finite number."""


class NotInline(Exception):
    """The expression is not one over plain numbers."""


class NotFinite(ArithmeticError):
    """A value overflowed on the way."""


def finite(value: float) -> float:
    """The value; raises for one that is not a finite number."""
    if value - value != 0.0:
        raise NotFinite
    return value


_OPERATOR_NAMES = {
    "/": "quotient", "**": "power", "MOD": "remainder", "&": "bit_and", "|": "bit_or",
    "^": "bit_xor", "&&": "both", "||": "either", "XOR": "one",
}  # fmt: skip
_INLINE_FUNCTIONS = {
    name: entry.apply
    for name, entry in FUNCTIONS.items()
    if entry.apply is not None and set(entry.kinds) == {"n"} and not name.endswith("_TO_STR")
}
NAMESPACE: dict[str, Any] = {
    "finite": finite,
    **{name: ARITHMETIC[symbol] for symbol, name in _OPERATOR_NAMES.items()},
    **{f"f_{name}": apply for name, apply in _INLINE_FUNCTIONS.items()},
}
"""What the source of this module refers to."""


def variable_key(node: Expression) -> str:
    """`P5` or `V.P.NAME`: the name of a plain variable. Raises NotInline for any other node."""
    if isinstance(node, Parameter) and not node.indices and isinstance(node.number, Number):
        number = math.floor(node.number.value + 0.5)
        if number > 0:
            return f"P{number}"
    if isinstance(node, Variable) and len(node.parts) >= 3:
        group = node.parts[1].name.upper()
        bare = not any(part.indices for part in node.parts)
        if node.parts[0].name.upper() == "V" and group in USER_GROUPS and bare:
            return f"V.{group}." + ".".join(part.name for part in node.parts[2:])
    raise NotInline


def source(node: Expression, names: Mapping[str, str]) -> str:
    """The Python expression; `names` are local names of variables that the block has assigned."""
    match node:
        case Number(value):
            return repr(float(value))
        case Parameter() | Variable():
            key = variable_key(node)
            return names.get(key, f"v[{key!r}]")
        case Unary():
            operand = source(node.operand, names)
            return f"(-{operand})" if node.operator == "-" else operand
        case Binary():
            return _binary(node, names)
        case Function() if node.name in _INLINE_FUNCTIONS:
            inner = [_guarded(argument, names) for argument in node.arguments]
            return f"f_{node.name}({', '.join(inner)})"
    raise NotInline


def condition(node: Expression, names: Mapping[str, str]) -> str:
    """A Python expression for whether the value is true: at least one half away from 0."""
    if isinstance(node, Binary) and node.operator in COMPARISONS:
        return _comparison(node, names)
    return f"abs(finite({source(node, names)})) >= 0.5"


def _binary(node: Binary, names: Mapping[str, str]) -> str:
    if node.operator in PLAIN:
        left, right = source(node.left, names), source(node.right, names)
        return f"({left} {PLAIN[node.operator]} {right})"
    if node.operator in COMPARISONS:
        return f"(1.0 if {_comparison(node, names)} else 0.0)"
    if node.operator == "/" and isinstance(node.right, Number) and node.right.value >= 1e-15:
        return f"({source(node.left, names)} / {source(node.right, names)})"
    left, right = _guarded(node.left, names), _guarded(node.right, names)
    return f"{_OPERATOR_NAMES[node.operator]}({left}, {right})"


def _comparison(node: Binary, names: Mapping[str, str]) -> str:
    left, right = _guarded(node.left, names), _guarded(node.right, names)
    return f"{left} {COMPARISONS[node.operator]} {right}"


def _guarded(node: Expression, names: Mapping[str, str]) -> str:
    """The source, checked where an infinite value could turn into a finite one unseen."""
    text = source(node, names)
    if isinstance(node, (Number, Parameter, Variable, CycleParameter)):
        return text
    if isinstance(node, Function) and node.name in BOUNDED:
        return text
    return f"finite({text})"
