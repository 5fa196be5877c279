"""Runs of plain blocks as single entries again.

A table of a program holds a long run of plain blocks as one entry. Where each of its blocks counts,
because a modal cycle is called behind every motion or a sequence begins or ends among them, all
tables are replaced by such with an entry for each block, and the places in them are found again.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from ncscope.language.structure import Layout, Level, layout

if TYPE_CHECKING:
    from ncscope.channel.flow import Walker


def unfold(walker: Walker) -> None:
    """The walker at the same place, in tables without runs of plain blocks."""
    walker.shortest = lambda source: None
    pairs = {id(t): _pair(walker, t) for t in (*walker.layouts.values(), walker.layout)}
    if all(old is new for old, new, _ in pairs.values()):
        return
    for frame in walker.calls:
        pairs.setdefault(id(frame.layout), _pair(walker, frame.layout))
    walker.calls[:] = [
        replace(frame, layout=new, level=_level(moved, frame.level), at=moved(frame.at))
        for frame in walker.calls
        for _, new, moved in [pairs[id(frame.layout)]]
    ]
    by_file = {old.source.name: moved for old, _, moved in pairs.values()}
    _, walker.layout, moved = pairs[id(walker.layout)]
    walker.level, walker.at = _level(moved, walker.level), moved(walker.at)
    walker.layouts.update({name: pairs[id(t)][1] for name, t in walker.layouts.items()})
    walker.passes = {(file, by_file[file](at)): n for (file, at), n in walker.passes.items()}
    walker.counters = {(file, by_file[file](at)): n for (file, at), n in walker.counters.items()}
    walker.complained = {(file, by_file[file](at)) for file, at in walker.complained}


def _pair(walker: Walker, old: Layout) -> tuple[Layout, Layout, Callable[[int], int]]:
    """A table, the same without runs, and where its entries are in that."""
    if not any(entry.plain for entry in old.entries):
        return old, old, lambda at: at
    new = layout(old.source, walker.skip)
    starts = [entry.block.span.start for entry in new.entries]

    def moved(at: int) -> int:
        if at >= len(old.entries):
            return len(starts)
        return bisect_left(starts, old.entries[at].block.span.start)

    return old, new, moved


def _level(moved: Callable[[int], int], level: Level) -> Level:
    return moved(level[0]), moved(level[1])
