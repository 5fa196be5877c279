"""What a run demands of the machine: travel of every axis, its limits, the pole, turned-over axes.

Enters: a `Trajectory`. Leaves: an `Inspection` with the numbers, and its warnings.
Every row is compared: the ends of blocks, and in a sampled run the points between them. A warning
does not end the run: what comes behind it is shown too, although the control would stop the axes
there (P-AXIS-00554, P-CHAN-00147).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.frames import Array
from ncscope.inspection.pole import (
    Swing,
    Wrap,
    continued,
    far_enough,
    pole_of,
    swings_in,
    with_start,
    wraps_in,
)
from ncscope.inspection.travel import Rows, Travel, joined, travel_of
from ncscope.machine import Axis
from ncscope.trajectory import NO_BLOCK, Stretch, Trajectory

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
            for pole in [pole_of(s)]
            if pole is not None
            for distance in [pole.distance(with_start(s, pole.second))]
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
        self.nearest: tuple[float, Place] | None = None
        """Smallest angle of the tool to its singular direction at the end of a move, degrees."""

    def see(self, s: Stretch, axes: tuple[Axis, ...]) -> None:
        """The next moves, with the axes of the channel at them."""
        if len(s) == 0:
            return
        row = self._row
        for column, axis in enumerate(axes):
            seen, known = travel_of(axis, s, column, row), self._travel.get(axis)
            self._travel[axis] = seen if known is None else joined(known, seen)
            self._remember(s, (int(rows[0]) for rows in (seen.below, seen.above) if len(rows)))
        pole = pole_of(s)
        swings: list[Swing] = []
        if pole is not None:
            swings, nearest = swings_in(pole, s, row)
            self._meet(s, nearest, float(pole.distance(s.acs[nearest, pole.second])))
        wraps = wraps_in(s, axes, row)
        self._remember(s, [*(swing.row for swing in swings), *(wrap.row for wrap in wraps)])
        self._swings = continued(self._swings, swings)
        self._wraps += wraps
        self._row += len(s)

    def inspection(self, result: Trajectory) -> Inspection:
        """What was seen; the result with or without its moves."""
        travel, swings = tuple(self._travel.values()), far_enough(self._swings)
        return Inspection(result, travel, swings, tuple(self._wraps), self._places)

    def _meet(self, s: Stretch, nearest: int, distance: float) -> None:
        if self.nearest is None or distance < self.nearest[0]:
            self.nearest = distance, (s.file, int(s.line[nearest]))

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
        pole = pole_of(s)
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
