"""V2.11 and V3.00 spelling, named fields and param[]: the machine stays, and there and back is
the text of before."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ncscope.lists.conversion import to_names, to_new_syntax, to_old_syntax, to_parameters
from ncscope.lists.document import ListDocument
from ncscope.lists.files import ListFile
from ncscope.lists.reading import machine_from_documents

MACHINES = Path(__file__).parents[2] / "examples" / "machines"
OLD = """# CA head
kinematik_id 91
  kinematik[91].zero_position[0]   12000 # flange
kinematik[91].axis[0].type\t1
...
Kinematik[60].param[0] 5
kinematik[91].rtcp 1
Ende
"""
NEW = """# CA head
kinematik_id 91
trafo[0].id 91
  trafo[0].zero_position[0]   12000 # flange
trafo[0].axis[0].type\t1
...
trafo[1].id 60
trafo[1].param[0] 5
trafo[0].rtcp 1
Ende
"""


def document(text: str) -> ListDocument:
    return ListDocument.from_text(text, "sda.lis")


def new(text: str) -> str:
    return to_new_syntax(document(text))[0].text


def old(text: str) -> str:
    return to_old_syntax(document(text))[0].text


def data_sets(text: str):
    machine, _ = machine_from_documents([ListFile("channel", document(text))])
    return {
        id: (p.values, p.type or p.id, p.name) for id, p in machine.kinematic_parameters.items()
    }


def test_old_to_new() -> None:
    assert new(OLD) == NEW


def test_new_to_old_takes_the_id_lines_out_again() -> None:
    assert old(NEW) == OLD.replace("Kinematik", "kinematik")


def test_lines_that_the_old_syntax_lacks_are_kept_as_comments() -> None:
    text = "trafo[1].id    91 # head\ntrafo[1].name HEAD\nkin_step[0].trafo[3].rtcp 1\n"
    text += "kin_step[0].trafo[3].id 60\n"
    turned = old(text)
    assert turned == (
        "# V3.00: trafo[1].id    91 # head\nkinematik[91].name HEAD\nkinematik[60].rtcp 1\n"
        "# V3.00: kin_step[0].trafo[3].id 60\n"
    )
    assert new(turned) == text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("trafo[0].rtcp 1\n", "trafo[0] is left as it is: it has no id"),
        ("trafo[0].id 500\ntrafo[0].type 91\ntrafo[0].rtcp 1\n", "its type 91 differs"),
        ("trafo[0].id 91\ntrafo[0].rtcp 1\ntrafo[1].id 91\ntrafo[1].rtcp 0\n", "used twice"),
        ("kin_step[1].trafo[0].id 91\n", "has no form in V2.11"),
    ],
)
def test_what_has_no_old_form_is_named(text: str, said: str) -> None:
    turned, found = to_old_syntax(document(text))
    assert any(said in d.message for d in found)
    assert data_sets(turned.text) == data_sets(text)


def test_an_eleventh_data_set_is_left() -> None:
    text = "".join(f"kinematik[{i}].param[0] 1\n" for i in range(1, 12))
    turned, found = to_new_syntax(document(text))
    assert "kinematik[11].param[0] 1" in turned.text
    assert [d.id for d in found] == ["N3501"]


def test_fields_and_numbers() -> None:
    text = "kinematik[91].axis[3].point[2] 5 #c\ntrafo[0].param[55] 13\ntrafo[0].id 91\n"
    text += "kinematik[9].param[3] 1\nkinematik[91].linkage[0][3] 7\nkinematik[91].param[58] 2\n"
    # 7 + 7 * 3 + 4 + 2 = 34; numbers from 57 on are not documented and keep their spelling.
    assert to_parameters(document(text)).text == text.replace("axis[3].point[2]", "param[34]")
    assert to_names(document(text)).text == text.replace(
        "trafo[0].param[55]", "trafo[0].programming_mode"
    )


def test_a_byte_order_mark_stays_first() -> None:
    text = "\xef\xbb\xbfkinematik[91].rtcp 1\r\n"
    assert new(text) == "\xef\xbb\xbftrafo[0].id 91\r\ntrafo[0].rtcp 1\r\n"
    assert old(new(text)) == text


@pytest.mark.parametrize("path", sorted(MACHINES.glob("*/sda.lis")), ids=lambda p: p.parent.name)
def test_examples_keep_their_machine(path: Path) -> None:
    text = path.read_bytes().decode("latin-1")
    for turned in (new(text), old(text), old(new(text)), new(old(text))):
        assert data_sets(turned) == data_sets(text)
    for turned in (to_parameters(document(text)), to_names(document(text))):
        assert data_sets(turned.text) == data_sets(text)
    assert to_names(to_parameters(document(text))).text == to_names(document(text)).text


FIELDS = st.sampled_from(
    ["rtcp", "zero_position[2]", "axis[4].point[0]", "chain[1]", "param[7]", "linkage[0][3]"]
)
OTHER = st.sampled_from(["# text", "", "...", "kinematik_id 91", "#V3.00: x", "Ende"])
VALUE = st.tuples(st.sampled_from([" ", "\t", "   "]), st.integers(0, 9)).map(
    lambda pair: f"{pair[0]}{pair[1]} # c"
)


def entry(prefix: str) -> st.SearchStrategy[str]:
    return st.tuples(FIELDS, VALUE).map(lambda pair: f"{prefix}.{pair[0]}{pair[1]}")


OLD_LINES = st.one_of(OTHER, entry("kinematik[91]"), entry("  kinematik[60]"))
NEW_LINES = st.one_of(
    OTHER,
    st.sampled_from(["trafo[2].id 91", "trafo[0].id 60", " kin_step[0].trafo[5].id  92 # w"]),
    st.sampled_from(["trafo[2].type 91", "trafo[0].type 0"]),
    entry("trafo[2]"), entry("trafo[0]"), entry("kin_step[0].trafo[5]"),
)  # fmt: skip
ENDS = st.sampled_from(["\n", "\r\n"])


@settings(max_examples=150)
@given(st.lists(OLD_LINES, max_size=12), ENDS)
def test_there_and_back_from_the_old_syntax(lines: list[str], end: str) -> None:
    text = "".join(line + end for line in lines)
    assert old(new(text)) == text
    assert data_sets(new(text)) == data_sets(text)


@settings(max_examples=150)
@given(st.lists(NEW_LINES, max_size=12), ENDS)
def test_there_and_back_from_the_new_syntax(lines: list[str], end: str) -> None:
    text = "".join(line + end for line in lines)
    assert new(old(text)) == text
    assert data_sets(old(text)) == data_sets(text)


@settings(max_examples=100)
@given(st.binary(max_size=200))
def test_any_bytes_are_kept(data: bytes) -> None:
    before = ListDocument.from_bytes(data)
    for turned in (to_new_syntax(before)[0], to_old_syntax(before)[0], to_names(before)):
        assert isinstance(turned.to_bytes(), bytes)
