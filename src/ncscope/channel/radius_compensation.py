"""G41, G42, G40: the programmed path is shown, and what the compensation forbids is refused.

The path of the cutter centre would be made of the moves in `transitions`; until then one warning
tells that it is missing. Source: TF5200 programming manual, tool radius compensation.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span
from ncscope.language import tree

if TYPE_CHECKING:
    from ncscope.channel.words import Words

FORBIDDEN = {
    "PSET": "20608",
    "PRESET": "20608",
    "TLC": "20671",
    "PTP": "21525",
    "CS": "20802",
    "ACS": "20802",
    "BCS": "20802",
    "ECS": "20802",
    "MCS": "20802",
    "FLUSH": "20651",
    "CHANNEL": "20651",
}
"""First keyword of a # command and the id that refuses it while G41 or G42 is active."""
ALLOWED = ("DEF", "MODE")
"""Second keywords that change no coordinate system."""


def select(draft: Draft, words: Words) -> None:
    """G41, G42: on; G40: off."""
    before = draft.modes.compensation
    for number in (40, 41, 42):
        if number not in words.gfunctions:
            continue
        if number != 40 and draft.state.coordinates.point_to_point:
            what = f"G{number} is not allowed while #PTP is active"
            draft.fail("21525", words.gfunctions[number].span, what, "write #PTP OFF before it")
        begins = number != 40 and not before
        draft.modal(compensation=0 if number == 40 else number, compensation_begins=begins)
        if number not in (40, before):
            what = "the path of the cutter centre is not computed; the programmed path is shown"
            draft.warn("N2037", words.gfunctions[number].span, what)
    if not (before and draft.modes.compensation):
        return
    for number in (17, 18, 19):
        if number in words.gfunctions and number != draft.modes.plane:
            what = f"G{number} changes the plane while G{before} is active"
            draft.fail("20133", words.gfunctions[number].span, what, "write G40 before it")


def motion(draft: Draft, circular: bool, span: Span) -> None:
    """Before a motion: the first one with G41 or G42 has to be straight."""
    if draft.modes.compensation_begins and circular:
        what = f"the first motion with G{draft.modes.compensation} is an arc"
        draft.fail("90008", span, what, "begin the compensation with a straight motion")
    if draft.modes.compensation_begins:
        draft.modal(compensation_begins=False)


def refuse(draft: Draft, command: tree.HashCommand) -> None:
    """Fails for a # command that is not allowed with G41, G42 or G51."""
    keywords = command.name.split(" ")
    first, rest = keywords[0], keywords[1:]
    active = draft.modes.compensation
    if active and first in FORBIDDEN and not set(rest) & set(ALLOWED):
        what = f"#{command.name} is not allowed while G{active} is active"
        draft.fail(FORBIDDEN[first], command.span, what, "write G40 before it")
    if draft.modes.diameter_axis is None:
        return
    if first in ("PSET", "PRESET"):
        what = f"#{command.name} is not allowed in diameter programming (G51)"
        draft.fail("20610", command.span, what, "write G52 before it")
    if command.name in ("SET AX", "PUT AX", "PUT AX ALL", "AX DEF", "AX RELEASE", "AX RELEASE ALL"):
        what = "the face turning axis is in use by diameter programming (G51)"
        draft.fail("20546", command.span, what, "write G52 before it")
