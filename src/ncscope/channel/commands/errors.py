"""#ERROR: a program raises a diagnostic of its own (TF5200 programming manual, user errors)."""

from __future__ import annotations

import re
from typing import NamedTuple

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.language import tree

WARNING, SERIOUS, FATAL = 0, 2, 7
MEANINGS = (
    "", "limit", "present value", "wrong value", "expected value", "corrected value",
    "axis number", "drive type", "control element", "state", "transition", "sender", "class",
    "instance", "identification", "status", "ring number", "block number", "lower limit",
    "upper limit", "start value", "end value",
)  # fmt: skip
"""What PM1 to PM5 say about PV1 to PV5, by number."""
_FORM = "write #ERROR [ID=455 RC=2 PV1=3.5 PM1=2]"
_KEY = re.compile(r"(ID|RC|MID|PV[1-5]|PM[1-5]|PIV[1-4])(\d*)")


class _Given(NamedTuple):
    value: float
    item: tree.Item


def error(draft: Draft, command: tree.HashCommand) -> None:
    """#ERROR [ID=1..1000 RC=0|2|7 MID=.. PV1=.. PM1=.. PIV1=..]; RC 0 is a warning."""
    given: dict[str, _Given] = {}
    for item in (item for group in command.groups for item in group.items):
        key, value = _read(draft, item)
        if key in given:
            draft.fail("N1005", item.span, f"{key} is given twice", _FORM)
        given[key] = _Given(value, item)
    _whole(draft, given, "ID", range(1, 1001))
    _whole(draft, given, "MID", range(2**31))
    reaction = _whole(draft, given, "RC", (WARNING, SERIOUS, FATAL))
    for i in range(1, 6):
        _whole(draft, given, f"PM{i}", range(len(MEANINGS)))
    text = _text(given)
    if reaction == WARNING:
        draft.warn("N2090", command.span, text)
        return
    draft.fail("N2091", command.span, text)


def _read(draft: Draft, item: tree.Item) -> tuple[str, float]:
    """`ID=455`, `ID 455` or `ID455`."""
    if item.key is None and isinstance(item.value, tree.Name):
        found = _KEY.fullmatch(item.value.text.upper())
        if found and found.group(2):
            return found.group(1), float(found.group(2))
    if item.key is not None and _KEY.fullmatch(item.key) and item.value is not None:
        return item.key, evaluate_number(draft, item.value)
    draft.fail("N1005", item.span, "this cannot stand in #ERROR", _FORM)


def _whole(draft: Draft, given: dict[str, _Given], key: str, allowed) -> int | None:
    if key not in given:
        return None
    value, item = given[key]
    number = round(value)
    if abs(value - number) > 1e-9 or number not in allowed:
        last = "0, 2 or 7" if isinstance(allowed, tuple) else f"{allowed[0]} to {allowed[-1]}"
        draft.fail("N1005", item.span, f"{key} is {last}, not {value:g}", _FORM)
    return number


def _text(given: dict[str, _Given]) -> str:
    number = f" {round(given['ID'].value)}" if "ID" in given else ""
    if "MID" in given:
        number += f" (place {round(given['MID'].value)})"
    parts = []
    for i in range(1, 6):
        if f"PV{i}" in given:
            meaning = MEANINGS[round(given[f"PM{i}"].value)] if f"PM{i}" in given else ""
            parts.append(f"{meaning or f'value {i}'} {given[f'PV{i}'].value:g}")
    parts += [f"PIV{i} {given[f'PIV{i}'].value:g}" for i in range(1, 5) if f"PIV{i}" in given]
    return f"the program raises its error{number}" + (": " + ", ".join(parts) if parts else "")


COMMANDS = {"ERROR": error}
