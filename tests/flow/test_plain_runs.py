"""Long runs of plain blocks in programs with control flow are taken together, unseen.

Positions follow by hand: see the comment of each program.
"""

from __future__ import annotations

import pytest

import ncscope
from ncscope.diagnostics import Source
from ncscope.execution import Options
from ncscope.machine import Machine
from test_lanes import assert_equal

STEPS = "".join(f"N{10 * i} X1\n" for i in range(1, 71))
"""Seventy times one millimetre under G91."""
DRILL = "%L DRILL\nG91 Z-@P1\nZ@P1\nM17\n"


def both(text: str, **options) -> ncscope.Trajectory:
    """The result with runs, which is that without."""
    assert_equal(Machine(), text, **options)
    return ncscope.run(Machine(), text, Options(bulk=True, **options))


def test_a_run_in_a_loop_is_passed_again(stepped):
    """Three passes of 70 mm; the step lane sees the loop, the head and the end alone."""
    result = both(f"G90 G1 F100 X0\nG91\n$FOR P1=1,3,1\n{STEPS}$ENDFOR\nM30\n").check()
    stepped.clear()
    ncscope.run(Machine(), f"G91 X0 F9\n$FOR P1=1,3,1\n{STEPS}$ENDFOR\nM30\n", Options(bulk=True))
    assert stepped == [1, 74]
    assert result.acs[-1, 0] == 210.0
    assert result.line[-1] == 73 and result.block[-1] == 700


def test_a_run_with_a_block_for_the_step_lane_is_read_on_from_there():
    """The file begins with a byte order mark before a subprogram; the third arc is corrected by
    more than a part of its radius, which the step lane says."""
    arcs = "G2 X2 I1\nG2 X2 I1\nG2 X2 I1.1\nG2 X2 I1\n"
    text = f"\xef\xbb\xbf%L SUB\nM17\n%MAIN\nG91 G1 F100 X0\nP1=0\n$IF P1==0\n{arcs}$ENDIF\nM30\n"
    result = both(text)
    assert [d.id for d in result.diagnostics] == ["N2030"]
    assert result.acs[-1, 0] == 8.0


def test_a_run_in_a_subprogram_file_knows_its_lines():
    text = "G91 G1 F100\nL part.nc\nL part.nc\nM30\n"
    files = {"part.nc": f"%PART\n{STEPS}M17\n"}
    result = both(text, load=lambda name: Source(name, files[name]))
    assert result.acs[-1, 0] == 140.0
    assert result.line[:70].tolist() == list(range(2, 72))
    assert {s.file for s in result.stretches} == {"part.nc"}


def test_a_modal_cycle_is_called_behind_each_block_of_a_run():
    """Every X is followed by two moves of the cycle, which runs where it is written too."""
    text = f"G91 G1 F100\nLL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\n{STEPS}M30\n{DRILL}"
    result = both(text).check()
    assert len(result) == 2 + 210
    assert result.acs[:6, 2].tolist() == [-3.0, 0.0, 0.0, -3.0, 0.0, 0.0]


def test_a_modal_cycle_that_begins_in_a_loop():
    """The first pass has 70 moves and the two of the cycle, the second 210; the loops around still
    know their passes."""
    cycle = "$IF P1==1\nLL CYCLE [NAME=DRILL MODAL_MOVE @P1=3]\n$ENDIF\n"
    text = f"G91 G1 F100\n$FOR P1=1,2,1\n{STEPS}{cycle}$ENDFOR\nM30\n{DRILL}"
    assert len(both(text).check()) == 70 + 2 + 210


def test_a_sequence_begins_and_ends_inside_a_run():
    """N200 to N400 are 21 blocks, run twice more."""
    text = f"G91 G1 F100\n{STEPS}L SEQUENCE [N200 N400 REPEAT=2]\nM30\n"
    result = both(text).check()
    assert result.acs[-1, 0] == 70.0 + 2 * 21.0


@pytest.mark.parametrize(
    ("line", "id"), [("N5 U1", "20200"), ("G2 X1 I-3", "20035"), ("X1 K5", "20048")]
)
def test_what_is_wrong_in_a_run_is_said_at_its_line(line, id):
    text = f"G91 G1 F100\n$IF 1\n{STEPS}{line}\n{STEPS}$ENDIF\nM30\n"
    result = both(text)
    assert (result.diagnostics[0].id, result.diagnostics[0].line) == (id, 73)
    assert len(result) == (141 if id == "20048" else 70)


def test_a_limit_of_blocks_ends_a_run_in_its_middle():
    result = both(f"G91 G1 F100\n$IF 1\n{STEPS}$ENDIF\nM30\n", max_blocks=32)
    assert (len(result), result.diagnostics[0].id, result.diagnostics[0].line) == (30, "N4001", 33)


def test_a_run_in_a_loop_without_end_is_found_out():
    text = f"G90 G1 F100\n$WHILE 1\n{STEPS}$ENDWHILE\nM30\n"
    for bulk in (True, False):
        (found,) = ncscope.run(Machine(), text, Options(bulk=bulk)).diagnostics
        assert (found.id, found.line) == ("N4001", 2)


def test_jumps_go_over_and_behind_runs():
    text = f"G91 G1 F100\n$GOTO N7\n{STEPS}N7: X5\n{STEPS}M30\n"
    assert both(text).check().acs[[0, -1], 0].tolist() == [5.0, 75.0]
