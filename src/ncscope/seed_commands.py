"""The commands of the three manuals about offsets, each with the test case that shows it.

A name is a G function (`G92`), a # command (`#CS ON`), an NC variable as its table spells it, the
id of a list parameter (`P-ZERO-00001`), or a word (`D`). Cases are folders of `tests/cases`.
Source: FCT-C2 coordinate systems and offsets; ZERO zero offsets; #CS definition.
"""

from __future__ import annotations

from typing import NamedTuple


class SeedCommand(NamedTuple):
    """place: manual and section. form: how the manual writes it. name: where its status stands."""

    place: str
    form: str
    name: str
    case: str


# fmt: off
SEED_COMMANDS: tuple[SeedCommand, ...] = (
    SeedCommand("FCT-C2 2.1", "G90", "G90", "e03_g92_waits_for_g90"),
    SeedCommand("FCT-C2 2.1", "G91", "G91", "g91_after_g54_moves_the_increment"),
    SeedCommand("FCT-C2 2.2.1", "#CS ON", "#CS ON", "cs_change_keeps_the_machine_position"),
    SeedCommand("FCT-C2 2.2.1", "#CS OFF", "#CS OFF", "life_of_offsets"),
    SeedCommand("FCT-C2 2.2.1", "#TOOL ORI CS", "#TOOL ORI CS", "tool_ori_cs_turns_the_tool"),
    SeedCommand("FCT-C2 2.2.2", "#ROTATION ON", "#ROTATION ON", "e14_contour_rotation"),
    SeedCommand("FCT-C2 2.2.2", "#ROTATION OFF", "#ROTATION OFF", "rotation_off_and_on"),
    SeedCommand("FCT-C2 2.2.2", "G17", "G17", "e14_contour_rotation"),
    SeedCommand("FCT-C2 2.2.2", "G18", "G18", "plane_change_ends_the_rotation"),
    SeedCommand("FCT-C2 2.2.2", "G19", "G19", "tool_length_axis_preset"),
    SeedCommand("FCT-C2 2.2.3", "#ACS ON", "#ACS ON", "acs_below_cs"),
    SeedCommand("FCT-C2 2.2.3", "#ACS OFF", "#ACS OFF", "acs_below_cs"),
    SeedCommand("FCT-C2 2.2.5", "#ECS ON", "#ECS ON", "ecs_moves_along_the_tool"),
    SeedCommand("FCT-C2 2.2.5", "#ECS OFF", "#ECS OFF", "ecs_moves_along_the_tool"),
    SeedCommand("FCT-C2 2.2.6", "#MCS ON", "#MCS ON", "mcs_programs_axis_positions"),
    SeedCommand("FCT-C2 2.2.6", "#MCS ON [EX TOOL]", "#MCS ON", "mcs_without_the_tool"),
    SeedCommand("FCT-C2 2.2.6", "#MCS OFF", "#MCS OFF", "mcs_programs_axis_positions"),
    SeedCommand("FCT-C2 1", "G100", "G100", "e19_measured_offset"),
    SeedCommand("FCT-C2 2.3", "G101", "G101", "e19_measured_offset"),
    SeedCommand("FCT-C2 2.3", "G102", "G102", "e19_measured_offset"),
    SeedCommand("FCT-C2 2.4", "G201", "G201", "e22_manual_offset"),
    SeedCommand("FCT-C2 2.4", "G202", "G202", "e22_manual_offset"),
    SeedCommand("FCT-C2 2.4", "#GET MANUAL OFFSETS", "#GET MANUAL OFFSETS", "e22_manual_offset"),
    SeedCommand("FCT-C2 2.5", "#PSET", "#PSET", "e04_pset_with_g92"),
    SeedCommand("FCT-C2 2.5", "#PRESET", "#PRESET", "e04_pset_and_preset"),
    SeedCommand("FCT-C2 2.5", "G74", "G74", "homing_ends_the_preset"),
    SeedCommand("FCT-C2 2.6", "G92", "G92", "e03_g92_adds_under_g91"),
    SeedCommand("FCT-C2 2.7", "G53", "G53", "g53_takes_the_zero_offset_away"),
    SeedCommand("FCT-C2 2.7", "G54", "G54", "e16_e17_zero_offsets"),
    SeedCommand("FCT-C2 2.7", "G159=", "G159", "g159_selects_by_number"),
    SeedCommand("FCT-C2 2.8", "D16", "D", "e12_tool_length"),
    SeedCommand("FCT-C2 2.8", "D0", "D", "e12_tool_length"),
    SeedCommand("FCT-C2 2.8", "move_tool_offsets_directly", "P-CHAN-00100", "tool_moves_at_once"),
    SeedCommand("FCT-C2 2.8", "tool_fixed", "P-TOOL-00010", "tool_fixed_stays_along_machine_axes"),
    SeedCommand("FCT-C2 2.8.1", "#TLC ON", "#TLC ON", "tlc_changes_the_length"),
    SeedCommand("FCT-C2 2.8.1", "#TLC OFF", "#TLC OFF", "tlc_changes_the_length"),
    SeedCommand("FCT-C2 2.9", "pzv_grp", "P-CLMP-00001", "clamp_position"),
    SeedCommand("FCT-C2 2.9", "V.G.AKT_PLATZ", "V.G.AKT_PLATZ", "value_variables"),
    SeedCommand("FCT-C2 2.10", "#SUPPRESS OFFSETS", "#SUPPRESS OFFSETS", "e02_suppress_offsets"),
    SeedCommand("FCT-C2 3.2", "achs_typ", "P-AXIS-00018", "axis_type_decides_the_unit"),
    SeedCommand("FCT-C2 3.3", "bezeichnung", "P-CHAN-00006", "axis_type_decides_the_unit"),
    SeedCommand("ZERO 2.1", "g53_verfuegbar", "P-ZERO-00001", "e17_group_0_is_a_record"),
    SeedCommand("ZERO 2.2", "default_index", "P-ZERO-00002", "life_of_offsets"),
    SeedCommand("ZERO 2.3", "G55", "G55", "zero_offsets_of_the_printed_list"),
    SeedCommand("ZERO 2.3", "G56", "G56", "zero_offsets_of_the_printed_list"),
    SeedCommand("ZERO 2.3", "G57", "G57", "zero_offsets_of_the_printed_list"),
    SeedCommand("ZERO 2.3", "G58", "G58", "zero_offsets_of_the_printed_list"),
    SeedCommand("ZERO 2.3", "G59", "G59", "zero_offsets_of_the_printed_list"),
    SeedCommand("ZERO 2.3.1.1", "versch", "P-ZERO-00003", "life_of_offsets"),
    SeedCommand("ZERO 2.3.1.2", "inaktiv", "P-ZERO-00004", "zero_offsets_of_the_printed_list"),
    SeedCommand("#CS", "#CS DEF", "#CS DEF", "seed_cs_2_stored_definitions"),
    SeedCommand("#CS", "#CS ON", "#CS ON", "seed_cs_2_stored_definitions"),
    SeedCommand("#CS", "#CS OFF", "#CS OFF", "e06_chained_systems"),
    SeedCommand("#CS", "#CS OFF ALL", "#CS OFF ALL", "cs_off_all"),
)
# fmt: on
