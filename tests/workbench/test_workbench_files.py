"""Only files below the folder exist, and an edited text keeps every other character."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ncscope.views.workbench.buffers import Buffer, Change, OutOfStep
from ncscope.views.workbench.files import Folder, Refused


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    root = tmp_path / "work"
    (root / "machine").mkdir(parents=True)
    (root / "machine" / "sda.lis").write_text("kopf.achs_anzahl 3\n")
    (root / "part.nc").write_bytes(b"X1\r\nM30\r\n")
    (root / ".hidden").mkdir()
    (root / ".hidden" / "other.nc").write_text("")
    (tmp_path / "secret.nc").write_text("secret")
    (root / "link.nc").symlink_to(tmp_path / "secret.nc")
    (root / "out").symlink_to(tmp_path)
    return Folder.at(root)


def test_listing(folder: Folder) -> None:
    found = folder.listing()
    assert found.programs == ("link.nc", "part.nc")
    assert found.machines == ("machine",)


@pytest.mark.parametrize(
    "key",
    ["../secret.nc", "link.nc", "out/secret.nc", "/etc/passwd", "..\\secret.nc", "a\0b", "machine"],
)
def test_nothing_outside_is_read_or_written(folder: Folder, key: str, tmp_path: Path) -> None:
    with pytest.raises(Refused):
        folder.read(key)
    with pytest.raises(Refused):
        folder.write(key, b"x", b"secret")
    assert (tmp_path / "secret.nc").read_text() == "secret"


def test_a_file_that_changed_on_disk_is_not_overwritten(folder: Folder) -> None:
    with pytest.raises(Refused, match="changed on disk"):
        folder.write("part.nc", b"mine", b"what I read")
    folder.write("part.nc", b"mine", b"X1\r\nM30\r\n")
    assert folder.read("part.nc") == b"mine"


@given(st.binary(max_size=60))
def test_a_text_that_was_not_edited_keeps_its_bytes(data: bytes) -> None:
    assert Buffer.of(data).data == data


@given(
    st.lists(st.sampled_from(["X1", "", "Y\u00e4"]), min_size=1), st.sampled_from(["\n", "\r\n"])
)
def test_line_ends_are_kept_by_an_edit(lines: list[str], end: str) -> None:
    before = Buffer.of(end.join(lines).encode("latin-1"))
    after = before.edited(0, [Change(0, 0, "N10\n")])
    ends = end if len(lines) > 1 else "\n"
    assert after.data == ("N10" + ends + end.join(lines)).encode("latin-1")
    assert after.changed


def test_change_sets_count_from_the_text_before_them() -> None:
    buffer = Buffer.of(b"X1\r\nY2\r\n").edited(0, [Change(1, 2, "15"), Change(4, 5, "-7")])
    assert buffer.data == b"X15\r\nY-7\r\n"
    assert buffer.edited(1, [Change(1, 3, "1"), Change(5, 7, "2")]).changed is False


def test_impossible_changes_are_refused() -> None:
    buffer = Buffer.of(b"X1\n")
    with pytest.raises(OutOfStep):
        buffer.edited(3, [])
    for change in (Change(2, 9, ""), Change(-1, 0, ""), Change(2, 1, "")):
        with pytest.raises(ValueError, match="outside"):
            buffer.edited(0, [change])
    with pytest.raises(UnicodeEncodeError):
        buffer.edited(0, [Change(0, 0, "\u20ac")])
