"""Lists to a `Machine`: read every list, check every value, fill every field that has an effect.

Layers: built-in defaults, then default lists, then specific lists; in one list the last entry of a
key counts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ncscope.diagnostics import Diagnostic, Span
from ncscope.kinematics import KinematicParameters
from ncscope.lists import axes, coordinate_systems, files, kinematic_sets, records
from ncscope.lists.axes import AxisRecord, ChannelAxes
from ncscope.lists.external import external_variables
from ncscope.lists.files import ListFile
from ncscope.lists.kinematic_sets import KinematicSet
from ncscope.lists.values import Reading, read_values
from ncscope.machine import Axis, ExternalVariable, Machine

Readings = tuple[Reading, ...]


@dataclass(frozen=True, slots=True)
class Loaded:
    """A machine with all that was read for it; `check` looks at more than the machine shows."""

    machine: Machine
    diagnostics: tuple[Diagnostic, ...] = ()
    readings: Readings = ()
    kinematic_sets: tuple[KinematicSet, ...] = ()
    axis_spans: tuple[Span | None, ...] = ()


def load_machine(path: str | Path) -> tuple[Machine, tuple[Diagnostic, ...]]:
    """The machine of a folder of lists, of a start-up list, or of a single list.

    What the lists have wrong comes back as diagnostics; the machine is complete in any case, with
    defaults where a list says nothing.
    """
    loaded = load(path)
    return loaded.machine, loaded.diagnostics


def load(path: str | Path) -> Loaded:
    """`load_machine` with the readings behind the machine."""
    found, complaints = files.find_lists(path)
    place = Path(path).resolve()
    name = place.name if place.is_dir() else place.stem
    return assemble(found, name, complaints)


def machine_from_documents(
    lists: Iterable[ListFile], name: str = "machine"
) -> tuple[Machine, tuple[Diagnostic, ...]]:
    """The machine of lists that are already in memory, default lists first."""
    loaded = assemble(tuple(lists), name)
    return loaded.machine, loaded.diagnostics


@dataclass(frozen=True, slots=True)
class _Lists:
    """The readings of all lists by kind; found: what their entries have wrong."""

    by_kind: dict[str, list[Reading]]
    of_axes: list[tuple[ListFile, Readings]]
    external: dict[str, ExternalVariable]
    found: list[Diagnostic]

    def readings(self) -> Readings:
        of_kinds = (reading for part in self.by_kind.values() for reading in part)
        of_axes = (reading for _, part in self.of_axes for reading in part)
        return (*of_kinds, *of_axes)


def assemble(
    lists: tuple[ListFile, ...], name: str, complaints: tuple[Diagnostic, ...] = ()
) -> Loaded:
    """Every list read and the machine filled."""
    read = _read(lists)
    of_channel = read.by_kind["channel"]
    # 1. the axes of the channel, and all other axes of the machine
    axis_records, axis_faults = _axis_records(read.of_axes)
    channel = axes.channel_axes(of_channel, axis_records)
    own = _axes(channel, axis_records)
    rotary = frozenset(i for i, axis in enumerate(own) if axis.rotary)
    # 2. what else the channel list says
    settings, setting_faults = records.channel_settings(of_channel)
    sets, set_faults = kinematic_sets.read_sets(of_channel)
    steps, step_faults = _by_step(sets)
    systems = coordinate_systems.configured(of_channel)
    # 3. the machine, with the records of the other lists
    machine = Machine(
        name,
        own,
        _known_axes(own, axis_records),
        records.zero_offsets(read.by_kind["zero"]),
        records.clamp_positions(read.by_kind["clamp"]),
        records.tools(read.by_kind["tool"], rotary),
        kinematic_parameters=steps[0],
        settings=settings,
        second_step_parameters=steps[1],
        program_step_parameters=steps[2],
        external=read.external,
        systems=systems.systems,
        stacks=systems.stacks,
        stack_at_start=systems.start,
    )
    found = [*complaints, *read.found, *axis_faults, *channel.diagnostics, *setting_faults]
    found += [*set_faults, *step_faults, *systems.diagnostics]
    return Loaded(machine, in_file_order(found, lists), read.readings(), sets, channel.name_spans)


def _read(lists: tuple[ListFile, ...]) -> _Lists:
    read = _Lists({kind: [] for kind in ("channel", "zero", "tool", "clamp")}, [], {}, [])
    for item in lists:
        if item.list_kind == "external":
            variables, faults = external_variables(item.document)
            read.external.update(variables)
            read.found.extend(faults)
            continue
        readings, faults = read_values(item.document, item.list_kind)
        read.found.extend([*faults, *_overwritten(readings)])
        if item.list_kind == "axis":
            read.of_axes.append((item, readings))
        else:
            read.by_kind.setdefault(item.list_kind, []).extend(readings)
    return read


def _by_step(
    sets: tuple[KinematicSet, ...],
) -> tuple[list[Mapping[int, KinematicParameters]], list[Diagnostic]]:
    """Parameters by kinematic id of the first step, the second one, PCS transformations."""
    steps: list[Mapping[int, KinematicParameters]] = []
    found: list[Diagnostic] = []
    for step in (0, 1, kinematic_sets.PROGRAM_STEP):
        parameters, faults = kinematic_sets.by_id(sets, step)
        steps.append(parameters)
        found.extend(faults)
    return steps, found


def in_file_order(
    found: Iterable[Diagnostic], lists: tuple[ListFile, ...]
) -> tuple[Diagnostic, ...]:
    """Diagnostics by list, in reading order, and by line; those without a list come first."""
    places = {id(item.document.source): place for place, item in enumerate(lists)}

    def key(item: Diagnostic) -> tuple[int, int]:
        if item.span is None:
            return -1, 0
        return places.get(id(item.span.source), -1), item.span.start

    return tuple(sorted(found, key=key))


def _axes(channel: ChannelAxes, axis_records: dict[int, AxisRecord]) -> tuple[Axis, ...]:
    """The channel's axes; X Y Z with the first three axis lists when no list names any."""
    if channel.axes:
        return channel.axes
    return tuple(_main_axis(axis, axis_records) for axis in Machine().axes)


def _main_axis(axis: Axis, axis_records: dict[int, AxisRecord]) -> Axis:
    record = axis_records.get(axis.number)
    if record is None or record.axis.rotary:
        return axis
    own = record.axis
    return Axis(
        axis.name,
        axis.number,
        limits=own.limits,
        reference=own.reference,
        measuring=own.measuring,
    )


def _known_axes(own: tuple[Axis, ...], axis_records: dict[int, AxisRecord]) -> dict[int, Axis]:
    """All axes by number, with their channel names; empty without axis lists."""
    if not axis_records:
        return {}
    known = {n: record.axis for n, record in axis_records.items() if not record.spindle}
    known.update({axis.number: axis for axis in own})
    return dict(sorted(known.items()))


def _axis_records(
    axis_lists: list[tuple[ListFile, Readings]],
) -> tuple[dict[int, AxisRecord], list[Diagnostic]]:
    defaults = [r for item, readings in axis_lists if item.is_default for r in readings]
    found: dict[int, AxisRecord] = {}
    complaints: list[Diagnostic] = []
    for place, (item, readings) in enumerate(p for p in axis_lists if not p[0].is_default):
        number = item.number if item.number is not None else place + 1
        own = [r for r in defaults if r.row.key != "kopf.achs_nr"]
        record, problems = axes.axis_record([*own, *readings], number)
        complaints.extend(problems)
        found[record.axis.number] = record
    return found, complaints


def _overwritten(readings: Readings) -> list[Diagnostic]:
    """N3007 for entries of one list that replace another value; kinematic numbers look themselves.

    An entry whose value was refused neither replaces nor is replaced.
    """
    first: dict[str, list[Reading]] = {}
    found = []
    for reading in readings:
        if reading.value is None or kinematic_sets.is_number(reading):
            continue
        earlier = first.setdefault(reading.entry.key.lower(), [])
        if earlier and earlier[-1].value != reading.value:
            spans = tuple(other.entry.key_span for other in earlier)
            old = earlier[-1].entry.value_text
            found.append(kinematic_sets.overwrite_warning(reading, old, spans))
        earlier.append(reading)
    return found
