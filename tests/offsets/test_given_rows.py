"""Tables of probe answers and jog increments: what is read, and what is wrong where."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

import ncscope
from ncscope.channel.given import read_rows
from ncscope.cli import app
from ncscope.diagnostics import Source

PROGRAM = "N10 G100 X100 F500\nN20 G101 X1\nN30 X100\nM30\n"


def rows_of(text):
    table, found = read_rows(Source("probe.csv", text))
    assert found == ()
    return [dict(row.values) for row in table.rows]


def faults_of(text):
    _, found = read_rows(Source("probe.csv", text))
    return [(d.id, d.line, d.column) for d in found]


def call(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def test_separators_blanks_comments_and_empty_cells():
    assert rows_of("X,Y\n1,-2.5\n") == [{"X": 1.0, "Y": -2.5}]
    assert rows_of("# contact\r\n X ; Z_1 \r\n\r\n +1. ; \r\n-;.5\r\n") == [
        {"X": 1.0}, {"Z_1": 0.5}
    ]  # fmt: skip
    assert rows_of("X,Y\n1\n,\n") == [{"X": 1.0}, {}]
    assert rows_of("X\n") == []


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("", [("N4010", 1, 1)]),
        ("# only\n", [("N4010", 1, 1)]),
        ("X,1Y\n1,2\n", [("N4010", 1, 3)]),
        ("X,Y,X\n1,2\n", [("N4010", 1, 5)]),
        ("X,Y\n1,two\n", [("N4010", 2, 3)]),
        ("X,Y\n1,2\n1,5,3\n", [("N4010", 3, 5)]),
        ("X;Y\n98,5;1\n", [("N4010", 2, 1)]),
        ("X\nnan\ninf\n1e999\n", [("N4010", 2, 1), ("N4010", 3, 1), ("N4010", 4, 1)]),
    ],
)
def test_faults_have_their_place(text, faults):
    assert faults_of(text) == faults


@given(st.text(alphabet="XY,;.-+01e #\n\r\t\x00é\u2028", max_size=40))
def test_any_text_is_read_or_blamed(text):
    table, found = read_rows(Source("probe.csv", text))
    for item in found:
        assert item.id == "N4010" and ncscope.render(item)
    assert all(isinstance(v, float) for row in table.rows for v in row.values.values())


def test_api():
    table, _ = read_rows(Source("probe.csv", "X\n98.5\n"))
    result = ncscope.run(ncscope.Machine(), PROGRAM, ncscope.Options(probe=table)).check()
    assert result.acs[:, 0].tolist() == [98.5, 98.5]
    again = ncscope.run(ncscope.Machine(), PROGRAM, ncscope.Options(probe=table)).check()
    assert again.acs.tolist() == result.acs.tolist()


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("part.nc").write_text(PROGRAM)
    Path("probe.csv").write_text("X\n98.5\n")
    Path("bad.csv").write_text("X\n98,5\n")
    return tmp_path


def test_probe_of_every_command(folder):
    given = ("--probe", "probe.csv")
    assert "98.5000" in call("run", "part.nc", *given).stdout
    layers = json.loads(call("explain", "part.nc:N30", *given, "--format", "json").stdout)["layers"]
    (measured,) = [layer for layer in layers if layer["name"] == "G101"]
    assert measured["change"]["X"] == -1.5 and measured["origin"] == "part.nc:2"
    shown = call("where", "--axes", "X=98.5", "--at", "part.nc:3", *given, "--format", "json")
    assert json.loads(shown.stdout)["pcs"]["X"] == 100.0
    checked = call("check", "part.nc", *given)
    assert checked.exit_code == 0 and "0 errors" in checked.stdout
    noted = call("check", "part.nc")
    assert noted.stderr.count("it triggers at the target") == 1


@pytest.mark.parametrize(
    "command",
    [("run", "part.nc"), ("explain", "part.nc:1"), ("check", "part.nc"),
     ("where", "--axes", "X=1", "--at", "part.nc:1")],
)  # fmt: skip
def test_bad_file_stops_every_command(folder, command):
    done = call(*command, "--probe", "bad.csv")
    assert done.exit_code == 1
    assert "bad.csv:2:4: error N4010" in done.stderr and "a point, not a comma" in done.stderr
    missing = call(*command, "--probe", "nowhere.csv")
    assert missing.exit_code == 2 and "cannot read nowhere.csv" in missing.stderr


def test_bad_file_in_jsonl(folder):
    done = call("run", "part.nc", "--probe", "bad.csv", "--format", "jsonl")
    first, *_, last = [json.loads(line) for line in done.stdout.splitlines()]
    assert (first["id"], first["file"], first["line"]) == ("N4010", "bad.csv", 2)
    assert last == {"kind": "end", "status": "error", "moves": 0}


def test_jog_increments_of_every_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("jog.nc").write_text("N10 X100\nN20 G201 X1\nN30 G202\nN40 X200\nM30\n")
    Path("jog.csv").write_text("X\n3\n")
    given = ("--manual", "jog.csv")
    moves = [json.loads(t) for t in call("run", "jog.nc", *given, "--format", "jsonl").stdout
             .splitlines()]  # fmt: skip
    assert [m["acs"]["X"] for m in moves[:-1]] == [100, 103, 203]
    assert [m["mcs"]["X"] for m in moves[:-1]] == [100, 100, 200]
    layers = json.loads(call("explain", "jog.nc:4", *given, "--format", "json").stdout)["layers"]
    assert [(layer["name"], layer["origin"]) for layer in layers] == [
        ("programmed", None), ("manual", "jog.csv:2"), ("axes", None)
    ]  # fmt: skip
    shown = call("where", "--axes", "X=203", "--at", "jog.nc:4", *given, "--format", "json")
    assert json.loads(shown.stdout)["pcs"]["X"] == 200.0
    left = call("check", "jog.nc", "--manual", "jog.csv").stderr
    assert "N2026" not in left
