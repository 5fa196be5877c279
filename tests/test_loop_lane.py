"""The loop lane has the meaning of the step lane: the same moves, messages and variables.

Programs with loops are drawn at random and run through both. What is compiled, and what is left to
the step lane, must not be seen in the result.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope
from ncscope.channel import loop_lane
from ncscope.execution import Options
from ncscope.language import inline
from ncscope.language.expressions import EvaluationError, evaluate
from ncscope.language.terms import parse_expression
from ncscope.machine import Machine
from test_lanes import CA_HEAD, FLAT, assert_equal

VALUE = st.one_of(
    st.integers(-9, 9).map(str),
    st.sampled_from(["1.5", "0", "90", "1000000000000", "P1", "P2", "P3", "V.P.A", "V.L.B", "P9"]),
)


def _combined(inner):
    function = st.sampled_from(
        ["SIN", "COS", "TAN", "SQRT", "ABS", "EXP", "LN", "INT", "FRACT", "NOT", "ATAN", "ROUND"]
    )
    operator = st.sampled_from(
        ["+", "-", "*", "/", "**", " MOD ", "<", ">=", "==", "&&", "||", " XOR ", "&", "|", "^"]
    )
    return st.one_of(
        st.tuples(function, inner).map(lambda p: f"{p[0]}[{p[1]}]"),
        st.tuples(inner, operator, inner).map(lambda p: f"[{p[0]}{p[1]}{p[2]}]"),
        inner.map(lambda e: f"-{e}" if not e.startswith("-") else e),
    )


EXPRESSION = st.recursive(VALUE, _combined, max_leaves=6)
WORD = st.one_of(
    st.tuples(st.sampled_from("XYZAC"), EXPRESSION).map(lambda p: f"{p[0]}[{p[1]}]"),
    st.tuples(
        st.sampled_from(["P1", "P2", "V.P.A", "V.L.B", "P4"]),
        st.sampled_from(["=", "+=", "-=", "*=", "/="]),
        EXPRESSION,
    ).map("".join),
    st.sampled_from(["G0", "G1", "G90", "G91", "F500", "F[P1]", "M8", "X1", "Y2.5", "G54", "S5"]),
    st.sampled_from(['"W"', 'Z"V"', 'P4="V"']),
)
BLOCK = st.tuples(
    st.sampled_from(["", "N10 ", "N[P1] "]), st.lists(WORD, min_size=1, max_size=4)
).map(lambda p: p[0] + " ".join(p[1]))


def _nested(inner):
    body = st.lists(inner, min_size=1, max_size=4).map("\n".join)
    return st.one_of(
        st.tuples(st.sampled_from("123"), st.sampled_from(["6", "P1", "P5"]), body).map(
            lambda p: f"$FOR P{p[0]} = 1,{p[1]},1\n{p[2]}\n$ENDFOR"
        ),
        body.map(lambda b: f"P5=0\n$WHILE P5 < 7\nP5=P5+1\n{b}\n$ENDWHILE"),
        body.map(lambda b: f"P6=9\n$DO\nP6-=2\n{b}\n$ENDDO P6 > 0"),
        body.map(lambda b: f"P7=0\n$REPEAT\nP7+=1\n{b}\n$UNTIL P7 >= 6"),
        body.map(lambda b: f'$IF "C"\n{b}\n$ELSE\nP1 += 1\n$ENDIF'),
        st.tuples(EXPRESSION, body, body).map(
            lambda p: f"$IF {p[0]}\n{p[1]}\n$ELSE\n{p[2]}\n$ENDIF"
        ),
        st.tuples(EXPRESSION, body).map(
            lambda p: f"$FOR P8 = 5,1,-1\n{p[1]}\n$IF {p[0]}\n$BREAK\n$ENDIF\n$ENDFOR"
        ),
    )


PROGRAM = st.lists(st.recursive(BLOCK, _nested, max_leaves=8), min_size=1, max_size=4).map(
    "\n".join
)
HEAD = (
    "#VAR\nV.L.B = 2\n#ENDVAR\nP1=1 P2=2 P3=3 V.P.A=4 P5=3\n"
    '"V" = "P1 + 2" "W" = "Y[P2] P3=\\"V\\"" "C" = "P1 > 2"\nG1 F100 X0\n'
)


def same_places(machine, text, **options):
    fast = ncscope.run(machine, text, Options(**options))
    slow = ncscope.run(machine, text, Options(bulk=False, **options))
    assert list(fast._places) == list(slow._places)
    for line, place in slow._places.items():
        other = fast._places[line]
        assert other.block == place.block
        np.testing.assert_allclose(other.program, place.program, rtol=0, atol=1e-12)


@settings(max_examples=250, deadline=None)
@given(PROGRAM, st.sampled_from([60, 400]))
def test_lanes_agree_on_programs_with_loops(program, limit):
    assert_equal(FLAT, HEAD + program + "\nM30\n", max_blocks=limit)


@settings(max_examples=60, deadline=None)
@given(PROGRAM)
def test_what_explain_shows_is_the_same(program):
    same_places(FLAT, HEAD + program + "\nM30\n", max_blocks=300)


@settings(max_examples=40, deadline=None)
@given(PROGRAM)
def test_lanes_agree_under_a_kinematics(program):
    text = f"{HEAD}#KIN ID [91]\n#TRAFO ON\n{program}\nM30\n"
    assert_equal(CA_HEAD, text, max_blocks=300)


class Plain:
    """Variables with these values."""

    def __init__(self, values):
        self.values = values

    def read(self, node, indices):
        return self.values[inline.variable_key(node)]


@settings(max_examples=400, deadline=None)
@given(EXPRESSION)
def test_inline_source_has_the_value_of_the_expression(text):
    """Bit for bit; where the expression has no value the source raises."""
    values = {"P1": 2.0, "P2": -3.5, "P3": 1e200, "V.P.A": 0.25, "V.L.B": 0.0, "P9": 90.0}
    from ncscope.diagnostics import Source, Span

    tree = parse_expression(text, Span(Source("p", text), 0, len(text)))
    code = f"finite({inline.source(tree, {})})"
    try:
        expected = evaluate(tree, Plain(values))
    except EvaluationError:
        with pytest.raises(loop_lane.NOT_MADE):
            eval(code, {**inline.NAMESPACE, "v": values})
        return
    found = eval(code, {**inline.NAMESPACE, "v": values})
    assert found == expected and math.copysign(1, found) == math.copysign(1, expected)


LOOP = "G1 F100 P1=0\n$FOR P1 = 1,{n},1\nX[50*COS[P1]] Y[P1/2]\n$ENDFOR\nM30\n"


def test_long_loop_takes_the_lane(monkeypatch):
    """Without this the tests above would compare the step lane with itself."""
    taken = []
    advance = loop_lane.LoopLane.advance
    monkeypatch.setattr(
        loop_lane.LoopLane, "advance", lambda *a: taken.append(advance(*a)) or taken[-1]
    )
    result = ncscope.run(Machine(), LOOP.format(n=10_000)).check()
    assert sum(piece.count for piece in taken if piece) > 19_000
    expected = [50 * math.cos(math.radians(i)) for i in range(1, 10_001)]
    np.testing.assert_allclose(result.acs[:, 0], expected, atol=1e-9)
    assert result.line.tolist() == [3] * 10_000


def test_points_along_the_moves_of_a_loop():
    text = LOOP.format(n=50)
    for sample in (None, 0.5):
        fast = ncscope.run(Machine(), text, Options(sample=sample))
        slow = ncscope.run(Machine(), text, Options(sample=sample, bulk=False))
        np.testing.assert_allclose(fast.acs, slow.acs, rtol=0, atol=1e-12)


def test_axis_position_that_is_not_found_is_reported_at_its_pass():
    """The step lane finds the pass at which the value overflows on the way to the axis."""
    text = "P1=1\nG91\n$WHILE 1\nP1=P1*1e0\nXP1\nP1=P1*10000000000\n$ENDWHILE\nM30\n"
    text = text.replace("P1=P1*1e0\n", "")
    assert_equal(FLAT, text)


def test_endless_loop_is_named_quickly():
    result = ncscope.run(
        Machine(), "X1\nP1=0\n$WHILE 1\nP1+=1\n$ENDWHILE\n", Options(max_blocks=10**6)
    )
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.id, error.notes[0][1].line) == ("N4001", 3)
