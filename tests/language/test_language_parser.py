"""NC text to tree: worked cases of the programming manual, and laws for any text."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ncscope.diagnostics import Source
from ncscope.language import parse_block, parse_program, tree
from ncscope.language.commands import COMMANDS, lookup
from ncscope.language.lexer import tokens


def program(text):
    return parse_program(Source("main.nc", text))


def block(text):
    found, diagnostics, stop = parse_block(Source("main.nc", text), 0)
    assert stop == len(text)
    assert diagnostics == () and found.ok
    return found


def words(text):
    return [(type(word).__name__, word.span.text) for word in block(text).words]


def errors(text):
    return [(item.id, item.span.text) for item in program(text).diagnostics]


def test_longest_axis_name():
    (word,) = block("X50P1=7").words
    assert (word.name, word.value.value, word.sign) == ("X50P1", 7, "")
    assert words("X50 P1=7") == [("AxisWord", "X50"), ("Assignment", "P1=7")]
    assert words("x10Y20") == [("AxisWord", "x10"), ("AxisWord", "Y20")]


@pytest.mark.parametrize(
    "text",
    [
        "X10",
        "X-10",
        "X+0.5",
        "X=10",
        "X[P1]",
        "XP1",
        "XV.P.NAME",
        "X@P1",
        "X100+20",
        "X5.",
        "X-P1",
        'X-2*"M1"',
        "X_ACHSE1=5",
        "V.5",
    ],
)
def test_axis_values(text):
    assert words(text) == [("AxisWord", text)]


@pytest.mark.parametrize("text", ["X SIN[30]", "X .5", "X = 10 MOD 3", "X 10 + 5"])
def test_axis_values_with_blanks(text):
    assert words(text) == [("AxisWord", text)]


def test_words_without_blanks_and_with_expressions():
    assert words("g01X10Y-20f1000 TV.P.X") == [
        ("GWord", "g01"),
        ("AxisWord", "X10"),
        ("AxisWord", "Y-20"),
        ("AddressWord", "f1000"),
        ("AddressWord", "TV.P.X"),
    ]
    assert words("P1 = P1 - 1.5 YP1") == [("Assignment", "P1 = P1 - 1.5"), ("AxisWord", "YP1")]
    assert words("S1=1000 S1000 S.POS=90")[1] == ("AddressWord", "S1000")
    assert words("X[INDP_SYN POS=5]") == [("AxisCommand", "X[INDP_SYN POS=5]")]


def test_g_and_m_words():
    (axis, offset, cycle) = block("G[P1] G159=3 G82 [1,,2]").words
    assert isinstance(axis.number, tree.Parameter)
    assert offset.value.value == 3
    assert [place and place.value for place in cycle.arguments] == [1, None, 2]
    assert block("M17 [JUMPS=2]").words[0].arguments[0].items[0].key == "JUMPS"


def test_number_label_and_skip():
    first = block("/10 N20: X1")
    assert (first.skip, first.number.value, first.labels) == (10, 20, ("N20",))
    assert block("/ [Start] X1").labels == ("[START]",)
    assert block("/5 N100 G00 X150").skip == 5


def test_comments():
    assert words("X1 (a (b) c) Y2 (open Z3") == [("AxisWord", "X1"), ("AxisWord", "Y2")]
    assert words('"A;(" = "B;("') == [("MacroDefinition", '"A;(" = "B;("')]
    assert program("; only\n(a)\n\n").blocks == ()


def test_continuation():
    text = 'L CYCLE [NAME=f.cyc @P1=5 \\\n  ; off \\\n\n  @P2="x" MODAL_MOVE]\nM30'
    call, end = program(text).blocks
    assert call.words[0].target.text == "f.cyc"
    assert [item.key for item in call.words[0].arguments[0].items] == ["NAME", "@P1", "@P2", None]
    assert end.span.line == 5


def test_calls_and_macros():
    kinds = [block(t).words[0] for t in ("LL sub", "L a/b.nc", 'L "X"', "L V.E.x")]
    assert [(c.kind, type(c.target).__name__) for c in kinds] == [
        ("LL", "Name"),
        ("L", "Name"),
        ("L", "Macro"),
        ("L", "Variable"),
    ]


def test_controls():
    jump = block("$IF P1 == 5 $GOTO N20").control
    assert (jump.keyword, jump.target.value) == ("IF", 20)
    loop = block("$FOR P1 = 1, 5, 1").control
    assert len(loop.values) == 3 and isinstance(loop.target, tree.Parameter)
    assert block("X10 $GOTO [lbl]").control.target.text == "LBL"
    assert block("$SWITCH P1=INT[P2]").control.values[0].span.text == "P1"


def test_commands_of_the_seed():
    axes = block("N00730 #SET AX [X, 1, 0] [C, 5, 4]").commands[0]
    assert [type(p).__name__ for p in axes.groups[0].places] == ["Name", "Number", "Number"]
    system = block("N010 #CS DEF [1][P1,15,5,20,30,45] (Definition)").commands[0]
    assert [len(group.places) for group in system.groups] == [1, 6]
    message = block('#MSG SAVE EXCLUSIVE ["X setpoint: %f", V.A.ACS.ABS.X]').commands[0]
    assert (message.name, message.modifiers) == ("MSG SAVE", ("EXCLUSIVE",))
    assert block('#MSG SAVE EXCLUSIVE [""]').commands[0].groups[0].places[0].value == ""
    assert block("#CS  off ALL").commands[0].name == "CS OFF ALL"
    assert block("#FILE NAME [MSG=a.txt]").commands[0].groups[0].items[0].value.text == "a.txt"


def test_items():
    items = block("#ROTATION ON [ANGLE -45 CENTER1=10]").commands[0].groups[0].items
    assert [(item.key, item.value.span.text) for item in items] == [
        ("ANGLE", "-45"),
        ("CENTER1", "10"),
    ]
    assert block("#CS ON [0,,1]").commands[0].groups[0].places[1] is None


def test_commands_with_words():
    assert [w.name for w in block("#PSET X20 Y20").commands[0].words] == ["X", "Y"]
    chamfer = block("G01 X10 #CHR=2 Y5")
    assert len(chamfer.words) == 3 and chamfer.commands[0].value.value == 2


def test_variables():
    (word,) = block("V.G.KIN[91].POINT[0] = 10000").words
    assert [part.name for part in word.target.parts] == ["V", "G", "KIN", "POINT"]
    assert block("XV.A.-SWE.X").words[0].value.parts[2].name == "-SWE"


def test_declarations():
    text = "#VAR\nV.P.A[3] : SGN32 = [1,2,3]\nV.P.S : STRING[20]\nP5[2][2]\n#ENDVAR\nM30\n"
    blocks = program(text).blocks
    assert not program(text).diagnostics
    assert [len(b.declarations) for b in blocks] == [0, 1, 1, 1, 0, 0]
    assert blocks[1].declarations[0].type == "SGN32"
    assert len(blocks[1].declarations[0].initial) == 3


def test_subprograms():
    found = program("%L one\nX1\nM17\n%L two\nM17\n%MAIN (x)\nM30\n")
    assert found.subprograms == {"one": range(1, 3), "two": range(4, 5)}
    assert found.blocks[5].header == "MAIN"
    assert found.diagnostics == ()


def test_block_comment():
    assert len(program('#COMMENT BEGIN\n"X( \n#COMMENT END\nX1\n').blocks) == 3
    assert errors("#COMMENT BEGIN\nX1")[0][0] == "20568"
    assert errors("#COMMENT END\n")[0][0] == "20567"


@pytest.mark.parametrize(
    ("text", "id", "place"),
    [
        ("X", "N1002", "X"),
        ("HierStehtIrgendwas", "20200", "HierStehtIrgendwas"),
        ("X[5", "20397", ""),
        ("#CS ON [1", "20198", ""),
        ("#FOO X1", "20509", "#FOO"),
        ("#TRAFO ON X10", "20207", "#TRAFO ON"),
        ("X1 $ELSE", "20206", "$ELSE"),
        ("$FOO", "20209", "$FOO"),
        ("V.P.X", "20194", "V.P.X"),
        ("X FIX[3]", "20392", "FIX"),
        ("X SIN 30", "20387", "30"),
        ('"abc', "N1003", '"abc'),
        ("N1 N2", "20105", "N2"),
        ("X1\n%MAIN", "20193", "%MAIN"),
        ("\ufeffX1", "21798", "\ufeff"),
        ("X1\rY2\r", "20301", "X"),
        ("X" + "[" * 100, "20386", "["),
        ("X1" + "+1" * 300, "20386", "1"),
        ("X1" + " " * 4000 + "Y1", "N1004", "X1" + " " * 4000 + "Y1"),
        ("X\u20ac", "20200", "X\u20ac"),
        ("X" + "9" * 400, "21883", "9" * 400),
    ],
)
def test_mistakes(text, id, place):
    if id == "20200" and "\u20ac" in text:
        assert errors(text)[0][0] in ("20200", "N1002")
    else:
        assert errors(text) == [(id, place)]
    assert not program(text).blocks[-1].ok


def test_a_mistake_is_kept_to_its_block():
    found = program("X1\nX[\nY2\n")
    assert [b.ok for b in found.blocks] == [True, False, True]
    assert (found.diagnostics[0].line, found.diagnostics[0].column) == (2, 3)


def test_close_match():
    assert program("#CS OOF").diagnostics[0].hint == "did you mean #CS OFF?"


def test_lookup_takes_the_longest_name():
    assert all(lookup(command.name) == command for command in COMMANDS)
    assert {command.kind for command in COMMANDS} == {"modelled", "no effect", "refused"}


FRAGMENTS = ["X", "X10", "G01", "#CS ON", "[", "]", "(", ")", ";", '"', "\\", "\n", "P1=", "V.P.A"]
FRAGMENTS += [
    " ",
    "1",
    "+",
    "-",
    "$IF ",
    "$GOTO ",
    "N10",
    "%",
    "%L ",
    "#VAR\n",
    "L ",
    "=",
    ",",
    ":",
]
FRAGMENTS += ["#COMMENT BEGIN\n", "#MSG", "SIN[", "**", "@P1", "/", ".", "\ufeff", "S1=", "#CHR="]
LINES = st.lists(st.sampled_from(FRAGMENTS), max_size=25).map("".join)


@given(st.one_of(st.text(), LINES))
@settings(max_examples=400, deadline=None)
def test_the_parser_never_raises(text):
    found = program(text)
    for item in found.diagnostics:
        assert 0 <= item.span.start <= item.span.end <= len(text)
    assert all(b.ok for b in found.blocks) == (not found.diagnostics)


@given(st.one_of(st.text(), LINES))
@settings(max_examples=300, deadline=None)
def test_tokens_cover_the_source(text):
    at, joined = 0, ""
    while at < len(text):
        line = [token.text for token in tokens(text, at)]
        stop = parse_block(Source("main.nc", text), at)[2]
        joined += "".join(line)
        at += len("".join(line))
        assert at == stop
    assert joined == text


def test_the_seed_program_is_read_without_a_diagnostic():
    text = """
; universal kinematics, FCT-C27 4.3
N00010 V.G.KIN[91].NUMBER_OF_AXES = 5
N00020 V.G.KIN[91].AXIS[0].ORIENTATION[0] = 1
N00730 #SET AX [X, 1, 0] [Y, 2, 1] [Z, 3, 2] [A, 4, 3] [C, 5, 4]
N00740 #KIN ID [91]
N00750 #TRAFO ON
N00760 G00 X0 Y0 Z0 B0
N00920 #FLUSH WAIT
N00930 #CHANNEL INIT [CMDPOS]
N00940 #MSG SAVE EXCLUSIVE ["X setpoint: %f", V.A.ACS.ABS.X]
N00990 #MSG SAVE EXCLUSIVE [""]
N01000 #TRAFO OFF
N01010 V.G.WZ_AKT.L = 99
N01320 M30
"""
    found = program(text)
    assert found.diagnostics == ()
    assert [block.number.value for block in found.blocks][:3] == [10, 20, 730]
    assert found.blocks[-1].span.text == "N01320 M30"
