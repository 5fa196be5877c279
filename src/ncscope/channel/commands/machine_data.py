"""#MACHINE DATA: one entry of an axis list, written by a program.

Software limits and the reference position are modelled; entries that change the kind of an axis are
refused; any other entry has no effect on positions.
Source: TF5200 programming manual; P-AXIS-00152, P-AXIS-00177, P-AXIS-00178.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number, evaluate_value
from ncscope.language import tree
from ncscope.machine import Axis

UNITS = 10_000
"""List units of one millimetre or degree: 0.1 um, 0.0001 degrees."""
_ENTRY = re.compile(r"\s*([A-Za-z_][\w.\[\]-]*)\s+(\S+)")
_INDEX = re.compile(r"\[\d*\]")
_PARAMETER = re.compile(r"P-AXIS-(\d{5})")

Change = Callable[[Axis, float], Axis]


def _limit(side: int) -> Change:
    def change(axis: Axis, value: float) -> Axis:
        limits = list(axis.limits or (-1e300, 1e300))
        limits[side] = value / UNITS
        return replace(axis, limits=(limits[0], limits[1]))

    return change


MODELLED: dict[str, Change] = {
    "kenngr.swe_neg": _limit(0),
    "kenngr.swe_pos": _limit(1),
    "getriebe[].pos_refpkt": lambda axis, value: replace(axis, reference=value / UNITS),
}
REFUSED = frozenset(
    ("kenngr.achs_mode", "kenngr.achs_typ", "kopf.achs_nr", "getriebe[].moduloo",
     "getriebe[].modulou", "kenngr.swe_check", "kenngr.messachse")
)  # fmt: skip
"""Entries that change what a programmed value means, or what a run checks."""
KEYS_OF_PARAMETERS = {
    "00015": "kenngr.achs_mode",
    "00016": "kopf.achs_nr",
    "00018": "kenngr.achs_typ",
    "00118": "kenngr.messachse",
    "00126": "getriebe[].moduloo",
    "00127": "getriebe[].modulou",
    "00152": "getriebe[].pos_refpkt",
    "00177": "kenngr.swe_neg",
    "00178": "kenngr.swe_pos",
    "00705": "kenngr.swe_check",
}


def machine_data(draft: Draft, command: tree.HashCommand) -> None:
    """#MACHINE DATA [AX=Z AXPARAM="kenngr.swe_pos 5000"] or [AX=Z P-AXIS-00178=5000]."""
    index, entries = None, []
    for item in (item for group in command.groups for item in group.items):
        word = item.value.text.upper() if isinstance(item.value, tree.Name) else ""
        if item.key == "AX" and isinstance(item.value, tree.Name):
            index = draft.axis_index(item.value.text, item.span, "20797")
        elif item.key == "AXNR" and item.value is not None:
            index = _by_number(draft, item, round(evaluate_number(draft, item.value)))
        elif item.key == "AXPARAM" and item.value is not None:
            entries.append((item, *_entry(draft, item)))
        elif item.key is None and word in ("SYN", "WAIT"):
            continue
        else:
            draft.fail("N1005", item.span, "this cannot stand in #MACHINE DATA", _FORM)
    if index is None or not entries:
        draft.fail("N1005", command.span, "#MACHINE DATA needs an axis and an entry", _FORM)
    for item, key, value in entries:
        _write(draft, item, index, key, value)


_FORM = 'write #MACHINE DATA [AX=Z AXPARAM="kenngr.swe_pos 5000000"]'


def _by_number(draft: Draft, item: tree.Item, number: int) -> int:
    for index, axis in enumerate(draft.state.axes):
        if axis.number == number:
            return index
    draft.fail("20312", item.span, f"axis number {number} is not in this channel")


def _entry(draft: Draft, item: tree.Item) -> tuple[str, str]:
    assert item.value is not None
    text = evaluate_value(draft, item.value)
    found = _ENTRY.match(text) if isinstance(text, str) else None
    if found is None:
        draft.fail("N1005", item.span, "AXPARAM needs a key and a value in quotes", _FORM)
    key = found.group(1)
    parameter = _PARAMETER.fullmatch(key.upper())
    if parameter:
        key = KEYS_OF_PARAMETERS.get(parameter.group(1), key)
    return _INDEX.sub("[]", key.lower()), found.group(2)


def _write(draft: Draft, item: tree.Item, index: int, key: str, text: str) -> None:
    name = draft.state.axis_names[index]
    if key in REFUSED:
        draft.fail("N2001", item.span, f"#MACHINE DATA for {key} is not supported")
    if key not in MODELLED:
        draft.warn("N2002", item.span, f"#MACHINE DATA {key} has no effect on positions")
        return
    value = _number(text)
    if value is None:
        draft.fail("N1005", item.span, f"{text} is not a number of a list", _FORM)
    axes = list(draft.state.axes)
    axes[index] = MODELLED[key](axes[index], value)
    if (limits := axes[index].limits) is not None and limits[0] > limits[1]:
        draft.fail("N1005", item.span, f"the software limits of {name} exclude each other")
    draft.state = draft.state.changed(axes=tuple(axes))


def _number(text: str) -> float | None:
    """A value as lists write it, hexadecimal with 0x; None where it is none or too large."""
    try:
        value = float(int(text, 16)) if text[:2].lower() == "0x" else float(text)
    except (ValueError, OverflowError):
        return None
    return value if math.isfinite(value) else None


COMMANDS = {"MACHINE DATA": machine_data}
