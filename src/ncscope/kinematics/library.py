"""Kinematics of the vendor's library as data sets of the universal kinematics (KIN-ID 91).

Enters: a library type and its offset parameters HD1 = param[0], HD2 = param[1] .. in list units
(0.1 um, 0.0001 degrees). Leaves: `KinematicParameters` of type 91, or the parameters that cannot be
taken over. Source of type 9: FCT-C27 8, whose numbers fix the signs. Source of the others: the
published tables of offset parameters, named in `LIBRARY`. Their figures are not published with
them, so an entry is only here where the wording of its table leaves one reading; all others are in
`NOT_DETERMINED` with the reason, and none is guessed.

The reading: offsets run from the tool towards the machine, along the positive machine axes. With
type 9 this follows from the numbers of FCT-C27 8.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.step import KinematicsError

UNITS_PER_DEGREE = 10_000.0
_PAGES = "isg-stuttgart.de/fileadmin/kernel/kernel-html/en-GB/"
_ANGLE = "ID 91 has no angle offset, and the sign of this one is not published"
_MEMBERS = "infosys.beckhoff.com, tf5240_couple_kinematics 654305547"
_TITLE_ONLY = f"only its title is published ({_MEMBERS})"
NO_CHAIN = (15, 19, 210)
_ROBOT = f"it is a robot ({_MEMBERS}) and has no three linear axes"
_DIRECTION = "its values are not published; only 0 can be taken over"

Offsets = Callable[[int], float]
"""The value of HD1, HD2 .. by its number, list units, 0 when it is not given."""


@dataclass(frozen=True, slots=True)
class LibraryKinematics:
    """One type of the library. axes: channel axes by index. fields: the ID 91 data set.

    offsets: HD numbers that are taken over, with their meaning. refused: HD numbers that may only
    be 0, with the reason.
    """

    id: int
    title: str
    axes: tuple[str, ...]
    offsets: Mapping[int, str]
    refused: Mapping[int, str]
    source: str
    fields: Callable[[Offsets], dict[str, Any]]


def to_universal(id: int, param: Mapping[int, float], new_id: int = 91) -> KinematicParameters:
    """The ID 91 data set for param[i] of library type `id`, list units.

    Raises KinematicsError 292045 for a type that is not in `LIBRARY`, 292010 for a parameter that
    cannot be taken over (`complaints` names all of them).
    """
    entry = LIBRARY.get(id)
    if entry is None:
        raise KinematicsError("292045", why_not(id))
    found = complaints(id, param)
    if found:
        raise KinematicsError("292010", found[0][1])
    fields = entry.fields(lambda number: float(param.get(number - 1, 0.0)))
    return KinematicParameters.from_fields(fields, new_id)


def complaints(id: int, param: Mapping[int, float]) -> tuple[tuple[int, str], ...]:
    """Each param index that cannot be taken over, with a sentence."""
    entry = LIBRARY[id]
    found = []
    for index, value in sorted(param.items()):
        number = index + 1
        if value == 0 or number in entry.offsets:
            continue
        why = entry.refused.get(number, f"the published table of type {id} has no HD{number}")
        found.append((index, f"HD{number} is {value:g} and cannot be taken over: {why}"))
    return (*found, *_value_complaints(id, param))


def why_not(id: int) -> str:
    """Why a type is not in `LIBRARY`."""
    known = ", ".join(str(i) for i in LIBRARY)
    reason = NOT_DETERMINED.get(id, "no public table of its parameters is known")
    return f"kinematics {id} cannot be turned into ID 91: {reason}; possible are {known}"


def instead(id: int) -> str:
    """What a user can do for a type that is not in `LIBRARY`."""
    if NOT_DETERMINED.get(id) == _ROBOT or id in NO_CHAIN:
        return "it takes a Python class of your own (--kinematics FILE.py, ids 500 to 999)"
    return "describe its axes instead: a direction for each, and a point for rotary ones"


def _value_complaints(id: int, param: Mapping[int, float]) -> list[tuple[int, str]]:
    if id == 30 and param.get(3, 0) not in (0, 1, -1):
        return [(3, f"HD4 is {param[3]:g}, but the rotation direction is 1 or -1")]
    angle = param.get(6, 0) / UNITS_PER_DEGREE
    if id == 60 and not 0 < angle < 180:
        return [(6, f"HD7 is {angle:g} degrees; the B axis has to be inclined to the Z axis")]
    if id == 60 and param.get(20, 0) not in (0, 1):
        return [(20, f"HD21 is {param[20]:g}, but it is a switch")]
    return []


def _linear(axis: int) -> dict[str, Any]:
    return {"type": 1, "orientation": [float(axis == k) for k in range(3)]}


def _rotary(direction: list[float], point: list[float]) -> dict[str, Any]:
    return {"type": 2, "orientation": direction, "point": point}


def _machine(flange: list[float], rotary: list[dict[str, Any]], mode: int) -> dict[str, Any]:
    """Three linear axes, then the rotary ones, all on the tool side, programmed with RTCP."""
    axes = [*(_linear(axis) for axis in range(3)), *rotary]
    return {
        "zero_orientation": [0.0, 0.0, 1.0],
        "zero_position": flange,
        "number_of_axes": len(axes),
        "axis": axes,
        "chain": list(range(len(axes))),
        "programming_mode": mode,
        "rtcp": 1,
    }


def _type_9(hd: Offsets) -> dict[str, Any]:
    """Head with C, then A. The flange stands HD1 below A, A stands HD2 below the reference."""
    c = [hd(7), hd(8), 0.0]
    a = [0.0, hd(8) - hd(5), -hd(2)]
    flange = [hd(7) - hd(6), hd(8) - hd(5) - hd(9), -hd(2) - hd(1)]
    return _machine(flange, [_rotary([0.0, 0.0, 1.0], c), _rotary([1.0, 0.0, 0.0], a)], 17)


def _type_22(hd: Offsets) -> dict[str, Any]:
    """Head with A, then B, through one point HD1 above the flange. X and Y carry the workpiece:
    their values count as the tool moves against the workpiece, as without a transformation."""
    rotary = [_rotary([1.0, 0.0, 0.0], [0.0] * 3), _rotary([0.0, 1.0, 0.0], [0.0] * 3)]
    return _machine([0.0, 0.0, -hd(1)], rotary, 14)


def _type_30(hd: Offsets) -> dict[str, Any]:
    """Head with A: flange -> A (HD2, HD3, HD1), A -> reference of the slide (HD6, HD7, HD8)."""
    a = [-hd(6), -hd(7), -hd(8)]
    flange = [a[0] - hd(2), a[1] - hd(3), a[2] - hd(1)]
    return _machine(flange, [_rotary([hd(4) or 1.0, 0.0, 0.0], a)], 13)


def _type_60(hd: Offsets) -> dict[str, Any]:
    """Head with C, then B inclined by HD7 against Z in the YZ plane: flange -> SP (HD1),
    SP -> B (HD4..6), B -> C (HD8..10), C -> M (HD11..13)."""
    c = [-hd(11), -hd(12), -hd(13)]
    b = [c[k] - hd(8 + k) for k in range(3)]
    sp = [b[k] - hd(4 + k) for k in range(3)]
    inclined_rad = math.radians(hd(7) / UNITS_PER_DEGREE)
    direction = [0.0, math.sin(inclined_rad), math.cos(inclined_rad)]
    flange = [sp[0], sp[1], sp[2] - hd(1)]
    machine = _machine(flange, [_rotary([0.0, 0.0, 1.0], c), _rotary(direction, b)], 19)
    return machine | {"rtcp": int(hd(21))}


LIBRARY: Mapping[int, LibraryKinematics] = {
    9: LibraryKinematics(
        9, "head with C and A", ("X", "Y", "Z", "C", "A"),
        {
            1: "Z, tool holder to A axis", 2: "Z, A axis to head reference",
            5: "Y, rotation point of C", 6: "X, rotation point of C",
            7: "static X of the head", 8: "static Y of the head",
            9: "Y, tool axis to A axis",
        },
        {3: _ANGLE, 4: _ANGLE},
        f"FCT-C27 8; {_PAGES}292664715.html", _type_9,
    ),
    22: LibraryKinematics(
        22, "head with A and B over an X Y table", ("X", "Y", "Z", "A", "B"),
        {1: "Z, tool holder to A and B axis"},
        {4: _DIRECTION, 5: _DIRECTION},
        f"{_PAGES}292705931.html", _type_22,
    ),
    30: LibraryKinematics(
        30, "head with A", ("X", "Y", "Z", "A"),
        {
            1: "Z, tool holder to A axis", 2: "X, tool holder to A axis",
            3: "Y, tool holder to A axis", 4: "sign of A, 1 or -1",
            6: "X, A axis to slide reference", 7: "Y, A axis to slide reference",
            8: "Z, A axis to slide reference",
        },
        {5: _ANGLE},
        f"{_PAGES}292727051.html", _type_30,
    ),
    60: LibraryKinematics(
        60, "head with C and an inclined B", ("X", "Y", "Z", "C", "B"),
        {
            1: "Z, tool holder to SP",
            4: "X, SP to B axis", 5: "Y, SP to B axis", 6: "Z, SP to B axis",
            7: "angle between B and Z axis",
            8: "X, B to C axis", 9: "Y, B to C axis", 10: "Z, B to C axis",
            11: "X, C axis to machine point M", 12: "Y, C axis to M", 13: "Z, C axis to M",
            21: "1: C and B are machine angles",
        },
        {
            2: "from where to where it runs is not published",
            3: "from where to where it runs is not published",
            14: _ANGLE, 15: _ANGLE,
        },
        f"{_PAGES}292777739.html", _type_60,
    ),
}  # fmt: skip
"""Types that can be turned into ID 91."""

NOT_DETERMINED: Mapping[int, str] = {
    5: _TITLE_ONLY,
    6: _TITLE_ONLY,
    7: _TITLE_ONLY,
    8: f"its table ({_PAGES}292660363.html) does not say along which axis the tool lies",
    10: "its table (infosys.beckhoff.com, tccnckintrans 15299441547) does not say along which "
    "axis the tool lies",
    11: "FCT-C27 5.2.2 says that its B axis is inclined by 45 degrees, but no offset is published",
    15: "it machines the surface of a cylinder (#CYL; infosys.beckhoff.com, "
    "tf5240_kinematic_transformation 1272858251) and is no chain of axes",
    16: f"its table ({_PAGES}292683787.html) does not say from where to where offsets run",
    19: f"three struts carry its workpiece ({_PAGES}292695563.html), which is no chain of axes",
    23: f"its table ({_PAGES}292710283.html) does not say in which sense the table turns",
    33: f"its table ({_PAGES}292731403.html) does not say in which plane the head is inclined",
    34: f"its table ({_PAGES}292739083.html) does not say in which sense the table turns",
    35: _ROBOT,
    45: _ROBOT,
    58: "FCT-C27 4.1.2 describes it as a table with A and C, but no offset is published",
    82: f"its table ({_PAGES}292834187.html) does not say in which sense the table turns",
    90: "its tables (infosys.beckhoff.com, tf5290_cnc_cutting_plus 297538955, 297533579, 297544331 "
    "and 297541643) run from the machine to the tool in some rows and the other way in others, and "
    "do not say the sense of the offsets to the tool",
    93: "its example (infosys.beckhoff.com, tf5290_cnc_cutting_plus 360249611) does not say the "
    "sense of the offsets to the tool",
    96: _ROBOT,
    210: "it couples other kinematics; convert its members",
    213: _ROBOT,
}
"""Types whose published table leaves more than one reading."""
