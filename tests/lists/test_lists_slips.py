"""Each slip that FCT-C27 and its copies print is met with a message that says what is meant.

T1 to T22 number the slips in the order of the document. A slip of a sentence that no list can
repeat (T16, T18) is here with the right list, which has to pass in silence.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from ncscope import run
from ncscope.diagnostics import Diagnostic
from ncscope.lists import check_lists
from ncscope.lists.check import check_loaded
from ncscope.lists.document import ListDocument
from ncscope.lists.files import ListFile
from ncscope.lists.reading import assemble

MACHINES = Path(__file__).parents[2] / "examples" / "machines"


def fields(**change: str | None) -> dict[str, str]:
    """The CA head of FCT-C27 4.1.1 without a fault; None leaves a field out."""
    values = {"zero_orientation[2]": "1", "zero_position[0]": "12000", "number_of_axes": "5"}
    axes = [(1, "100"), (1, "010"), (1, "001"), (2, "001"), (2, "100")]
    for axis, (kind, direction) in enumerate(axes):
        values[f"axis[{axis}].type"] = str(kind)
        values |= {f"axis[{axis}].orientation[{k}]": direction[k] for k in range(3)}
        if kind == 2:
            values |= {f"axis[{axis}].point[{k}]": "0" for k in range(3)}
    values |= {f"chain[{i}]": str(i) for i in range(5)}
    values |= {"programming_mode": "17", "rtcp": "1"}
    for name, value in change.items():
        values.pop(name, None)
        if value is not None:
            values[name] = value
    return values


def written(values: dict[str, str], slot: str = "kinematik[91]") -> str:
    return "".join(f"{slot}.{name} {value}\n" for name, value in values.items())


def checked(text: str, names: str = "XYZCA") -> tuple[Diagnostic, ...]:
    channel = "".join(
        f"gruppe[0].achse[{i}].bezeichnung {name}\ngruppe[0].achse[{i}].log_achs_nr {i + 1}\n"
        for i, name in enumerate(names)
    )
    loaded = assemble((ListFile("channel", ListDocument.from_text(channel + text)),), "machine")
    return tuple(d for d in check_loaded(loaded) if d.id != "N3004")


HEAD = written(fields())
TABLE_INVERTED = fields(**{"axis[3].orientation[2]": "-1", "axis[4].orientation[0]": "-1"})
LINKAGE = {
    "linkage_mode": "1",
    "linkage[0][0]": "0.5", "linkage[0][1]": "0.5", "linkage[1][2]": "1",
    "linkage[2][0]": "0.71", "linkage[2][1]": "-0.71",
}  # fmt: skip
# X1 and X2 of the sample with X2 along Z, as its notice says.
TURNED = {
    "axis[1].orientation[1]": "0", "axis[1].orientation[2]": "1",
    "axis[2].orientation[1]": "-1", "axis[2].orientation[2]": "0",
}  # fmt: skip
PRINTED = (MACHINES / "ac_table_as_printed" / "sda.lis").read_text(encoding="latin-1")

SLIPS = [
    ("T1", PRINTED, "N3007", "axis[1].orientation[0] was probably meant"),
    ("T1", PRINTED, "N3009", "axis 0 (X) has the direction (0, 0, 0)"),
    ("T2", PRINTED, "N3009", "the list does not write kinematik[91].number_of_axes"),
    ("T2", PRINTED, "N3009", "kinematik[91].programming_mode and kinematik[91].rtcp, so the d"),
    ("T3", HEAD + "...\n", "N3001", "'...' stands for lines that were left out"),
    ("T3", HEAD + "\xe2\x80\xa6\n", "N3001", "'...' stands for lines that were left out"),
    ("T4", written(fields(**{"zero_orientation[1]": "0,707"})), "N3002", "0,707 is taken as 0.707"),
    ("T5", written(fields(rtcp=None)) + "kinematik[91].rtcp\n1\n", "1028", "value of kin"),
    ("T6", written(fields(**{"axis[1].point[0]": "5"})), "N3010", "points count for rotary axes"),
    ("T6", written(fields(**{f"axis[4].point[{k}]": None for k in range(3)})), "N3010", "no point"),
    ("T7", written(TABLE_INVERTED), "N3010", "chain is walked from the workpiece to the tool"),
    ("T8", written(fields(programming_mode="16", rtcp="0")), "N3010", "CA is 17"),
    ("T8", written(fields(programming_mode="16")), "N3010", "with rtcp 1 that makes no difference"),
    ("T8", written(fields(programming_mode="18", rtcp="0")), "N3010", "BC, but the channel has no"),
    ("T10", written(fields(**(LINKAGE | {"linkage_mode": None}))), "N3010", "linkage_mode 1 (P-CH"),
    ("T11", written(fields(**LINKAGE, **TURNED)), "N3010", "direction of axis 1 is not about Y"),
    ("T12", HEAD + "V.KIN[91].ZERO_POSITION[0] 3\n", "110303", "write kinematik[91].zero_"),
    ("T13", HEAD.replace("kinematik[91].rtcp", "Kinematik[91].rtcp"), "N3011", "write kinem"),
    ("T14", HEAD.replace("kinematik[91].chain[0]", "# Sequence: YXZCA\nkinematik[91].chain[0]"),
     "N3010", "the comment before says YXZCA, but the chain is XYZCA"),
    ("T14", HEAD.replace("chain[0] 0", "chain[0] 0 #Y axis"), "N3010", "says Y, but axis 0 is X"),
    ("T15", written(fields(**{"axis[0].orientation[0]": "0.99953"})), "N3010", "length 0.99953"),
    ("T17", written(fields(), "trafo[1]"), "N3010", "trafo[1] has no id"),
    ("T20", written(fields(programming_mode="17.5")), "N3009", "has to be a whole number"),
    ("T21", written(fields(**{
        "zero_position[0]": "0", "zero_position[2]": "1", "zero_orientation[0]": "12000",
        "zero_orientation[1]": "-3200", "zero_orientation[2]": "500"})),
     "N3010", "zero_position and zero_orientation of kinematics 91 look exchanged"),
    ("T22", HEAD + "```\n", "N3001", "'```' marks printed text"),
]  # fmt: skip


@pytest.mark.parametrize(("slip", "text", "id", "said"), SLIPS)
def test_slip_is_met(slip: str, text: str, id: str, said: str) -> None:
    found = [d for d in checked(text) if d.id == id]
    assert any(said in f"{d.message} {d.hint}" for d in found), [d.message for d in found]
    assert all(d.span is not None for d in found)


SILENT = [
    ("T14", HEAD.replace("type 1\n", "type 1 #lin\n").replace("type 2\n", "type 2#rot\n")),
    ("T14", HEAD.replace("chain[0] 0", "chain[0] 0 #X axis")),
    ("T16", HEAD),
    ("T17", "trafo[1].id 91\n" + written(fields(), "trafo[1]")),
    ("T18", HEAD),
    ("T19", HEAD.replace("chain[4] 4", "chain[4]\t4 # A axis")),
    ("T20", written(fields(programming_mode="17.0", number_of_axes="5.0", rtcp="1.0"))),
]  # fmt: skip


@pytest.mark.parametrize(("slip", "text"), SILENT)
def test_what_is_no_fault_is_not_blamed(slip: str, text: str) -> None:
    assert [d.message for d in checked(text)] == []


def test_the_programs_of_the_document() -> None:
    """T9: B in the program of a machine with A and C. T12: a variable without its G."""
    machine = assemble((ListFile("channel", ListDocument.from_text(PRINTED)),), "m").machine
    (found,) = run(machine, "G00 X0 B45\nM30\n").diagnostics
    assert found.id == "20200" and "it has the axes X Y Z C A" in found.message
    (found,) = run(machine, "V.KIN[91].ZERO_POSITION[0] = 3\nM30\n").diagnostics
    assert found.hint == "V.G.KIN[91].ZERO_POSITION[0] was probably meant"


def test_every_slip_is_here() -> None:
    numbers = {name for name, *_ in (*SLIPS, *SILENT)} | {"T9", "T12"}
    assert numbers == {f"T{i}" for i in range(1, 23)}


LOOKS = [
    (fields(**{"axis[0].orientation[0]": "-1"}), "form a left-handed system"),
    (fields(**{"axis[2].orientation[0]": "1", "axis[2].orientation[1]": "1",
               "axis[2].orientation[2]": "0"}), "lie in one plane"),
    (fields(**{"chain[4]": "3"}), "leaves out axis 4 (A)"),
    (fields(**{"chain[4]": "7"}), "leaves out axis 4 (A)"),
    (fields(**{f"chain[{i}]": str(a) for i, a in enumerate((3, 4, 0, 1, 2))}), "not inverted"),
    (fields(**{"axis[3].orientation[2]": "0", "axis[3].orientation[0]": "1"}), "calls it C"),
    (fields(**{"axis[1].orientation[0]": "1", "axis[1].orientation[1]": "0"}), "are parallel"),
    (fields(**{"zero_orientation[2]": "-1"}), "the tool tip is above the flange"),
    (fields(number_of_axes="4"), "axis 4 of kinematics 91 is described, but number_of_axes is 4"),
    (fields(number_of_axes="6", **{"axis[5].type": "2", "axis[5].orientation[1]": "1",
                                   "chain[5]": "5"}), "the channel has 5 axes, but the kinematics"),
]  # fmt: skip


@pytest.mark.parametrize(("values", "said"), LOOKS)
def test_what_looks_wrong_is_named(values: dict[str, str], said: str) -> None:
    assert any(said in d.message for d in checked(written(values)))


def test_an_axis_that_is_linear_in_the_channel() -> None:
    found = checked(HEAD, "XYZUA")
    assert any("axis U at index 3 of the channel is linear" in d.message for d in found)


def test_the_field_counts_before_the_channel() -> None:
    found = checked("ori_rotation_angle 13\n" + HEAD)
    assert any("ori_rotation_angle 13 (P-CHAN-00112) does not" in d.message for d in found)


def test_examples_are_not_blamed() -> None:
    good = {"ca_head", "kin9_head", "xyzac_axes", "ac_table", "cb_head", "cardanic_table"}
    for name in sorted(good):
        found = [d for d in check_lists(MACHINES / name) if d.id not in ("N3004", "N3003")]
        assert [d.message for d in found if d.severity == "warning"] == [], name


def line_of(text: str, said: str) -> list[str]:
    """The lines that are blamed with these words."""
    found = [d for d in checked(text) if said in d.message]
    return [d.span.source.line_text(d.line) for d in found if d.span is not None]


def test_the_line_with_the_fault_is_blamed() -> None:
    """Not the first line that takes part in what is wrong."""
    turned = written(fields(**{"axis[1].orientation[1]": "-1"}))
    assert line_of(turned, "left-handed") == ["kinematik[91].axis[1].orientation[1] -1"]
    twice = written(fields(**{"chain[3]": "4"}))
    assert line_of(twice, "leaves out axis 3 (C)") == ["kinematik[91].chain[4] 4"]
    outside = written(fields(**{"chain[2]": "5"}))
    assert line_of(outside, "leaves out axis 2 (Z)") == ["kinematik[91].chain[2] 5"]
    alike = written(fields(**{"axis[2].orientation[0]": "1", "axis[2].orientation[2]": "0"}))
    assert line_of(alike, "parallel") == ["kinematik[91].axis[2].orientation[0] 1"]


def test_a_number_that_is_missing_is_named() -> None:
    (found,) = [d for d in checked(written(fields(**{"chain[4]": None}))) if d.id == "N3009"]
    assert found.message.endswith("the list does not write kinematik[91].chain[4], so the default "
                                  "0 counts")  # fmt: skip


def test_fields_need_the_type_of_the_universal_kinematics() -> None:
    """FCT-C27 3.2: from V3.00 on the id has to be 91, or the type says so."""
    text = "trafo[0].id 9\n" + written(fields(), "trafo[0]")
    (found,) = [d for d in checked(text) if d.id == "N3010"]
    assert "counts for type 91 only, but kinematics 9 has type 9" in found.message
    assert found.hint == "write trafo[0].id 91, or trafo[0].type 91"
    assert checked("trafo[0].id 9\ntrafo[0].type 91\n" + written(fields(), "trafo[0]")) == ()
    assert checked("trafo[0].id 9\ntrafo[0].param[0] 5\n") == ()


def test_one_wrong_index_is_one_complaint() -> None:
    text = "trafo[10].id 91\n" + written(fields(), "trafo[10]")
    (found,) = checked(text)
    lines = text.count("\n") - 1
    assert found.id == "110303" and f"; {lines} more lines begin with trafo[10]" in found.message


def test_complaints_go_from_top_to_bottom() -> None:
    lines = [d.line for d in checked(PRINTED)]
    assert lines == sorted(lines)
