"""The machine as its lists describe it: read once, never changed.

Lengths are millimetres and angles degrees, except inside `KinematicParameters`, which stays in the
units of the list because NC programs read and write it there. `origin` fields say which line of
which list set a value (`nullp.lis:14`), None when no list did.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.readings import STANDARD, Reading

if TYPE_CHECKING:
    from ncscope.diagnostics import Span
    from ncscope.kinematics.step import Builder, KinematicStep

ZERO_GROUPS = 97
"""Zero offset groups 0..96 (P-ZERO-00002)."""
CLAMP_GROUPS = 150
TOOL_RECORDS = 201
MAX_CHANNEL_AXES = 32


@dataclass(frozen=True, slots=True)
class Axis:
    """One axis of the channel, at its channel index.

    `number` is the logical axis number. `assumed`: no axis list said whether the axis is rotary.
    `modulo_range`: (low, high) in degrees for a modulo axis, else None.
    `face_turning`: the axis that G51 acts on (P-AXIS-00015); `diameter_absolute` and
    `diameter_relative`: whether its words are diameters under G90 and G91.
    `limits`: software limits (mm or degrees) of the axis position, None when none are monitored.
    `reference`: position after homing. `measuring`: G100 may measure with it (P-AXIS-00118).
    """

    name: str
    number: int
    rotary: bool = False
    assumed: bool = False
    modulo_range: tuple[float, float] | None = None
    limits: tuple[float, float] | None = None
    reference: float = 0.0
    face_turning: bool = False
    diameter_absolute: bool = False
    diameter_relative: bool = False
    measuring: bool = True


@dataclass(frozen=True, slots=True)
class OffsetRecord:
    """One zero offset or clamp position group: values by channel axis index, mm or degrees.

    `inactive` holds the axis indices that the group leaves out (P-ZERO-00004);
    `origins` the place that set each axis value.
    """

    values: Mapping[int, float] = field(default_factory=dict)
    inactive: frozenset[int] = frozenset()
    origins: Mapping[int, str] = field(default_factory=dict)

    def effective(self, axis: int) -> float:
        """The offset that counts for the axis: 0 where the group leaves the axis out."""
        return 0.0 if axis in self.inactive else self.values.get(axis, 0.0)


@dataclass(frozen=True, slots=True)
class ZeroOffsets:
    """The zero offset list. `group_0_is_offset` is g53_verfuegbar (P-ZERO-00001)."""

    groups: Mapping[int, OffsetRecord] = field(default_factory=dict)
    group_0_is_offset: bool = False
    default_index: int = 0

    def record(self, group: int) -> OffsetRecord:
        """The record that a selection of `group` brings; empty when group 0 means "no offset"."""
        if group == 0 and not self.group_0_is_offset:
            return OffsetRecord()
        return self.groups.get(group, OffsetRecord())


@dataclass(frozen=True, slots=True)
class Tool:
    """One tool data record (`wz[i]`): mm, axis offsets by channel axis index.

    `fixed`: P-TOOL-00010, offsets act along machine axes even in a rotated coordinate system.
    `orientation`: P-TOOL-00146, mount -> tip in the machine system, None when not configured.
    `kinematic_parameters`: wz[i].kinematic.param[j], list units, added to param[j].
    `parameters`: wz[i].param[j], for the program's own use. `data`: what has no effect on
    positions, by its list key without `wz[i].`, in list units; programs can read it.
    """

    length: float = 0.0
    radius: float = 0.0
    axis_offsets: Mapping[int, float] = field(default_factory=dict)
    valid: bool = True
    fixed: bool = False
    orientation: tuple[float, float, float] | None = None
    kinematic_id: int = 0
    kinematic_parameters: Mapping[int, float] = field(default_factory=dict)
    parameters: Mapping[int, float] = field(default_factory=dict)
    data: Mapping[str, float] = field(default_factory=dict)
    origin: str | None = None


@dataclass(frozen=True, slots=True)
class ExternalVariable:
    """One V.E variable of the list of external variables (P-EXTV).

    elements: of an array, 0 for a single value. length: characters of a STRING.
    access: READ_ONLY, WRITE_ONLY or READ_WRITE, as the NC program sees it.
    """

    type: str = "REAL64"
    elements: int = 0
    length: int = 126
    access: str = "READ_WRITE"


@dataclass(frozen=True, slots=True)
class ChannelSettings:
    """Channel parameters that change what a program means."""

    default_kinematic_id: int = 0  # P-CHAN-00032, P-CHAN-00264 default_id_of_kin_step[0]
    default_second_id: int = 0  # P-CHAN-00264 default_id_of_kin_step[1]
    default_program_step_id: int = 0  # P-CHAN-00854 default_id_of_trafo_pcs
    orientation_mode: int = 0  # P-CHAN-00112 ori_rotation_angle
    tool_moves_at_once: bool = False  # P-CHAN-00100 move_tool_offsets_directly
    tool_with_t: bool = False  # P-CHAN-00014 einrechnen_mit_t
    tool_length_stays: bool = False  # P-CHAN-00420 remain_tool_length_in_ax
    measuring_type: int = 1  # P-CHAN-00057 messtyp
    probe_must_answer: bool = False  # P-CHAN-00176 meas_error_no_signal
    keep_parameters: bool = False  # P-CHAN-00067 p_param_haltend
    rotation_sequence: str = "ZYX"  # P-CHAN-00394
    rotation_fixed: bool = False  # P-CHAN-00393
    offsets_per_level: bool = True  # P-CHAN-00397
    orientation_words: str = "ANGLE"  # P-CHAN-00177 ori.mode
    tool_offsets_stay: bool = False  # P-CHAN-00851 ax_offsets_with_active_kin
    direction_turns: bool = False  # P-CHAN-00247 ori_wcs
    direction_path: int = 0  # P-CHAN-00417 ori_interpolation_mode
    rapid_straight: bool = False  # P-CHAN-00423 suppress_trafo_in_g0_blocks
    transformation_at_start: bool = False  # P-CHAN-00151 auto_enable_kin_trafo
    transformation_ends: bool = False  # P-CHAN-00152 auto_disable_kin_trafo
    deviation: float = 3e-4  # P-CHAN-00228 permitted_trafo_deviation_limit, mm and degrees
    tool_orientation_axis: int = 0  # P-CHAN-00188 tool_ori_cs.axis
    tool_orientation_mode: int = 0  # P-CHAN-00189 tool_ori_cs.mode
    ecs_axis: str = ""  # P-CHAN-00031 kind_of_2nd_ecs_ax
    ecs_plane: str = ""  # P-CHAN-00050 mach_plane_of_2nd_ecs_ax
    offsets_in_diameter: bool = False  # P-CHAN-00091 versch_im_durchm
    modulo_shortest: bool = False  # P-CHAN-00346 enable_mod_axis_always_shortest_way
    centre_shift: float = 2.0  # P-CHAN-00059 mittelpkt_diff, mm
    centre_shift_share: float = 0.05  # P-CHAN-00060 mittelpkt_faktor, of the radius
    radius_difference: float = 0.005  # P-CHAN-00171 max_radius_diff_circle, mm
    radius_difference_share: float = 0.001  # P-CHAN-00172 max_proz_radius_diff_circle
    cycle_changes_stay: bool = False  # P-CHAN-00210 cycle_changes_modal
    start_file: str = ""  # P-CHAN-00119 start_init_prog_file
    end_file: str = ""  # P-CHAN-00252 final_prog_file
    macro_name_length: int = 30  # P-CHAN-00511 configuration.decoder.macro_symbol_len
    macros: Mapping[str, str] = field(default_factory=dict)
    """Texts of the macros that the list defines, by name (P-CHAN-00085, P-CHAN-00062)."""
    called_files: Mapping[str, str] = field(default_factory=dict)
    """Files that `M6`, `G80` .. `G89` and `G800` .. `G839` call (P-CHAN-00118, 00160.., 00187)."""
    search_paths: tuple[str, ...] = ()
    """Folders of subprograms, first the one that is searched first (P-CHAN-00401 to 00404)."""


@dataclass(frozen=True, slots=True)
class ConfiguredSystem:
    """A coordinate system of the channel list (P-CHAN-00490 to P-CHAN-00496).

    values: shift in mm, angles in degrees.
    """

    values: tuple[float, ...]
    origin: str


@dataclass(frozen=True, slots=True)
class TransformationStack:
    """Coordinate systems and a kinematics that are switched together (#TRAFO STACK).

    systems: kind (`#BCS`, `#ACS`, `#CS`) and id, from bottom to top. kinematics: ids of the first
    and second step, 0 for none.
    """

    name: str
    systems: tuple[tuple[str, int | str], ...] = ()
    kinematics: tuple[int, int] = (0, 0)
    origin: str | None = None


@dataclass(frozen=True, slots=True)
class StackAtStart:
    """The transformation stack that is active from program start (P-CHAN-00757)."""

    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class Machine:
    """A channel with its axes, offsets, tools and kinematics; frozen.

    `axes` are in channel order: index 0, 1, 2 are the main axes. `known_axes` are all axes that
    axis lists describe or the channel lists, by logical number: `#SET AX` fetches from them; when
    it is empty any number may be fetched. `kinematic_parameters`: by kinematic id.
    `second_step_parameters`, `program_step_parameters`: the same for the second step of a
    transformation (kin_step[1]) and for PCS transformations (trafo_pcs).
    `kinematic_types`: what makes a kinematics of a data set, by type number; 91 is built in.
    `kinematic_reading`: how parameters of type 91 are understood where the manual is open.
    `systems`: the configured coordinate systems by their id, for #CS, #ACS and #BCS alike.
    `external`: the V.E variables that are declared, by name.
    `stacks`: the configured transformation stacks by name; `stack_at_start`: P-CHAN-00757.
    """

    name: str = "XYZ"
    axes: tuple[Axis, ...] = (Axis("X", 1), Axis("Y", 2), Axis("Z", 3))
    known_axes: Mapping[int, Axis] = field(default_factory=dict)
    zero_offsets: ZeroOffsets = ZeroOffsets()
    clamp_positions: Mapping[int, OffsetRecord] = field(default_factory=dict)
    tools: Mapping[int, Tool] = field(default_factory=dict)
    kinematic_parameters: Mapping[int, KinematicParameters] = field(default_factory=dict)
    settings: ChannelSettings = ChannelSettings()
    second_step_parameters: Mapping[int, KinematicParameters] = field(default_factory=dict)
    program_step_parameters: Mapping[int, KinematicParameters] = field(default_factory=dict)
    kinematic_types: Mapping[int, Builder] = field(default_factory=dict)
    kinematic_reading: Reading = STANDARD
    systems: Mapping[int | str, ConfiguredSystem] = field(default_factory=dict)
    external: Mapping[str, ExternalVariable] = field(default_factory=dict)
    stacks: Mapping[str, TransformationStack] = field(default_factory=dict)
    stack_at_start: StackAtStart | None = None

    @property
    def axis_names(self) -> tuple[str, ...]:
        return tuple(axis.name for axis in self.axes)

    @property
    def kinematics(self) -> Mapping[int, KinematicStep]:
        """The kinematics by id, ready for `forward` and `inverse`.

        Access raises KinematicsError where the lists do not describe a usable kinematics.
        """
        return _Kinematics(self)

    @property
    def kinematic_ids_of_user(self) -> tuple[int, ...]:
        """Ids of the data sets that need a kinematics of the user (types 500 to 999)."""
        from ncscope.kinematics.building import FIRST_ID, LAST_ID, type_of

        sets = (
            self.kinematic_parameters,
            self.second_step_parameters,
            self.program_step_parameters,
        )
        ids = {id for held in sets for id, p in held.items() if FIRST_ID <= type_of(p) <= LAST_ID}
        return tuple(sorted(ids))


class _Kinematics(Mapping[int, "KinematicStep"]):
    def __init__(self, machine: Machine) -> None:
        self._machine = machine

    def __getitem__(self, id: int) -> KinematicStep:
        from ncscope.kinematics.building import build

        machine = self._machine
        parameters = machine.kinematic_parameters[id]
        mode = machine.settings.orientation_mode
        types, reading = machine.kinematic_types, machine.kinematic_reading
        return build(parameters, machine.axis_names, mode, types, reading)

    def __iter__(self) -> Iterator[int]:
        return iter(sorted(self._machine.kinematic_parameters))

    def __len__(self) -> int:
        return len(self._machine.kinematic_parameters)


def is_rotary_name(name: str) -> bool:
    """Whether an axis without an axis list is taken as rotary: its name begins with A, B or C."""
    return name[:1] in ("A", "B", "C")
