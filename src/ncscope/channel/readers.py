"""What the variables of measuring, manual mode, conversion and selected systems read (TF5200)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.rows import Reference


def measured(field: str) -> Callable[[Draft, Reference], float]:
    """A value of the last measuring run in units of the program; 0 before the first."""

    def read(draft: Draft, ref: Reference) -> float:
        held = draft.state.measured.get(draft.state.axis_names[ref.axis])
        return draft.shown(ref.axis, getattr(held, field)) if held else 0.0

    return read


def was_measured(draft: Draft, ref: Reference) -> float:
    """1 when the axis was measured, else 0."""
    return float(draft.state.axis_names[ref.axis] in draft.state.measured)


def converted(variable: str, command: str) -> Callable[[Draft, Reference], float]:
    """The result of the last conversion by this command; there is none before it."""

    def read(draft: Draft, ref: Reference) -> float:
        key = (variable, draft.state.axis_names[ref.axis])
        if key not in draft.state.converted:
            draft.fail("20097", ref.span, f"{ref.text} has no value before {command}")
        return draft.shown(ref.axis, draft.state.converted[key])

    return read


def selected_origin(axis: int) -> Callable[[Draft, Reference], float]:
    """Where the zero of the innermost system lies in the machine system; 0 without a system."""

    def read(draft: Draft, ref: Reference) -> float:
        chain = draft.state.coordinates
        place = len(chain.levels) - 1
        if place == 0:
            return 0.0
        below = np.zeros(chain.axis_count)
        below[:3] = chain.top.frame.shift
        origin = chain.at_level(place - 1).to_mcs(below)
        return float(origin[axis]) / draft.modes.length_factor

    return read


def manual_offset(draft: Draft, ref: Reference) -> float:
    """What #GET MANUAL OFFSETS fetched last."""
    name = draft.state.axis_names[ref.axis]
    return draft.shown(ref.axis, draft.state.manual_offsets.get(name, 0.0))
