"""The user's own variables: P parameters, V.P, V.S and V.L, and their declaration.

Source: TF5200 programming manual Array indices count from 0; a P number counts from 1.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.state import Stored
from ncscope.diagnostics import Span
from ncscope.language import tree

Value = float | str
Node = tree.Variable | tree.Parameter
MAX_ELEMENTS = 1_000_000
"""Largest array; a declaration beyond it is a mistake, not a need."""


def is_user(node: tree.Variable | tree.Parameter | tree.CycleParameter) -> bool:
    """Whether the variable is one that programs create themselves."""
    if isinstance(node, tree.Parameter):
        return True
    return (
        isinstance(node, tree.Variable)
        and len(node.parts) >= 3
        and node.parts[0].name.upper() == "V"
        and node.parts[1].name.upper() in ("P", "S", "L")
    )


def read(draft: Draft, node: Node, numbers: tuple[int, ...]) -> Value:
    """The value of a variable; `numbers` are its evaluated indices (a P number first)."""
    key, indices = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        if isinstance(node, tree.Parameter):
            draft.fail("20925", node.span, f"{key} has no value yet", f"write {key} = .. first")
        draft.fail("20932", node.span, f"the variable {key} does not exist")
    if isinstance(stored.value, tuple):
        return stored.value[_element(draft, key, stored, indices, node.span)]
    _refuse_indices(draft, key, indices, node.span)
    return stored.value


def write(draft: Draft, node: Node, numbers: tuple[int, ...], value: Value) -> None:
    """Assigns; a P parameter, V.P and V.S come into being by their first assignment."""
    key, indices = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        if indices:
            id = "20921" if isinstance(node, tree.Parameter) else "20972"
            draft.fail(id, node.span, f"the array {key} is not declared", "declare it in #VAR")
        if key.upper().startswith("V.L."):
            draft.fail("20932", node.span, f"{key} is not declared", "declare it in #VAR")
        return _store(draft, key, Stored(value))
    if isinstance(stored.value, tuple):
        element = _element(draft, key, stored, indices, node.span)
        items = list(stored.value)
        items[element] = value
        return _store(draft, key, replace(stored, value=tuple(items)))
    _refuse_indices(draft, key, indices, node.span)
    return _store(draft, key, replace(stored, value=value))


def declare(
    draft: Draft, item: tree.Declaration, numbers: tuple[int, ...], values: tuple[Value, ...]
) -> None:
    """One line between #VAR and #ENDVAR; `values` are its evaluated initial values."""
    key, dimensions = _resolve(draft, item.target, numbers)
    if key in draft.state.variables and not isinstance(item.target, tree.Parameter):
        draft.fail("20909", item.span, f"{key} already exists")
    if any(d <= 0 for d in dimensions) or math.prod(dimensions) > MAX_ELEMENTS:
        draft.fail("20906", item.span, f"the dimensions of {key} are not allowed")
    count = math.prod(dimensions)
    if len(values) > count:
        draft.fail("20912", item.span, f"{key} has {count} elements but {len(values)} values")
    start: Value = "" if (item.type or "").upper() == "STRING" else 0.0
    filled = (*values, *([start] * (count - len(values))))
    kind = (item.type or "REAL64").upper()
    stored = Stored(filled if dimensions else filled[0], dimensions, kind)
    _store(draft, key, stored)


def delete(draft: Draft, node: Node, numbers: tuple[int, ...]) -> None:
    """#DELETE of one variable."""
    key, _ = _resolve(draft, node, numbers)
    if key not in draft.state.variables:
        draft.fail("20932", node.span, f"the variable {key} does not exist")
    kept = {k: v for k, v in draft.state.variables.items() if k != key}
    draft.state = replace(draft.state, variables=kept)


def size(
    draft: Draft,
    node: tree.Variable | tree.Parameter | tree.CycleParameter,
    numbers: tuple[int, ...],
    dimension: int,
) -> int:
    """SIZEOF: the length of one dimension of an array, 1 for a single value."""
    if isinstance(node, tree.CycleParameter) or not is_user(node):
        draft.fail("20392", node.span, "SIZEOF needs a variable of the program")
    key, _ = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        draft.fail("20932", node.span, f"the variable {key} does not exist")
    if not stored.dimensions:
        return 1
    if not 0 <= dimension < len(stored.dimensions):
        draft.fail("20906", node.span, f"{key} has {len(stored.dimensions)} dimensions")
    return stored.dimensions[dimension]


def _store(draft: Draft, key: str, stored: Stored) -> None:
    variables = {**draft.state.variables, key: stored}
    draft.state = replace(draft.state, variables=variables)


def _resolve(draft: Draft, node: Node, numbers: tuple[int, ...]) -> tuple[str, tuple[int, ...]]:
    """The name under which a variable is stored, and the indices of the element."""
    if isinstance(node, tree.Parameter):
        if numbers[0] <= 0:
            draft.fail("20400", node.span, f"P{numbers[0]} does not exist; P numbers start at 1")
        return f"P{numbers[0]}", numbers[1:]
    group = node.parts[1].name.upper()
    name = ".".join(part.name for part in node.parts[2:])
    return f"V.{group}.{name}", numbers


def _element(draft: Draft, key: str, stored: Stored, indices: tuple[int, ...], span: Span) -> int:
    if len(indices) < len(stored.dimensions):
        draft.fail("21216", span, f"{key} needs {len(stored.dimensions)} indices")
    if len(indices) > len(stored.dimensions):
        draft.fail("20924", span, f"{key} has only {len(stored.dimensions)} dimensions")
    element = 0
    for index, length in zip(indices, stored.dimensions, strict=True):
        if not 0 <= index < length:
            draft.fail(
                "20906", span, f"index {index} of {key} is out of range", f"0 to {length - 1}"
            )
        element = element * length + index
    return element


def _refuse_indices(draft: Draft, key: str, indices: tuple[int, ...], span: Span) -> None:
    if indices:
        draft.fail("20924", span, f"{key} is not an array")
