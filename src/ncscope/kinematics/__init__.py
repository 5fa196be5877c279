"""Axes <-> tool pose for KIN-ID 91, the universal kinematics. Knows nothing of NC programs.

Reading order: `parameters` (the 70 numbers of a data set), `chain` (the same in mm and unit
vectors), `faults` (what can be wrong with it), `kernels` (compiled loops: tool from axes, linear
axes from tool), `turning` and `orientation` (tool direction <-> rotary axes), `directions` (how a
program writes a direction), `step` (what any kinematics has to offer), `universal` (programming
modes, the public class).

Frames: the workpiece system with all axes at 0. Units: mm and degrees. Rotations follow the
right-hand rule about the entered direction. The tool direction points from the tip to the flange.
"""

from ncscope.kinematics.chain import CLASSIC, Chain
from ncscope.kinematics.faults import Fault, validate
from ncscope.kinematics.orientation import OrientationSolver
from ncscope.kinematics.parameters import (
    FIELD_OF_INDEX,
    INDEX_OF_FIELD,
    KinematicParameters,
    field_index,
)
from ncscope.kinematics.readings import Reading
from ncscope.kinematics.step import KinematicsError, KinematicStep, TwoSteps
from ncscope.kinematics.universal import UniversalKinematics, explain_status

__all__ = [
    "CLASSIC",
    "FIELD_OF_INDEX",
    "INDEX_OF_FIELD",
    "Chain",
    "Fault",
    "KinematicParameters",
    "KinematicStep",
    "KinematicsError",
    "OrientationSolver",
    "Reading",
    "TwoSteps",
    "UniversalKinematics",
    "explain_status",
    "field_index",
    "validate",
]
