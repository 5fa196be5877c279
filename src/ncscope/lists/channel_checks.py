"""A data set of the universal kinematics beside the axes of the channel and the list's comments."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ncscope.diagnostics import Diagnostic, Severity, Span, diagnostic
from ncscope.kinematics.chain import CLASSIC
from ncscope.kinematics.parameters import INDEX_OF_FIELD, MAX_AXES
from ncscope.lists.blame import axis_count, blame, direction_of, lint
from ncscope.lists.kinematic_sets import KinematicSet
from ncscope.machine import Machine

ROTARY = 2
LETTERS = "ABC"
"""Rotary axes about X, Y and Z."""

_SEQUENCE = re.compile(r"#[^\n]*:[ \t]*(?P<names>[A-Z]{3,6})[ \t]*$")
_NAMED = re.compile(r"[ \t]*#[ \t]*(?P<name>[A-Z]\w*)\b")


def check_against_channel(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """What the data set says of axes that the channel, or a comment, says otherwise."""
    for axis in range(3, min(axis_count(item.parameters), len(machine.axes))):
        yield from _other_kind(item, machine, axis)
        yield from _other_letter(item, machine, axis)
    yield from _other_mode(item, machine)
    yield from _letter_missing(item, machine)
    yield from _overruled_mode(item, machine)
    yield from _comments(item, machine.axis_names)


def _other_kind(item: KinematicSet, machine: Machine, axis: int) -> Iterator[Diagnostic]:
    """FCT-C27 4.2: with RTCP, a rotary axis has the index that it has in the channel."""
    own = machine.axes[axis]
    if item.parameters.get(f"axis[{axis}].type") == ROTARY and not own.rotary:
        if item.parameters.get("rtcp") != 1:
            return
        message = (
            f"axis {axis} of kinematics {item.id} is rotary, but axis {own.name} at index {axis} "
            "of the channel is linear"
        )
        hint = f"describe the rotary axis at its channel index, or see gruppe[0].achse[{axis}]"
        yield lint(item, f"axis[{axis}].type", message, hint)


def _other_letter(item: KinematicSet, machine: Machine, axis: int) -> Iterator[Diagnostic]:
    """A turns about X, B about Y, C about Z; a clear contradiction looks like exchanged axes."""
    name = machine.axis_names[axis][:1]
    direction = [abs(c) for c in direction_of(item.parameters, axis)]
    main = [k for k in range(3) if direction[k] > 0]
    if item.parameters.get(f"axis[{axis}].type") != ROTARY or name not in LETTERS:
        return
    if len(main) == 1 and LETTERS[main[0]] != name:
        about = "XYZ"[main[0]]
        message = (
            f"axis {axis} of kinematics {item.id} turns about {about}, but the channel calls it "
            f"{machine.axis_names[axis]}"
        )
        hint = f"see whether the indices of two axes are exchanged; {LETTERS[main[0]]} turns "
        yield lint(item, f"axis[{axis}].orientation[{main[0]}]", message, f"{hint}about {about}")


def _other_mode(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """P-CHAN-00288 prints BC at 19, which is CB: the two are easily exchanged."""
    parameters = item.parameters
    letters = CLASSIC.get(int(parameters.get("programming_mode")))
    names = [
        machine.axis_names[a][:1]
        for place in range(axis_count(parameters))
        if 3 <= (a := int(parameters.get(f"chain[{place}]"))) < min(MAX_AXES, len(machine.axes))
    ]
    if letters is None or "".join(names) != letters[::-1]:
        return
    mode = int(parameters.get("programming_mode"))
    other = next(m for m, text in CLASSIC.items() if text == letters[::-1])
    message = (
        f"programming_mode {mode} of kinematics {item.id} is {letters}, but in the chain the axes "
        f"stand as {letters[::-1]}"
    )
    if parameters.get("rtcp") == 1:
        message += "; with rtcp 1 that makes no difference"
    hint = f"{letters[::-1]} is {other}; in a table that turns the workpiece {mode} can be meant"
    yield lint(item, "programming_mode", message, hint, note=True)


def _letter_missing(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """The complete transformation reads its angles from the axes that the mode names (D-8)."""
    mode = int(item.parameters.get("programming_mode") or machine.settings.orientation_mode)
    names = machine.axis_names
    missing = [c for c in CLASSIC.get(mode, "") if not any(n[:1] == c for n in names)]
    if missing and item.parameters.get("rtcp") == 0:
        message = (
            f"programming_mode {mode} of kinematics {item.id} is {CLASSIC[mode]}, but the channel "
            f"has no axis {missing[0]}"
        )
        hint = f"the axes are {' '.join(names)}; without the letter the axis index counts"
        yield lint(item, "programming_mode", message, hint)


def _overruled_mode(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """FCT-C27 5: the field of the kinematics counts before P-CHAN-00112."""
    mode, default = int(item.parameters.get("programming_mode")), machine.settings.orientation_mode
    if default and mode and default != mode:
        message = (
            f"programming_mode {mode} of kinematics {item.id} counts, ori_rotation_angle {default} "
            "(P-CHAN-00112) does not"
        )
        yield lint(item, "programming_mode", message, note=True)


def _comments(item: KinematicSet, names: tuple[str, ...]) -> Iterator[Diagnostic]:
    """Comments at the chain that name other axes than its numbers do."""
    parameters = item.parameters
    places = range(axis_count(parameters))
    chain = [int(parameters.get(f"chain[{place}]")) for place in places]
    if any(not 0 <= axis < len(names) for axis in chain):
        return
    for place, axis in zip(places, chain, strict=True):
        index = INDEX_OF_FIELD[f"chain[{place}]"]
        if index not in parameters.origins:
            continue
        span, _ = blame(item, (index,))
        before, behind = _comments_at(span)
        yield from _sequence(item, span, before, "".join(names[a] for a in chain))
        match = _NAMED.match(behind)
        if match and match["name"] in names and match["name"] != names[axis]:
            message = f"the comment says {match['name']}, but axis {axis} is {names[axis]}"
            hint = f"chain[{place}] of kinematics {item.id} is the channel index of an axis"
            yield diagnostic("N3010", span, message, hint, severity=Severity.NOTE)


def _sequence(item: KinematicSet, span: Span, line: str, chain: str) -> Iterator[Diagnostic]:
    match = _SEQUENCE.search(line)
    if match and match["names"] != chain and sorted(match["names"]) == sorted(chain):
        message = f"the comment before says {match['names']}, but the chain is {chain}"
        hint = f"the chain of kinematics {item.id} goes from the workpiece to the tool"
        yield diagnostic("N3010", span, message, hint, severity=Severity.NOTE)


def _comments_at(span: Span) -> tuple[str, str]:
    """The line before the entry, and what stands behind its value."""
    line = span.source.position(span.start)[0]
    before = span.source.line_text(line - 1) if line > 1 else ""
    text = span.source.line_text(line)
    _, mark, behind = text.partition("#")
    return before, mark + behind
