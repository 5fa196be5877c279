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
        ("V.P.A : SGN08", "V.P.A=128", "20847"),
        ("V.P.A : UNS16", "V.P.A=-1", "20847"),
        ("V.P.A : UNS08 = 256", "", "20847"),
        ("V.P.A : SGN32", 'V.P.A="x"', "20392"),
        ("V.P.A : STRING[3]", "V.P.A=5", "20392"),
        ("V.P.A : STRING[3]", 'V.P.A="abcd"', "21462"),
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
        ("V.E.COUNT=40000", "20847"),
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


def set_values(tmp_path, program, *values, machine=True):
    """Exit code, axis positions of the last move and the text of `run` with values of --set."""
    (tmp_path / "main.nc").write_text(program + "\nM30\n")
    (tmp_path / "ext_var1.lis").write_text(
        "var[0].name COUNT\nvar[0].type SGN16\nvar[1].name TABLE\nvar[1].type REAL64\n"
        "var[1].array_elements 4\nvar[2].name PART\nvar[2].type STRING\nvar[2].size 11\n"
        "var[3].name NAMES\nvar[3].type STRING\nvar[3].array_elements 2\n"
        "var[4].name READY\nvar[4].type BOOLEAN\nEnde\n"
    )
    arguments = [str(tmp_path / "main.nc"), "--format", "jsonl"]
    arguments += ["--machine", str(tmp_path)] if machine else []
    for value in values:
        arguments += ["--set", value]
    result = CliRunner().invoke(app, ["run", *arguments])
    moves = [json.loads(line) for line in result.stdout.splitlines() if '"move"' in line]
    return result.exit_code, list(moves[-1]["acs"].values()) if moves else None, result.output


@pytest.mark.parametrize(
    ("program", "values", "xyz"),
    [
        ("X=V.E.TABLE[0] Y=V.E.TABLE[3]", ["V.E.TABLE=[1, 2.5,3,4]"], [1, 4, 0]),
        ("X=V.E.TABLE[1] Y=V.E.TABLE[2]", ["V.E.TABLE=[1,2]", "V.E.TABLE[2]=7"], [2, 7, 0]),
        ("X=V.E.COUNT", ["V.E.COUNT=2.6"], [3, 0, 0]),
        ("X=V.E.READY", ["V.E.READY=true"], [1, 0, 0]),
        ("X=V.E.READY", ["V.E.READY=7"], [1, 0, 0]),
        ("XLEN[V.E.PART]", ["V.E.PART=007"], [3, 0, 0]),
        ("XLEN[V.E.PART]", ['V.E.PART="a b"'], [3, 0, 0]),
        ("XLEN[V.E.PART]", ["V.E.PART=[1,2]"], [5, 0, 0]),
        ("XLEN[V.E.NAMES[0]] YLEN[V.E.NAMES[1]]", ['V.E.NAMES=["a,b",5]'], [3, 1, 0]),
    ],
)
def test_set_gives_values_of_the_declared_type(tmp_path, program, values, xyz):
    code, position, _ = set_values(tmp_path, program, *values)
    assert (code, position) == (0, xyz)


def test_set_declares_where_no_list_does(tmp_path):
    program = "X=V.E.A[1] YLEN[V.E.B[0]] Z=SIZEOF[V.E.A]"
    values = ("V.E.A=[1,2,3]", 'V.E.B=["abcd"]')
    assert set_values(tmp_path, program, *values, machine=False)[:2] == (0, [2, 4, 3])


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("V.E.COUNT=abc", "SGN16"),
        ("V.E.COUNT=40000", "-32768 to 32767"),
        ("V.E.COUNT=[1,2]", "no array"),
        ("V.E.TABLE=5", "V.E.TABLE[0]=.."),
        ("V.E.TABLE=[1,2,3,4,5]", "0 to 3"),
        ("V.E.TABLE[4]=1", "0 to 3"),
        ("V.E.TABLE[1]=[1,2]", "one value"),
        ("V.E.TABLE=[1,,2]", "commas"),
        ("V.E.TABLE=[]", "commas"),
        ("V.E.PART=twelve_chars", "10 characters"),
        ("V.E.COUTN=5", "V.E.COUNT was probably meant"),
        ("V.E.count=5", "V.E.COUNT was probably meant"),
    ],
)
def test_set_that_does_not_fit_says_what_would(tmp_path, value, said):
    code, position, output = set_values(tmp_path, "X1", value)
    assert code == 2 and position is None and "Traceback" not in output
    assert said in " ".join(output.split())


@pytest.mark.parametrize("value", ["V.E.A[0]=5", 'V.E.A=[1,"x"]', "V.E.A[0=5"])
def test_set_without_a_list_that_cannot_declare(tmp_path, value):
    assert set_values(tmp_path, "X1", value, machine=False)[0] == 2


def test_label_of_a_jump_from_an_external_variable(tmp_path):
    program = "$GOTO V.E.PART\nX1\n[AB] X2\n$GOTO [END]\nN40: X3\n[END] Y1"
    for label, x in (("AB", 2), ("[ab]", 2), ("N40", 3)):
        assert set_values(tmp_path, program, f"V.E.PART={label}")[:2] == (0, [x, 1, 0])
    assert set_values(tmp_path, program, "V.E.PART=NONE")[0] == 1


def test_exist_does_not_read(tmp_path):
    """A variable that a program may only write exists as well."""
    assert run("X=EXIST[V.E.ORDER] Y=EXIST[V.E.NAMES[1]] Z=EXIST[V.E.NAMES[2]]").acs[
        0
    ].tolist() == [1, 1, 0]


def test_text_does_not_grow_without_end():
    """20 characters are 2560 after seven doublings; the eighth would make 5120."""
    text = 'V.P.A="01234567890123456789"\n$WHILE 1\nX[LEN[V.P.A]]\nV.P.A=V.P.A+V.P.A\n$ENDWHILE\n'
    result = go(text, max_blocks=1000)
    assert result.acs[:, 0].tolist() == [20 * 2**n for n in range(8)]
    assert ids(result) == [("N1008", 4)]
