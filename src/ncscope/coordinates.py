"""The one chain from programmed values to axis positions and back.

Enters: absolute programmed values of the innermost coordinate system. Leaves: workpiece, machine
and axis coordinates, and the layers between them with the place that set each. This is the only
module that adds an offset or applies a coordinate system. Every command that changes an offset,
a coordinate system, the tool or the kinematics makes another `Coordinates`.

All arrays are (..., n) with one column per channel axis, in channel order; mm and degrees.
Columns 0 to 2 are the main axes; coordinate systems turn these three only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ncscope.contour import NO_CONTOUR, Contour
from ncscope.frames import Array, Frame
from ncscope.kinematics.universal import UniversalKinematics

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
    id: int = 0
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


@dataclass(frozen=True)
class ActiveKinematics:
    """A selected kinematics with the pose that it keeps until it is deselected."""

    model: UniversalKinematics
    pose: int | None = None
    origin: str | None = None


class Layer(NamedTuple):
    """One step from the programmed word to the axis: contribution and value after it."""

    name: str
    origin: str | None
    change: Array
    values: Array


@dataclass(frozen=True)
class Coordinates:
    """The chain that is valid for one block.

    axis_count: columns of every array. levels: from the workpiece level 0 to the innermost one.
    Source: TF5200 coordinate systems and offsets; FCT-C2; TF5200 #CS; FCT-C27.
    """

    axis_count: int
    levels: tuple[Level, ...] = (BASE_LEVEL,)
    tool: ActiveTool = ActiveTool()
    kinematics: ActiveKinematics | None = None
    contour: Contour = NO_CONTOUR

    def __post_init__(self) -> None:
        """Raises ValueError for a coordinate system over fewer than three main axes."""
        if len(self.levels) > 1 and self.axis_count < 3:
            raise ValueError(
                f"coordinate systems need three main axes; the channel has {self.axis_count}"
            )

    # --- the three verbs -----------------------------------------------------------------------

    def to_axes(self, program: ArrayLike, near: ArrayLike | None = None) -> Array:
        """Axis positions (..., n) that put the tool where `program` (..., n) says.

        near: (n,) axis positions; decides where a rotary axis is free to stand anywhere.
        Raises KinematicsError when the machine cannot get there.
        """
        return self.axes_from_mcs(self.to_mcs(program), near)

    def to_program(self, axes: ArrayLike) -> Array:
        """The programmed values (..., n) that lead to the axis positions `axes` (..., n)."""
        return self.program_from_mcs(self.mcs_from_axes(axes))

    def layers(self, program: ArrayLike, near: ArrayLike | None = None) -> tuple[Layer, ...]:
        """Each layer from the programmed values (n,) down to the axes, with its contribution."""
        values = np.asarray(program, dtype=float)
        layers = [Layer("programmed", None, np.zeros(self.axis_count), values)]
        for name, origin, step in self._steps(near):
            after = step(values)
            layers.append(Layer(name, origin, after - values, after))
            values = after
        layers.append(Layer("axes", None, np.zeros(self.axis_count), values))
        return tuple(layers)

    # --- the systems between -------------------------------------------------------------------

    def to_mcs(self, program: ArrayLike) -> Array:
        """Tool tip in the Cartesian machine system; axes beyond the third with their offsets."""
        values = self.contour.apply(program)
        return self._affine(values, self.mcs_frame, self._offset_total)

    def to_wcs(self, program: ArrayLike) -> Array:
        """The same point with all coordinate systems undone, without the offsets of level 0."""
        return self.to_mcs(program) - self._total(self.levels[0])

    def program_from_mcs(self, mcs: ArrayLike) -> Array:
        """Programmed values (..., n) of a tool tip (..., n) in the machine system."""
        result = np.array(mcs, dtype=float)
        n = min(3, self.axis_count)
        result[..., 3:] -= self._offset_total[3:]
        back = self._main(self.mcs_frame.inverse)
        result[..., :n] = _transformed(result[..., :n], *back)
        return self.contour.invert(result)

    def axes_from_mcs(self, mcs: ArrayLike, near: ArrayLike | None = None) -> Array:
        """Axis positions (..., n) for a tool tip (..., n) in the machine system."""
        position = np.asarray(mcs, dtype=float) - self.tool_vector
        active = self.kinematics
        if active is None:
            return position
        return active.model.inverse(
            position, tool_length=self.tool.length, near=near, pose=active.pose
        )

    def mcs_from_axes(self, axes: ArrayLike) -> Array:
        """Tool tip (..., n) in the machine system for axis positions (..., n)."""
        position = np.asarray(axes, dtype=float)
        active = self.kinematics
        if active is not None:
            position = active.model.program(position, tool_length=self.tool.length)
        return position + self.tool_vector

    def direction(self, axes: ArrayLike) -> Array | None:
        """Unit vector (..., 3) tip -> flange in the MCS; None without a kinematics."""
        if self.kinematics is None:
            return None
        return self.kinematics.model.forward(axes, tool_length=self.tool.length)[1]

    # --- level-absolute values -----------------------------------------------------------------

    def level_from_program(self, program: ArrayLike) -> Array:
        """Values (..., n) of the innermost level with its offsets and, where the tool lies in
        the level, without the tool: what stays put when an offset changes."""
        return self.contour.apply(program) + self.top_total - self._tool_in_level

    def program_from_level(self, level: ArrayLike) -> Array:
        """The programmed values (..., n) that show for level-absolute values (..., n)."""
        values = np.asarray(level, dtype=float) - self.top_total + self._tool_in_level
        return self.contour.invert(values)

    def suppressed(self, kinds: frozenset[str]) -> Coordinates:
        """The same chain without the offsets of these kinds in any level; `tool` takes the tool
        away, but not its length inside a kinematics (#SUPPRESS OFFSETS)."""
        levels = tuple(
            replace(level, offsets=tuple((k, o) for k, o in level.offsets if k not in kinds))
            for level in self.levels
        )
        tool = self.tool
        if "tool" in kinds:
            length = tool.length if self.kinematics is not None else 0.0
            tool = replace(tool, axis_offsets=(), length=length)
        return replace(self, levels=levels, tool=tool)

    # --- parts ---------------------------------------------------------------------------------

    @property
    def top(self) -> Level:
        return self.levels[-1]

    @cached_property
    def top_total(self) -> Array:
        """Sum of the offsets of the innermost level, by channel axis."""
        return self._total(self.top)

    def _total(self, level: Level) -> Array:
        return level.total(self.axis_count, self.contour)

    @cached_property
    def mcs_frame(self) -> Frame:
        """The MCS from the programmed coordinates: every level with its offsets, main axes."""
        frame = Frame("MCS", "level 0", shift=_main_axes(self._total(self.levels[0])))
        for k, level in enumerate(self.levels[1:], start=1):
            step = Frame(f"level {k - 1}", f"level {k}", level.frame.rotation, level.frame.shift)
            own = Frame(f"level {k}", f"level {k}", shift=_main_axes(self._total(level)))
            frame = frame @ step @ own
        return frame

    @cached_property
    def tool_vector(self) -> Array:
        """What is subtracted from the tip to reach the axes, along machine axes (n,).

        With a kinematics the length and the axis offsets of the main axes are left out: the
        length goes into the transformation (TF5200 tool data, P-TOOL ax_versatz).
        """
        vector = self._tool_in_level.copy() if not self.tool.fixed else self._own_tool_vector
        if not self.tool.fixed:
            n = min(3, self.axis_count)
            vector[:n] = (self.mcs_frame.rotation @ _main_axes(vector))[:n]
        return vector

    @cached_property
    def _own_tool_vector(self) -> Array:
        """Tool vector (n,) along the axes in which the tool data are given."""
        vector = np.zeros(self.axis_count)
        offsets = self.tool.axis_offsets[: self.axis_count]
        vector[: len(offsets)] = offsets
        n = min(3, self.axis_count)
        if self.kinematics is not None:
            vector[:n] = 0.0
        else:
            vector[:n] += self.tool.length * np.array(self.tool.direction)[:n]
        return vector

    @cached_property
    def _tool_in_level(self) -> Array:
        return np.zeros(self.axis_count) if self.tool.fixed else self._own_tool_vector

    @cached_property
    def _offset_total(self) -> Array:
        """Per-axis sum of the offsets of all levels; counts for the axes beyond the third."""
        return np.sum([self._total(level) for level in self.levels], axis=0)

    def _affine(self, program: ArrayLike, frame: Frame, total: Array) -> Array:
        result = np.array(program, dtype=float)
        n = min(3, self.axis_count)
        result[..., :n] = _transformed(result[..., :n], *self._main(frame))
        result[..., 3:] += total[3:]
        return result

    def _main(self, frame: Frame) -> tuple[Array, Array]:
        n = min(3, self.axis_count)
        return frame.rotation[:n, :n], frame.shift[:n]

    @property
    def _kinematics_alone(self) -> Coordinates:
        tool = replace(self.tool, axis_offsets=())
        return replace(self, levels=(BASE_LEVEL,), tool=tool, contour=NO_CONTOUR)

    def _steps(self, near: ArrayLike | None) -> Iterator[tuple]:
        """Every layer as name, origin and the function that applies it."""
        n = self.axis_count
        yield from self.contour.steps()
        for k in range(len(self.levels) - 1, -1, -1):
            level = self.levels[k]
            for kind, offset in level.offsets:
                values = self.contour.shift(kind, offset.values)
                yield offset.name, offset.origin, _adder(values)
            if k:
                yield level.name, level.origin, _mover(level.frame, n)
        if self.tool.origin is not None or np.any(self.tool_vector):
            yield "tool", self.tool.origin, _adder(-self.tool_vector)
        if self.kinematics is not None:
            active = self._kinematics_alone
            yield "kinematics", self.kinematics.origin, _solver(active, near)


def _main_axes(values: Array) -> Array:
    """The first three columns, filled with zeros where the channel has fewer axes."""
    main = np.zeros(3)
    main[: min(3, len(values))] = values[:3]
    return main


def _transformed(points: Array, rotation: Array, shift: Array) -> Array:
    """rotation @ point + shift, summed in one order so that one row and a million agree."""
    n = points.shape[-1]
    rows = [sum(rotation[i, j] * points[..., j] for j in range(n)) + shift[i] for i in range(n)]
    return np.stack(rows, axis=-1)


def _adder(values: ArrayLike):
    return lambda x: x + np.asarray(values)


def _mover(frame: Frame, n: int):
    def move(x: Array) -> Array:
        y = x.copy()
        y[: min(3, n)] = frame.apply(_main_axes(x))[:n]
        return y

    return move


def _solver(coordinates: Coordinates, near: ArrayLike | None):
    return lambda x: coordinates.axes_from_mcs(x, near)
