"""A data set of the list as its checks ask for it: numbers, directions, and which line to blame."""

from __future__ import annotations

from typing import Any

from ncscope.diagnostics import Diagnostic, Severity, Span, diagnostic
from ncscope.kinematics.parameters import INDEX_OF_FIELD, MAX_AXES, KinematicParameters
from ncscope.lists.kinematic_sets import KinematicSet


def blame(
    item: KinematicSet, indices: tuple[int, ...]
) -> tuple[Span, tuple[tuple[str, Span], ...]]:
    """The last writer of the first blamed number that a line wrote, and its other writers."""
    for index in indices:
        writers: tuple[Any, ...] = item.parameters.origins.get(index, ())
        if writers:
            notes = tuple(("also written here", span) for span in writers[:-1])
            return writers[-1], notes
    return item.first.entry.key_span, ()


def lint(
    item: KinematicSet, field: str, message: str, hint: str = "", *, note: bool = False
) -> Diagnostic:
    """N3010 at the line that wrote the field; a warning, or a note."""
    span, _ = blame(item, (INDEX_OF_FIELD[field],))
    severity = Severity.NOTE if note else None
    return diagnostic("N3010", span, message, hint, severity=severity)


def axis_count(parameters: KinematicParameters) -> int:
    """The axes that the list means: number_of_axes, or those with a type where it is missing."""
    count = parameters.get("number_of_axes")
    if count.is_integer() and 1 <= count <= MAX_AXES:
        return int(count)
    typed = [a for a in range(MAX_AXES) if parameters.get(f"axis[{a}].type")]
    return typed[-1] + 1 if typed else 0


def direction_of(parameters: KinematicParameters, axis: int) -> list[float]:
    """Direction (3,) of an axis as the list writes it, not normalised."""
    return [parameters.get(f"axis[{axis}].orientation[{k}]") for k in range(3)]
