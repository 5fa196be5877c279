"""Random machines, and the same machines as a physical tree that shares no code with ncscope.

The tree is built as a machine builder would: a table branch and a tool branch from the machine
base, each axis with its physical direction. Only the parameter writer negates the table's axes.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from ncscope.kinematics import KinematicParameters


def unit(rng, n=3):
    v = rng.normal(size=n)
    return v / np.linalg.norm(v)


class Machine:
    """zero, flange, kinds, physical directions, points, table branch, tool branch (base first)."""

    def __init__(self, rng, rotary, linear_first=False):
        n = 3 + rotary
        self.n = n
        self.zero = unit(rng)
        self.flange = rng.uniform(-300, 300, 3)
        near_axes = np.eye(3) + rng.uniform(-0.2, 0.2, (3, 3))
        self.directions = np.vstack([near_axes, rng.normal(size=(rotary, 3))])
        self.directions /= np.linalg.norm(self.directions, axis=1)[:, None]
        self.points = rng.uniform(-400, 400, (n, 3))
        places = list(rng.permutation(n)) if not linear_first else self._linear_together(rng)
        cut = int(rng.integers(0, n + 1))
        self.chain = [int(a) for a in places]
        self.table = self.chain[:cut][::-1]  # base first, workpiece last
        self.tool = self.chain[cut:]

    def _linear_together(self, rng):
        rotary = list(range(3, self.n))
        at = int(rng.integers(0, len(rotary) + 1))
        return [*rotary[:at], 0, 1, 2, *rotary[at:]]

    def _branch(self, axes, q):
        out = np.eye(4)
        for a in axes:
            step = np.eye(4)
            if a < 3:
                step[:3, 3] = q[a] * self.directions[a]
            else:
                turn = Rotation.from_rotvec(np.radians(q[a]) * self.directions[a]).as_matrix()
                step[:3, :3] = turn
                step[:3, 3] = self.points[a] - turn @ self.points[a]
            out = out @ step
        return out

    def tool_pose(self, q, length):
        """Tool tip and direction in the workpiece system: inv(W) @ T."""
        t = np.linalg.inv(self._branch(self.table, q)) @ self._branch(self.tool, q)
        tip = self.flange - length * self.zero
        return (t @ [*tip, 1.0])[:3], t[:3, :3] @ self.zero

    def parameters(self, mode, rtcp, scale=1.0):
        sign = [-1.0 if a in self.table else 1.0 for a in range(self.n)]
        return KinematicParameters.from_fields(
            {
                "zero_orientation": list(self.zero * scale),
                "zero_position": list(self.flange * 1e4),
                "number_of_axes": self.n,
                "axis": [
                    {
                        "type": 1 if a < 3 else 2,
                        "orientation": list(self.directions[a] * sign[a] * scale),
                        "point": list(self.points[a] * 1e4),
                    }
                    for a in range(self.n)
                ],
                "chain": self.chain,
                "programming_mode": mode,
                "rtcp": rtcp,
            }
        )
