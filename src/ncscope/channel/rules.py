"""The rules of a block: each takes the words it owns and leaves the rest, in one fixed order.

Enters: a draft and the evaluated words of the block. Leaves: the changed draft.
Source: TF5200 programming manual, order of effects and G functions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

from ncscope.channel import (
    calls,
    circle,
    contour,
    corner,
    diameter,
    dwell,
    manual,
    measuring,
    offsets,
    radius_compensation,
    tools,
    travel,
)
from ncscope.channel.commands import spline
from ncscope.channel.draft import Draft
from ncscope.channel.gfunctions import GFUNCTIONS, WEIGHTED, GFunction
from ncscope.channel.words import Words
from ncscope.diagnostics import Span
from ncscope.language import tree
from ncscope.machine import ZERO_GROUPS

KNOWN_M = frozenset((0, 1, 2, 3, 4, 5, 17, 19, 29, 30, *range(40, 46)))
"""Stops, program end, return and spindle: without effect on positions beyond any doubt."""

CONTOURING = frozenset((61, 261))
"""G functions that round corners, so that the path misses the ends of blocks a little."""


def _refuse_g(draft: Draft, words: Words) -> None:
    for number, word in words.gfunctions.items():
        row: GFunction = GFUNCTIONS[number]
        if row.effect == "refused":
            draft.refuse(word.span, f"G{number:02d} ({row.purpose})")
        if row.effect == "quiet":
            what = "has no effect on positions"
            if number in CONTOURING:
                what = "rounds corners between the ends of blocks; the path is shown without it"
            draft.warn("N2002", word.span, f"G{number:02d} {what}")
        if number == 151:
            spline.begin(draft, word.span, "G151")
    weighted = [n for n in words.gfunctions if n in WEIGHTED]
    if weighted:
        words.axes.clear()  # weights of G130.., not positions


def _modal(draft: Draft, words: Words) -> None:
    for number in words.gfunctions:
        if number in (0, 1, 2, 3, 33, 63, 331, 332):
            draft.modal(motion=f"G{number:02d}")
        elif number in (70, 71):
            draft.modal(inch=number == 70)
        elif number in (90, 91):
            draft.modal(absolute=number == 90)
        elif number in (17, 18, 19):
            contour.plane(draft, number, words.gfunctions[number].span)
            draft.state = offsets.with_tool(draft.state, draft.state.tool)


def _zero_offset(draft: Draft, words: Words) -> None:
    for number, word in words.gfunctions.items():
        if GFUNCTIONS[number].group != "zero":
            continue
        index = number - 53
        if number == 159:
            index = _group_index(draft, words, word)
        draft.state = offsets.select_zero(draft.state, index, draft.place)


def _group_index(draft: Draft, words: Words, word: tree.GWord) -> int:
    number = 159 if 159 in words.gfunctions and words.gfunctions[159] is word else 160
    if number not in words.values:
        draft.fail(
            "20147", word.span, f"G{number} needs the index of a group", f"write G{number}=2"
        )
    value = words.values[number]
    if abs(value - round(value)) > 1e-9:
        what = f"G{number} needs a whole number, not {value:g}"
        draft.fail("20582" if number == 159 else "20583", word.span, what)
    index = round(value)
    if not 0 <= index < ZERO_GROUPS:
        what = f"zero offset group {index} does not exist; indices are 0 to {ZERO_GROUPS - 1}"
        draft.fail("20149" if number == 159 else "20584", word.span, what)
    return index


def _mask_group(draft: Draft, words: Words) -> None:
    """G160=2 X1 Y0: leave X out of group 2, take Y in; counts at the next selection."""
    if 160 not in words.gfunctions:
        return
    index = _group_index(draft, words, words.gfunctions[160])
    table = draft.state.zero_offsets
    record = table.groups.get(index, offsets.OffsetRecord())
    inactive = set(record.inactive)
    if not words.axes:
        hint = "write for example G160=2 X1 Y0: 1 leaves the axis out, 0 takes it in"
        draft.fail("N2004", words.gfunctions[160].span, "G160 needs at least one axis", hint)
    for axis, (value, span) in words.axes.items():
        if value not in (0.0, 1.0):
            what = f"G160 takes 0 (axis is included) or 1 (left out), not {value:g}"
            draft.fail("N1005", span, what)
        (inactive.add if value else inactive.discard)(axis)
    groups = {**table.groups, index: replace(record, inactive=frozenset(inactive))}
    draft.state = draft.state.changed(zero_offsets=replace(table, groups=groups))
    words.axes.clear()


def _reference_point(draft: Draft, words: Words) -> None:
    """G92: machine = programmed + zero offset + G92; G90 replaces, G91 adds."""
    if 92 not in words.gfunctions:
        return
    if not words.axes:
        draft.fail(
            "N2004",
            words.gfunctions[92].span,
            "G92 needs at least one axis with its offset",
            "write for example G92 X10; G92 X0 takes the offset away",
        )
    values = {axis: draft.length(axis, value) for axis, (value, _) in words.axes.items()}
    add = not draft.modes.absolute
    draft.state = offsets.set_offsets(draft.state, "g92", "G92", values, draft.place, add)
    words.axes.clear()


_NO_TARGETS = frozenset((74, 100, 200, 201, 202))
"""G functions whose axis words do not end where they say."""


def _tool(draft: Draft, words: Words) -> None:
    """T and D; with P-CHAN-00100 the axes move at once, together with the words of the block."""
    place = words.addresses.pop("T", None)
    record = words.addresses.pop("D", None)
    if place is not None:
        tool = draft.state.tool.changed(place=round(place[0]))
        draft.state = draft.state.changed(tool=tool)
        if draft.machine.settings.tool_with_t and record is None:
            record = place
    if record is not None:
        tools.refuse_written(draft, words, record[1])
        together = bool(words.axes) and not _NO_TARGETS & words.gfunctions.keys()
        tools.select(draft, round(record[0]), record[1], together)


def _technology(draft: Draft, words: Words) -> None:
    feed = words.addresses.pop("F", None)
    if feed is not None:
        if feed[0] <= 0:
            draft.fail("20176", feed[1], "the feed must be greater than 0")
        draft.modal(feed=feed[0] * draft.modes.length_factor)
    for letter in ("S", "E", "H"):
        word = words.addresses.pop(letter, None)
        if letter == "H" and word is not None:
            what = f"H{word[0]:g} is taken as without effect on positions"
            draft.warn("N2002", word[1], what)
        if letter == "E" and word is not None:
            _end_feed(draft, *word)
    for number, span in words.mfunctions.items():
        if number not in KNOWN_M and not (number == 6 and calls.tool_change_file(draft)):
            draft.warn("N2002", span, f"M{number:02d} is taken as without effect on positions")


def _end_feed(draft: Draft, value: float, span: Span) -> None:
    """E is the feed at the end of the block, never an exponent."""
    if value <= 0:
        draft.fail(
            "20176",
            span,
            "the feed at the block end (E) must be greater than 0",
            "numbers have no exponent here: write 0.001 for 1E-3",
        )
    draft.warn("N2002", span, "E (feed at the block end) has no effect on positions")


def _end(draft: Draft, words: Words) -> None:
    for number, span in words.mfunctions.items():
        if number in (2, 30):
            draft.ended = True
            quiet = draft.machine.settings.transformation_ends
            if draft.state.kinematics.is_on and not quiet:
                draft.warn("21247", span, "a transformation is still active at program end")


def reject_unused(draft: Draft, words: Words) -> None:
    """N2003 for the first address that no rule has taken."""
    for letter, (_value, span) in words.addresses.items():
        draft.fail("N2003", span, f"word {letter} is not used by any command in this block")


Rule = Callable[[Draft, Words], None]

AXIS, MISCELLANEOUS, INSERT = "an axis word", "an M word", "#CHR and its kin"
"""What wakes a rule besides the numbers of G functions and the letters of addresses."""
_G = frozenset(GFUNCTIONS)
_ZERO = frozenset(number for number, row in GFUNCTIONS.items() if row.group == "zero")
_SPOKEN_OF = frozenset(n for n, row in GFUNCTIONS.items() if row.effect in ("refused", "quiet"))

RULES: tuple[tuple[Rule, frozenset[int | str]], ...] = (
    (_refuse_g, _SPOKEN_OF | {151}),
    (dwell.dwell, frozenset((4,))),
    (radius_compensation.select, frozenset((40, 41, 42, 17, 18, 19))),
    (_modal, _G),
    (dwell.software_limits, frozenset((98, 99))),
    (contour.mirror, frozenset((20, 21, 22, 23, 351))),
    (diameter.select, _G),
    (contour.rotation, frozenset((68, 69))),
    (circle.modes, frozenset((161, 162, 163, 164, 165, "R"))),
    (_zero_offset, _ZERO),
    (_mask_group, frozenset((160,))),
    (_reference_point, frozenset((92,))),
    (measuring.offset, frozenset((101, 102, 106))),
    (_tool, frozenset("TD")),
    (_technology, frozenset(("F", "S", "E", "H", MISCELLANEOUS))),
    (manual.jog, frozenset((200, 201, 202))),
    (manual.home, frozenset((74,))),
    (corner.stored_size, frozenset((301, 302))),
    (travel.motion, frozenset((100, AXIS, "I", "J", "K", "R"))),
    (corner.beside_motion, frozenset((INSERT,))),
    (calls.implicit, calls.IMPLICIT | {MISCELLANEOUS}),
    (_end, frozenset((MISCELLANEOUS,))),
)
"""The rules in their order of effect, each with the words that wake it; it takes those that it
owns and leaves the rest."""


def awake(draft: Draft, words: Words) -> tuple[Rule, ...]:
    """The rules that have something to do in a block, in their order."""
    kinds: list[int | str] = [*words.gfunctions, *words.addresses]
    if words.axes:
        kinds.append(AXIS)
    if words.mfunctions:
        kinds.append(MISCELLANEOUS)
    if draft.inserts:
        kinds.append(INSERT)
    return _woken_by(frozenset(kinds))


@lru_cache(maxsize=1000)
def _woken_by(kinds: frozenset[int | str]) -> tuple[Rule, ...]:
    return tuple(rule for rule, wakes in RULES if wakes & kinds)
