"""`ncscope convert` as a user types it."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

import ncscope
from ncscope.cli import app

MACHINES = Path(__file__).parents[2] / "examples" / "machines"
KIN9 = """# head of the workshop
kinematik[9].param[0] 250000
kinematik[9].param[1] 700000
kinematik[9].param[4] 30000
kinematik[9].param[5] 7000
kinematik[9].param[6] 61000
kinematik[9].param[7] 195000
kinematik[9].param[8] 560000
"""


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def call(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(app, ["convert", *(str(a) for a in arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_there_and_back_on_files() -> None:
    source = MACHINES / "cardanic_table" / "sda.lis"
    assert call(source, "--to", "v3", "--out", "new.lis").exit_code == 0
    assert b"trafo[0].id 91" in Path("new.lis").read_bytes()
    assert call("new.lis", "--to", "v2", "--out", "old.lis").exit_code == 0
    assert Path("old.lis").read_bytes() == source.read_bytes()


def test_a_library_head_moves_as_the_example_of_the_document() -> None:
    Path("params.lis").write_text(KIN9)
    result = call("params.lis", "--kin", "9")
    assert result.exit_code == 0
    channel = (MACHINES / "kin9_head" / "sda.lis").read_text()
    axes = "".join(line + "\n" for line in channel.splitlines() if line.startswith("gruppe"))
    Path("sda.lis").write_text(axes + result.stdout)
    machine, found = ncscope.load_machine("sda.lis")
    assert not [d for d in found if d.severity != "note"]
    printed, _ = ncscope.load_machine(MACHINES / "kin9_head")
    row = [10, 20, -30, 40, 50]
    wanted = printed.kinematics[91].inverse(row, 80.0)
    assert machine.kinematics[91].inverse(row, 80.0) == pytest.approx(wanted)
    old = call("params.lis", "--kin", "9", "--to", "v2").stdout
    assert "kinematik[91].zero_position[0]" in old and "trafo" not in old


@pytest.mark.parametrize(
    ("text", "id", "said"),
    [
        (KIN9, "33", "does not say in which plane the head is inclined"),
        (KIN9, "22", "has no parameters of kinematics 22"),
        (KIN9 + "kinematik[9].param[2] 100\n", "9", "p.lis:9:23: error N3502: HD3 is 100"),
        ("trafo[0].id 60\ntrafo[0].param[0] 5\n", "60", "HD7 is 0 degrees"),
    ],
)
def test_what_a_library_head_lacks_is_named(text: str, id: str, said: str) -> None:
    Path("p.lis").write_text(text)
    result = call("p.lis", "--kin", id, "--out", "o.lis")
    assert result.exit_code == 1
    assert said in " ".join(result.stderr.split())
    assert not Path("o.lis").exists()


@pytest.mark.parametrize(
    ("id", "reason", "help"),
    [
        (58, "FCT-C27 4.1.2 describes it", "describe its axes instead"),
        (11, "inclined by 45 degrees", "describe its axes instead"),
        (45, "has no three linear axes", "a Python class of your own"),
        (19, "three struts", "a Python class of your own"),
        (70, "no public table of its parameters is known", "describe its axes instead"),
    ],
)
def test_types_that_cannot_be_founded_are_refused(id: int, reason: str, help: str) -> None:
    Path("p.lis").write_text(f"kinematik[{id}].param[0] 5\n")
    result = call("p.lis", "--kin", str(id))
    said = " ".join(result.stderr.split())
    assert result.exit_code == 1 and result.stdout == ""
    assert "N3502" in said and reason in said and help in said


def test_a_type_counts_before_the_id() -> None:
    """P-CHAN-00829: several data sets of one type lie under different ids."""
    Path("p.lis").write_text("trafo[0].id 12\ntrafo[0].type 9\ntrafo[0].param[0] 77\n")
    assert "trafo[0].zero_position[2]        -77\n" in call("p.lis", "--kin", "9").stdout
    Path("p.lis").write_text("trafo[0].id 9\ntrafo[0].type 22\ntrafo[0].param[0] 77\n")
    assert "no parameters of kinematics 9" in call("p.lis", "--kin", "9").stderr


def test_capitals_become_the_spelling_of_the_control() -> None:
    Path("a.lis").write_bytes(b"Kinematik[91].rtcp 1 # \xfc\r\nkinematik[91].chain[0] 0\r\n")
    call("a.lis", "--to", "v3", "--out", "b.lis")
    assert b"\r\ntrafo[0].rtcp 1 # \xfc\r\n" in b"\r\n" + Path("b.lis").read_bytes()
    call("b.lis", "--to", "v2", "--out", "c.lis")
    assert Path("c.lis").read_bytes() == Path("a.lis").read_bytes().replace(b"K", b"k")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([".", "--to", "v3"], "is a folder; give one of its lists"),
        (["no.lis", "--to", "v3"], "there is no list no.lis"),
        (["."], "what to?"),
        ([".", "--fields", "--param"], "are opposites"),
        ([".", "--kin", "9", "--param"], "use --param on its result"),
    ],
)
def test_wrong_usage_is_said(arguments: list[str], said: str) -> None:
    result = call(*arguments)
    assert result.exit_code == 2
    assert said in result.stderr


def test_a_list_without_kinematics_comes_back_unchanged() -> None:
    Path("a.lis").write_bytes(b"\xe4 # x\r\nfoo 1")
    result = call("a.lis", "--to", "v3", "--fields", "--out", "b.lis")
    assert Path("b.lis").read_bytes() == b"\xe4 # x\r\nfoo 1"
    assert "there was nothing to convert" in result.stderr
