"""Kinematics of the user (ids 500 to 999): a class of theirs as a kinematic step.

Enters: a class with `forward` and `inverse` over arrays. Leaves: a builder of steps that check
every answer of the class: what is raised, shapes, and values that are not finite become
KinematicsError N2601 or N2602 with the rows, never an exception of another kind. An `inverse` that
`forward` does not undo is 292023, as on the control.
Source: TF5200 TcCOM transformations (500 to 999), P-CHAN-00228, P-CHAN-00262.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ncscope.kinematics.building import FIRST_ID, LAST_ID
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.step import Builder, KinematicsError, Pose

Array = NDArray[np.float64]

FAULTY, NO_SOLUTION, NOT_INVERSE = "N2601", "N2602", "292023"
DEVIATION = 3e-4
"""mm and degrees: what `forward` may miss by, unless the channel says otherwise (P-CHAN-00228)."""


def faults_of(cls: type) -> tuple[str, ...]:
    """What a class lacks to be a kinematics of the user; empty when nothing."""
    found = []
    id = getattr(cls, "id", None)
    if not isinstance(id, int) or isinstance(id, bool) or not FIRST_ID <= id <= LAST_ID:
        found.append(f"its attribute id is {id!r}, but has to be a number from 500 to 999")
    for name in ("forward", "inverse"):
        if not callable(getattr(cls, name, None)):
            found.append(f"it has no method {name}")
    return tuple(found)


def builder_of(cls: type, deviation: float = DEVIATION) -> Builder:
    """Makes steps of a class that `faults_of` finds nothing wrong with.

    deviation: mm and degrees between programmed values and `forward` of their axis values.
    """

    def build(
        parameters: KinematicParameters, axis_names: Sequence[str], default_mode: int
    ) -> UserKinematics:
        names = tuple(axis_names)
        try:
            user = cls(parameters.values, names)
        except (Exception, SystemExit) as error:
            raise _failed(cls.__name__, "cannot be set up", error) from error
        name = parameters.name or str(getattr(cls, "name", "") or cls.__name__)
        return UserKinematics(parameters.id, name, len(names), user, deviation)

    return build


@dataclass(frozen=True, slots=True, eq=False)
class UserKinematics:
    """A kinematic step that asks an object of the user; arrays (..., n_channel), mm and degrees.

    Programmed angles are the positions of rotary axes, as with RTCP. There is one pose.
    """

    id: int
    name: str
    n: int
    user: Any = field(repr=False)
    deviation: float = DEVIATION

    @property
    def orientation(self) -> tuple[int, ...]:
        return ()

    def forward(self, axes: ArrayLike, tool_length: float = 0.0) -> tuple[Array, Array | None]:
        """Tool tip (..., 3), and the direction (..., 3) when the class has `direction`."""
        rows, shape = self._rows(axes)
        tip = self._ask("forward", rows, (len(rows), self.n), rows, float(tool_length))[:, :3]
        direction = None
        if callable(getattr(self.user, "direction", None)):
            answer = self._ask("direction", rows, (len(rows), 3), rows)
            direction = self._unit(answer).reshape(*shape, 3)
        return tip.reshape(*shape, 3), direction

    def inverse(
        self,
        program: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        pose: Pose | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Axis values (..., n_channel) for programmed values (..., n_channel)."""
        rows, shape = self._rows(program)
        start = np.zeros(self.n) if near is None else self._rows(near)[0][0].copy()
        shape_of_rows, length = (len(rows), self.n), float(tool_length)
        axes = self._ask("inverse", rows, shape_of_rows, rows, length, start)
        self._compare(rows, axes, length, start)
        return axes.reshape(*shape, self.n)

    def program(
        self,
        axes: ArrayLike,
        tool_length: float = 0.0,
        near: ArrayLike | None = None,
        turn: Array | None = None,
    ) -> Array:
        """Programmed values (..., n_channel) that lead to these axis values."""
        rows, shape = self._rows(axes)
        answer = self._ask("forward", rows, (len(rows), self.n), rows, float(tool_length))
        return answer.reshape(*shape, self.n)

    def pose_of(self, axes: ArrayLike) -> NDArray[np.int8]:
        """Always +1."""
        return np.ones(np.shape(axes)[:-1], np.int8)

    def _rows(self, values: ArrayLike) -> tuple[Array, tuple[int, ...]]:
        array = np.asarray(values, np.float64)
        if array.ndim == 0 or array.shape[-1] < self.n:
            raise ValueError(f"the last dimension of {array.shape} has to hold {self.n} values")
        return array[..., : self.n].reshape(-1, self.n), array.shape[:-1]

    def _ask(self, method: str, rows: Array, shape: tuple[int, int], *arguments: Any) -> Array:
        """The checked answer of a method of the user; it gets copies, so rows stay as they are."""
        who = f"{type(self.user).__name__}.{method}"
        given = [a.copy() if isinstance(a, np.ndarray) else a for a in arguments]
        try:
            with np.errstate(all="ignore"):
                answer = np.asarray(getattr(self.user, method)(*given))
        except (Exception, SystemExit) as error:
            raise _failed(who, "failed", error) from error
        if answer.dtype.kind not in "iuf":
            message = f"{who} returned values of type {answer.dtype}, not numbers"
            raise KinematicsError(FAULTY, message, (0,), "return an array of float")
        answer = answer.astype(np.float64)
        if answer.shape != shape:
            message = f"{who} returned an array of shape {answer.shape} instead of {shape}"
            raise KinematicsError(FAULTY, message, (0,), "return one row for each row")
        bad = np.flatnonzero(~np.isfinite(answer).all(axis=1) & np.isfinite(rows).all(axis=1))
        if len(bad):
            values = ", ".join(f"{v:g}" for v in rows[bad[0]])
            message = f"{who} has no solution for ({values})"
            raise KinematicsError(NO_SOLUTION, message, tuple(int(i) for i in bad))
        return answer

    def _compare(self, program: Array, axes: Array, length: float, near: Array) -> None:
        """Fails where `forward` gives other programmed values, unless they mean the same axes: the
        words of a point may differ by a whole turn."""
        back = self._ask("forward", axes, axes.shape, axes, length)
        apart = np.flatnonzero((np.abs(back - program) > self.deviation).any(axis=1))
        if not len(apart):
            return
        other = back[apart]
        again = self._ask("inverse", other, other.shape, other, length, near)
        bad = apart[(np.abs(again - axes[apart]) > self.deviation).any(axis=1)]
        if len(bad):
            given, found = (", ".join(f"{v:g}" for v in a[bad[0]]) for a in (program, back))
            name = type(self.user).__name__
            message = f"{name}.forward gives ({found}) for the axes that {name}.inverse"
            raise KinematicsError(
                NOT_INVERSE,
                f"{message} gives for ({given})",
                tuple(int(i) for i in bad),
                "one has to undo the other; permitted_trafo_deviation_limit (P-CHAN-00228) is "
                f"{self.deviation:g} mm and degrees",
            )

    def _unit(self, vectors: Array) -> Array:
        length = np.linalg.norm(vectors, axis=1, keepdims=True)
        if (length == 0).any():
            who = f"{type(self.user).__name__}.direction"
            rows = tuple(int(i) for i in np.flatnonzero(length == 0))
            raise KinematicsError(FAULTY, f"{who} returned the zero vector", rows)
        return vectors / length


def _failed(who: str, what: str, error: BaseException) -> KinematicsError:
    text = str(error).splitlines()[0] if str(error) else "no message"
    message = f"{who} {what}: {type(error).__name__}: {text[:200]}"
    return KinematicsError(FAULTY, message, (0,), "see the class of this kinematics")
