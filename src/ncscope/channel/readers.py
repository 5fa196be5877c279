"""What V.G.WZ[j] and the measuring variables read (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.machine import Tool

if TYPE_CHECKING:
    from ncscope.channel.variables import Reference


def record(draft: Draft, ref: Reference) -> Tool:
    """The record of the lists that `V.G.WZ[j]` reads."""
    index = ref.numbers[0]
    if index not in draft.machine.tools:
        draft.fail("20172", ref.span, f"tool data D{index} does not exist")
    return draft.machine.tools[index]


def record_axis(draft: Draft, ref: Reference) -> float:
    return draft.shown(ref.axis, record(draft, ref).axis_offsets.get(ref.axis, 0.0))


def measured(field: str) -> Callable[[Draft, Reference], float]:
    def read(draft: Draft, ref: Reference) -> float:
        held = draft.state.measured.get(draft.state.axis_names[ref.axis])
        return draft.shown(ref.axis, getattr(held, field)) if held else 0.0

    return read


def was_measured(draft: Draft, ref: Reference) -> float:
    return float(draft.state.axis_names[ref.axis] in draft.state.measured)
