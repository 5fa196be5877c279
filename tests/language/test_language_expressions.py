"""Values of expressions: worked cases of the programming manual, and Python as the oracle."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ncscope.diagnostics import Source
from ncscope.language import EvaluationError, evaluate, parse_block


class World:
    """P1 = 5, P2[3] = 23; every V. variable is the name of its last part."""

    def read(self, node, indices):
        return {(1,): 5.0, (2, 3): 23.0}.get(indices, node.span.text)

    def exists(self, node, indices):
        return indices == (1,)

    def size(self, node, indices, dimension):
        return 4 + dimension

    def macro(self, name):
        return {"M1": "2+3", "LOOP": '1+"LOOP"', "BAD": "1+"}.get(name)


def value(text):
    block, diagnostics, _ = parse_block(Source("main.nc", f"P9 = {text}"), 0)
    assert diagnostics == ()
    return evaluate(block.words[0].value, World())


def failure(text):
    with pytest.raises(EvaluationError) as caught:
        value(text)
    return caught.value.diagnostic


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("COS[5*12]", 0.5),
        ("11 MOD 3", 2),
        ("-11 MOD 3", -2),
        ("COS[90]", 0),
        ("SIN[-540]", 0),
        ("TAN[180]", 0),
        ("COT[90]", 0),
        ("-2**2", -4),
        ("2**-1", 0.5),
        ("2**3**2", 512),
        ("2**P1", 32),
        ("10-2-3", 5),
        ("1+2*3", 7),
        ("[1+2]*3", 9),
        ("6 & 3 | 8 ^ 1", 11),
        ("INV[0]", -1),
        ("1 == 1 && 2 < 1", 0),
        ("0.5 XOR 0.4", 1),
        ("NOT[0.4]", 1),
        ("INT[-1.7]", -1),
        ("FRACT[2.25]", 0.25),
        ("ROUND[2.5]", 3),
        ("FLOOR[-1.2] + CEIL[1.2]", 0),
        ("SQR[3] + SQRT [16]", 13),
        ("DEXP[2] + LOG[100]", 102),
        ("ATAN2[1,1]", 45),
        ("PI * TRUE", math.pi),
        ("P2[P1-2]", 23),
        ("EXIST[P1] + EXIST[P7]", 1),
        ("SIZEOF[V.P.A, 1]", 5),
        ('2 * "M1"', 10),
        ('2 + "M1"', 7),
        ('MACRO_LENGTH["M1"]', 3),
        ('"ab" + "cd"', "abcd"),
        ('"ab" == "ab"', 1),
        ('LEFT["hello",2] + MID["hello",2,3] + RIGHT["hello",1]', "hello"),
        ('FIND["hello","l"] + LEN["hello"] + ORD["A",1]', 73),
        ('IS_STRING["a"] + IS_NUMBER[1]', 2),
        ("REAL_TO_STR[1.5]", "1.500000"),
        (".5 + 5.", 5.5),
    ],
)
def test_worked_cases(text, expected):
    assert value(text) == pytest.approx(expected, abs=0) or value(text) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ("10/COS[90]", "20396"),
        ("TAN[90]", "20396"),
        ("1 MOD 0", "20396"),
        ("0 ** -1", "20396"),
        ("SQRT[-1]", "20398"),
        ("LN[0]", "20399"),
        ("10 ** 400", "21883"),
        ("EXP[1000]", "21883"),
        ("ASIN[2]", "N1006"),
        ("1 - V.P.TEXT", "20392"),
        ('1 * "NONE"', "20619"),
        ('1 * "LOOP"', "20734"),
        ('1 * "BAD"', "20392"),
    ],
)
def test_failures(text, id):
    found = failure(text)
    assert found.id == id
    assert found.span.line == 1


def test_the_span_of_a_failure_is_the_division():
    assert failure("1 + 10/COS[90]").span.text == "10/COS[90]"


ATOMS = st.integers(0, 99).map(str)
TREES = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*"]), inner).map(" ".join),
        inner.map(lambda text: f"({text})"),
    ),
    max_leaves=12,
)


@given(TREES)
@settings(max_examples=200, deadline=None)
def test_arithmetic_agrees_with_python(text):
    ours = text.replace("(", "[").replace(")", "]")
    assert value(ours) == eval(text)


@given(st.floats(-720, 720))
def test_trigonometry_agrees_with_python(angle):
    text = f"{angle:.6f}"
    assert value(f"SIN[{text}]") == pytest.approx(math.sin(math.radians(float(text))), abs=1e-12)
    assert value(f"COS[{text}]") == pytest.approx(math.cos(math.radians(float(text))), abs=1e-12)


def test_long_chains_stay_within_the_recursion_limit():
    assert value("1" + "+1" * 149) == 150
    assert value("[" * 30 + "1" + "]" * 30) == 1
