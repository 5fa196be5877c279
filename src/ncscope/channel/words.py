"""Axis words: which axis, and its value in the programmed unit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.diagnostics import Span
from ncscope.language import tree

PRESET_NAMES = ("PSET", "PRESET")


@dataclass(slots=True)
class Words:
    """The words of one block, each evaluated, waiting for the rule that takes it.

    macro_uses: macros that were replaced by their text.
    signed: of a modulo axis, the sign behind its letter and the value without it.
    """

    gfunctions: dict[int, tree.GWord] = field(default_factory=dict)
    values: dict[int, float] = field(default_factory=dict)
    axes: dict[int, tuple[float, Span]] = field(default_factory=dict)
    signed: dict[int, tuple[str, float]] = field(default_factory=dict)
    addresses: dict[str, tuple[float, Span]] = field(default_factory=dict)
    mfunctions: dict[int, Span] = field(default_factory=dict)
    tool_writes: dict[str, Span] = field(default_factory=dict)
    macro_uses: int = 0


def cycle_letter(draft: Draft, word: tree.AddressWord) -> str:
    """The letter of an address word: in a cycle @I @J @K are the centre words of the plane."""
    if not word.letter.startswith("@"):
        return word.letter
    draft.cycle_parameters(word.span, "21385" if word.letter == "@S" else "21384")
    if word.letter == "@S":
        return "S"
    return "IJK"[draft.state.main_axes["IJK".index(word.letter[1])]]


def collect_axes(draft: Draft, axes: dict[int, tuple[float, Span]], word: tree.AxisWord) -> int:
    """Adds the word to `axes` and returns its axis; fails for an unknown axis or a second value."""
    axis = draft.axis_index(word.name, word.span)
    if axis in axes:
        draft.fail("20203", word.span, f"the block has two values for axis {word.name}")
    axes[axis] = (evaluate_number(draft, word.value), word.span)
    return axis


def axis_values(
    draft: Draft, words: Iterable[tree.Word], name: str = ""
) -> dict[int, tuple[float, Span]]:
    """The axis words of the # command `name`; any other word fails."""
    axes: dict[int, tuple[float, Span]] = {}
    words = tuple(words)
    refuse_path_condition(draft, name, words)
    for word in words:
        if not isinstance(word, tree.AxisWord):
            draft.fail("N1005", word.span, "only axis words can stand here")
        collect_axes(draft, axes, word)
    return axes


def refuse_path_condition(draft: Draft, name: str, words: Iterable[tree.Word]) -> None:
    """#PSET and #PRESET cannot stand in a block with G functions."""
    for word in words:
        if isinstance(word, tree.GWord) and name in PRESET_NAMES:
            draft.fail(
                "20607",
                word.span,
                f"#{name} cannot stand in a block with G functions",
                "write it in a block of its own",
            )
