"""#TRANSFORM, #MCS TO WCS and #WCS TO MCS: positions computed into variables; nothing moves.

The results are in V.A.TRANSFORM, V.A.WCS and V.A.MCS.
Source: TF5200 programming manual, #TRANSFORM and #WCS TO MCS
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

from ncscope.channel.commands import transformation
from ncscope.channel.commands.named_systems import (
    RESERVED,
    index_of,
    name_in,
    refuse_intermediate,
    whole_stack,
)
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.systems import require_main_axes, text_of
from ncscope.channel.words import axis_values
from ncscope.coordinates import Coordinates
from ncscope.frames import Array
from ncscope.kinematics.pole import Pole
from ncscope.kinematics.step import KinematicsError
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.language import tree

Values = dict[int, float]
SINGULAR = 1e-5
"""Degrees between tool and first rotary axis: a tenth of the resolution of the control."""
_FORM = "write for example #TRANSFORM [PCS] [MCS] [10,20,30]"
_JOINED = re.compile(r"([A-Z]\w*?)([-+]?(?:\d+\.?\d*|\.\d+))")


# --- between the systems of the stack ----------------------------------------------------------


def transform(draft: Draft, command: tree.HashCommand) -> None:
    """#TRANSFORM [from] [to] [x,y,z] [C=..]: a point of one system as a point of another one.

    Axes that are not given stand where they are. MCS is the machine system without offsets, ACS
    the axes.
    """
    _refuse_in_mcs(draft, command)
    groups = command.groups
    if not 3 <= len(groups) <= 4:
        draft.fail("20675", command.span, "#TRANSFORM needs two names and a position", _FORM)
    source, target = (name_in(draft, group, _FORM) for group in groups[:2])
    given = dict(enumerate(_point(draft, groups[2])))
    require_main_axes(draft, command.span, "#TRANSFORM")
    if len(groups) == 4:
        given.update(_axes_in(draft, groups[3]))
    axes = draft.state.position.axes
    tip = draft.state.coordinates.mcs_from_axes(axes)
    try:
        values = _leaving(draft, source)(tip)
        for axis, value in given.items():
            values[axis] = value
        result = _leaving(draft, target)(_entering(draft, source)(values))
    except KinematicsError as error:
        draft.fail(error.id, command.span, error.message)
    _keep(draft, "TRANSFORM", result)


def _leaving(draft: Draft, node: tree.Name | tree.Text) -> Callable[[Array], Array]:
    """The function from the machine system to a system of the stack."""
    name, coordinates = text_of(node).upper(), draft.state.coordinates
    if name == "MCS":
        return np.array
    if name == "ACS":
        near = draft.state.position.axes
        return lambda mcs: coordinates.axes_from_mcs(mcs, near)
    return _level(draft, node).program_from_mcs


def _entering(draft: Draft, node: tree.Name | tree.Text) -> Callable[[Array], Array]:
    """The function from a system of the stack to the machine system."""
    name, coordinates = text_of(node).upper(), draft.state.coordinates
    if name == "MCS":
        return np.array
    if name == "ACS":
        return coordinates.mcs_from_axes
    return _level(draft, node).to_mcs


def _level(draft: Draft, node: tree.Name | tree.Text) -> Coordinates:
    if text_of(node).upper() in RESERVED:
        refuse_intermediate(draft, node)
    chain = whole_stack(draft)
    below = len(chain.levels) - len(draft.state.systems)
    return chain.at_level(below + index_of(draft, node))


def _point(draft: Draft, group: tree.Group) -> list[float]:
    """Three coordinates in mm."""
    places = group.places
    if len(places) != 3 or None in places or len(group.items) != 3:
        draft.fail("21104", group.span, "#TRANSFORM needs three coordinates", _FORM)
    factor = draft.modes.length_factor
    return [evaluate_number(draft, p) * factor for p in places if p is not None]


# --- between programs with and without a kinematics --------------------------------------------


def wcs_to_mcs(draft: Draft, command: tree.HashCommand) -> None:
    """#WCS TO MCS [X1 Y2 C30]: what to program without a transformation to get to the place that
    these values mean with the selected kinematics; axes that are not given stay."""
    without, with_kinematics = _both(draft, command)
    near = draft.state.position.axes
    try:
        values = with_kinematics.to_program(near, draft.state.position.program)
        values = _replaced(values, _given(draft, command))
        axes = with_kinematics.to_axes(values, near)
        result = without.to_program(axes)
    except KinematicsError as error:
        draft.fail(error.id, command.span, error.message)
    _refuse_singular(draft, command, with_kinematics, axes)
    _keep(draft, "MCS", result)


def mcs_to_wcs(draft: Draft, command: tree.HashCommand) -> None:
    """#MCS TO WCS [X1 Y2 C30]: the other way round."""
    without, with_kinematics = _both(draft, command)
    values = _replaced(draft.state.position.program, _given(draft, command))
    axes = without.to_axes(values)
    try:
        result = with_kinematics.to_program(axes, values)
    except KinematicsError as error:
        draft.fail(error.id, command.span, error.message)
    _refuse_singular(draft, command, with_kinematics, axes)
    _keep(draft, "WCS", result)


def _refuse_singular(
    draft: Draft, command: tree.HashCommand, chain: Coordinates, axes: Array
) -> None:
    """Fails where a complete transformation leaves one rotary axis open: motions keep its position,
    a conversion has no unique result (21314)."""
    model = None if chain.kinematics is None else chain.kinematics.model
    if not isinstance(model, UniversalKinematics) or model.rtcp:
        return
    pole = Pole.of(model)
    if pole is not None and pole.distance(axes[pole.second]) < SINGULAR:
        what = f"the tool lies along axis {model.axis_names[pole.first]}, which leaves it open"
        draft.fail("21314", command.span, what, "tilt the tool out of the singular direction")


def _both(draft: Draft, command: tree.HashCommand) -> tuple[Coordinates, Coordinates]:
    """The coordinates as they are, and as they would be after #TRAFO ON."""
    _refuse_in_mcs(draft, command)
    coordinates = draft.state.coordinates
    if coordinates.kinematics is not None or len(coordinates.levels) > 1:
        active = "a transformation" if coordinates.kinematics else coordinates.top.name
        what = f"#{command.name} is not allowed while {active} is active"
        draft.fail("21236", command.span, what, "switch all off first (#TRAFO OFF, #CS OFF ALL)")
    trial = Draft(draft.machine, draft.state, draft.at)
    transformation.on(trial, command)
    return coordinates, trial.state.coordinates


def _replaced(values: Array, given: Values) -> Array:
    result = np.array(values, dtype=float)
    for axis, value in given.items():
        result[axis] = value
    return result


# --- words and results -------------------------------------------------------------------------


def _given(draft: Draft, command: tree.HashCommand) -> Values:
    """Axis values in mm and degrees, from brackets or from words."""
    given = {
        axis: draft.length(axis, value)
        for axis, (value, _) in axis_values(draft, command.words).items()
    }
    for group in command.groups:
        given.update(_axes_in(draft, group))
    if not given:
        form = f"write for example #{command.name} [X10 Y20 Z30]"
        draft.fail("20480", command.span, f"#{command.name} needs axes and their values", form)
    return given


def _axes_in(draft: Draft, group: tree.Group) -> Values:
    """`X=10`, `X 10`, `X10` or `X[P1]` in a bracket, with commas or without."""
    found: Values = {}
    name: tree.Name | None = None
    for item in group.items:
        if name is not None and item.key is None and not isinstance(item.value, tree.Name):
            _add_axis(draft, found, name.text, item, item.value)
            name = None
        elif item.key is not None:
            _add_axis(draft, found, _axis_of_key(draft, item.key), item, item.value)
        elif isinstance(item.value, tree.Name):
            joined = _JOINED.fullmatch(item.value.text)
            if joined is None or item.value.text in draft.state.axis_names:
                name = item.value
            else:
                number = tree.Number(float(joined[2]), item.span)
                _add_axis(draft, found, joined[1], item, number)
        else:
            draft.fail("N1005", item.span, "an axis and its value are needed here", "write X=10")
    if name is not None:
        draft.fail("N1002", name.span, f"the value of {name.text} is missing", "write X=10")
    return found


def _axis_of_key(draft: Draft, key: str) -> str:
    """Keys are capitals; the channel may write the name of the axis in another way."""
    return next((name for name in draft.state.axis_names if name.upper() == key), key)


def _add_axis(
    draft: Draft, found: Values, name: str, item: tree.Item, value: tree.Expression | None
) -> None:
    axis = draft.axis_index(name, item.span)
    if axis in found:
        draft.fail("20203", item.span, f"{name} has two values")
    if value is None:
        draft.fail("N1002", item.span, f"the value of {name} is missing", "write X=10")
    found[axis] = draft.length(axis, evaluate_number(draft, value))


def _refuse_in_mcs(draft: Draft, command: tree.HashCommand) -> None:
    if draft.state.suspended is not None:
        what = f"#{command.name} is not allowed while #MCS is active"
        draft.fail("20805", command.span, what, "write #MCS OFF before it")


def _keep(draft: Draft, variable: str, values: Array) -> None:
    new = {
        (variable, name): float(value)
        for name, value in zip(draft.state.axis_names, values, strict=True)
    }
    draft.state = draft.state.changed(converted={**draft.state.converted, **new})


COMMANDS = {"TRANSFORM": transform, "WCS TO MCS": wcs_to_mcs, "MCS TO WCS": mcs_to_wcs}
