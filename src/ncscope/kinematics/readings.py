"""Points of the manual that can be read in two ways: which of them a kinematics follows.

The standard reading is the decided one (decisions D-1, D-5, D-7); a control that turns out to do
otherwise is met by a switch, without other data.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Reading:
    """How the parameters of KIN-ID 91 are understood.

    scaled_axes: the length of a linear axis direction scales its travel; else it is normalised.
    conformal_chain: in mode 13 the position goes through the chain without points and zero
        position; else it is X, Y, Z as programmed.
    classic_z: in modes AB, BA, CA and CB the tool points along Z at angles 0; else along the first
        named axis. AC and BC stay as they are: their second axis could not tilt a tool along Z.
    """

    scaled_axes: bool = False
    conformal_chain: bool = False
    classic_z: bool = False


STANDARD = Reading()
