"""What looks wrong in the data sets of the universal kinematics, before a program selects them.

Rules about one data set alone; `channel_checks` looks at it beside the axes of the channel.
Source: FCT-C27, P-CHAN-00285 to -00295.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import takewhile

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.kinematics.building import can_be_pcs
from ncscope.kinematics.faults import Fault, validate
from ncscope.kinematics.parameters import (
    FIELD_OF_INDEX,
    INDEX_OF_FIELD,
    MAX_AXES,
    KinematicParameters,
)
from ncscope.lists.blame import axis_count, blame, direction_of, lint
from ncscope.lists.channel_checks import check_against_channel
from ncscope.lists.kinematic_sets import PROGRAM_STEP, KinematicSet
from ncscope.lists.reading import Loaded
from ncscope.machine import Machine

UNIVERSAL = 91
LINEAR, ROTARY = 1, 2
DIRECTION_TOLERANCE = 1e-9
SMALL = 2.0
"""List units: a position below 0.2 um is no position but a direction in the wrong place."""


def check_kinematics(loaded: Loaded) -> Iterator[Diagnostic]:
    """What every data set of the universal kinematics will fail with, or has that looks wrong."""
    machine = loaded.machine
    used = (
        machine.kinematic_parameters,
        machine.second_step_parameters,
        machine.program_step_parameters,
    )
    for item in loaded.kinematic_sets:
        parameters = used[item.slot.step].get(item.id)
        overruled = parameters is None or parameters.values is not item.parameters.values
        if overruled or parameters is None:
            continue
        if item.slot.step == PROGRAM_STEP:
            yield from _no_pcs_type(item, parameters.type)
            continue
        if parameters.type != UNIVERSAL:
            yield from _fields_of_another_type(item, parameters.type)
            continue
        yield from _faults(item, machine)
        yield from _unusual(item)
        yield from check_against_channel(item, machine)


def _fields_of_another_type(item: KinematicSet, type: int) -> Iterator[Diagnostic]:
    """FCT-C27 3.2: from V3.00 on the id of the universal kinematics has to be 91."""
    named = [w[-1] for w in item.parameters.origins.values() if ".param[" not in w[-1].text.lower()]
    if named:
        slot, old = item.slot.spelling, item.slot.fixed_id is not None
        message = (
            f"{named[0].text} counts for type 91 only, but kinematics {item.id} has type {type}"
        )
        hint = "write kinematik[91]" if old else f"write {slot}.id 91, or {slot}.type 91"
        yield diagnostic("N3010", named[0], message, hint)


def _faults(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """N3009 for what would stop the program when it selects this kinematics."""
    mode = machine.settings.orientation_mode
    for fault in validate(item.parameters.corrected(), len(machine.axes), mode, machine.axis_names):
        span, notes = blame(item, tuple(fault.indices))
        message = (
            f"kinematics {item.id} will fail with {fault.id} when it is selected: {fault.message}"
        )
        yield diagnostic("N3009", span, message + _unwritten(item, fault), fault.hint, notes=notes)


def _no_pcs_type(item: KinematicSet, type: int) -> Iterator[Diagnostic]:
    if not can_be_pcs(type):
        what = f"type {type} is no PCS transformation"
        message = f"{item.slot.spelling} will fail with 22287 when it is selected: {what}"
        hint = "PCS transformations have types 500 to 999"
        yield diagnostic("N3009", item.first.entry.key_span, message, hint)


def _unwritten(item: KinematicSet, fault: Fault) -> str:
    """Says that the list lacks the number to blame: its default 0 is what is wrong."""
    missing = list(takewhile(lambda i: i not in item.parameters.origins, fault.indices))
    if not missing:
        return ""
    names = [f"{item.slot.spelling}.{FIELD_OF_INDEX[i]}" for i in missing[:3]]
    named = ", ".join(names[:-1]) + (" and " if names[1:] else "") + names[-1]
    return f"; the list does not write {named}, so the default 0 counts"


def _unusual(item: KinematicSet) -> Iterator[Diagnostic]:
    yield from _exchanged_zero(item)
    yield from _tool_upside_down(item)
    yield from _axes_left_over(item)
    yield from _left_handed(item)
    for axis in range(axis_count(item.parameters)):
        yield from _direction_length(item, axis)
        yield from _point_missing(item, axis)
        yield from _point_of_linear_axis(item, axis)
    yield from _not_inverted(item)
    yield from _inverted(item)
    yield from _turned_linkage(item)
    yield from _linkage_without_mode(item)


def _left_handed(item: KinematicSet) -> Iterator[Diagnostic]:
    directions = [direction_of(item.parameters, axis) for axis in range(3)]
    if _triple_product(*directions) >= 0:
        return
    largest = [max(range(3), key=lambda k: abs(d[k])) for d in directions]
    message = f"the linear axes of kinematics {item.id} form a left-handed system"
    hint, blamed = "two of the three are exchanged, or one has the wrong sign", 0
    negative = [axis for axis in range(3) if directions[axis][largest[axis]] < 0]
    if sorted(largest) == largest and negative:
        blamed = negative[0]
        named = " and ".join(f"axis {axis} points along -{'XYZ'[axis]}" for axis in negative)
        hint = f"{named}; see whether that is meant"
    yield lint(item, f"axis[{blamed}].orientation[{largest[blamed]}]", message, hint)


def _direction_length(item: KinematicSet, axis: int) -> Iterator[Diagnostic]:
    length = math.hypot(*direction_of(item.parameters, axis))
    if length > DIRECTION_TOLERANCE and abs(length - 1) > DIRECTION_TOLERANCE:
        message = (
            f"the direction of axis {axis} of kinematics {item.id} has the length {length:.6g}, "
            "not 1; it is normalised"
        )
        yield lint(item, f"axis[{axis}].orientation[0]", message, note=True)


def _point_missing(item: KinematicSet, axis: int) -> Iterator[Diagnostic]:
    indices = [INDEX_OF_FIELD[f"axis[{axis}].point[{k}]"] for k in range(3)]
    written = any(index in item.parameters.origins for index in indices)
    if item.parameters.get(f"axis[{axis}].type") == ROTARY and not written:
        message = (
            f"rotary axis {axis} of kinematics {item.id} has no point; it runs through 0, 0, 0"
        )
        hint = f"write {item.slot.spelling}.axis[{axis}].point[0], [1] and [2]"
        yield lint(item, f"axis[{axis}].type", message, hint, note=True)


def _not_inverted(item: KinematicSet) -> Iterator[Diagnostic]:
    """Directions of axes on the workpiece side are to be inverted (FCT-C27 4.1)."""
    for axis in _workpiece_side(item.parameters):
        direction = direction_of(item.parameters, axis)
        if max(direction, key=abs) > 0:
            message = (
                f"rotary axis {axis} of kinematics {item.id} is on the workpiece side and its "
                "direction looks not inverted"
            )
            meant = ", ".join(f"{-c + 0.0:g}" for c in direction)
            hint = "the direction of an axis before the machine origin is multiplied by -1; for a "
            hint += f"table that turns mathematically positive write {meant}"
            largest = max(range(3), key=lambda k: abs(direction[k]))
            yield lint(item, f"axis[{axis}].orientation[{largest}]", message, hint)


def _turned_linkage(item: KinematicSet) -> Iterator[Diagnostic]:
    """The rows of the linkage are X, Y and Z only while the directions are (FCT-C27 9)."""
    if item.parameters.get("linkage_mode") != 1:
        return
    for axis in range(3):
        direction = direction_of(item.parameters, axis)
        if any(direction) and not direction[axis] >= max(map(abs, direction)):
            message = (
                f"kinematics {item.id} has a linkage, but the direction of axis {axis} is not "
                f"about {'XYZ'[axis]}"
            )
            hint = f"row {axis} of the linkage moves along axis[{axis}].orientation"
            yield lint(item, f"axis[{axis}].orientation[0]", message, hint)


def _exchanged_zero(item: KinematicSet) -> Iterator[Diagnostic]:
    """FCT-C27 3.1 prints the headings of both the other way round."""
    position = [item.parameters.get(f"zero_position[{k}]") for k in range(3)]
    direction = [item.parameters.get(f"zero_orientation[{k}]") for k in range(3)]
    if 0 < math.hypot(*position) <= SMALL < math.hypot(*direction) / 10:
        message = (
            f"zero_position and zero_orientation of kinematics {item.id} look exchanged: a flange "
            "position of less than 0.2 um and a direction of great length"
        )
        hint = "zero_orientation is the direction from tip to flange, zero_position in 0.1 um"
        yield lint(item, "zero_position[0]", message, hint)


def _tool_upside_down(item: KinematicSet) -> Iterator[Diagnostic]:
    """FCT-C27 3.1 comments (0, 0, 1) as "tool points in Z direction"; its formula says tip to
    flange."""
    direction = [item.parameters.get(f"zero_orientation[{k}]") for k in range(3)]
    if direction[2] < 0 and -direction[2] >= max(map(abs, direction)):
        message = (
            f"zero_orientation of kinematics {item.id} points down, so the tool tip is above the "
            "flange"
        )
        hint = "the direction goes from the tip to the flange: 0, 0, 1 for a tool that hangs down"
        yield lint(item, "zero_orientation[2]", message, hint, note=True)


def _axes_left_over(item: KinematicSet) -> Iterator[Diagnostic]:
    """Axes behind number_of_axes that the list describes nevertheless."""
    count = item.parameters.get("number_of_axes")
    if not (count.is_integer() and 3 <= count < MAX_AXES):
        return
    for axis in range(int(count), MAX_AXES):
        if item.parameters.get(f"axis[{axis}].type"):
            message = (
                f"axis {axis} of kinematics {item.id} is described, but number_of_axes is "
                f"{count:g}: it takes no part"
            )
            hint = f"write {item.slot.spelling}.number_of_axes {axis + 1}, or leave the axis out"
            yield lint(item, f"axis[{axis}].type", message, hint)


def _point_of_linear_axis(item: KinematicSet, axis: int) -> Iterator[Diagnostic]:
    """P-CHAN-00293: the table of FCT-C27 3.2 says it of the wrong kind of axis."""
    point = [item.parameters.get(f"axis[{axis}].point[{k}]") for k in range(3)]
    if item.parameters.get(f"axis[{axis}].type") == LINEAR and any(point):
        message = f"the point of linear axis {axis} of kinematics {item.id} has no effect"
        hint = "points count for rotary axes only"
        yield lint(item, f"axis[{axis}].point[0]", message, hint, note=True)


def _inverted(item: KinematicSet) -> Iterator[Diagnostic]:
    """A chain that was walked from the tool has the table's inverted axes at its tool end."""
    parameters = item.parameters
    axes = [int(parameters.get(f"chain[{place}]")) for place in range(axis_count(parameters))]
    kinds = [parameters.get(f"axis[{a}].type") if 0 <= a < MAX_AXES else 0 for a in axes]
    if sorted(axes) != list(range(len(axes))) or LINEAR not in kinds:
        return
    behind = axes[len(kinds) - kinds[::-1].index(LINEAR) :]
    if len(behind) > 1 and all(max(direction_of(parameters, a), key=abs) < 0 for a in behind):
        named = ", ".join(map(str, behind))
        message = (
            f"the rotary axes {named} of kinematics {item.id} are on the tool side and their "
            "directions look inverted"
        )
        hint = "the chain is walked from the workpiece to the tool; only axes before the machine "
        hint += "origin are inverted"
        yield lint(item, "chain[0]", message, hint)


def _linkage_without_mode(item: KinematicSet) -> Iterator[Diagnostic]:
    written = [
        i
        for i in range(INDEX_OF_FIELD["linkage[0][0]"], INDEX_OF_FIELD["linkage[2][3]"] + 1)
        if item.parameters.values[i]
    ]
    if written and item.parameters.get("linkage_mode") == 0:
        message = f"the linkage of kinematics {item.id} has no effect without linkage_mode"
        hint = f"write {item.slot.spelling}.linkage_mode 1 (P-CHAN-00294)"
        yield lint(item, FIELD_OF_INDEX[written[0]], message, hint)


def _workpiece_side(parameters: KinematicParameters) -> list[int]:
    """Rotary axes of the chain before its first linear axis."""
    found: list[int] = []
    for place in range(axis_count(parameters)):
        axis = parameters.get(f"chain[{place}]")
        if not (axis.is_integer() and 0 <= axis < MAX_AXES):
            return []
        if parameters.get(f"axis[{int(axis)}].type") != ROTARY:
            return found
        found.append(int(axis))
    return []


def _triple_product(x: list[float], y: list[float], z: list[float]) -> float:
    """Positive for a right-handed system, 0 for dependent directions."""
    return (
        (x[1] * y[2] - x[2] * y[1]) * z[0]
        + (x[2] * y[0] - x[0] * y[2]) * z[1]
        + (x[0] * y[1] - x[1] * y[0]) * z[2]
    )
