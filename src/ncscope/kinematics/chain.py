"""The machine as a chain of axes in mm and unit vectors.

Enters: `KinematicParameters` (list units) without faults. Leaves: `Chain` (mm).
Everything is given in the workpiece system with all axes at 0; axes on the workpiece side are
entered with the opposite direction, so no case distinction between head and table is needed.
Source: FCT-C27 sections 3 and 9, P-CHAN-00285..00295.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ncscope.kinematics.parameters import LIST_UNITS_PER_MM, KinematicParameters
from ncscope.kinematics.readings import STANDARD, Reading

Array = NDArray[np.float64]

LINEAR, ROTARY = 1, 2
POINT_VECTOR, DIRECT, CONFORMAL = 10, 12, 13
CLASSIC = {14: "AB", 15: "BA", 16: "AC", 17: "CA", 18: "BC", 19: "CB"}
"""Programming modes with two named angles, and the letters in the order they turn."""


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """One machine. Lengths in mm; arrays are indexed by axis index unless `order` says otherwise.

    zero_orientation (3,): unit vector from the tool tip to the flange, all axes at 0.
    zero_position (3,): flange position, all axes at 0.
    types (n,): 1 linear, 2 rotary. directions (n, 3): unit. points (n, 3): on the rotary axis.
    order (n,): axis indices from the workpiece to the tool.
    linkage (3, 3) and linkage_offset (3,): displacement = linkage @ axes + offset; None when off.
    """

    zero_orientation: Array
    zero_position: Array
    types: NDArray[np.int64]
    directions: Array
    points: Array
    order: NDArray[np.int64]
    linkage: Array | None
    linkage_offset: Array | None
    programming_mode: int
    rtcp: bool

    @classmethod
    def from_parameters(
        cls,
        parameters: KinematicParameters,
        default_mode: int = 0,
        reading: Reading = STANDARD,
    ) -> Chain:
        """The chain of parameters that `faults.validate` finds no fault in.

        default_mode: P-CHAN-00112, counts when the field programming_mode is 0.
        """
        v = np.asarray(parameters.values, np.float64)
        n = int(v[6])
        axes = v[7 : 7 + 7 * n].reshape(n, 7)
        linked = v[57] == 1
        table = v[58:70].reshape(3, 4)
        return cls(
            zero_orientation=unit(v[0:3]),
            zero_position=v[3:6] / LIST_UNITS_PER_MM,
            types=axes[:, 0].astype(np.int64),
            directions=_directions(axes, reading),
            points=axes[:, 4:7] / LIST_UNITS_PER_MM,
            order=v[49 : 49 + n].astype(np.int64),
            linkage=table[:, :3].copy() if linked else None,
            linkage_offset=table[:, 3] / LIST_UNITS_PER_MM if linked else None,
            programming_mode=int(v[55]) or default_mode,
            rtcp=v[56] == 1,
        )

    @property
    def n(self) -> int:
        """Number of axes that take part."""
        return len(self.types)

    @property
    def rotary(self) -> tuple[int, ...]:
        """Indices of the rotary axes, the one nearest to the workpiece first."""
        return tuple(int(a) for a in self.order if self.types[a] == ROTARY)

    def packed(self) -> tuple[Array, Array, Array, Array]:
        """joints, flange, linkage, unlinkage as the compiled loops read them (see `kernels`)."""
        a = self.order
        joints = np.column_stack([self.types[a], self.directions[a], self.points[a], a])
        flange = np.array([self.zero_orientation, self.zero_position])
        matrix = np.eye(3) if self.linkage is None else self.linkage
        offset = np.zeros(3) if self.linkage_offset is None else self.linkage_offset
        inverse = np.eye(3) if self.linkage is None else np.linalg.inv(matrix)
        linkage = np.column_stack([matrix, offset])
        unlinkage = np.column_stack([inverse, -inverse @ offset])
        return joints.astype(np.float64), flange, linkage, unlinkage


def _directions(axes: Array, reading: Reading) -> Array:
    """Directions (n, 3) of rows of type, direction, point; unit unless they scale."""
    kept = reading.scaled_axes
    return np.array([r[1:4] if kept and r[0] == LINEAR else unit(r[1:4]) for r in axes])


def unit(vector: Array) -> Array:
    """The vector with length 1; it must not be zero."""
    # Directions such as (0.99953, 0.0002, -0.0004) stand in published lists; a length other than
    # one would scale the axis, so every direction is normalised (D-1).
    return vector / np.linalg.norm(vector)
