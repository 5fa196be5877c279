"""The table of list parameters: every key of every list, with its type, default, unit and range.

`parameters.tsv` is read at the first question, not at import. Keys are stored as patterns without
index numbers (`np_grp[].achse[].versch`); `sizes` says how far each index may go.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from importlib import resources

LIST_KINDS = ("channel", "axis", "zero", "tool", "clamp", "startup")
LIST_NAMES = {
    "channel": "channel list",
    "axis": "axis list",
    "zero": "zero offset list",
    "tool": "tool list",
    "clamp": "clamp position list",
    "startup": "start-up list",
}
INTEGER_RANGES = {
    "UNS08": (0, 2**8 - 1),
    "UNS16": (0, 2**16 - 1),
    "UNS32": (0, 2**32 - 1),
    "UNS64": (0, 2**64 - 1),
    "SGN08": (-(2**7), 2**7 - 1),
    "SGN16": (-(2**15), 2**15 - 1),
    "SGN32": (-(2**31), 2**31 - 1),
    "SGN64": (-(2**63), 2**63 - 1),
}

_OLD_KINEMATICS = re.compile(r"kinematik\[\d*\]\.(.+)")
_KINEMATIC_STEP = re.compile(r"kin_step\[\d*\]\.(trafo\[\d*\].*)")
_PROGRAM_STEP = re.compile(r"trafo_pcs(\[\d*\])(?:\.trafo\[\d*\])?(\..*)")
_PROGRAM_STEP_ID = re.compile(r"(default_id_of_trafo_pcs)\[0\]", re.IGNORECASE)
_INDEX = re.compile(r"\[\d+\]")


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """One list parameter.

    `sizes`: for each index of the key the number of values it may take, None without a limit.
    `status`: `effective` (changes what a run gives), `read` (checked or shown only), `-` (known,
    without effect here).
    """

    list_kind: str
    id: str
    key: str
    type: str
    default: str
    unit: str
    sizes: tuple[int | None, ...]
    low: int | None
    high: int | None
    status: str
    meaning: str

    @property
    def range(self) -> tuple[int, int] | None:
        """Smallest and largest value that the list accepts, both included; None without limits."""
        base = INTEGER_RANGES.get(self.type)
        if self.low is not None and self.high is not None:
            return self.low, self.high
        return base


def rows() -> tuple[ParameterRow, ...]:
    """Every parameter, in the order of the table."""
    return _table()[0]


def find(list_kind: str, key: str) -> ParameterRow | None:
    """The parameter that a key of a list means; index numbers do not matter, upper case neither.

    Knows the spellings `kinematik[91].x`, `kin_step[i].trafo[j].x` and `trafo_pcs[j].x` of
    `trafo[j].x`.
    """
    return _table()[1].get((list_kind, pattern(key).lower()))


def pattern(key: str) -> str:
    """The key as the table spells it: without index numbers, kinematics under `trafo[]`."""
    match = _KINEMATIC_STEP.fullmatch(key)
    key = match.group(1) if match else key
    match = _PROGRAM_STEP.fullmatch(key)
    key = f"trafo{match.group(1)}{match.group(2)}" if match else key
    match = _PROGRAM_STEP_ID.fullmatch(key)
    key = match.group(1) if match else key
    match = _OLD_KINEMATICS.fullmatch(key.lower() if key[:1] == "K" else key)
    key = f"trafo[].{match.group(1)}" if match else key
    return _INDEX.sub("[]", key)


def kinds_of(key: str) -> tuple[str, ...]:
    """The kinds of list that know a key."""
    return tuple(kind for kind in LIST_KINDS if find(kind, key) is not None)


def close_matches(list_kind: str, key: str) -> list[str]:
    """Keys of a list that look like `key`, best first, as patterns; empty when none does."""
    keys = _table()[2].get(list_kind, ())
    return get_close_matches(pattern(key).lower(), keys, n=3, cutoff=0.75)


_Table = tuple[
    tuple[ParameterRow, ...], dict[tuple[str, str], ParameterRow], dict[str, tuple[str, ...]]
]


@cache
def _table() -> _Table:
    text = resources.files("ncscope.lists").joinpath("parameters.tsv").read_text("utf-8")
    all_rows = tuple(_row(line) for line in text.splitlines()[1:])
    by_key = {(row.list_kind, row.key.lower()): row for row in all_rows}
    keys = {kind: tuple(k for w, k in by_key if w == kind) for kind in LIST_KINDS}
    return all_rows, by_key, keys


def _row(line: str) -> ParameterRow:
    kind, id, key, type, default, unit, sizes, low, high, status, meaning = line.split("\t")
    return ParameterRow(
        kind,
        id,
        key,
        type,
        default,
        unit,
        tuple(None if size == "*" else int(size) for size in sizes.split(",") if size),
        int(low) if low else None,
        int(high) if high else None,
        status,
        meaning,
    )
