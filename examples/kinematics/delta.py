"""A delta machine and a program in polar coordinates, as kinematics of the user.

    ncscope run examples/programs/delta.nc --machine examples/machines/delta \\
        --kinematics examples/kinematics/delta.py

Lengths are mm and angles degrees; parameters come from the list as they stand there, in 0.1 um.
See docs/user_kinematics.md.
"""

import numpy as np

UNITS_PER_MM = 10_000.0


class LinearDelta:
    """Three vertical carriages, each with a rod to the tool.

    The carriages stand on a circle at 90, 210 and 330 degrees; axis value i is the height of
    carriage i, at channel index i. Axes behind the third pass through.
    param[0]: length of the rods. param[1]: radius of the circle.
    """

    id = 500
    name = "delta"

    def __init__(self, param, axis_names):
        self.rod, self.radius = param[0] / UNITS_PER_MM, param[1] / UNITS_PER_MM
        if self.rod <= self.radius:
            raise ValueError("param[0], the rods, must be longer than param[1], the radius")
        angles_rad = np.radians([90.0, 210.0, 330.0])
        self.feet = self.radius * np.column_stack([np.cos(angles_rad), np.sin(angles_rad)])

    def forward(self, axes, tool_length):
        """Programmed values (m, n) for axis values (m, n): where the three rods meet."""
        program = axes.copy()
        heights = axes[:, :3]
        # |p - (foot, height)| = rod for all three; differences of two are linear in p, which
        # gives x and y as start + slope * z, and the first is a quadratic equation for z.
        inverse = np.linalg.inv(self.feet[1:] - self.feet[0])
        first = heights[:, :1]
        start = 0.5 * (heights[:, 1:] ** 2 - first**2) @ inverse.T
        slope = -(heights[:, 1:] - first) @ inverse.T
        away = start - self.feet[0]
        a = 1.0 + (slope**2).sum(axis=1)
        b = (slope * away).sum(axis=1) - first[:, 0]
        c = (away**2).sum(axis=1) + first[:, 0] ** 2 - self.rod**2
        z = (-b - np.sqrt(b**2 - a * c)) / a  # NaN where the rods do not meet
        program[:, :2] = start + slope * z[:, None]
        program[:, 2] = z - tool_length
        return program

    def inverse(self, program, tool_length, near):
        """Axis values (m, n) for programmed values (m, n): each carriage is a rod above."""
        axes = program.copy()
        for i, foot in enumerate(self.feet):
            across = ((program[:, :2] - foot) ** 2).sum(axis=1)
            height = np.sqrt(self.rod**2 - across)  # NaN where the rod is too short
            axes[:, i] = program[:, 2] + tool_length + height
        return axes

    def direction(self, axes):
        """Tool direction (m, 3) from the tip to the flange: the rods keep the tool upright."""
        return np.tile([0.0, 0.0, 1.0], (len(axes), 1))


class Polar:
    """A PCS transformation: X is programmed as radius in mm, Y as angle in degrees."""

    id = 501
    name = "polar"

    def __init__(self, param, axis_names):
        pass

    def inverse(self, program, tool_length, near):
        """Cartesian values (m, n) for radius and angle."""
        values = program.copy()
        angle_rad = np.radians(program[:, 1])
        values[:, 0] = program[:, 0] * np.cos(angle_rad)
        values[:, 1] = program[:, 0] * np.sin(angle_rad)
        return values

    def forward(self, values, tool_length):
        """Radius and angle (m, n) for Cartesian values."""
        program = values.copy()
        program[:, 0] = np.hypot(values[:, 0], values[:, 1])
        program[:, 1] = np.degrees(np.arctan2(values[:, 1], values[:, 0]))
        return program
