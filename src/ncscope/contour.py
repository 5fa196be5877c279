"""What happens to programmed values before any offset: scale, turn in the plane, mirror.

The order of composition: x1 = S x, x2 = C + Rot (x1 - C), x3 = M x2. Only `Coordinates`
applies a contour. Arrays are (..., n) with one column per channel axis; mm and degrees.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ncscope.frames import Array, sin_cos


class Step(NamedTuple):
    """One part of a contour: how it is shown, and the function (..., n) -> (..., n)."""

    name: str
    origin: str | None
    apply: Callable[[Array], Array]


@dataclass(frozen=True)
class Turn:
    """Contour rotation (#ROTATION, G68): x' = C + R (x - C).

    angle: degrees, positive from the first to the second axis of the plane. centre: mm, absolute
    coordinates of C. axes: channel indices of the plane.
    """

    angle: float = 0.0
    centre: tuple[float, float] = (0.0, 0.0)
    axes: tuple[int, int] = (0, 1)
    origin: str | None = None

    def apply(self, values: ArrayLike, inverse: bool = False) -> Array:
        s, c = sin_cos(-self.angle if inverse else self.angle)
        result = np.array(values, dtype=float)
        (i, j), (ci, cj) = self.axes, self.centre
        di, dj = result[..., i] - ci, result[..., j] - cj
        result[..., i], result[..., j] = ci + c * di - s * dj, cj + s * di + c * dj
        return result


@dataclass(frozen=True)
class Contour:
    """The contour functions that are active; the empty contour changes nothing.

    scale: factor > 0 by channel axis (#SCALE). mirror: axes whose sign is turned (G21..G23,
    G351). mirror_shift: axes whose G92 value is turned too (G351).
    """

    scale: Mapping[int, float] = field(default_factory=dict)
    turn: Turn | None = None
    mirror: frozenset[int] = frozenset()
    mirror_shift: frozenset[int] = frozenset()
    scale_origin: str | None = None
    mirror_origin: str | None = None

    def apply(self, values: ArrayLike) -> Array:
        """Contour values (..., n) of programmed values (..., n), themselves without a step."""
        result = np.asarray(values, dtype=float)
        for step in self.steps:
            result = step.apply(result)
        return result

    def invert(self, values: ArrayLike) -> Array:
        """Programmed values (..., n) of contour values (..., n)."""
        result = self._mirrored(np.array(values, dtype=float), self.mirror)
        if self.turn is not None:
            result = self.turn.apply(result, inverse=True)
        return result / self.factors(result.shape[-1])

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """What acts, in its order: scale, turn, mirror."""
        return tuple(self._steps())

    def _steps(self) -> Iterator[Step]:
        if any(f != 1.0 for f in self.scale.values()):
            yield Step("scale", self.scale_origin, lambda x: x * self.factors(x.shape[-1]))
        if self.turn is not None:
            yield Step("contour rotation", self.turn.origin, self.turn.apply)
        if self.mirror:
            yield Step("mirror", self.mirror_origin, lambda x: self._mirrored(x, self.mirror))

    def factors(self, n: int) -> Array:
        """The scale factor of each of n channel axes."""
        result = np.ones(n)
        for axis, factor in self.scale.items():
            result[axis] = factor
        return result

    def shift(self, kind: str, values: Sequence[float]) -> Array:
        """The offset as it acts: G351 turns the sign of the reference point offset (G92)."""
        array = np.array(values, dtype=float)
        return self._mirrored(array, self.mirror_shift) if kind == "g92" else array

    def without_turn(self) -> Contour:
        return replace(self, turn=None)

    def moved(self, sources: Sequence[int | None]) -> Contour:
        """The contour for other channel axes: sources[new] is the old index, None for an axis
        that came in. An axis that came in has no scale and no mirror."""
        new = {old: i for i, old in enumerate(sources) if old is not None}
        turn = self.turn
        if turn is not None:
            kept = all(new.get(axis) == axis for axis in turn.axes)
            turn = turn if kept else None
        return replace(
            self,
            scale={new[a]: f for a, f in self.scale.items() if a in new},
            mirror=frozenset(new[a] for a in self.mirror if a in new),
            mirror_shift=frozenset(new[a] for a in self.mirror_shift if a in new),
            turn=turn,
        )

    @staticmethod
    def _mirrored(values: Array, axes: frozenset[int]) -> Array:
        result = np.array(values, dtype=float)
        result[..., sorted(axes)] *= -1.0
        return result


NO_CONTOUR = Contour()
