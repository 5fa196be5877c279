"""Library kinematics as ID 91 data sets, against closed forms written from their tables.

The closed forms go down the head from the machine reference to the tool with scipy rotations; they
share no code with ncscope. Lengths in lists are 0.1 um, angles 0.0001 degrees.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from ncscope.kinematics import KinematicsError, UniversalKinematics
from ncscope.kinematics.library import LIBRARY, NOT_DETERMINED, complaints, to_universal
from ncscope.kinematics.parameters import INDEX_OF_FIELD

LENGTH = 83.0
KIN9_LIST = Path(__file__).parents[2] / "examples" / "machines" / "kin9_head" / "sda.lis"


def turn(axis, degrees):
    return Rotation.from_rotvec(np.radians(degrees) * np.asarray(axis, float)).as_matrix()


def tip_9(hd, q):
    x, y, z, c, a = q
    inner = turn([1, 0, 0], a) @ [0, -hd[9], -hd[1] - LENGTH]
    head = turn([0, 0, 1], c) @ (np.array([-hd[6], -hd[5], -hd[2]]) + inner)
    return np.array([x + hd[7], y + hd[8], z]) + head


def tip_22(hd, q):
    return q[:3] + turn([1, 0, 0], q[3]) @ turn([0, 1, 0], q[4]) @ [0, 0, -hd[1] - LENGTH]


def tip_30(hd, q):
    below = turn([1, 0, 0], (hd[4] or 1) * q[3]) @ [-hd[2], -hd[3], -hd[1] - LENGTH]
    return q[:3] - [hd[6], hd[7], hd[8]] + below


def tip_60(hd, q):
    incline = np.radians(hd[7])
    b_axis = [0, np.sin(incline), np.cos(incline)]
    below = turn(b_axis, q[4]) @ [-hd[4], -hd[5], -hd[6] - hd[1] - LENGTH]
    head = turn([0, 0, 1], q[3]) @ (below - [hd[8], hd[9], hd[10]])
    return q[:3] - [hd[11], hd[12], hd[13]] + head


FORMS = {
    9: (tip_9, [1, 2, 5, 6, 7, 8, 9], {}),
    22: (tip_22, [1], {}),
    30: (tip_30, [1, 2, 3, 6, 7, 8], {4: -1}),
    60: (tip_60, [1, 4, 5, 6, 8, 9, 10, 11, 12, 13], {7: 40.0}),
}


@pytest.mark.parametrize("id", sorted(FORMS))
def test_data_set_is_the_closed_form(id: int) -> None:
    rng = np.random.default_rng(id)
    form, lengths, fixed = FORMS[id]
    hd = {n: 0.0 for n in range(1, 30)} | {n: rng.uniform(-300, 300) for n in lengths} | fixed
    param = {n - 1: v * 1e4 for n, v in hd.items() if n not in (4,) or id != 30}
    if id == 30:
        param[3] = hd[4]
    axes = LIBRARY[id].axes
    parameters = to_universal(id, param).with_value(INDEX_OF_FIELD["rtcp"], 1)
    kin = UniversalKinematics.from_parameters(parameters, axes)
    for _ in range(20):
        q = np.array([*rng.uniform(-500, 500, 3), *rng.uniform(-180, 180, len(axes) - 3)])
        assert kin.forward(q, LENGTH)[0] == pytest.approx(form(hd, q), abs=1e-9)


def test_every_type_is_tested_against_a_closed_form() -> None:
    assert set(FORMS) == set(LIBRARY)
    assert not set(LIBRARY) & set(NOT_DETERMINED)


def test_type_9_gives_the_numbers_of_the_document() -> None:
    """FCT-C27 8: zero position, points of C and A."""
    hd = {1: 250000, 2: 700000, 5: 30000, 6: 7000, 7: 61000, 8: 195000, 9: 560000}
    found = to_universal(9, {n - 1: v for n, v in hd.items()})
    text = KIN9_LIST.read_text()
    printed = dict(re.findall(r"^trafo\[\d\]\.(\S+)\s+(\S+)", text, re.MULTILINE))
    printed = {k: float(v) for k, v in printed.items() if k in INDEX_OF_FIELD}
    assert len(printed) > 40
    assert {name: found.get(name) for name in printed} == printed


def test_inclined_head_reaches_twice_its_angle() -> None:
    # The table of type 60 says: largest spatial B angle 2 * HD7.
    kin = UniversalKinematics.from_parameters(to_universal(60, {6: 35e4}), "XYZCB")
    assert not kin.rtcp and kin.mode == 19
    assert kin.rotary_solver.reach == pytest.approx((0, 70))
    axes = kin.inverse([0, 0, 0, 20, 69], pose=1)
    # d = (cosC sinB, sinC sinB, cosB) of the programmed spatial angles.
    b, c = np.radians(69), np.radians(20)
    wanted = [np.cos(c) * np.sin(b), np.sin(c) * np.sin(b), np.cos(b)]
    assert kin.forward(axes)[1] == pytest.approx(wanted)
    with pytest.raises(KinematicsError, match="292014"):
        kin.inverse([0, 0, 0, 0, 71])


@pytest.mark.parametrize(
    ("id", "param", "said"),
    [
        (9, {2: 5}, "HD3 is 5 and cannot be taken over: ID 91 has no angle offset"),
        (9, {20: 1}, "the published table of type 9 has no HD21"),
        (22, {3: 1}, "HD4 is 1"),
        (30, {3: 2}, "the rotation direction is 1 or -1"),
        (60, {}, "HD7 is 0 degrees"),
        (60, {6: 4e5, 1: 3}, "HD2 is 3"),
        (60, {6: 4e5, 20: 2}, "HD21 is 2, but it is a switch"),
    ],
)
def test_what_the_table_does_not_settle_is_refused(id: int, param: dict, said: str) -> None:
    assert any(said in text for _, text in complaints(id, param))
    with pytest.raises(KinematicsError):
        to_universal(id, param)


@pytest.mark.parametrize("id", [16, 82, 70])
def test_types_without_a_settled_table_are_refused(id: int) -> None:
    with pytest.raises(KinematicsError, match=f"292045: kinematics {id} cannot be turned"):
        to_universal(id, {})
