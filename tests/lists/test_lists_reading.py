"""Lists to machines: the lists of the manuals, start-up lists, layers, and hostile files."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ncscope.kinematics.parameters import INDEX_OF_FIELD
from ncscope.lists import ListDocument, check_lists, load_machine, table
from ncscope.lists.check import check_loaded
from ncscope.lists.files import ListFile
from ncscope.lists.reading import assemble, machine_from_documents

MACHINES = Path(__file__).parents[2] / "examples" / "machines"


def machine_of(text, kind="channel"):
    return machine_from_documents([ListFile(kind, ListDocument.from_text(text, "sda.lis"))])


def ids(found):
    return [item.id for item in found]


def write(folder, **texts):
    for name, text in texts.items():
        (folder / f"{name}.lis").write_text(text, encoding="latin-1")
    return folder


def test_zero_list_of_the_manual_as_printed():
    machine, found = load_machine(MACHINES / "zero_list")
    assert [(d.id, d.line, d.column) for d in found] == [
        ("1019", 16, 28),
        ("110303", 18, 1),
        ("110303", 20, 1),
    ]
    zero = machine.zero_offsets
    assert zero.group_0_is_offset and zero.default_index == 2
    assert [zero.record(0).effective(axis) for axis in range(3)] == [0, 0, 0]
    assert zero.record(1).values == {0: 10, 1: 20, 2: 30}
    assert [zero.record(1).effective(axis) for axis in range(3)] == [10, 0, 0]
    assert [zero.record(2).effective(axis) for axis in range(3)] == [-11, 21, 31]
    assert zero.record(8).effective(2) == 34.45
    assert zero.record(1).origins[0] == "nullp.lis:25"


def test_zero_list_repaired():
    machine, found = load_machine(MACHINES / "zero_list_repaired")
    assert found == ()
    assert machine.zero_offsets.record(0).values == {0: 8, 1: 8.1, 2: 8.2}


def test_both_kinematics_spellings_give_equal_parameters():
    old = (MACHINES / "ca_head" / "sda.lis").read_text()
    new = old.replace("kinematik[91].", "trafo[4].") + "trafo[4].id 91\n"
    new = new.replace("Ende\n", "") + "Ende\n"
    first, second = machine_of(old)[0], machine_of(new)[0]
    assert first.kinematic_parameters[91].values == second.kinematic_parameters[91].values
    numbers = "".join(
        f"kin_step[0].trafo[0].param[{i}] {value!r}\n"
        for i, value in enumerate(first.kinematic_parameters[91].values)
    )
    third = machine_of("kin_step[0].trafo[0].id 91\n" + numbers)[0]
    assert third.kinematic_parameters[91].values == first.kinematic_parameters[91].values


def test_printed_table_kinematics_points_at_the_overwriting_lines():
    found = check_lists(MACHINES / "ac_table_as_printed")
    text = (MACHINES / "ac_table_as_printed" / "sda.lis").read_text().splitlines()
    slips = [n for n, line in enumerate(text, 1) if "axis[0].orientation[0]  0" in line]
    overwrites = [d for d in found if d.id == "N3007"]
    assert [d.line for d in overwrites] == slips
    assert [d.hint for d in overwrites] == [
        f"kinematik[91].axis[{axis}].orientation[0] was probably meant" for axis in (1, 2, 3)
    ]
    (fault,) = [d for d in found if d.id == "N3009" and "292007" in d.message]
    assert fault.line == slips[-1]
    assert [span.line for _, span in fault.notes][1:] == slips[:-1]
    assert sum(d.id == "N3001" for d in found) == 5


@pytest.mark.parametrize(
    "name", ["ca_head", "ac_table", "cardanic_table", "kin9_head", "cb_head", "compensated_head"]
)
def test_repaired_kinematics_have_no_faults(name):
    machine, found = load_machine(MACHINES / name)
    assert found == ()
    assert 91 in machine.kinematic_parameters
    checked = check_lists(MACHINES / name)
    assert {d.id for d in checked} <= {"N3004", "N3010"}
    assert not [d for d in checked if d.id == "N3010" and d.severity == "warning"]


def test_axis_types_and_assumption():
    machine, _ = load_machine(MACHINES / "ca_head")
    assert [axis.rotary for axis in machine.axes] == [False, False, False, True, True]
    assert not any(axis.assumed for axis in machine.axes)
    assert check_lists(MACHINES / "ca_head") == ()
    assert ids(check_lists(MACHINES / "xyzac_axes")) == ["N3004", "N3004"]


def test_clamp_positions_and_tools():
    clamp, found = load_machine(MACHINES / "clamp_pallets")
    assert ids(found) == ["N3005", "N3005", "N3001", "N3001"]
    assert clamp.clamp_positions[1].values == {0: -0.001, 1: 0.0088, 2: 0.0}
    tools, found = load_machine(MACHINES / "tools")
    assert found == ()
    assert tools.tools[1].axis_offsets == {0: 75}
    assert (tools.tools[16].length, tools.tools[20].length) == (5, 12.5)
    assert tools.tools[16].valid and tools.tools[16].origin == "werkz.lis:5"


def test_tool_in_inches():
    text = "wz[2].mass_einheit 1\nwz[2].laenge 10000\nwz[2].kinematic.param[5] 7\n"
    machine, _ = machine_of(text + "wz[2].orientation_vector[2] -1\n", "tool")
    tool = machine.tools[2]
    assert tool.length == pytest.approx(25.4)
    assert (tool.kinematic_parameters, tool.orientation) == ({5: 7}, (0, 0, -1))
    assert not tool.valid


def test_axis_list_fields(tmp_path):
    write(
        tmp_path,
        sda="gruppe[0].achse[0].bezeichnung C\ngruppe[0].achse[0].log_achs_nr 7\n",
        default_achs_mds="kenngr.swe_pos 50000\n",
        achs1="kopf.achs_nr 7\nkenngr.achs_typ 0x0002\nkenngr.achs_mode 0x5\n"
        "kenngr.swe_neg -10000\nkenngr.swe_check 1\n"
        "getriebe[0].moduloo 1800000\ngetriebe[0].modulou -1800000\n"
        "getriebe[0].pos_refpkt 25000\n",
        achs2="kopf.achs_nr 8\nkenngr.achs_typ 4\n",
    )
    machine, found = load_machine(tmp_path)
    assert found == ()
    (axis,) = machine.axes
    assert (axis.name, axis.number, axis.rotary, axis.assumed) == ("C", 7, True, False)
    assert axis.modulo_range == (-180, 180)
    assert (axis.limits, axis.reference) == ((-1, 5), 2.5)
    assert list(machine.known_axes) == [7]


def test_axis_names_are_checked():
    lines = ["X", "X", "D", "W1+", "X" * 17]
    text = "".join(f"gruppe[0].achse[{i}].bezeichnung {n}\n" for i, n in enumerate(lines))
    _, found = machine_of(text + "gruppe[0].achse[1].log_achs_nr 1\n")
    assert sorted(ids(found)) == ["20423", "20424", "20425", "20425", "20425"]
    assert [d.line for d in found if d.severity == "warning"] == [4]


def test_without_a_channel_list_the_axes_are_x_y_z():
    machine, _ = machine_of("np_grp[1].achse[0].versch 10000\n", "zero")
    assert machine.axis_names == ("X", "Y", "Z")


def test_channel_settings():
    text = (
        "kinematik_id 9\nori_rotation_angle 17\nmove_tool_offsets_directly 1\n"
        "einrechnen_mit_t 1\np_param_haltend 1\ncoordinate_system.rotation_sequence XYZ\n"
        "coordinate_system.rotation_mode_fixed 1\nori_wcs 1\n"
        "coordinate_system.axes_offsets_layer_specific 0\n"
    )
    settings = machine_of(text)[0].settings
    assert (settings.default_kinematic_id, settings.orientation_mode) == (9, 17)
    assert settings.tool_moves_at_once is True and settings.offsets_per_level is False
    assert (settings.rotation_sequence, settings.rotation_fixed) == ("XYZ", True)
    machine, found = machine_of("coordinate_system.rotation_sequence XXX\n")
    assert machine.settings.rotation_sequence == "ZYX" and ids(found) == ["22190"]


def test_several_data_sets():
    text = "trafo[3].id 7\ntrafo[3].type 91\ntrafo[0].id 91\ntrafo[1].id 91\ntrafo[1].rtcp 1\n"
    machine, found = machine_of(text + "trafo[2].rtcp 1\n")
    assert ids(found) == ["N3007", "N3010"]
    sets = machine.kinematic_parameters
    assert (sets[7].type, sets[91].type, sets[91].get("rtcp")) == (91, 91, 1)


def test_one_memory_with_all_writers():
    machine, found = machine_of("trafo[0].id 91\ntrafo[0].rtcp 1\ntrafo[0].param[56] 0\n")
    index = INDEX_OF_FIELD["rtcp"]
    assert ids(found) == ["N3007"]
    assert [span.line for span in machine.kinematic_parameters[91].origins[index]] == [2, 3]


def test_lint_of_table_axes_and_handedness():
    text = (MACHINES / "ac_table" / "sda.lis").read_text()
    text = text.replace("axis[3].orientation[2] -1", "axis[3].orientation[2] 1")
    text = text.replace("axis[2].orientation[2] 1", "axis[2].orientation[2] -1")
    loaded = assemble((ListFile("channel", ListDocument.from_text(text)),), "x")
    messages = [d.message for d in check_loaded(loaded) if d.id == "N3010"]
    assert any("left-handed" in message for message in messages)
    assert any("not inverted" in message for message in messages)


def test_linkage():
    machine, found = load_machine(MACHINES / "spline_linkage")
    assert found == () and check_lists(MACHINES / "spline_linkage") == ()
    parameters = machine.kinematic_parameters[91]
    assert (parameters.get("linkage[2][1]"), parameters.get("linkage[2][3]")) == (-0.71, -750000)
    text = (MACHINES / "spline_linkage" / "sda.lis").read_text()
    text = text.replace("axis[1].orientation[1] 1", "axis[1].orientation[2] 1")
    text = text.replace("axis[2].orientation[2] 1", "axis[2].orientation[1] 1")
    loaded = assemble((ListFile("channel", ListDocument.from_text(text)),), "x")
    assert sum("linkage" in d.message for d in check_loaded(loaded)) == 2


def test_other_kinematics_are_kept_and_not_judged():
    machine, found = machine_of("kinematik[9].param[0] 1500\nkinematik_id 9\n")
    assert found == () and machine.kinematic_parameters[9].values[0] == 1500
    text = "kinematik[9].param[0] 1500\n"
    loaded = assemble((ListFile("channel", ListDocument.from_text(text)),), "x")
    assert check_loaded(loaded) == ()


def test_entries_without_effect_are_noted_once_per_key(tmp_path):
    write(tmp_path, sda="spindel[0].log_achs_nr 6\nspindel[1].log_achs_nr 7\nm_synch[3] MOS\n")
    notes = [d for d in check_lists(tmp_path) if d.id == "N3003"]
    assert [d.line for d in notes] == [1, 3]


def test_default_lists_come_first(tmp_path):
    write(tmp_path, default_sda_mds="kinematik_id 9\neinrechnen_mit_t 1\n", SDA="kinematik_id 91\n")
    machine, found = load_machine(tmp_path)
    assert found == ()
    assert machine.settings.default_kinematic_id == 91 and machine.settings.tool_with_t


def test_startup_list(tmp_path):
    (tmp_path / "lists").mkdir()
    write(tmp_path / "lists", a="gruppe[0].achse[0].bezeichnung C\n", b="kenngr.achs_typ 1\n")
    write(
        tmp_path,
        hochlauf="kanal_anzahl 1\nsda_mds[0] lists\\a.lis\nachs_mds[1] lists/b.lis (axis\n"
        "nullp_data[0] zero.lis\n",
        zero="default_index 3\n",
        sda="kinematik_id 5\n",
    )
    for path in (tmp_path, tmp_path / "hochlauf.lis"):
        machine, found = load_machine(path)
        assert found == ()
        assert [(a.name, a.rotary, a.assumed) for a in machine.axes] == [("C", False, False)]
        assert machine.zero_offsets.default_index == 3
        assert machine.settings.default_kinematic_id == 0


@pytest.mark.parametrize("name", ["../secret.lis", "/etc/passwd", "C:\\a.lis", "none.lis", "."])
def test_startup_list_stays_in_its_folder(tmp_path, name):
    (tmp_path / "secret.lis").write_text("kinematik_id 9\n")
    folder = tmp_path / "machine"
    folder.mkdir()
    write(folder, hochlauf=f"sda_mds[0] {name}\n")
    machine, found = load_machine(folder)
    assert ids(found) == ["N3006"]
    assert (found[0].line, found[0].column) == (1, 12)
    assert machine.settings.default_kinematic_id == 0


def test_links_that_leave_the_folder_are_refused(tmp_path):
    (tmp_path / "secret.lis").write_text("kinematik_id 9\n")
    folder = tmp_path / "machine"
    folder.mkdir()
    (folder / "sda.lis").symlink_to(tmp_path / "secret.lis")
    machine, found = load_machine(folder)
    assert ids(found) == ["N3006"] and machine.settings.default_kinematic_id == 0


def test_single_list_by_name_and_by_content(tmp_path):
    write(tmp_path, nullp="default_index 1\n", mine="wz[3].laenge 10000\n", odd="hello\n")
    assert load_machine(tmp_path / "nullp.lis")[0].zero_offsets.default_index == 1
    assert load_machine(tmp_path / "mine.lis")[0].tools[3].length == 1
    assert ids(load_machine(tmp_path / "odd.lis")[1]) == ["N3008"]
    assert ids(load_machine(tmp_path / "absent.lis")[1]) == ["N3006"]
    (tmp_path / "empty").mkdir()
    assert ids(load_machine(tmp_path / "empty")[1]) == ["N3008"]


def test_a_list_whose_name_says_no_kind_is_named(tmp_path):
    (tmp_path / "sda.lis").write_text("kopf.log_achs_name[0] X\n")
    (tmp_path / "wz.lis").write_text("wz[1].laenge 100000\n")
    (tmp_path / "notes.txt").write_text("no list\n")
    found = load_machine(tmp_path)[1]
    named = [d.message for d in found if d.id == "N3012"]
    assert len(named) == 1 and named[0].startswith("wz.lis is not read")


KEYS = st.sampled_from([row.key for row in table.rows() if row.status != "-"]).flatmap(
    lambda key: st.sampled_from([key.replace("[]", f"[{n}]") for n in (0, 1, 5, 91, 999999)])
)
ENTRIES = st.tuples(KEYS, st.sampled_from(["", "0", "1", "-7", "1e9", "0x9", "X", "0,5", "a|b"]))


@given(st.lists(ENTRIES, max_size=8), st.binary(max_size=40), st.sampled_from(table.LIST_KINDS))
def test_no_bytes_make_reading_fail(entries, tail, kind):
    data = "".join(f"{key} {value}\n" for key, value in entries).encode() + tail
    lists = (ListFile(kind, ListDocument.from_bytes(data)),)
    check_loaded(assemble(lists, "any"))


@pytest.mark.parametrize(
    ("entries", "expected"),
    [
        ("", (-10.0, 350.0)),
        ("kenngr.swe_check 0\n", None),
        ("kenngr.achs_mode 4\n", None),
        ("kenngr.achs_mode 4\nkenngr.swe_check 1\n", None),  # -10 is outside of 0 to 360
        ("kenngr.achs_mode 4\nkenngr.swe_check 1\ngetriebe[0].modulou -200000\n", (-10.0, 350.0)),
    ],
)
def test_software_limits_of_a_rotary_axis(tmp_path, entries, expected):
    """P-AXIS-00177, -00178, -00705: modulo axes are monitored only where a list asks for it."""
    text = "kopf.achs_nr 1\nkenngr.achs_typ ACHSTYP_ROTATOR\nkenngr.swe_neg -100000\n"
    text += f"kenngr.swe_pos 3500000\n{entries}Ende\n"
    write(tmp_path, achs1=text, sda="gruppe[0].achse[0].bezeichnung C\nEnde\n")
    machine, _ = load_machine(tmp_path)
    assert machine.axes[0].limits == expected
