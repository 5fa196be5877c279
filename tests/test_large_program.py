"""A CAM program of 100,000 five-axis blocks runs in one go under RTCP."""

from pathlib import Path

import numpy as np

import ncscope

ROOT = Path(__file__).parents[1]
BLOCKS = 100_000


def program_text(values: np.ndarray) -> str:
    """Blocks as a CAM system writes them, three decimals."""
    rows = (
        f"N{i} G1 X{x:.3f} Y{y:.3f} Z{z:.3f} A{a:.3f} C{c:.3f} F2000"
        for i, (x, y, z, a, c) in enumerate(values.tolist())
    )
    return "\n".join(["#KIN ID [91]", "#TRAFO ON", *rows, "M30", ""])


def test_a_hundred_thousand_five_axis_blocks():
    machine, _ = ncscope.load_machine(ROOT / "examples" / "machines" / "ca_head")
    t = np.arange(BLOCKS) * 1e-3
    values = np.stack(
        [100 * np.cos(t), 100 * np.sin(t), t % 50, 30 * np.sin(t / 3), (t * 20) % 360], axis=1
    ).round(3)
    result = ncscope.run(machine, program_text(values))
    assert result.ok
    assert len(result) == BLOCKS
    column = {name: i for i, name in enumerate(result.axes)}
    written = result.pcs[:, [column[a] for a in "XYZAC"]]
    np.testing.assert_array_equal(written, values)
    np.testing.assert_array_equal(result.line, np.arange(3, BLOCKS + 3))
    np.testing.assert_allclose(tip(result.acs, column), values[:, :3], rtol=0, atol=1e-9)


def tip(acs: np.ndarray, column: dict[str, int]) -> np.ndarray:
    """Textbook CA head: TCP = q + c + Rz(C)[(a - c) + Rx(A)(zp - a)], lengths of the list in mm."""
    flange, c_point = np.array([1.2, -0.32, 0.05]), np.array([0.08, 0.12, 0.0])
    a_point = np.array([0.0, 0.4, 25.0])
    q = acs[:, [column[a] for a in "XYZ"]]
    a, c = np.radians(acs[:, column["A"]]), np.radians(acs[:, column["C"]])
    x, y, z = flange - a_point
    tilted = np.stack(
        [np.full_like(a, x), np.cos(a) * y - np.sin(a) * z, np.sin(a) * y + np.cos(a) * z], axis=1
    ) + (a_point - c_point)
    turned = np.stack(
        [
            np.cos(c) * tilted[:, 0] - np.sin(c) * tilted[:, 1],
            np.sin(c) * tilted[:, 0] + np.cos(c) * tilted[:, 1],
            tilted[:, 2],
        ],
        axis=1,
    )
    return q + c_point + turned


def test_other_blocks_between_plain_ones_leave_one_stretch():
    """Contours as in a 2.5-axis program: lines, arcs, a coolant word and a comment in each."""
    contour = "(pocket)\nG1 X{} Y0 M8\nG2 X{} Y1 R1\nG1 Y2\nG3 X{} Y3 I-1\nG1 Y0\n"
    lines = (contour.format(k % 50, k % 50 + 1, k % 50) for k in range(400))
    options = ncscope.Options(bulk=True)
    result = ncscope.run(ncscope.Machine(), f"G90 F900\n{''.join(lines)}M30\n", options)
    result.check()
    assert (len(result), len(result.stretches)) == (2000, 1)
    assert result.motion[:5].tolist() == ["G01", "G02", "G01", "G03", "G01"]
