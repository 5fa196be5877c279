"""KIN-ID 91: programmed values <-> axis values of any chain of three linear and some rotary axes.

Enters and leaves: arrays (..., n_channel) in channel index order, mm and degrees.
Two kinds: with RTCP the programmed angles are the axis angles and only X, Y, Z are computed; the
complete transformation takes the programmed angles as a tool direction in space.
Knows no NC programs, coordinate systems or offsets.
Source: FCT-C27 (universal kinematics), P-CHAN-00285..00295, P-CHAN-00112.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics import kernels
from ncscope.kinematics.chain import CONFORMAL, DIRECT, POINT_VECTOR, Chain
from ncscope.kinematics.directions import ProgrammedDirection
from ncscope.kinematics.faults import validate
from ncscope.kinematics.orientation import OrientationSolver
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.readings import STANDARD, Reading
from ncscope.kinematics.step import KinematicsError

Array = NDArray[np.float64]
Status = NDArray[np.int8]
Packed = tuple[Array, Array, Array, Array]


@dataclass(frozen=True, slots=True, eq=False)
class UniversalKinematics:
    """One machine with one way of programming it.

    mode: programming mode 10, 12..19 (with RTCP also -1..9). rtcp: False for the complete
    transformation; mode 10 is always complete. direction: how the tool direction is programmed,
    None with RTCP. packed: the chain for the compiled loops. position: the chain that programmed
    positions go through, with tool length 0; None where they are X, Y, Z.
    """

    id: int
    name: str
    axis_names: tuple[str, ...]
    chain: Chain
    mode: int
    rtcp: bool
    direction: ProgrammedDirection | None
    packed: Packed
    position: Packed | None

    @classmethod
    def from_parameters(
        cls,
        parameters: KinematicParameters,
        channel_axis_names: Sequence[str],
        default_mode: int = 0,
        reading: Reading = STANDARD,
    ) -> UniversalKinematics:
        """The kinematics of a data set; raises KinematicsError with its first fault.

        default_mode: P-CHAN-00112, counts when the field programming_mode is 0.
        """
        names = tuple(channel_axis_names)
        faults = validate(parameters, len(names), default_mode, names)
        if faults:
            raise KinematicsError(faults[0].id, faults[0].message)
        chain = Chain.from_parameters(parameters, default_mode, reading)
        mode = chain.programming_mode
        rtcp = chain.rtcp and mode != POINT_VECTOR
        return cls(
            id=parameters.id,
            name=parameters.name,
            axis_names=names,
            chain=chain,
            mode=mode,
            rtcp=rtcp,
            direction=None if rtcp else ProgrammedDirection.of(chain, names, reading),
            packed=chain.packed(),
            position=_position_chain(chain, reading),
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
        return () if self.direction is None else self.direction.columns

    @property
    def rotary_solver(self) -> OrientationSolver | None:
        """The rotary axes as a solver of directions; None with RTCP."""
        return None if self.direction is None else self.direction.own

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
        if self.direction is not None:
            start = None if near is None else self._rows(near, self.chain.n)[0]
            self.direction.turn_rotary(rows, axes, status, turn, start, pose)
        target = rows if self.position is None else _tool(self.position, rows, 0.0)[0]
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
        if self.direction is not None:
            words = None if near is None else self._rows(near, self._columns())[0]
            status |= self.direction.name(program, direction, words, turn)
        if self.position is not None:
            joints, flange, _, unlinkage = self.position
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
        if self.direction is None:
            direction = self._forward_rows(rows, 0.0)[1]
        else:
            direction = self.direction.asked(rows)
        with np.errstate(invalid="ignore", divide="ignore"):
            direction = direction / np.linalg.norm(direction, axis=1, keepdims=True)
        return direction.reshape(*shape, 3)

    def pose_of(self, axes: ArrayLike) -> NDArray[np.int8]:
        """Pose +1 or -1 of axis values (..., >= n); +1 where there is only one."""
        rows, shape = self._rows(axes, self.chain.n)
        if self.direction is None:
            return np.ones(shape, np.int8)
        return self.direction.own.pose_of(self.direction.angles(rows)).reshape(shape)

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
        return _tool(self.packed, rows, tool_length)

    def _raise_for(self, status: Status, program: ArrayLike, turn: Array | None) -> None:
        if not status.any():
            return
        bad = np.flatnonzero(status.reshape(-1))
        code = int(status.reshape(-1)[bad[0]])
        id, message = explain_status(self, code)
        hint = ""
        if code == kernels.UNREACHABLE and self.direction is not None and self.chain.rotary:
            rows, _ = self._rows(program, self._columns())
            asked = self.direction.asked(rows[bad[:1]], turn)[0]
            hint = self.direction.reach_hint(asked, self.axis_names[self.chain.rotary[0]])
        raise KinematicsError(id, message, tuple(int(i) for i in bad), hint)


def _tool(packed: Packed, rows: Array, tool_length: float) -> tuple[Array, Array]:
    """Tool tip and direction, each (m, 3), of axis values (m, n) through a chain."""
    tip, direction = np.empty((len(rows), 3)), np.empty((len(rows), 3))
    joints, flange, linkage, _ = packed
    kernels.forward_rows(joints, flange, linkage, rows, float(tool_length), tip, direction)
    return tip, direction


def _position_chain(chain: Chain, reading: Reading) -> Packed | None:
    if chain.programming_mode == DIRECT:
        return chain.packed()
    if chain.programming_mode == CONFORMAL and reading.conformal_chain:
        origin = np.zeros(3)
        return replace(chain, zero_position=origin, points=0.0 * chain.points).packed()
    return None


def explain_status(kinematics: UniversalKinematics, status: int) -> tuple[str, str]:
    """The control's error number and one sentence for a row status other than 0."""
    names = kinematics.axis_names
    rotary = [names[a] for a in kinematics.chain.rotary if a < len(names)]
    if status == kernels.SINGULAR:
        linear = ", ".join(names[:3])
        return "292016", f"the linear axes {linear} cannot reach every point in this position"
    if status == kernels.UNREACHABLE:
        by = "a machine without rotary axes"
        if rotary:
            by = f"the rotary {'axis' if len(rotary) == 1 else 'axes'} {' and '.join(rotary)}"
        return "292014", f"{by} cannot bring the tool into this direction"
    if status == kernels.ZERO_VECTOR:
        return "292007", "the tool direction is the zero vector"
    return "20703", "a programmed value is not a finite number"
