"""#ROTATION, #SCALE and #SUPPRESS OFFSETS (TF5200 coordinate systems and offsets)."""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel import diameter
from ncscope.channel.circle import CIRCULAR
from ncscope.channel.contour import plane_axes, set_contour, turn_off, turn_on
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.words import axis_values
from ncscope.contour import Turn
from ncscope.language import tree

SUPPRESSED = {
    "ZERO": "zero",
    "ADD_ZERO": "g92",
    "PSET": "pset",
    "CLAMP": "clamp",
    "TOOL": "tool",
    "MEASURE": "measure",
    "MANUAL": "manual",
}
"""The kinds that #SUPPRESS OFFSETS [..] names, and the kinds of offset in a level."""


def rotation_on(draft: Draft, command: tree.HashCommand) -> None:
    """#ROTATION ON [ANGLE=30 CENTER1=10 CENTER2=20]; without bracket the values used last."""
    first, second = plane_axes(draft, command.span, "#ROTATION ON")
    values = {"ANGLE": 0.0, "CENTER1": 0.0, "CENTER2": 0.0}
    items = [item for group in command.groups for item in group.items]
    for item in items:
        if item.key not in values or item.value is None:
            form = "write #ROTATION ON [ANGLE=30 CENTER1=10 CENTER2=20]"
            draft.fail("N1005", item.span, "a contour rotation has an angle and a centre", form)
        values[item.key] = evaluate_number(draft, item.value)
    turn = draft.state.turn
    if items:
        factor = draft.modes.length_factor
        centre = (values["CENTER1"] * factor, values["CENTER2"] * factor)
        turn = Turn(values["ANGLE"], centre)
    turn_on(draft, replace(turn, axes=(first, second), origin=draft.place), command.span)


def rotation_off(draft: Draft, command: tree.HashCommand) -> None:
    """#ROTATION OFF"""
    turn_off(draft, command.span)


def scale(draft: Draft, command: tree.HashCommand) -> None:
    """#SCALE X2 Y2: factors for the next #SCALE ON."""
    factors = axis_values(draft, command.words)
    if not factors:
        draft.fail("N1005", command.span, "#SCALE needs an axis and its factor, for example X2")
    if draft.state.coordinates.contour.scale:
        hint = "switch the scale off first (#SCALE OFF)"
        draft.fail("N2020", command.span, "scale factors cannot be changed while they act", hint)
    for value, span in factors.values():
        if value <= 0.0:
            draft.fail("N2020", span, f"a scale factor must be greater than 0, not {value:g}")
    new = {axis: value for axis, (value, _) in factors.items()}
    draft.state = draft.state.changed(scale_factors={**draft.state.scale_factors, **new})


def scale_on(draft: Draft, command: tree.HashCommand) -> None:
    """#SCALE ON, #SCALE ON X2: the factors act; zero of the active system stays in place."""
    if command.words:
        scale(draft, command)
    contour = draft.state.coordinates.contour
    factors = draft.state.scale_factors
    set_contour(draft, replace(contour, scale=factors, scale_origin=draft.place))


def scale_off(draft: Draft, command: tree.HashCommand) -> None:
    """#SCALE OFF: the factors stay stored."""
    contour = draft.state.coordinates.contour
    set_contour(draft, replace(contour, scale={}, scale_origin=None))


def suppress(draft: Draft, command: tree.HashCommand) -> None:
    """#SUPPRESS OFFSETS [ZERO TOOL] X50: in this block without these offsets, in any level."""
    if not draft.modes.absolute:
        what = "#SUPPRESS OFFSETS is not allowed with relative values (G91)"
        draft.fail("20985", command.span, what, "write G90 before it")
    words = axis_values(draft, command.words)
    if not words:
        what = "#SUPPRESS OFFSETS needs an axis and its position"
        draft.fail("N1005", command.span, what, "write for example #SUPPRESS OFFSETS X50")
    if draft.modes.motion in CIRCULAR:
        draft.refuse(command.span, "an arc (G02, G03) with #SUPPRESS OFFSETS")
    chain = draft.state.coordinates.suppressed(_kinds(draft, command))
    program = chain.to_program(draft.state.position.axes, near=draft.state.position.program)
    for axis, (value, span) in words.items():
        program[axis] = diameter.radius(draft, axis, value, span)
    draft.move_to(program, command.span, chain)


def _kinds(draft: Draft, command: tree.HashCommand) -> frozenset[str]:
    """The kinds in brackets; all of them without brackets."""
    items = [item for group in command.groups for item in group.items]
    kinds = set()
    for item in items:
        word = item.value.text.upper() if isinstance(item.value, tree.Name) else ""
        if word not in SUPPRESSED or item.key:
            what = f"{item.span.text.strip()} is no kind of offset"
            draft.fail("N1005", item.span, what, "known are " + " ".join(SUPPRESSED))
        kinds.add(SUPPRESSED[word])
    return frozenset(kinds or SUPPRESSED.values())


COMMANDS = {
    "ROTATION ON": rotation_on,
    "ROTATION OFF": rotation_off,
    "SCALE": scale,
    "SCALE ON": scale_on,
    "SCALE OFF": scale_off,
    "SUPPRESS OFFSETS": suppress,
}
