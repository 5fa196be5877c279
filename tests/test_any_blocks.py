"""Any sequence of blocks ends with a result or a diagnostic, in bounded time and memory.

Blocks are drawn from the whole grammar, right and wrong ones, and cut up at random. Whatever comes
out, it comes without an exception, and a program that goes round for ever ends at the limit of
blocks with the loop that goes on. Expressions are checked against Python's own arithmetic.
"""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope
from ncscope.channel.gfunctions import GFUNCTIONS
from ncscope.diagnostics import Source, Span
from ncscope.execution import Options
from ncscope.language.commands import COMMANDS
from ncscope.language.expressions import EvaluationError, evaluate
from ncscope.language.functions import rounded
from ncscope.language.terms import parse_expression
from ncscope.language.vocabulary import WORDS
from ncscope.machine import Axis, ChannelSettings, Machine

FILES = {"a.nc": "G91 X1\nM17\n", "b.nc": "L a.nc\nL b.nc\n", "c.nc": "%L S\nX@P1\nM17\nLL S\n"}
MACHINE = Machine(settings=ChannelSettings(called_files={"M6": "a.nc", "G80": "c.nc"}))
HEAD, _ = ncscope.load_machine("examples/machines/ca_head")
TURNING = Machine(
    axes=tuple(Axis(n, i, rotary=n == "C", modulo_range=(0.0, 360.0) if n == "C" else None)
               for i, n in enumerate("XYZC", 1)),
    settings=MACHINE.settings,
)  # fmt: skip
NUMBER = st.sampled_from(["0", "1", "-2", "3.5", "[1+1]", "P1", "V.P.A", "@P1", "SIN[30]", "1/0",
                          "[", "P[P1]", '"M"', "V.L.B[1]", "1e9", "9" * 20])  # fmt: skip
AXIS = st.tuples(st.sampled_from(["X", "Y", "Z=", "C", "@X", "X["]), NUMBER).map("".join)
GCODE = st.sampled_from(sorted(GFUNCTIONS)).map(lambda n: f"G{n}")
WORD = st.one_of(
    AXIS,
    GCODE,
    st.tuples(GCODE, st.sampled_from(["=1", "[1,2]", "[]", "=", " X1 I2"])).map("".join),
    st.tuples(st.sampled_from("DEFHIJKMNRSTP"), NUMBER).map("".join),
    st.tuples(
        st.sampled_from(["P1", "V.P.A", "V.S.T", "@P1", "V.L.B[1]", "V.G.NP[1].V.X"]),
        st.sampled_from(["=", "+=", "/=", "=="]),
        NUMBER,
    ).map("".join),
    st.sampled_from(['"M" = "X1"', '"M"', '"M" = "\\"M\\""', "M17", "M30", "M17 [MAIN]", "M6"]),
)
CALL = st.sampled_from(
    ["L a.nc", "L b.nc", "LL S", "LL T", "L none.nc", "LL CYCLE [NAME=S @P1=2]", "G80", "M6 X1",
     "LL CYCLE [NAME=S MODAL_BLOCK @P1=1]", "L SEQUENCE [N10]", "L SEQUENCE [N10 N20 REPEAT=3]",
     "L CYCLE [NAME=a.nc MODAL @P1=1]", "#DISABLE MODAL CYCLE", "L", "L CYCLE [", "LL \"M\""]
)  # fmt: skip
CONTROL = st.sampled_from(
    ["$IF P1 > 0", "$IF 1", "$ELSEIF 0", "$ELSE", "$ENDIF", "$WHILE 1", "$WHILE P1 < 3",
     "$ENDWHILE", "$FOR P1 = 1,3,1", "$FOR P1 = 1,9,0", "$ENDFOR", "$DO", "$ENDDO P1", "$REPEAT",
     "$UNTIL 1", "$SWITCH P1", "$CASE 1", "$DEFAULT", "$ENDSWITCH", "$BREAK", "$CONTINUE",
     "$GOTO N10", "$GOTO [A]", "$IF 1 $GOTO N20", "N10:", "N20: X1", "[A]", "#IF 1", "#ELSE",
     "#ENDIF", "#VAR", "V.L.B[3] : SGN08 = [1,2]", "#ENDVAR", "$IF", "$WHAT",
     '$IF "M"', '$FOR P1 = "M",3,1', "$GOTO V.E.A", "$GOTO V.P.A", "N10: [A] X1", "$IF P1 = 1",
     "$WHILE 1 AND 1", "$ ENDIF", "$FOR P1 1,3", "$BREAK X1", "V.P.A = [P1 + 2] / 3"]
)  # fmt: skip
HASH = st.tuples(
    st.sampled_from([c.name for c in COMMANDS]),
    st.sampled_from(["", " [1]", " [X,1,0]", " [", ' ["%f", P1]', " X1", " [1,2,3,0,0,30]", "=2"]),
).map(lambda p: f"#{p[0]}{p[1]}")
ARC = st.tuples(
    st.sampled_from(
        [
            "G02",
            "G03",
            "G17 G02",
            "G18 G03",
            "G19 G02",
            "G163=5 G02",
            "G164 G03",
            "G161 G02",
            "G01",
            "G331",
            "G91 G03",
            "G41 G01",
            "G70 G02",
        ]
    ),
    st.sampled_from(["", " X10", " X10 Y0", " Y1 Z5", " Z0 X0", " C90", " X5 Y5 Z5 C400"]),
    st.sampled_from(
        ["", " I5", " I5 J0", " J5 K1", " K0", " R5", " R-20", " R0", " I1 R1", " I1e3"]
    ),
    st.sampled_from(["", " F100", " F0", " E5", " #CHR=1", " #RND=2 #FRC=5", " #CHF=0", " S[1]"]),
).map("".join)
TYPICAL = r"""
    #SET AX [X,1,0] [Y,2,1] | #SET AX [C,5,0] | #CALL AX [U,7,3] | #PUT AX [Z] | #AX DEF DEFAULT |
    #PUT AX ALL | #AX REQUEST [IDX] [C,5,3] | #GET CMDPOS [P1=X, V.P.A=Y] | #GET ACTPOS [X=P1] |
    #CHANNEL INIT [CMDPOS] | #CHANNEL INIT [ACTPOS AX=X] | #ERROR [ID=5 RC=0 PV1=P1] | #ERROR |
    #MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos 5"] | #MACHINE DATA [AXNR=P1 AXPARAM="x y"] |
    #MSG SAVE EXCLUSIVE ["%d %s %f", 1, "a", P1] | #MSG ["%q"] | #FILE NAME [MSG=a.txt G81=a.nc] |
    #CS DEF [2] [1,2,3,30,0,45] | #CS ON [2] | #CS ON [1,2,3,0,P1,0] | #CS OFF | #ACS ON [5,0,0] |
    #BCS ON [1,0,0] | #CS ADD [A] [1,2,3,0,0,9] | #CS SELECT [A] | #CS DEL [A] | #ECS ON |
    #MCS ON | #MCS OFF | #MCS ON EX TOOL | #ROTATION ON [ANGLE 30 CENTER1 1] | #ROTATION OFF |
    #SCALE ON X2 Y3 | #SCALE OFF | #PSET X5 | #PRESET | #SUPPRESS OFFSETS [ZERO] X1 |
    #KIN ID [91] | #TRAFO ON | #TRAFO OFF | #TRAFO [91] | #PTP ON | #PTP OFF | #TLC ON [5] |
    #TLC OFF | #TLAX [X-] | #TOOL ORI CS | #TRANSFORM [PCS] [WCS] X1 Y1 Z1 | #WCS TO MCS X1 |
    #SPLINE TYPE BSPLINE | #SPLINE ON | G151 | #DELETE V.P.A | #INIT MACRO TAB | G92 X1 | G54 |
    G59 X0 | G159=2 | G160=1 X1 | G74 X1 | G98 X-1 | G99 X1 | G04 X2 | G04 | G20 | G21 | G23 |
    G351 X-1 | G51 | G52 | G68 R30 | G69 | G70 | G71 | D1 | T1 D0 | V.G.WZ_AKT.L = 5 |
    V.G.NP_AKT.V.X = 3 | V.G.KIN[91].PARAM[0] = 1 | X[V.A.ABS.X + 1] | Y[V.A.ACS.ABS.C] |
    P1 = V.G.BLOCK_NR | V.S.T = "a" + LEFT["bcd", 2] | P1 = EXIST[V.P.A] | P1 = FIND["abc", "c"] |
    P1 = SIZEOF[V.L.B] | C-200 | C+-200 | C--5 | C=370 | XA=5
"""
COMMAND = st.sampled_from([text.strip() for text in TYPICAL.split("|")])
OTHER = st.one_of(
    st.sampled_from(WORDS).map(lambda w: f"X[{w.name} 1]"),
    st.text(max_size=12),
    st.sampled_from(["%MAIN", "%L S", "%L T", "/X1", "(open", "\\", "#COMMENT BEGIN", ";"]),
)
BLOCK = st.one_of(
    st.lists(WORD, min_size=1, max_size=4).map(" ".join), AXIS, CALL, CONTROL, CONTROL, HASH, OTHER,
    ARC, ARC, COMMAND, COMMAND, COMMAND
)  # fmt: skip
PROGRAM = st.lists(BLOCK, min_size=1, max_size=20).map("\n".join)


def load(name):
    return Source(name, FILES[name]) if name in FILES else None


@settings(max_examples=400, deadline=None)
@given(
    PROGRAM,
    st.sampled_from(["", "\nM30\n%L S\nX5\nM17\n"]),
    st.sampled_from([MACHINE, HEAD, TURNING]),
    st.sampled_from([None, None, 0.5]),
)
def test_any_blocks_end(program, tail, machine, sample):
    options = Options(max_blocks=400, load=load, sample=sample)
    result = ncscope.run(machine, program + tail, options)
    for item in result.diagnostics:
        ncscope.render(item)
    assert result.ok == (not any(d.is_error for d in result.diagnostics))
    assert sample or len(result) <= 400 * 40


@settings(max_examples=100, deadline=None)
@given(PROGRAM, st.sampled_from(["", "\nM30\n%L S\nX5\nM17\n"]))
def test_any_blocks_end_without_a_limit_of_the_user(program, tail):
    """The built-in limit, made small: the state comes back, or too many blocks bring none anew."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("ncscope.channel.endless.MOST_BLOCKS", 5_000)
        result = ncscope.run(MACHINE, program + tail, Options(load=load))
    assert result.ok == (not any(d.is_error for d in result.diagnostics))


@settings(max_examples=100, deadline=None)
@given(PROGRAM, st.integers(0, 300))
def test_a_program_may_be_cut_off_anywhere(program, cut):
    ncscope.run(MACHINE, program[:cut], Options(max_blocks=200, load=load))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("X1\n$WHILE 1\nX2\n$ENDWHILE\n", 2),
        ("X1\n$FOR P1 = 1, 2, 0\nX2\n$ENDFOR\n", 2),
        ("X1\n$REPEAT\n$UNTIL 0\n", 2),
        ("N10: X1\nX2\n$GOTO N10\n", 3),
        ("$DO\n$FOR P1=1,3,1\nXP1\n$ENDFOR\n$ENDDO 1\n", None),
        ("X1\n$WHILE 1\nLL S\n$ENDWHILE\nM30\n%L S\nX2\nM17\n", None),
    ],
)
def test_endless_program_ends_with_the_loop_that_goes_on(text, line):
    result = ncscope.run(Machine(), text, Options(max_blocks=5_000))
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert error.id == "N4001"
    if line is not None:
        assert [span.line for _, span in error.notes] == [line]


# --- expressions -------------------------------------------------------------------------------

LITERAL = st.integers(0, 50).map(lambda n: (str(n), float(n)))


def _applied(inner):
    def binary(parts):
        (a, x), (symbol, apply), (b, y) = parts
        return f"[{a}{symbol}{b}]", _or_none(apply, x, y)

    def function(parts):
        (name, apply), (a, x) = parts
        return f"{name}[{a}]", _or_none(apply, x)

    return st.one_of(
        st.tuples(inner, st.sampled_from(list(BINARY.items())), inner).map(binary),
        st.tuples(st.sampled_from(list(FUNCTIONS.items())), inner).map(function),
    )


def _or_none(apply, *values):
    """None where Python has no value for it, and for what depends on one that has none."""
    if any(v is None for v in values):
        return None
    try:
        result = apply(*values)
    except (ArithmeticError, ValueError):
        return None
    return None if isinstance(result, complex) or not math.isfinite(result) else float(result)


def _divided(a, b):
    if abs(b) < 1e-15:
        raise ZeroDivisionError
    return a / b


def _modulo(a, b):
    if abs(b) < 1e-15:
        raise ZeroDivisionError
    return math.fmod(a, b)


def _true(x):
    return abs(x) >= 0.5


BINARY = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": _divided,
    "**": lambda a, b: a**b,
    " MOD ": _modulo,
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    "&&": lambda a, b: _true(a) and _true(b),
    "||": lambda a, b: _true(a) or _true(b),
    " XOR ": lambda a, b: _true(a) != _true(b),
}
FUNCTIONS = {
    "ABS": abs,
    "SQR": lambda x: x * x,
    "SQRT": math.sqrt,
    "EXP": math.exp,
    "LN": math.log,
    "LOG": math.log10,
    "DEXP": lambda x: 10.0**x,
    "SIN": lambda x: math.sin(math.radians(math.fmod(x, 360))),
    "COS": lambda x: math.cos(math.radians(math.fmod(x, 360))),
    "ATAN": lambda x: math.degrees(math.atan(x)),
    "ASIN": lambda x: math.degrees(math.asin(x)),
    "INT": math.trunc,
    "FRACT": lambda x: math.fmod(x, 1),
    "ROUND": rounded,
    "CEIL": math.ceil,
    "FLOOR": math.floor,
    "NOT": lambda x: not _true(x),
}
STEPS = ("<", ">", "==", "!=", "&&", "||", "XOR", "NOT", "INT", "FRACT", "ROUND", "CEIL", "FLOOR",
         "MOD", "/", "LN", "LOG", "SQRT", "ASIN")  # fmt: skip
"""What turns the last digit of a sine into another value, or into none."""
COMPUTED = st.recursive(LITERAL, _applied, max_leaves=7)


@settings(max_examples=600, deadline=None)
@given(COMPUTED)
def test_expression_has_the_value_of_python(pair):
    text, expected = pair
    rough = any(name in text for name in ("SIN", "COS", "EXP", "LN", "LOG", "DEXP", "ATAN", "**"))
    if rough and any(step in text for step in STEPS):
        return
    tree = parse_expression(text, Span(Source("p", text), 0, len(text)))
    try:
        found = evaluate(tree, None)  # type: ignore[arg-type]
    except EvaluationError:
        assert expected is None, text
        return
    assert expected is not None, text
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9), text
