"""The oracle file as NC programs: pose from the axes at #TRAFO ON, then one block per vector."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import ncscope
from ncscope.kinematics import KinematicParameters
from ncscope.machine import Axis, ChannelSettings, Machine

DATA = json.loads((Path(__file__).parents[1] / "data" / "kinematics.json").read_text())


def machine_of(entry: dict, ori_wcs: int = 0) -> Machine:
    axes = tuple(Axis(name, i + 1, rotary=i > 2) for i, name in enumerate(entry["channel_axes"]))
    parameters = KinematicParameters.from_fields(entry["param"])
    settings = ChannelSettings(direction_turns=bool(ori_wcs))
    return Machine(axes=axes, kinematic_parameters={91: parameters}, settings=settings)


def words(names, values) -> str:
    return " ".join(f"{name}={value:.24f}" for name, value in zip(names, values, strict=False))


def angles_of(rotation) -> tuple[float, float, float]:
    """f1, f2, f3 of R = Rz(f3) Ry(f2) Rx(f1)."""
    r = np.asarray(rotation)
    return (
        float(np.degrees(np.arctan2(r[2, 1], r[2, 2]))),
        float(np.degrees(-np.arcsin(r[2, 0]))),
        float(np.degrees(np.arctan2(r[1, 0], r[0, 0]))),
    )


def program_of(case: dict, names) -> str:
    lines = [f"V.G.WZ_AKT.L = {case['tool_length_mm']!r}"]
    start = case.get("prev_acs") or case["acs"]
    lines.append("G0 " + words(names, start))
    if "cs" in case:
        values = ",".join(repr(float(v)) for v in (*case["cs"]["t"], *angles_of(case["cs"]["R"])))
        lines.append(f"#CS ON [{values}]")
    lines += ["#KIN ID [91]", "#TRAFO ON", "N10 G0 " + words(names, case["pcs"]), "#TRAFO OFF"]
    return "\n".join([*lines, "M30"]) + "\n"


@pytest.mark.parametrize("case", DATA["vectors"], ids=lambda c: c["id"])
def test_vector_as_a_program(case):
    entry = DATA["machines"][case["machine"]]
    names = entry["channel_axes"]
    machine = machine_of(entry, case.get("cs", {}).get("ori_wcs", 0))
    result = ncscope.run(machine, program_of(case, names)).check()
    n = len(case["acs"])
    np.testing.assert_allclose(result.acs[-1, :n], case["acs"], rtol=0, atol=1e-8)
    np.testing.assert_allclose(result.pcs[-1], case["pcs"], rtol=0, atol=0)
    np.testing.assert_allclose(result.direction[-1], case["orientation"], rtol=0, atol=1e-9)
    if case["programming_mode"] != 12:
        np.testing.assert_allclose(result.mcs[-1, :3], case["tcp"], rtol=0, atol=1e-8)
    assert result.block[-1] == 10
    layers = result.explain(int(result.line[-1])).layers
    total = layers[0].values + sum(layer.change for layer in layers)
    np.testing.assert_allclose(total, result.acs[-1], rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "case", [c for c in DATA["vectors"] if "acs_other_pose" in c], ids=lambda c: c["id"]
)
def test_the_pose_at_trafo_on_is_kept(case):
    """From the twin position the same words lead to the twin solution."""
    entry = DATA["machines"][case["machine"]]
    twin = case | {"acs": case["acs_other_pose"]}
    machine = machine_of(entry, case.get("cs", {}).get("ori_wcs", 0))
    result = ncscope.run(machine, program_of(twin, entry["channel_axes"])).check()
    expected = case["acs_other_pose"]
    np.testing.assert_allclose(result.acs[-1, : len(expected)], expected, rtol=0, atol=1e-8)
