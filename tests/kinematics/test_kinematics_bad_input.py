"""What somebody sees who writes a command of the kinematics wrongly, or a list as an older page has
it: the id, the place, and what would have been right."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from test_kinematics_commands import COMPLETE, HEAD, LINEAR, errors, machine, polar_machine, run

import ncscope
from ncscope.kinematics import KinematicParameters
from ncscope.lists import check_lists
from ncscope.machine import ChannelSettings


def only_error(text: str, on=None):
    (error,) = [d for d in run(text, on).diagnostics if d.is_error]
    return error


@pytest.mark.parametrize(
    "command",
    ["#TRAFO ON [91]", "#TRAFO ON [OFF]", "#TRAFO ON AGAIN", "#TRAFO ON = 5", "#TRAFO OFF [91]",
     "#RTCP ON [91]", "#RTCP OFF [1]", "#TRAFO PCS OFF [500]", "#PTP ON [1]", "#PTP OFF [1]",
     "#TLC OFF [5]", "#TOOL ORI CS [3]"],
)  # fmt: skip
def test_nothing_stands_behind_these_commands(command):
    """Before, what stood there was not read: #TRAFO ON [91] switched on whatever was chosen."""
    error = only_error(f"#KIN ID [91]\n{command}")
    assert (error.id, error.line, error.column) == ("N1005", 2, 1)
    assert error.hint


@pytest.mark.parametrize("command", ["#KIN ID [91.4]", "#TRAFO [90.6]", "#TRAFO PCS ID [500.4]"])
def test_an_id_with_a_fraction_is_not_rounded(command):
    error = only_error(command)
    assert (error.id, error.line, error.column) == ("N1005", 1, command.index("[") + 2)


def test_an_unknown_type_says_what_to_do():
    sets = {id: KinematicParameters(id=id, type=id) for id in (9, 12, 600)}
    own = replace(machine(), kinematic_parameters=sets)
    assert "ncscope convert --kin 9" in only_error("#TRAFO [9]", own).hint
    assert only_error("#TRAFO [12]", own).hint == "known types: 91"
    meant = replace(machine().kinematic_parameters[91], id=51, type=51)
    error = only_error("#TRAFO [51]", replace(machine(), kinematic_parameters={51: meant}))
    assert "universal kinematics with another id needs type 91" in error.hint
    assert "--kinematics FILE.py" in only_error("#TRAFO [600]", own).hint


def test_a_mode_of_the_channel_parameter_is_not_blamed_on_the_kinematics():
    settings = ChannelSettings(orientation_mode=77)
    error = only_error(
        "#TRAFO [91]", machine(COMPLETE | {"programming_mode": 0}, settings=settings)
    )
    assert error.id == "292045" and "ori_rotation_angle (P-CHAN-00112) is 77" in error.message


def test_one_rotary_axis_is_no_plural():
    fields = COMPLETE | {"number_of_axes": 4, "chain": [0, 1, 2, 3]}
    fields["axis"] = [*LINEAR, {"type": 2, "orientation": [1, 0, 0]}]
    error = only_error("#TRAFO [91]\nA30 C10", machine(fields, "XYZAC"))
    assert error.message.startswith("the rotary axis A cannot bring the tool")


def test_mode_10_wants_axes_that_are_called_u_v_w():
    """FCT-C27 5.1. Otherwise C30 would be taken as a component of a vector."""
    fields = HEAD | {"programming_mode": 10}
    error = only_error("#TRAFO [91]", machine(fields, "XYZCAB"))
    assert error.id == "292040" and "called C, A, B" in error.message
    assert run("#TRAFO [91]\nX1\n#TRAFO OFF", machine(fields, "XYZUVW")).ok


# --- PCS transformations -----------------------------------------------------------------------


def test_a_pcs_transformation_is_chosen_where_it_is_switched_on():
    rows = run(
        "#TRAFO PCS ON [500]\nX10 Y90\n#TRAFO PCS ON\n#TRAFO PCS ON [500]\nY0", polar_machine()
    )
    assert rows.check().acs[:, 0].round(9).tolist() == [0, 10]
    text = "#TRAFO PCS ON [500]\n#TRAFO PCS ON [501]"
    assert errors(text, polar_machine()) == [("22282", 3, 1)]


@pytest.mark.parametrize(("type", "id"), [(9, "22287"), (212, "N2001"), (91, "22287")])
def test_types_that_are_no_pcs_transformation(type, id):
    """212 is one that the control has ready made; it is not modelled."""
    own = machine(program_step_parameters={10: KinematicParameters(id=10, type=type)})
    assert only_error("#TRAFO PCS ON [10]", own).id == id


def test_preset_under_a_pcs_transformation_is_refused():
    """Its value would be one of the program, its shift one of what the program is mapped to."""
    assert only_error("#TRAFO PCS ON [500]\n#PSET X5", polar_machine()).id == "N2001"


def lists(tmp_path: Path, *lines: str):
    axes = [f"gruppe[0].achse[{i}].{key}" for i in range(3)
            for key in (f"bezeichnung {'XYZ'[i]}", f"log_achs_nr {i + 1}")]  # fmt: skip
    (tmp_path / "sda.lis").write_text("\n".join([*axes, *lines, "Ende\n"]))
    return ncscope.load_machine(tmp_path)


def test_lists_may_spell_pcs_transformations_as_the_programming_manual(tmp_path):
    """P-CHAN-00262 has trafo_pcs[0].id, the page of #TRAFO PCS ID trafo_pcs[0].trafo[0].id."""
    text = ["trafo_pcs[0].trafo[0].id 10", "trafo_pcs[0].trafo[0].type 500",
            "trafo_pcs[0].trafo[0].param[1] 4", "trafo_pcs[1].id 20",
            "default_id_of_trafo_pcs[0] 10"]  # fmt: skip
    own, found = lists(tmp_path, *text)
    assert not found and own.settings.default_program_step_id == 10
    assert sorted(own.program_step_parameters) == [10, 20]
    first = own.program_step_parameters[10]
    assert (first.type, first.values[1]) == (500, 4)


def test_check_says_that_a_type_is_no_pcs_transformation(tmp_path):
    lists(tmp_path, "trafo_pcs[0].id 10", "trafo_pcs[0].type 91", "trafo_pcs[1].id 500")
    (found,) = [d for d in check_lists(tmp_path) if d.id == "N3009"]
    assert "trafo_pcs[0] will fail with 22287" in found.message and found.line == 7


def test_both_spellings_of_the_first_step_are_one_place(tmp_path):
    own, found = lists(tmp_path, "trafo[0].id 91", "kin_step[0].trafo[0].param[3] 7")
    assert not found and own.kinematic_parameters[91].get("zero_position[0]") == 7
