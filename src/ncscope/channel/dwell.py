"""G04 and G98, G99: axis words that are a time or a limit, and no position.

Source: TF5200 programming manual, dwell time, software limit switches.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def dwell(draft: Draft, words: Words) -> None:
    """G04 3.5, G04 P1, G04 X3.5: seconds; G04 S10: turns of the spindle. Nothing moves."""
    if 4 not in words.gfunctions:
        return
    span = words.gfunctions[4].span
    direct = words.values.get(4)
    first = {0, draft.state.main_axes[0]}
    given = [axis for axis in words.axes if axis in first]
    if direct is not None and words.axes:
        place = next(iter(words.axes.values()))[1]
        draft.fail("20013", place, "the time of G04 is given directly and by an axis")
    if words.axes and not given:
        name, place = draft.state.axis_names[0], next(iter(words.axes.values()))[1]
        hint = f"write for example G04 {name}2"
        draft.fail("20014", place, "the time of G04 is given by the first main axis", hint)
    for axis, (_, place) in words.axes.items():
        if axis != given[0]:
            draft.warn("20685", place, "only the first main axis gives the time of G04")
    if direct is None and not words.axes and not {"S", "F"} & set(words.addresses):
        draft.fail("N2035", span, "G04 needs its time in seconds", "write for example G04 2.5")
    seconds = direct if direct is not None else 0.0
    if given:
        seconds = words.axes[given[0]][0]
    if seconds < 0.0:
        draft.fail("20752", span, f"the time of G04 cannot be {seconds:g} seconds")
    words.addresses.pop("F", None)
    words.axes.clear()


def software_limits(draft: Draft, words: Words) -> None:
    """G98 X-100, G99 X250: the negative and positive software limit of axes; nothing moves."""
    number = next((n for n in (98, 99) if n in words.gfunctions), None)
    if number is None:
        return
    span = words.gfunctions[number].span
    if not words.axes:
        draft.warn("20003", span, f"G{number} needs an axis with its limit; it does nothing")
    axes = list(draft.state.axes)
    for axis, (value, _) in words.axes.items():
        low, high = axes[axis].limits or (-math.inf, math.inf)
        limit = draft.length(axis, value)
        limits = (limit, high) if number == 98 else (low, limit)
        axes[axis] = replace(axes[axis], limits=limits)
    if words.axes:
        draft.state = draft.state.changed(axes=tuple(axes))
    words.axes.clear()
