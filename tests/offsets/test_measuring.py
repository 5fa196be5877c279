"""G100, G101, G102: TF5200 coordinate systems and offsets and the worked probe at 98.5."""

from dataclasses import replace

import pytest

import ncscope
from ncscope.channel.block import execute
from ncscope.channel.start import start_state
from ncscope.channel.state import Measured
from ncscope.diagnostics import Source
from ncscope.language import iterate_blocks


def result_of(text):
    return ncscope.run(ncscope.Machine(), text + "\nM30\n")


def messages_of(text, *names):
    lines = [f'#MSG SAVE EXCLUSIVE ["%f", {name}]' for name in names]
    return [float(m.text) for m in result_of("\n".join([text, *lines])).check().messages]


def test_e19_measured_offset_with_factors():
    machine = ncscope.Machine()
    state = replace(start_state(machine), measured={"X": Measured(98.5, -1.5)})
    text = "G101 X1\nX100\nG101 X7\nX100\nG91 X1\nG90\nG102\nX100\n"
    found = []
    for block, _ in iterate_blocks(Source("e19", text)):
        if block is None:
            continue
        step = execute(machine, state, block)
        assert not step.failed
        state = step.state
        found += [float(move.axes[0]) for move in step.moves]
    assert found == pytest.approx([98.5, 89.5, 90.5, 100])


def test_the_probe_triggers_at_the_target():
    result = result_of("G92 X10\nG00 X1\nG100 X100 F500\nX2\nG101 X7\nX100")
    assert [d.id for d in result.diagnostics] == ["N2024"]
    assert result.acs[:, 0] == pytest.approx([11, 110, 12, 110])
    assert list(result.motion) == ["G00", "G01", "G00", "G00"]


def test_variables():
    names = [f"V.A.{v}.{a}" for a in "XY" for v in ("MESS", "MOFFS", "MERF", "MEIN")]
    found = messages_of("G92 X10\nG100 X100 F500\nG101 X2", *names)
    assert found == pytest.approx([110, 0, 1, 0, 0, 0, 0, 0])


def test_measured_value_in_a_coordinate_system_is_the_programmed_one():
    assert messages_of("#CS ON [5,0,0]\nG100 X100 F500", "V.A.MESS.X") == pytest.approx([100])


@pytest.mark.parametrize(
    ("text", "column"), [("G101 X1", 6), ("G102 X0", 6), ("G101", 1), ("G100", 1)]
)
def test_nothing_measured(text, column):
    found = result_of(text).diagnostics
    assert [(d.id, d.column) for d in found] == [("N2025", column)]
    assert result_of("G102").ok
