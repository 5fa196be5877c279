"""What makes the step lane fast changes no meaning: each shortcut beside the long way."""

from dataclasses import fields, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

import ncscope
from ncscope.channel import block
from ncscope.channel.elements import Elements
from ncscope.channel.rules import RULES
from ncscope.channel.start import start_state
from ncscope.diagnostics import Source
from ncscope.language.lexer import _joined_line, read_line
from ncscope.machine import Machine
from test_cases import CASES, machine_of, options_of, rest_of

STATE = start_state(Machine())


def test_a_changed_state_is_a_replaced_one():
    for field in fields(STATE):
        new = STATE.changed(**{field.name: "other"})
        expected = replace(STATE, **{field.name: "other"})
        assert all(getattr(new, f.name) is getattr(expected, f.name) for f in fields(STATE))
        assert getattr(STATE, field.name) != "other"


def test_a_state_takes_no_field_that_it_does_not_have():
    with pytest.raises(TypeError, match="blok"):
        STATE.changed(blok=5)
    assert not hasattr(STATE, "blok")


def test_a_rule_that_sleeps_has_nothing_to_do(monkeypatch):
    """Every case with all rules awake in all blocks."""
    everything = tuple(rule for rule, _ in RULES)
    for folder in CASES:
        if not (folder / "main.nc").exists():
            continue
        machine, options = machine_of(folder), options_of(folder)
        program = ncscope.load_program(folder / "main.nc")
        quick = ncscope.run(machine, program, replace(options, bulk=False))
        with monkeypatch.context() as patch:
            patch.setattr(block, "awake", lambda draft, words: everything)
            full = ncscope.run(machine, program, replace(options, bulk=False))
        assert rest_of(quick) == rest_of(full), folder.name
        assert quick.acs.tobytes() == full.acs.tobytes(), folder.name


@given(st.lists(st.integers(), min_size=1, max_size=40), st.data())
def test_elements_are_a_list(values, data):
    elements = Elements.of(values)
    for _ in range(4):
        at = data.draw(st.integers(0, len(values) - 1))
        before = list(elements)
        changed = elements.with_element(at, data.draw(st.integers()))
        assert list(elements) == before
        elements, before[at] = changed, changed[at]
        assert list(elements) == before and len(elements) == len(values)
        assert [elements[i] for i in range(len(values))] == before


def test_an_array_that_a_loop_fills():
    """T[i] = 2 i, so T[0] + T[7] + T[9] = 0 + 14 + 18."""
    text = "#VAR\nV.P.T[10]\n#ENDVAR\n$FOR P1=0,9,1\nV.P.T[P1]=P1*2\n$ENDFOR\n"
    result = ncscope.run(Machine(), text + "G0 X[V.P.T[0]+V.P.T[7]+V.P.T[9]]\nM30\n").check()
    assert result.acs[0, 0] == 32.0


@given(st.text("a\n", max_size=60), st.lists(st.integers(0, 60), max_size=12), st.booleans())
def test_lines_are_counted_from_anywhere(text, offsets, as_bytes):
    import numpy as np

    content = np.frombuffer(text.encode(), dtype=np.uint8) if as_bytes else text
    source = Source("p", content)
    for offset in offsets:
        at = min(offset, len(text))
        assert source.line(at) == text[:at].count("\n") + 1 == source.position(at)[0]


@given(st.text("X1 ();\r\n[", max_size=30))
def test_a_line_without_joins_loses_its_comments_at_once(text):
    """Beside the way that takes joined lines: it reads piece after piece."""
    line, slow = read_line(Source("p", text), 0), _joined_line(text, 0)
    assert (line.code.rstrip(), line.stop) == (slow.code.rstrip(), slow.stop)


def test_diagnostics_are_shown_as_they_are(capsys):
    """The line 100 between two colons, and what looks like markup in the text of the program."""
    from ncscope.cli.screen import console, show_diagnostics

    text = "\n" * 99 + "N1 G1 X1 I2 ;[bold]x[/] :smile:\nM30\n"
    result = ncscope.run(Machine(), text)
    show_diagnostics(result.diagnostics * 600)
    shown = capsys.readouterr().err
    (expected,) = {ncscope.render(d) for d in result.diagnostics if d.id == "20048"}
    assert "program:100:10: warning 20048" in expected
    assert shown.count(expected + "\n") == 600
    console().print("a.nc:100:3")
    assert capsys.readouterr().out == "a.nc:100:3\n"
