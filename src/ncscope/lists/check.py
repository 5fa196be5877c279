"""What `ncscope check` says about lists: all that loading finds, and what looks wrong beyond it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.lists.kinematic_checks import check_kinematics
from ncscope.lists.reading import Loaded, load


def check_lists(path: str | Path) -> tuple[Diagnostic, ...]:
    """Everything worth saying about the lists of a machine; nothing is run."""
    return check_loaded(load(path))


def check_loaded(loaded: Loaded) -> tuple[Diagnostic, ...]:
    """Diagnostics of loading, axes, kinematics, and entries without effect, list by list and from
    top to bottom; those without a list come first."""
    found = (
        *loaded.diagnostics,
        *_assumed_axes(loaded),
        *check_kinematics(loaded),
        *_without_effect(loaded),
    )
    order: dict[int, int] = {}

    def place(item: Diagnostic) -> tuple[int, int]:
        if item.span is None:
            return -1, 0
        return order.setdefault(id(item.span.source), len(order)), item.span.start

    return tuple(sorted(found, key=place))


def _assumed_axes(loaded: Loaded) -> Iterator[Diagnostic]:
    for axis, span in zip(loaded.machine.axes, loaded.axis_spans, strict=False):
        if axis.assumed and axis.rotary:
            message = (
                f"axis {axis.name} has no axis list; it is taken as rotary because of its name"
            )
            hint = f"add an axis list with kopf.achs_nr {axis.number} and kenngr.achs_typ"
            yield diagnostic("N3004", span, message, hint)


def _without_effect(loaded: Loaded) -> Iterator[Diagnostic]:
    """N3003 once for every key, at its first entry."""
    said: set[str] = set()
    for reading in loaded.readings:
        key = reading.row.key
        if key in said or reading.row.status != "-":
            continue
        said.add(key)
        message = f"{reading.entry.key} ({reading.row.id}) is read and has no effect"
        yield diagnostic("N3003", reading.entry.key_span, message)
