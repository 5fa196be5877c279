"""A data set of the universal kinematics as the lines of a channel list, and one from a library.

The form is that of FCT-C27 8: groups with a comment before each.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.kinematics.library import LIBRARY, complaints, instead, to_universal, why_not
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.lists.document import Entry, ListDocument
from ncscope.lists.kinematic_sets import Slot, split_key
from ncscope.lists.values import Value, read_values

LINEAR = 1


def from_library(
    document: ListDocument, id: int, old_syntax: bool = False
) -> tuple[str | None, tuple[Diagnostic, ...]]:
    """The ID 91 list for the library kinematics `id` of a list; None with errors.

    Errors: the list has no such kinematics, the library type is not known, or one of its
    parameters cannot be taken over.
    """
    if id not in LIBRARY:
        return None, (diagnostic("N3502", None, why_not(id), instead(id)),)
    entries, found = _parameters(document, id)
    if not entries:
        message = f"{document.name} has no parameters of kinematics {id}"
        hint = f"write kinematik[{id}].param[0] .., or trafo[0].id {id} and trafo[0].param[0] .."
        return None, (*found, diagnostic("N3502", None, message, hint))
    param = {index: value for index, (value, _) in entries.items()}
    wrong = complaints(id, param)
    if wrong:
        return None, (*found, *(_refused(entries, index, text) for index, text in wrong))
    entry = LIBRARY[id]
    head = [
        f"# Library kinematics {id}: {entry.title}, as universal kinematics (ID 91)",
        f"# Source: {entry.source}",
        *(f"# HD{n} = {param.get(n - 1, 0):g}: {text}" for n, text in entry.offsets.items()),
        "# Compare a few positions with the machine before you use it.",
        "",
    ]
    lines = universal_lines(to_universal(id, param), entry.axes, old_syntax)
    return "\n".join([*head, *lines]) + "\n", found


def _refused(entries: Mapping[int, tuple[float, Entry]], index: int, message: str) -> Diagnostic:
    span = entries[index][1].value_span if index in entries else None
    return diagnostic("N3502", span, message)


def universal_lines(
    parameters: KinematicParameters, axes: Sequence[str], old_syntax: bool = False
) -> Iterator[str]:
    """The lines that write all fields of a data set; `axes` are the names in the comments."""
    slot = f"kinematik[{parameters.id}]" if old_syntax else "trafo[0]"

    def entry(field: str, comment: str = "") -> str:
        key = f"{slot}.{field}"
        return f"{key:<32} {_number(parameters.get(field))}{comment}"

    if not old_syntax:
        yield from ("# Kinematic ID", f"{slot + '.id':<32} {parameters.id}", "")
    yield "# Tool direction from tip to flange, and flange position, all axes at 0"
    yield from (entry(f"{name}[{k}]") for name in _ZERO for k in range(3))
    yield from ("", f"# {len(axes)} axes ({''.join(axes)})", entry("number_of_axes"))
    for axis, name in enumerate(axes):
        yield from ("", f"# {name} axis", entry(f"axis[{axis}].type"))
        yield from (entry(f"axis[{axis}].orientation[{k}]") for k in range(3))
        if parameters.get(f"axis[{axis}].type") != LINEAR:
            yield from (entry(f"axis[{axis}].point[{k}]") for k in range(3))
    yield from ("", "# Axis sequence in the kinematic chain, from the workpiece to the tool")
    for place in range(len(axes)):
        yield entry(f"chain[{place}]", f" # {axes[int(parameters.get(f'chain[{place}]'))]}")
    yield from ("", "# Programming mode, and RTCP (1) or complete transformation (0)")
    yield from (entry("programming_mode"), entry("rtcp"))


_ZERO = ("zero_orientation", "zero_position")


def _number(value: float) -> str:
    """Whole numbers without a point; others with digits that read back as the same number."""
    return str(int(value)) if value == int(value) else repr(value)


def _parameters(
    document: ListDocument, id: int
) -> tuple[dict[int, tuple[float, Entry]], tuple[Diagnostic, ...]]:
    """param index -> value and entry of the kinematics of this type; the last entry counts.

    A data set without a type has that of its id (P-CHAN-00829).
    """
    readings, found = read_values(document, "channel")
    named: dict[str, dict[Slot, Value]] = {"id": {}, "type": {}}
    for reading in readings:
        split = split_key(reading.entry.key)
        if split is not None and split[1] in named and reading.value:
            named[split[1]][split[0]] = reading.value
    places = {slot for slot, number in {**named["id"], **named["type"]}.items() if number == id}
    values: dict[int, tuple[float, Entry]] = {}
    for reading in readings:
        split = split_key(reading.entry.key)
        if split is None or reading.value is None or not split[1].startswith("param["):
            continue
        untyped = split[0] not in named["type"]
        if split[0] in places or (split[0].fixed_id == id and untyped):
            values[reading.indices[-1]] = (float(reading.value), reading.entry)
    return values, found
