"""What a chain is made of: offsets, levels, the tool and the selected kinematics.

Values are by channel axis, mm and degrees. Only `coordinates` adds them up.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ncscope.compilation import compiled
from ncscope.contour import NO_CONTOUR, Contour
from ncscope.frames import Array, Frame
from ncscope.kinematics.alignment import LengthCorrection
from ncscope.kinematics.step import KinematicStep, Pose

OFFSET_KINDS = ("zero", "g92", "pset", "clamp", "measure")
"""Kinds of offset a level can hold, in the order in which they are reported."""


@dataclass(frozen=True)
class Offset:
    """One kind of offset in one level.

    values: by channel axis, mm and degrees. name: as the report shows it (`G54`). origins: the
    place that set the value of each axis (`nullp.lis:14`), None where nothing did.
    """

    name: str
    values: tuple[float, ...]
    origins: tuple[str | None, ...]
    selected_at: str | None = None

    @property
    def origin(self) -> str | None:
        """The places that set it, each once; the selecting block when no value has a place."""
        places = list(dict.fromkeys(o for o in self.origins if o))
        return ", ".join(places) or self.selected_at


@dataclass(frozen=True)
class Level:
    """One coordinate system with the offsets that were programmed in it.

    frame: the level below from this level (`#CS DEF`). offsets: kind -> Offset; they act along
    the axes of this level and go when the level goes. `temporary`: the definition is deleted at
    #CS OFF. Level 0 is the workpiece system with the identity as its frame.
    """

    name: str
    kind: str
    frame: Frame
    offsets: tuple[tuple[str, Offset], ...] = ()
    id: int | str = 0
    temporary: bool = False
    origin: str | None = None

    def offset(self, kind: str) -> Offset | None:
        return dict(self.offsets).get(kind)

    def with_offset(self, kind: str, offset: Offset | None) -> Level:
        held = {k: o for k, o in self.offsets if k != kind}
        if offset is not None:
            held[kind] = offset
        order = sorted(held.items(), key=lambda pair: OFFSET_KINDS.index(pair[0]))
        return replace(self, offsets=tuple(order))

    def total(self, n: int, contour: Contour = NO_CONTOUR) -> Array:
        """Sum of the offsets by channel axis, mm and degrees; G351 mirrors G92."""
        total = np.zeros(n)
        for kind, offset in self.offsets:
            total += contour.shift(kind, offset.values)
        return total


BASE_LEVEL = Level("workpiece", "base", Frame("level 0", "level 0"))


@dataclass(frozen=True)
class ActiveTool:
    """The tool as it acts on positions.

    length: mm. axis_offsets: by channel axis, mm or degrees; they are subtracted.
    direction: unit vector from the mount to the tip, in the axes the tool lies along.
    fixed: the tool stays along machine axes even in a turned coordinate system (P-TOOL-00010).
    """

    length: float = 0.0
    axis_offsets: tuple[float, ...] = ()
    direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    fixed: bool = False
    origin: str | None = None


NO_TOOL = ActiveTool()


@dataclass(frozen=True)
class ActiveKinematics:
    """A selected kinematics with the pose that it keeps until it is deselected.

    turns_direction: coordinate systems turn the programmed direction too (P-CHAN-00247).
    point_to_point: between the ends of a move the axes run straight, not the tip (#PTP).
    rapid_straight: with G00 they always do (P-CHAN-00423).
    turns_in_plane: a programmed direction turns in the plane of its ends (P-CHAN-00417).
    """

    model: KinematicStep
    pose: Pose | None = None
    origin: str | None = None
    turns_direction: bool = False
    point_to_point: bool = False
    rapid_straight: bool = False
    turns_in_plane: bool = True


@dataclass(frozen=True)
class ActiveLengthCorrection:
    """#TLC with a kinematics: it acts along the tool, while no transformation is on."""

    model: LengthCorrection
    origin: str | None = None


@dataclass(frozen=True)
class ModuloAxes:
    """Axes whose positions are shown inside a range, as the control does after every motion.

    ranges: (channel index, low, high) in degrees, high not included.
    Source: P-AXIS-00015, P-AXIS-00126, P-AXIS-00127.
    """

    ranges: tuple[tuple[int, float, float], ...] = ()

    def wrap(self, values: Array, but: tuple[int, ...] = ()) -> Array:
        """Values (..., n) with these axes brought into their range, except the columns `but`."""
        wanted = [r for r in self.ranges if r[0] not in but]
        if not wanted:
            return values
        result = np.array(values, dtype=float, order="C")
        rows = result.reshape(-1, result.shape[-1])
        for column, low, high in wanted:
            _wrap_column(rows, column, low, high)
        return result

    def whole_turns(self, difference: Array) -> Array:
        """The full turns in differences (..., n) of axis values; 0 for other axes."""
        result = np.zeros_like(difference)
        for column, low, high in self.ranges:
            turn = high - low
            result[..., column] = turn * np.round(difference[..., column] / turn)
        return result


@compiled
def _wrap_column(rows, column, low, high):
    for row in range(rows.shape[0]):
        rows[row, column] = in_range(rows[row, column], low, high)


@compiled
def in_range(angle, low, high):
    """The angle in [low, high); one that is there stays as it is, to the last bit."""
    if low <= angle < high:
        return angle
    turned = low + (angle - low) % (high - low)
    return low if turned >= high else turned


NO_MODULO = ModuloAxes()
