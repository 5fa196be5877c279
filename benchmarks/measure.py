"""One measurement in a process of its own; prints one JSON object.

    python benchmarks/measure.py run MACHINE PROGRAM        text to PCS and ACS, first and later
    python benchmarks/measure.py growth MACHINE PROGRAM ..  seconds of longer and longer programs
    python benchmarks/measure.py output MACHINE PROGRAM FMT csv, jsonl or parquet of a run
    python benchmarks/measure.py kernels                    poses a second, one core
    python benchmarks/measure.py limits PROGRAM             what the stages are to be held against
    python benchmarks/measure.py nc_to_dataframe PROGRAM    the peer of that name

Seconds are wall and CPU time of the step itself; memory is the peak of the process in MB.
"""

from __future__ import annotations

import functools
import json
import resource
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).parents[1] / "examples" / "machines"
MISALIGNED = {
    "axis[0].orientation": (0.99953, 0.0002, -0.0004),
    "axis[3].orientation": (0.001, -0.0005, 0.9999993749998047),
    "axis[4].orientation": (0.9999989999995, 0.001, -0.001),
    "rtcp": (0.0,),
}
"""Directions in error by about 1e-3, as a measured machine has them, and no RTCP."""


def machine(name: str) -> Any:
    """An example machine; `complete` is the CA head with misaligned axes and rtcp 0."""
    import ncscope
    from ncscope.kinematics.parameters import INDEX_OF_FIELD

    lists = ncscope.load_machine(EXAMPLES / ("ca_head" if name == "complete" else name))[0]
    if name != "complete":
        return lists
    parameters = lists.kinematic_parameters[91]
    for field, values in MISALIGNED.items():
        for k, value in enumerate(values):
            place = f"{field}[{k}]" if len(values) > 1 else field
            parameters = parameters.with_value(INDEX_OF_FIELD[place], value)
    return replace(lists, kinematic_parameters={91: parameters})


def timed(work: Callable[[], Any]) -> dict[str, float]:
    """Wall and CPU seconds of one call."""
    wall, cpu = time.perf_counter(), time.process_time()
    work()
    return {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}


def peak() -> float:
    """Peak resident memory of this process, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def run(name: str, program: str) -> dict[str, Any]:
    import ncscope

    lists = machine(name)

    def once() -> None:
        result = ncscope.run(lists, ncscope.load_program(program))
        assert result.ok, result.diagnostics
        once.moves = len(result)  # type: ignore[attr-defined]

    first = timed(once)
    memory = peak()
    later = [timed(once) for _ in range(4)]
    moves = once.moves  # type: ignore[attr-defined]
    return {"moves": moves, "first": first, "later": later, "peak": memory}


def growth(name: str, *programs: str) -> dict[str, float]:
    """Seconds of a run of each program whose moves are not kept, by program."""
    import ncscope

    lists = machine(name)

    def drop(stretch: Any) -> None:
        pass

    def once(program: str) -> None:
        result = ncscope.run(lists, ncscope.load_program(program), sink=drop)
        assert result.ok, result.diagnostics

    once(programs[0])
    return {program: timed(lambda p=program: once(p))["wall"] for program in programs}


def output(name: str, program: str, shape: str) -> dict[str, Any]:
    import ncscope
    from ncscope.views.records import write_csv, write_jsonl

    lists = machine(name)
    result = ncscope.run(lists, ncscope.load_program(program))
    out = Path(program).with_suffix(f".{shape}")

    def write() -> None:
        if shape == "parquet":
            result.write(out)
            return
        with out.open("w", encoding="utf-8", newline="") as stream:
            if shape == "csv":
                write_csv(stream, result)
            else:
                write_jsonl(stream, result, [], True)

    found = {"moves": len(result), **timed(write), "bytes": out.stat().st_size, "peak": peak()}
    out.unlink()
    return found


def kernels() -> dict[str, float]:
    """Poses a second over a million poses, and microseconds of one pose from Python."""
    import numpy as np

    n = 1_000_000
    rng = np.random.default_rng(1)
    found: dict[str, float] = {}
    for label, name in (("RTCP", "ca_head"), ("complete", "complete")):
        kin = machine(name).kinematics[91]
        axes = rng.uniform(-40, 40, (n, 5))
        programmed = kin.program(axes, tool_length=50.0)
        steps = {
            "forward": lambda kin=kin, axes=axes: kin.forward(axes, tool_length=50.0),
            "inverse": lambda kin=kin, p=programmed, a=axes: kin.inverse(
                p, tool_length=50.0, near=a[0]
            ),
        }
        for name, work in steps.items():
            work()
            seconds = statistics.median(timed(work)["wall"] for _ in range(5))
            found[f"{label} {name}, poses/s"] = n / seconds
        one, near = programmed[0], axes[0]
        begin = time.perf_counter()
        for _ in range(5000):
            kin.inverse(one, tool_length=50.0, near=near)
        found[f"{label} inverse of one pose, us"] = (time.perf_counter() - begin) / 5000 * 1e6
    return found


def limits(program: str) -> dict[str, float]:
    """What this machine can do at best, and what single stages reach of it.

    Rates of the copy of a long array, of the search for control flow, of the scanner alone, and of
    the compiled sine with its cosine.
    """
    import numpy as np

    from ncscope import compilation
    from ncscope.language.detection import needs_layout
    from ncscope.language.scanner import Scanner

    compilation.load()
    source = ncscope_source(program)
    data = np.array(source.data)
    scanner = Scanner(data, ("X", "Y", "Z", "A", "C"))
    start = int(np.flatnonzero(data[:1000] == 10)[3]) + 1
    lines = 0

    def scan() -> None:
        nonlocal lines
        at, lines = start, 0
        while len(rows := scanner.scan(at, 1)):
            at, lines = int(rows.stops[-1]), lines + len(rows)

    copy, angles = np.empty_like(data), np.linspace(-180.0, 180.0, 1_000_000)
    seconds = {}
    for name, work in {
        "copy": lambda: np.copyto(copy, data),
        "search": lambda: needs_layout(source),
        "scan": scan,
        "sine": lambda: _all_sines()(angles),
    }.items():
        work()
        seconds[name] = statistics.median(timed(work)["wall"] for _ in range(5))
    size = len(data)
    return {
        "copy of an array, GB/s": size / seconds["copy"] / 1e9,
        "search for control flow, GB/s": size / seconds["search"] / 1e9,
        "scanner alone, GB/s": size / seconds["scan"] / 1e9,
        "scanner alone, M lines/s": lines / seconds["scan"] / 1e6,
        "sine and cosine, M pairs/s": len(angles) / seconds["sine"] / 1e6,
    }


def ncscope_source(program: str) -> Any:
    import ncscope

    return ncscope.load_program(program).source


@functools.cache
def _all_sines() -> Callable[[Any], float]:
    from numba import njit

    from ncscope.kinematics.kernels import sincos_deg

    @njit(error_model="numpy")
    def total(angles):
        found = 0.0
        for angle in angles:
            s, c = sincos_deg(angle)
            found += s + c
        return found

    return total


def nc_to_dataframe(program: str) -> dict[str, Any]:
    import nc_gcode_interpreter

    text = Path(program).read_text(encoding="ascii")
    found = timed(lambda: nc_gcode_interpreter.nc_to_dataframe(text))
    return {**found, "peak": peak()}


if __name__ == "__main__":
    print(json.dumps(globals()[sys.argv[1]](*sys.argv[2:])))
