"""Expressions and assignments of a block: the variables that they name are found here.

The table of the control's variables is in `variables`, the program's own are in
`user_variables`.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ncscope.channel import offsets, user_variables
from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.variables import (
    VARIABLES,
    Reference,
    Row,
    active_zero,
    group_index,
    store_group,
)
from ncscope.language import tree
from ncscope.language.expressions import evaluate, indices_of
from ncscope.language.failures import EvaluationError
from ncscope.language.vocabulary import word_entry
from ncscope.machine import OffsetRecord

Value = float | str
Node = tree.Variable | tree.Parameter | tree.CycleParameter


class Environment:
    """What an expression sees: the draft of the running block."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft

    def read(self, node: Node, indices: tuple[int, ...]) -> Value:
        return _read(self.draft, node, indices)

    def exists(self, node: Node, indices: tuple[int, ...]) -> bool:
        try:
            if not isinstance(node, tree.CycleParameter) and user_variables.is_user(node):
                return user_variables.exists(self.draft, node, indices)
            _read(self.draft, node, indices)
        except BlockError:
            return False
        return True

    def size(self, node: Node, indices: tuple[int, ...], dimension: int) -> int:
        return user_variables.size(self.draft, node, indices, dimension)

    def macro(self, name: str) -> str | None:
        return self.draft.state.macros.get(name)


def indices(draft: Draft, node: Node) -> tuple[int, ...]:
    """The evaluated indices of a variable, in the order in which they are written."""
    try:
        return indices_of(node, Environment(draft))
    except EvaluationError as error:
        raise BlockError(error.diagnostic) from error


def evaluate_value(draft: Draft, expression: tree.Expression) -> Value:
    """The value of an expression; fails the block where it has none."""
    if isinstance(expression, tree.Number):
        return expression.value
    try:
        return evaluate(expression, Environment(draft))
    except EvaluationError as error:
        raise BlockError(error.diagnostic) from error


def evaluate_number(draft: Draft, expression: tree.Expression) -> float:
    """The finite number of an expression; 20392 for a text, 21883 beyond the range."""
    value: Value
    if isinstance(expression, tree.Number):
        value = expression.value
    else:
        value = evaluate_value(draft, expression)
    if isinstance(value, str):
        draft.fail("20392", expression.span, "a number is needed here, not a text")
    if not math.isfinite(value):
        draft.fail("21883", expression.span, "the value is too large")
    return value


# --- access ------------------------------------------------------------------------------------


def _read(draft: Draft, node: Node, numbers: tuple[int, ...]) -> Value:
    if isinstance(node, tree.CycleParameter):
        return _cycle_parameter(draft, node, numbers[0])
    if user_variables.is_user(node):
        return user_variables.read(draft, node, numbers)
    assert isinstance(node, tree.Variable)
    row, reference = _find(draft, node, numbers)
    return row.read(draft, reference)


def _cycle_parameter(draft: Draft, node: tree.CycleParameter, number: int) -> Value:
    held = draft.cycle_parameters(node.span)
    if number not in held:
        hint = f"V.G.@P[{number}].VALID tells whether the call gave it"
        draft.fail("20925", node.span, f"@P{number} was not given in the call of the cycle", hint)
    return held[number]


def write_variable(draft: Draft, word: tree.Assignment) -> None:
    """`target = value`, `+=` and the rest; the change counts for the words that follow."""
    node = word.target
    if isinstance(node, tree.Variable) and _is_record(node):
        return _write_record(draft, node, word)
    numbers = indices(draft, node)
    value = evaluate_value(draft, _source(draft, node, numbers, word.value))
    if word.operator != "=":
        value = _combined(draft, word, _read(draft, node, numbers), value)
    if isinstance(node, tree.CycleParameter):
        held = {**draft.cycle_parameters(node.span), numbers[0]: value}
        running = replace(draft.state.running, parameters=held)
        draft.state = draft.state.changed(running=running)
        return None
    if user_variables.is_user(node):
        return user_variables.write(draft, node, numbers, value)
    assert isinstance(node, tree.Variable)
    row, reference = _find(draft, node, numbers)
    if row.write is None:
        draft.fail("20100", node.span, f"{reference.text} can only be read")
    if isinstance(value, str):
        draft.fail("20392", word.value.span, "a number is needed here, not a text")
    row.write(draft, reference, value)
    return None


def _source(
    draft: Draft, node: Node, numbers: tuple[int, ...], value: tree.Expression
) -> tree.Expression:
    """What is assigned: a string alone is a text, or the macro of this name for a number."""
    if not isinstance(value, tree.Text) or value.value not in draft.state.macros:
        return value
    if isinstance(node, tree.CycleParameter):
        return value
    if user_variables.is_user(node) and not user_variables.holds_number(draft, node, numbers):
        return value
    return tree.Macro(value.value, value.span)


def _combined(draft: Draft, word: tree.Assignment, old: Value, value: Value) -> Value:
    if isinstance(old, str) and isinstance(value, str) and word.operator == "+=":
        return old + value
    if isinstance(old, str) or isinstance(value, str):
        draft.fail("20392", word.value.span, "a text and a number cannot be combined")
    if word.operator == "/=":
        if abs(value) < 1e-15:
            draft.fail("20574", word.value.span, "division by zero")
        return old / value
    return {"+=": old + value, "-=": old - value, "*=": old * value}[word.operator]


def _find(draft: Draft, node: tree.Variable, numbers: tuple[int, ...]) -> tuple[Row, Reference]:
    """The table row of a variable. Axis variables may end in an axis name or an index."""
    names = [part.name.upper() + "[]" * len(part.indices) for part in node.parts]
    key = ".".join(names)
    reference = Reference(node.span.text.strip(), numbers, node.span)
    if key.startswith("V.G.KIN[].") and len(numbers) >= 1:
        return VARIABLES["V.G.KIN[].<field>"], reference._replace(field=_field(node, numbers))
    if key in VARIABLES:
        return _by_index(draft, key, reference)
    pattern = ".".join(names[:-1]) + ".<axis>"
    if pattern in VARIABLES and not node.parts[-1].indices:
        axis = draft.axis_index(node.parts[-1].name, node.span, "20092")
        return VARIABLES[pattern], reference._replace(axis=axis)
    group = word_entry(".".join(names[:2]).partition("[")[0] + ".")
    if group is not None and group.kind == "refused":
        draft.fail("N2001", node.span, f"{reference.text} is not supported ({group.purpose})")
    other = f"V.G.{key[2:]}"
    known = other in VARIABLES or other.startswith("V.G.KIN[].")
    hint = f"V.G.{reference.text[2:]} was probably meant" if known else ""
    draft.fail("20196", node.span, f"the variable {reference.text} is unknown", hint)


def _by_index(draft: Draft, key: str, reference: Reference) -> tuple[Row, Reference]:
    """A pattern that ends in `[]` next to one that ends in `.<axis>` counts channel axes."""
    if key.endswith("[]") and key[:-2] + ".<axis>" in VARIABLES:
        axis = reference.numbers[-1]
        if not 0 <= axis < len(draft.state.axes):
            draft.fail("20092", reference.span, f"the channel has no axis with index {axis}")
        return VARIABLES[key], reference._replace(axis=axis)
    return VARIABLES[key], reference


def _field(node: tree.Variable, numbers: tuple[int, ...]) -> str:
    rest, used = [], len(node.parts[2].indices)
    for part in node.parts[3:]:
        indices = numbers[used : used + len(part.indices)]
        used += len(part.indices)
        rest.append(part.name.lower() + "".join(f"[{i}]" for i in indices))
    return ".".join(rest)


# --- whole records -----------------------------------------------------------------------------


def _is_record(node: tree.Variable) -> bool:
    """`V.G.NP[i].ALL`, `V.G.NP_AKT.ALL`: all axes of a record at once."""
    names = [part.name.upper() for part in node.parts]
    return names[:2] == ["V", "G"] and names[-1] == "ALL"


def _record_values(draft: Draft, expression: tree.Expression) -> list[float]:
    """The sum of records; single-axis items and constants may not be mixed in."""
    if isinstance(expression, tree.Binary) and expression.operator in "+-":
        left = _record_values(draft, expression.left)
        right = _record_values(draft, expression.right)
        sign = 1.0 if expression.operator == "+" else -1.0
        return [a + sign * b for a, b in zip(left, right, strict=True)]
    if not isinstance(expression, tree.Variable) or not _is_record(expression):
        draft.fail(
            "20392",
            expression.span,
            "a record can only be combined with records (.ALL)",
            "write single axes as V.G.NP[..].V.X",
        )
    if expression.parts[2].name.upper() == "NP_AKT":
        return list(active_zero(draft).values)
    index = round(evaluate_number(draft, expression.parts[2].indices[0]))
    record = draft.state.zero_offsets.groups.get(index, OffsetRecord())
    return [record.values.get(i, 0.0) for i in range(len(draft.state.axes))]


def _write_record(draft: Draft, node: tree.Variable, word: tree.Assignment) -> None:
    values = _record_values(draft, word.value)
    if word.operator in ("+=", "-="):
        sign = 1.0 if word.operator == "+=" else -1.0
        values = [o + sign * v for o, v in zip(_record_values(draft, node), values, strict=True)]
    elif word.operator != "=":
        draft.fail("20573", word.span, "records know =, += and -= only")
    indexed = dict(enumerate(values))
    if node.parts[2].name.upper() == "NP_AKT":
        name = active_zero(draft).name
        draft.state = offsets.set_offsets(draft.state, "zero", name, indexed, draft.place)
        return
    ref = Reference(
        node.span.text, (round(evaluate_number(draft, node.parts[2].indices[0])),), node.span
    )
    index = group_index(draft, ref)
    record = draft.state.zero_offsets.groups.get(index, OffsetRecord())
    origins = dict.fromkeys(indexed, draft.place)
    store_group(draft, index, replace(record, values=indexed, origins=origins))
