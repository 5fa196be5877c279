"""What the measuring variables read (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

from collections.abc import Callable

from ncscope.channel.draft import Draft
from ncscope.channel.rows import Reference


def measured(field: str) -> Callable[[Draft, Reference], float]:
    def read(draft: Draft, ref: Reference) -> float:
        held = draft.state.measured.get(draft.state.axis_names[ref.axis])
        return draft.shown(ref.axis, getattr(held, field)) if held else 0.0

    return read


def was_measured(draft: Draft, ref: Reference) -> float:
    return float(draft.state.axis_names[ref.axis] in draft.state.measured)
