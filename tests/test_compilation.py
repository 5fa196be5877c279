"""The first run on a machine says that it compiles; the next one finds the code on disk."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

EXAMPLES = Path(__file__).parents[1] / "examples"
SCRIPT = """
from ncscope.compilation import when_compiling
compiled = []
when_compiling(lambda: compiled.append(1))
import ncscope
machine, _ = ncscope.load_machine(sys.argv[1])
ncscope.run(machine, ncscope.load_program(sys.argv[2])).check()
print(len(compiled))
"""


def compiled_functions(cache: Path) -> int:
    arguments = [EXAMPLES / "machines" / "ca_head", EXAMPLES / "programs" / "five_axis.nc"]
    found = subprocess.run(
        [sys.executable, "-c", "import sys" + SCRIPT, *map(str, arguments)],
        env={**os.environ, "NUMBA_CACHE_DIR": str(cache)},
        capture_output=True,
        text=True,
        check=True,
    )
    return int(found.stdout)


def test_code_is_compiled_once_and_the_listener_hears_of_it(tmp_path):
    assert compiled_functions(tmp_path) > 0
    assert compiled_functions(tmp_path) == 0


def test_a_run_without_kinematics_does_not_load_numba():
    arguments = [EXAMPLES / "machines" / "xyz", EXAMPLES / "programs" / "cs_3.nc"]
    script = "import sys" + SCRIPT + "print('numba' in sys.modules)"
    found = subprocess.run(
        [sys.executable, "-c", script, *map(str, arguments)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout.split() == ["0", "False"]
