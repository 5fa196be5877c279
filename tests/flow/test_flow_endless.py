"""Programs that do not end: proved from a state that comes back, or given up after many blocks.

No program here has a limit of its own unless it says so: that the tests end is what they show.
"""

import pytest

import ncscope
from ncscope import Machine, Options
from ncscope.channel.endless import same
from ncscope.channel.layered import Layered, with_value, without

FOREVER = [
    ("[A] X1\n$GOTO [A]\n", 2),
    ("N10: G91 X1\nX-1\n$GOTO N10\n", 3),
    ("X1\n$WHILE 1\n$ENDWHILE\n", 2),
    ("X1\n$WHILE 1\nX2\nX3\nX4\n$ENDWHILE\n", 2),
    ("$DO\n$ENDDO 1\n", 1),
    ("X0\n$REPEAT\nG02 X0 Y0 I5 F100\n$UNTIL 0\n", 2),
    ("P1=0\n$WHILE P1 < 5\nP1 = P1 + 1\n$IF P1 == 4\nP1 = 1\n$ENDIF\n$ENDWHILE\n", 2),
    ("$WHILE 1\n$FOR P1=1,300,1\nXP1\n$ENDFOR\n$ENDWHILE\n", 1),
    ("$FOR P2=1,3,1\n$WHILE P2 >= 2\nX1\n$ENDWHILE\n$ENDFOR\n", 2),
    ("$FOR P1=1,5,1\nP1 = 2\n$ENDFOR\n", 1),
    ("$FOR P1=1,5,0\n$ENDFOR\n", 1),
    ("%L S\nP1=1\nM17\n%M\n$WHILE 1\nLL S\n$ENDWHILE\n", 5),
    ("%L S\n[B] X1\n$GOTO [B]\nM17\n%M\nLL S\n", 3),
    ("%L C\nX @P1\nM17\n%M\n$WHILE 1\nLL CYCLE [NAME=C @P1=3]\n$ENDWHILE\n", 5),
    ('$WHILE 1\nG54 X1\n#CS ON [1,2,3,0,0,30]\nX2\n#CS OFF\n#MSG ["again"]\n$ENDWHILE\n', 1),
    ('$WHILE 1\nV.P.A = "text"\n#PSET X5\nG92 X1\n$ENDWHILE\n', 1),
]


@pytest.mark.parametrize(("text", "line"), FOREVER)
@pytest.mark.parametrize("bulk", [None, False])
def test_a_state_that_comes_back_ends_the_run_at_its_loop(text, line, bulk):
    result = ncscope.run(Machine(), text + "M30\n", Options(bulk=bulk))
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.id, error.line) == ("N4001", line)
    assert f"line {line} never ends" in error.message


def test_waiting_for_the_plc_is_explained():
    result = ncscope.run(Machine(), "P1 = 0\n$WHILE P1 == 0\n$ENDWHILE\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert "--set" in error.hint


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("P1=0\n[A] P1=P1+1\nG02 X0 Y0 I5 F100\n$GOTO [A]\n", 4),
        ("P1=0\n$WHILE P1 >= 0\nP1=P1+1\nM3\n$ENDWHILE\n", 2),
        ("P1=0\n$WHILE P1 >= 0\nP1=P1+1\nXP1\n$ENDWHILE\n", 2),
        ("P2=0\n$FOR P1=1,5,1\nP1 = 2\nP2 = P2 + 1\nM3\n$ENDFOR\n", 2),
        ("P2=0\n$FOR P1=1,5,0\nP2 = P2 + 1\nM3\n$ENDFOR\n", 2),
    ],
)
def test_a_state_that_always_changes_ends_after_many_blocks(text, line, monkeypatch):
    monkeypatch.setattr("ncscope.channel.endless.MOST_BLOCKS", 2_000)
    result = ncscope.run(Machine(), text + "M30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert error.id == "N4001" and f"line {line} goes on" in error.message
    assert [span.line for _, span in error.notes] == [line]
    assert "--max-blocks" in error.hint


@pytest.mark.parametrize(
    "text",
    [
        "$FOR P1=1,150,1\nM3\n$ENDFOR\n",  # 452 blocks of the step lane, but it counts
        "$FOR P2=1,10,1\n$FOR P1=20,1,-1\nM3\n$ENDFOR\n$ENDFOR\n",
        "%L S\nM3\nM4\nM17\n%M\n" + "LL S\n" * 300,  # each line of the main program is new
        "M3\n" * 900,
    ],
)
def test_long_programs_are_not_limited(text, monkeypatch):
    monkeypatch.setattr("ncscope.channel.endless.MOST_BLOCKS", 700)
    assert ncscope.run(Machine(), text + "M30\n").ok


def test_the_users_own_limit_replaces_the_built_in_one(monkeypatch):
    monkeypatch.setattr("ncscope.channel.endless.MOST_BLOCKS", 700)
    text = "P1=0\n$WHILE P1 < 500\nP1=P1+1\nM3\n$ENDWHILE\nM30\n"
    assert not ncscope.run(Machine(), text).ok
    assert ncscope.run(Machine(), text, Options(max_blocks=100_000)).ok


def test_equal_states_are_equal_to_the_last_bit():
    start = ncscope.run(Machine(), "X1\nM30\n")
    assert same(start.stretches[0].coordinates, start.stretches[0].coordinates)
    assert same({"a": (1.0, "x")}, {"a": (1.0, "x")}) and not same({"a": 1.0}, {"a": 1.5})
    assert same((1, 2), (1, 2)) and not same((1, 2), (1, 3)) and not same((1,), [1])


# --- many names --------------------------------------------------------------------------------


def test_layered_mapping_is_a_dict_that_never_changes():
    whole: dict[str, int] = {}
    mapping, older = {}, []
    for n in range(2_000):
        key = f"k{n * 7 % 500}"
        if n % 5 == 4 and key in whole:
            whole = {k: v for k, v in whole.items() if k != key}
            mapping = without(mapping, key)
        else:
            whole = {**whole, key: n}
            mapping = with_value(mapping, key, n)
        if n % 100 == 0:
            older.append((mapping, dict(whole)))
        assert len(mapping) == len(whole)
    assert isinstance(mapping, Layered)
    for then, copy in [*older, (mapping, whole)]:
        assert dict(then) == copy and set(then) == set(copy)
    with pytest.raises(KeyError):
        mapping["none"]
    with pytest.raises(KeyError):
        without(mapping, next(iter(mapping)))[next(iter(mapping))]


def test_a_warning_in_a_loop_is_given_once_for_its_place():
    result = ncscope.run(Machine(), "$FOR P1=1,50,1\n#CS OFF\n#CS OFF ALL\n$ENDFOR\nM30\n")
    assert [(d.id, d.line) for d in result.diagnostics] == [("20824", 2), ("20824", 3)]
