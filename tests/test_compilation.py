"""A few rows are computed as Python, many as machine code: both give the same bits."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

MACHINE = Path(__file__).parents[1] / "examples" / "machines" / "ca_head"

ONE_BY_ONE_THEN_COMPILED = """
import sys
import numpy as np
from ncscope import compilation, load_machine
from ncscope.kinematics import UniversalKinematics
from ncscope.kinematics.parameters import INDEX_OF_FIELD

machine = load_machine(sys.argv[1])[0]
rtcp = machine.kinematics[91]
parameters = machine.kinematic_parameters[91].with_value(INDEX_OF_FIELD["rtcp"], 0.0)
complete = UniversalKinematics.from_parameters(parameters, rtcp.axis_names)
axes = np.random.default_rng(7).uniform(-170.0, 170.0, (200, 5))
axes[0, 3:] = 0.0
axes[1, 3:] = -180.0

def one_by_one(model):
    programmed = np.array([model.program(row, 12.5) for row in axes])
    return programmed, np.array([model.inverse(row, 12.5, near=axes[0]) for row in programmed])

found = [one_by_one(model) for model in (rtcp, complete)]
assert "numba" not in sys.modules, "a few rows have loaded numba"
compilation.load()
for model, (programmed, inverse) in zip((rtcp, complete), found):
    again, back = one_by_one(model)
    assert again.tobytes() == programmed.tobytes()
    assert back.tobytes() == inverse.tobytes()
print("same bits")
"""


def test_python_and_machine_code_give_the_same_bits() -> None:
    command = [sys.executable, "-c", ONE_BY_ONE_THEN_COMPILED, str(MACHINE)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "same bits", done.stderr
