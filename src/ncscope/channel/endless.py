"""Whether a program goes round for ever.

Enters the walker and the state behind each block. Leaves N4001 where a run cannot end, or does not
seem to. A run that comes back to a block with the same state does the same again, for nothing from
outside changes it: that is proof. Brent's way finds it by keeping one earlier state.
Where the state changes in every pass, blocks are counted since a block was reached for the first
time, for a long program always reaches new ones; a block counts as much as it takes to make.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np

from ncscope.channel.flow import Walker
from ncscope.channel.state import State
from ncscope.channel.subprograms import Frame
from ncscope.diagnostics import Diagnostic, Span, diagnostic
from ncscope.language.structure import LOOPS

MOST_BLOCKS = 10_000_000
"""Blocks without a new one among them after which a run ends, where no limit is given."""
SLOW = 25
"""What a block of the step lane counts, where the loop need not come to an end."""


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a run was: the next block, the calls around it, the state, the passes so far."""

    layout: object
    at: int
    calls: tuple[Frame, ...]
    state: State
    passes: Mapping[tuple[str, int], int]


class Watch:
    """Looks at a walker behind each of its blocks. awake: False where the user set a limit."""

    def __init__(self, walker: Walker, awake: bool) -> None:
        self.walker, self.awake = walker, awake
        self._seen: dict[int, bytearray] = {}
        self._begin()

    def _begin(self) -> None:
        """A block was reached for the first time: no loop is without an end up to here."""
        self._blocks = self._spent = self._steps = 0
        self._window = 1
        self._astray = self.walker.astray
        self._place: _Place | None = None

    def look(
        self, layout: object, at: int, state: State, blocks: int = 0, new: bool = False
    ) -> Diagnostic | None:
        """What is to be said behind the block `at`, or behind many blocks that are made quickly:
        those of the loop lane, which has seen all of them, and plain ones, which may be new."""
        if not self.awake:
            return None
        if (new or not blocks) and self._is_new(layout, at):
            self._begin()
            return None
        self._blocks += blocks or 1
        self._spent += blocks or SLOW
        self._steps += 1
        if self._place is not None and self._is_back(self._place, state):
            return self._repeats(self._place)
        if self._steps >= self._window:
            self._keep(state)
        if self._spent > MOST_BLOCKS and not self._counts():
            return self.too_many(self._blocks)
        return None

    def _is_new(self, layout: Any, at: int) -> bool:
        seen = self._seen.get(id(layout))
        if seen is None:
            seen = self._seen[id(layout)] = bytearray(len(layout.entries))
        if seen[at]:
            return False
        seen[at] = 1
        return True

    def _keep(self, state: State) -> None:
        walker = self.walker
        calls, passes = tuple(walker.calls), dict(walker.passes)
        self._place = _Place(walker.layout, walker.at, calls, state, passes)
        self._window, self._steps = 2 * self._window, 0

    def _is_back(self, place: _Place, state: State) -> bool:
        walker = self.walker
        if walker.at != place.at or walker.layout is not place.layout:
            return False
        return same(place.state, state) and same(place.calls, tuple(walker.calls))

    def _counts(self) -> bool:
        """Whether $FOR loops alone go on, each of them towards its last value."""
        return self.walker.astray == self._astray and self._blocks <= MOST_BLOCKS

    # --- what is said --------------------------------------------------------------------------

    def _repeats(self, place: _Place) -> Diagnostic:
        loop = self._repeated(place.passes) or self._here()
        message = f"the loop in line {loop.line} never ends: it comes back to the same state"
        hint = "what it waits for cannot happen here; a variable of the PLC is given by --set"
        return diagnostic("N4001", loop, message, hint)

    def too_many(self, blocks: int, at: Span | None = None) -> Diagnostic:
        """N4001 with the loop that goes on; at: the block behind the limit that the user set."""
        loop = self._longest()
        hint = "check how the loop ends, or raise --max-blocks"
        if loop is None:
            message = f"more than {blocks} blocks were executed"
            return diagnostic("N4001", at or self._here(), message, hint)
        message = f"more than {blocks} blocks were executed: the loop in line {loop.line} goes on"
        if at is None:
            hint = "check how the loop ends; a longer program needs --max-blocks with its number"
        return diagnostic("N4001", at or self._here(), message, hint, notes=(("the loop", loop),))

    def _here(self) -> Span:
        walker = self.walker
        return walker.layout.entries[min(walker.at, walker.level[1] - 1)].span

    def _repeated(self, before: Mapping[tuple[str, int], int]) -> Span | None:
        """Of the loops that went on since then the outermost one around, else a jump."""
        passes = self.walker.passes
        went = {key for key, n in passes.items() if n != before.get(key, 0)}
        around = [key for key in self._around() if key in went]
        return self._span(around[0] if around else max(went, default=None))

    def _longest(self) -> Span | None:
        """Of the loops around the one with most passes, else the jump with most passes."""
        passes = self.walker.passes
        keys = [key for key in self._around() if key in passes] or list(passes)
        return self._span(max(keys, key=lambda key: passes[key], default=None))

    def _span(self, key: tuple[str, int] | None) -> Span | None:
        layout = self.walker.layouts.get(key[0]) if key is not None else None
        return layout.entries[key[1]].span if key is not None and layout is not None else None

    def _around(self) -> list[tuple[str, int]]:
        """The loops around the place of the program and of its calls, outermost first."""
        walker = self.walker
        places = [(frame.layout, frame.at - 1) for frame in walker.calls]
        places.append((walker.layout, min(walker.at, walker.level[1] - 1)))
        found = []
        for layout, at in places:
            own = layout.statements.get(at)
            around = layout.around[at] if 0 <= at < len(layout.around) else ()
            for statement in (*around, *((own,) if own is not None else ())):
                if statement.keyword in LOOPS:
                    found.append((layout.source.name, statement.first))
        return found


def too_long(limit: int, span: Span) -> Diagnostic:
    """N4001 for a program without loops."""
    hint = "raise --max-blocks, or leave it out"
    return diagnostic("N4001", span, f"the program has more than {limit} blocks", hint)


# --- equality of states ------------------------------------------------------------------------


def same(one: Any, other: Any) -> bool:
    """Whether two values hold the same, to the last bit of their numbers."""
    if one is other:
        return True
    if type(one) is not type(other):
        return isinstance(one, Mapping) and isinstance(other, Mapping) and _alike(one, other)
    if isinstance(one, np.ndarray):
        return one.shape == other.shape and one.tobytes() == other.tobytes()
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, Mapping):
        return _alike(one, other)
    if is_dataclass(one):
        return _same_fields(one, other)
    return bool(one == other)


def _same_fields(one: Any, other: Any) -> bool:
    return all(same(getattr(one, name), getattr(other, name)) for name in _names(type(one)))


def _alike(one: Mapping[Any, Any], other: Mapping[Any, Any]) -> bool:
    if len(one) != len(other):
        return False
    return all(key in other and same(value, other[key]) for key, value in one.items())


_FIELDS: dict[Any, tuple[str, ...]] = {}
_SOONEST = ("variables", "position", "block", "modal")


def _names(kind: Any) -> tuple[str, ...]:
    """The fields of a dataclass; what tells states apart soonest stands first in a `State`."""
    names = _FIELDS.get(kind)
    if names is None:
        all_names = [field.name for field in fields(kind)]
        soonest = [name for name in _SOONEST if name in all_names]
        names = _FIELDS[kind] = (*soonest, *(n for n in all_names if n not in soonest))
    return names
