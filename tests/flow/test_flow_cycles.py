"""Cycles, implicit calls, sequences, returns with brackets, macros as words.

Expected positions follow from the manual by hand: see the comment of each program.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from test_flow_structured import go, ids, xs

import ncscope
from ncscope.diagnostics import Source
from ncscope.execution import Options
from ncscope.machine import ChannelSettings, Machine

DRILL = "%L DRILL\nG91 Z-@P1\nZ@P1\nM17\n"


def positions(text, axis=0, machine=None, files=None, **options):
    def load(name):
        return Source(name, (files or {})[name]) if name in (files or {}) else None

    result = ncscope.run(machine or Machine(), text, Options(load=load, **options))
    assert result.ok, [ncscope.render(d) for d in result.diagnostics]
    return result.acs[:, axis].tolist()


def failing(text, machine=None, files=None):
    def load(name):
        return Source(name, files[name]) if files and name in files else None

    result = ncscope.run(machine or Machine(), text, Options(load=load))
    return [(d.id, d.line) for d in result.diagnostics if d.is_error]


def test_cycle_with_parameters():
    text = "X1\nLL CYCLE [NAME=S @P1=5 @P2=[2+1]]\nX2\nM30\n%L S\nX@P1\nX[@P1+@P2]\nM17\n"
    assert xs(text) == [1, 5, 8, 2]


def test_cycle_call_over_several_lines():
    text = "LL CYCLE [NAME=S \\\n@P1=5 \\\n; a remark \\\n@P2=3]\nX2\nM30\n%L S\nX[@P1+@P2]\nM17\n"
    assert xs(text) == [8, 2]


def test_cycle_restores_modal_functions_and_a_subprogram_does_not():
    """G91 and F in the cycle end with it: X2 is absolute again."""
    body = "\nX2\nM30\n%L S\nG91 G01 X5 F100\nM17\n"
    assert xs("G90 G01 F500 X1\nLL CYCLE [NAME=S]" + body) == [1, 6, 2]
    result = go("G90 G01 F500 X1\nLL CYCLE [NAME=S]" + body)
    assert result.feed.tolist() == [500, 100, 500]
    assert xs("G90 X1\nLL S" + body) == [1, 6, 8]


def test_cycle_restores_plane_zero_offset_and_mirror():
    text = "V.G.NP[1].V.X=100\nG54 X1\nLL CYCLE [NAME=S]\nX2\nM30\n%L S\nG18 G53 G22 X3\nM17\n"
    assert xs(text) == [101, -3, 102]


def test_reference_offset_of_a_cycle_stays():
    """G92 is bound to values: it is not restored."""
    assert xs("X1\nLL CYCLE [NAME=S]\nX2\nM30\n%L S\nG92 X10\nM17\n") == [1, 12]


def test_cycle_changes_stay_where_it_is_said():
    text = "G90 X1\nLL CYCLE [NAME=S]\nX2\nM30\n%L S\n{}G91 X5\nM17\n"
    assert xs(text.format("#RETAIN CYCLE CHANGES\n")) == [1, 6, 8]
    machine = Machine(settings=ChannelSettings(cycle_changes_stay=True))
    assert positions(text.format(""), machine=machine) == [1, 6, 8]


def test_cycle_axes_follow_the_plane():
    """G18: first main axis Z, second X."""
    text = "G18\nLL CYCLE [NAME=S]\nM30\n%L S\n@X5 @Y=6 @Z[7]\nM17\n"
    result = go(text)
    assert result.acs.tolist() == [[6, 7, 5]]


@pytest.mark.parametrize(
    ("block", "id"),
    [
        ("X@P1", "21382"),
        ("@P1=5", "21382"),
        ("P1=@P1", "21382"),
        ("#RETAIN CYCLE CHANGES", "21382"),
        ("@X5", "21383"),
        ("G02 X2 @I1", "21384"),
        ("@S=100", "21385"),
    ],
)
def test_cycle_words_outside_of_cycles(block, id):
    assert failing(f"X1\n{block}\nM30\n") == [(id, 2)]


def test_cycle_parameter_that_was_not_given():
    text = "LL CYCLE [NAME=S @P2=1]\nM30\n%L S\n$IF V.G.@P[1].VALID\nX9\n$ENDIF\nX@P2\nX@P1\nM17\n"
    result = go(text)
    assert result.acs[:, 0].tolist() == [1] and [i for i, _ in ids(result)] == ["20925"]
    assert failing("P1=V.G.@P[1].VALID\nM30\n") == [("21544", 1)]


def test_cycle_parameters_may_be_texts_and_be_written():
    text = 'LL CYCLE [NAME=S @P1="ab"]\nM30\n%L S\nXLEN[@P1]\n@P1=7\nX@P1\nX IS_STRING[@P1]\nM17\n'
    assert xs(text) == [2, 7, 0]


def test_nested_cycle_has_its_own_parameters():
    text = (
        "LL CYCLE [NAME=A @P1=1]\nM30\n%L A\nLL CYCLE [NAME=B @P1=2]\nX@P1\nLL C\nM17\n"
        "%L B\nX@P1\nM17\n%L C\nX[@P1+10]\nM17\n"
    )
    assert xs(text) == [2, 1, 11]


# --- modal cycles ------------------------------------------------------------------------------


def test_modal_cycle_runs_after_every_motion():
    """It runs at its call, after X20 and X30; M8 moves nothing; its own motions call nothing."""
    text = (
        "X10\nLL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\nX20\nM8\nX30\n"
        "#DISABLE MODAL CYCLE\nX40\nM30\n"
    )
    assert positions(text + DRILL, 2) == [0, -3, 0, 0, -3, 0, 0, -3, 0, 0]
    assert positions(text + DRILL, 0) == [10, 10, 10, 20, 20, 20, 30, 30, 30, 40]


def test_old_word_modal_is_modal_move():
    text = "LL CYCLE [NAME=DRILL MODAL @P1=3]\nX20\nM30\n"
    assert positions(text + DRILL, 2) == [-3, 0, 0, -3, 0]


def test_modal_block_runs_after_blocks_without_motion_too():
    text = "LL CYCLE [NAME=DRILL MODAL_BLOCK @P1=3]\nM8\n#DISABLE MODAL CYCLE\nM8\nM30\n"
    assert positions(text + DRILL, 2) == [-3, 0, -3, 0]


def test_modal_cycle_in_a_loop_and_before_a_return():
    text = (
        "LL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\n$FOR P1=1,2,1\nXP1\n$ENDFOR\nLL ROW\n"
        "#DISABLE MODAL CYCLE\nX0\nM30\n%L ROW\nX8\nX9 M17\n"
    )
    assert positions(text + DRILL, 0) == [0, 0, 1, 1, 1, 2, 2, 2, 8, 8, 8, 9, 9, 9, 0]


def test_modal_cycle_before_the_program_end():
    text = "LL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\nX5 M30\nX6\n"
    assert positions(text + DRILL, 0) == [0, 0, 5, 5, 5]


def test_modal_cycle_from_a_file_is_found_from_another():
    files = {"sub.nc": "X7\nM17\n"}
    text = "LL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\nL sub.nc\nM30\n"
    assert positions(text + DRILL, 2, files=files) == [-3, 0, 0, -3, 0]


def test_second_cycle_while_one_is_modal():
    text = "LL CYCLE [NAME=DRILL MODAL @P1=1]\nLL CYCLE [NAME=DRILL @P1=2]\nM30\n"
    assert failing(text + DRILL) == [("21381", 2)]


@pytest.mark.parametrize(
    ("arguments", "id"),
    [
        ("@P1=1", "N1005"),
        ("NAME=DRILL WRONG @P1=1", "N1005"),
        ("NAME=DRILL X=3", "N1005"),
        ("NAME=DRILL @P1=1 @P1=2", "21379"),
        ("NAME=DRILL NAME=DRILL @P1=1", "21379"),
        ("NAME=DRILL MODAL MODAL_BLOCK", "21379"),
    ],
)
def test_cycle_written_wrongly(arguments, id):
    assert [i for i, _ in failing(f"LL CYCLE [{arguments}]\nM30\n" + DRILL)] == [id]


def nested_macros(inner: str, between: str) -> str:
    """Macros A0 to A8; each text uses the macro before it eight times."""
    lines = [f'"A0" = "{inner}"']
    for i in range(1, 9):
        text = between.join([f'\\"A{i - 1}\\"'] * 8)
        lines.append(f'"A{i}" = "{text}"')
    return "\n".join(lines) + "\n"


def test_error_in_a_macro_shows_the_text_of_the_macro():
    """The marker stands under the use; the note has the innermost text, whatever is wrong."""
    for inner in ("X1 X2", "X[1/0]", "X1 Q"):
        result = go(f'"A" = "{inner}"\n"B" = "\\"A\\" Z1"\nX1\nN10 "B"\nM30\n')
        (error,) = result.diagnostics
        assert (error.line, error.column, error.span.text) == (4, 5, '"B"')
        assert [span.source.text for _, span in error.notes] == [inner]


def test_macros_of_macros_have_a_limit():
    """A4 is 8 ** 4 words; A8 would be 16 million."""
    result = go(nested_macros("P1=P1+1", " ") + 'P1=0\n"A4"\nXP1\n"A8"\nM30\n')
    assert result.acs[:, 0].tolist() == [4096] and ids(result) == [("20734", 13)]
    result = go(nested_macros("1", "+") + 'X"A4"\nX["A8"]\nM30\n')
    assert result.acs[:, 0].tolist() == [4096] and ids(result) == [("20734", 11)]
    result = go(nested_macros("1", "+") + 'V.P.T=MACRO_CONTENT["A8"]\nM30\n')
    assert ids(result) == [("22276", 10)]


@pytest.mark.parametrize(
    "block",
    [
        '$IF "C"\nX1\n$ENDIF',
        '$FOR P1="N","N",1\nX1\n$ENDFOR',
        '$GOTO N"N"\nX9\nN2: X1',
        '$SWITCH "N"\n$CASE "N"\nX1\n$ENDSWITCH',
        '#IF "C"\nX1\n#ENDIF',
        'P2="N" X[P2-1]',
        '$WHILE "C"\nX1\nP1=3\n$ENDWHILE',
        '$REPEAT\nX1\n$UNTIL "C"',
        'N"N" X["N"-1]',
    ],
)
def test_macro_that_stands_alone_for_a_number(block):
    text = f'"C" = "P1 < 3"\n"N" = "1+1"\nP1=0\n{block}\nX1\nM30\n'
    result = go(text)
    assert ids(result) == [] and set(result.acs[:, 0].tolist()) == {1}


def test_text_for_a_variable_of_texts_is_no_macro():
    text = '"N" = "1+1"\n#VAR\nV.P.T : STRING[9]\nV.P.R\n#ENDVAR\nV.P.T="N" V.P.R="N" V.P.NEW="N"\n'
    result = go(text + "XLEN[V.P.T] YV.P.R ZLEN[V.P.NEW]\nM30\n")
    assert result.acs.tolist() == [[1, 2, 1]]


def test_cycle_parameter_number():
    assert failing("LL CYCLE [NAME=DRILL @P201=1]\nM30\n" + DRILL) == [("20400", 1)]


# --- implicit calls ----------------------------------------------------------------------------

FILES = {"g82.nc": "X@P1\nG91 X@P2\nM17\n", "tool.nc": "G91 Z5\nM17\n", "start.nc": "X3\nM17\n"}
CALLS = Machine(settings=ChannelSettings(called_files={"G82": "g82.nc", "M6": "tool.nc"}))


def test_g82_with_values_is_a_cycle():
    """The motion of the block comes first; G91 of the cycle ends with it."""
    text = "G82 [4,[1+1]] X1\nX2\nM30\n"
    assert positions(text, machine=CALLS, files=FILES) == [1, 4, 6, 2]


def test_g80_without_values_is_a_subprogram():
    machine = Machine(settings=ChannelSettings(called_files={"G80": "tool.nc"}))
    assert positions("G80\nX1\nX1\nM30\n", machine=machine, files=FILES) == [0, 1, 2]


def test_file_name_sets_what_a_function_calls():
    text = "#FILE NAME [G839=g82.nc M6=tool.nc]\nG839 [7,1]\nM6\nZ1\nM30\n"
    assert positions(text, files=FILES) == [7, 8, 8, 8]
    assert positions(text, 2, files=FILES) == [0, 0, 5, 6]


def test_function_without_a_file():
    assert failing("G82 [1]\nM30\n") == [("20131", 1)]
    assert failing("G82 [1]\nM30\n", machine=CALLS, files={}) == [("20369", 1)]


def test_m6_runs_last_in_its_block_and_a_loop_may_call_it():
    flow = "$FOR P1=1,2,1\nG90 Z0 M6 XP1\n$ENDFOR\nM30\n"
    assert positions(flow, 2, machine=CALLS, files=FILES) == [0, 5, 0, 5]


def test_m6_without_a_file_is_noted():
    result = go("M6 X1\nM30\n")
    assert [d.id for d in result.diagnostics] == ["N2002"]


def test_start_and_end_programs():
    settings = ChannelSettings(start_file="start.nc", end_file="tool.nc")
    text = "X1\nM30\n"
    assert positions(text, machine=Machine(settings=settings), files=FILES) == [3, 1, 1]
    assert positions("$IF 1\n$ENDIF\n" + text, 0, Machine(settings=settings), FILES) == [3, 1, 1]
    assert failing(text, machine=Machine(settings=settings), files={}) == [("20369", 1)]


# --- sequences, returns, labels ----------------------------------------------------------------


def test_sequence_of_block_numbers():
    text = "N10 X1\nN20 X2\nN30 X3\nN40 L SEQUENCE [N20 N30]\nN50 X5\nM30\n"
    assert xs(text) == [1, 2, 3, 2, 3, 5]


def test_sequence_of_one_block_repeated():
    assert xs("N10 G91 X1\nL SEQUENCE [N10 N10 REPEAT=3]\nM30\n") == [1, 2, 3, 4]
    assert xs("N10 G91 X1\nL SEQUENCE [N10]\nM30\n") == [1, 2]


def test_sequence_of_labels_in_a_file_and_endtag():
    files = {"part.nc": "X1\n[A] X2\nX3\n[B] X4\nX5\nM17\n"}
    assert positions("L SEQUENCE [NAME=part.nc [A] [B]]\nM30\n", files=files) == [2, 3, 4]
    assert xs("[A] X1\nX2\nL SEQUENCE [[A] ENDTAG]\nX3\nM30\n") == [1, 2, 1, 2, 3]


def test_sequence_that_is_wrong():
    assert failing("N10 X1\nL SEQUENCE [N15]\nM30\n") == [("20840", 2)]
    assert failing("N10 X1\nN20 X2\nL SEQUENCE [N20 N10]\nM30\n") == [("N1005", 3)]
    assert failing("N10 X1\nL SEQUENCE [REPEAT=2]\nM30\n") == [("N1005", 2)]


CALLED = "%L A\nLL B\nX2\nM17\n%L B\nX3\n{}\nX4\nM17\n"


@pytest.mark.parametrize(
    ("order", "expected"),
    [
        ("M17", [3, 2, 1]),
        ("M17 [MAIN]", [3, 1]),
        ("M17 [JUMPS=2]", [3, 1]),
        ("M29 [MAIN] [END]", [3, 9]),
        ("M17 [JUMPS=2] N90", [3, 9]),
    ],
)
def test_return_with_brackets(order, expected):
    text = "LL A\nX1\n$GOTO N99\n[END] N1\nN90: X9\nN99: M30\n" + CALLED.format(order)
    assert xs(text.replace("[END] N1\n", "[END]\n")) == expected


def test_return_over_too_many_levels():
    text = "LL A\nM30\n" + CALLED.format("M17 [JUMPS=3]")
    assert [i for i, _ in failing(text)] == ["N1005"]


def test_computed_label():
    text = "P1=3\n$GOTO N[P1*10]\nX1\nN[P1*5+15]: X2\nM30\n"
    assert xs(text) == [2]


def test_local_variables_are_seen_below_and_hidden():
    text = (
        "#VAR\nV.L.A=1\n#ENDVAR\nLL S\nX[V.L.A]\nM30\n"
        "%L S\nX[V.L.A]\nV.L.A=2\n#VAR\nV.L.A=5\n#ENDVAR\nX[V.L.A]\nM17\n"
    )
    assert xs(text) == [1, 5, 2]


# --- macros ------------------------------------------------------------------------------------


def test_macros_as_words():
    text = '"A" = "X5 Y[P1*2]" P1=4\n"B" = "G91 \\"A\\""\n"A"\n"B"\nM30\n'
    assert go(text).acs[:, :2].tolist() == [[5, 8], [10, 16]]


def test_macro_names_a_subprogram_and_holds_a_call():
    text = '"N" = "S"\nLL "N"\n"C" = "LL S"\nX1 "C"\nM30\n%L S\nX7\nM17\n'
    assert xs(text) == [7, 1, 7]


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ('"A"\nM30\n', "20619"),
        ('"A" = "\\"A\\""\n"A"\nM30\n', "20734"),
        ('"A" = "$IF 1"\n"A"\nM30\n', "20644"),
        ('"A" = "N10 X1"\n"A"\nM30\n', "20644"),
        ('"A" = "X["\n"A"\nM30\n', "20392"),
        ('"A" = "X1"\n#INIT MACRO TAB\n"A"\nM30\n', "20619"),
    ],
)
def test_macro_that_is_wrong(text, id):
    assert [i for i, _ in failing(text)] == [id]


def test_name_from_an_external_variable():
    files = {"a.nc": "X5\nM17\n"}
    assert positions("L V.E.NAME\nM30\n", files=files, external={"V.E.NAME": "a.nc"}) == [5]


@pytest.mark.parametrize("line", ["; costs 5$ at L 3", "(LL A $IF)", '#MSG ["$5 L 1"]'])
def test_marks_in_comments_and_texts_do_not_count(line):
    from ncscope.language.detection import needs_layout

    assert not needs_layout(Source("p", f"X1\n{line}\nX2 ; L x\nM30\n"))
    assert needs_layout(Source("p", f"X1\n{line}\nX2 (remark) L x\nM30\n"))
    assert needs_layout(Source("p", f"{line}\n$IF 1\n"))


def test_settings_of_the_channel_list(tmp_path):
    (tmp_path / "sda.lis").write_text(
        "m6_prog_file tool.nc\ng82_prog_file g82.nc\ng800_prog_file[39] g839.nc\n"
        "start_init_prog_file start.nc\nfinal_prog_file end.nc\ncycle_changes_modal 1\n"
        "path[0].dir low\npath[0].type 0x03\npath[0].priority 2\n"
        "path[1].dir main\npath[1].type 0x01\npath[2].dir high\npath[2].type 2\n"
        "path[2].priority 1\nEnde\n"
    )
    machine, found = ncscope.load_machine(tmp_path)
    assert not found
    expected = ChannelSettings(
        cycle_changes_stay=True,
        start_file="start.nc",
        end_file="end.nc",
        called_files={"M6": "tool.nc", "G82": "g82.nc", "G839": "g839.nc"},
        search_paths=("high", "low"),
    )
    assert machine.settings == replace(expected)


def test_search_paths_stay_inside_the_folders(tmp_path):
    from ncscope.loading import subprogram_loader

    (tmp_path / "job" / "subs").mkdir(parents=True)
    (tmp_path / "out").mkdir()
    for folder in ("job/subs", "out"):
        (tmp_path / folder / "s.nc").write_text("X1\n")
    load = subprogram_loader([tmp_path / "job"], ["subs", str(tmp_path / "out"), "../out"])
    assert load("s.nc").name == "subs/s.nc"
    assert subprogram_loader([tmp_path / "job"], [str(tmp_path / "out"), "../out"])("s.nc") is None
