"""Files that are written while the program runs: the bytes of a finished run, valid when broken
off, and with every axis."""

from __future__ import annotations

import io
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import ncscope
from ncscope.cli import app
from ncscope.views.records import write_csv, write_jsonl

HEAD = str(Path(__file__).parents[1] / "examples" / "machines" / "ca_head")
CODE = ["-c", "from ncscope.cli import main; main()"]


def call(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def long_program(path: Path, blocks: int) -> Path:
    """Plain blocks with a coordinate system and a comment in the middle; five axes with RTCP."""
    lines = ["%MAIN", "N1 G54 G90 F2000", "#KIN ID [91]", "#TRAFO ON"]
    lines += [f"N{i + 2} G1 X{i % 90} Y{i % 7}.5 Z-1 A{i % 30} C{-i % 60}" for i in range(blocks)]
    lines[blocks // 2 : blocks // 2] = ["#CS ON [1,2,3,0,0,30]", "(turned)"]
    path.write_text("\n".join([*lines, "#CS OFF", "#TRAFO OFF", "M30", ""]))
    return path


@pytest.fixture(scope="module")
def program(tmp_path_factory) -> Path:
    return long_program(tmp_path_factory.mktemp("stream") / "long.nc", 3000)


@pytest.mark.parametrize("shape", ["csv", "jsonl"])
@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("sample", [None, 0.5])
def test_streamed_text_is_that_of_a_finished_run(program, tmp_path, shape, jobs, sample):
    out = tmp_path / f"out.{shape}"
    more = [] if sample is None else ["--sample", sample]
    found = call("run", program, "-m", HEAD, "--out", out, "--jobs", jobs, *more)
    assert found.exit_code == 0, found.stderr
    machine, _ = ncscope.load_machine(HEAD)
    options = ncscope.Options(sample=sample)
    result = ncscope.run(machine, ncscope.load_program(program), options)
    text = io.StringIO()
    write_csv(text, result) if shape == "csv" else write_jsonl(text, result, (), True)
    assert out.read_text() == text.getvalue()


def test_streamed_parquet_has_the_columns_of_the_result(program, tmp_path):
    import pyarrow.parquet

    out = tmp_path / "out.parquet"
    assert call("run", program, "-m", HEAD, "--out", out).exit_code == 0
    machine, _ = ncscope.load_machine(HEAD)
    result = ncscope.run(machine, ncscope.load_program(program))
    table = pyarrow.parquet.read_table(out)
    assert table.schema.names == result.to_arrow().schema.names
    assert table.num_rows == len(result) == 3000
    for name in ("acs", "mcs", "wcs", "pcs"):
        columns = [table[f"{name}_{axis}"].to_numpy() for axis in result.axes]
        assert np.array_equal(np.column_stack(columns), getattr(result, name))
    assert table["motion"][0].as_py() == "G01" and table["line"].to_pylist() == list(result.line)
    assert np.array_equal(table["direction_k"].to_numpy(), result.direction[:, 2])


@pytest.mark.parametrize("shape", ["csv", "parquet"])
def test_an_axis_that_turns_up_later_has_its_column(tmp_path, shape):
    path, out = tmp_path / "axes.nc", tmp_path / f"out.{shape}"
    path.write_text("G0 X1 Y2 Z3\n#SET AX [X,1,0] [Y,2,1] [Z,3,2] [U,4,3]\nG0 X5 U7\nM30\n")
    assert call("run", path, "--out", out).exit_code == 0
    assert call("run", path, "--format", "csv").exit_code == 0
    if shape == "csv":
        head, *rows = (line.split(",") for line in out.read_text().splitlines())
        u = [row[head.index("acs_U")] for row in rows]
        assert u == ["", "7.0"]
    else:
        import pyarrow.parquet

        u = pyarrow.parquet.read_table(out)["acs_U"].to_pylist()
        assert np.isnan(u[0]) and u[1] == 7.0


@pytest.mark.parametrize("shape", ["jsonl", "csv", "parquet"])
def test_a_run_that_is_broken_off_leaves_a_valid_file(tmp_path, shape):
    """Ctrl-C while an endless loop moves; the file has moves and its end."""
    path, out = tmp_path / "endless.nc", tmp_path / f"out.{shape}"
    path.write_text("P1=0\n$WHILE 1\nP1=P1+1\nG91 X1\nX-1\nG90\n$ENDWHILE\nM30\n")
    child = subprocess.Popen(
        [sys.executable, *CODE, "run", str(path), "--out", str(out)],
        stderr=subprocess.PIPE,
        # A shell that runs the tests in the background makes all of them deaf to Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    while not out.exists():
        time.sleep(0.1)
    time.sleep(2)
    child.send_signal(2)
    _, said = child.communicate(timeout=60)
    assert child.returncode == 130 and b"Traceback" not in said
    if shape == "jsonl":
        *moves, end = map(json.loads, out.read_text().splitlines())
        assert end == {"kind": "end", "status": "error", "moves": len(moves)} and len(moves) > 10
    elif shape == "csv":
        rows = out.read_text().splitlines()
        assert out.read_text().endswith("\n") and len({row.count(",") for row in rows}) == 1
    else:
        import pyarrow.parquet

        assert pyarrow.parquet.read_table(out).num_columns > 10


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--format", "parquet"], "--format parquet needs --out FILE"),
        (["--out", "missing/x.parquet"], "cannot write missing/x.parquet"),
        (["--out", "missing/x.csv"], "cannot write missing/x.csv: No such file"),
        (["--out", "x.txt"], "--out writes csv, jsonl or parquet"),
    ],
)
def test_what_cannot_be_written(program, arguments, said):
    found = call("run", program, "-m", HEAD, *arguments)
    assert found.exit_code == 2 and said in found.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a file that is always full")
@pytest.mark.parametrize("shape", ["table", "csv", "jsonl"])
def test_output_on_a_full_disk_is_said_in_one_line(program, shape):
    with open("/dev/full", "w") as full:
        command = [sys.executable, *CODE, "run", str(program), "-m", HEAD, "--format", shape]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2
    assert "ncscope: cannot write the output: No space left on device" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_reader_who_has_seen_enough_is_no_error(program):
    """More than a pipe holds, of which one line is read."""
    command = [sys.executable, *CODE, "run", str(program), "-m", HEAD, "--format", "csv"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        assert child.stdout is not None and child.stderr is not None
        child.stdout.readline()
        child.stdout.close()
        said = child.stderr.read()
    assert (child.returncode, b"Traceback" in said) == (0, False), said


def test_a_process_without_standard_output_ends_well(program, tmp_path):
    out = tmp_path / "out.csv"
    command = [sys.executable, *CODE, "run", str(program), "-m", HEAD, "--out", str(out)]
    closed = ["sh", "-c", 'exec "$@" >&-', "sh", *command]
    done = subprocess.run(closed, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False), done.stderr
    assert len(out.read_text().splitlines()) == 3001
