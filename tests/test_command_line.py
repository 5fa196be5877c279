"""The command line: what goes to standard output, exit codes, files, and hostile input.

Most tests run in this process; a few start the real command, since each start costs a second.
"""

from __future__ import annotations

import csv
import io
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

import ncscope
from ncscope.cli import app

EXAMPLES = Path(__file__).parent.parent / "examples"
MACHINES, PROGRAMS = EXAMPLES / "machines", EXAMPLES / "programs"
HEAD = MACHINES / "ac_table"
MOVE_KEYS = ["kind", "index", "file", "line", "block", "motion", "feed"]
MOVE_KEYS += ["pcs", "wcs", "mcs", "direction", "acs"]
DIAGNOSTIC_KEYS = ["kind", "id", "severity", "file", "line", "column", "message"]
GOOD = 'N10 G01 F1000 X10 Y5\nX20\nN30 #MSG SAVE EXCLUSIVE ["x %f", V.A.ABS.X]\nN40 M30\n'


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def call(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(app, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def command(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The installed command in a process of its own, its output in pipes."""
    start = [sys.executable, "-m", "ncscope.cli", *map(str, arguments)]
    return subprocess.run(start, capture_output=True, text=True, timeout=60, check=False)


def program(text: str | bytes, name: str = "main.nc") -> Path:
    path = Path(name)
    path.write_bytes(text if isinstance(text, bytes) else text.encode("latin-1"))
    return path


def records(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]


# --- run ---------------------------------------------------------------------------------------


def test_jsonl_in_a_pipe() -> None:
    text = "N10 #KIN ID [91]\n#TRAFO ON\nN30 G01 X1 C30\n#TRAFO OFF\nG00 X2\nN50 X1 X2\nM30\n"
    done = command("run", program(text), "--machine", HEAD, "--format", "jsonl")
    assert done.returncode == 1
    found = records(done.stdout)
    assert [r["kind"] for r in found if r["kind"] != "diagnostic"] == ["move", "move", "end"]
    first, second = (r for r in found if r["kind"] == "move")
    assert list(first) == list(second) == MOVE_KEYS
    names = ["X", "Y", "Z", "C", "A"]
    assert list(first["pcs"]) == list(first["wcs"]) == list(first["acs"]) == names
    assert list(first["mcs"]) == ["X", "Y", "Z"]
    assert (first["index"], first["file"], first["line"]) == (0, "main.nc", 3)
    assert (first["block"], first["motion"], first["feed"]) == (30, "G01", None)
    assert (second["index"], second["block"], second["motion"]) == (1, None, "G00")
    assert first["direction"] == pytest.approx([0, 0, 1]) and second["direction"] is None
    errors = [r for r in found if r["kind"] == "diagnostic" and r["severity"] == "error"]
    assert [(e["id"], e["line"], e["column"], e["file"]) for e in errors] == [
        ("20203", 6, 8, "main.nc")
    ]
    assert found[-1] == {"kind": "end", "status": "error", "moves": 2}


def test_diagnostic_keys_are_those_of_the_design() -> None:
    found = records(call("run", program("N10 X1 X2\n"), "--format", "jsonl").stdout)
    assert list(found[0]) == DIAGNOSTIC_KEYS


def test_jsonl_numbers_and_message() -> None:
    result = call("run", program(GOOD), "--format", "jsonl")
    assert result.exit_code == 0
    first, second, message, end = records(result.stdout)
    assert first["acs"] == {"X": 10.0, "Y": 5.0, "Z": 0.0} and first["feed"] == 1000.0
    assert (second["line"], second["block"], second["acs"]["X"]) == (2, None, 20.0)
    assert message == {"kind": "message", "file": "message.txt", "text": "x 20.000000"}
    assert end == {"kind": "end", "status": "ok", "moves": 2}
    assert Path("message.txt").read_text() == "x 20.000000\n"


def test_jsonl_keeps_full_precision() -> None:
    found = records(call("run", program("X[1/3]\nM30\n"), "--format", "jsonl").stdout)
    assert found[0]["acs"]["X"] == 1 / 3


def test_table_in_a_pipe_is_plain_text() -> None:
    done = command("run", program(GOOD + "N50 X1\n"))
    assert done.returncode == 0
    assert "\x1b" not in done.stdout + done.stderr
    for part in ("10  G01  1000", "10.0000", "20.0000", "x 20.000000", "2 moves"):
        assert part in done.stdout, part
    bad = command("run", program("N10 X1 X2\n"))
    assert bad.returncode == 1 and "\x1b" not in bad.stdout + bad.stderr
    assert "20203" in bad.stderr and "20203" not in bad.stdout


def test_csv() -> None:
    result = call("run", program(GOOD), "--format", "csv")
    header, first, second = csv.reader(io.StringIO(result.stdout))
    row = dict(zip(header, first, strict=True))
    assert len(second) == len(header) == len(set(header))
    assert (row["line"], row["block"], row["motion"], row["feed"]) == ("1", "10", "G01", "1000.0")
    assert (row["pcs_X"], row["wcs_X"], row["mcs_X"], row["acs_X"]) == ("10.0",) * 4
    assert dict(zip(header, second, strict=True))["block"] == ""


@pytest.mark.parametrize("kind", ["csv", "jsonl"])
def test_out_writes_the_same_as_the_screen(kind: str) -> None:
    path = program(GOOD)
    shown = call("run", path, "--format", kind, "--messages", "a").stdout
    by_name = call("run", path, "--out", f"run.{kind}", "--messages", "b")
    assert (by_name.exit_code, by_name.stdout) == (0, "")
    assert Path(f"run.{kind}").read_text() == shown
    call("run", path, "--format", kind, "--out", "other.txt", "--messages", "c")
    assert Path("other.txt").read_text() == shown


def test_out_that_cannot_be_written() -> None:
    path = program(GOOD)
    assert call("run", path, "--out", "no/folder/x.csv").exit_code == 2
    assert call("run", path, "--out", "x.csv", "--format", "table").exit_code == 2
    assert call("run", path, "--out", "table.txt").exit_code == 2


def test_out_never_overwrites_the_program() -> None:
    path = program(GOOD)
    assert call("run", path, "--format", "csv", "--out", path).exit_code == 2
    assert path.read_text() == GOOD


def test_max_blocks_and_strict() -> None:
    path = program("N10 G01 X1\nN20 X2\nN30 M30\n")
    assert call("run", path).exit_code == 0
    assert call("run", path, "--max-blocks", "3").exit_code == 0
    limited = records(call("run", path, "--max-blocks", "1", "--format", "jsonl").stdout)
    assert [r["kind"] for r in limited].count("move") == 1
    assert [r["id"] for r in limited if r.get("severity") == "error"] == ["N4001"]
    strict = call("run", path, "--strict", "--format", "jsonl")
    assert (strict.exit_code, records(strict.stdout)[-1]) == (
        1,
        {"kind": "end", "status": "error", "moves": 1},
    )


def test_clamp_and_skip(in_empty_folder: Path) -> None:
    lists = in_empty_folder / "machine"
    lists.mkdir()
    (lists / "sda.lis").write_text((MACHINES / "xyz" / "sda.lis").read_text())
    (lists / "pzv.lis").write_text("pzv_grp[3].achse[0].versatz 100000\nEnde\n")
    path = program("/2 N10 X5\nN20 X1\nM30\n")

    def xs(*more: str) -> list[float]:
        out = call("run", path, "--machine", lists, "--format", "jsonl", *more).stdout
        return [r["acs"]["X"] for r in records(out) if r["kind"] == "move"]

    assert xs() == [5, 1]
    assert xs("--clamp", "3") == [15, 11]
    assert xs("--clamp", "3", "--skip", "1,2") == [11]
    assert call("run", path, "--machine", lists, "--clamp", "4").exit_code == 2
    assert call("run", path, "--skip", "11").exit_code == 2
    assert call("run", path, "--skip", "x").exit_code == 2


# --- wrong usage and hostile files -------------------------------------------------------------


def test_wrong_usage_is_2() -> None:
    path = program(GOOD)
    for arguments in (
        ("run", "missing.nc"),
        ("run", "."),
        ("run",),
        ("nonsense",),
        ("run", path, "--format", "xml"),
        ("run", path, "--machine", "missing"),
        ("run", path, "--max-blocks", "-1"),
        ("check", "missing.lis"),
        ("explain", "main.nc"),
        ("explain", "main.nc:x"),
        ("explain", "missing.nc:1"),
    ):
        result = call(*arguments)
        assert result.exit_code == 2, arguments
        assert result.stdout == "" or arguments == (), arguments


@pytest.mark.parametrize(
    ("content", "code"),
    [(b"", 0), (b"\n\n", 0), (bytes(range(256)) * 8, 1), (b"\x00" * 999, None), (b"\xff\xfeX", 1)],
    ids=["empty", "blank lines", "all bytes", "zeros", "utf-16 mark"],
)
def test_hostile_programs(content: bytes, code: int | None) -> None:
    result = call("run", program(content), "--format", "jsonl")
    assert code is None or result.exit_code == code
    end = records(result.stdout)[-1]
    assert (end["kind"], end["status"]) == ("end", "ok" if result.exit_code == 0 else "error")
    shown = call("run", program(content))
    text = shown.stdout + shown.stderr
    assert not [c for c in text if not c.isprintable() and c != "\n"]


@pytest.mark.parametrize(
    "name",
    ["../../evil.txt", "/tmp/ncscope_evil/evil.txt", "..\\\\..\\\\evil.txt", "a/b/evil.txt"],
)
def test_messages_stay_below_the_folder(in_empty_folder: Path, name: str) -> None:
    text = f'#FILE NAME [MSG="{name}"]\n#MSG SAVE EXCLUSIVE ["hi"]\nM30\n'
    path = program(text)
    before = {p for p in in_empty_folder.parent.rglob("*") if p.name == "evil.txt"}
    call("run", path, "--messages", "deep/messages")
    written = {p for p in in_empty_folder.parent.rglob("*evil*") if p.is_file()} - before
    assert [p.read_text() for p in written] == ["hi\n"]
    (only,) = written
    assert (in_empty_folder / "deep" / "messages") in only.parents
    assert not Path("/tmp/ncscope_evil").exists()


@pytest.mark.parametrize("name", ["..", ".", "", "/", "\x01", "main.nc"])
def test_names_that_are_no_files(in_empty_folder: Path, name: str) -> None:
    text = f'#FILE NAME [MSG="{name}"]\n#MSG SAVE EXCLUSIVE ["hi"]\nM30\n'
    path = program(text)
    call("run", path)
    assert path.read_text() == text
    assert {p.name for p in in_empty_folder.iterdir()} <= {"main.nc", "message.txt"}


def test_message_file_that_is_a_link(in_empty_folder: Path) -> None:
    (in_empty_folder / "victim.txt").write_text("mine")
    folder = in_empty_folder / "messages"
    folder.mkdir()
    (folder / "message.txt").symlink_to(in_empty_folder / "victim.txt")
    path = program('#MSG SAVE EXCLUSIVE ["hi"]\nM30\n')
    result = call("run", path, "--messages", folder, "--format", "jsonl")
    assert (in_empty_folder / "victim.txt").read_text() == "mine"
    assert result.exit_code == 1 and "N4003" in result.stdout


def test_message_never_overwrites_a_hard_link_of_the_program(in_empty_folder: Path) -> None:
    path = program('#MSG SAVE EXCLUSIVE ["hi"]\nM30\n')
    before = path.read_text()
    (in_empty_folder / "message.txt").hardlink_to(path)
    call("run", path)
    assert path.read_text() == before


def test_messages_are_appended() -> None:
    path = program('#MSG SAVE EXCLUSIVE CONTINUE ["a"]\n#MSG SAVE EXCLUSIVE ["b"]\nM30\n')
    call("run", path, "--messages", "m")
    call("run", path, "--messages", "m")
    assert Path("m/message.txt").read_text() == "ab\nab\n"


# --- explain, check, version -------------------------------------------------------------------

OFFSETS = "N10 V.G.NP[1].V.X=10\nN20 G54\nN30 G92 Y2\nN40 #CS ON [1,0,0,0,0,90]\nN50 X1\nM30\n"


def test_explain_json() -> None:
    path = program(OFFSETS)
    text = call("explain", f"{path}:N50", "--format", "json").stdout
    assert text == call("explain", f"{path}:5", "--format", "json").stdout
    found = json.loads(text)
    assert list(found) == ["file", "line", "block", "layers"]
    assert (found["file"], found["line"], found["block"]) == ("main.nc", 5, 50)
    layers = {layer["name"]: layer for layer in found["layers"]}
    assert list(layers) == ["programmed", "#CS 1", "G54", "G92", "axes"]
    assert all(list(v) == ["name", "origin", "change", "values"] for v in layers.values())
    # the start (0, 0) seen from the system at (1, 0), turned by 90 degrees, below it zero offsets
    # of (10, 2): (0, 0) - (10, 2) - (1, 0) = (-11, -2) -> (-2, 11); then X1
    assert layers["programmed"]["values"] == pytest.approx({"X": 1, "Y": 11, "Z": 0})
    assert layers["#CS 1"]["values"] == pytest.approx({"X": -10, "Y": 1, "Z": 0})
    assert layers["G54"]["change"] == pytest.approx({"X": 10, "Y": 0, "Z": 0})
    assert layers["G92"]["values"] == pytest.approx({"X": 0, "Y": 3, "Z": 0})
    origins = {name: layer["origin"] for name, layer in layers.items()}
    assert origins["#CS 1"] == "main.nc:4" and origins["G92"] == "main.nc:3"
    assert origins["G54"] == "main.nc:1" and origins["programmed"] is None


def test_explain_text_and_lines_that_were_not_run() -> None:
    path = program(OFFSETS)
    shown = call("explain", f"{path}:N50")
    assert shown.exit_code == 0
    for part in ("main.nc:5", "programmed", "#CS 1", "G54", "main.nc:3", "axes"):
        assert part in shown.stdout, part
    assert call("explain", f"{path}:99").exit_code == 1
    assert call("explain", f"{path}:N99").exit_code == 1


@pytest.mark.parametrize("folder", sorted(MACHINES.iterdir()), ids=lambda p: p.name)
def test_check_every_example_machine(folder: Path) -> None:
    result = call("check", folder)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "0 errors" in result.stdout


def test_check_finds_the_slips_of_the_printed_lists() -> None:
    zero = call("check", MACHINES / "zero_list")
    text = zero.stdout + zero.stderr
    lines = (MACHINES / "zero_list" / "nullp.lis").read_text("latin-1").splitlines()
    wrong = [n for n, t in enumerate(lines, 1) if "versatz" in t or "inaktiv 80000" in t]
    assert len(wrong) == 3
    for number in wrong:
        assert f"nullp.lis:{number}:" in text
    assert text.count("versch") >= 3 and "P-ZERO-0000" in text
    table = call("check", MACHINES / "ac_table_as_printed")
    assert "zero vector" in (table.stdout + table.stderr).lower()
    assert call("check", MACHINES / "zero_list", "--strict").exit_code == 1


@pytest.mark.parametrize("path", sorted(PROGRAMS.glob("*.nc")), ids=lambda p: p.name)
def test_check_every_example_program(path: Path) -> None:
    named = re.search(r"machine: (\w+)", path.read_text("latin-1"))
    machine = named.group(1) if named else "xyzac_axes"
    own = re.search(r"kinematics: (\w+\.py)", path.read_text("latin-1"))
    more = ["--kinematics", EXAMPLES / "kinematics" / own.group(1)] if own else []
    result = call("check", path, "--machine", MACHINES / machine, *more)
    assert result.exit_code == (1 if "as_printed" in path.name else 0), result.stderr
    assert not Path("message.txt").exists()


def test_version_and_help() -> None:
    assert call("--version").stdout == f"ncscope {ncscope.__version__}\n"
    assert call("--help").exit_code == 0
    for name in ("run", "explain", "check"):
        assert call(name, "--help").exit_code == 0
