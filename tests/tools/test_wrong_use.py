"""Wrong use of every command: one line that names what is wrong, exit code 2, and no traceback.

What is wrong inside of a program or a list is a diagnostic, with exit code 1.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from ncscope.cli import app
from ncscope.lists import load_machine
from ncscope.lists.document import ListDocument

HEAD = Path(__file__).parents[2] / "examples" / "machines" / "ca_head"
LONG = "9" * 5000
"""More digits than Python turns into a number."""
TOO_LONG = "a" * 5000
"""Longer than the name of any file."""


@pytest.fixture(autouse=True)
def in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("main.nc").write_text("N10 G1 F100 X10\nN20 X20\nM30\n")
    Path("poses.csv").write_text("X,Y,Z,C,A\n1,2,3,4,5\n")
    return tmp_path


def call(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(app, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def refusal(*arguments: str | Path) -> str:
    """The one line that a command says before it ends with exit code 2."""
    result = call(*arguments)
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    return line.removeprefix("ncscope: ")


# --- places ------------------------------------------------------------------------------------


@pytest.mark.parametrize("block", ["", "N", "²", "N²", "-1", LONG, "N" + LONG])
def test_a_place_that_is_none(block: str) -> None:
    message = f"main.nc:{block}: write PROGRAM:LINE or PROGRAM:N40"
    assert refusal("explain", f"main.nc:{block}") == message
    assert refusal("where", "--at", f"main.nc:{block}", "--axes", "X=1") == message


@pytest.mark.parametrize("block", ["N", "²", "-1", LONG])
def test_a_block_of_a_report_that_is_none(block: str) -> None:
    message = f"--explain N10,{block}: write blocks as N40,N60 or lines as 12,15"
    assert refusal("report", "main.nc", "-o", "x.html", "--explain", f"N10,{block}") == message


def test_a_block_may_be_written_with_a_small_letter() -> None:
    assert call("explain", "main.nc:n20").stdout.startswith("main.nc:2 ")


# --- what is read ------------------------------------------------------------------------------


@pytest.mark.skipif(not Path("/dev/zero").is_char_device(), reason="a device without an end")
@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "/dev/zero"],
        ["check", "/dev/zero"],
        ["run", "main.nc", "--probe", "/dev/zero"],
        ["run", "main.nc", "--kinematics", "/dev/zero"],
        ["kin", "forward", "-m", str(HEAD), "--poses", "/dev/zero"],
    ],
)
def test_a_device_without_an_end_is_not_read(arguments: list[str]) -> None:
    assert refusal(*arguments) == "cannot read /dev/zero: it is a device, not a file"


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "main.nc", "--machine", TOO_LONG],
        ["check", TOO_LONG],
        ["convert", TOO_LONG, "--to", "v3"],
        ["run", "main.nc", "--subprograms", TOO_LONG],
    ],
)
def test_a_name_that_no_file_can_have(arguments: list[str]) -> None:
    assert refusal(*arguments) == f"cannot read {TOO_LONG}: File name too long"


def test_a_folder_of_subprograms_has_to_be_one() -> None:
    assert refusal("run", "main.nc", "--subprograms", "none") == (
        "--subprograms none: there is no such folder"
    )
    assert refusal("check", "main.nc", "--subprograms", "main.nc") == (
        "--subprograms main.nc: it is no folder; give the folder of the file"
    )


def test_poses_come_from_one_source() -> None:
    both = ["--grid", "X=1:2:3", "--poses", "poses.csv"]
    assert refusal("kin", "compare", HEAD, HEAD, *both) == "give one of --poses and --grid"


def test_a_table_of_answers_that_is_no_text() -> None:
    Path("hits.csv").write_bytes(b"X,Y\n1,2\n" + bytes(range(256)))
    result = call("run", "main.nc", "--probe", "hits.csv")
    assert result.exit_code == 1
    assert result.stderr.startswith(
        "hits.csv:1:1: error N4010: the file is no text: it holds zero bytes\n"
    )
    assert result.stderr.count("error") == 1


# --- lists -------------------------------------------------------------------------------------


def machine_list(data: bytes) -> Path:
    Path("m").mkdir()
    path = Path("m", "sda.lis")
    path.write_bytes(data)
    return path


def test_a_list_that_is_no_text() -> None:
    path = machine_list("kopf.x 1\n".encode("utf-16-le"))
    message = "sda.lis:1:2: error N3006: the list is no text: it holds zero bytes\n"
    for arguments in (["check", "m"], ["run", "main.nc", "-m", "m"], ["convert", path, "--fields"]):
        result = call(*arguments)
        assert (result.exit_code, result.stderr[: len(message)]) == (1, message)


def test_a_list_may_be_filled_up_with_zeros() -> None:
    document = ListDocument.from_bytes(b"kinematik_id 9\n\x1a\0\0\0", "sda.lis")
    assert [entry.key for entry in document.entries] == ["kinematik_id"]
    assert not any(d.id == "N3006" for d in document.diagnostics)


def test_an_id_of_more_digits_than_a_number_has() -> None:
    machine_list(f"coordinate_system.def[0].id {LONG}\n".encode())
    machine, found = load_machine("m")
    assert machine.systems == {}
    assert [d.id for d in found] == ["110552"]


@pytest.mark.parametrize("id", [LONG, "²"])
@pytest.mark.parametrize("option", ["v2", "v3"])
def test_an_id_that_is_no_number_is_left_as_it_is(id: str, option: str) -> None:
    text = f"trafo[0].id {id}\ntrafo[0].param[0] 1\n# V3.00: trafo[0].id {id}\n".encode("latin-1")
    result = call("convert", machine_list(text), "--to", option)
    assert result.stdout_bytes.startswith(b"trafo[0].id ")


# --- what is written ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "main.nc", "--out", "none/x.parquet"],
        ["kin", "forward", "-m", str(HEAD), "X=1", "--out", "none/x.parquet"],
        ["run", "main.nc", "--out", "none/x.csv"],
        ["plot", "main.nc", "-o", "none/x.svg"],
    ],
)
def test_the_reason_is_said_without_what_a_library_says_about_it(arguments: list[str]) -> None:
    assert refusal(*arguments) == f"cannot write {arguments[-1]}: No such file or directory"


def test_parquet_without_its_library(monkeypatch: pytest.MonkeyPatch) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "pyarrow" else found(name)
    )
    message = "Parquet needs pyarrow: pip install 'ncscope[table]'"
    assert refusal("run", "main.nc", "--out", "x.parquet") == message
    assert refusal("kin", "forward", "-m", HEAD, "X=1", "--out", "x.parquet") == message


@pytest.mark.parametrize("option", ["--probe", "--manual", "--kinematics"])
def test_no_output_over_a_file_that_is_read(option: str) -> None:
    Path("given.csv").write_text("X,Y\n1,2\n")
    message = "--out given.csv is a file that is read"
    assert refusal("run", "main.nc", option, "given.csv", "--out", "given.csv") == message
    assert Path("given.csv").read_text() == "X,Y\n1,2\n"


@pytest.mark.skipif(sys.platform == "win32", reason="a shell that closes the output")
@pytest.mark.parametrize("form", ["table", "jsonl"])
def test_output_that_is_closed(form: str) -> None:
    start = f"exec '{sys.executable}' -m ncscope.cli run main.nc --format {form} >&-"
    result = subprocess.run(["sh", "-c", start], capture_output=True, timeout=60, check=False)
    assert (result.returncode, result.stderr) == (0, b"")
