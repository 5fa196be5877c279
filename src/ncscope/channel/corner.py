"""G301, G302, #CHR, #CHF, #RND, #FRC: chamfers and roundings before the next motion.

Source: TF5200 programming manual, inserting chamfers and roundings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.diagnostics import Span
from ncscope.language import tree
from ncscope.motion.corners import Corner

if TYPE_CHECKING:
    from ncscope.channel.words import Words

INSERTED = ("CHR", "CHF", "RND")


def size(draft: Draft, command: tree.HashCommand) -> None:
    """#CHR=2, #CHF=2, #RND=5 in a motion block, #FRC=300 beside them."""
    if command.value is None:
        hint = f"write for example #{command.name}=2"
        draft.fail("N1005", command.span, f"#{command.name} needs a value", hint)
    value = evaluate_number(draft, command.value)
    if value <= 0.0:
        draft.fail("20012", command.span, f"#{command.name} has to be greater than 0")
    others = [name for name in draft.inserts if name in INSERTED]
    if command.name in draft.inserts or (command.name in INSERTED and others):
        draft.fail("20130", command.span, "the block has two chamfers or roundings")
    draft.inserts[command.name] = value * draft.modes.length_factor, command.span


def stored_size(draft: Draft, words: Words) -> None:
    """G301 I2, G302 I5 in a block of their own; I stays stored for the next one."""
    number = next((n for n in (301, 302) if n in words.gfunctions), None)
    if number is None:
        return
    span = words.gfunctions[number].span
    if words.axes:
        hint = "write it in a block between two motion blocks"
        draft.fail("N2032", span, f"G{number} cannot stand in a motion block", hint)
    given = words.addresses.pop("I", None)
    if given is not None and given[0] < 0.0:
        draft.fail("20800", given[1], f"the size of a chamfer or rounding cannot be {given[0]:g}")
    if given is not None:
        draft.modal(corner_size=given[0] * draft.modes.length_factor)
    if not draft.modes.corner_size:
        hint = f"write for example G{number} I5"
        draft.fail("20012", given[1] if given else span, f"G{number} needs its size in I", hint)
    _insert(draft, number == 302, draft.modes.corner_size, False, span)


def beside_motion(draft: Draft, words: Words) -> None:
    """After the motion of the block: its #CHR, #CHF or #RND; #FRC is their feed."""
    if not draft.inserts:
        return
    found = next((name for name in INSERTED if name in draft.inserts), None)
    if found is None:
        if draft.corner is None:
            _, span = draft.inserts["FRC"]
            draft.fail("N2032", span, "#FRC stands beside #CHR, #CHF, #RND, G301 or G302")
        _insert(draft, draft.corner.rounding, draft.corner.size, False, draft.corner.span)
        return
    value, span = draft.inserts[found]
    if not draft.moves:
        hint = "write it into the motion block before the corner"
        draft.fail("N2032", span, f"#{found} stands in a block without a motion", hint)
    _insert(draft, found == "RND", value, found == "CHF", span)


def _insert(draft: Draft, rounding: bool, value: float, width: bool, span: Span) -> None:
    plane = draft.state.main_axes
    if draft.state.coordinates.point_to_point:
        what = "no chamfer or rounding while #PTP is active: its path is not that of the contour"
        draft.fail("21530", span, what, "write #PTP OFF before it")
    if max(plane[:2]) >= len(draft.state.axes):
        draft.fail("20010", span, "a chamfer or rounding needs the two axes of the plane")
    feed = draft.inserts["FRC"][0] if "FRC" in draft.inserts else draft.modes.feed
    draft.corner = Corner(rounding, value, width, plane, feed, draft.state.block, span)


COMMANDS = {name: size for name in (*INSERTED, "FRC")}
