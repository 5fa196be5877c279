"""What a run demands of the machine: travel of every axis, its limits, the pole, turned-over axes.

Enters: a `Trajectory`. Leaves: an `Inspection` with the numbers, and its warnings.
Software limits hold for axis positions, never for the tool tip (P-AXIS-00177, P-AXIS-00178). Every
row is compared: the ends of blocks, and in a sampled run the points between them. A warning does
not end the run: what comes behind it is shown too, although the control would stop the axes there
(P-AXIS-00554, P-CHAN-00147).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.frames import Array
from ncscope.kinematics.pole import Pole
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.machine import Axis
from ncscope.trajectory import NO_BLOCK, Stretch, Trajectory

Rows = NDArray[np.int64]

TOLERANCE = 1e-6
"""mm or degrees that an axis may be beyond a limit: rounding, far below the control's 1e-4."""
NEAR_POLE = 5.0
"""Degrees from the singular direction inside which swings are looked for."""
SMALLEST_SWING = 20.0
"""Degrees that the first rotary axis turns, in one go, to be worth a warning."""
CROSSING = 90.0
"""A computed turn, in degrees, of at least so much leads past the pole to its other side."""
SWING_RATIO = 10.0
"""So many times more than the tool direction the axis turns in a swing."""
SAME_DIRECTION = 1e-4
"""Degrees below which the tool direction stays: turning the axis there was asked for."""


@dataclass(frozen=True, slots=True)
class Travel:
    """Where one axis went: mm or degrees, and the rows of the trajectory where it was there.

    below, above: the rows of moves that go beyond a limit, in order. first_below, first_above:
    how far the first of them goes; NaN without. An arc goes as far as it bulges.
    """

    axis: Axis
    low: float
    high: float
    low_row: int
    high_row: int
    below: Rows
    above: Rows
    first_below: float = np.nan
    first_above: float = np.nan


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


Place = tuple[str, int]
"""File and line of a move that a warning names."""


@dataclass(frozen=True)
class Inspection:
    """The numbers behind the warnings of a run; rows count from 0 over the whole trajectory.

    result: without moves where they were not kept. places: by row, at least of the rows that
    `diagnostics` names.
    """

    result: Trajectory = field(repr=False)
    travel: tuple[Travel, ...]
    swings: tuple[Swing, ...]
    wraps: tuple[Wrap, ...]
    places: Mapping[int, Place] = field(repr=False)

    @cached_property
    def move(self) -> Rows:
        """(rows,) the move that each row belongs to: several rows in a sampled run."""
        end = self.result.end
        return np.cumsum(end) - end

    @cached_property
    def pole_distance(self) -> Array:
        return pole_distance(self.result)

    @property
    def nearest_to_pole(self) -> tuple[float, int] | None:
        """Smallest distance to the singular direction and the row of the move that has it, at its
        start or end; None without a kinematics that has a pole."""
        found = [
            (float(distance.min()), row + max(0, int(distance.argmin()) - 1))
            for row, s in _stretches(self.result)
            for pole in [_pole(s)]
            if pole is not None
            for distance in [pole.distance(_with_start(s, pole.second))]
        ]
        return min(found, default=None)

    def diagnostics(self, sources: Mapping[str, Source] | None = None) -> tuple[Diagnostic, ...]:
        """Warnings: one for each limit of an axis and for each kind of event, with its number.

        sources: the texts by file name, to show the line of the first block.
        """
        found = [*self._limit_warnings(), *self._swing_warnings(), *self._wrap_warnings()]
        found.sort(key=lambda item: item[0])
        return tuple(
            diagnostic(id, _span(self.places[row], sources or {}), message, hint)
            for row, id, message, hint in found
        )

    def _limit_warnings(self) -> Iterator[tuple[int, str, str, str]]:
        for travel in self.travel:
            axis, limits = travel.axis, travel.axis.limits
            if limits is None:
                continue
            low = (travel.below, limits[0], travel.first_below, travel.low)
            high = (travel.above, limits[1], travel.first_above, travel.high)
            for (rows, limit, at, worst), key in (
                (low, "kenngr.swe_neg (P-AXIS-00177)"),
                (high, "kenngr.swe_pos (P-AXIS-00178)"),
            ):
                if len(rows) == 0:
                    continue
                unit = "degrees" if axis.rotary else "mm"
                message = (
                    f"axis {axis.name} goes to {_number(at)} {unit}, beyond its software limit "
                    f"{_number(limit)}"
                )
                count = len(np.unique(self.move[rows] if self.result.sampled else rows))
                if count > 1:
                    message += f"; {count} blocks are beyond it, at most {_number(worst)}"
                hint = f"the control stops the axis here; the limit is {key}"
                yield int(rows[0]), "N4101", message, hint

    def _swing_warnings(self) -> Iterator[tuple[int, str, str, str]]:
        if not self.swings:
            return
        first, count = self.swings[0], len(self.swings)
        widest = max(self.swings, key=lambda s: s.swing)
        blocks = "" if first.last == first.row else f" in {first.last - first.row + 1} blocks"
        message = (
            f"axis {first.axis} swings by {first.swing:.1f} degrees{blocks} while the tool passes "
            f"the singular direction at {first.distance:.4f} degrees"
        )
        if count > 1:
            message += f"; {count} swings, the widest by {widest.swing:.1f} degrees"
        hint = "the feed drops here; tilt the part or the path away from the pole"
        yield first.row, "N4102", message, hint

    def _wrap_warnings(self) -> Iterator[tuple[int, str, str, str]]:
        wraps: dict[str, list[Wrap]] = {}
        for wrap in self.wraps:
            if wrap.axis.modulo_range is None:
                wraps.setdefault(wrap.axis.name, []).append(wrap)
        for name, items in wraps.items():
            first = items[0]
            message = (
                f"axis {name} turns back from {_number(first.before)} to {_number(first.after)} "
                "degrees: computed angles are between -180 and 180"
            )
            if len(items) > 1:
                message += f"; this happens {len(items)} times"
            hint = "a modulo axis (P-AXIS-00015) would take the short way"
            yield first.row, "N4103", message, hint


class Inspector:
    """Takes the stretches of a run one after the other."""

    def __init__(self) -> None:
        self._row = 0
        self._travel: dict[Axis, Travel] = {}
        self._swings: list[Swing] = []
        self._wraps: list[Wrap] = []
        self._places: dict[int, Place] = {}

    def see(self, s: Stretch, axes: tuple[Axis, ...]) -> None:
        """The next moves, with the axes of the channel at them."""
        if len(s) == 0:
            return
        row = self._row
        for column, axis in enumerate(axes):
            seen, known = _travel(axis, *_positions(s, column), row), self._travel.get(axis)
            self._travel[axis] = seen if known is None else _joined(known, seen)
            self._remember(s, (int(rows[0]) for rows in (seen.below, seen.above) if len(rows)))
        pole = _pole(s)
        swings = [] if pole is None else _swings(pole, s, row)
        wraps = _wraps(s, axes, row)
        self._remember(s, [*(swing.row for swing in swings), *(wrap.row for wrap in wraps)])
        self._swings += swings
        self._wraps += wraps
        self._row += len(s)

    def inspection(self, result: Trajectory) -> Inspection:
        """What was seen; the result with or without its moves."""
        travel, swings, wraps = (tuple(self._travel.values()), self._swings, self._wraps)
        return Inspection(result, travel, tuple(swings), tuple(wraps), self._places)

    def _remember(self, s: Stretch, rows: Iterable[int]) -> None:
        for row in rows:
            self._places.setdefault(row, (s.file, int(s.line[row - self._row])))


def inspect(result: Trajectory) -> Inspection:
    """Travel, limits, swings at the pole and turned-over axes of a run."""
    inspector = Inspector()
    for row, s in _stretches(result):
        inspector.see(s, _axes_at(result, row, s))
    return inspector.inspection(result)


def pole_distance(result: Trajectory) -> Array:
    """(rows,) degrees between the tool and its singular direction; NaN without one."""
    parts = [np.full(len(s), np.nan) for s in result.stretches]
    for s, out in zip(result.stretches, parts, strict=True):
        pole = _pole(s)
        if pole is not None:
            out[:] = pole.distance(s.acs[:, pole.second])
    return np.concatenate(parts) if parts else np.empty(0)


def place(result: Trajectory, row: int) -> tuple[str, int, int | None]:
    """File, line and block number (None without) of a row of the trajectory."""
    for first, s in _stretches(result):
        if row < first + len(s):
            block = int(s.block[row - first])
            return s.file, int(s.line[row - first]), None if block == NO_BLOCK else block
    raise IndexError(row)


# --- steps -------------------------------------------------------------------------------------


def _stretches(result: Trajectory) -> Iterator[tuple[int, Stretch]]:
    """Each stretch that has moves, with the row of its first one."""
    row = 0
    for s in result.stretches:
        if len(s):
            yield row, s
        row += len(s)


def _axes_at(result: Trajectory, row: int, s: Stretch) -> tuple[Axis, ...]:
    """The axes of the channel in a stretch that begins at a row."""
    found = [axes for first, axes in result.channels if first <= row]
    if found and len(found[-1]) == len(s.axes):
        return found[-1]
    return tuple(Axis(name, index + 1) for index, name in enumerate(s.axes))


def _positions(s: Stretch, column: int) -> tuple[Array, Rows]:
    """Positions of one axis with the rows of the stretch that they belong to, arcs included."""
    values, rows = s.acs[:, column], np.arange(len(s))
    if s.turning is None:
        return values, rows
    ends = np.flatnonzero(s.end)
    return (
        np.append(values, s.turning.acs[:, column]),
        np.append(rows, ends[s.turning.row]),
    )


def _travel(axis: Axis, values: Array, rows: Rows, row: int) -> Travel:
    lowest, highest = int(values.argmin()), int(values.argmax())
    low, high = float(values[lowest]), float(values[highest])
    ends = (row + int(rows[lowest]), row + int(rows[highest]))
    below = above = (np.empty(0, dtype=np.int64), np.nan)
    if axis.limits is not None:
        if low < axis.limits[0] - TOLERANCE:
            below = _beyond(values < axis.limits[0] - TOLERANCE, values, rows + row)
        if high > axis.limits[1] + TOLERANCE:
            above = _beyond(values > axis.limits[1] + TOLERANCE, values, rows + row)
    return Travel(axis, low, high, *ends, below[0], above[0], below[1], above[1])


def _beyond(there: NDArray[np.bool_], values: Array, rows: Rows) -> tuple[Rows, float]:
    """The rows beyond a limit in order, and the position at the first of them."""
    found = np.flatnonzero(there)
    order = found[np.argsort(rows[found], kind="stable")]
    return rows[order], float(values[order[0]])


def _joined(a: Travel, b: Travel) -> Travel:
    low, high = (a if a.low <= b.low else b), (a if a.high >= b.high else b)
    return Travel(
        a.axis,
        low.low,
        high.high,
        low.low_row,
        high.high_row,
        np.concatenate([a.below, b.below]),
        np.concatenate([a.above, b.above]),
        a.first_below if len(a.below) else b.first_below,
        a.first_above if len(a.above) else b.first_above,
    )


def _pole(s: Stretch) -> Pole | None:
    active = s.coordinates.kinematics
    if active is None or not isinstance(active.model, UniversalKinematics):
        return None
    return Pole.of(active.model)


def _swings(pole: Pole, s: Stretch, row: int) -> list[Swing]:
    """Runs of moves in which the first rotary axis turns far and the tool direction does not."""
    moves = pole.turning(s.start, s.acs, SMALLEST_SWING, NEAR_POLE, SWING_RATIO)
    if len(moves) == 0:
        return []
    start = np.where(moves[:, None] > 0, s.acs[moves - 1], s.start)
    end = s.acs[moves]
    turn = end[:, pole.first] - start[:, pole.first]
    if not pole.model.rtcp:
        turn = _short_way(turn)
    distance = pole.closest(start, end)
    change = pole.tilt(start, end)
    turn = np.abs(turn)
    far = turn >= SWING_RATIO * change
    if not pole.model.rtcp:  # nobody asked for the turn, however far the tool tilts besides
        leaves = pole.distance(np.stack([start, end])[..., pole.second]).min(axis=0)
        far |= (turn >= CROSSING) & (leaves > SAME_DIRECTION)
    bad = (distance < NEAR_POLE) & far & (change > SAME_DIRECTION)
    moves, distance, turn = moves[bad], distance[bad], turn[bad]
    if len(moves) == 0:
        return []
    runs = np.append(0, np.flatnonzero(np.diff(moves) > 1) + 1)
    sums = np.add.reduceat(turn, runs)
    least = np.minimum.reduceat(distance, runs)
    ends = np.append(runs[1:], len(moves)) - 1
    name = s.axes[pole.first]
    return [
        Swing(name, row + int(moves[a]), row + int(moves[b]), float(d), float(t))
        for a, b, d, t in zip(runs, ends, least, sums, strict=True)
        if t >= SMALLEST_SWING
    ]


def _wraps(s: Stretch, axes: tuple[Axis, ...], row: int) -> list[Wrap]:
    """Jumps of angles that a complete transformation computed; programmed angles are as asked."""
    active = s.coordinates.kinematics
    if active is None or not isinstance(active.model, UniversalKinematics) or active.model.rtcp:
        return []
    found = []
    for column in active.model.chain.rotary:
        values = _with_start(s, column)
        for i in np.flatnonzero(np.abs(np.diff(values)) > 180.0):
            found.append(Wrap(axes[column], row + int(i), float(values[i]), float(values[i + 1])))
    return sorted(found, key=lambda wrap: wrap.row)


def _with_start(s: Stretch, column: int) -> Array:
    return np.append(s.start[column], s.acs[:, column])


def _short_way(turn: Array) -> Array:
    return turn - 360.0 * np.round(turn / 360.0)


def _number(value: float) -> str:
    return f"{value + 0.0:.4f}".rstrip("0").rstrip(".")


def _span(place: Place, sources: Mapping[str, Source]) -> Span | None:
    file, line = place
    source = sources.get(file)
    if source is None:
        return None
    start, text = source.line_start(line), source.line_text(line)
    first = len(text) - len(text.lstrip())
    return Span(source, start + first, start + max(len(text.rstrip()), first + 1))
