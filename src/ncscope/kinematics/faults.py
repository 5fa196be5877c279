"""What can be wrong with the parameters of a chain, as the control says it at selection.

Enters: `KinematicParameters` (list units). Leaves: a tuple of `Fault`.
Source: FCT-C27 sections 3 and 9, P-CHAN-00285..00295.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ncscope.kinematics.chain import (
    CLASSIC,
    CONFORMAL,
    DIRECT,
    LINEAR,
    POINT_VECTOR,
    ROTARY,
    Array,
    unit,
)
from ncscope.kinematics.kernels import SINGULAR_DETERMINANT
from ncscope.kinematics.parameters import (
    FIELD_OF_INDEX,
    INDEX_OF_FIELD,
    MAX_AXES,
    KinematicParameters,
)

_MODES = (POINT_VECTOR, DIRECT, CONFORMAL, *CLASSIC)
_LETTER_MODES = range(-1, 10)
"""Three-angle rotation orders for robots: without meaning for the axes when rtcp is 1 (D-11)."""


@dataclass(frozen=True, slots=True)
class Fault:
    """Something wrong with the parameters.

    id: the control's error number. message: one sentence naming the axis or field.
    indices: the `param[]` numbers to blame. hint: what would be right.
    """

    id: str
    message: str
    indices: tuple[int, ...]
    hint: str


def validate(
    parameters: KinematicParameters,
    channel_axis_count: int,
    default_mode: int = 0,
    axis_names: Sequence[str] = (),
) -> tuple[Fault, ...]:
    """Everything wrong with a data set; empty when the transformation can be selected.

    default_mode: P-CHAN-00112, counts when the field programming_mode is 0.
    axis_names: channel axis names by index, where they are known.
    The control reports these errors when the transformation is selected.
    """
    return tuple(_Check(parameters, channel_axis_count, default_mode, tuple(axis_names)).faults())


_WHOLE = (
    "number_of_axes",
    *(f"axis[{a}].type" for a in range(MAX_AXES)),
    *(f"chain[{i}]" for i in range(MAX_AXES)),
    "programming_mode",
    "rtcp",
    "linkage_mode",
)


@dataclass(frozen=True, slots=True)
class _Check:
    parameters: KinematicParameters
    channel_axis_count: int
    default_mode: int
    axis_names: tuple[str, ...]

    def faults(self) -> Iterator[Fault]:
        not_numbers = [*self._not_finite(), *self._not_whole()]
        if not_numbers:
            yield from not_numbers
            return
        yield from self._vectors()
        yield from self._count()
        yield from self._types()
        yield from self._order()
        yield from self._mode()
        yield from self._linkage()
        yield from self._linear_axes()
        yield from self._channel()

    # What the numbers say

    def _get(self, name: str) -> float:
        return self.parameters.get(name)

    def _count_is_right(self) -> bool:
        return 3 <= self._get("number_of_axes") <= MAX_AXES

    def _axes(self) -> range:
        """The axes described; with a wrong count those that have a type, up to the first gap."""
        if self._count_is_right():
            return range(int(self._get("number_of_axes")))
        typed = [self._get(f"axis[{a}].type") != 0 for a in range(MAX_AXES)]
        return range(typed.index(False) if False in typed else MAX_AXES)

    def _name(self, axis: int) -> str:
        return f"axis {axis}" + (
            f" ({self.axis_names[axis]})" if axis < len(self.axis_names) else ""
        )

    def _vector(self, name: str) -> tuple[tuple[int, ...], Array]:
        first = INDEX_OF_FIELD[f"{name}[0]"]
        indices = (first, first + 1, first + 2)
        return indices, np.array([self.parameters.values[i] for i in indices])

    def _programming_mode(self) -> int:
        return int(self._get("programming_mode")) or self.default_mode

    def _complete(self) -> bool:
        return self._programming_mode() == POINT_VECTOR or self._get("rtcp") == 0

    def _rotary(self) -> list[int]:
        return [a for a in self._axes() if self._get(f"axis[{a}].type") == ROTARY]

    # The rules

    def _not_finite(self) -> Iterator[Fault]:
        for index, value in enumerate(self.parameters.values):
            if not math.isfinite(value):
                yield Fault(
                    "292010",
                    f"{FIELD_OF_INDEX[index]} is {value}, which is not a number",
                    (index,),
                    "write a finite number",
                )

    def _not_whole(self) -> Iterator[Fault]:
        for name in _WHOLE:
            value = self._get(name)
            if math.isfinite(value) and value != int(value):
                yield Fault(
                    "292010",
                    f"{name} is {value:g}, but it has to be a whole number",
                    (INDEX_OF_FIELD[name],),
                    "1 (linear) or 2 (rotary)"
                    if name.endswith(".type")
                    else f"{math.floor(value)} or {math.ceil(value)}",
                )

    def _vectors(self) -> Iterator[Fault]:
        indices, vector = self._vector("zero_orientation")
        if not vector.any():
            yield Fault(
                "292007",
                "zero_orientation is (0, 0, 0), so the tool has no direction",
                indices,
                "the vector from the tool tip to the flange, such as 0, 0, 1",
            )
        for axis in self._axes():
            indices, vector = self._vector(f"axis[{axis}].orientation")
            if not vector.any():
                yield Fault(
                    "292007",
                    f"{self._name(axis)} has the direction (0, 0, 0)",
                    indices,
                    f"a direction in axis[{axis}].orientation[0..2] that is not the zero vector; "
                    "see whether another axis was given this index by mistake",
                )

    def _count(self) -> Iterator[Fault]:
        index = INDEX_OF_FIELD["number_of_axes"]
        if not self._count_is_right():
            described = len(self._axes())
            yield Fault(
                "292009",
                f"number_of_axes is {self._get('number_of_axes'):g}, but 3 to 6 axes are possible",
                (index,),
                f"{described}, as many axes have a type" if described >= 3 else "3 to 6",
            )
        rotary = self._rotary()
        limit = 2 if self._complete() else 3
        if len(rotary) > limit:
            why = " in the complete transformation" if limit == 2 else ""
            named = ", ".join(self._name(a) for a in rotary)
            yield Fault(
                "292009",
                f"{named} are {len(rotary)} rotary axes, but at most {limit} can take part{why}",
                (index, INDEX_OF_FIELD["rtcp"]),
                "rtcp 1 with a mode other than 10" if limit == 2 else "at most three rotary axes",
            )

    def _types(self) -> Iterator[Fault]:
        for axis in self._axes():
            name = f"axis[{axis}].type"
            value = self._get(name)
            wanted = LINEAR if axis < 3 else ROTARY
            if value != wanted:
                kinds = {LINEAR: "linear", ROTARY: "rotary"}
                yield Fault(
                    "292040",
                    f"{self._name(axis)} is {kinds.get(int(value), f'of type {value:g}')}, but "
                    "exactly the axes 0, 1 and 2 have to be linear and the others rotary",
                    (INDEX_OF_FIELD[name],),
                    f"{name} {wanted} ({kinds[wanted]})",
                )

    def _order(self) -> Iterator[Fault]:
        n = len(self._axes())
        order = [self._get(f"chain[{i}]") for i in range(n)]
        if sorted(order) != list(range(n)):
            missing = [a for a in range(n) if a not in order]
            wrong = [i for i, a in enumerate(order) if a not in range(n) or a in order[:i]]
            places = [*wrong, *(i for i in range(n) if i not in wrong)]
            yield Fault(
                "292010",
                f"chain is {', '.join(f'{a:g}' for a in order)} and leaves out "
                f"{', '.join(self._name(a) for a in missing)}",
                tuple(INDEX_OF_FIELD[f"chain[{i}]"] for i in places),
                f"each of 0 to {n - 1} exactly once, the axis next to the workpiece first",
            )

    def _mode(self) -> Iterator[Fault]:
        for name in ("rtcp", "linkage_mode"):
            if self._get(name) not in (0.0, 1.0):
                yield Fault(
                    "292010",
                    f"{name} is {self._get(name):g}, but it is a switch",
                    (INDEX_OF_FIELD[name],),
                    "0 or 1",
                )
        mode = self._programming_mode()
        if mode in _MODES or (mode in _LETTER_MODES and not self._complete()):
            return
        field = "programming_mode"
        if not self._get(field) and self.default_mode:
            field += " is 0 and ori_rotation_angle (P-CHAN-00112)"
        yield Fault(
            "292045",
            f"{field} is {mode}, which the universal kinematics does not support"
            + (" with rtcp 0" if mode in _LETTER_MODES else ""),
            (INDEX_OF_FIELD["programming_mode"], INDEX_OF_FIELD["rtcp"]),
            "10 or 12 to 19" + (", or rtcp 1" if mode in _LETTER_MODES else ""),
        )

    def _linkage(self) -> Iterator[Fault]:
        if self._get("linkage_mode") != 1:
            return
        first = INDEX_OF_FIELD["linkage[0][0]"]
        matrix = np.array(self.parameters.values[first : first + 12]).reshape(3, 4)[:, :3]
        # Rows are scaled to length 1 so that the limit does not depend on the gear factors.
        lengths = np.linalg.norm(matrix, axis=1)
        scaled = matrix / lengths[:, None] if lengths.all() else np.zeros((3, 3))
        if abs(np.linalg.det(scaled)) < SINGULAR_DETERMINANT:
            yield Fault(
                "292010",
                "linkage_mode is 1, but the matrix linkage[0..2][0..2] cannot be inverted",
                tuple(range(first - 1, first + 12)),
                "a matrix with three independent rows, or linkage_mode 0",
            )

    def _linear_axes(self) -> Iterator[Fault]:
        vectors = [self._vector(f"axis[{a}].orientation") for a in range(3)]
        if len(self._axes()) < 3 or not all(vector.any() for _, vector in vectors):
            return
        units = [unit(vector) for _, vector in vectors]
        if abs(np.linalg.det(units)) < SINGULAR_DETERMINANT:
            pairs = ((0, 1), (0, 2), (1, 2))
            alike = [p for p in pairs if abs(units[p[0]] @ units[p[1]]) > 1 - SINGULAR_DETERMINANT]
            named, what, blamed = [self._name(a) for a in range(3)], "lie in one plane", (0, 1, 2)
            if alike:
                first, second = alike[0]
                named, what = [named[first], named[second]], "are parallel"
                blamed = (second, first, 3 - first - second)
            yield Fault(
                "292016",
                f"the directions of {', '.join(named[:-1])} and {named[-1]} {what}",
                tuple(i for a in blamed for i in vectors[a][0]),
                "three directions that span the space, such as X, Y and Z",
            )

    def _channel(self) -> Iterator[Fault]:
        needed, field, why = len(self._axes()), "number_of_axes", "the kinematics"
        if self._programming_mode() == POINT_VECTOR:
            needed, field, why = 6, "programming_mode", "programming_mode 10 (X, Y, Z, U, V, W)"
        if self.channel_axis_count < needed:
            yield Fault(
                "20658",
                f"the channel has {self.channel_axis_count} axes, but {why} needs {needed}",
                (INDEX_OF_FIELD[field],),
                f"at least {needed} axes in the channel, without a gap: gruppe[0].achse"
                f"[{self.channel_axis_count}] is missing",
            )
        named = tuple(name[:1].upper() for name in self.axis_names[3:6])
        if field == "programming_mode" and len(named) == 3 and named != tuple("UVW"):
            yield Fault(
                "292040",
                f"programming_mode 10 takes the axes 3, 4, 5 as U, V, W, but they are called "
                f"{', '.join(self.axis_names[3:6])}",
                (INDEX_OF_FIELD[field],),
                "six axes in the order X, Y, Z, U, V, W, or a mode with angles (12 to 19)",
            )
