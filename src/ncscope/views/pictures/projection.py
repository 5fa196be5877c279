"""The four views of a drawing: from above, from the front, from the right, isometric.

Enters: points (..., 3) in mm. Leaves: picture coordinates (..., 2) in mm, right and up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ncscope.frames import Array


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """One direction to look from.

    right, up (3,): unit vectors of the picture. toward (3,): unit vector to the eye.
    labels: what the two edges of the picture show, empty where they show a mixture.
    """

    name: str
    right: Array
    up: Array
    labels: tuple[str, str] = ("", "")

    @property
    def toward(self) -> Array:
        return np.cross(self.right, self.up)

    def flat(self, points: Array) -> Array:
        return np.stack([points @ self.right, points @ self.up], axis=-1)


_X, _Y, _Z = np.eye(3)
VIEWS = (
    View("top", _X, _Y, ("X", "Y")),
    View("isometric", (_X + _Y) / math.sqrt(2), (-_X + _Y + 2 * _Z) / math.sqrt(6)),
    View("front", _X, _Z, ("X", "Z")),
    View("right", _Y, _Z, ("Y", "Z")),
)
