"""Kinematics of the user: the delta example against its rods, and classes that go wrong."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner, Result

import ncscope
from ncscope.cli import app
from ncscope.kinematics import KinematicsError
from ncscope.loading import user_kinematics

EXAMPLES = Path(__file__).parents[2] / "examples"
DELTA, LISTS = EXAMPLES / "kinematics" / "delta.py", EXAMPLES / "machines" / "delta"
ROD, RADIUS = 250.0, 150.0


def machine():
    lists, found = ncscope.load_machine(LISTS)
    own, problems = ncscope.with_user_kinematics(lists, DELTA)
    assert not found and not problems
    return own


def call(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(app, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_the_rods_keep_their_length() -> None:
    """Each carriage is one rod from the tool: the distance is checked, no formula repeated."""
    kin = machine().kinematics[500]
    rng = np.random.default_rng(1)
    program = rng.uniform(-60, 60, (50, 3))
    heights = kin.inverse(program, 12.0)
    flange = program + np.array([0, 0, 12.0])
    for i, angle in enumerate(np.radians([90, 210, 330])):
        foot = RADIUS * np.array([np.cos(angle), np.sin(angle)])
        carriage = np.column_stack([np.tile(foot, (50, 1)), heights[:, i]])
        assert np.linalg.norm(carriage - flange, axis=1) == pytest.approx(np.full(50, ROD))
        assert (carriage[:, 2] > flange[:, 2]).all()
    assert kin.forward(heights, 12.0)[0] == pytest.approx(program)
    assert kin.program(heights, 12.0) == pytest.approx(program)
    # In the middle: sqrt(250^2 - 150^2) = 200.
    assert kin.inverse([0, 0, 5.0]) == pytest.approx([205, 205, 205])


def test_a_program_with_the_step_and_the_pcs_transformation() -> None:
    result = ncscope.run(machine(), ncscope.load_program(EXAMPLES / "programs" / "delta.nc"))
    assert result.ok
    by_block = dict(zip(result.block.tolist(), result.acs, strict=True))
    kin = machine().kinematics[500]
    # Radius 40 at 90 degrees is X0 Y40; 40 at 180 is X-40 Y0.
    assert by_block[90] == pytest.approx(kin.inverse([0, 40, 0]))
    assert by_block[100] == pytest.approx(kin.inverse([-40, 0, 0]))
    assert result.direction == pytest.approx(np.tile([0, 0, 1], (len(result.acs), 1)))


def test_lanes_agree() -> None:
    """Plain blocks go through the class in one array, the same blocks with a comment one by one."""
    blocks = [f"G01 X{i % 7} Y{-i % 11} Z{i % 3}" for i in range(200)]
    start, end = "#TRAFO [500]\nG01 F100 X1\n", "\n#TRAFO OFF\nM30\n"
    bulk = ncscope.run(machine(), start + "\n".join(blocks) + end)
    step = ncscope.run(machine(), start + "\n".join(f"{b} (x)" for b in blocks) + end)
    assert bulk.ok and step.ok
    assert bulk.acs == pytest.approx(step.acs, abs=1e-9)


def test_commands_take_the_file() -> None:
    options = ["--machine", LISTS, "--kinematics", DELTA]
    run = call("run", EXAMPLES / "programs" / "delta.nc", *options)
    assert run.exit_code == 0 and "224.4994" in run.stdout
    explain = call("explain", f"{EXAMPLES / 'programs' / 'delta.nc'}:N90", *options)
    assert "#TRAFO PCS" in explain.stdout
    kin = call("kin", "forward", "X=200", "Y=200", "Z=200", *options)
    assert kin.exit_code == 0 and "delta" in kin.stdout
    far = call("kin", "inverse", "X=400", *options)
    assert far.exit_code == 1 and "N2602: the kinematics has no solution" in far.stdout
    missing = call("run", EXAMPLES / "programs" / "delta.nc", "--machine", LISTS)
    assert missing.exit_code == 1 and "--kinematics FILE.py" in missing.stderr
    nowhere = call("run", EXAMPLES / "programs" / "delta.nc", "--kinematics", "no.py")
    assert nowhere.exit_code == 2 and "cannot read no.py" in nowhere.stderr


def test_a_move_out_of_reach_stops_at_its_block() -> None:
    result = ncscope.run(machine(), "#TRAFO [500]\nG00 X1\nX2\nX300\nX3\nM30\n")
    (found,) = result.diagnostics
    assert (found.id, found.line, len(result.acs)) == ("N2602", 4, 2)


GOOD = """
import numpy as np
class K:
    id = 500
    def __init__(self, param, axis_names): pass
    def forward(self, axes, tool_length): return axes
    def inverse(self, program, tool_length, near): return program
"""


def with_file(tmp_path: Path, text: str):
    path = tmp_path / "k.py"
    path.write_text(text)
    lists, _ = ncscope.load_machine(LISTS)
    return ncscope.with_user_kinematics(lists, path)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return program[0]", "K.inverse returned an array of shape (3,) instead of (1, 3)"),
        ("return program[:, :2]", "returned an array of shape (1, 2)"),
        ("return 1 / 0", "K.inverse failed: ZeroDivisionError: division by zero"),
        ("return None", "returned values of type object"),
        ("return 'here'", "returned values of type"),
        ("return program * 1j", "returned values of type complex128"),
        ("return program * np.nan", "K.inverse has no solution for (1, 0, 0)"),
        ("raise SystemExit", "K.inverse failed: SystemExit"),
        ("return program.nothing", "AttributeError"),
    ],
)
def test_a_faulty_answer_is_a_diagnostic(tmp_path: Path, body: str, said: str) -> None:
    own, found = with_file(tmp_path, GOOD.replace("return program", body))
    assert not found
    for text in ("#TRAFO [500]\nX1\nM30\n", "#TRAFO [500]\n" + "G01 F9 X1\n" * 300):
        result = ncscope.run(own, text)
        (error,) = [d for d in result.diagnostics if d.is_error]
        assert error.id in ("N2601", "N2602") and said in error.message


def test_forward_has_to_undo_inverse(tmp_path: Path) -> None:
    """The control compares both; 3 list units are allowed unless the list says more."""
    for shift, ok in ((0.0002, True), (0.0004, False), (5.0, False)):
        own, _ = with_file(tmp_path, GOOD.replace("return program", f"return program + {shift}"))
        result = ncscope.run(own, "#TRAFO [500]\nX1\n#TRAFO OFF\nM30\n")
        assert result.ok == ok
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.id, error.line) == ("292023", 2)
    assert "K.forward gives (" in error.message
    assert "P-CHAN-00228" in error.hint
    coarse = replace(own, settings=replace(own.settings, deviation=6.0))
    again, _ = ncscope.with_user_kinematics(coarse, tmp_path / "k.py")
    assert ncscope.run(again, "#TRAFO [500]\nX1\n#TRAFO OFF\nM30\n").ok


def test_words_that_mean_the_same_position_may_differ(tmp_path: Path) -> None:
    """A radius and an angle: `forward` cannot know whether 30 or 390 degrees were written."""
    polar = """
import numpy as np
class Polar:
    id = 500
    def __init__(self, param, axis_names): pass
    def forward(self, axes, tool_length):
        x, y = axes[:, 0], axes[:, 1]
        return np.column_stack([np.hypot(x, y), np.degrees(np.arctan2(y, x)), axes[:, 2]])
    def inverse(self, program, tool_length, near):
        r, t = program[:, 0], np.radians(program[:, 1])
        return np.column_stack([r * np.cos(t), r * np.sin(t), program[:, 2]])
"""
    own, _ = with_file(tmp_path, polar)
    result = ncscope.run(own, "#TRAFO [500]\nX10 Y390\nX-10 Y-90\n#TRAFO OFF\nM30\n").check()
    assert result.acs[-1] == pytest.approx([0, 10, 0], abs=1e-9)


def test_inputs_of_a_class_are_copies(tmp_path: Path) -> None:
    own, _ = with_file(tmp_path, GOOD.replace("return program", "program[:] = 7; return program"))
    program = np.ones((2, 3))
    own.kinematics[500].inverse(program)
    assert (program == 1).all()


def test_a_constructor_that_fails(tmp_path: Path) -> None:
    own, _ = with_file(tmp_path, GOOD.replace(": pass", ": raise ValueError('rods too short')"))
    with pytest.raises(KinematicsError, match="rods too short"):
        own.kinematics[500]
    (found,) = ncscope.run(own, "#TRAFO [500]\nM30\n").diagnostics
    assert "ValueError: rods too short" in found.message and found.line == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = = 1\n", "k.py cannot be run: SyntaxError"),
        ("\nx = 1 / 0\n", "k.py cannot be run: ZeroDivisionError"),
        ("import sys\nsys.exit(3)\n", "k.py cannot be run: SystemExit"),
        ("x = 1\n", "k.py defines no kinematics class"),
        (GOOD.replace("500", "91"), "its attribute id is 91, but has to be a number from 500"),
        (GOOD.replace("500", "'a'"), "its attribute id is 'a'"),
        (GOOD.replace("def forward", "def backward"), "it has no method forward"),
        (
            GOOD + GOOD.replace("class K", "class L"),
            "k.py: L is no kinematics: its id 500 is used by k.py: K",
        ),
        ("\0", "k.py cannot be run"),
    ],
)
def test_a_faulty_file_is_a_diagnostic(tmp_path: Path, text: str, said: str) -> None:
    _, found = with_file(tmp_path, text)
    assert [d.id for d in found] == ["N4301"] and said in found[0].message


def test_the_line_of_a_faulty_file_is_named(tmp_path: Path) -> None:
    _, (found,) = with_file(tmp_path, "\nx = 1\ny = x / 0\n")
    assert found.line == 3


def test_installed_classes_come_by_entry_point(monkeypatch: pytest.MonkeyPatch) -> None:
    class Straight:
        id = 500

        def __init__(self, param, axis_names):
            self.param = param

        def forward(self, axes, tool_length):
            return axes - self.param[0] / 1e4

        def inverse(self, program, tool_length, near):
            return program + self.param[0] / 1e4

    def broken():
        raise ImportError("no module named rods")

    points = [
        SimpleNamespace(name="s", value="a:Straight", load=lambda: Straight),
        SimpleNamespace(name="b", value="b:B", load=broken),
    ]
    monkeypatch.setattr(user_kinematics.metadata, "entry_points", lambda group: points)
    lists, _ = ncscope.load_machine(LISTS)
    own, found = ncscope.with_user_kinematics(lists)
    assert own.kinematics[500].inverse([1, 2, 3]) == pytest.approx([251, 252, 253])
    assert [(d.id, d.severity) for d in found] == [("N4301", "warning")]
    # A machine without such an id asks for none, and a file counts before an installed class.
    assert ncscope.with_user_kinematics(ncscope.Machine()) == (ncscope.Machine(), ())
    file, _ = ncscope.with_user_kinematics(lists, DELTA)
    assert file.kinematics[500].inverse([0, 0, 0]) == pytest.approx([200, 200, 200])


def test_a_table_keeps_the_rows_that_can_be_reached(tmp_path: Path) -> None:
    poses = tmp_path / "poses.csv"
    poses.write_text("X,Y,Z\n0,0,0\n4000,0,0\n-40,0,0\n")
    options = ["--machine", LISTS, "--kinematics", DELTA, "--format", "csv"]
    done = call("kin", "inverse", "--poses", poses, *options)
    lines = done.stdout.splitlines()
    assert done.exit_code == 1 and "1 of 3 poses have no solution" in done.stderr
    assert [line.rsplit(",", 1)[1] for line in lines[1:]] == ["", "N2602", ""]
    alone = call("kin", "inverse", "X=-40", *options).stdout.splitlines()[1]
    axes = [[float(v) for v in line.split(",")[-6:-3]] for line in (lines[3], alone)]
    assert axes[0] == pytest.approx(axes[1])


def test_what_is_wrong_with_installed_classes_is_said_and_stops_no_others(monkeypatch):
    """Only warnings: this machine may not need them. Of two with one id neither is taken."""

    def sound(name: str, id: int) -> type:
        def same(self, program, *more):
            return program

        methods = {"__init__": lambda self, param, axis_names: None, "forward": same}
        return type(name, (), {"id": id, "inverse": same, **methods})

    classes = [sound("A", 500), sound("B", 600), sound("C", 600), sound("Low", 499), 5]
    points = [
        SimpleNamespace(name=f"e{i}", value="a", load=lambda c=c: c) for i, c in enumerate(classes)
    ]
    monkeypatch.setattr(user_kinematics.metadata, "entry_points", lambda group: points)
    lists, _ = ncscope.load_machine(LISTS)
    own, found = ncscope.with_user_kinematics(lists)
    assert sorted(own.kinematic_types) == [500]
    assert {(d.id, str(d.severity)) for d in found} == {("N4301", "warning")}
    said = [d.message for d in found]
    assert said[0] == "entry point e2: C is no kinematics: its id 600 is used by entry point e1: B"
    assert "e3: Low" in said[1] and "from 500 to 999" in said[1]
    assert said[2] == "entry point e4: 5 is no kinematics: it is no class"
