"""The functions of expressions: one table.

Enters numbers (angles in degrees) and strings. Leaves a number or a string. A function that has
no value raises `NoValue` with the id of the diagnostic.
Source: TF5200 programming manual
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple


class NoValue(Exception):
    """`id` and `message` of the diagnostic; the span is the caller's."""

    def __init__(self, id: str, message: str) -> None:
        super().__init__(message)
        self.id = id
        self.message = message


class Entry(NamedTuple):
    """Fewest and most arguments; their kinds (`n`umber, `s`tring, `*` either); the function.

    `apply` is None for the functions that ask the environment.
    """

    least: int
    most: int
    kinds: str
    apply: Callable[..., Any] | None


def sine(angle: float) -> float:
    """Exact at multiples of 90 degrees and at 30 degrees before and after them.

    >>> sine(180), sine(30), sine(-90)
    (0.0, 0.5, -1.0)
    """
    turn = math.fmod(angle, 360.0)
    if turn < 0.0:
        turn += 360.0
    if turn < 180.0:
        exact = _EXACT.get(turn)
        return math.sin(math.radians(turn)) if exact is None else exact
    turn -= 180.0
    exact = _EXACT.get(turn)
    value = math.sin(math.radians(turn)) if exact is None else exact
    return -value if value else 0.0


_EXACT = {0.0: 0.0, 30.0: 0.5, 90.0: 1.0, 150.0: 0.5, 180.0: 0.0}


def cosine(angle: float) -> float:
    """Exact where `sine` is.

    >>> cosine(90), cosine(60), cosine(-180)
    (0.0, 0.5, -1.0)
    """
    return sine(math.fmod(angle, 360.0) + 90.0)


def quotient(dividend: float, divisor: float) -> float:
    """20396 when the divisor is 0 but for rounding, as in 10/COS[90]."""
    if abs(divisor) < 1e-15:
        raise NoValue("20396", "Division by zero.")
    return dividend / divisor


def _root(x: float) -> float:
    if x < 0:
        raise NoValue("20398", f"The root of {x:g} was asked for.")
    return math.sqrt(x)


def _logarithm(function: Callable[[float], float]) -> Callable[[float], float]:
    def apply(x: float) -> float:
        if x <= 0:
            raise NoValue("20399", f"The logarithm of {x:g} was asked for.")
        return function(x)

    return apply


def _arc(function: Callable[[float], float]) -> Callable[[float], float]:
    def apply(x: float) -> float:
        if abs(x) > 1:
            raise NoValue("N1006", f"{x:g} is not between -1 and 1.")
        return math.degrees(function(x))

    return apply


def rounded(x: float) -> int:
    """The nearest whole number, halves away from zero."""
    return math.floor(abs(x) + 0.5) * (1 if x >= 0 else -1)


def _character(text: str, position: float = 1.0) -> float:
    at = rounded(position)
    if not 1 <= at <= len(text):
        raise NoValue("N1006", f"The string has no position {at}.")
    return ord(text[at - 1])


def _left(text: str, count: float) -> str:
    return text[: max(0, rounded(count))]


def _right(text: str, count: float) -> str:
    return text[max(0, len(text) - max(0, rounded(count))) :]


def _middle(text: str, count: float, position: float) -> str:
    start = max(0, rounded(position) - 1)
    return text[start : start + max(0, rounded(count))]


def _insert(text: str, other: str, position: float) -> str:
    at = max(0, rounded(position))
    return text[:at] + other + text[at:]


def _delete(text: str, count: float, position: float) -> str:
    start = max(0, rounded(position) - 1)
    return text[:start] + text[start + max(0, rounded(count)) :]


def _replace(text: str, other: str, count: float, position: float) -> str:
    start = max(0, rounded(position) - 1)
    return text[:start] + other + text[start + max(0, rounded(count)) :]


def _number_from(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise NoValue("N1006", f"{text!r} is not a number.") from None


def _text_from_real(x: float) -> str:
    return f"{x:f}"


# fmt: off
FUNCTIONS: dict[str, Entry] = {
    "ABS": Entry(1, 1, "n", abs),
    "SQR": Entry(1, 1, "n", lambda x: x * x),
    "SQRT": Entry(1, 1, "n", _root),
    "EXP": Entry(1, 1, "n", math.exp),
    "LN": Entry(1, 1, "n", _logarithm(math.log)),
    "DEXP": Entry(1, 1, "n", lambda x: math.pow(10.0, x)),
    "LOG": Entry(1, 1, "n", _logarithm(math.log10)),
    "SIN": Entry(1, 1, "n", sine),
    "COS": Entry(1, 1, "n", cosine),
    "TAN": Entry(1, 1, "n", lambda x: quotient(sine(x), cosine(x))),
    "COT": Entry(1, 1, "n", lambda x: quotient(cosine(x), sine(x))),
    "ASIN": Entry(1, 1, "n", _arc(math.asin)),
    "ACOS": Entry(1, 1, "n", _arc(math.acos)),
    "ATAN": Entry(1, 1, "n", lambda x: math.degrees(math.atan(x))),
    "ATAN2": Entry(2, 2, "nn", lambda y, x: math.degrees(math.atan2(y, x))),
    "ACOT": Entry(1, 1, "n", lambda x: 90.0 - math.degrees(math.atan(x))),
    "INT": Entry(1, 1, "n", lambda x: float(math.trunc(x))),
    "FRACT": Entry(1, 1, "n", lambda x: math.fmod(x, 1.0)),
    "ROUND": Entry(1, 1, "n", lambda x: float(rounded(x))),
    "CEIL": Entry(1, 1, "n", lambda x: float(math.ceil(x))),
    "FLOOR": Entry(1, 1, "n", lambda x: float(math.floor(x))),
    "NOT": Entry(1, 1, "n", lambda x: float(abs(x) < 0.5)),
    "INV": Entry(1, 1, "n", lambda x: float(~rounded(x))),
    "LEFT": Entry(2, 2, "sn", _left),
    "MID": Entry(3, 3, "snn", _middle),
    "RIGHT": Entry(2, 2, "sn", _right),
    "LEN": Entry(1, 1, "s", len),
    "FIND": Entry(2, 2, "ss", lambda text, part: text.find(part) + 1),
    "ORD": Entry(1, 2, "sn", _character),
    "INSERT": Entry(3, 3, "ssn", _insert),
    "DELETE": Entry(3, 3, "snn", _delete),
    "REPLACE": Entry(4, 4, "ssnn", _replace),
    "REAL_TO_STR": Entry(1, 1, "n", _text_from_real),
    "INT_TO_STR": Entry(1, 1, "n", lambda x: str(rounded(x))),
    "BOOL_TO_STR": Entry(1, 1, "n", lambda x: "TRUE" if abs(x) >= 0.5 else "FALSE"),
    "STR_TO_REAL": Entry(1, 1, "s", _number_from),
    "STR_TO_INT": Entry(1, 1, "s", lambda text: float(rounded(_number_from(text)))),
    "IS_STRING": Entry(1, 1, "*", lambda x: float(isinstance(x, str))),
    "IS_NUMBER": Entry(1, 1, "*", lambda x: float(not isinstance(x, str))),
    "EXIST": Entry(1, 1, "*", None),
    "SIZEOF": Entry(1, 2, "*n", None),
    "MACRO_LENGTH": Entry(1, 1, "s", None),
    "MACRO_CONTENT": Entry(1, 1, "s", None),
}
# fmt: on
