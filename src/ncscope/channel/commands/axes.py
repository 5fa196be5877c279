"""#SET AX, #CHANNEL INIT and #FLUSH: the axes of the channel and their positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.modulo import modulo_axes
from ncscope.channel.state import Position, State
from ncscope.coordinates import Level, Offset
from ncscope.language import tree
from ncscope.machine import MAX_CHANNEL_AXES, Axis, is_rotary_name

AXIS_LETTERS = "ABCQUVWXYZ"
LONGEST_NAME = 16


def set_ax(draft: Draft, command: tree.HashCommand) -> None:
    """#SET AX [X,1,0] [Y,2,1]: these axes are the channel now; index 0 to 2 are the main axes."""
    refuse_exchange(draft, command)
    groups = [g for g in command.groups if not _is_option(draft, g)]
    if not groups:
        draft.fail("20480", command.span, "#SET AX needs axes", _FORM)
    placed: dict[int, Axis] = {}
    for group in groups:
        index, axis = axis_of_group(draft, group)
        check_unique(draft, group, placed, index, axis)
        placed[index] = axis
    require_no_gap(draft, command, placed)
    draft.state = with_axes(draft.state, tuple(placed[i] for i in sorted(placed)))


def refuse_exchange(draft: Draft, command: tree.HashCommand) -> None:
    """Fails while a transformation or #MCS is active."""
    chain = draft.state.coordinates
    if chain.program_step is not None and chain.kinematics is None:
        what = "axes cannot be exchanged while a PCS transformation is active"
        draft.fail("22257", command.span, what, "switch it off first (#TRAFO PCS OFF)")
    if any(s is not None for s in (chain.kinematics, chain.program_step, chain.length_step)):
        draft.fail(
            "20683",
            command.span,
            "axes cannot be exchanged while a transformation is active",
            "switch it off first (#TRAFO OFF)",
        )
    above = draft.state.coordinates.levels[1:]
    if above:
        what = f"axes cannot be exchanged while a coordinate system is active: {above[-1].name}"
        draft.fail("20684", command.span, what, "switch it off first (#CS OFF ALL)")
    if draft.state.suspended is not None:
        what = f"#{command.name} while #MCS is active is not supported"
        draft.fail("N2001", command.span, what)


def require_no_gap(draft: Draft, command: tree.HashCommand, placed: Mapping[int, Axis]) -> None:
    """Fails for a channel without one of its first axes."""
    if sorted(placed) != list(range(len(placed))):
        draft.fail(
            "N1005",
            command.span,
            "the indices of the axes have a gap; that is not supported",
            f"number them from 0 to {len(placed) - 1}",
        )


_FORM = "write [name, logical number, index], for example #SET AX [X,1,0] [Y,2,1] [Z,3,2]"


def _is_option(draft: Draft, group: tree.Group) -> bool:
    """`FAST`, and options that say how offsets are taken over, in a bracket of their own."""
    names = [i.value.text for i in group.items if isinstance(i.value, tree.Name)]
    if len(group.cells) != 1 or len(names) != len(group.items) or not names:
        return False
    if names[0] in draft.state.axis_names or len(names[0]) == 1:
        return False  # an axis without its number and index
    if names != ["FAST"]:
        draft.warn("N2006", group.span, f"the option {names[0]} of #SET AX is ignored")
    return True


def axis_of_group(draft: Draft, group: tree.Group) -> tuple[int, Axis]:
    """Channel index and axis of `[name, logical number, index]`."""
    places = group.places
    if not places:
        draft.fail("20480", group.span, "the brackets of an axis are empty", _FORM)
    if places[-1] is None:
        draft.fail("20483", group.span, "a comma stands before the closing bracket", _FORM)
    if len(places) < 3:
        draft.fail("21251", group.span, "an axis needs its name, number and index", _FORM)
    if len(places) > 3:
        draft.warn("N2006", group.span, "the take-over option of the axis is ignored")
    name, number, index = places[:3]
    if not isinstance(name, tree.Name) or name.text[:1] not in AXIS_LETTERS:
        draft.fail("20797", group.span, "an axis name begins with A B C Q U V W X Y or Z", _FORM)
    if len(name.text) > LONGEST_NAME:
        what = f"an axis name has at most {LONGEST_NAME} characters, not {len(name.text)}"
        draft.fail("20425", name.span, what)
    if number is None or index is None:
        draft.fail("21251", group.span, "an axis needs its name, number and index", _FORM)
    channel_index = _whole(draft, index, "index")
    if not 0 <= channel_index < MAX_CHANNEL_AXES:
        draft.fail("20697", group.span, f"index {channel_index} is not 0 to {MAX_CHANNEL_AXES - 1}")
    return channel_index, _known(draft, group, name.text, _whole(draft, number, "number"))


def _whole(draft: Draft, node: tree.Expression, what: str) -> int:
    value = evaluate_number(draft, node)
    if abs(value - round(value)) > 1e-9:
        message = f"the {what} of an axis is a whole number, not {value:g}"
        draft.fail("N1005", node.span, message, _FORM)
    return round(value)


def _known(draft: Draft, group: tree.Group, name: str, number: int) -> Axis:
    """The axis of the lists under its name in the channel; by its letter where no list has it."""
    known = draft.machine.known_axes
    if number in known:
        held = next((axis for axis in draft.state.axes if axis.number == number), known[number])
        return replace(held, name=name)
    if known and len(known) > len(draft.machine.axes):
        has = " ".join(str(i) for i in sorted(known))
        draft.fail("20312", group.span, f"axis number {number} is unknown; the lists have {has}")
    for axis in draft.state.axes:
        if axis.number == number and axis.name == name:
            return axis
    return Axis(name, number, rotary=is_rotary_name(name), assumed=True)


def check_unique(
    draft: Draft, group: tree.Group, placed: Mapping[int, Axis], index: int, axis: Axis
) -> None:
    """Fails for an index, name or number that stands in the command already."""
    if index in placed:
        draft.fail("21257", group.span, f"index {index} is used twice")
    if any(a.name == axis.name for a in placed.values()):
        draft.fail("21256", group.span, f"axis name {axis.name} is used twice")
    if any(a.number == axis.number for a in placed.values()):
        draft.fail("20888", group.span, f"axis number {axis.number} is used twice")


def with_axes(state: State, axes: tuple[Axis, ...]) -> State:
    """Another channel configuration. An axis that stays keeps its position and its offsets."""
    old = {axis.number: i for i, axis in enumerate(state.axes)}
    parked = {
        **state.parked,
        **{axis.number: float(p) for axis, p in zip(state.axes, state.position.axes, strict=True)},
    }
    sources = [old.get(axis.number) for axis in axes]
    position = np.array([parked.get(axis.number, 0.0) for axis in axes])
    levels = tuple(_moved_level(level, sources) for level in state.coordinates.levels)
    contour = state.coordinates.contour.moved(sources)
    coordinates = replace(
        state.coordinates,
        axis_count=len(axes),
        levels=levels,
        contour=contour,
        modulo=modulo_axes(axes),
        manual=_moved(state.coordinates.manual, sources),
    )
    state = replace(
        state,
        scale_factors=_moved_factors(state.scale_factors, sources),
        axes=axes,
        coordinates=coordinates,
        parked=parked,
        position=Position(position, coordinates.to_program(position)),
    )
    return offsets.with_tool(state, state.tool)


def _moved_factors(factors: Mapping[int, float], sources: list[int | None]) -> dict[int, float]:
    return {i: factors[s] for i, s in enumerate(sources) if s is not None and s in factors}


def _moved_level(level: Level, sources: list[int | None]) -> Level:
    offsets = ((kind, _moved(offset, sources)) for kind, offset in level.offsets)
    return replace(level, offsets=tuple((kind, o) for kind, o in offsets if o is not None))


def _moved(offset: Offset | None, sources: list[int | None]) -> Offset | None:
    if offset is None:
        return None
    values = tuple(0.0 if s is None else offset.values[s] for s in sources)
    origins = tuple(None if s is None else offset.origins[s] for s in sources)
    return replace(offset, values=values, origins=origins)


def channel_init(draft: Draft, command: tree.HashCommand) -> None:
    """#CHANNEL INIT [CMDPOS] | [ACTPOS {AX=X}]: the channel takes the present positions.

    Axes are ideal here, so command and actual positions are the same. What manual mode laid on
    the axes is part of their position from now on.
    """
    items = [item for group in command.groups for item in group.items]
    if not items:
        draft.fail("20480", command.span, "#CHANNEL INIT needs [CMDPOS] or [ACTPOS]")
    first = items[0].value
    word = first.text.upper() if isinstance(first, tree.Name) and not items[0].key else ""
    if word not in ("CMDPOS", "ACTPOS"):
        draft.fail("N1005", command.span, "#CHANNEL INIT needs [CMDPOS] or [ACTPOS]")
    for item in items[1:]:
        if word == "CMDPOS":
            draft.fail("21508", item.span, "AX can only be given with ACTPOS")
        if item.key == "AX" and isinstance(item.value, tree.Name):
            draft.axis_index(item.value.text, item.span, "20797")
        elif item.key == "AXNR" and item.value is not None:
            number = _whole(draft, item.value, "number")
            if all(axis.number != number for axis in draft.state.axes):
                draft.fail("20312", item.span, f"axis number {number} is not in this channel")
        else:
            draft.fail("N1005", item.span, "only AX=.. and AXNR=.. can stand here")
    draft.set_coordinates(replace(draft.state.coordinates, manual=None), command.span)


def flush(draft: Draft, command: tree.HashCommand) -> None:
    """#FLUSH, #FLUSH WAIT: blocks are executed one after the other here; nothing is buffered."""


COMMANDS = {
    "SET AX": set_ax,
    "CHANNEL INIT": channel_init,
    "FLUSH": flush,
    "FLUSH WAIT": flush,
    "FLUSH CONTINUE": flush,
}
