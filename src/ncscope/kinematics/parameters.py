"""The one memory of KIN-ID 91: 70 numbers, reachable as named fields and as `param[i]`.

Numbers stay in list units here (0.1 um for positions and linkage offsets), because the list, the
NC variables and the tool data all read and write them in these units; `chain` converts.
Source: FCT-C27 section 3.5, P-CHAN-00263 and P-CHAN-00285..00295.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

PARAMETER_COUNT = 70
MAX_AXES = 6
LIST_UNITS_PER_MM = 10_000.0
"""Lists give lengths in 0.1 um."""


def _field_table() -> dict[str, int]:
    table = {f"zero_orientation[{k}]": k for k in range(3)}
    table |= {f"zero_position[{k}]": 3 + k for k in range(3)}
    table["number_of_axes"] = 6
    for axis in range(MAX_AXES):
        first = 7 + 7 * axis
        table[f"axis[{axis}].type"] = first
        for k in range(3):
            table[f"axis[{axis}].orientation[{k}]"] = first + 1 + k
            table[f"axis[{axis}].point[{k}]"] = first + 4 + k
    table |= {f"chain[{i}]": 49 + i for i in range(MAX_AXES)}
    table["programming_mode"] = 55
    table["rtcp"] = 56
    # Not documented by the vendor; 57 + 1 + 12 fills the array exactly (decision D-16).
    table["linkage_mode"] = 57
    for row in range(3):
        for column in range(4):
            table[f"linkage[{row}][{column}]"] = 58 + 4 * row + column
    return table


MAX_WRITERS = 7
"""So many earlier writers of a number are remembered: a loop may write it for ever."""

INDEX_OF_FIELD: Mapping[str, int] = MappingProxyType(_field_table())
FIELD_OF_INDEX: Mapping[int, str] = MappingProxyType({i: f for f, i in _field_table().items()})


@dataclass(frozen=True, slots=True)
class KinematicParameters:
    """One data set: the number memory, and for each number the place that wrote it last.

    `values`: 70 numbers in list units. `origins`: index -> all writers in order (any value; lists
    and NC programs put a Span there), so that a fault can point at the lines that caused it.
    `corrections`: index -> what a calibration adds to the number (P-CHAN-00438), with its writer.
    """

    id: int = 91
    type: int = 91
    name: str = ""
    values: tuple[float, ...] = (0.0,) * PARAMETER_COUNT
    origins: Mapping[int, tuple[Any, ...]] = field(default_factory=dict)
    corrections: Mapping[int, tuple[float, Any]] = field(default_factory=dict)

    def with_value(self, index: int, value: float, origin: Any = None) -> KinematicParameters:
        """The same data set with one number written. Raises IndexError for index not in 0..69."""
        if not 0 <= index < PARAMETER_COUNT:
            raise IndexError(f"param[{index}] does not exist; indices are 0 to 69")
        values = (*self.values[:index], float(value), *self.values[index + 1 :])
        origins = dict(self.origins)
        origins[index] = (*origins.get(index, ())[-MAX_WRITERS:], origin)
        return replace(self, values=values, origins=origins)

    def with_correction(self, index: int, value: float, origin: Any = None) -> KinematicParameters:
        """The same data set with one correction. Raises IndexError for index not in 0..69."""
        if not 0 <= index < PARAMETER_COUNT:
            raise IndexError(f"corr[{index}] does not exist; indices are 0 to 69")
        return replace(self, corrections={**self.corrections, index: (value, origin)})

    def corrected(self) -> KinematicParameters:
        """The numbers a kinematics is made of: each with its correction, and none left to add."""
        result = replace(self, corrections={}) if self.corrections else self
        for index, (value, origin) in self.corrections.items():
            if value:
                result = result.with_value(index, self.values[index] + value, origin)
        return result

    def get(self, name: str) -> float:
        """The number of a field such as `axis[3].point[0]`; list units."""
        return self.values[INDEX_OF_FIELD[name]]

    @classmethod
    def from_fields(cls, fields: Mapping[str, Any], id: int = 91) -> KinematicParameters:
        """A data set from nested fields (`{"axis": [{"type": 1, ..}], "chain": [..], ..}`)."""
        values = [0.0] * PARAMETER_COUNT
        for name, value in _flatten(fields):
            values[INDEX_OF_FIELD[name]] = float(value)
        return cls(id=id, type=id, values=tuple(values))


def field_index(text: str) -> int | None:
    """Index of a field written as in a list or an NC variable, None when there is none.

    `AXIS[0].POINT[2]`, `axis[0].point[2]` and `param[13]` all mean 13.
    """
    plain = text.strip().lower()
    match = re.fullmatch(r"param\[(\d+)\]", plain)
    if match:
        index = int(match.group(1))
        return index if index < PARAMETER_COUNT else None
    return INDEX_OF_FIELD.get(plain)


def _flatten(value: Any, prefix: str = "") -> list[tuple[str, float]]:
    if isinstance(value, Mapping):
        dot = "." if prefix else ""
        return [pair for k, v in value.items() for pair in _flatten(v, f"{prefix}{dot}{k}")]
    if isinstance(value, (list, tuple)):
        return [pair for i, v in enumerate(value) for pair in _flatten(v, f"{prefix}[{i}]")]
    return [(prefix, value)]
