"""#TRANSFORM, #WCS TO MCS, #MCS TO WCS: there and back, and against motions to the same place."""

from pathlib import Path

import numpy as np
import pytest

import ncscope

MACHINES = Path(__file__).parents[2] / "examples" / "machines"


def machine(name):
    return ncscope.load_machine(MACHINES / name)[0]


def printed(variable, axes):
    names = ", ".join(f"V.A.{variable}.{axis}" for axis in axes)
    formats = " ".join(["%f"] * len(axes))
    return f'#MSG ["{formats}", {names}]\n'


def numbers(result):
    return [[float(v) for v in message.text.split()] for message in result.messages]


STACK = (
    "G92 X{0} Y{1}\n#CS ADD [A] [{2},{3},{4},{0},{1},{2}]\n#CS ADD [B] [{1},{0},{3},{4},{2},{0}]\n"
)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("name", ["xyz", "ca_head"])
def test_transform_agrees_with_motions(seed, name):
    """A motion in A reads the same in B, MCS and ACS as #TRANSFORM says, and back again."""
    rng = np.random.default_rng(seed)
    found = machine(name)
    axes = found.axis_names
    values = rng.uniform(-80, 80, 5).round(3)
    place = rng.uniform(-50, 50, len(axes)).round(3)
    words = " ".join(f"{n}{v}" for n, v in zip(axes, place, strict=True))
    point = ",".join(map(str, place[:3]))
    further = " ".join(f"{n}={v}" for n, v in zip(axes[3:], place[3:], strict=True))
    further = f" [{further}]" if further else ""
    text = STACK.format(*values) + ("#TRAFO [91]\n" if len(axes) > 3 else "")
    for target in ("B", "MCS", "ACS", "A"):
        text += f"#TRANSFORM [A] [{target}] [{point}]{further}\n" + printed("TRANSFORM", axes)
        back = ",".join(f"V.A.TRANSFORM.{n}" for n in axes[:3])
        more = " ".join(f"{n}=V.A.TRANSFORM.{n}" for n in axes[3:])
        text += f"#TRANSFORM [{target}] [A] [{back}]" + (f" [{more}]\n" if more else "\n")
        text += printed("TRANSFORM", axes)
    text += f"#CS SELECT [A]\n{words}\n#CS SELECT [B]\nG91 X0\nM30\n"
    result = ncscope.run(found, text).check()
    there, back = numbers(result)[::2], numbers(result)[1::2]
    assert there[0] == pytest.approx(result.pcs[1], abs=2e-6)
    assert there[1] == pytest.approx(result.mcs[0], abs=2e-6)
    assert there[2] == pytest.approx(result.acs[0], abs=2e-6)
    for row in (*back, there[3]):
        assert row == pytest.approx(place, abs=2e-6)


@pytest.mark.parametrize("name", ["ca_head", "ac_table", "kin9_head"])
def test_converted_values_lead_to_the_same_axes(name):
    """Without a transformation V.A.MCS leads where the workpiece values lead with it."""
    found = machine(name)
    axes = found.axis_names
    place = dict(zip(axes, (10.5, -7.25, 31.0, 25.0, -14.0), strict=True))
    words = " ".join(f"{n}{v}" for n, v in place.items())
    move = " ".join(f"{n}[V.A.MCS.{n}]" for n in axes)
    given = " ".join(f"{n}=V.A.MCS.{n}" for n in axes)
    text = (
        "G92 X3 Y-4\nV.G.WZ_AKT.L=25\n#KIN ID [91]\n"
        f"#WCS TO MCS [{words}]\n{move}\n#MCS TO WCS [{given}]\n{printed('WCS', axes)}"
        f"G0 X0 Y0 Z0\n#TRAFO ON\n{words}\n#TRAFO OFF\nM30\n"
    )
    result = ncscope.run(found, text).check()
    assert result.acs[0] == pytest.approx(result.acs[-1], abs=1e-9)
    assert numbers(result)[0] == pytest.approx(list(place.values()), abs=2e-6)


@pytest.mark.parametrize(
    "form", ["[X1.5 Y-2]", "[X=1.5, Y=-2]", "[X 1.5 Y -2]", "[X[1+0.5] Y[-2]]"]
)
def test_spellings_of_axes(form):
    text = f"#KIN ID [91]\n#WCS TO MCS {form}\n{printed('MCS', 'XYZ')}"
    text += f"#WCS TO MCS X1.5 Y-2\n{printed('MCS', 'XYZ')}M30\n"
    first, second = numbers(ncscope.run(machine("ca_head"), text).check())
    assert first == second


@pytest.mark.parametrize("command", ["WCS TO MCS", "MCS TO WCS"])
def test_a_singular_position_has_no_unique_conversion(command):
    """A tool along C: a complete transformation leaves C open (21314), under RTCP it is given."""
    for rtcp, place, ids in ((0, "C30 A0", ["21314"]), (0, "C30 A1", []), (1, "C30 A0", [])):
        text = f"V.G.KIN[91].RTCP={rtcp}\n#KIN ID [91]\n#{command} [X1 {place}]\nM30\n"
        found = ncscope.run(machine("ca_head"), text).diagnostics
        assert [d.id for d in found] == ids


def test_inches():
    text = "#CS ADD [A] [25.4,0,0]\nG70\n#TRANSFORM [A] [MCS] [1,0,0]\n" + printed("TRANSFORM", "X")
    assert numbers(ncscope.run(machine("xyz"), text + "M30\n").check()) == [[2.0]]
