"""Zero offsets, clamp positions, tools and channel settings from their lists.

List units are 0.1 um (0.0001 inch for tools in inches) and 0.0001 degrees; records are in mm and
degrees. Source: P-ZERO-00001 to -00004, P-CLMP-00001, P-TOOL-00003 to -00011, P-TOOL-00146.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.lists.axes import UNITS
from ncscope.lists.values import MACRO_TEXT, Reading, Value
from ncscope.machine import ChannelSettings, OffsetRecord, Tool, ZeroOffsets

MM_PER_INCH = 25.4
ROTATION_SEQUENCES = frozenset(
    ("XYZ", "XYX", "XZY", "XZX", "YXZ", "YXY", "YZX", "YZY", "ZXY", "ZXZ", "ZYX", "ZYZ")
)

CALLED_FILE = re.compile(r"(m6|g8[0-9]|g800)_prog_file(?:\[\])?")
NESTED_QUOTE = re.compile(r'\\+"')
"""The mark of a macro inside of a macro."""
SUBPROGRAM_PATH = 2
"""The bit of path[].type that stands for subprograms."""

SETTINGS_OF_KEYS = {
    "kinematik_id": "default_kinematic_id",
    "default_id_of_kin_step[0]": "default_kinematic_id",
    "default_id_of_kin_step[1]": "default_second_id",
    "default_id_of_trafo_pcs": "default_program_step_id",
    "default_id_of_trafo_pcs[0]": "default_program_step_id",
    "ori_rotation_angle": "orientation_mode",
    "move_tool_offsets_directly": "tool_moves_at_once",
    "einrechnen_mit_t": "tool_with_t",
    "remain_tool_length_in_ax": "tool_length_stays",
    "messtyp": "measuring_type",
    "meas_error_no_signal": "probe_must_answer",
    "p_param_haltend": "keep_parameters",
    "ori.mode": "orientation_words",
    "ax_offsets_with_active_kin": "tool_offsets_stay",
    "ori_wcs": "direction_turns",
    "ori_interpolation_mode": "direction_path",
    "suppress_trafo_in_g0_blocks": "rapid_straight",
    "auto_enable_kin_trafo": "transformation_at_start",
    "auto_disable_kin_trafo": "transformation_ends",
    "permitted_trafo_deviation_limit": "deviation",
    "tool_ori_cs.axis": "tool_orientation_axis",
    "tool_ori_cs.mode": "tool_orientation_mode",
    "coordinate_system.rotation_sequence": "rotation_sequence",
    "coordinate_system.rotation_mode_fixed": "rotation_fixed",
    "coordinate_system.axes_offsets_layer_specific": "offsets_per_level",
    "kind_of_2nd_ecs_ax": "ecs_axis",
    "mach_plane_of_2nd_ecs_ax": "ecs_plane",
    "enable_mod_axis_always_shortest_way": "modulo_shortest",
    "versch_im_durchm": "offsets_in_diameter",
    "mittelpkt_diff": "centre_shift",
    "mittelpkt_faktor": "centre_shift_share",
    "max_radius_diff_circle": "radius_difference",
    "max_proz_radius_diff_circle": "radius_difference_share",
    "cycle_changes_modal": "cycle_changes_stay",
    "start_init_prog_file": "start_file",
    "final_prog_file": "end_file",
    "configuration.decoder.macro_symbol_len": "macro_name_length",
}
"""List keys of the channel settings and their names in `ChannelSettings`."""
ECS_WORDS = {"ecs_axis": ("X", "Y"), "ecs_plane": ("XY", "ZX", "YZ")}
SETTING_UNITS = {
    "deviation": UNITS,
    "centre_shift": UNITS,
    "centre_shift_share": 1000.0,
    "radius_difference": UNITS,
    "radius_difference_share": 1000.0,
}
"""List units in a millimetre, per mille in the whole."""


def zero_offsets(readings: Iterable[Reading]) -> ZeroOffsets:
    """The zero offset groups that the list mentions."""
    groups: dict[int, dict[str, Reading]] = defaultdict(dict)
    single: dict[str, Reading] = {}
    for reading in readings:
        if reading.value is None:
            continue
        if len(reading.indices) == 2:
            groups[reading.indices[0]][f"{reading.field}{reading.indices[1]}"] = reading
        else:
            single[reading.row.key] = reading
    return ZeroOffsets(
        {group: _offset_record(parts.values()) for group, parts in sorted(groups.items())},
        bool(_number(single, "g53_verfuegbar")),
        int(_number(single, "default_index")),
    )


def clamp_positions(readings: Iterable[Reading]) -> dict[int, OffsetRecord]:
    """The clamp position groups that the list mentions."""
    groups: dict[int, list[Reading]] = defaultdict(list)
    for reading in readings:
        if reading.value is not None:
            groups[reading.indices[0]].append(reading)
    return {group: _offset_record(parts) for group, parts in sorted(groups.items())}


TOOL_DATA = (
    "typ", "srk_lage", "log_ax_nr_spdl", "vb_min", "vb_max", "a_max",
    "tool_id.sister", "tool_id.sister_valid", "tool_id.variant", "tool_id.variant_valid",
)  # fmt: skip
"""Fields of a tool record that programs can read and that change no position."""


def tools(readings: Iterable[Reading], rotary: frozenset[int] = frozenset()) -> dict[int, Tool]:
    """The tool records that the list mentions, by tool index.

    rotary: channel indices of rotary axes, whose offsets are angles in any unit of length.
    """
    found: dict[int, dict[tuple[str, int], Reading]] = defaultdict(dict)
    for reading in readings:
        if reading.value is not None and reading.row.key.startswith("wz[]."):
            index = reading.indices[1] if len(reading.indices) > 1 else 0
            found[reading.indices[0]][_tool_field(reading), index] = reading
    return {index: _tool(parts, rotary) for index, parts in sorted(found.items())}


def channel_settings(
    readings: Iterable[Reading],
) -> tuple[ChannelSettings, tuple[Diagnostic, ...]]:
    """The settings of the channel list; the last entry of a setting counts."""
    values: dict[str, Any] = {}
    found: list[Diagnostic] = []
    readings = tuple(readings)
    for reading in readings:
        name = SETTINGS_OF_KEYS.get(reading.entry.key.lower())
        if name is None or reading.value is None:
            continue
        fault = _bad_word(name, reading)
        if fault is None:
            values[name] = _setting(name, reading.value)
        else:
            found.append(fault)
    values["called_files"] = _called_files(readings)
    values["macros"] = _macros(readings)
    values["search_paths"] = _search_paths(readings)
    return ChannelSettings(**values), tuple(found)


def _bad_word(name: str, reading: Reading) -> Diagnostic | None:
    """The fault of a setting whose value is a word that it does not know."""
    if name == "rotation_sequence" and reading.value not in ROTATION_SEQUENCES:
        return _bad_sequence(reading)
    if name in ECS_WORDS and str(reading.value).upper() not in ECS_WORDS[name]:
        return _bad_ecs_word(reading, ECS_WORDS[name])
    return None


def _setting(name: str, value: Value) -> Any:
    """The value with the type and the unit of its field in `ChannelSettings`."""
    if name in ECS_WORDS:
        value = str(value).upper()
    typed = type(getattr(ChannelSettings(), name))(value)
    return typed / SETTING_UNITS[name] if name in SETTING_UNITS else typed


def _called_files(readings: Iterable[Reading]) -> dict[str, str]:
    """The file of each function that calls one, by its name in programs."""
    files: dict[str, str] = {}
    for reading in readings:
        found = CALLED_FILE.fullmatch(reading.row.key)
        if found is None or not isinstance(reading.value, str):
            continue
        name = found.group(1).upper()
        files[f"G{800 + reading.indices[0]}" if name == "G800" else name] = reading.value
    return files


def _macros(readings: Iterable[Reading]) -> dict[str, str]:
    """The macros of the list. A text has blanks; it ends at a comment in round brackets."""
    parts: dict[int, dict[str, str]] = defaultdict(dict)
    for reading in readings:
        if reading.row.key in ("makro_def[].symbol", MACRO_TEXT):
            text = (reading.entry.value_text + reading.entry.rest).partition("(")[0].strip()
            parts[reading.indices[0]][reading.field] = NESTED_QUOTE.sub('"', text)
    return {
        part["symbol"]: part.get("nc_code", "")
        for _, part in sorted(parts.items())
        if part.get("symbol")
    }


def _search_paths(readings: Iterable[Reading]) -> tuple[str, ...]:
    """Folders of the kind "subprogram" by their priority; 0 and equal ones in list order."""
    parts: dict[int, dict[str, Reading]] = defaultdict(dict)
    for reading in readings:
        if reading.row.key.startswith("path[].") and reading.value is not None:
            parts[reading.indices[0]][reading.field] = reading
    folders = [
        (_number(part, "priority"), index, str(part["dir"].value))
        for index, part in sorted(parts.items())
        if "dir" in part and int(_number(part, "type")) & SUBPROGRAM_PATH
    ]
    return tuple(folder for _, _, folder in sorted(folders))


def _offset_record(readings: Iterable[Reading]) -> OffsetRecord:
    values: dict[int, float] = {}
    origins: dict[int, str] = {}
    inactive: dict[int, bool] = {}
    for reading in readings:
        axis = reading.indices[1]
        if reading.field == "inaktiv":
            inactive[axis] = bool(reading.value)
            continue
        values[axis] = float(reading.value or 0) / UNITS
        origins[axis] = reading.entry.place
    return OffsetRecord(values, frozenset(a for a, off in inactive.items() if off), origins)


def _tool_field(reading: Reading) -> str:
    return reading.row.key.removeprefix("wz[].").removesuffix("[]")


def _tool(parts: Mapping[tuple[str, int], Reading], rotary: frozenset[int]) -> Tool:
    single = {field: reading for (field, _), reading in parts.items()}
    factor = (MM_PER_INCH if _number(single, "mass_einheit") == 1 else 1.0) / UNITS
    offsets = _indexed(parts, "ax_versatz")
    return Tool(
        length=_number(single, "laenge") * factor,
        radius=_number(single, "radius") * factor,
        axis_offsets={
            axis: value / UNITS if axis in rotary else value * factor
            for axis, value in offsets.items()
        },
        valid=bool(_number(single, "gueltig")),
        fixed=bool(_number(single, "tool_fixed")),
        orientation=_orientation(_indexed(parts, "orientation_vector")),
        kinematic_id=int(_number(single, "kin_id")),
        kinematic_parameters=_indexed(parts, "kinematic.param"),
        parameters=_indexed(parts, "param"),
        data={key: _number(single, key) for key in TOOL_DATA if key in single},
        origin=single.get("laenge", next(iter(parts.values()))).entry.place,
    )


def _indexed(parts: Mapping[tuple[str, int], Reading], field: str) -> dict[int, float]:
    return {
        index: float(reading.value or 0)
        for (name, index), reading in sorted(parts.items(), key=lambda item: item[0])
        if name == field
    }


def _orientation(values: Mapping[int, float]) -> tuple[float, float, float] | None:
    vector = (values.get(0, 0.0), values.get(1, 0.0), values.get(2, 0.0))
    return vector if any(vector) else None


def _number(readings: Mapping[str, Reading], key: str) -> float:
    reading = readings.get(key)
    return float(reading.value or 0) if reading else 0.0


def _bad_sequence(reading: Reading) -> Diagnostic:
    message = f"{reading.entry.key} ({reading.row.id}): {reading.value} is no rotation sequence"
    hint = "write one of " + " ".join(sorted(ROTATION_SEQUENCES))
    return diagnostic("22190", reading.entry.value_span, message, hint)


def _bad_ecs_word(reading: Reading, words: tuple[str, ...]) -> Diagnostic:
    message = f"{reading.entry.key} ({reading.row.id}): {str(reading.value).upper()} is not allowed"
    hint = "write one of " + " ".join(words)
    return diagnostic("110552", reading.entry.value_span, message, hint)
