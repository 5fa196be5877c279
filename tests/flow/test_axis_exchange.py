"""#CALL AX, #PUT AX, #AX DEF and their kin, #MACHINE DATA, #ERROR, #MSG with all its forms."""

from __future__ import annotations

import pytest
from test_flow_structured import go, ids

import ncscope
from ncscope.machine import Axis, Machine

FIVE = Machine(
    axes=(Axis("X", 1), Axis("Y", 2), Axis("Z", 3)),
    known_axes={
        1: Axis("X", 1), 2: Axis("Y", 2), 3: Axis("Z", 3), 4: Axis("A", 4, True),
        6: Axis("C", 6, True),
    },
)  # fmt: skip


def last(text):
    result = ncscope.run(FIVE, text + "\nM30\n").check()
    return dict(zip(result.axes, result.acs[-1].tolist(), strict=True))


def error(text):
    result = ncscope.run(FIVE, text + "\nM30\n")
    return [(d.id, d.line) for d in result.diagnostics if d.is_error]


def test_call_ax_adds_axes_and_positions_stay():
    assert last("X1 Y2\n#CALL AX [C,6,3]\nC30") == {"X": 1, "Y": 2, "Z": 0, "C": 30}
    assert last("#CALL AX [C1,6,3] [A,4,4]\nC1=30 A5")["C1"] == 30


def test_call_ax_of_an_axis_that_is_there_does_nothing():
    assert last("X1\n#CALL AX [X,1,0]\nY2") == {"X": 1, "Y": 2, "Z": 0}
    assert last("X1\n#CALL AX FAST [Y,2,1] [C,6,3]\nC2")["C"] == 2


def test_axis_that_leaves_and_comes_back_stands_where_it_stood():
    text = "#CALL AX [C,6,3]\nC30 X1\n#PUT AX [C]\nX2\n#CALL AX [C,6,3]\nX3"
    assert last(text) == {"X": 3, "Y": 0, "Z": 0, "C": 30}


@pytest.mark.parametrize("release", ["#PUT AX ALL", "#AX RELEASE ALL"])
def test_all_axes_leave(release):
    text = f"X5 Y6\n{release}\n#SET AX [Y,2,0] [X,1,1]\nY7"
    assert last(text) == {"X": 5, "Y": 7, "Z": pytest.approx(float("nan"), nan_ok=True)}
    assert error(f"{release}\nX1") == [("20200", 2)]


def test_extended_commands():
    text = "#AX DEF [NAM, NBR, IDX] [Y,2,0] [X,1,1] [Z,3,2] [C,6,3]\nC5\n"
    assert last(text)["C"] == 5
    assert last(text + "#AX DEF DEFAULT\nX9")["X"] == 9
    assert error(text + "#AX DEF DEFAULT\nC9") == [("20200", 4)]
    assert last("#AX REQUEST [NBR] [X,1,0] [C,6,3]\nC7")["C"] == 7
    assert last("#CALL AX [C,6,3]\nC7\n#AX RELEASE [C]\nX1")["X"] == 1


def test_request_of_an_axis_that_is_there_is_a_warning():
    result = ncscope.run(FIVE, "#AX REQUEST [X,1,0]\nX1\nM30\n")
    assert ids(result) == [("N2092", 1)] and result.ok


@pytest.mark.parametrize(
    ("line", "id"),
    [
        ("#CALL AX [C,6,2]", "20697"),
        ("#CALL AX [C,6,4]", "N1005"),
        ("#CALL AX [X,6,3]", "21256"),
        ("#CALL AX [C,6,3] [A,6,4]", "20888"),
        ("#CALL AX [C,6,3] [A,4,3]", "21257"),
        ("#CALL AX [C,9,3]", "20312"),
        ("#CALL AX", "20480"),
        ("#CALL AX [C 6 3]", "21251"),
        ("#AX REQUEST [IDX] [C,6,2]", "N2001"),
        ("#AX REQUEST [NAM] [X,6,3]", "N2001"),
        ("#PUT AX [X]", "N1005"),
        ("#PUT AX [Q]", "20797"),
        ("#PUT AX", "20480"),
        ("#PUT AX [5]", "20797"),
    ],
)
def test_exchange_that_is_wrong(line, id):
    assert error(f"X1\n{line}\nX2") == [(id, 2)]


def test_axes_of_an_active_system_stay():
    assert error("#CS ON [1,2,3]\n#PUT AX [Z]\nX1") == [("20684", 2)]


# --- #MACHINE DATA -----------------------------------------------------------------------------


def test_machine_data_writes_limits_and_reference():
    text = '#MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos 50000"]\nXV.A.+SWE.X'
    assert last(text)["X"] == 5
    assert last('#MACHINE DATA [AXNR=2 AXPARAM="P-AXIS-00152 70000"]\nYV.A.REF.Y')["Y"] == 7


def test_machine_data_without_effect_is_noted():
    result = ncscope.run(FIVE, '#MACHINE DATA [AX=X AXPARAM="kenngr.vmax 5" WAIT]\nX1\nM30\n')
    assert result.ok and [d.id for d in result.diagnostics] == ["N2002"]


@pytest.mark.parametrize(
    ("arguments", "id"),
    [
        ('AX=X AXPARAM="kenngr.achs_typ 2"', "N2001"),
        ('AX=Q AXPARAM="kenngr.vmax 2"', "20797"),
        ('AXNR=9 AXPARAM="kenngr.vmax 2"', "20312"),
        ('AX=X AXPARAM="kenngr.swe_pos abc"', "N1005"),
        ('AX=X AXPARAM="kenngr.swe_pos"', "N1005"),
        ("AX=X", "N1005"),
        ('AXPARAM="kenngr.vmax 2"', "N1005"),
        ("AX=X WRONG=3", "N1005"),
    ],
)
def test_machine_data_that_is_wrong(arguments, id):
    assert error(f"X1\n#MACHINE DATA [{arguments}]") == [(id, 2)]


# --- #ERROR ------------------------------------------------------------------------------------


def test_error_stops_and_warning_does_not():
    result = go("X1\n#ERROR [ID=455 RC=0 MID=3 PV1=2.5 PM1=2 PIV2=7]\nX2\nM30\n")
    assert result.ok and ids(result) == [("N2090", 2)] and len(result) == 2
    assert "455 (place 3): present value 2.5, PIV2 7" in result.diagnostics[0].message
    for reaction in (2, 7):
        result = go(f"X1\n#ERROR [ID455 RC{reaction}]\nX2\nM30\n")
        assert not result.ok and ids(result) == [("N2091", 2)] and len(result) == 1


@pytest.mark.parametrize("form", ["[ID 455 RC 2]", "[ID=P1 RC=2]", "", "[PV1=3]"])
def test_error_forms(form):
    assert ids(go(f"P1=455\n#ERROR {form}\nM30\n")) == [("N2091", 2)]


@pytest.mark.parametrize(
    "arguments", ["ID=0", "ID=1001", "RC=1", "PM1=22", "PV6=1", "ID=1 ID=2", "WRONG", "X=1"]
)
def test_error_that_is_wrong(arguments):
    assert ids(go(f"X1\n#ERROR [{arguments}]\nM30\n")) == [("N1005", 2)]


# --- #MSG --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "text"),
    [
        ('#MSG ["a"]', "a"),
        ('#MSG SYN ["a"]', "a"),
        ('#MSG SYN_ACK [HMI] ["%d %D", 2.6, -3]', "3 -3"),
        ('#MSG [PLC] ["%f", 1/4]', "0.250000"),
        ('#MSG INFO ["%s%%", "x"]', "x%"),
        ('#MSG ACK [EVENT_LOGGER] ["%S", "y"]', "y"),
    ],
)
def test_message_forms(command, text):
    result = go(f"{command}\nM30\n").check()
    assert [(m.file, m.text) for m in result.messages] == [(None, text)]


@pytest.mark.parametrize(
    ("command", "id"),
    [
        ('#MSG WRONG ["a"]', "N1005"),
        ('#MSG [NOBODY] ["a"]', "N1005"),
        ('#MSG [HMI] [PLC] ["a"]', "N1005"),
        ('#MSG SAVE SYN ["a"]', "N1005"),
        ('#MSG ["' + "%d" * 11 + '"' + ",1" * 11 + "]", "20724"),
        ('#MSG ["%d"]', "20726"),
        ('#MSG ["%d", "x"]', "20721"),
        ('#MSG ["%x", 1]', "21180"),
    ],
)
def test_message_that_is_wrong(command, id):
    assert ids(go(f"{command}\nM30\n")) == [(id, 1)]
