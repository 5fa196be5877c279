"""Lists as text: nothing is lost, one value can be changed, odd lines are reported."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ncscope.lists import ListDocument
from ncscope.lists.files import read_document
from ncscope.lists.writing import write_document

LINES = st.one_of(
    st.sampled_from(
        ["", "# text", "...", "Ende", "np_grp[1].achse[0].versch 10", "a.b[3] x (c", "k[91].rtcp"]
    ),
    st.text(st.characters(min_codepoint=0, max_codepoint=255), max_size=30),
)
TEXTS = st.lists(st.tuples(LINES, st.sampled_from(["\n", "\r\n", "\r"]))).map(
    lambda pairs: "".join(line + end for line, end in pairs)
)


@given(TEXTS)
def test_a_list_written_is_the_list_read(text):
    data = text.encode("latin-1")
    document = ListDocument.from_bytes(data)
    assert document.to_bytes() == data
    for entry in document.entries:
        assert entry.key_span.text == entry.key
        assert entry.value_span.text == entry.value_text


@given(TEXTS, st.from_regex(r"[0-9]{1,5}", fullmatch=True))
def test_changing_a_value_changes_only_that_value(text, value):
    document = ListDocument.from_text(text)
    for entry in document.entries[:3]:
        changed = document.with_value(entry.key, value)
        assert changed.get(entry.key).value_text == value
        assert len(changed.entries) == len(document.entries)
        span = document.get(entry.key).value_span
        assert changed.text[: span.start] == text[: span.start]
        assert changed.text.endswith(text[span.end :])


def test_file_round_trip(tmp_path):
    data = b"# \xe4\xf6\r\na 1\r\n\r\n  b 2 text\nEnde\r\nleft over"
    (tmp_path / "in.lis").write_bytes(data)
    write_document(read_document(tmp_path / "in.lis"), tmp_path / "out.lis")
    assert (tmp_path / "out.lis").read_bytes() == data


@pytest.mark.parametrize(
    ("line", "value"),
    [
        ("dummy[1] 1 Comment", "1"),
        ("dummy[2] 1 # Comment", "1"),
        ("dummy[3] 1 ( Comment", "1"),
        ("dummy[4] 1 /* Comment", "1"),
        ("dummy[5]\t-7", "-7"),
        ("beispiel[0].bezeichnung STRING_2 (Comment", "STRING_2"),
        ("beispiel[0].bezeichnung STRING_2(Comment", "STRING_2"),
        ("gruppe[0].achse[2].bezeichnung W1+", "W1+"),
        ("m_synch[3] PLC_INFO | MVS_SVS # flags", "PLC_INFO | MVS_SVS"),
        ("list 20804,20805", "20804,20805"),
    ],
)
def test_value_and_comment(line, value):
    assert ListDocument.from_text(line).entries[0].value_text == value


def test_ende_ends_the_list():
    document = ListDocument.from_text("a 1\nEnde of list\nb 2\n")
    assert [entry.key for entry in document.entries] == ["a"]


def test_missing_value_says_where_it_may_stand():
    document = ListDocument.from_text("# x\nkinematik[91].rtcp\n\n   1\na 2\n")
    (warning,) = document.diagnostics
    assert (warning.id, warning.line, warning.column) == ("1028", 2, 1)
    assert warning.notes[0][1].line == 4


def test_byte_order_mark_and_filler():
    document = ListDocument.from_bytes(b"\xef\xbb\xbfa 1\n  ...\nb 2\n")
    assert [(d.id, d.line, d.column) for d in document.diagnostics] == [
        ("21798", 1, 1),
        ("N3001", 2, 3),
    ]
    assert [entry.key for entry in document.entries] == ["a", "b"]


def test_with_value_refuses_what_is_not_one_value():
    document = ListDocument.from_text("a 1\n")
    with pytest.raises(ValueError):
        document.with_value("a", "1\nb 2")
    with pytest.raises(KeyError):
        document.with_value("b", "1")


def test_lines_that_end_with_cr_alone_are_named():
    document = ListDocument.from_text("kopf.achs_nr 1\rkenngr.achs_mode 1\r", "achs1.lis")
    assert document.entries == ()
    (found,) = document.diagnostics
    assert found.id == "20301" and "line ends CR LF or LF" in found.hint
    assert document.to_bytes() == b"kopf.achs_nr 1\rkenngr.achs_mode 1\r"
    for text in ("a 1\r\nb 2\r\n", "a 1", "a 1\r", "\r\r"):
        assert ListDocument.from_text(text).diagnostics == ()
