"""Coordinate systems of a program: how they are written, and the chain that links them.

A definition is a shift in the axes of the level below and three angles, f3 about the third axis
first, then f2, then f1 about the axes already turned. Shift and angles always follow the order of
the main axes in G17. From bottom to top lie #BCS, #ACS, #CS and the systems of #CS SELECT,
whichever was switched on first; #ECS stands alone.
Source: definition of #CS; TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace

import numpy as np

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.coordinates import Level
from ncscope.diagnostics import Span
from ncscope.frames import Frame, sequence_rotation
from ncscope.language import tree

SELECTED = "#CS SELECT"
ECS = "#ECS"
ORDER = ("base", "#BCS", "#ACS", "#CS", SELECTED, ECS)
"""Kinds of level from bottom to top."""
MAX_LEVELS = 5
ID_LENGTH = 7
"""Characters of an id that is a name (P-CHAN-00490)."""
Id = int | str

FORM = "write for example #CS DEF [1] [10,0,0,0,0,30]: shift X Y Z, angles about X Y Z"


# --- how they are written ----------------------------------------------------------------------


def identifier(draft: Draft, group: tree.Group) -> Id:
    """The id in a bracket: a whole number from 1, or a name; a number as text is the number."""
    places = group.places
    if len(places) != 1 or places[0] is None or len(group.items) != 1 or group.items[0].key:
        what = "the id of a coordinate system is one number or one name"
        draft.fail("20820", group.span, what, FORM)
    if isinstance(places[0], (tree.Name, tree.Text)):
        return _name_id(draft, places[0])
    value = evaluate_number(draft, places[0])
    if value <= 0 or abs(value - round(value)) > 1e-9:
        draft.fail("20820", group.span, f"{value:g} is not an id; ids are whole numbers from 1")
    return round(value)


def _name_id(draft: Draft, node: tree.Name | tree.Text) -> str:
    text = text_of(node)
    if not 0 < len(text) <= ID_LENGTH:
        what = f"{text} is too long for an id: a name has at most {ID_LENGTH} characters"
        draft.fail("20820", node.span, what)
    return text


def text_of(node: tree.Name | tree.Text) -> str:
    """A name, with or without quotation marks."""
    return node.text if isinstance(node, tree.Name) else node.value


def values(draft: Draft, group: tree.Group, form: str = FORM) -> tuple[float, ...]:
    """Shift in mm and angles in degrees; empty and missing places are 0."""
    if len(group.cells) > 6 or any(len(cell) > 1 for cell in group.cells):
        what = "a coordinate system has three shifts and three angles"
        draft.fail("20675", group.span, what, form)
    if any(item.key or isinstance(item.value, tree.Name) for item in group.items):
        what = "a coordinate system is given by numbers alone"
        draft.fail("20675", group.span, what, form)
    numbers = [0.0 if p is None else evaluate_number(draft, p) for p in group.places]
    numbers += [0.0] * (6 - len(numbers))
    factor = draft.modes.length_factor
    return (*(v * factor for v in numbers[:3]), *numbers[3:])


def frame(draft: Draft, name: str, values: tuple[float, ...]) -> Frame:
    """The level below from this system, by the rotation sequence that is valid now."""
    settings, mode = draft.machine.settings, draft.state.system_mode
    sequence = mode.sequence or settings.rotation_sequence
    fixed = settings.rotation_fixed if mode.fixed is None else mode.fixed
    rotation = sequence_rotation(values[3:], sequence, fixed)
    return Frame(f"below {name}", name, rotation, np.array(values[:3]))


# --- the chain ---------------------------------------------------------------------------------


def active(draft: Draft, kind: str) -> list[Level]:
    """The active systems of a kind, from bottom to top."""
    return [level for level in draft.state.coordinates.levels if level.kind == kind]


def link(draft: Draft, span: Span, level: Level) -> None:
    """On top of the systems of its kind, below those of a higher kind; the axes stay."""
    check_axes(draft, span, level.kind)
    if level.kind != ECS and active(draft, ECS):
        what = f"{level.kind} cannot be linked to the effector coordinate system"
        draft.fail("20774", span, what, "switch it off first (#ECS OFF)")
    if len(active(draft, level.kind)) >= MAX_LEVELS:
        draft.fail("20826", span, f"only {MAX_LEVELS} coordinate systems can be linked")
    coordinates = draft.state.coordinates
    rank = ORDER.index(level.kind)
    place = sum(ORDER.index(other.kind) <= rank for other in coordinates.levels)
    levels = (*coordinates.levels[:place], level, *coordinates.levels[place:])
    draft.set_coordinates(replace(coordinates, levels=levels), span)


def unlink(draft: Draft, span: Span, gone: Container[int]) -> None:
    """Without the levels at these places of the chain, and without the offsets in them."""
    check_axes(draft, span, "a coordinate system")
    coordinates = draft.state.coordinates
    levels = tuple(level for k, level in enumerate(coordinates.levels) if k not in gone)
    draft.set_coordinates(replace(coordinates, levels=levels), span)


def require_main_axes(draft: Draft, span: Span, what: str) -> None:
    """Fails for a channel with fewer than three axes (20010)."""
    count = len(draft.state.axes)
    if count < 3:
        draft.fail("20010", span, f"{what} needs three main axes; the channel has {count}")


def check_axes(draft: Draft, span: Span, kind: str) -> None:
    """Three main axes are needed, and none of them may be a modulo axis."""
    axes = draft.state.axes
    require_main_axes(draft, span, kind)
    for axis in axes[:3]:
        if axis.modulo_range is not None:
            what = f"{kind} is not allowed: the main axis {axis.name} is a modulo axis"
            hint = "put a linear axis into its place (#SET AX)"
            draft.fail("21556", span, what, hint)
