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
from ncscope.frames import Array, Frame, transformed
from ncscope.kinematics.step import KinematicsError
from ncscope.levels import (
    BASE_LEVEL,
    NO_MODULO,
    NO_TOOL,
    OFFSET_KINDS,
    ActiveKinematics,
    ActiveLengthCorrection,
    ActiveTool,
    Level,
    ModuloAxes,
    Offset,
)

__all__ = [
    "BASE_LEVEL",
    "OFFSET_KINDS",
    "ActiveKinematics",
    "ActiveLengthCorrection",
    "ActiveTool",
    "Coordinates",
    "Layer",
    "Level",
    "Offset",
]


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
    modulo: axes that are shown inside a range, in the program and at the machine.
    program_step: what maps programmed values before everything else (#TRAFO PCS).
    length_step: what carries axis values over to a tool of another length (#TLC).
    manual: what was jogged in manual mode (G201); it lies on the axes, behind everything else.
    Source: TF5200 coordinate systems and offsets; FCT-C2; TF5200 #CS; FCT-C27.
    """

    axis_count: int
    levels: tuple[Level, ...] = (BASE_LEVEL,)
    tool: ActiveTool = NO_TOOL
    kinematics: ActiveKinematics | None = None
    contour: Contour = NO_CONTOUR
    program_step: ActiveKinematics | None = None
    length_step: ActiveLengthCorrection | None = None
    modulo: ModuloAxes = NO_MODULO
    manual: Offset | None = None

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

    def to_program(self, axes: ArrayLike, near: ArrayLike | None = None) -> Array:
        """The programmed values (..., n) that lead to the axis positions `axes` (..., n).

        near: (n,) programmed values; of several ways to write a direction the nearest is taken.
        """
        return self.program_from_mcs(self.mcs_from_axes(axes, near), near)

    def layers(self, program: ArrayLike, near: ArrayLike | None = None) -> tuple[Layer, ...]:
        """Each layer from the programmed values (n,) down to the axes, with its contribution."""
        values = np.asarray(program, dtype=float)
        layers = [Layer("programmed", None, np.zeros(self.axis_count), values)]
        for name, origin, step in self._steps(near):
            after = step(values)
            if name == "modulo" and np.array_equal(after, values):
                continue
            layers.append(Layer(name, origin, after - values, after))
            values = after
        layers.append(Layer("axes", None, np.zeros(self.axis_count), values))
        return tuple(layers)

    # --- the systems between -------------------------------------------------------------------

    def to_mcs(self, program: ArrayLike) -> Array:
        """Tool tip in the Cartesian machine system; axes beyond the third with their offsets."""
        values = self.contour.apply(self._mapped(program))
        return transformed(values, *self._to_mcs)

    def wcs_from_mcs(self, mcs: ArrayLike) -> Array:
        """The same point with all coordinate systems undone, without the offsets of level 0."""
        return np.asarray(mcs, dtype=float) - self._total(self.levels[0])

    def program_from_mcs(self, mcs: ArrayLike, near: ArrayLike | None = None) -> Array:
        """Programmed values (..., n) of a tool tip (..., n) in the machine system."""
        values = transformed(mcs, *self._from_mcs)
        return self.shown(self._unmapped(self.contour.invert(values), near))

    def axes_from_mcs(self, mcs: ArrayLike, near: ArrayLike | None = None) -> Array:
        """Axis positions (..., n) for a tool tip (..., n) in the machine system."""
        position = np.asarray(mcs, dtype=float)
        if self._tool_acts:
            position = position - self.tool_vector
        axes = self._solved(position, near)
        return self.modulo.wrap(axes if self.manual is None else axes + self._jogged)

    def mcs_from_axes(self, axes: ArrayLike, near: ArrayLike | None = None) -> Array:
        """Tool tip (..., n) in the machine system for axis positions (..., n).

        near: (n,) programmed values, as for `to_program`.
        """
        position = np.asarray(axes, dtype=float) - self._jogged
        active = self.kinematics
        if self.length_step is not None:
            position = self.length_step.model.program(position)
        if active is not None:
            self._check_vector(active, position)
            near = None if near is None else self.asked(near)
            position = active.model.program(position, self.tool.length, near, self._turn)
        return position + self.tool_vector

    def asked(self, program: ArrayLike) -> Array:
        """What the kinematics is asked for (..., n): tool tip, and the words of the direction."""
        return self.to_mcs(program) - self.tool_vector

    def program_from_asked(self, asked: Array, near: ArrayLike | None = None) -> Array:
        """Programmed values (..., n) of what the kinematics is asked for."""
        return self.program_from_mcs(asked + self.tool_vector, near)

    def direction(self, axes: ArrayLike) -> Array | None:
        """Unit vector (..., 3) tip -> flange in the MCS; None without a kinematics."""
        if self.kinematics is None:
            return None
        position = axes if self.manual is None else np.asarray(axes, dtype=float) - self._jogged
        return self.kinematics.model.forward(position, tool_length=self.tool.length)[1]

    # --- level-absolute values -----------------------------------------------------------------

    def level_from_program(self, program: ArrayLike) -> Array:
        """Values (..., n) of the innermost level with its offsets and, where the tool lies in
        the level, without the tool: what stays put when an offset changes."""
        return self.contour.apply(self._mapped(program)) + self.top_total - self._tool_in_level

    def program_from_level(self, level: ArrayLike) -> Array:
        """The programmed values (..., n) that show for level-absolute values (..., n)."""
        values = np.asarray(level, dtype=float) - self.top_total + self._tool_in_level
        return self.shown(self._unmapped(self.contour.invert(values)))

    def shown(self, program: Array) -> Array:
        """Programmed values inside the ranges of modulo axes; directions are no positions."""
        active = self.kinematics
        return self.modulo.wrap(program, () if active is None else active.model.orientation)

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
        manual = None if "manual" in kinds else self.manual
        return replace(self, levels=levels, tool=tool, manual=manual)

    def at_level(self, k: int) -> Coordinates:
        """The chain as it ends at level `k`: program values are those of that level, not mapped,
        scaled, turned or mirrored."""
        contour = Contour(mirror_shift=self.contour.mirror_shift)
        levels = self.levels[: k + 1]
        return replace(self, levels=levels, contour=contour, program_step=None)

    # --- parts ---------------------------------------------------------------------------------

    @property
    def point_to_point(self) -> bool:
        """Whether the axes run straight between the ends of moves, and not the tip (#PTP)."""
        return self.kinematics is not None and self.kinematics.point_to_point

    @property
    def top(self) -> Level:
        return self.levels[-1]

    @cached_property
    def _jogged(self) -> Array:
        """What manual mode superimposes, by channel axis."""
        return np.zeros(self.axis_count) if self.manual is None else np.array(self.manual.values)

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
    def _tool_acts(self) -> bool:
        return bool(self.tool_vector.any())

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

    @cached_property
    def _to_mcs(self) -> tuple[Array | None, Array]:
        return self._all_columns(self.mcs_frame, self._offset_total)

    @cached_property
    def _from_mcs(self) -> tuple[Array | None, Array]:
        return self._all_columns(self.mcs_frame.inverse, -self._offset_total)

    def _all_columns(self, frame: Frame, total: Array) -> tuple[Array | None, Array]:
        """Rotation of the main axes or None, and shift of all: of the others by their offsets."""
        n = min(3, self.axis_count)
        rotation, shift = frame.rotation[:n, :n], total.copy()
        shift[:n] = frame.shift[:n]
        return None if (rotation == _NOT_TURNED[:n, :n]).all() else rotation, shift

    @property
    def _turn(self) -> Array | None:
        """Rotation (3, 3) that the levels give to a programmed direction; None without one."""
        active = self.kinematics
        turned = active is not None and active.turns_direction and active.model.orientation
        return self.mcs_frame.rotation if turned and len(self.levels) > 1 else None

    def _solved(self, position: Array, near: ArrayLike | None) -> Array:
        """Axis positions for a tool tip with the tool offsets taken off."""
        active = self.kinematics
        if self.length_step is not None:
            return self.length_step.model.inverse(position)
        if active is None:
            return position
        self._check_vector(active, position)
        return active.model.inverse(position, self.tool.length, near, active.pose, self._turn)

    def _check_vector(self, active: ActiveKinematics, position: Array) -> None:
        """An offset added to the components of a direction would turn it: refused."""
        columns = [c for c in active.model.orientation if c < self.axis_count]
        if len(columns) > 2 and (self._offset_total - self.tool_vector)[columns].any():
            raise KinematicsError(
                "N2001",
                "an offset of the axes that hold the tool direction (U, V, W) is not supported",
                tuple(range(position.size // self.axis_count)),
                "take their zero offset, G92, #PSET and tool offset away",
            )

    def _mapped(self, program: ArrayLike) -> ArrayLike:
        step = self.program_step
        return program if step is None else step.model.inverse(program, pose=step.pose)

    def _unmapped(self, values: Array, near: ArrayLike | None = None) -> Array:
        return (
            values
            if self.program_step is None
            else self.program_step.model.program(values, near=near)
        )

    def _steps(self, near: ArrayLike | None) -> Iterator[tuple]:
        """Every layer as name, origin and the function that applies it."""
        n = self.axis_count
        if self.program_step is not None:
            yield "#TRAFO PCS", self.program_step.origin, self._mapped
        yield from self.contour.steps
        for k in range(len(self.levels) - 1, -1, -1):
            level = self.levels[k]
            for kind, offset in level.offsets:
                values = self.contour.shift(kind, offset.values)
                yield offset.name, offset.origin, _adder(values)
            if k:
                yield level.name, level.origin, _mover(level.frame, n)
        if self.tool.origin is not None or np.any(self.tool_vector):
            yield "tool", self.tool.origin, _adder(-self.tool_vector)
        if self.length_step is not None:
            yield "#TLC", self.length_step.origin, lambda x: self._solved(x, near)
        if self.kinematics is not None:
            yield "kinematics", self.kinematics.origin, lambda x: self._solved(x, near)
        if self.manual is not None:
            yield self.manual.name, self.manual.origin, _adder(self._jogged)
        if self.modulo.ranges:
            yield "modulo", None, self.modulo.wrap


_NOT_TURNED = np.eye(3)


def _main_axes(values: Array) -> Array:
    """The first three columns, filled with zeros where the channel has fewer axes."""
    main = np.zeros(3)
    main[: min(3, len(values))] = values[:3]
    return main


def _adder(values: ArrayLike):
    return lambda x: x + np.asarray(values)


def _mover(frame: Frame, n: int):
    def move(x: Array) -> Array:
        y = x.copy()
        y[: min(3, n)] = frame.apply(_main_axes(x))[:n]
        return y

    return move
