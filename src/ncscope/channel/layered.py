"""A mapping that never changes and from which the next one is made cheaply.

Each block leaves a new state, and most blocks change one variable. Up to a few names the mapping is
copied. Beyond that it is a large part that is shared and a small one with what was changed since;
the small part is merged when its size reaches the square root of the whole.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

V = TypeVar("V")

SMALL = 64
"""Names up to which the whole mapping is copied."""
_GONE: Any = object()


class Layered(Mapping[str, V]):
    """Values by name; `recent` hides `base` and holds a mark for what was removed."""

    __slots__ = ("_base", "_count", "_recent")

    def __init__(self, base: dict[str, V], recent: dict[str, V], count: int) -> None:
        self._base, self._recent, self._count = base, recent, count

    def __getitem__(self, key: str) -> V:
        value = self._recent[key] if key in self._recent else self._base[key]
        if value is _GONE:
            raise KeyError(key)
        return value

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[str]:
        for key in self._base:
            if key not in self._recent:
                yield key
        for key, value in self._recent.items():
            if value is not _GONE:
                yield key

    def changed(self, key: str, value: V, added: int) -> Mapping[str, V]:
        recent = {**self._recent, key: value}
        count = self._count + added
        if len(recent) ** 2 > SMALL + len(self._base):
            whole = {**self._base, **recent}
            return Layered({k: v for k, v in whole.items() if v is not _GONE}, {}, count)
        return Layered(self._base, recent, count)


def with_value(mapping: Mapping[str, V], key: str, value: V) -> Mapping[str, V]:
    """The mapping with another value under one name."""
    if isinstance(mapping, Layered):
        return mapping.changed(key, value, key not in mapping)
    if len(mapping) < SMALL:
        return {**mapping, key: value}
    return Layered(dict(mapping), {}, len(mapping)).changed(key, value, key not in mapping)


def without(mapping: Mapping[str, V], key: str) -> Mapping[str, V]:
    """The mapping without one of its names."""
    if isinstance(mapping, Layered):
        return mapping.changed(key, _GONE, -1)
    return {k: v for k, v in mapping.items() if k != key}
