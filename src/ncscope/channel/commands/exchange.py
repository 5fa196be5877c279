"""#CALL AX, #PUT AX, #AX DEF, #AX REQUEST and #AX RELEASE: axes come into the channel and go.

Source: TF5200 programming manual, axis exchange commands, standard and extended. An axis that stays
keeps its position and its offsets; one that comes back stands where it stood when it left.
"""

from __future__ import annotations

from ncscope.channel.commands.axes import (
    axis_of_group,
    check_unique,
    refuse_exchange,
    require_no_gap,
    with_axes,
)
from ncscope.channel.draft import Draft
from ncscope.language import tree
from ncscope.machine import Axis

SWITCHES = frozenset(("NAM", "NBR", "IDX"))
_CALL_FORM = "write [name, logical number, index], for example #CALL AX [C,6,3]"
_PUT_FORM = "write the names of axes, for example #PUT AX [B][C]"


def call_ax(draft: Draft, command: tree.HashCommand) -> None:
    """#CALL AX [C,6,3]: more axes; one that is in the channel already is not fetched again."""
    _request(draft, command, frozenset())


def request(draft: Draft, command: tree.HashCommand) -> None:
    """#AX REQUEST [NAM, NBR, IDX] [C,6,3]: #CALL AX with switches for conflicts."""
    switches = _switches(command)
    if "NBR" not in switches:
        held = {axis.number for axis in draft.state.axes}
        for _, axis, group in _wanted(draft, command):
            if axis.number in held:
                what = f"axis number {axis.number} is in the channel already"
                draft.warn("N2092", group.span, what, "the switch NBR says that this is meant")
    _request(draft, command, switches)


def define(draft: Draft, command: tree.HashCommand) -> None:
    """#AX DEF [X,1,0] [Y,2,1]: exactly these axes are the channel."""
    refuse_exchange(draft, command)
    switches = _switches(command)
    placed: dict[int, Axis] = {}
    for index, axis, group in _wanted(draft, command):
        check_unique(draft, group, placed, index, axis)
        _check_name(draft, group, axis, switches)
        placed[index] = axis
    _place(draft, command, placed)


def define_default(draft: Draft, command: tree.HashCommand) -> None:
    """#AX DEF DEFAULT: the axes of the channel list."""
    refuse_exchange(draft, command)
    _place(draft, command, dict(enumerate(draft.machine.axes)))


def put_ax(draft: Draft, command: tree.HashCommand) -> None:
    """#PUT AX [B][C], #AX RELEASE [B][C]: these axes leave the channel."""
    refuse_exchange(draft, command)
    names = [i for group in command.groups for i in group.items]
    if not names:
        draft.fail("20480", command.span, f"#{command.name} needs axes", _PUT_FORM)
    gone: set[int] = set()
    for item in names:
        if not isinstance(item.value, tree.Name) or item.key is not None:
            draft.fail("20797", item.span, "the name of an axis is needed here", _PUT_FORM)
        gone.add(draft.axis_index(item.value.text, item.span, "20797"))
    axes = draft.state.axes
    _place(draft, command, {i: axis for i, axis in enumerate(axes) if i not in gone})


def put_all(draft: Draft, command: tree.HashCommand) -> None:
    """#PUT AX ALL, #AX RELEASE ALL: the channel has no axes."""
    refuse_exchange(draft, command)
    _place(draft, command, {})


def _request(draft: Draft, command: tree.HashCommand, switches: frozenset[str]) -> None:
    refuse_exchange(draft, command)
    placed = dict(enumerate(draft.state.axes))
    held = {axis.number for axis in draft.state.axes}
    new: dict[int, Axis] = {}
    for index, axis, group in _wanted(draft, command):
        if axis.number in held:
            continue
        check_unique(draft, group, new, index, axis)
        _check_name(draft, group, axis, switches)
        if index in placed:
            _taken(draft, group, index, placed[index], switches)
        new[index] = axis
    _place(draft, command, {**placed, **new})


def _taken(
    draft: Draft, group: tree.Group, index: int, axis: Axis, switches: frozenset[str]
) -> None:
    if "IDX" in switches:
        what = "the switch IDX for an index that is taken is not supported"
        draft.fail("N2001", group.span, what, "give the axis an index that is free")
    what = f"index {index} has the axis {axis.name} already"
    draft.fail("20697", group.span, what, f"release it first: #PUT AX [{axis.name}]")


def _check_name(draft: Draft, group: tree.Group, axis: Axis, switches: frozenset[str]) -> None:
    """A name of the channel cannot go to another axis number."""
    other = next((a for a in draft.state.axes if a.name == axis.name), None)
    if other is None or other.number == axis.number:
        return
    if "NAM" in switches:
        what = "the switch NAM for a name that is taken is not supported"
        draft.fail("N2001", group.span, what, "give the axis a name that is free")
    what = f"the name {axis.name} belongs to axis number {other.number} in the channel"
    draft.fail("21256", group.span, what)


def _wanted(draft: Draft, command: tree.HashCommand) -> list[tuple[int, Axis, tree.Group]]:
    groups = [g for g in command.groups if not _is_switch(g)]
    if not groups:
        draft.fail("20480", command.span, f"#{command.name} needs axes", _CALL_FORM)
    return [(*axis_of_group(draft, group), group) for group in groups]


def _switches(command: tree.HashCommand) -> frozenset[str]:
    first = command.groups[0] if command.groups else None
    if first is None or not _is_switch(first):
        return frozenset()
    return frozenset(i.value.text.upper() for i in first.items if isinstance(i.value, tree.Name))


def _is_switch(group: tree.Group) -> bool:
    names = [i.value.text.upper() for i in group.items if isinstance(i.value, tree.Name)]
    return len(names) == len(group.items) > 0 and SWITCHES.issuperset(names)


def _place(draft: Draft, command: tree.HashCommand, placed: dict[int, Axis]) -> None:
    require_no_gap(draft, command, placed)
    draft.state = with_axes(draft.state, tuple(placed[i] for i in sorted(placed)))


COMMANDS = {
    "CALL AX": call_ax,
    "PUT AX": put_ax,
    "PUT AX ALL": put_all,
    "AX DEF": define,
    "AX DEF DEFAULT": define_default,
    "AX REQUEST": request,
    "AX RELEASE": put_ax,
    "AX RELEASE ALL": put_all,
}
