"""KIN-ID 91: programmed values <-> axis values of any chain of three linear and some rotary axes.

Enters and leaves: arrays (..., n_channel) in channel index order, mm and degrees.
Two kinds: with RTCP the programmed angles are the axis angles and only X, Y, Z are computed; the
complete transformation takes the programmed angles as a tool direction in space.
Knows no NC programs, coordinate systems or offsets.
Source: FCT-C27 (universal kinematics), P-CHAN-00285..00295, P-CHAN-00112.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics import kernels
from ncscope.kinematics.chain import CLASSIC, DIRECT, POINT_VECTOR, Chain, validate
from ncscope.kinematics.orientation import REACH_TOLERANCE_DEG, OrientationSolver
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.step import KinematicsError

Array = NDArray[np.float64]
Status = NDArray[np.int8]

_SAME_DIRECTION = 1e-12
"""Directions that differ by less are one: rounding is far below, the resolution far above."""

_LETTER_AXES = {"A": (1.0, 0.0, 0.0), "B": (0.0, 1.0, 0.0), "C": (0.0, 0.0, 1.0)}


@dataclass(frozen=True, slots=True, eq=False)
class UniversalKinematics:
    """One machine with one way of programming it.

    mode: programming mode 10, 12..19 (with RTCP also -1..9). rtcp: False for the complete
    transformation; mode 10 is always complete. angle_columns: channel columns of the two
    programmed angles, -1 for an angle that the channel does not have.
    """

    id: int
    name: str
    axis_names: tuple[str, ...]
    chain: Chain
    mode: int
    rtcp: bool
    angle_columns: tuple[int, int]
    rotary_solver: OrientationSolver | None
    program_solver: OrientationSolver | None
    packed: tuple[Array, Array, Array, Array]

    @classmethod
    def from_parameters(
        cls,
        parameters: KinematicParameters,
        channel_axis_names: Sequence[str],
        default_mode: int = 0,
    ) -> UniversalKinematics:
        """The kinematics of a data set; raises KinematicsError with its first fault.

        default_mode: P-CHAN-00112, counts when the field programming_mode is 0.
        """
        names = tuple(channel_axis_names)
        faults = validate(parameters, len(names), default_mode, names)
        if faults:
            raise KinematicsError(faults[0].id, faults[0].message)
        chain = Chain.from_parameters(parameters, default_mode)
        mode = chain.programming_mode
        rtcp = chain.rtcp and mode != POINT_VECTOR
        own = None
        if not rtcp:
            own = OrientationSolver.from_axes(
                chain.directions[list(chain.rotary)], chain.zero_orientation
            )
        return cls(
            id=parameters.id,
            name=parameters.name,
            axis_names=names,
            chain=chain,
            mode=mode,
            rtcp=rtcp,
            angle_columns=_angle_columns(chain, mode, names),
            rotary_solver=own,
            program_solver=own if mode not in CLASSIC or rtcp else _classic_solver(mode),
            packed=chain.packed(),
        )

    def forward(self, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array]:
        """Tool tip (..., 3) and unit tool direction tip -> flange (..., 3), workpiece system.

        axes: (..., >= n) mm and degrees. tool_length: mm.
        """
        rows, shape = self._rows(axes, self.chain.n)
        tip, direction = self._forward_rows(rows, tool_length)
        return tip.reshape(*shape, 3), direction.reshape(*shape, 3)

    @property
    def orientation(self) -> tuple[int, ...]:
        """Channel columns of the programmed direction; none with RTCP."""
        if self.rtcp:
            return ()
        columns = (3, 4, 5) if self.mode == POINT_VECTOR else self.angle_columns
        return tuple(c for c in columns if c >= 0)

    def inverse(
        self,
        program: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Axis values (..., n_channel); arguments as for `inverse_rows`.

        Raises KinematicsError naming the rows that cannot be solved.
        """
        axes, status = self.inverse_rows(program, tool_length, near, pose, turn)
        self._raise_for(status, program, turn)
        return axes

    def inverse_rows(
        self,
        program: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> tuple[Array, Status]:
        """Axis values (..., n_channel) and a status (...): 0 ok, else see `kernels`.

        program: (..., n_channel) in channel order; axes outside the chain pass through.
        tool_length: mm.
        near: axis values (n_channel,) before the first row, or one row for each row. A rotary axis
            that the direction leaves free keeps this value, each row continuing from the one
            before. Axes at 0 when left out.
        pose: +1 or -1, one or one a row; the pose of `near` when left out (D-3).
        turn: rotation (3, 3) of the programmed direction, for callers that turn it with a
            coordinate system (P-CHAN-00247). Not used with RTCP.
        Rows without a solution have NaN in X, Y, Z.
        """
        rows, shape = self._rows(program, self._columns())
        axes, status = rows.copy(), np.zeros(len(rows), np.int8)
        if not self.rtcp:
            self._turn_rotary(axes, status, self._directions(rows, turn), near, pose)
        target = self._forward_rows(rows, 0.0)[0] if self.mode == DIRECT else rows
        joints, flange, _, unlinkage = self.packed
        kernels.solve_rows(joints, flange, unlinkage, target, float(tool_length), axes, status)
        return axes.reshape(*shape, axes.shape[1]), status.reshape(shape)

    def program(
        self,
        axes: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Programmed values (..., n_channel) that lead to these axis values.

        axes: (..., n_channel). near: programmed values (n_channel,) or one row for each row; where
        they mean the direction of the tool they stay, else of two angle pairs the nearest is taken
        (D-12), nearest to the axis angles when left out. turn: as for `inverse_rows`. The tool
        direction is given as a unit vector in mode 10.
        Raises KinematicsError naming the rows that cannot be solved.
        """
        rows, shape = self._rows(axes, self._columns())
        tip, direction = self._forward_rows(rows, tool_length)
        program, status = rows.copy(), np.zeros(len(rows), np.int8)
        if not self.rtcp:
            status |= self._name_direction(program, direction, near, turn)
        if self.mode == DIRECT:
            joints, flange, _, unlinkage = self.packed
            kernels.solve_rows(joints, flange, unlinkage, tip, 0.0, program, status)
        else:
            program[:, :3] = tip
        self._raise_for(status, program, turn)
        return program.reshape(*shape, program.shape[1])

    def programmed_direction(self, program: ArrayLike) -> Array:
        """Unit tool direction (..., 3) that the programmed values (..., n_channel) ask for.

        With RTCP it is the direction that the axis angles give.
        """
        rows, shape = self._rows(program, self._columns())
        if self.rtcp:
            direction = self._forward_rows(rows, 0.0)[1]
        else:
            direction = self._programmed_directions(rows)
        with np.errstate(invalid="ignore", divide="ignore"):
            direction = direction / np.linalg.norm(direction, axis=1, keepdims=True)
        return direction.reshape(*shape, 3)

    def pose_of(self, axes: ArrayLike) -> NDArray[np.int8]:
        """Pose +1 or -1 of axis values (..., >= n); +1 where there is only one."""
        rows, shape = self._rows(axes, self.chain.n)
        if self.rotary_solver is None:
            return np.ones(shape, np.int8)
        return self.rotary_solver.pose_of(self._rotary_values(rows)).reshape(shape)

    # Steps; rows are (m, columns)

    def _columns(self) -> int:
        return 6 if self.mode == POINT_VECTOR else self.chain.n

    def _rows(self, values: ArrayLike, columns: int) -> tuple[Array, tuple[int, ...]]:
        """The values as writable contiguous rows (one compiled variant), and the outer shape."""
        rows = np.require(values, np.float64, ["C", "W"])
        if rows.ndim == 0 or rows.shape[-1] < columns:
            raise ValueError(
                f"the last dimension of an array of shape {rows.shape} has to hold "
                f"at least {columns} axis values"
            )
        return rows.reshape(-1, rows.shape[-1]), rows.shape[:-1]

    def _forward_rows(self, rows: Array, tool_length: float) -> tuple[Array, Array]:
        tip, direction = np.empty((len(rows), 3)), np.empty((len(rows), 3))
        joints, flange, linkage, _ = self.packed
        kernels.forward_rows(joints, flange, linkage, rows, float(tool_length), tip, direction)
        return tip, direction

    def _programmed_directions(self, rows: Array) -> Array:
        if self.mode == POINT_VECTOR:
            return np.ascontiguousarray(rows[:, 3:6])
        assert self.program_solver is not None
        return self.program_solver.directions(_pick(rows, self.angle_columns))

    def _rotary_values(self, rows: Array) -> Array:
        return _pick(rows, _pair(self.chain.rotary))

    def _turn_rotary(
        self,
        axes: Array,
        status: Status,
        directions: Array,
        near: ArrayLike | None,
        pose: ArrayLike | None,
    ) -> None:
        """Writes the rotary columns that give the directions (m, 3), and the status."""
        assert self.rotary_solver is not None
        start = np.zeros((1, 2))
        if near is not None:
            start = self._rotary_values(self._rows(near, self.chain.n)[0])
        chosen = self.rotary_solver.pose_of(start)
        if pose is not None:
            chosen = np.atleast_1d(np.asarray(pose, np.int8)).reshape(-1)
        _check_rows(len(directions), len(axes), "direction")
        for given, what in ((start, "near"), (chosen, "pose")):
            if len(given) != 1:
                _check_rows(len(given), len(axes), what)
        angles, status[:] = self.rotary_solver.solve(directions, start, chosen)
        if self.mode == POINT_VECTOR:
            axes[:, 3:6] = 0.0  # U, V, W are no axis values; columns without an axis stay 0 (D-13)
        for k, column in enumerate(self.chain.rotary):
            axes[:, column] = angles[:, k]

    def _directions(self, rows: Array, turn: Array | None) -> Array:
        """Directions (m, 3) that the rows ask for in the workpiece system, of any length."""
        directions = self._programmed_directions(rows)
        return directions if turn is None else _turned(directions, turn)

    def _name_direction(
        self, program: Array, directions: Array, near: ArrayLike | None, turn: Array | None
    ) -> Status:
        """Writes the columns that program the unit directions (m, 3)."""
        if turn is not None:
            directions = _turned(directions, np.ascontiguousarray(turn.T))
        status = np.zeros(len(program), np.int8)
        if self.mode == POINT_VECTOR:
            program[:, 3:6] = directions
        elif self.mode in CLASSIC or turn is not None:
            status |= self._name_angles(program, directions, near)
        if near is not None:
            self._keep_words(program, directions, self._rows(near, self._columns())[0])
        return status

    def _keep_words(self, program: Array, directions: Array, near: Array) -> None:
        """Leaves a direction as it was written where it means the same: `C200` stays `C200`."""
        meant = self._programmed_directions(near)
        with np.errstate(invalid="ignore", divide="ignore"):
            meant = meant / np.linalg.norm(meant, axis=1, keepdims=True)
        same = np.abs(meant - directions).max(axis=1) < _SAME_DIRECTION
        columns = list(self.orientation)
        program[:, columns] = np.where(same[:, None], near[:, columns], program[:, columns])

    def _name_angles(self, program: Array, directions: Array, near: ArrayLike | None) -> Status:
        """Writes the two programmed angles for directions (m, 3)."""
        assert self.program_solver is not None
        start = _pick(program, self.angle_columns)
        if near is not None:
            start = _pick(self._rows(near, self.chain.n)[0], self.angle_columns)
            if len(start) != 1:
                _check_rows(len(start), len(program), "near")
        angles, status = self.program_solver.solve(directions, start, np.zeros(1, np.int8))
        for k, column in enumerate(self.angle_columns):
            if column >= 0:
                program[:, column] = angles[:, k]
        return status

    def _raise_for(self, status: Status, program: ArrayLike, turn: Array | None) -> None:
        if not status.any():
            return
        bad = np.flatnonzero(status.reshape(-1))
        code = int(status.reshape(-1)[bad[0]])
        id, message = explain_status(self, code)
        hint = ""
        if code == kernels.UNREACHABLE:
            rows, _ = self._rows(program, self._columns())
            hint = self._reach_hint(self._directions(rows[bad[:1]], turn)[0])
        raise KinematicsError(id, message, tuple(int(i) for i in bad), hint)

    def _reach_hint(self, direction: Array) -> str:
        """The tilt that the machine can reach, and the one that was asked for."""
        solver = self.rotary_solver
        if solver is None or not self.chain.rotary:
            return ""
        first = self.axis_names[self.chain.rotary[0]]
        low, high = solver.reach
        tilt = solver.tilt(direction)
        span = f"{low:.4f}" if high - low < REACH_TOLERANCE_DEG else f"{low:.4f} to {high:.4f}"
        return (
            f"the angle between tool and axis {first} can be {span} degrees; here it is {tilt:.4f}"
        )


def explain_status(kinematics: UniversalKinematics, status: int) -> tuple[str, str]:
    """The control's error number and one sentence for a row status other than 0."""
    names = kinematics.axis_names
    rotary = " and ".join(names[a] for a in kinematics.chain.rotary if a < len(names))
    if status == kernels.SINGULAR:
        linear = ", ".join(names[:3])
        return "292016", f"the linear axes {linear} cannot reach every point in this position"
    if status == kernels.UNREACHABLE:
        by = (
            f"the rotary axes {rotary} cannot" if rotary else "a machine without rotary axes cannot"
        )
        return "292014", f"{by} bring the tool into this direction"
    if status == kernels.ZERO_VECTOR:
        return "292007", "the tool direction is the zero vector"
    return "20703", "a programmed value is not a finite number"


def _classic_solver(mode: int) -> OrientationSolver:
    # The zero tool vector is the direction of the first named axis, literally (D-7).
    directions = np.array([_LETTER_AXES[letter] for letter in CLASSIC[mode]])
    return OrientationSolver.from_axes(directions, directions[0])


def _angle_columns(chain: Chain, mode: int, names: tuple[str, ...]) -> tuple[int, int]:
    """Channel columns of the programmed angles, in the order in which they turn (D-8)."""
    if mode not in CLASSIC:
        return _pair(chain.rotary)
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


def _pick(rows: Array, columns: tuple[int, int]) -> Array:
    """Two columns (m, 2); 0 where the column is -1 or not there."""
    out = np.zeros((len(rows), 2))
    for k, column in enumerate(columns):
        if 0 <= column < rows.shape[1]:
            out[:, k] = rows[:, column]
    return out


def _check_rows(given: int, wanted: int, what: str) -> None:
    if given != wanted:
        raise ValueError(f"{what} has {given} rows, but there are {wanted} rows to solve")
