"""The user's own variables: P parameters, V.P, V.S, V.L, V.CYC and V.E, and their declaration.

Array indices count from 0; a P number counts from 1. V.L and V.CYC belong to the program level that
declares them and are seen below it; a level may hide one of the same name.
Source: TF5200 programming manual, variables; TF5200 external variables (P-EXTV).
"""

from __future__ import annotations

import math

from ncscope.channel.draft import Draft
from ncscope.channel.elements import Elements
from ncscope.channel.layered import with_value, without
from ncscope.channel.state import Stored
from ncscope.diagnostics import Span
from ncscope.language import tree
from ncscope.language.functions import rounded

Value = float | str
Node = tree.Variable | tree.Parameter
GROUPS = ("P", "S", "L", "CYC", "E")
DECLARED_GROUPS = ("V.L.", "V.CYC.", "V.E.")
"""Variables that no assignment brings into being."""
MAX_ELEMENTS = 1_000_000
"""Largest array; a declaration beyond it is a mistake, not a need."""
MAX_DIMENSIONS = 4
LONGEST_STRING = 126
INTEGER_RANGES = {
    "SGN08": (-128, 127),
    "UNS08": (0, 255),
    "SGN16": (-32768, 32767),
    "UNS16": (0, 65535),
    "SGN32": (-(2**31), 2**31 - 1),
    "UNS32": (0, 2**32 - 1),
}


def is_user(node: tree.Variable | tree.Parameter | tree.CycleParameter) -> bool:
    """Whether the variable is one that programs create themselves."""
    if isinstance(node, tree.Parameter):
        return True
    return (
        isinstance(node, tree.Variable)
        and len(node.parts) >= 3
        and node.parts[0].name.upper() == "V"
        and node.parts[1].name.upper() in GROUPS
    )


def read(draft: Draft, node: Node, numbers: tuple[int, ...]) -> Value:
    """The value of a variable; `numbers` are its evaluated indices (a P number first)."""
    key, indices = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        if isinstance(node, tree.Parameter):
            draft.fail("20925", node.span, f"{key} has no value yet", f"write {key} = .. first")
        draft.fail("20932", node.span, f"the variable {key} does not exist", _missing(key))
    if key.startswith("V.E."):
        _check_access(draft, key, "READ", node.span)
    if isinstance(stored.value, Elements):
        return stored.value[_element(draft, key, stored, indices, node.span, reading=True)]
    _refuse_indices(draft, key, indices, node.span, reading=True)
    return stored.value


def write(draft: Draft, node: Node, numbers: tuple[int, ...], value: Value) -> None:
    """Assigns; a P parameter, V.P and V.S come into being by their first assignment."""
    key, indices = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        if indices:
            id = "20921" if isinstance(node, tree.Parameter) else "20972"
            draft.fail(id, node.span, f"the array {key} is not declared", "declare it in #VAR")
        if key.startswith(DECLARED_GROUPS):
            draft.fail("20932", node.span, f"{key} is not declared", _missing(key))
        return _store(
            draft, key, Stored(value, type="STRING" if isinstance(value, str) else "REAL64")
        )
    if key.startswith("V.E."):
        _check_access(draft, key, "WRITE", node.span)
    value = _fitting(draft, key, stored, value, node.span)
    if isinstance(stored.value, Elements):
        element = _element(draft, key, stored, indices, node.span)
        elements = stored.value.with_element(element, value)
        return _store(draft, key, stored._replace(value=elements))
    _refuse_indices(draft, key, indices, node.span)
    return _store(draft, key, stored._replace(value=value))


def _missing(key: str) -> str:
    if key.startswith("V.E."):
        return f"declare it in the list of external variables, or give --set {key}=.."
    return "declare it in #VAR" if key.startswith(DECLARED_GROUPS) else "assign a value to it first"


def _check_access(draft: Draft, key: str, right: str, span: Span) -> None:
    """READ or WRITE against the access rights of the list (P-EXTV-00006)."""
    declared = draft.machine.external.get(key.removeprefix("V.E."))
    if declared is not None and right not in declared.access:
        what = "read" if right == "READ" else "written"
        id = "20097" if right == "READ" else "20100"
        draft.fail(id, span, f"{key} cannot be {what}: its access right is {declared.access}")


class Unfit(Exception):
    """A value that its variable cannot hold: number, message and hint of the diagnostic."""

    def __init__(self, id: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.id, self.message, self.hint = id, message, hint


def fitted(key: str, stored: Stored, value: Value) -> Value:
    """The value as the type of the variable holds it; a fraction is rounded for a whole number.

    Raises Unfit.
    """
    if isinstance(value, str) != (stored.type == "STRING"):
        what = f"the text {value!r}" if isinstance(value, str) else "a number"
        raise Unfit("20392", f"{key} is of type {stored.type} and cannot hold {what}")
    if isinstance(value, str):
        if stored.length and len(value) > stored.length:
            what = f"{key} holds {stored.length} characters, the text has {len(value)}"
            raise Unfit("21462", what, "declare it with a larger STRING[..]")
        return value
    if stored.type == "BOOLEAN":
        return float(abs(value) >= 0.5)
    limits = INTEGER_RANGES.get(stored.type)
    if limits is None:
        return value
    whole = rounded(value)
    if not limits[0] <= whole <= limits[1]:
        what = f"{whole} is outside of {limits[0]} to {limits[1]}"
        raise Unfit("20847", f"{key} is of type {stored.type}: {what}")
    return float(whole)


def _fitting(draft: Draft, key: str, stored: Stored, value: Value, span: Span) -> Value:
    try:
        return fitted(key, stored, value)
    except Unfit as problem:
        draft.fail(problem.id, span, problem.message, problem.hint)


def declare(
    draft: Draft,
    item: tree.Declaration,
    numbers: tuple[int, ...],
    values: tuple[Value, ...],
    length: int = LONGEST_STRING,
) -> None:
    """One line between #VAR and #ENDVAR; `values` are its evaluated initial values.

    length: characters that a STRING holds.
    """
    key, dimensions = _resolve(draft, item.target, numbers)
    old = draft.state.variables.get(key)
    level = draft.state.running.level if key.startswith(("V.L.", "V.CYC.")) else 0
    if old is not None and old.level == level and not isinstance(item.target, tree.Parameter):
        draft.fail("20909", item.span, f"{key} already exists")
    if len(dimensions) > MAX_DIMENSIONS:
        draft.fail("20974", item.span, f"an array has at most {MAX_DIMENSIONS} dimensions")
    if any(d <= 0 for d in dimensions) or math.prod(dimensions) > MAX_ELEMENTS:
        draft.fail("20906", item.span, f"the dimensions of {key} are not allowed")
    count = math.prod(dimensions)
    if len(values) > count:
        draft.fail("20912", item.span, f"{key} has {count} elements but {len(values)} values")
    kind = (item.type or "REAL64").upper()
    kind = "REAL64" if kind == "REAL" else kind
    start: Value = "" if kind == "STRING" else 0.0
    empty = Stored(start, dimensions, kind, length, level, old if level else None)
    fitted = [_fitting(draft, key, empty, value, item.span) for value in values]
    filled = (*fitted, *([start] * (count - len(fitted))))
    _store(draft, key, empty._replace(value=Elements.of(filled) if dimensions else filled[0]))


def delete(draft: Draft, node: Node, numbers: tuple[int, ...]) -> None:
    """#DELETE of one variable."""
    key, _ = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        draft.fail("20932", node.span, f"the variable {key} does not exist")
    if key.startswith("V.E."):
        draft.fail("20908", node.span, "an external variable cannot be deleted")
    kept = without(draft.state.variables, key)
    if stored.outer is not None:
        kept = with_value(kept, key, stored.outer)
    draft.state = draft.state.changed(variables=kept)


def size(
    draft: Draft,
    node: tree.Variable | tree.Parameter | tree.CycleParameter,
    numbers: tuple[int, ...],
    dimension: int,
) -> int:
    """SIZEOF: the length of one dimension of an array, 1 for a single value.

    Dimensions count from 1.
    """
    if isinstance(node, tree.CycleParameter) or not is_user(node):
        draft.fail("20392", node.span, "SIZEOF needs a variable of the program")
    key, _ = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None:
        draft.fail("20932", node.span, f"the variable {key} does not exist", _missing(key))
    sizes = stored.dimensions or (1,)
    if not 1 <= dimension <= len(sizes):
        hint = "dimensions count from 1"
        draft.fail("20918", node.span, f"{key} has no dimension {dimension}", hint)
    return sizes[dimension - 1]


def _store(draft: Draft, key: str, stored: Stored) -> None:
    variables = with_value(draft.state.variables, key, stored)
    draft.state = draft.state.changed(variables=variables)


def _resolve(draft: Draft, node: Node, numbers: tuple[int, ...]) -> tuple[str, tuple[int, ...]]:
    """The name under which a variable is stored, and the indices of the element."""
    if isinstance(node, tree.Parameter):
        if numbers[0] <= 0:
            draft.fail("20400", node.span, f"P{numbers[0]} does not exist; P numbers start at 1")
        return f"P{numbers[0]}", numbers[1:]
    group = node.parts[1].name.upper()
    name = ".".join(part.name for part in node.parts[2:])
    return f"V.{group}.{name}", numbers


def _element(
    draft: Draft,
    key: str,
    stored: Stored,
    indices: tuple[int, ...],
    span: Span,
    reading: bool = False,
) -> int:
    if len(indices) < len(stored.dimensions):
        id = "20925" if key.startswith("P") else "21216"
        draft.fail(id, span, f"{key} needs {_indices(len(stored.dimensions))}", _size(stored))
    if len(indices) > len(stored.dimensions):
        id = "20925" if key.startswith("P") and reading else "20924"
        draft.fail(id, span, f"{key} has only {_indices(len(stored.dimensions))}", _size(stored))
    element = 0
    for index, length in zip(indices, stored.dimensions, strict=True):
        if not 0 <= index < length:
            draft.fail(
                "20906", span, f"index {index} of {key} is out of range", f"0 to {length - 1}"
            )
        element = element * length + index
    return element


def _indices(count: int) -> str:
    return "1 index" if count == 1 else f"{count} indices"


def _size(stored: Stored) -> str:
    sizes = "".join(f"[{n}]" for n in stored.dimensions)
    return f"it is declared with {sizes}, and indices count from 0"


def _refuse_indices(
    draft: Draft, key: str, indices: tuple[int, ...], span: Span, reading: bool = False
) -> None:
    if indices:
        id = "20925" if key.startswith("P") and reading else "20924"
        draft.fail(id, span, f"{key} is not an array")


def holds_number(draft: Draft, node: Node, numbers: tuple[int, ...]) -> bool:
    """Whether the variable is of a type for numbers; P is, where it has not been declared."""
    stored = draft.state.variables.get(_resolve(draft, node, numbers)[0])
    return isinstance(node, tree.Parameter) if stored is None else stored.type != "STRING"


def exists(draft: Draft, node: Node, numbers: tuple[int, ...]) -> bool:
    """EXIST: whether there is such a variable or element, whoever may read it."""
    key, indices = _resolve(draft, node, numbers)
    stored = draft.state.variables.get(key)
    if stored is None or not indices:
        return stored is not None
    inside = (0 <= i < n for i, n in zip(indices, stored.dimensions, strict=False))
    return len(indices) == len(stored.dimensions) and all(inside)
