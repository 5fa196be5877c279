"""`--set V.E.NAME=VALUE`: values of external variables as the user writes them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING

from ncscope.cli.screen import fail

if TYPE_CHECKING:
    from ncscope.machine import Machine

Value = float | str
Values = Mapping[str, Value | tuple[Value, ...]]
_ELEMENT = re.compile(r'\s*("[^"]*"|[^,"]*)\s*(,|$)')


def read_settings(texts: list[str] | None) -> dict[str, Value | tuple[Value, ...]]:
    """The texts of --set by name; what they mean depends on the machine, see `typed_settings`."""
    values: dict[str, Value | tuple[Value, ...]] = {}
    for text in texts or ():
        name, equals, value = text.partition("=")
        if not equals or not name.strip().startswith("V.E."):
            fail(f"--set {text}: write V.E.NAME=VALUE")
        values[name.strip()] = value.strip()
    return values


def typed_settings(machine: Machine, values: Values) -> Values:
    """The values as the declarations of the machine want them.

    A text for a variable of the type STRING; else numbers, TRUE and FALSE, or a text where it is
    none of them. `[1,2]` is a list of values.
    """
    return {
        name: _typed(machine, name, text) if isinstance(text, str) else text
        for name, text in values.items()
    }


def _typed(machine: Machine, name: str, text: str) -> Value | tuple[Value, ...]:
    declared = machine.external.get(name[4:].partition("[")[0])
    is_text = declared is not None and declared.type == "STRING"
    is_single = declared is not None and not declared.elements
    if text.startswith("[") and text.endswith("]") and not (is_text and is_single):
        return tuple(_value(element, is_text) for element in _elements(name, text))
    return _value(text, is_text)


def _elements(name: str, text: str) -> list[str]:
    inside, at, found = text[1:-1], 0, []
    while True:
        match = _ELEMENT.match(inside, at)
        if match is None or not match.group(1).strip():
            fail(f"--set {name}={text}: write values with commas between them, for example [1,2]")
        found.append(match.group(1).strip())
        at = match.end()
        if not match.group(2):
            return found


def _value(text: str, is_text: bool) -> Value:
    if len(text) >= 2 and text[0] == text[-1] == '"':
        return text[1:-1]
    if is_text:
        return text
    if text.upper() in ("TRUE", "FALSE"):
        return float(text.upper() == "TRUE")
    try:
        number = float(text)
    except ValueError:
        return text
    return number if isfinite(number) else text
