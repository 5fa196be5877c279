"""The elements of an array variable: they never change, and the next ones are made cheaply.

A program that fills an array writes one element a block. The elements are kept in parts of about
the square root of their number, so that a write copies one part and the list of parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Elements(Generic[T]):
    """The values of an array in the order of their last index.

    parts: all of the length `step` but the last one.
    """

    parts: tuple[tuple[T, ...], ...]
    step: int
    count: int

    @classmethod
    def of(cls, values: Iterable[T]) -> Elements[T]:
        held = tuple(values)
        step = max(1, math.isqrt(len(held)))
        parts = (held[at : at + step] for at in range(0, len(held), step))
        return cls(tuple(parts), step, len(held))

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[T]:
        return (value for part in self.parts for value in part)

    def __getitem__(self, index: int) -> T:
        """The element at 0 <= index < len."""
        at, inside = divmod(index, self.step)
        return self.parts[at][inside]

    def with_element(self, index: int, value: T) -> Elements[T]:
        """The elements with another value at 0 <= index < len."""
        at, inside = divmod(index, self.step)
        part = self.parts[at]
        part = (*part[:inside], value, *part[inside + 1 :])
        return Elements((*self.parts[:at], part, *self.parts[at + 1 :]), self.step, self.count)
