"""Each rule of the parameter check, broken once."""

from __future__ import annotations

import pickle
from copy import deepcopy

import pytest

from ncscope.kinematics import (
    INDEX_OF_FIELD,
    KinematicParameters,
    KinematicsError,
    UniversalKinematics,
    validate,
)

GOOD = {
    "zero_orientation": [0, 0, 1],
    "zero_position": [54000, -395000, -950000],
    "number_of_axes": 5,
    "axis": [
        {"type": 1, "orientation": [1, 0, 0], "point": [0, 0, 0]},
        {"type": 1, "orientation": [0, 1, 0], "point": [0, 0, 0]},
        {"type": 1, "orientation": [0, 0, 1], "point": [0, 0, 0]},
        {"type": 2, "orientation": [0, 0, 1], "point": [61000, 195000, 0]},
        {"type": 2, "orientation": [1, 0, 0], "point": [0, 165000, -700000]},
    ],
    "chain": [0, 1, 2, 3, 4],
    "programming_mode": 17,
    "rtcp": 1,
}
NAMES = ["X", "Y", "Z", "C", "A"]


def parameters(changes: dict[str, float] | None = None) -> KinematicParameters:
    out = KinematicParameters.from_fields(deepcopy(GOOD))
    for name, value in (changes or {}).items():
        out = out.with_value(INDEX_OF_FIELD[name], value)
    return out


def faults(changes, axes=5, default_mode=0):
    return validate(parameters(changes), axes, default_mode, NAMES)


CASES = [
    ({"axis[0].orientation[0]": 0}, "292007", "axis 0 (X) has the direction (0, 0, 0)"),
    ({"zero_orientation[2]": 0}, "292007", "zero_orientation"),
    ({"number_of_axes": 2}, "292009", "number_of_axes is 2"),
    ({"number_of_axes": 7}, "292009", "number_of_axes is 7"),
    ({"number_of_axes": 4.5}, "292010", "number_of_axes is 4.5"),
    ({"axis[3].type": 1}, "292040", "axis 3 (C) is linear"),
    ({"axis[2].type": 2}, "292040", "axis 2 (Z) is rotary"),
    ({"axis[1].type": 0}, "292040", "axis 1 (Y) is of type 0"),
    ({"chain[0]": 1}, "292010", "leaves out axis 0 (X)"),
    ({"chain[0]": 9}, "292010", "chain is 9, 1, 2, 3, 4"),
    ({"chain[1]": 1.5}, "292010", "chain[1] is 1.5"),
    ({"axis[1].orientation[1]": 0, "axis[1].orientation[0]": 1}, "292016", "axis 1 (Y)"),
    ({"programming_mode": 11}, "292045", "programming_mode is 11"),
    ({"programming_mode": 20}, "292045", "programming_mode is 20"),
    ({"programming_mode": 3, "rtcp": 0}, "292045", "programming_mode is 3"),
    ({"programming_mode": 0, "rtcp": 0}, "292045", "programming_mode is 0"),
    ({"programming_mode": 17.5}, "292010", "programming_mode is 17.5"),
    ({"programming_mode": 10}, "20658", "has 5 axes"),
    ({"rtcp": 2}, "292010", "rtcp is 2"),
    ({"linkage_mode": 1}, "292010", "linkage"),
    ({"axis[4].point[1]": float("nan")}, "292010", "axis[4].point[1]"),
]


@pytest.mark.parametrize(("changes", "id", "text"), CASES)
def test_each_rule(changes, id, text):
    found = [fault for fault in faults(changes) if fault.id == id]
    assert any(text in fault.message for fault in found), faults(changes)
    assert all(fault.indices and fault.hint for fault in found)
    with pytest.raises(KinematicsError):
        UniversalKinematics.from_parameters(parameters(changes), NAMES)


@pytest.mark.parametrize(
    "changes", [{}, {"programming_mode": 17.0, "rtcp": 0}, {"programming_mode": 0}]
    + [{"programming_mode": mode} for mode in (*range(-1, 10), *range(12, 20))]
)  # fmt: skip
def test_accepted(changes):
    assert faults(changes) == ()


def test_the_channel_default_counts_when_the_mode_is_0():
    assert faults({"programming_mode": 0, "rtcp": 0}, default_mode=17) == ()
    assert [f.id for f in faults({"programming_mode": 0}, default_mode=11)] == ["292045"]


def test_too_few_channel_axes():
    assert [f.id for f in faults({}, axes=4)] == ["20658"]


def test_three_rotary_axes_only_with_rtcp():
    six = {f"chain[{i}]": i for i in range(6)} | {"number_of_axes": 6, "axis[5].type": 2}
    six["axis[5].orientation[1]"] = 1
    assert faults(six, axes=6) == ()
    assert [f.id for f in faults(six | {"rtcp": 0}, axes=6)] == ["292009"]
    assert [f.id for f in faults(six | {"programming_mode": 10}, axes=6)] == ["292009"]


def test_the_published_table_list_as_printed():
    """FCT-C27 4.1.2 writes `axis[0].orientation[0] 0` in four blocks, so X ends as (0, 0, 0)."""
    printed = parameters({"number_of_axes": 0, "axis[3].orientation[2]": -1})
    for _ in range(4):
        printed = printed.with_value(INDEX_OF_FIELD["axis[0].orientation[0]"], 0.0)
    first, second = validate(printed, 5, axis_names=NAMES)
    assert (first.id, first.indices) == ("292007", (8, 9, 10))
    assert first.message == "axis 0 (X) has the direction (0, 0, 0)"
    assert (second.id, second.hint) == ("292009", "5, as many axes have a type")


def test_errors_and_machines_survive_pickling():
    error = KinematicsError("292014", "no", (3,))
    assert pickle.loads(pickle.dumps(error)).rows == (3,)
    kin = UniversalKinematics.from_parameters(parameters(), NAMES)
    again = pickle.loads(pickle.dumps(kin))
    assert (again.inverse([1.0, 2, 3, 4, 5]) == kin.inverse([1.0, 2, 3, 4, 5])).all()
