"""Life times, types and ranges of variables; V.E from a list and from the command line."""

from __future__ import annotations

import json

import pytest
from test_flow_structured import go, ids, xs
from typer.testing import CliRunner

import ncscope
from ncscope.cli import app
from ncscope.execution import Options
from ncscope.machine import ExternalVariable, Machine

DECLARED = "#VAR\n{}\n#ENDVAR\n{}\nM30\n"


@pytest.mark.parametrize(
    ("declaration", "block", "x"),
    [
        ("V.P.A : SGN08", "V.P.A=2.5 X=V.P.A", 3),
        ("V.P.A : SGN08 = -128", "X=V.P.A", -128),
        ("V.P.A : UNS32", "V.P.A=4294967295 X[V.P.A-4294967290]", 5),
        ("V.P.A : BOOLEAN", "V.P.A=7 X=V.P.A", 1),
        ("V.P.A : BOOLEAN = TRUE", "V.P.A=0.4 X=V.P.A", 0),
        ("V.P.A : REAL", "V.P.A=2.5 X=V.P.A", 2.5),
        ('V.P.A : STRING[4] = "abcd"', "XLEN[V.P.A]", 4),
        ("V.P.A[2][3] : UNS08 = [1,2,3,4,5,6]", "X=V.P.A[1][2]", 6),
        ("V.S.A[2] = [7]", "X[V.S.A[0]+V.S.A[1]]", 7),
        ("P5[2][2] = [[1,2],[3,4]]", "XP5[1][0]", 3),
    ],
)
def test_declared_variable(declaration, block, x):
    assert xs(DECLARED.format(declaration, block)) == [x]


@pytest.mark.parametrize(
    ("declaration", "block", "id"),
    [
        ("V.P.A : SGN08", "V.P.A=128", "21883"),
        ("V.P.A : UNS16", "V.P.A=-1", "21883"),
        ("V.P.A : UNS08 = 256", "", "21883"),
        ("V.P.A : SGN32", 'V.P.A="x"', "20392"),
        ("V.P.A : STRING[3]", "V.P.A=5", "20392"),
        ("V.P.A : STRING[3]", 'V.P.A="abcd"', "N1008"),
        ("V.P.A : STRING[127]", "", "20906"),
        ("V.P.A[1][1][1][1][1]", "", "20974"),
        ("V.P.A[0]", "", "20906"),
        ("V.P.A[2] = [1,2,3]", "", "20912"),
        ("V.P.A\nV.P.A", "", "20909"),
        ("V.E.A", "", "20908"),
        ("V.G.A", "", "20908"),
        ("V.P.A[2]", "X=V.P.A[2]", "20906"),
        ("V.P.A[2]", "X=V.P.A", "21216"),
        ("V.P.A[2]", "X=V.P.A[0][0]", "20924"),
        ("V.P.A : WRONG", "", "N1005"),
    ],
)
def test_declaration_or_value_that_is_wrong(declaration, block, id):
    found = ids(go(DECLARED.format(declaration, block)))
    assert found and found[0][0] == id


def test_level_variables_end_with_their_level():
    text = "LL S\nX=V.CYC.A\nM30\n%L S\n#VAR\nV.CYC.A = 4\n#ENDVAR\nX=V.CYC.A\nM17\n"
    result = go(text)
    assert result.acs[:, 0].tolist() == [4] and [i for i, _ in ids(result)] == ["20932"]


def test_deleted_variable_shows_the_one_it_hid():
    text = (
        "#VAR\nV.L.A=1\n#ENDVAR\nLL S\nM30\n%L S\n#VAR\nV.L.A=2\n#ENDVAR\nX=V.L.A\n"
        "#DELETE V.L.A\nX=V.L.A\nM17\n"
    )
    assert xs(text) == [2, 1]


@pytest.mark.parametrize("name", ["V.SPDL.X", "V.TOOL.A", "V.TLM.A", "V.SPDL_PROG.S"])
def test_groups_that_are_refused(name):
    result = go(f"P1={name}\nM30\n")
    assert ids(result) == [("N2001", 1)] and name in result.diagnostics[0].message


# --- external variables ------------------------------------------------------------------------

PLC = Machine(
    external={
        "COUNT": ExternalVariable("SGN16"),
        "NAMES": ExternalVariable("STRING", 2, 8),
        "STATE": ExternalVariable("REAL64", access="READ_ONLY"),
        "ORDER": ExternalVariable("REAL64", access="WRITE_ONLY"),
    }
)


def run(text, **values):
    external = {f"V.E.{name}": value for name, value in values.items()}
    return ncscope.run(PLC, text + "\nM30\n", Options(external=external))


def test_declared_external_variables_start_empty():
    assert run("X=V.E.COUNT YLEN[V.E.NAMES[1]]").acs[0].tolist() == [0, 0, 0]
    assert run("X=V.E.COUNT", COUNT=3.0).acs[0, 0] == 3
    assert run("V.E.COUNT=V.E.COUNT*2 X=V.E.COUNT", COUNT=3.0).acs[0, 0] == 6


@pytest.mark.parametrize(
    ("block", "id"),
    [
        ("V.E.STATE=1", "20100"),
        ("X=V.E.ORDER", "20097"),
        ("V.E.COUNT=40000", "21883"),
        ("X=V.E.NOBODY", "20932"),
        ("V.E.NOBODY=1", "20932"),
        ("#DELETE V.E.COUNT", "20908"),
    ],
)
def test_external_variable_that_is_wrong(block, id):
    assert [i for i, _ in ids(run(block))] == [id]


@pytest.mark.parametrize(
    "values",
    [{"COUNT": "x"}, {"NAMES": "x"}, {"NAMES[2]": "x"}, {"COUNT[0]": 1.0}, {"NEW[0]": 1.0}],
)
def test_value_that_does_not_fit_is_an_exception(values):
    with pytest.raises(KeyError):
        run("X1", **values)


def test_list_of_external_variables(tmp_path):
    (tmp_path / "ext_var1.lis").write_text(
        "number_used_variables 3\nvar[0].name COUNT (parts)\nvar[0].type SGN32\n"
        "var[0].access_rights READ_ONLY\nvar[1].name TABLE\nvar[1].type REAL64\n"
        "var[1].array_size 4\nvar[2].name PART\nvar[2].type VSTRING\nvar[2].size 11\n"
        "var[3].name BAD\nvar[3].type NONSENSE\nEnde\n"
    )
    machine, found = ncscope.load_machine(tmp_path)
    assert machine.external == {
        "COUNT": ExternalVariable("SGN32", access="READ_ONLY", length=127),
        "TABLE": ExternalVariable("REAL64", 4, length=127),
        "PART": ExternalVariable("STRING", length=10),
        "BAD": ExternalVariable("REAL64", length=127),
    }
    assert [(d.id, d.line) for d in found if d.severity == "warning"] == [("110552", 12)]


def test_values_from_the_command_line(tmp_path):
    program = tmp_path / "main.nc"
    program.write_text('$IF V.E.PART == "LONG"\nX=V.E.LENGTH\n$ENDIF\nM30\n')
    arguments = [str(program), "--set", "V.E.PART=LONG", "--set", "V.E.LENGTH=12.5"]
    result = CliRunner().invoke(app, ["run", *arguments, "--format", "jsonl"])
    assert json.loads(result.stdout.splitlines()[0])["acs"]["X"] == 12.5
    assert CliRunner().invoke(app, ["check", *arguments]).exit_code == 0
    place = [f"{program}:2", *arguments[1:]]
    assert CliRunner().invoke(app, ["explain", *place]).exit_code == 0
    for wrong in ("LENGTH=1", "V.E.LENGTH", "V.E.A[3]=1"):
        result = CliRunner().invoke(app, ["run", str(program), "--set", wrong])
        assert result.exit_code == 2 and "--set" in result.output


def test_text_does_not_grow_without_end():
    """20 characters are 2560 after seven doublings; the eighth would make 5120."""
    text = 'V.P.A="01234567890123456789"\n$WHILE 1\nX[LEN[V.P.A]]\nV.P.A=V.P.A+V.P.A\n$ENDWHILE\n'
    result = go(text, max_blocks=1000)
    assert result.acs[:, 0].tolist() == [20 * 2**n for n in range(8)]
    assert ids(result) == [("N1008", 4)]
