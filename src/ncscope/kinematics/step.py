"""What a kinematics has to offer to stand between programmed values and axis values.

`UniversalKinematics` (KIN-ID 91) offers it, `TwoSteps` links two of them, and a kinematics of the
user (ids 500 to 999) offers it through its own class. The same protocol serves a transformation of
programmed coordinates (`#TRAFO PCS`): there `inverse` maps what the program writes, and the tool
length is 0.

All arrays are (..., n) with one column per channel axis, mm and degrees. One row and a million rows
give the same numbers, row by row.
Source: TF5240 kinematic transformation, multi-step transformations, #TRAFO PCS; FCT-C27.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics.parameters import KinematicParameters

Array = NDArray[np.float64]
Pose = Any
"""What `pose_of` gives for one row: a small number, or an array of them."""


class KinematicsError(Exception):
    """Rows that have no solution, or parameters that describe no machine.

    id: the control's error number. rows: indices of the failing rows (of the flattened input).
    hint: what would have been right, or ''.
    """

    def __init__(self, id: str, message: str, rows: tuple[int, ...] = (), hint: str = "") -> None:
        super().__init__(f"{id}: {message}")
        self.id = id
        self.message = message
        self.rows = rows
        self.hint = hint

    def __reduce__(self) -> tuple[type, tuple[str, str, tuple[int, ...], str]]:
        return type(self), (self.id, self.message, self.rows, self.hint)


class KinematicStep(Protocol):
    """One kinematic step, ready for use. Every method raises KinematicsError for rows it cannot
    solve and names them.

    orientation: channel columns whose programmed values are a direction in space and not the
    positions of these axes; empty where programmed angles are axis angles (RTCP).
    """

    @property
    def id(self) -> int: ...

    @property
    def name(self) -> str: ...

    @property
    def orientation(self) -> tuple[int, ...]: ...

    def forward(self, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array | None]:
        """Tool tip (..., 3) and unit direction tip -> flange (..., 3), None without a tool."""
        ...

    def inverse(
        self,
        program: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        pose: Pose | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Axis values (..., n) for programmed values (..., n).

        near: axis values (n,) before the first row, or (..., n) one for each row; decides what
        the program leaves open, each row continuing from the one before. pose: which of several
        solutions, as `pose_of` names it; that of `near` when left out. turn: rotation (3, 3)
        applied to the programmed direction (P-CHAN-00247).
        """
        ...

    def program(
        self,
        axes: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Programmed values (..., n) that lead to these axis values (..., n).

        near: programmed values (n,); of several ways to write a direction the nearest is taken,
        and the one of `near` itself where it means the same direction.
        """
        ...

    def pose_of(self, axes: ArrayLike) -> NDArray[np.int8]:
        """Which of several solutions the axis values (..., n) are."""
        ...


Builder = Callable[[KinematicParameters, Sequence[str], int], KinematicStep]
"""Makes a step of a data set, the channel axis names and the mode of P-CHAN-00112.

Raises KinematicsError for parameters that describe no machine.
"""


@dataclass(frozen=True, slots=True, eq=False)
class TwoSteps:
    """A kinematics of two steps: axes <-> first <-> second <-> program.

    Steps are numbered from the axes upwards: programmed values go through `second`, and its axis
    values are what is programmed for `first`. The tool belongs to `first`, whose parameters the
    tool data add to. Source: TF5200 multi-step transformations.
    """

    first: KinematicStep
    second: KinematicStep

    @property
    def id(self) -> int:
        return self.first.id

    @property
    def name(self) -> str:
        return f"{self.first.name or self.first.id}, {self.second.name or self.second.id}"

    @property
    def orientation(self) -> tuple[int, ...]:
        return self.second.orientation

    def forward(self, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array | None]:
        """Tip and direction of the tool in the system of the program.

        The direction is that from the tip of the tool to the tip of one that is 1 mm shorter: the
        second step carries both points. None where the first step has no tool.
        """
        tip = self._tip(axes, tool_length)
        if self.first.forward(axes, tool_length)[1] is None:
            return tip, None
        along = self._tip(axes, tool_length - 1.0) - tip
        with np.errstate(invalid="ignore", divide="ignore"):
            return tip, along / np.linalg.norm(along, axis=-1, keepdims=True)

    def _tip(self, axes: ArrayLike, tool_length: float) -> Array:
        return self.second.forward(self.first.program(axes, tool_length))[0]

    def inverse(
        self,
        program: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        pose: Pose | None = None,
        turn: Array | None = None,
    ) -> Array:
        """As `KinematicStep.inverse`; pose (2,) of the first and the second step."""
        before = None if near is None else self.first.program(near, tool_length)
        of_first, of_second = (None, None) if pose is None else np.asarray(pose)
        between = self.second.inverse(program, 0.0, before, of_second, turn)
        return self.first.inverse(between, tool_length, near, of_first)

    def program(
        self,
        axes: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> Array:
        """As `KinematicStep.program`."""
        return self.second.program(self.first.program(axes, tool_length), 0.0, near, turn)

    def pose_of(self, axes: ArrayLike) -> NDArray[np.int8]:
        """Poses (..., 2) of the first and the second step."""
        between = self.first.program(axes)
        return np.stack([self.first.pose_of(axes), self.second.pose_of(between)], axis=-1)
