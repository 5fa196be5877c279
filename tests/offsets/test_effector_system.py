"""#ECS: Z along the tool. Expected directions are written out from the axes of the machine."""

from pathlib import Path

import numpy as np
import pytest

import ncscope
from ncscope.frames import axes_in_plane, tilt

MACHINES = Path(__file__).parents[2] / "examples" / "machines"


def machine(name, **settings):
    found, _ = ncscope.load_machine(MACHINES / name)
    if not settings:
        return found
    from dataclasses import replace

    return replace(found, settings=replace(found.settings, **settings))


def directions(count=200):
    vectors = np.random.default_rng(7).normal(size=(count, 3))
    vectors[:6] = [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0), (1e-9, 0, -1), (3e-7, 1e-8, -1)]
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def test_tilt_is_the_smallest_rotation():
    for d in directions():
        matrix = tilt(d)
        assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(matrix) == pytest.approx(1.0)
        assert matrix[:, 2] == pytest.approx(d, abs=1e-12)
        # trace = 1 + 2 cos(angle); no rotation that takes Z to d is by less than their angle
        assert np.trace(matrix) == pytest.approx(1 + 2 * d[2], abs=1e-9)
    assert tilt([0, 0, -1]).tolist() == [[1, 0, 0], [0, -1, 0], [0, 0, -1]]


@pytest.mark.parametrize("kind", ["X", "Y"])
@pytest.mark.parametrize("plane,normal", [("XY", 2), ("ZX", 1), ("YZ", 0)])
def test_configured_axis_lies_in_its_plane(kind, plane, normal):
    for d in directions()[6:]:
        matrix = axes_in_plane(d, kind, plane)
        assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(matrix) == pytest.approx(1.0)
        assert matrix[:, 2] == pytest.approx(d, abs=1e-12)
        laid, other = (0, 1) if kind == "X" else (1, 0)
        assert matrix[normal, laid] == pytest.approx(0.0, abs=1e-12)
        assert matrix[normal, other] * d[normal] >= 0.0


HEAD = "#KIN ID [91]\n#TRAFO ON\nG0 X10 Y20 Z30 C{c} A{a}\n#ECS ON\n"


@pytest.mark.parametrize("c,a", [(0, 0), (0, 90), (30, 20), (-120, 75), (200, -45)])
def test_relative_z_moves_along_the_tool(c, a):
    text = HEAD.format(c=c, a=a) + f"G91 X0\nZ7\nX3\n#ECS OFF\nG90 C{c}\nM30\n"
    result = ncscope.run(machine("ca_head"), text).check()
    # the tool points along Z; A turns about X, then C about Z: (sin C sin A, -cos C sin A, cos A)
    sin_c, cos_c = np.sin(np.radians(c)), np.cos(np.radians(c))
    sin_a, cos_a = np.sin(np.radians(a)), np.cos(np.radians(a))
    tool = np.array([sin_c * sin_a, -cos_c * sin_a, cos_a])
    assert result.acs[1] == pytest.approx(result.acs[0], abs=1e-9)
    assert (result.mcs[2] - result.mcs[1])[:3] == pytest.approx(7 * tool, abs=1e-9)
    assert (result.acs[2] - result.acs[1])[:3] == pytest.approx(7 * tool, abs=1e-9)
    across = (result.mcs[3] - result.mcs[2])[:3]
    assert across @ tool == pytest.approx(0.0, abs=1e-9)
    assert np.linalg.norm(across) == pytest.approx(3.0)
    assert result.acs[4] == pytest.approx(result.acs[3], abs=1e-9)


def test_x_lies_in_the_xy_plane_where_the_list_says_so():
    text = HEAD.format(c=30, a=20) + "G91 X3\nM30\n"
    free = ncscope.run(machine("ca_head"), text).check()
    laid = ncscope.run(machine("ca_head", ecs_axis="X", ecs_plane="XY"), text).check()
    # X in the plane XY across the tool: C turns it by 30 degrees
    step = (laid.mcs[1] - laid.mcs[0])[:3]
    assert step == pytest.approx([3 * np.cos(np.radians(30)), 1.5, 0.0], abs=1e-9)
    assert (free.mcs[1] - free.mcs[0])[2] != pytest.approx(0.0, abs=1e-3)


def test_explain_shows_the_level_and_adds_up():
    text = HEAD.format(c=30, a=20) + "X1 Y2 Z3\nM30\n"
    result = ncscope.run(machine("ca_head"), text).check()
    layers = result.explain(5).layers
    names = {layer.name: layer.origin for layer in layers}
    assert names["#ECS"] == "program:4"
    total = layers[0].values + np.sum([layer.change for layer in layers], axis=0)
    assert total == pytest.approx(result.acs[-1], abs=1e-9)


def test_it_is_the_inverse_of_tool_ori_cs():
    """The tool is turned onto Z of a system; without it the effector system has the same Z."""
    text = "#TRAFO [91]\n#CS ON [1.5,0,32,14.5,0,45]\n#TOOL ORI CS\nX0 Y0 Z0\nG91 Z5\n#CS OFF\n"
    result = ncscope.run(machine("ca_head"), text + "#ECS ON\nZ-5\nM30\n").check()
    assert result.acs[-1] == pytest.approx(result.acs[-3], abs=1e-9)
