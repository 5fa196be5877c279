"""Kinematic data sets from the channel list.

Three spellings reach one kind of record: `kinematik[id].x` (up to V2.11), `trafo[j].id` with
`trafo[j].x` (from V3.00), and `kin_step[0].trafo[j].x`. `kin_step[1].trafo[j].x` is the second step
of a transformation, `trafo_pcs[j].x` a PCS transformation, for which the programming manual also
writes `trafo_pcs[j].trafo[0].x`. Numbers stay in list units.
Source: FCT-C27 3.2 and 3.5, P-CHAN-00262, -00263, -00285 to -00295, -00829.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from ncscope.diagnostics import Diagnostic, Span, diagnostic
from ncscope.kinematics.parameters import KinematicParameters, field_index
from ncscope.lists.values import Reading

_SLOT = re.compile(
    r"(?:kinematik\[(?P<id>\d+)\]|(?:kin_step\[(?P<step>\d+)\]\.)?"
    r"trafo(?P<pcs>_pcs)?\[(?P<place>\d+)\](?(pcs)(?:\.trafo\[\d+\])?))\.(?P<field>.+)"
)


_AXIS = re.compile(r"(?P<slot>.*\.axis\[)(?P<axis>\d+)\]")

_CORRECTION = re.compile(r"corr\[(\d+)\]")

PROGRAM_STEP = -1
"""The step of a PCS transformation (trafo_pcs)."""


@dataclass(frozen=True, slots=True)
class Slot:
    """Where a list keeps a data set: `spelling` is the text before the field.

    step: 0 and 1 are the steps of a transformation, PROGRAM_STEP is a PCS transformation.
    """

    spelling: str
    step: int
    fixed_id: int | None


@dataclass(frozen=True, slots=True)
class KinematicSet:
    """A data set as one slot of the list gives it; `id` 0 when the list names none."""

    slot: Slot
    parameters: KinematicParameters
    first: Reading
    id_reading: Reading | None = None

    @property
    def id(self) -> int:
        return self.parameters.id


def split_key(key: str) -> tuple[Slot, str] | None:
    """The slot and the field of a kinematics key, None for other keys."""
    match = _SLOT.fullmatch(key.lower())
    if match is None:
        return None
    fixed = int(match["id"]) if match["id"] else None
    spelling = key.lower()[: match.start("field") - 1]
    step = PROGRAM_STEP if match["pcs"] else int(match["step"] or 0)
    return Slot(spelling, step, fixed), match["field"]


def is_number(reading: Reading) -> bool:
    """Whether a reading writes one of the 70 numbers of a data set."""
    split = split_key(reading.entry.key)
    return split is not None and field_index(split[1]) is not None


def read_sets(
    readings: Iterable[Reading],
) -> tuple[tuple[KinematicSet, ...], tuple[Diagnostic, ...]]:
    """The data sets in the order in which their slots first appear, and overwritten numbers."""
    sets: dict[Slot, KinematicSet] = {}
    found: list[Diagnostic] = []
    overwritten: list[tuple[int, bool, Diagnostic]] = []
    readings = tuple(readings)
    for place, reading in enumerate(readings):
        split = split_key(reading.entry.key)
        if split is None or reading.value is None:
            continue
        slot, field = split
        if slot.step > 1:
            found.append(_no_such_step(reading))
            continue
        # `kin_step[0].trafo[j]` and `trafo[j]` are one place (TF5200 multi-step transformations).
        slot = replace(slot, spelling=slot.spelling.removeprefix("kin_step[0]."))
        current = sets.get(slot) or _empty(slot, reading)
        overwritten.extend((place, *item) for item in _overwritten(current, field, reading))
        sets[slot] = _with_reading(current, field, reading)
    return tuple(sets.values()), (*found, *_with_meant_index(overwritten, readings))


def by_id(
    sets: Iterable[KinematicSet], step: int = 0
) -> tuple[Mapping[int, KinematicParameters], tuple[Diagnostic, ...]]:
    """The data sets of one step by kinematic id; of two with one id the later one counts."""
    chosen: dict[int, KinematicSet] = {}
    found: list[Diagnostic] = []
    for item in sets:
        if item.slot.step != step:
            continue
        if item.id == 0:
            found.append(_without_id(item))
            continue
        earlier = chosen.get(item.id)
        if earlier is not None:
            found.append(_same_id(earlier, item))
        chosen[item.id] = item
    return {id: _typed(item.parameters) for id, item in sorted(chosen.items())}, tuple(found)


def _empty(slot: Slot, first: Reading) -> KinematicSet:
    return KinematicSet(slot, KinematicParameters(id=slot.fixed_id or 0, type=0), first)


def _with_reading(item: KinematicSet, field: str, reading: Reading) -> KinematicSet:
    correction, index = _CORRECTION.fullmatch(field), field_index(field)
    if correction is not None:
        return _with_correction(item, int(correction[1]), reading)
    if index is not None:
        return _with_number(item, index, reading)
    return _with_property(item, field, reading)


def _with_property(item: KinematicSet, field: str, reading: Reading) -> KinematicSet:
    parameters, value = item.parameters, reading.value
    if field == "id" and item.slot.fixed_id is None:
        parameters = replace(parameters, id=int(value or 0))
        return replace(item, parameters=parameters, id_reading=reading)
    if field == "type":
        return replace(item, parameters=replace(parameters, type=int(value or 0)))
    if field == "name":
        return replace(item, parameters=replace(parameters, name=str(value)))
    return item


def _with_number(item: KinematicSet, index: int, reading: Reading) -> KinematicSet:
    value = float(reading.value or 0)
    origin = reading.entry.key_span
    return replace(item, parameters=item.parameters.with_value(index, value, origin))


def _with_correction(item: KinematicSet, index: int, reading: Reading) -> KinematicSet:
    """P-CHAN-00438; an index that does not exist is reported where the reading is made."""
    value = float(reading.value or 0)
    origin = reading.entry.key_span
    return replace(item, parameters=item.parameters.with_correction(index, value, origin))


def _overwritten(
    item: KinematicSet, field: str, reading: Reading
) -> Iterator[tuple[bool, Diagnostic]]:
    """For a number: whether it repeats that of earlier lines of its list, and the warning."""
    index = field_index(field)
    if index is None:
        return
    span = reading.entry.key_span
    writers = [w for w in item.parameters.origins.get(index, ()) if w.source is span.source]
    old, new = item.parameters.values[index], float(reading.value or 0)
    if writers:
        yield old == new, overwrite_warning(reading, f"{old:g}", tuple(writers))


def overwrite_warning(reading: Reading, old: str, writers: tuple[Span, ...]) -> Diagnostic:
    """N3007: an entry replaces the value `old` of earlier lines."""
    message = f"{reading.entry.key} {reading.entry.value_text} overwrites the earlier value {old}"
    hint = "the last entry counts; check the index numbers of the key, or delete one of the lines"
    notes = tuple(("written before here", span) for span in writers)
    return diagnostic("N3007", reading.entry.key_span, message, hint, notes=notes)


def _with_meant_index(
    found: Iterable[tuple[int, bool, Diagnostic]], readings: tuple[Reading, ...]
) -> Iterator[Diagnostic]:
    """Overwritten numbers of an axis that stand among lines of another axis get its index as hint.

    The lists of FCT-C27 4.1.2 and 4.1.3 have this slip: `axis[0]` in the blocks of other axes.
    A line that only writes the same value again is no fault anywhere else.
    """
    written = {r.entry.key.lower() for r in readings}
    for place, repeats, item in found:
        meant = _meant_key(readings, place, written)
        if meant:
            yield replace(item, hint=f"{meant} was probably meant")
        elif not repeats:
            yield item


def _meant_key(readings: tuple[Reading, ...], place: int, written: set[str]) -> str:
    """The key with the axis index of the lines around it, when nothing else writes that key."""
    own = _AXIS.match(readings[place].entry.key)
    around = [r for r in readings[max(place - 1, 0) : place + 2] if r is not readings[place]]
    matches = [_AXIS.match(r.entry.key) for r in around]
    indices = {m["axis"] for m in matches if m and own and m["slot"] == own["slot"]}
    if own is None or len(indices) != 1 or own["axis"] in indices:
        return ""
    meant = f"{own['slot']}{indices.pop()}{readings[place].entry.key[own.end('axis') :]}"
    return "" if meant.lower() in written else meant


def _same_id(earlier: KinematicSet, later: KinematicSet) -> Diagnostic:
    new, old = later.id_reading or later.first, earlier.id_reading or earlier.first
    message = (
        f"{later.slot.spelling} has the kinematic id {later.id} of {earlier.slot.spelling}; "
        f"only {later.slot.spelling} counts"
    )
    notes = (("the same id here", old.entry.key_span),)
    return diagnostic(
        "N3007", new.entry.key_span, message, "give each data set its own id", notes=notes
    )


def _no_such_step(reading: Reading) -> Diagnostic:
    message = f"{reading.entry.key}: a transformation has the steps 0 and 1 only"
    hint = "write kin_step[0] or kin_step[1]"
    return diagnostic("110303", reading.entry.key_span, message, hint)


def _without_id(item: KinematicSet) -> Diagnostic:
    message = f"{item.slot.spelling} has no id, so that no program can select it"
    hint = f"write {item.slot.spelling}.id 91"
    return diagnostic("N3010", item.first.entry.key_span, message, hint)


def _typed(parameters: KinematicParameters) -> KinematicParameters:
    """Type 0 takes the value of the id (P-CHAN-00829)."""
    return parameters if parameters.type else replace(parameters, type=parameters.id)
