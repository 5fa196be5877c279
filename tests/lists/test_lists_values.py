"""Keys and values against the table."""

import re

import pytest

from ncscope.lists import ListDocument, table
from ncscope.lists.reference_page import parameters_page
from ncscope.lists.values import read_values


def read(text, kind="zero"):
    readings, found = read_values(ListDocument.from_text(text, "x.lis"), kind)
    return [reading.value for reading in readings], found


@pytest.mark.parametrize("row", table.rows(), ids=lambda row: f"{row.list_kind}-{row.key}")
def test_every_key_of_the_table_is_read(row):
    key = row.key.replace("[]", "[0]")
    low = min(max(row.range[0], 1), row.range[1]) if row.range else 1
    values, found = read(f"{key} {low}\n", row.list_kind)
    assert values == [str(low) if row.type in ("STRING", "STRUCT") else low]
    assert found == ()


def test_table_is_complete_and_quick_to_search():
    assert len(table.rows()) > 1400
    assert {row.list_kind for row in table.rows()} == set(table.LIST_KINDS)
    assert table.find("zero", "np_grp[96].achse[31].versch").id == "P-ZERO-00003"
    for key in ("kinematik[91].rtcp", "trafo[3].rtcp", "kin_step[1].trafo[0].rtcp"):
        assert table.find("channel", key).id == "P-CHAN-00287"
    for row in table.rows():
        assert row.key.count("[]") == len(row.sizes)
        assert bool(row.meaning) == (row.status != "-")


@pytest.mark.parametrize(
    ("line", "kind", "value", "id"),
    [
        ("np_grp[0].achse[0].inaktiv 80000", "zero", None, "1019"),
        ("np_grp[0].achse[0].inaktiv TRUE", "zero", None, "1019"),
        ("np_grp[0].achse[0].versch 3000000000", "zero", None, "110552"),
        ("np_grp[0].achse[0].versch abc", "zero", None, "1020"),
        ("np_grp[0].achse[0].versch 10mm", "zero", None, "1020"),
        ("np_grp[0].achse[0].versch 0100", "zero", None, "1022"),
        ("np_grp[0].achse[0].versch 1F", "zero", None, "1026"),
        ("np_grp[0].achse[0].versch 0x1F", "zero", 31, None),
        ("np_grp[0].achse[0].versch -5 mm", "zero", -5, None),
        ("np_grp[0].achse[0].versch 12.0", "zero", 12, None),
        ("np_grp[0].achse[0].versch 0.32", "zero", 0, "N3005"),
        ("np_grp[0].achse[0].versch -8.76", "zero", -9, "N3005"),
        ("np_grp[0].achse[0].versch 1e99999", "zero", None, "1020"),
        ("np_grp[97].achse[0].versch 1", "zero", "absent", "110303"),
        ("np_grp[0].achse[0].Versch 1", "zero", 1, "N3011"),
        ("default_index 97", "zero", None, "20585"),
        ("default_index -1", "zero", None, "20585"),
        ("kinematik[91].zero_orientation[1] 0,707", "channel", 0.707, "N3002"),
        ("Kinematik[91].programming_mode 17", "channel", 17.0, "N3011"),
        ("trafo[0].zero_position[0] 1e400", "channel", None, "1027"),
        ("trafo[0].zero_position[0] nan", "channel", None, "1020"),
        ("trafo[0].linkage[2][3] -750000", "channel", -750000.0, None),
        ("trafo[0].linkage[3][0] 1", "channel", "absent", "110303"),
        ("kinematik[91].zero_position[3] 1", "channel", "absent", "110303"),
        ("m_synch[3] PLC_INFO | MVS_SVS", "channel", "PLC_INFO | MVS_SVS", None),
        ("include other.lis", "channel", "absent", "110303"),
    ],
)
def test_values(line, kind, value, id):
    values, found = read(line + "\n", kind)
    assert values == ([] if value == "absent" else [value])
    assert [item.id for item in found] == ([id] if id else [])


def test_messages_say_what_was_expected():
    _, (flag,) = read("np_grp[0].achse[0].inaktiv 80000\n")
    assert (flag.line, flag.column) == (1, 28)
    assert re.search(r"P-ZERO-00004.*0 or 1.*versch was probably meant", flag.message)
    _, (key,) = read("np_grp[0].achse[1].versatz 81000\n")
    assert (key.id, key.column) == ("110303", 1)
    assert key.hint == "np_grp[0].achse[1].versch was probably meant"
    _, (case,) = read("Kinematik[91].programming_mode 17\n", "channel")
    assert case.hint == "write kinematik[91].programming_mode"
    _, (other,) = read("wz[1].laenge 5\n")
    assert other.hint == "this key belongs into a tool list"


def test_parameters_page():
    page = parameters_page()
    assert "`np_grp[].achse[].versch`" in page
    assert all(row.id in page for row in table.rows())
