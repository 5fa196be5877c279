"""`ncscope kin forward` and `inverse` as a user types them, and the tables they read."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from ncscope.cli import app

MACHINES = Path(__file__).parents[2] / "examples" / "machines"
HEAD = MACHINES / "ca_head"
AXIS_A = (0.0, 0.4, 25.0)


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def call(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(app, ["kin", *(str(a) for a in arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def rows(result: Result) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(result.stdout)))


def head_tip(x: float, y: float, z: float, c: float, a: float, length: float) -> list[float]:
    """The CA head of the example lists by its textbook equation, mm.

    tip = q + c + Rz(C) [Rx(A) (zero position - length * Z - a) + a - c], zero position
    (1.2, -0.32, 0.05), C through c = (0.08, 0.12, 0), A through a = AXIS_A.
    """
    c, a = math.radians(c), math.radians(a)
    px, py, pz = 1.2 - AXIS_A[0], -0.32 - AXIS_A[1], 0.05 - length - AXIS_A[2]
    py, pz = py * math.cos(a) - pz * math.sin(a), py * math.sin(a) + pz * math.cos(a)
    px, py, pz = px + AXIS_A[0] - 0.08, py + AXIS_A[1] - 0.12, pz + AXIS_A[2]
    px, py = px * math.cos(c) - py * math.sin(c), px * math.sin(c) + py * math.cos(c)
    return [x + px + 0.08, y + py + 0.12, z + pz]


@pytest.mark.parametrize("length", ["nan", "inf"])
def test_a_tool_length_is_a_number(length: str) -> None:
    result = call("forward", "X=1", "-m", HEAD, "--tool-length", length)
    assert result.exit_code == 2 and "write a length in mm" in result.stderr


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"X,Y,Z,C,A\n", "has no rows below the names of its columns"),
        (b"X,\x00\x8f\x01\r7,Z\n1,2,3\n", "it holds no text"),
        (b"X,Y\n1,\r2\n1,zwei\n", "N4201"),
        (b"", "it is empty"),
    ],
)
def test_files_that_are_no_table_are_named(data: bytes, said: str) -> None:
    Path("p.csv").write_bytes(data)
    for command in (["inverse", "-m", HEAD], ["compare", HEAD, HEAD]):
        result = call(*command, "--poses", "p.csv")
        assert result.exit_code == 1 and said in result.stderr and result.stdout == ""


def test_both_poses_of_one_direction() -> None:
    """A complete transformation: the words mean the same in both poses, twins C+180 and -A."""
    text = (HEAD / "sda.lis").read_text().replace("kinematik[91].rtcp 1", "kinematik[91].rtcp 0")
    Path("sda.lis").write_text(text)
    found = rows(call("inverse", "C=30", "A=45", "--both", "-m", "sda.lis", "--format", "csv"))
    assert [float(r["pcs_C"]) for r in found] == [30, 30]
    assert [float(r["pcs_A"]) for r in found] == [45, 45]
    assert [float(r["acs_C"]) for r in found] == pytest.approx([30, -150])
    assert [float(r["acs_A"]) for r in found] == pytest.approx([45, -45])


def test_the_pole_has_one_pose() -> None:
    result = call("inverse", "--tip", "X=1", "Y=2", "Z=3", "--direction", "0", "0", "1",
                  "--both", "-m", HEAD, "--format", "csv")  # fmt: skip
    assert len(rows(result)) == 1


def test_a_second_step_has_a_kinematics_too() -> None:
    text = (HEAD / "sda.lis").read_text()
    second = "".join(
        line.replace("kinematik[91]", "kin_step[1].trafo[0]") + "\n"
        for line in text.splitlines()
        if line.startswith("kinematik")
    )
    second = second.replace("zero_position[0] 12000", "zero_position[0] 22000")
    Path("sda.lis").write_text(
        text.replace("Ende\n", "") + "kin_step[1].trafo[0].id 92\nkin_step[1].trafo[0].type 91\n"
        + second
    )  # fmt: skip
    tips = [
        float(rows(call("forward", "X=5", "-m", "sda.lis", "--format", "csv", *id))[0]["mcs_X"])
        for id in ([], ["--id", "92"])
    ]
    assert tips == pytest.approx([6.2, 7.2])


def test_huge_numbers_do_not_widen_the_table() -> None:
    result = call("forward", "X=1e300", "-m", HEAD)
    assert "1e+300" in result.stdout and max(map(len, result.stdout.splitlines())) < 120


def test_forward_of_words_is_the_textbook_equation() -> None:
    result = call(
        "forward", "--axes", "X=1", "Y=-2", "C=30", "A=-20.5",
        "-m", HEAD, "--tool-length", "99", "--format", "jsonl",
    )  # fmt: skip
    record = json.loads(result.stdout)
    assert list(record["mcs"].values()) == pytest.approx(head_tip(1, -2, 0, 30, -20.5, 99))
    assert record["pose"] == -1
    assert record["condition"]["rotary"] == pytest.approx(1 / math.sin(math.radians(20.5)))
    assert result.exit_code == 0


def test_words_may_stand_alone() -> None:
    a = call("forward", "X=1", "C=30", "--machine", HEAD)
    b = call("forward", "--machine", HEAD, "--axes", "X=1", "--axes", "C=30")
    assert a.stdout == b.stdout and "30.0000" in a.stdout


def test_inverse_of_tip_and_direction_in_both_poses() -> None:
    # Tool tilted by 30 degrees about X: direction (0, -sin 30, cos 30); twins A30 and C180 A-30.
    result = call(
        "inverse", "--tip", "X=5", "Y=6", "Z=7", "--direction", "0", "-0.5", f"{math.sqrt(3) / 2}",
        "--both", "-m", HEAD, "--tool-length", "50", "--format", "csv",
    )  # fmt: skip
    found = rows(result)
    angles = [(float(r["acs_C"]), float(r["acs_A"])) for r in found]
    assert angles[0] == pytest.approx((0, 30), abs=1e-9)
    assert angles[1] == pytest.approx((180, -30), abs=1e-9)
    for r in found:
        values = [float(r[f"acs_{axis}"]) for axis in "XYZCA"]
        assert head_tip(*values, 50) == pytest.approx([5, 6, 7])


def test_near_chooses_the_pose() -> None:
    tool = ["--tip", "X=0", "Y=0", "Z=0", "--direction", "0", "-1", "1", "-m", HEAD]
    near = rows(call("inverse", *tool, "--near", "A=-1", "C=170", "--format", "csv"))
    assert float(near[0]["acs_A"]) == pytest.approx(-45)


def test_a_table_goes_there_and_back() -> None:
    Path("in.csv").write_text("X,Y,Z,C,A\n1,2,3,40,10\n\n# noted\n-1,0,5,-100,-35.5\n")
    assert call("forward", "--poses", "in.csv", "-m", HEAD, "--out", "a.csv").exit_code == 0
    assert call("inverse", "--poses", "a.csv", "-m", HEAD, "--out", "b.parquet").exit_code == 0
    back = rows(call("forward", "--poses", "b.parquet", "-m", HEAD, "--format", "csv"))
    # The second row comes back in the pose of axes at 0, so only the first keeps its angles.
    assert [float(back[0][f"acs_{axis}"]) for axis in "XYZCA"] == pytest.approx([1, 2, 3, 40, 10])
    with open("a.csv") as stream:
        first = list(csv.DictReader(stream))
    for a, b in zip(first, back, strict=True):
        for name in ("mcs_X", "mcs_Y", "mcs_Z", "direction_i", "direction_k"):
            assert float(a[name]) == pytest.approx(float(b[name]))


def test_semicolons_and_decimal_commas() -> None:
    Path("in.csv").write_text("X;Y;Z;C;A\n1,5;2;3;40;10\n")
    found = rows(call("forward", "--poses", "in.csv", "-m", HEAD, "--format", "csv"))
    assert float(found[0]["acs_X"]) == 1.5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("X,Y,Z\n1,two,3\n", "in.csv:2:1: error N4201: column Y: 'two' is not a number"),
        ("X,Y,Z\n1,2\n", "the line ends before column Z"),
        ("X,Y,X\n1,2,3\n", "the column X twice"),
        ("1,2,3\n4,5,6\n", "its first line has no column names"),
        ("", "it is empty"),
        ("U,V\n1,2\n", "has no column of the axes X Y Z C A"),
    ],
)
def test_a_faulty_table_is_named(text: str, said: str) -> None:
    Path("in.csv").write_text(text)
    result = call("forward", "--poses", "in.csv", "-m", HEAD)
    assert result.exit_code != 0
    assert said in result.stderr


def test_columns_that_are_missing_or_unused_are_named() -> None:
    Path("in.csv").write_text("X,c\n1,30\n")
    said = call("forward", "--poses", "in.csv", "-m", HEAD).stderr
    assert "no column for Y, Z, C, A; 0 is taken" in said
    assert "no axis is called c" in said


def test_an_empty_cell_spoils_its_row_only() -> None:
    Path("in.csv").write_text("X,Y,Z,C,A\n1,2,3,4,5\n1,2,,4,5\n")
    result = call("inverse", "--poses", "in.csv", "-m", HEAD, "--format", "jsonl")
    records = [json.loads(line) for line in result.stdout.splitlines()]
    assert [r["error"] and r["error"]["id"] for r in records] == [None, "20703"]
    assert records[1]["acs"]["X"] is None
    assert result.exit_code == 1


def test_an_unreachable_direction_is_a_message() -> None:
    # The cardanic table tilts by at most 90 degrees: the tool cannot point downwards.
    result = call(
        "inverse", "--tip", "X=0", "Y=0", "Z=0", "--direction", "0", "0", "-1",
        "-m", MACHINES / "cardanic_table",
    )  # fmt: skip
    assert "292014" in result.stdout and "1 of 1 poses have no solution" in result.stderr
    assert result.exit_code == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["forward", "X=1"], "which machine?"),
        (["forward", "-m", "nowhere", "X=1"], "machine nowhere does not exist"),
        (["forward", "-m", HEAD], "write axis values, such as X=10"),
        (["forward", "-m", HEAD, "Q=1"], "with a name of X Y Z C A"),
        (["forward", "-m", HEAD, "X=1", "X=2"], "X stands twice"),
        (["forward", "-m", HEAD, "X=east"], "'east' is not a number"),
        (["forward", "-m", HEAD, "X=inf"], "inf is not a finite number"),
        (["forward", "-m", HEAD, "--id", "9", "X=1"], "kinematics 9 is not configured"),
        (["forward", "-m", MACHINES / "xyz", "X=1"], "configure no kinematics"),
        (["forward", "-m", HEAD, "--poses", "no.csv"], "cannot read no.csv"),
        (["forward", "-m", HEAD, "X=1", "--out", "a.txt"], "name it .csv, .jsonl or .parquet"),
        (["inverse", "-m", HEAD, "--tip", "X=1", "Y=1", "Z=1"], "belong together"),
        (["inverse", "-m", HEAD, "--tip", "X=1", "--direction", "0", "0", "1"], "all of X, Y"),
        (["inverse", "-m", HEAD, "X=1", "--poses", "no.csv"], "give one of"),
    ],
)
def test_wrong_usage_is_said(arguments: list[str | Path], said: str) -> None:
    result = call(*arguments)
    assert result.exit_code == 2
    assert said in " ".join(result.stderr.split())


def test_a_kinematics_that_cannot_be_used_names_the_line_of_the_list() -> None:
    result = call("forward", "X=1", "-m", MACHINES / "ac_table_as_printed")
    assert result.exit_code == 1
    assert "N3009" in result.stderr and ".lis:" in result.stderr


# --- compare -----------------------------------------------------------------------------------


def skewed(tmp_path: Path) -> tuple[Path, Path]:
    """The head of the examples, and the same with X along (1, 0, -0.001)."""
    text = (HEAD / "sda.lis").read_text()
    for name, value in (("a", "0"), ("b", "-0.001")):
        (tmp_path / name).mkdir()
        changed = text.replace("axis[0].orientation[2] 0", f"axis[0].orientation[2] {value}")
        (tmp_path / name / "sda.lis").write_text(changed)
    return tmp_path / "a", tmp_path / "b"


def test_compare_shows_what_compensation_does(tmp_path: Path) -> None:
    a, b = skewed(tmp_path)
    result = call("compare", a, b, "--grid", "X=-100:300:3", "--format", "jsonl")
    found = {r["quantity"]: r for r in map(json.loads, result.stdout.splitlines())}
    # Axis value X at tip X 300: 300 - 1.2 of the flange. Off by 0.001 of it in Z.
    assert found["tip before"]["largest"] == pytest.approx(0.2988, abs=1e-6)
    assert found["tip before"]["worst"]["X"] == 300
    assert found["tip after"]["largest"] == pytest.approx(0, abs=1e-9)
    assert found["axis Z"]["largest"] == pytest.approx(0.2988, abs=1e-6)
    assert found["axis C"]["largest"] == 0
    # rms of 101.2, 98.8 and 298.8 thousandths: sqrt((10241.4 + 9761.4 + 89281.4) / 3) / 1000.
    assert found["axis Z"]["rms"] == pytest.approx(0.190862, abs=1e-6)


def test_compare_pose_by_pose(tmp_path: Path) -> None:
    a, b = skewed(tmp_path)
    Path("p.csv").write_text("X,Y,Z,C,A\n101.2,0,0,0,0\n1.2,0,0,0,0\n")
    found = rows(call("compare", a, b, "--poses", "p.csv", "--format", "csv"))
    assert [float(r["tip_before_Z"]) for r in found] == pytest.approx([-0.1, 0], abs=1e-6)
    table = call("compare", a, b, "--poses", "p.csv", "--rows").stdout
    assert "101.2000" in table and "tool tip, computed with A, on machine B" in table


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([HEAD, HEAD], "which poses?"),
        ([HEAD, HEAD, "--grid", "X=1:2"], "write FROM:TO:COUNT"),
        ([HEAD, HEAD, "--grid", "X=1:2:2.5"], "write FROM:TO:COUNT"),
        ([HEAD, HEAD, "--grid", "X=1:2:0"], "write FROM:TO:COUNT"),
        ([HEAD, HEAD, "--grid", "Q=1"], "with a name of X Y Z C A"),
        ([HEAD, HEAD, "--grid", "X=1:2:1001", "Y=1:2:1000"], "at most 1000000"),
    ],
)
def test_compare_says_what_is_missing(arguments: list[str | Path], said: str) -> None:
    result = call("compare", *arguments)
    assert result.exit_code == 2
    assert said in " ".join(result.stderr.split())


def test_compare_of_different_axes() -> None:
    result = call("compare", HEAD, MACHINES / "spline_linkage", "--grid", "X=0:1:2")
    assert result.exit_code == 1 and "292040" in result.stderr
