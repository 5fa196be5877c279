"""A data set to a kinematics that can be used: which type of kinematics it describes.

Type 91 is built in. Other types come from the caller as builders by type number: the control's
own library, or the kinematics of the user (500 to 999).
Source: P-CHAN-00262 (id), P-CHAN-00829 (type).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ncscope.kinematics.library import LIBRARY
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.kinematics.readings import STANDARD, Reading
from ncscope.kinematics.step import Builder, KinematicsError, KinematicStep
from ncscope.kinematics.universal import UniversalKinematics

UNIVERSAL = 91
FIRST_ID, LAST_ID = 500, 999
"""Types of the user's own kinematics."""
READY_MADE_PCS = frozenset({212})
"""PCS transformations of the control itself; none is modelled, so selecting one is refused."""


def type_of(parameters: KinematicParameters) -> int:
    """The type of a data set; 0 takes the id (P-CHAN-00829)."""
    return parameters.type or parameters.id


def can_be_pcs(type: int) -> bool:
    """Whether a control has PCS transformations (#TRAFO PCS) of this type; else error 22287."""
    return type in READY_MADE_PCS or FIRST_ID <= type <= LAST_ID


def is_known(parameters: KinematicParameters, types: Mapping[int, Builder]) -> bool:
    """Whether `build` can make a kinematics of this type."""
    return type_of(parameters) in (UNIVERSAL, *types)


def build(
    parameters: KinematicParameters,
    axis_names: Sequence[str],
    default_mode: int = 0,
    types: Mapping[int, Builder] | None = None,
    reading: Reading = STANDARD,
) -> KinematicStep:
    """The kinematics of a data set in a channel with these axes.

    default_mode: P-CHAN-00112. types: builders of further types. reading: for type 91.
    Raises KinematicsError for an unknown type, or with the first fault of the parameters.
    """
    type, parameters = type_of(parameters), parameters.corrected()
    if types and type in types:
        return types[type](parameters, axis_names, default_mode)
    if type != UNIVERSAL:
        raise KinematicsError(
            "N2001", f"type {type} is not supported", hint=_help(parameters, types)
        )
    return UniversalKinematics.from_parameters(parameters, axis_names, default_mode, reading)


def _help(parameters: KinematicParameters, types: Mapping[int, Builder] | None) -> str:
    type = type_of(parameters)
    known = ", ".join(str(t) for t in sorted({UNIVERSAL, *(types or ())}))
    if FIRST_ID <= type <= LAST_ID:
        return f"give its Python class with --kinematics FILE.py; known types: {known}"
    if type in LIBRARY:
        return f"ncscope convert --kin {type} writes its list as a data set of type {UNIVERSAL}"
    if (
        type == parameters.id
        and parameters.get("axis[0].type") == parameters.get("axis[1].type") == 1
    ):
        return f"a data set of the universal kinematics with another id needs type {UNIVERSAL}"
    return f"known types: {known}"
