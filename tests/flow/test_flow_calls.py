"""Subprograms: local, global, returns, limits (TF5200 programming manual)."""

from __future__ import annotations

import numpy as np
import pytest
from test_flow_structured import go, ids, xs

import ncscope
from ncscope.execution import Options
from ncscope.loading import load_program, subprogram_loader
from ncscope.machine import Machine


def test_local_call_returns_to_the_next_line():
    text = "%L S\nX5\nM17\n%MAIN\nX1\nLL S\nX2\nM30\n"
    assert xs(text) == [1, 5, 2]


def test_subprograms_may_stand_behind_the_main_program():
    assert xs("X1\nLL S\nX2\nM30\n%L S\nX5\nM29\nX6\n") == [1, 5, 2]


def test_main_program_does_not_run_into_a_subprogram():
    result = go("X1\n%L S\nX5\nM17\n")
    assert result.acs[:, 0].tolist() == [1] and [i for i, _ in ids(result)] == ["21129"]


def test_words_before_a_call_run_first_and_behind_it_not():
    result = go("X1 LL S\nX2\nM30\n%L S\nX5\nM17\n")
    assert result.acs[:, 0].tolist() == [1, 5, 2]


def test_call_in_a_loop_and_return_from_a_loop():
    text = "$FOR P1=1,2,1\nLL S\n$ENDFOR\nM30\n%L S\n$WHILE 1\nXP1\nM17\n$ENDWHILE\n"
    assert xs(text) == [1, 2]


def test_modal_state_stays_after_a_call():
    assert xs("G90 X1\nLL S\nX1\nM30\n%L S\nG91\nM17\n") == [1, 2]


def test_local_variables_belong_to_a_level():
    text = (
        "#VAR\nV.L.A=1\n#ENDVAR\nLL S\nX[V.L.A]\nM30\n%L S\n#VAR\nV.L.A=5\n#ENDVAR\nX[V.L.A]\nM17\n"
    )
    assert xs(text) == [5, 1]
    assert xs(text.replace("#VAR\nV.L.A=5\n#ENDVAR\n", "")) == [1, 1]


def test_m30_in_a_subprogram():
    result = go("LL S\nX2\nM30\n%L S\nX5\nM30\n")
    assert ids(result) == [("20377", 6)] and result.ok
    assert result.acs[:, 0].tolist() == [5]


@pytest.mark.parametrize("code", ["M17", "M29"])
@pytest.mark.parametrize("flow", ["", "$IF 1\n$ENDIF\n"])
def test_return_in_the_main_program(code, flow):
    result = go(f"X1\n{code}\nX2\n{flow}M30\n")
    assert ids(result) == [("20376", 2)] and len(result) == 1


def test_recursion_ends_at_the_depth_limit():
    result = go("LL S\nM30\n%L S\nG91 X1\nLL S\nM17\n")
    assert ids(result) == [("20371", 5)] and len(result) == 20


def test_local_subprogram_that_is_missing():
    result = go("X1\nLL T\nM30\n%L S\nM17\n")
    assert ids(result) == [("20373", 2)] and "S" in result.diagnostics[0].message


def test_file_with_subprograms_only():
    assert ids(go("%L S\nX1\nM17\n"))[0] == ("20368", 1)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "job").mkdir()
    (tmp_path / "outside.nc").write_text("X99\nM17\n")
    (tmp_path / "job" / "sub.nc").write_text("\n\nX5\nLL OWN\nM17\n%L OWN\nX6\nM17\n")
    return tmp_path / "job"


def run_in(folder, text):
    (folder / "main.nc").write_text(text)
    options = Options(load=subprogram_loader([folder]))
    return ncscope.run(Machine(), load_program(folder / "main.nc"), options)


@pytest.mark.parametrize("name", ["sub.nc", '"sub.nc"', "./sub.nc", "../job/sub.nc"])
def test_global_call(folder, name):
    result = run_in(folder, f"X1\nL {name}\nX2\nM30\n")
    assert result.acs[:, 0].tolist() == [1, 5, 6, 2], result.diagnostics
    assert [s.file for s in result.stretches] == ["main.nc", "sub.nc", "main.nc"]
    assert result.line.tolist() == [1, 3, 7, 3]


def test_name_of_a_file_in_other_capitals(folder):
    """As on Windows, where the control runs; two files that differ in capitals only are none."""
    (folder / "Cycles").mkdir()
    (folder / "Cycles" / "Drill.NC").write_text("X7\nM17\n")
    for name in ("SUB.NC", "cycles/drill.nc", "CYCLES\\DRILL.nc"):
        result = run_in(folder, f"X1\nL {name}\nM30\n")
        assert result.ok and len(result) > 1, result.diagnostics
    (folder / "Sub.NC").write_text("X9\nM17\n")
    assert run_in(folder, "L Sub.NC\nM30\n").acs[0, 0] == 9
    assert ids(run_in(folder, "L SUB.nc\nM30\n")) == [("20369", 1)]
    assert ids(run_in(folder, "L ../OUTSIDE.nc\nM30\n")) == [("20369", 1)]


def test_explain_means_the_main_program(folder):
    result = run_in(folder, "X1\nL sub.nc\nX2\nM30\n")
    assert result.explain(line=3).layers[0].values[0] == 2
    assert np.all(result.acs[:, 1] == 0)


@pytest.mark.parametrize("name", ["../outside.nc", "none.nc", ".", "link.nc"])
def test_global_call_that_is_not_found_or_outside(folder, name):
    (folder / "link.nc").symlink_to(folder.parent / "outside.nc")
    result = run_in(folder, f"X1\nL {name}\nM30\n")
    assert ids(result) == [("20369", 2)] and len(result) == 1


def test_absolute_path_outside_is_refused(folder):
    result = run_in(folder, f"X1\nL {folder.parent / 'outside.nc'}\nM30\n")
    assert ids(result) == [("20369", 2)]


def test_structure_error_in_a_subprogram_file(folder):
    (folder / "bad.nc").write_text("X5\n$ENDIF\nM17\n")
    result = run_in(folder, "X1\nL bad.nc\nM30\n")
    assert ids(result) == [("20218", 2)] and result.diagnostics[0].file == "bad.nc"
    assert len(result) == 1


def test_without_a_loader_no_file_is_found():
    assert ids(go("L sub.nc\nM30\n")) == [("20369", 1)]


def test_command_line_finds_files_next_to_the_program(folder):
    from typer.testing import CliRunner

    from ncscope.cli import app

    (folder / "main.nc").write_text("L sub.nc\nM30\n")
    result = CliRunner().invoke(app, ["run", str(folder / "main.nc"), "--format", "jsonl"])
    assert result.exit_code == 0 and '"X":6.0' in result.stdout
