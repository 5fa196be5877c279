"""What one block leaves for the next: frozen, sharing what did not change."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

from ncscope.channel.elements import Elements
from ncscope.channel.given import GivenRows
from ncscope.contour import Turn
from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Span
from ncscope.frames import Array, Frame
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.machine import Axis, Tool, TransformationStack, ZeroOffsets

PROGRAM_STEP = -1
"""Stands for the PCS transformation where the kinematic steps are numbered 0 and 1."""
_PLANES = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}
INCH = 25.4
"""Millimetres of an inch (G70)."""


class Changing:
    """A frozen dataclass of many fields, of which every block makes copies.

    `dataclasses.replace` gives each field to `__init__` again; here the dict of the fields is
    copied. So what derives from this has neither slots, nor `__post_init__`, nor cached properties.
    """

    def changed(self, **changes: Any) -> Self:
        """A copy with other values of some fields. Raises TypeError for a name that is no field."""
        values = self.__dict__.copy()
        values.update(changes)
        if len(values) != len(self.__dict__):
            raise TypeError(f"no field of {type(self).__name__}: {changes.keys() - self.__dict__}")
        copy = object.__new__(type(self))
        object.__setattr__(copy, "__dict__", values)
        return copy


@dataclass(frozen=True)
class Modal(Changing):
    """The modal G functions that change what a word means.

    motion: one of `motion.MOTIONS` (group 0). plane: 17, 18 or 19. absolute: G90. inch: G70.
    feed: mm or degrees per minute. radius: mm, of the arcs without a centre (R, G163), None where
    a centre was given last. centre_absolute: G161. centre_fits: G165. corner_size: mm, the last I
    of G301 and G302. control_points: #SPLINE TYPE BSPLINE. compensation: 0, 41 or 42; it begins
    with the next straight motion. diameter_axis: channel index of the axis that G51 acts on, None
    with G52. The start values are the built-in ones of P-CHAN-00063.
    """

    motion: str = "G00"
    plane: int = 17
    absolute: bool = True
    inch: bool = False
    feed: float | None = None
    feed_warned: bool = False
    radius: float | None = None
    centre_absolute: bool = False
    centre_fits: bool = True
    corner_size: float = 0.0
    control_points: bool = False
    compensation: int = 0
    compensation_begins: bool = False
    diameter_axis: int | None = None

    @property
    def plain(self) -> bool:
        """Whether axis words are plain positions on straight moves or arcs."""
        path = self.motion in ("G00", "G01", "G02", "G03")
        return path and self.diameter_axis is None and not self.compensation_begins

    @property
    def length_factor(self) -> float:
        """Millimetres of one programmed unit of a linear axis."""
        return INCH if self.inch else 1.0


@dataclass(frozen=True, slots=True)
class Position:
    """Where the channel stands: axis positions, and the programmed values that lead there."""

    axes: Array
    program: Array


@dataclass(frozen=True, slots=True)
class SystemDefinition:
    """A stored `#CS DEF`: shift mm and angles degrees, relative to the level it is used on.

    kind: `#CS`, `#ACS` or `#BCS`; each counts its own ids. id: a number or a name.
    """

    kind: str
    id: int | str
    values: tuple[float, ...]
    origin: str
    temporary: bool = False


@dataclass(frozen=True, slots=True)
class NamedSystem:
    """A system of the stack of #CS ADD. frame: the system below from this one."""

    name: str
    frame: Frame
    origin: str


@dataclass(frozen=True)
class SelectedTool(Changing):
    """The tool that acts: T and D words, and the record with what the program wrote into it.

    correction: mm that #TLC adds to the length; correction_at: its place, None when it is off.
    """

    place: int = 0
    record_index: int = 0
    record: Tool = field(default_factory=Tool)
    selected_at: str | None = None
    correction: float = 0.0
    correction_at: str | None = None


@dataclass(frozen=True, slots=True)
class LengthAxis:
    """#TLAX: the main axis 0 to 2 that takes the tool length in every plane, and its sign."""

    axis: int
    sign: float


@dataclass(frozen=True, slots=True)
class Kinematics:
    """The kinematic data sets with what the program wrote into them, and which are preselected.

    parameters: of the first step, by id. second, program: those of the second step and of PCS
    transformations. ids: preselected for the first and the second step, 0 for none. active: the
    ids that are on. program_id: preselected for #TRAFO PCS.
    """

    parameters: Mapping[int, KinematicParameters]
    ids: tuple[int, int] = (0, 0)
    active: tuple[int, int] = (0, 0)
    second: Mapping[int, KinematicParameters] = field(default_factory=dict)
    program: Mapping[int, KinematicParameters] = field(default_factory=dict)
    program_id: int = 0

    @property
    def is_on(self) -> bool:
        """Whether a transformation is selected, also while #MCS suspends it."""
        return self.active != (0, 0)

    def sets(self, step: int) -> Mapping[int, KinematicParameters]:
        """The data sets of step 0, step 1 or PROGRAM_STEP."""
        return (self.parameters, self.second, self.program)[step]


@dataclass(frozen=True, slots=True)
class SystemMode:
    """What #CS MODE set; None stands for the channel parameter (P-CHAN-00393, P-CHAN-00394).

    per_level: every level keeps offsets of its own for the axes beyond the third (P-CHAN-00397).
    """

    sequence: str | None = None
    fixed: bool | None = None
    per_level: bool = True


@dataclass(frozen=True, slots=True)
class Suspended:
    """What #MCS OFF brings back: coordinates and zero offset group at #MCS ON.

    ex_tool: a D word inside does not act before #MCS OFF. tool_acts: a D word inside acts.
    """

    coordinates: Coordinates
    zero_index: int
    ex_tool: bool = False
    tool_acts: bool = False


@dataclass(frozen=True, slots=True)
class Measured:
    """A measured position and its difference to the target of G100; mm or degrees.

    value: in the system of V.A.MESS. program, axis: the programmed value and the axis position.
    """

    value: float
    offset: float = 0.0
    program: float = 0.0
    axis: float = 0.0


@dataclass(frozen=True, slots=True)
class Measuring:
    """What #MEAS set: the type of measuring runs, and whether the probe must answer.

    Source: P-CHAN-00057, P-CHAN-00176.
    """

    type: int = 1
    must_answer: bool = False


class Stored(NamedTuple):
    """One user variable: a number, a text, or an array with its dimensions.

    length: of a STRING. level: the program level that declared a V.L or V.CYC variable; outer: the
    variable of an outer level that this one hides.
    """

    value: float | str | Elements[float | str]
    dimensions: tuple[int, ...] = ()
    type: str = "REAL64"
    length: int = 0
    level: int = 0
    outer: Stored | None = None


@dataclass(frozen=True, slots=True)
class CallRequest:
    """A subprogram that a block calls; it is found and entered behind the block.

    kind: `LL` for a local one, `L` for a file, `SEQUENCE` for a part of a program. name: "" for
    the running program of a sequence. parameters: @P values of a cycle by number, None for a plain
    subprogram. modal: `MODAL_MOVE` or `MODAL_BLOCK` when the request comes from a modal cycle.
    first, last: labels or block numbers of a sequence; endtag: its own call ends it too.
    home: the file whose local subprograms LL means, "" for the running one.
    """

    kind: str
    name: str
    span: Span
    parameters: Mapping[int, float | str] | None = None
    modal: str = ""
    first: str = ""
    last: str = ""
    repeat: int = 1
    endtag: bool = False
    home: str = ""


@dataclass(frozen=True, slots=True)
class Return:
    """What M17 brackets ask for: how many calls to leave (0: all), and a label to go on at."""

    span: Span
    levels: int = 1
    label: str = ""


@dataclass(frozen=True, slots=True)
class Running:
    """Which program runs: what the blocks of a subprogram or cycle may ask.

    level: depth of calls, 0 in the main program. file: its name. parameters: @P values of the
    cycle, None outside of one. modal: the cycle that is called again after every motion.
    in_modal: whether that cycle is what runs. retain: modal changes of this cycle stay.
    """

    level: int = 0
    file: str = ""
    parameters: Mapping[int, float | str] | None = None
    modal: CallRequest | None = None
    in_modal: bool = False
    retain: bool = False


@dataclass(frozen=True)
class State(Changing):
    """Everything that a block may read or change.

    axes: the channel configuration. tools: the tool table with what the program wrote into it.
    length_axis: None lets the tool length follow the plane. variables: `P5`, `V.P.NAME` -> value.
    definitions: stored coordinate systems by kind (`#CS`, `#ACS`, `#BCS`) and id, in the order of
    their definition.
    systems: the stack of #CS ADD from bottom to top; selected: how many of them act. stacks: the
    transformation stacks by name.
    parked: positions of axes that left the channel, by logical number. turn, scale_factors: the
    values programmed last for #ROTATION and #SCALE, by channel index. suspended: what waits while
    #MCS is on. converted: what #TRANSFORM and its relatives computed, by variable and axis name, mm
    or degrees. measured: what G100 measured, by axis name. probe: the answers that are given.
    manual: the jog increments that are given. manual_offsets: what #GET MANUAL OFFSETS fetched, by
    axis name, mm and degrees.
    circle: the corrected I, J, K and R of the last arc, mm. message_file: where #MSG SAVE writes.
    called_files: what #FILE NAME set for M6 and G80 ... running: the program level.
    """

    axes: tuple[Axis, ...]
    coordinates: Coordinates
    position: Position
    kinematics: Kinematics
    zero_offsets: ZeroOffsets
    tools: Mapping[int, Tool] = field(default_factory=dict)
    modal: Modal = Modal()
    tool: SelectedTool = field(default_factory=SelectedTool)
    length_axis: LengthAxis | None = None
    zero_index: int = 0
    clamp_index: int = 0
    variables: Mapping[str, Stored] = field(default_factory=dict)
    definitions: Mapping[tuple[str, int | str], SystemDefinition] = field(default_factory=dict)
    systems: tuple[NamedSystem, ...] = ()
    selected: int = 0
    stacks: Mapping[str, TransformationStack] = field(default_factory=dict)
    macros: Mapping[str, str] = field(default_factory=dict)
    parked: Mapping[int, float] = field(default_factory=dict)
    turn: Turn = field(default_factory=Turn)
    scale_factors: Mapping[int, float] = field(default_factory=dict)
    suspended: Suspended | None = None
    system_mode: SystemMode = field(default_factory=SystemMode)
    converted: Mapping[tuple[str, str], float] = field(default_factory=dict)
    measured: Mapping[str, Measured] = field(default_factory=dict)
    circle: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    measuring: Measuring = field(default_factory=Measuring)
    probe: GivenRows | None = None
    manual: GivenRows | None = None
    manual_offsets: Mapping[str, float] = field(default_factory=dict)
    message_file: str = "message.txt"
    called_files: Mapping[str, str] = field(default_factory=dict)
    running: Running = field(default_factory=Running)
    block: int | None = None

    @property
    def axis_names(self) -> tuple[str, ...]:
        return tuple(axis.name for axis in self.axes)

    @property
    def main_axes(self) -> tuple[int, int, int]:
        """Channel indices of the first, second and third axis of the plane."""
        return _PLANES[self.modal.plane]

    def unit(self, axis: int) -> float:
        """Mm or degrees of one programmed unit; a word of a direction in space has no unit."""
        active = self.coordinates.kinematics
        bare = active is not None and axis in active.model.orientation
        return 1.0 if bare or self.axes[axis].rotary else self.modal.length_factor

    def with_coordinates(self, coordinates: Coordinates, *, keep: str = "axes") -> State:
        """The state under other coordinates; nothing moves.

        keep: `level` where only offsets of the innermost level changed (exact, and no inverse
        transformation is needed), else `axes`.
        """
        if keep == "level":
            level = self.coordinates.level_from_program(self.position.program)
            program = coordinates.program_from_level(level)
        else:
            both = self.coordinates.kinematics is not None and coordinates.kinematics is not None
            near = self.position.program if both else None
            program = coordinates.to_program(self.position.axes, near)
        position = Position(self.position.axes, program)
        return self.changed(coordinates=coordinates, position=position)
