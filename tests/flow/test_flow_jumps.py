"""$GOTO with both label kinds, and #IF (TF5200 programming manual)."""

from __future__ import annotations

import pytest
from test_flow_structured import go, ids, xs


def test_jump_forward_to_a_number():
    assert xs("X1\n$GOTO N20\nX2\nN20: X3\nM30\n") == [1, 3]


def test_jump_to_a_name_whatever_its_case():
    assert xs("X1\n$GOTO [end]\nX2\n[END] X3\nM30\n") == [1, 3]


def test_jump_back_and_one_line_if():
    assert xs("P1=0\nN10: P1+=1\nXP1\n$IF P1 < 3 $GOTO N10\nX9\nM30\n") == [1, 2, 3, 9]


def test_words_of_the_block_run_before_its_jump():
    assert xs("X1 $GOTO N20\nX2\nN20: X3\nM30\n") == [1, 3]


def test_jump_to_a_computed_number():
    assert xs("P1=2\n$GOTO N[P1*10]\nX1\nN20: X3\nM30\n") == [3]


def test_label_in_a_comment_is_none():
    assert ids(go("$GOTO [A]\n; [A] X1\n([A])\nM30\n")) == [("20840", 1)]


def test_jump_out_of_loops_and_into_a_branch():
    text = "$FOR P1=1,5,1\nXP1\n$GOTO [IN]\n$ENDFOR\n$IF 0\n[IN] X7\n$ELSE\nX8\n$ENDIF\nM30\n"
    assert xs(text) == [1, 7]


def test_jump_inside_one_loop():
    assert xs("$FOR P1=1,2,1\n$GOTO [S]\nX9\n[S] XP1\n$ENDFOR\nM30\n") == [1, 2]


@pytest.mark.parametrize(
    "loop",
    [
        ("$WHILE 1", "$ENDWHILE"),
        ("$FOR P1=1,2,1", "$ENDFOR"),
        ("$DO", "$ENDDO 0"),
        ("$REPEAT", "$UNTIL 1"),
    ],
)
def test_jump_into_a_loop(loop):
    result = go(f"X1\n$GOTO [A]\n{loop[0]}\n[A] X2\n{loop[1]}\nM30\n")
    assert ids(result) == [("21480", 2)] and len(result) == 1
    assert result.diagnostics[0].notes[0][1].line == 3


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("X1\n$GOTO N20\nN20 X2\nM30\n", ("20840", 2)),
        ("X1\n[A] X2\n[A] X3\nM30\n$GOTO [A]\n", ("20836", 3)),
        ("X1 [A] X2\nM30\n", ("21187", 1)),
        ("X1 N20: X2\nM30\n", ("21187", 1)),
        ("[A] N20: X2\nM30\n", ("21187", 1)),
    ],
)
def test_labels_that_are_wrong(text, expected):
    assert ids(go(text)) == [expected]


def test_labels_belong_to_a_program_level():
    text = "%L S\n[A] X1\nM17\n%MAIN\n[A] X2\nLL S\nM30\n"
    assert xs(text) == [2, 1]
    result = go("%L S\n[B] X1\nM17\n%MAIN\n$GOTO [B]\nM30\n")
    assert ids(result) == [("20840", 5)]


def test_endless_jumps_are_named():
    result = go("N10: X1\n$GOTO N10\nM30\n", max_blocks=30)
    assert ids(result) == [("N4001", 1)] or ids(result) == [("N4001", 2)]
    assert "line 2 " in result.diagnostics[0].message


@pytest.mark.parametrize(("value", "x"), [("1", [1]), ("0", [2])])
def test_hash_if(value, x):
    assert xs(f"#IF {value}\nX1\n#ELSE\nX2\n#ENDIF\nM30\n") == x


def test_the_false_part_of_hash_if_is_not_checked():
    assert xs("#IF 0\nno nc text at all\n#ENDIF\nX1\nM30\n") == [1]


def test_hash_if_with_a_block_number():
    assert ids(go("X1\nN10 #IF 1\n#ENDIF\nM30\n")) == [("20593", 2)]
