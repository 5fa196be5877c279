"""Moves a second of a loop with five trigonometric expressions and one move in each pass.

    python benchmarks/loop.py [--passes N] [--runs N]

The same loop is written for every peer in its own words: nc-gcode-interpreter, where the
environment of `bench.py` below build/bench has it or this Python does, and LinuxCNC's `rs274` on
the path. What is not there is named. Figures are the best of so many runs, by the clock and by
processor time, which other work on the computer does not touch.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
Times = tuple[float, float]
"""Seconds by the clock, and of processor time."""
PEER = "nc-gcode-interpreter"
PROGRAMS = {
    "ncscope": """G90 G01 F1000 P1 = 0
$FOR P1 = 1, {passes}, 1
X[50*COS[P1/10]] Y[50*SIN[P1/10]] Z[2*SIN[3*P1] - COS[P1/7]*SIN[P1/100]]
$ENDFOR
M30
""",
    PEER: """G90 G1 F1000
R1=1
WHILE R1<={passes}
X=50*COS(R1/10) Y=50*SIN(R1/10) Z=2*SIN(3*R1)-COS(R1/7)*SIN(R1/100)
R1=R1+1
ENDWHILE
M30
""",
    "rs274": """G90 G1 F1000
#1=1
o100 while [#1 LE {passes}]
X[50*COS[#1/10]] Y[50*SIN[#1/10]] Z[2*SIN[3*#1] - COS[#1/7]*SIN[#1/100]]
#1=[#1+1]
o100 endwhile
M2
""",
}
PEER_CODE = """import sys, time
from nc_gcode_interpreter import nc_to_dataframe
text = open(sys.argv[1]).read()
start, cpu = time.perf_counter(), time.process_time()
frame = nc_to_dataframe(text, iteration_limit=10**9)
print(time.perf_counter() - start, time.process_time() - cpu)
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])  # type: ignore[union-attr]
    parser.add_argument("--passes", type=int, default=100_000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name, measure in (("ncscope", _ours), (PEER, _peer), ("rs274", _rs274)):
            path = Path(folder) / f"{name}.nc"
            path.write_text(PROGRAMS[name].format(passes=options.passes), encoding="ascii")
            _show(name, measure, path, options)


def _show(name: str, measure, path: Path, options: argparse.Namespace) -> None:
    try:
        times = [measure(path, options.passes) for _ in range(options.runs)]
    except LookupError as reason:
        print(f"{name:24} {reason.args[0]}")
        return
    wall, cpu = (options.passes / min(t[i] for t in times) for i in (0, 1))
    print(f"{name:24} {wall:12,.0f} moves/s {cpu:12,.0f} per second of processor time")


def _ours(path: Path, passes: int) -> Times:
    sys.path.insert(0, str(ROOT / "src"))
    import ncscope

    start, cpu = time.perf_counter(), time.process_time()
    result = ncscope.run(ncscope.Machine(), ncscope.load_program(path))
    times = time.perf_counter() - start, time.process_time() - cpu
    if not result.ok or len(result) != passes:
        raise SystemExit("the loop did not run to its end")
    return times


def _peer(path: Path, passes: int) -> Times:
    for python in (ROOT / "build" / "bench" / "peers" / "bin" / "python", Path(sys.executable)):
        if python.exists():
            command = [str(python), "-c", PEER_CODE, str(path)]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode == 0:
                wall, cpu = map(float, done.stdout.split())
                return wall, cpu
    raise LookupError("is not installed; benchmarks/bench.py installs it below build/bench")


def _rs274(path: Path, passes: int) -> Times:
    command = shutil.which("rs274")
    if command is None:
        raise LookupError("is not on the path")
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([command, "-g", str(path)], capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.perf_counter() - start, cpu


if __name__ == "__main__":
    main()
