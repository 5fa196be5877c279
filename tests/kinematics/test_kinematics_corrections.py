"""Results of a calibration in the list (P-CHAN-00438), and channel settings that are refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from test_kinematics_commands import HEAD, errors, machine, run

import ncscope
from ncscope.lists import check_lists
from ncscope.machine import ChannelSettings, Tool

HEAD_LISTS = Path(__file__).parents[2] / "examples" / "machines" / "ca_head"


def corrected(tmp_path: Path, *lines: str):
    """The CA head, whose flange is at (1.2, -0.32, 0.05) mm, with further lines."""
    text = (HEAD_LISTS / "sda.lis").read_text().replace("Ende", "\n".join(lines) + "\nEnde")
    for source in HEAD_LISTS.glob("*.lis"):
        (tmp_path / source.name).write_text(source.read_text())
    (tmp_path / "sda.lis").write_text(text)
    own, found = ncscope.load_machine(tmp_path)
    assert not [d for d in found if d.severity != "note"]
    return own


PROGRAM = "#KIN ID [91]\n#TRAFO ON\nX0 Y0 Z0\n#TRAFO OFF"


def test_corrections_are_added_to_the_parameters(tmp_path):
    own = corrected(tmp_path, "kinematik[91].corr[3] 5000", "kinematik[91].corr[5] -20000")
    result = run(PROGRAM, own).check()
    assert result.acs[-1, :3].round(9).tolist() == [-1.7, 0.32, 1.95]
    assert own.kinematics[91].forward([0] * 5)[0].round(9).tolist() == [1.7, -0.32, -1.95]


def test_a_program_writes_the_parameter_and_not_the_correction(tmp_path):
    own = corrected(tmp_path, "kinematik[91].corr[3] 5000")
    text = "V.G.KIN[91].PARAM[3] = V.G.KIN[91].PARAM[3] + 10000\n" + PROGRAM
    assert run(text, own).check().acs[-1, 0].round(9) == -2.7


def test_a_correction_that_breaks_the_machine_is_blamed(tmp_path):
    own = corrected(tmp_path, "kinematik[91].corr[6] 3")
    (error,) = run(PROGRAM, own).diagnostics
    assert error.id == "292009" and error.notes[-1][1].text == "kinematik[91].corr[6]"
    assert "N3009" in [d.id for d in check_lists(tmp_path)]


# --- settings ----------------------------------------------------------------------------------


def test_words_as_a_vector_are_refused():
    """P-CHAN-00177: A, B, C would be components of a direction."""
    own = machine(settings=ChannelSettings(orientation_words="VECTOR_2DOF"))
    assert errors("#TRAFO [91]", own) == [("N2001", 2, 1)]


@pytest.mark.parametrize(
    ("text", "line"), [("D1\n#TRAFO [91]", 2), ("#TRAFO [91]\nD1", 2), ("D2\n#TRAFO [91]", None)]
)
def test_tool_offsets_that_would_stay_are_refused(text, line):
    """P-CHAN-00851: only where the tool has offsets of the main axes is there a difference."""
    tools = {1: Tool(axis_offsets={1: 5.0}), 2: Tool(axis_offsets={3: 5.0})}
    own = machine(HEAD, tools=tools, settings=ChannelSettings(tool_offsets_stay=True))
    found = [d for d in run(text + "\n#TRAFO OFF", own).diagnostics if d.is_error]
    assert [(d.id, d.line) for d in found] == ([("N2001", line)] if line else [])
    plain = replace(own, settings=ChannelSettings())
    assert run(text + "\n#TRAFO OFF", plain).ok
