"""What happens to the rotary axes near the singular direction, and at the end of their range.

Source: FCT-C27 section 7.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ncscope.frames import Array
from ncscope.kinematics.pole import Pole
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.machine import Axis
from ncscope.trajectory import Stretch

NEAR_POLE = 5.0
"""Degrees from the singular direction inside which swings are looked for."""
SMALLEST_SWING = 20.0
"""Degrees that the first rotary axis turns, in one go, to be worth a warning."""
CROSSING = 90.0
"""A computed turn, in degrees, of at least so much leads past the pole to its other side."""
SWING_RATIO = 10.0
"""So many times more than the tool direction the axis turns in a swing."""
ROUNDING = 1e-9
"""Part of a turn that does not decide whether it is a swing: rounding of the tool's own turn."""
SAME_DIRECTION = 1e-4
"""Degrees below which the tool direction stays: turning the axis there was asked for."""


@dataclass(frozen=True, slots=True)
class Swing:
    """The first rotary axis turns far while the tool passes its singular direction.

    row, last: first and last move. distance: smallest angle to the singular direction.
    swing: degrees that the axis turns, counted without its sense.
    """

    axis: str
    row: int
    last: int
    distance: float
    swing: float


@dataclass(frozen=True, slots=True)
class Wrap:
    """A computed rotary axis jumps over the end of its range, (-180, 180] degrees, at a move."""

    axis: Axis
    row: int
    before: float
    after: float


def pole_of(s: Stretch) -> Pole | None:
    """The pole of the kinematics of a stretch, None without one."""
    active = s.coordinates.kinematics
    if active is None or not isinstance(active.model, UniversalKinematics):
        return None
    return Pole.of(active.model)


def swings_in(pole: Pole, s: Stretch, row: int) -> tuple[list[Swing], int]:
    """Runs of moves in which the first rotary axis turns far and the tool direction does not.

    A run at the first or last move may go on in another stretch, so it may be a short one. The
    second result is the move of the stretch that ends nearest to the pole.
    """
    moves, nearest = pole.turning(s.start, s.acs, SMALLEST_SWING, NEAR_POLE, SWING_RATIO)
    if len(moves) == 0:
        return [], nearest
    start = np.where(moves[:, None] > 0, s.acs[moves - 1], s.start)
    end = s.acs[moves]
    turn = end[:, pole.first] - start[:, pole.first]
    if not pole.model.rtcp:
        turn = _short_way(turn)
    distance = pole.closest(start, end)
    change = pole.tilt(start, end)
    turn = np.abs(turn)
    far = turn >= SWING_RATIO * change * (1.0 - ROUNDING)
    if not pole.model.rtcp:  # nobody asked for the turn, however far the tool tilts besides
        leaves = pole.distance(np.stack([start, end])[..., pole.second]).min(axis=0)
        far |= (turn >= CROSSING) & (leaves > SAME_DIRECTION)
    bad = (distance < NEAR_POLE) & far & (change > SAME_DIRECTION)
    moves, distance, turn = moves[bad], distance[bad], turn[bad]
    if len(moves) == 0:
        return [], nearest
    runs = np.append(0, np.flatnonzero(np.diff(moves) > 1) + 1)
    sums = np.add.reduceat(turn, runs)
    least = np.minimum.reduceat(distance, runs)
    ends = np.append(runs[1:], len(moves)) - 1
    name = s.axes[pole.first]
    found = [
        Swing(name, row + int(moves[a]), row + int(moves[b]), float(d), float(t))
        for a, b, d, t in zip(runs, ends, least, sums, strict=True)
        if t >= SMALLEST_SWING or moves[a] == 0 or moves[b] == len(s) - 1
    ]
    return found, nearest


def continued(known: list[Swing], found: Iterable[Swing]) -> list[Swing]:
    """Swings in order; one that goes on where the last one ended is the same."""
    result = list(known)
    for swing in found:
        last = result[-1] if result else None
        if last is not None and (last.axis, last.last + 1) == (swing.axis, swing.row):
            distance = min(last.distance, swing.distance)
            turned = last.swing + swing.swing
            swing = Swing(swing.axis, result.pop().row, swing.last, distance, turned)
        elif last is not None and last.swing < SMALLEST_SWING:
            result.pop()
        result.append(swing)
    return result


def far_enough(found: Iterable[Swing]) -> tuple[Swing, ...]:
    """The swings that are worth a warning."""
    return tuple(swing for swing in found if swing.swing >= SMALLEST_SWING)


def wraps_in(s: Stretch, axes: tuple[Axis, ...], row: int) -> list[Wrap]:
    """Jumps of angles that a complete transformation computed; programmed angles are as asked."""
    active = s.coordinates.kinematics
    if active is None or not isinstance(active.model, UniversalKinematics) or active.model.rtcp:
        return []
    found = []
    for column in active.model.chain.rotary:
        values = with_start(s, column)
        for i in np.flatnonzero(np.abs(np.diff(values)) > 180.0):
            found.append(Wrap(axes[column], row + int(i), float(values[i]), float(values[i + 1])))
    return sorted(found, key=lambda wrap: wrap.row)


def with_start(s: Stretch, column: int) -> Array:
    return np.append(s.start[column], s.acs[:, column])


def _short_way(turn: Array) -> Array:
    return turn - 360.0 * np.round(turn / 360.0)
