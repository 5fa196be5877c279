"""`where`: axis positions to PCS, WCS and MCS under the state of a block; API and command line."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import ncscope
from ncscope.cli import app
from ncscope.machine import Machine, Tool

MACHINES = Path(__file__).parents[2] / "examples" / "machines"
FLAT = """N10 G92 X5 Y-2
N20 #CS ON [100,50,0,0,0,90]
N30 D1 X1 Y2 Z3
N40 X9
M30
"""
FIVE_AXES = """N10 G92 X5 Y-2
N20 V.G.WZ_AKT.L = 99
N30 #CS ON [100,50,0,0,0,30]
N40 #TRAFO [91]
N60 G00 X0 Y0 Z10 C0 A0
N70 G01 X10 Y5 Z2 C30 A20 F1000
N80 #TRAFO OFF
M30
"""


def call(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def test_offsets_system_and_tool_are_undone():
    result = ncscope.run(Machine(tools={1: Tool(length=7.0)}), FLAT).check()
    place = result.where({"X": 103.0, "Y": 49.0, "Z": 10.0}, line=3)
    # tool 7: tip (103, 49, 3) is the MCS; without G92 (98, 51, 3) is the WCS;
    # #CS at (100, 50) turned by 90 degrees: (dx, dy) = (-2, 1) reads X = dy = 1, Y = -dx = 2
    assert place.mcs == pytest.approx([103, 49, 3])
    assert place.wcs == pytest.approx([98, 51, 3])
    assert place.pcs == pytest.approx([1, 2, 3])
    assert place.direction is None and place.assumed == () and place.block == 30


def test_axes_that_are_not_given_stand_where_the_block_left_them():
    result = ncscope.run(Machine(tools={1: Tool(length=7.0)}), FLAT).check()
    place = result.where({"X": 103.0}, line=4)
    assert place.assumed == ("Y", "Z")
    assert place.acs == pytest.approx([103, 50 + 9 - 2, 10])
    before_motion = result.where({}, line=1)
    assert before_motion.acs == pytest.approx([0, 0, 0])
    assert before_motion.pcs == pytest.approx([-5, 2, 0])


@pytest.mark.parametrize("line", [5, 6])
def test_there_and_back_under_a_kinematics(line):
    """The textbook equation of the head is tested elsewhere; here the way back must fit it."""
    machine, _ = ncscope.load_machine(MACHINES / "ca_head")
    result = ncscope.run(machine, FIVE_AXES).check()
    row = result.line.tolist().index(line)
    place = result.where(dict(zip(result.axes, result.acs[row], strict=True)), line=line)
    for name in ("pcs", "wcs", "mcs", "acs", "direction"):
        wanted = getattr(result, name)[row]
        np.testing.assert_allclose(getattr(place, name), wanted, atol=1e-9, err_msg=name)


def test_unknown_axis_and_line():
    result = ncscope.run(Machine(), FLAT.replace("D1", "")).check()
    with pytest.raises(KeyError, match="axis Q is not in the channel at line 3; it has X Y Z"):
        result.where({"Q": 1.0}, line=3)
    with pytest.raises(KeyError, match="line 77 was not executed; the nearest is line 5"):
        result.where({}, line=77)


def test_command_line(tmp_path):
    program = tmp_path / "part.nc"
    program.write_text(FIVE_AXES)
    machine = ("--machine", MACHINES / "ca_head")
    given = ("--axes", "X=131.1087", "Y=20.2798", "Z=93.7212", "C=30", "A=20")
    shown = call("where", *machine, *given, "--at", f"{program}:N70")
    assert shown.exit_code == 0, shown.stderr
    rows = [line.split() for line in shown.stdout.splitlines()]
    # the block programs X10 Y5 Z2; the display has four decimals
    assert rows[2] == ["PCS", "10.0000", "5.0000", "2.0000", "30.0000", "20.0000"]
    assert rows[4][:2] == ["MCS", "111.1602"] and rows[6][0] == "dir" and rows[6][3] == "0.9397"
    found = json.loads(call("where", *machine, *given, "--at", f"{program}:6", "--format", "json")
                       .stdout)  # fmt: skip
    assert list(found) == ["file", "line", "block", "assumed", "pcs", "wcs", "mcs", "acs",
                           "direction"]  # fmt: skip
    assert (found["line"], found["block"], list(found["mcs"])) == (6, 70, ["X", "Y", "Z"])
    left = call("where", *machine, "--axes", "X=1", "--at", f"{program}:6")
    assert "not given, as the block left it: Y Z C A" in left.stdout


@pytest.mark.parametrize(
    ("axes", "at", "code", "said"),
    [
        (["X1"], "part.nc:5", 2, "--axes X1: write an axis and its position"),
        (["X=1,5"], "part.nc:5", 2, "--axes X=1,5: '1,5' is not a number"),
        (["X=nan"], "part.nc:5", 2, "--axes X=nan: nan is not a finite number"),
        (["X=1", "X=2"], "part.nc:5", 2, "--axes: X stands twice"),
        (["X=1"], "part.nc", 2, "write PROGRAM:LINE or PROGRAM:N40"),
        (["X=1"], "other.nc:5", 2, "cannot read other.nc"),
        (["B=1"], "part.nc:5", 1, "axis B is not in the channel at line 5; it has X Y Z C A"),
        (["X=1"], "part.nc:50", 1, "line 50 was not executed; the nearest is line 8"),
        (["X=1"], "part.nc:N5", 1, "block N5 was not executed"),
    ],
)
def test_used_wrongly(tmp_path, monkeypatch, axes, at, code, said):
    monkeypatch.chdir(tmp_path)
    Path("part.nc").write_text(FIVE_AXES)
    done = call("where", "--machine", MACHINES / "ca_head", "--axes", *axes, "--at", at)
    assert (done.exit_code, said in done.stderr) == (code, True), done.stderr


def test_variables_and_subprograms_of_the_run(tmp_path, monkeypatch):
    """The zero point is V.E.SHIFT + 2 (global.nc) = 7, so the axis at 10 is programmed 3."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "global.nc").write_text("G92 X[V.E.SHIFT + 2]\nM17\n")
    (tmp_path / "part.nc").write_text("L global.nc\nG00 X0\nM30\n")
    given = ("--set", "V.E.SHIFT=5", "--subprograms", "other", "--format", "json")
    done = call("where", "--axes", "X=10", "--at", "part.nc:2", *given)
    assert done.exit_code == 0, done.output
    assert json.loads(done.stdout)["pcs"]["X"] == 3.0
