"""Axis words of modulo axes: the sign behind the axis letter is the turning direction.

Source: TF5200 programming manual, programming modulo axes; P-AXIS-00015, P-CHAN-00346.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.compilation import compiled
from ncscope.language import tree
from ncscope.levels import ModuloAxes
from ncscope.machine import Axis

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def modulo_axes(axes: Iterable[Axis]) -> ModuloAxes:
    """The modulo axes of a channel with their ranges."""
    return ModuloAxes(
        tuple((i, *axis.modulo_range) for i, axis in enumerate(axes) if axis.modulo_range)
    )


def keep_sign(draft: Draft, words: Words, axis: int, word: tree.AxisWord) -> None:
    """Of `C-200`: the sign, and the value without it. Long axis names have no such sign."""
    if word.sign and draft.state.axes[axis].modulo_range is not None:
        value = evaluate_number(draft, _without_sign(word.value))
        words.signed[axis] = word.sign, value


def _without_sign(value: tree.Expression) -> tree.Expression:
    """The expression without its first sign: -200+10 gives 200+10."""
    if isinstance(value, tree.Unary):
        return value.operand
    if isinstance(value, tree.Binary):
        return value._replace(left=_without_sign(value.left))
    return value


def travel(draft: Draft, words: Words, axis: int) -> float | None:
    """Degrees that the axis turns with its word; None where it is no modulo axis, or where its
    word gives a direction in space.

    G90: a sign turns that way, less than a full turn; without one the short way, and half a turn
    in positive direction. G91: the value is the way.
    """
    state = draft.state
    limits = state.axes[axis].modulo_range
    active = state.coordinates.kinematics
    if limits is None or (active is not None and axis in active.model.orientation):
        return None
    value, span = words.axes[axis]
    sign, amount = words.signed.get(axis, ("", value))
    if not draft.modes.absolute:
        if sign and amount < 0:
            what = "a relative word of a modulo axis has a turning direction and a negative way"
            draft.fail("20958", span, what, "write one sign: it is the direction of the way")
        return value
    if draft.machine.settings.modulo_shortest:
        sign, amount = "", value
    at = float(state.position.program[axis])
    return way_to(amount, at, limits[1] - limits[0], SIGNS[sign])


SAME_ANGLE = 1e-9
"""Degrees; a way that is so much shorter than a full turn is none: rounding."""
SIGNS = {"": 0, "+": 1, "-": -1}


@compiled
def way_to(amount, at, turn, sign):
    """Degrees from `at` to `amount`, both without whole turns: in the direction of the sign, or
    with sign 0 the short way."""
    way = (amount - at) % turn
    if turn - way < SAME_ANGLE:
        way = 0.0
    if sign < 0:
        return way - turn if way > 0.0 else 0.0
    return way - turn if sign == 0 and way > turn / 2 else way
