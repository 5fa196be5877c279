"""What a row of the table of NC variables is: how a variable of the control is read and written."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span

Value = float | str


class Reference(NamedTuple):
    """A variable with its indices evaluated: what a table row reads or writes.

    numbers: all indices from left to right. axis: channel index where the variable names one.
    field: the rest of the name after `V.G.KIN[i].`, as a parameter field.
    """

    text: str
    numbers: tuple[int, ...]
    span: Span
    axis: int = 0
    field: str = ""


class Row(NamedTuple):
    """One table row; `write` is None for a variable that a program may only read."""

    read: Callable[[Draft, Reference], Value]
    write: Callable[[Draft, Reference, float], None] | None
    meaning: str


def refuse_while_active(draft: Draft, ref: Reference) -> None:
    """Fails for a write that is not allowed while a transformation is active."""
    if draft.state.kinematics.is_on:
        draft.fail(
            "21022",
            ref.span,
            f"{ref.text} cannot be written while a transformation is active",
            "switch it off first (#TRAFO OFF)",
        )


def length(value: Callable[[Draft], float]) -> Callable[[Draft, Reference], float]:
    """Reads a length in mm as the programmed unit."""
    return lambda draft, ref: value(draft) / draft.modes.length_factor


def plain(value: Callable[[Draft], float]) -> Callable[[Draft, Reference], float]:
    """Reads a value that has no unit of length."""
    return lambda draft, ref: value(draft)


def axis_rows(prefix: str, row: Row) -> dict[str, Row]:
    """An axis variable is written with an axis name or with a channel index."""
    return {f"{prefix}.<axis>": row, f"{prefix}[]": row}
