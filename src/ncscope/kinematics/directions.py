"""How a program writes the tool direction of a complete transformation, and what it means.

Enters: rows of programmed values in channel order, degrees. Leaves: tool directions in the
workpiece system, rotary axis values, and the way back. A direction is a vector (mode 10), the two
angles of a named chain (14 to 19), or the angles of the machine's own rotary axes (12, 13).
Source: FCT-C27 sections 6 and 7, P-CHAN-00112, P-CHAN-00288.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics.chain import CLASSIC, POINT_VECTOR, Chain
from ncscope.kinematics.orientation import REACH_TOLERANCE_DEG, OrientationSolver
from ncscope.kinematics.readings import STANDARD, Reading
from ncscope.kinematics.step import Array

Status = NDArray[np.int8]

_LETTER_AXES = {"A": (1.0, 0.0, 0.0), "B": (0.0, 1.0, 0.0), "C": (0.0, 0.0, 1.0)}
_NEAREST = np.zeros(1, np.int8)
_SAME_DIRECTION = 1e-12
"""Directions that differ by less are one: rounding is far below, the resolution far above."""


@dataclass(frozen=True, slots=True, eq=False)
class ProgrammedDirection:
    """The words of a direction, and the rotary axes that follow from them.

    own: the machine's rotary axes. written: the chain of the programmed angles. words (3,):
    columns of the vector, or of the two angles and -1; a column below 0 does not exist.
    rotary (2,): columns of the rotary axes, -1 for one that the machine does not have.
    into (3, 3): from the words to the frame of `own` (see `turning`).
    """

    own: OrientationSolver
    written: OrientationSolver
    words: NDArray[np.int64]
    rotary: NDArray[np.int64]
    into: Array
    is_vector: bool
    is_classic: bool

    @classmethod
    def of(
        cls, chain: Chain, axis_names: tuple[str, ...], reading: Reading = STANDARD
    ) -> ProgrammedDirection:
        """The direction as the programming mode of the chain writes it."""
        mode, rotary = chain.programming_mode, _pair(chain.rotary)
        own = OrientationSolver.from_axes(
            chain.directions[list(chain.rotary)], chain.zero_orientation
        )
        written = _classic_solver(mode, reading) if mode in CLASSIC else own
        vector = mode == POINT_VECTOR
        angles = _classic_columns(mode, axis_names) if mode in CLASSIC else rotary
        return cls(
            own,
            written,
            np.array((3, 4, 5) if vector else (*angles, -1)),
            np.array(rotary),
            own.frame if vector else own.frame @ written.frame.T,
            vector,
            mode in CLASSIC,
        )

    @property
    def columns(self) -> tuple[int, ...]:
        """The columns that hold the words."""
        return tuple(int(c) for c in self.words if c >= 0)

    def asked(self, rows: Array, turn: Array | None = None) -> Array:
        """Directions (m, 3), of any length, that the rows ask for in the workpiece system."""
        if self.is_vector:
            directions = np.ascontiguousarray(rows[:, 3:6])
        else:
            directions = self.written.directions(_pick(rows, self.words[:2]))
        return directions if turn is None else _turned(directions, turn)

    def angles(self, axes: Array) -> Array:
        """Values (m, 2) of the rotary axes; 0 for one that the machine does not have."""
        return _pick(axes, self.rotary)

    def turn_rotary(
        self,
        rows: Array,
        axes: Array,
        status: Status,
        turn: Array | None,
        near: Array | None,
        pose: ArrayLike | None,
    ) -> None:
        """Writes the rotary columns of `axes` that give the programmed directions, and `status`.

        near (1, n) or (m, n); pose, turn: as for `UniversalKinematics.inverse_rows`.
        """
        start = np.zeros((1, 2)) if near is None else self.angles(near)
        chosen = self.own.pose_of(start) if pose is None else np.asarray(pose, np.int8).reshape(-1)
        for given, what in ((start, "near"), (chosen, "pose")):
            if len(given) != 1:
                check_rows(len(given), len(axes), what)
        into = self.into
        if turn is not None:
            into = self.own.frame @ turn
            into = into if self.is_vector else into @ self.written.frame.T
        if self.is_vector:
            axes[:, 3:6] = 0.0  # U, V, W are no axis values; columns without an axis stay 0 (D-13)
        self.own.turn(
            rows, self.words, self.written, into, self.rotary, start, chosen, axes, status
        )

    def name(
        self, program: Array, directions: Array, near: Array | None, turn: Array | None
    ) -> Status:
        """Writes the words of the unit directions (m, 3) into `program`, which holds axis values.

        near (1, n) or (m, n): programmed values; they stay where they mean the same direction.
        """
        if turn is not None:
            directions = _turned(directions, np.ascontiguousarray(turn.T))
        status = np.zeros(len(program), np.int8)
        if self.is_vector:
            program[:, 3:6] = directions
        elif self.is_classic or turn is not None:
            status = self._name_angles(program, directions, near)
        if near is not None:
            self._keep(program, directions, near)
        return status

    def with_direction(self, program: Array, directions: Array) -> Array:
        """`program` (m, n) with angles for the directions (m, 3), those nearest to the old ones.

        Whole turns are kept. NaN where the written chain does not reach the direction.
        """
        columns = list(self.columns)
        old = _pick(program, self.words[:2])
        angles, status = self.written.solve(directions, old, _NEAREST)
        angles += 360.0 * np.round((old - angles) / 360.0)
        angles[status != 0] = np.nan
        result = program.copy()
        result[:, columns] = angles[:, [k for k in (0, 1) if self.words[k] >= 0]]
        return result

    def reach_hint(self, direction: Array, axis_name: str) -> str:
        """The tilt that the machine can reach, and that of a direction (3,) out of reach."""
        low, high = self.own.reach
        span = f"{low:.4f}" if high - low < REACH_TOLERANCE_DEG else f"{low:.4f} to {high:.4f}"
        tilt = self.own.tilt(direction)
        can = f"the angle between tool and axis {axis_name} can be {span} degrees"
        return f"{can}; here it is {tilt:.4f}"

    def _name_angles(self, program: Array, directions: Array, near: Array | None) -> Status:
        start = _pick(program if near is None else near, self.words[:2])
        if len(start) != 1:
            check_rows(len(start), len(program), "near")
        angles, status = self.written.solve(directions, start, _NEAREST)
        for k, column in enumerate(self.words[:2]):
            if column >= 0:
                program[:, column] = angles[:, k]
        return status

    def _keep(self, program: Array, directions: Array, near: Array) -> None:
        """A direction stays as it was written where it means the same: `C200` stays `C200`."""
        meant = self.asked(near)
        with np.errstate(invalid="ignore", divide="ignore"):
            meant = meant / np.linalg.norm(meant, axis=1, keepdims=True)
        same = np.abs(meant - directions).max(axis=1) < _SAME_DIRECTION
        columns = list(self.columns)
        program[:, columns] = np.where(same[:, None], near[:, columns], program[:, columns])


def check_rows(given: int, wanted: int, what: str) -> None:
    """Raises ValueError for an argument with another number of rows."""
    if given != wanted:
        raise ValueError(f"{what} has {given} rows, but there are {wanted} rows to solve")


def _classic_solver(mode: int, reading: Reading) -> OrientationSolver:
    # The zero tool vector is the direction of the first named axis, literally (D-7).
    letters = CLASSIC[mode]
    directions = np.array([_LETTER_AXES[letter] for letter in letters])
    along_z = reading.classic_z and letters[1] != "C"
    return OrientationSolver.from_axes(directions, np.eye(3)[2] if along_z else directions[0])


def _classic_columns(mode: int, names: tuple[str, ...]) -> tuple[int, int]:
    """Channel columns of the programmed angles, in the order in which they turn (D-8)."""
    candidates = range(3, len(names))
    found = [
        next((a for a in candidates if names[a][:1].upper() == letter), -1)
        for letter in CLASSIC[mode]
    ]
    spare = iter([a for a in candidates if a < 5 and a not in found])
    first, second = (a if a >= 0 else next(spare, -1) for a in found)
    return first, second


def _turned(vectors: Array, turn: Array) -> Array:
    """turn @ vector for vectors (m, 3), summed in one order so that one row and a million agree."""
    x, y, z = vectors[:, 0], vectors[:, 1], vectors[:, 2]
    return np.stack([row[0] * x + row[1] * y + row[2] * z for row in turn], axis=1)


def _pair(indices: tuple[int, ...]) -> tuple[int, int]:
    first, second = (*indices, -1, -1)[:2]
    return first, second


def _pick(rows: Array, columns: NDArray[np.int64]) -> Array:
    """Two columns (m, 2); 0 where the column is -1 or not there."""
    out = np.zeros((len(rows), 2))
    for k, column in enumerate(columns):
        if 0 <= column < rows.shape[1]:
            out[:, k] = rows[:, column]
    return out
