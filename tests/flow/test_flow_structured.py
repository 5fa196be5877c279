"""Control statements and loops (TF5200 programming manual): X positions worked out by hand."""

from __future__ import annotations

import pytest

import ncscope
from ncscope.diagnostics import Source
from ncscope.execution import Options
from ncscope.machine import Machine


def go(text: str, **options) -> ncscope.Trajectory:
    return ncscope.run(Machine(), text, Options(**options))


def xs(text: str, **options) -> list[float]:
    return go(text, **options).acs[:, 0].tolist()


def ids(result: ncscope.Trajectory) -> list[tuple[str, int | None]]:
    return [(d.id, d.line) for d in result.diagnostics if d.severity != "note"]


IF = "P1={}\n$IF P1 == 1\nX1\n$ELSEIF P1 == 2\nX2\n$ELSE\nX3\n$ENDIF\nX9\nM30\n"


@pytest.mark.parametrize(("value", "x"), [(1, 1), (2, 2), (7, 3)])
def test_if_takes_one_branch(value, x):
    assert xs(IF.format(value)) == [x, 9]


@pytest.mark.parametrize(("value", "taken"), [("0.5", 1), ("-0.5", 1), ("0.49", 0), ("-1", 1)])
def test_truth_begins_at_one_half(value, taken):
    assert xs(f"$IF {value}\nX1\n$ENDIF\nM30\n") == [1] * taken


def test_if_inside_a_skipped_branch_is_skipped():
    text = "$IF 0\n$IF 1\nX1\n$ELSE\nX2\n$ENDIF\n$ELSE\nX3\n$ENDIF\nM30\n"
    assert xs(text) == [3]


@pytest.mark.parametrize(
    ("value", "x"), [("1", [1]), ("2", [2, 3]), ("3", [3]), ("4", [4]), ("1.0009", [1])]
)
def test_switch(value, x):
    text = (
        f"$SWITCH {value}\n$CASE 1\nX1\n$BREAK\n$CASE 2\nX2\n$CASE 3\nX3\n$BREAK\n"
        "$DEFAULT\nX4\n$ENDSWITCH\nM30\n"
    )
    assert xs(text) == x


def test_switch_with_an_assignment():
    assert xs("$SWITCH P1=1+1\n$CASE 2\nXP1\n$ENDSWITCH\nM30\n") == [2]


def test_for_counts_up_and_leaves_the_first_value_beyond():
    assert xs("$FOR P1 = 1, 3, 1\nXP1\n$ENDFOR\nX[P1*10]\nM30\n") == [1, 2, 3, 40]


def test_for_counts_down():
    assert xs("$FOR V.P.I = 4, 1, -2\nX[V.P.I]\n$ENDFOR\nM30\n") == [4, 2]


def test_for_that_never_begins():
    assert xs("$FOR P1 = 2, 1, 1\nXP1\n$ENDFOR\nX9\nM30\n") == [9]


def test_while_tests_first():
    assert xs("P1=0\n$WHILE P1 < 2\nP1+=1\nXP1\n$ENDWHILE\n$WHILE 0\nX9\n$ENDWHILE\nM30\n") == [
        1,
        2,
    ]


def test_do_and_repeat_test_last():
    assert xs("P1=5\n$DO\nP1+=1\nXP1\n$ENDDO P1 < 7\nM30\n") == [6, 7]
    assert xs("P1=5\n$REPEAT\nP1+=1\nXP1\n$UNTIL P1 >= 7\nM30\n") == [6, 7]
    assert xs("$DO\nX1\n$ENDDO 0\n$REPEAT\nX2\n$UNTIL 1\nM30\n") == [1, 2]


def test_break_and_continue():
    text = (
        "$FOR P1 = 1, 9, 1\n$IF P1 == 2\n$CONTINUE\n$ENDIF\n$IF P1 == 4\n$BREAK\n$ENDIF\n"
        "XP1\n$ENDFOR\nX[P1*10]\nM30\n"
    )
    assert xs(text) == [1, 3, 40]


@pytest.mark.parametrize(
    "loop",
    ["$WHILE P1 < 3\n{}$ENDWHILE\n", "$DO\n{}$ENDDO P1 < 3\n", "$REPEAT\n{}$UNTIL P1 >= 3\n"],
)
def test_continue_goes_to_the_test(loop):
    assert xs("P1=0\n" + loop.format("P1+=1\nXP1\n$CONTINUE\nX99\n") + "M30\n") == [1, 2, 3]


def test_break_in_a_switch_stays_in_the_loop():
    text = "$FOR P1 = 1, 2, 1\n$SWITCH P1\n$CASE 1\n$BREAK\n$ENDSWITCH\nXP1\n$ENDFOR\nM30\n"
    assert xs(text) == [1, 2]


def test_nested_loops():
    text = "$FOR P1=1,2,1\n$FOR P2=1,2,1\nX[10*P1+P2]\n$ENDFOR\n$ENDFOR\nM30\n"
    assert xs(text) == [11, 12, 21, 22]


def test_skipped_blocks_are_no_part_of_the_structure():
    text = "/1 $IF 0\nX1\n/1 $ENDIF\nM30\n"
    assert xs(text) == [] and xs(text, skip=frozenset([1])) == [1]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("X1\n$ENDIF\nM30\n", ("20218", 2)),
        ("X1\n$ELSE\nM30\n", ("20214", 2)),
        ("X1\n$FOR P1=1,2,1\n$ENDWHILE\nM30\n", ("20237", 3)),
        ("$IF 1\n$ELSE\n$ELSE\n$ENDIF\nM30\n", ("20214", 3)),
        ("X1\n$BREAK\nM30\n", ("20243", 2)),
        ("X1\n$SWITCH 1\n$CONTINUE\n$ENDSWITCH\nM30\n", ("20244", 3)),
        ("X1\n$UNTIL 1\nM30\n", ("N1007", 2)),
    ],
)
def test_structure_errors_come_before_any_motion(text, expected):
    result = go(text)
    assert ids(result)[:1] == [expected] and not result.ok
    assert len(result) == 0


def test_open_block_that_ran_is_a_warning():
    result = go("$IF 1\nX1\nM30\n")
    assert ids(result) == [("20375", 1)] and result.ok and len(result) == 1
    assert ids(go("X1\n$WHILE 1\nX2\nM30\n")) == [("20375", 2)]


OPENINGS = ["$IF 0", "$SWITCH 1\n$CASE 2", "$WHILE 0", "$FOR P1=2,1,1"]


@pytest.mark.parametrize("opening", OPENINGS)
def test_open_block_that_was_skipped_is_an_error(opening):
    """The number says where it is open: 21500 local subprogram, 21501 main, 21502 file."""
    result = go(f"X1\n{opening}\nX2\nM30\n")
    assert ids(result) == [("21501", 2)] and not result.ok and len(result) == 1
    result = go(f"%L S\n{opening}\nX2\nM17\n%M\nX1\nLL S\nX3\nM30\n")
    assert ids(result) == [("21500", 2)] and not result.ok and len(result) == 1
    file = Source("s.nc", f"{opening}\nX2\nM17\n")
    result = go("X1\nL s.nc\nX3\nM30\n", load=lambda name: file)
    assert ids(result) == [("21502", 1)] and result.diagnostics[0].file == "s.nc"


def test_open_block_of_a_subprogram_that_ran_is_said_once():
    text = "%L S\n$IF 1\nX2\nM17\n%M\nLL S\nLL S\nM30\n"
    result = go(text)
    assert ids(result) == [("20375", 2)] and result.ok and len(result) == 2


def test_endless_for_warns_and_ends_at_the_limit():
    result = go("X1\n$FOR P1=1,2,0\nX2\n$ENDFOR\nM30\n", max_blocks=50)
    assert [i for i, _ in ids(result)] == ["20852", "N4001"]
    assert "line 2" in result.diagnostics[-1].message


def test_endless_loop_is_named_not_the_finite_one_inside():
    text = "$WHILE 1\n$FOR P1=1,3,1\nXP1\n$ENDFOR\n$ENDWHILE\nM30\n"
    result = go(text, max_blocks=500)
    assert result.diagnostics[-1].id == "N4001" and "line 1 " in result.diagnostics[-1].message


def test_condition_that_fails_is_marked():
    (error,) = go("$IF 1/0\nX1\n$ENDIF\nM30\n").diagnostics
    assert (error.id, error.line) == ("20396", 1)


BESIDE = [
    ("$IF 1 X1\n$ENDIF\n", "20212", 1),
    ("$IF 1 $BREAK\n$ENDIF\n", "20212", 1),
    ("P1=1\n$IF P1=1\n$ENDIF\n", "20212", 2),
    ("$IF 0\n$ELSE X1\n$ENDIF\n", "20215", 2),
    ("$IF 0\n$ELSEIF 1 X1\nX2\n$ENDIF\n", "20217", 2),
    ("$IF 0\nX1\n$ENDIF X2\n", "20219", 3),
    ("$IF 1\nX1\n$ELSE\n$ENDIF X2\n", "20219", 4),
    ("$SWITCH 1 X1\n$ENDSWITCH\n", "20220", 1),
    ("$SWITCH 1\n$CASE 1 X1\nX2\n$ENDSWITCH\n", "20222", 2),
    ("$SWITCH 1\n$DEFAULT X1\nX2\n$ENDSWITCH\n", "20224", 2),
    ("$SWITCH 1\n$CASE 1\nX1\n$BREAK\n$DEFAULT\n$ENDSWITCH X2\n", "20206", 6),
    ("$WHILE 0 X1\n$ENDWHILE\n", "20235", 1),
    ("$WHILE 0\nX1\n$ENDWHILE X2\n", "20238", 3),
    ("$WHILE 1\n$BREAK\n$ENDWHILE X2\n", "20238", 3),
    ("$WHILE 1\n$BREAK X1\n$ENDWHILE\n", "20242", 2),
    ("$FOR P1 = 2,1,1 X1\n$ENDFOR\n", "20206", 1),
    ("$FOR P1 = 2,1,1\nX1\n$ENDFOR X2\n", "20206", 3),
    ("$FOR P1 = 1,2,1\n$CONTINUE X1\n$ENDFOR\n", "20245", 2),
    ("$DO X1\n$ENDDO 0\n", "20239", 1),
    ("$DO\n$ENDDO 0 X1\n", "20241", 2),
    ("$REPEAT X1\n$UNTIL 1\n", "21468", 1),
    ("$REPEAT\n$UNTIL 1 X1\n", "21470", 2),
    ("X1 $IF 1\n$ENDIF\n", "20206", 1),
]
"""Program, number and line of a word beside a control statement."""


@pytest.mark.parametrize(("text", "id", "line"), BESIDE)
@pytest.mark.parametrize("bulk", [True, False])
def test_words_beside_a_control_statement_are_not_dropped(text, id, line, bulk):
    assert ids(go(text + "X9\nM30\n", bulk=bulk)) == [(id, line)]


def test_word_behind_a_condition_is_marked():
    (error,) = go("$IF 1 X5\n$ENDIF\nM30\n").diagnostics
    assert error.span.text == "X5" and "line of its own" in error.hint
    (error,) = go("P1=1\n$IF P1=1\n$ENDIF\nM30\n").diagnostics
    assert error.span.text == "=" and "==" in error.hint


@pytest.mark.parametrize(
    ("line", "id"),
    [
        ("$FOR P1 1,5,1", "20228"),
        ("$FOR P1 = 1 5,1", "20229"),
        ("$FOR P1 = 1,5", "20229"),
        ("$FOR = 1,5,1", "N1005"),
        ("$WHILE 1 AND 1", "20392"),
        ("$IF", "20392"),
    ],
)
def test_opening_that_cannot_be_read_keeps_its_end(line, id):
    """One mistake, one message: the end of the statement is not called superfluous."""
    end = {"$FOR": "$ENDFOR", "$WHIL": "$ENDWHILE", "$IF": "$ENDIF"}
    closing = next(v for k, v in end.items() if line.startswith(k))
    assert ids(go(f"X1\n{line}\n{closing}\nM30\n")) == [(id, 2)]
