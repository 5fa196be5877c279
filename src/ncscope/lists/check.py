"""What `ncscope check` says about lists: all that loading finds, and what looks wrong beyond it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ncscope.diagnostics import Diagnostic, Severity, Span, diagnostic
from ncscope.kinematics.parameters import INDEX_OF_FIELD, MAX_AXES, KinematicParameters
from ncscope.lists.kinematic_sets import KinematicSet
from ncscope.lists.reading import Loaded, load
from ncscope.machine import Machine

UNIVERSAL = 91
ROTARY = 2
DIRECTION_TOLERANCE = 1e-9


def check_lists(path: str | Path) -> tuple[Diagnostic, ...]:
    """Everything worth saying about the lists of a machine; nothing is run."""
    return check_loaded(load(path))


def check_loaded(loaded: Loaded) -> tuple[Diagnostic, ...]:
    """Diagnostics of loading, then of axes, kinematics, and entries without effect."""
    return (
        *loaded.diagnostics,
        *_assumed_axes(loaded),
        *_kinematics(loaded),
        *_without_effect(loaded),
    )


def _assumed_axes(loaded: Loaded) -> Iterator[Diagnostic]:
    for axis, span in zip(loaded.machine.axes, loaded.axis_spans, strict=False):
        if axis.assumed and axis.rotary:
            message = (
                f"axis {axis.name} has no axis list; it is taken as rotary because of its name"
            )
            hint = f"add an axis list with kopf.achs_nr {axis.number} and kenngr.achs_typ"
            yield diagnostic("N3004", span, message, hint)


def _without_effect(loaded: Loaded) -> Iterator[Diagnostic]:
    """N3003 once for every key, at its first entry."""
    said: set[str] = set()
    for reading in loaded.readings:
        key = reading.row.key
        if key in said or reading.row.status != "-":
            continue
        said.add(key)
        message = f"{reading.entry.key} ({reading.row.id}) is read and has no effect yet"
        yield diagnostic("N3003", reading.entry.key_span, message)


def _kinematics(loaded: Loaded) -> Iterator[Diagnostic]:
    machine = loaded.machine
    used = (
        machine.kinematic_parameters,
        machine.second_step_parameters,
        machine.program_step_parameters,
    )
    for item in loaded.kinematic_sets:
        parameters = used[item.slot.step].get(item.id)
        overruled = parameters is None or parameters.values is not item.parameters.values
        if overruled or parameters is None or parameters.type != UNIVERSAL:
            continue
        yield from _faults(item, loaded.machine)
        yield from _unusual(item)


def _faults(item: KinematicSet, machine: Machine) -> Iterator[Diagnostic]:
    """N3009 for what would stop the program when it selects this kinematics."""
    try:
        from ncscope.kinematics.chain import validate
    except ImportError:
        return
    mode = machine.settings.orientation_mode
    for fault in validate(item.parameters, len(machine.axes), mode, machine.axis_names):
        span, notes = _blame(item, tuple(fault.indices))
        message = (
            f"kinematics {item.id} will fail with {fault.id} when it is selected: {fault.message}"
        )
        yield diagnostic("N3009", span, message, fault.hint, notes=notes)


def _blame(
    item: KinematicSet, indices: tuple[int, ...]
) -> tuple[Span, tuple[tuple[str, Span], ...]]:
    """The last writer of the first blamed number that a line wrote, and its other writers."""
    for index in indices:
        writers: tuple[Any, ...] = item.parameters.origins.get(index, ())
        if writers:
            notes = tuple(("also written here", span) for span in writers[:-1])
            return writers[-1], notes
    return item.first.entry.key_span, ()


def _unusual(item: KinematicSet) -> Iterator[Diagnostic]:
    yield from _left_handed(item)
    for axis in range(_axis_count(item.parameters)):
        yield from _direction_length(item, axis)
        yield from _point_missing(item, axis)
    yield from _not_inverted(item)
    yield from _turned_linkage(item)


def _left_handed(item: KinematicSet) -> Iterator[Diagnostic]:
    if _triple_product(*(_direction(item.parameters, axis) for axis in range(3))) < 0:
        message = f"the linear axes of kinematics {item.id} form a left-handed system"
        hint = "check the signs of axis[0..2].orientation"
        yield _lint(item, "axis[0].orientation[0]", message, hint)


def _direction_length(item: KinematicSet, axis: int) -> Iterator[Diagnostic]:
    length = math.hypot(*_direction(item.parameters, axis))
    if length > DIRECTION_TOLERANCE and abs(length - 1) > DIRECTION_TOLERANCE:
        message = (
            f"the direction of axis {axis} of kinematics {item.id} has the length {length:.6g}, "
            "not 1; it is normalised"
        )
        yield _lint(item, f"axis[{axis}].orientation[0]", message, note=True)


def _point_missing(item: KinematicSet, axis: int) -> Iterator[Diagnostic]:
    indices = [INDEX_OF_FIELD[f"axis[{axis}].point[{k}]"] for k in range(3)]
    written = any(index in item.parameters.origins for index in indices)
    if item.parameters.get(f"axis[{axis}].type") == ROTARY and not written:
        message = (
            f"rotary axis {axis} of kinematics {item.id} has no point; it runs through 0, 0, 0"
        )
        hint = f"write {item.slot.spelling}.axis[{axis}].point[0], [1] and [2]"
        yield _lint(item, f"axis[{axis}].type", message, hint, note=True)


def _not_inverted(item: KinematicSet) -> Iterator[Diagnostic]:
    """Directions of axes on the workpiece side are to be inverted (FCT-C27 4.1)."""
    for axis in _workpiece_side(item.parameters):
        direction = _direction(item.parameters, axis)
        if max(direction, key=abs) > 0:
            message = (
                f"rotary axis {axis} of kinematics {item.id} is on the workpiece side and its "
                "direction looks not inverted"
            )
            hint = "the direction of an axis before the machine origin is multiplied by -1"
            largest = max(range(3), key=lambda k: abs(direction[k]))
            yield _lint(item, f"axis[{axis}].orientation[{largest}]", message, hint)


def _turned_linkage(item: KinematicSet) -> Iterator[Diagnostic]:
    """The rows of the linkage are X, Y and Z only while the directions are (FCT-C27 9)."""
    if item.parameters.get("linkage_mode") != 1:
        return
    for axis in range(3):
        direction = _direction(item.parameters, axis)
        if direction[axis] < max(map(abs, direction)) or direction[axis] <= 0:
            message = (
                f"kinematics {item.id} has a linkage, but the direction of axis {axis} is not "
                f"about {'XYZ'[axis]}"
            )
            hint = f"row {axis} of the linkage moves along axis[{axis}].orientation"
            yield _lint(item, f"axis[{axis}].orientation[0]", message, hint)


def _workpiece_side(parameters: KinematicParameters) -> list[int]:
    """Rotary axes of the chain before its first linear axis."""
    found: list[int] = []
    for place in range(_axis_count(parameters)):
        axis = parameters.get(f"chain[{place}]")
        if not (axis.is_integer() and 0 <= axis < MAX_AXES):
            return []
        if parameters.get(f"axis[{int(axis)}].type") != ROTARY:
            return found
        found.append(int(axis))
    return []


def _axis_count(parameters: KinematicParameters) -> int:
    """The axes that the list means: number_of_axes, or those with a type where it is missing."""
    count = parameters.get("number_of_axes")
    if count.is_integer() and 1 <= count <= MAX_AXES:
        return int(count)
    typed = [a for a in range(MAX_AXES) if parameters.get(f"axis[{a}].type")]
    return typed[-1] + 1 if typed else 0


def _direction(parameters: KinematicParameters, axis: int) -> list[float]:
    return [parameters.get(f"axis[{axis}].orientation[{k}]") for k in range(3)]


def _triple_product(x: list[float], y: list[float], z: list[float]) -> float:
    """Positive for a right-handed system, 0 for dependent directions."""
    return (
        (x[1] * y[2] - x[2] * y[1]) * z[0]
        + (x[2] * y[0] - x[0] * y[2]) * z[1]
        + (x[0] * y[1] - x[1] * y[0]) * z[2]
    )


def _lint(
    item: KinematicSet, field: str, message: str, hint: str = "", *, note: bool = False
) -> Diagnostic:
    span, _ = _blame(item, (INDEX_OF_FIELD[field],))
    severity = Severity.NOTE if note else None
    return diagnostic("N3010", span, message, hint, severity=severity)
