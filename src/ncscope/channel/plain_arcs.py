"""G02 and G03 among plain blocks: the rules of `circle`, row by row.

What the step lane would say something about is not taken: the stretch ends before it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ncscope.channel.circle import (
    GOOD,
    LARGEST,
    about_centre,
    limits_of,
    remembered,
    with_radius,
)
from ncscope.channel.state import State
from ncscope.compilation import compiled
from ncscope.frames import Array
from ncscope.language.scanner import PlainRows
from ncscope.machine import ChannelSettings
from ncscope.motion import MOTIONS
from ncscope.motion.arc import angles_and_radii
from ncscope.motion.arcs import NO_ARCS, Arcs

CLOCKWISE = MOTIONS.index("G02")
"""The first of the circular motions; the other one, G03, follows it."""
RADIUS = 3
"""Place of R behind I, J and K."""


class PlainArcs(NamedTuple):
    """rows: how many of the rows are plain. arcs: those among them. radius: (arcs,) mm, what is
    stored for arcs without a centre behind each, NaN for nothing."""

    rows: int
    arcs: Arcs = NO_ARCS
    radius: Array = np.empty(0)

    def before(self, row: int) -> PlainArcs:
        """The arcs of the rows before one."""
        arcs = self.arcs.before(row)
        return PlainArcs(min(self.rows, row), arcs, self.radius[: len(arcs)])


class ArcTerms(NamedTuple):
    """What I, J, K and R mean while coordinates, axes and modal functions stay: channel indices of
    the plane, millimetres of a unit, and the rules of `circle.about_centre`."""

    first: int
    second: int
    third: int
    first_unit: float
    second_unit: float
    length_unit: float
    centre_absolute: bool
    fits: bool
    shift: float
    shift_share: float
    difference: float
    difference_share: float

    @classmethod
    def of(cls, state: State, settings: ChannelSettings) -> ArcTerms | None:
        """None where there can be no arcs in the plane: the step lane says why."""
        first, second, third = state.main_axes
        if state.coordinates.point_to_point or max(first, second) >= len(state.axes):
            return None
        factors = state.coordinates.contour.factors(len(state.axes))
        if factors[first] != factors[second]:
            return None
        units = state.unit(first), state.unit(second), state.modal.length_factor
        rules = state.modal.centre_absolute, state.modal.centre_fits
        return cls(first, second, third, *units, *rules, *limits_of(settings))


def arcs_among(
    terms: ArcTerms | None,
    state: State,
    rows: PlainRows,
    motion: NDArray[np.int8],
    program: Array,
) -> PlainArcs:
    """The arcs of plain rows from their words; motion: (m,) as it is in each row; program: (m, n)
    programmed values at their ends."""
    m = len(program)
    circular, words = motion >= CLOCKWISE, rows.circular[:m] > 0
    count = int(np.count_nonzero(circular))
    if count == 0 or terms is None:
        other = circular | words
        return PlainArcs(int(np.argmax(other)) if other.any() else m)
    row, values, radius = np.empty(count, np.int64), np.empty((count, 6)), np.empty(count)
    stored = np.nan if state.modal.radius is None else state.modal.radius
    taken, count = _plain_arcs(
        motion, rows.circular, rows.centre, state.position.program, program, stored, *terms,
        row, values, radius,
    )  # fmt: skip
    axes = np.empty((count, 2), np.int64)
    axes[:] = terms.first, terms.second
    return PlainArcs(taken, Arcs(row[:count], axes, values[:count]), radius[:count])


def radius_and_circle(
    state: State, found: PlainArcs, program: Array
) -> tuple[float | None, tuple[float, float, float, float]]:
    """What the arcs leave in the state: the radius for arcs without a centre, and what V.G.I to
    V.G.R read. state: before the rows. program: (m, n) programmed values at their ends."""
    if not len(found.arcs):
        return state.modal.radius, state.circle
    row, radius = int(found.arcs.row[-1]), float(found.radius[-1])
    last = found.arcs.at(row)
    assert last is not None
    first, second = last.axes
    start = program[row - 1] if row else state.position.program
    begin = float(start[first]), float(start[second])
    circle = remembered(last, begin, state.modal.centre_absolute)
    return None if np.isnan(radius) else radius, circle


@compiled
def _plain_arcs(
    motion, circular, centre, start, program, radius, first, second, third, first_unit, second_unit,
    length_unit, centre_absolute, fits, shift, shift_share, difference, difference_share,
    rows, values, radii,
):  # fmt: skip
    """Rows that are plain, and the number of arcs among them."""
    count = 0
    x0, y0 = start[first], start[second]
    for i in range(len(program)):
        words = circular[i]
        x1, y1 = program[i, first], program[i, second]
        if motion[i] < CLOCKWISE:
            if words:
                return i, count
            x0, y0 = x1, y1
            continue
        large = max(max(abs(x0), abs(y0)), max(abs(x1), abs(y1)))
        has_radius = words >> RADIUS
        has_centre = (words >> first | words >> second) & 1
        if not large < LARGEST or (words >> third) & 1 or (has_radius and has_centre):
            return i, count
        clockwise = motion[i] == CLOCKWISE
        if has_centre:
            radius = np.nan
            cx = centre[i, first] * first_unit if words >> first & 1 else 0.0
            cy = centre[i, second] * second_unit if words >> second & 1 else 0.0
            if not centre_absolute:
                cx, cy = cx + x0, cy + y0
            verdict, cx, cy = about_centre(
                x0, y0, x1, y1, cx, cy, fits, shift, shift_share, difference, difference_share
            )
        else:
            if has_radius:
                radius = centre[i, RADIUS] * length_unit
            if radius == 0.0 or np.isnan(radius):
                return i, count
            verdict, cx, cy = with_radius(x0, y0, x1, y1, radius, clockwise)
        if verdict != GOOD:
            return i, count
        begin, sweep, start_radius, end_radius = angles_and_radii(x0, y0, x1, y1, cx, cy, clockwise)
        values[count, 0], values[count, 1], values[count, 2] = cx, cy, begin
        values[count, 3], values[count, 4], values[count, 5] = sweep, start_radius, end_radius
        rows[count], radii[count] = i, radius
        count += 1
        x0, y0 = x1, y1
    return len(program), count
