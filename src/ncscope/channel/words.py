"""Axis words: which axis, and its value in the programmed unit."""

from __future__ import annotations

from collections.abc import Iterable

from ncscope.channel.draft import Draft
from ncscope.channel.variables import evaluate_number
from ncscope.diagnostics import Span
from ncscope.language import tree

PRESET_NAMES = ("PSET", "PRESET")


def collect_axes(draft: Draft, axes: dict[int, tuple[float, Span]], word: tree.AxisWord) -> None:
    """Adds the word to `axes`; fails for an unknown axis or a second value of one axis."""
    axis = draft.axis_index(word.name, word.span)
    if axis in axes:
        draft.fail("20203", word.span, f"the block has two values for axis {word.name}")
    axes[axis] = (evaluate_number(draft, word.value), word.span)


def axis_values(draft: Draft, words: Iterable[tree.Word]) -> dict[int, tuple[float, Span]]:
    """The axis words of a # command; any other word fails."""
    axes: dict[int, tuple[float, Span]] = {}
    for word in words:
        if not isinstance(word, tree.AxisWord):
            draft.fail("N1005", word.span, "only axis words can stand here")
        collect_axes(draft, axes, word)
    return axes
