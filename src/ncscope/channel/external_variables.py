"""V.E variables at program start: what the list declares and what the user sets.

Source: TF5200 external variables, P-EXTV-00001 to P-EXTV-00008.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping

from ncscope.channel.elements import Elements
from ncscope.channel.state import Stored
from ncscope.channel.user_variables import Unfit, Value, fitted
from ncscope.machine import Machine

External = Mapping[str, Value | tuple[Value, ...]]
"""Values by `V.E.NAME` or `V.E.NAME[2]`; a tuple for an array."""
EXTERNAL_NAME = re.compile(r"V\.E\.([^\s\[\]=]+)(?:\[(\d{1,6})\])?")


def external_variables(machine: Machine, values: External) -> dict[str, Stored]:
    """The V.E variables: declared ones start at 0 or empty.

    A value declares its variable on a machine without a list of external variables.
    Raises KeyError for a variable that the list does not have, and for a value that does not fit.
    """
    variables: dict[str, Stored] = {}
    for name, row in machine.external.items():
        start: Value = "" if row.type == "STRING" else 0.0
        dimensions = (row.elements,) if row.elements else ()
        value = Elements.of((start,) * row.elements) if row.elements else start
        variables[f"V.E.{name}"] = Stored(value, dimensions, row.type, row.length)
    for text, given in values.items():
        match = EXTERNAL_NAME.fullmatch(text)
        if match is None:
            raise KeyError(f"{text} is no external variable: write V.E.NAME or V.E.NAME[2]")
        name, index = f"V.E.{match.group(1)}", match.group(2)
        if name not in variables and machine.external:
            raise KeyError(_not_in_the_list(name, tuple(machine.external)))
        held = variables.get(name) or _declared(name, index, given)
        variables[name] = _with_value(held, name, index, given)
    return variables


def _not_in_the_list(name: str, known: tuple[str, ...]) -> str:
    close = difflib.get_close_matches(name[4:].upper(), [n.upper() for n in known], 1)
    hint = next((f"; V.E.{n} was probably meant" for n in known if n.upper() in close), "")
    return f"{name} is not in the list of external variables{hint}"


def _declared(name: str, index: str | None, value: Value | tuple[Value, ...]) -> Stored:
    """A variable of no list: its first value says what it is."""
    if index is not None:
        raise KeyError(f"{name} has no elements yet: set all of them first, {name}=[1,2]")
    items = value if isinstance(value, tuple) else (value,)
    texts = [isinstance(item, str) for item in items]
    if not items or any(texts) != all(texts):
        raise KeyError(f"{name}: an array has one or more values, all numbers or all texts")
    kind = "STRING" if texts[0] else "REAL64"
    if isinstance(value, tuple):
        return Stored(Elements.of(items), (len(items),), kind)
    return Stored(value, (), kind)


def _with_value(
    held: Stored, name: str, index: str | None, value: Value | tuple[Value, ...]
) -> Stored:
    items = value if isinstance(value, tuple) else (value,)
    try:
        items = tuple(fitted(name, held, item) for item in items)
    except Unfit as problem:
        raise KeyError(problem.message) from None
    if not isinstance(held.value, Elements):
        if index is not None or isinstance(value, tuple):
            raise KeyError(f"{name} is no array")
        return held._replace(value=items[0])
    if index is None and not isinstance(value, tuple):
        raise KeyError(f"{name} is an array: write {name}[0]=.. or {name}=[1,2]")
    if index is not None and isinstance(value, tuple):
        raise KeyError(f"{name}[{index}] is one element and takes one value")
    first, size = int(index or 0), len(held.value)
    if first + len(items) > size:
        raise KeyError(f"{name} has the elements 0 to {size - 1}")
    values = list(held.value)
    values[first : first + len(items)] = items
    return held._replace(value=Elements.of(values))
