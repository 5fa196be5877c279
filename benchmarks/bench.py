"""What ncscope and its peers take for the same files, measured in one run.

    python benchmarks/bench.py [--blocks N] [--long N] [--runs N] [--json FILE]

Each figure is the median of so many processes, with its range. Peers come from the package index
into an environment of their own below build/bench; `rs274` is used when it is on the path. A peer
that cannot be had is named with the reason; its row stays empty.
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from programs import write

HERE = Path(__file__).parent
ROOT = HERE.parent
WORK = ROOT / "build" / "bench"
PEER = "nc-gcode-interpreter"
Row = tuple[str, str, str]


def main() -> None:
    options = _options()
    WORK.mkdir(parents=True, exist_ok=True)
    files = _files(options.blocks)
    rows: list[Row] = [
        *_lanes(files, options),
        *_whole_processes(files, options),
        *_outputs(files, options),
        *_kernels(options),
        *_limits(files, options),
        *_small(options),
        *_peers(files, options),
    ]
    if options.long:
        rows += _long(options)
    _print(rows)
    if options.json:
        Path(options.json).write_text(json.dumps({"machine": _machine(), "rows": rows}, indent=1))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])  # type: ignore[union-attr]
    parser.add_argument("--blocks", type=int, default=1_000_000, help="blocks of a program")
    parser.add_argument("--long", type=int, default=0, help="blocks of the long program")
    parser.add_argument("--runs", type=int, default=5, help="processes a figure")
    parser.add_argument("--json", help="file for the rows")
    return parser.parse_args()


def _files(blocks: int) -> dict[str, Path]:
    files = {}
    for kind in ("five_axis", "complete", "three_axis", "contour", "peers"):
        files[kind] = WORK / f"{kind}_{blocks}.nc"
        if not files[kind].exists():
            write(kind, blocks, files[kind])
    return files


# --- ncscope -----------------------------------------------------------------------------------


def _lanes(files: dict[str, Path], options: argparse.Namespace) -> list[Row]:
    """Text to PCS and ACS inside a process: the first run of it, and later ones."""
    rows = []
    kinds = (
        ("five_axis", "ca_head"),
        ("complete", "complete"),
        ("three_axis", "xyz"),
        ("contour", "xyz"),
    )
    for kind, machine in kinds:
        found = [_measure("run", machine, str(files[kind])) for _ in range(options.runs)]
        million = found[0]["moves"] / 1e6
        first = [million / f["first"]["wall"] for f in found]
        later = [million / statistics.median(t["wall"] for t in f["later"]) for f in found]
        size = files[kind].stat().st_size / 2**20
        memory = [f["peak"] - size for f in found]
        rows += [
            (f"{kind}: first run in a process", _range(first), "M blocks/s"),
            (f"{kind}: later runs", _range(later), "M blocks/s"),
            (f"{kind}: peak memory above the file", _range(memory, 0), "MB"),
        ]
    return rows


def _whole_processes(files: dict[str, Path], options: argparse.Namespace) -> list[Row]:
    """The command line from start to exit, with everything written."""
    ca_head = str(ROOT / "examples" / "machines" / "ca_head")
    rows = []
    for suffix in ("parquet", "csv"):
        out = WORK / f"out.{suffix}"
        command = _ncscope("run", str(files["five_axis"]), "-m", ca_head, "--out", str(out))
        timed = [_process(command) for _ in range(options.runs)]
        rows += _process_rows(f"ncscope run --out x.{suffix}", timed)
        if suffix == "parquet":
            first = [_compiling(command)["wall"] for _ in range(options.runs)]
            rows.append(("the same, loops compiled for the first time", _range(first, 1), "s"))
        out.unlink(missing_ok=True)
    return rows


def _compiling(command: Sequence[str]) -> dict[str, float]:
    """A process that finds no machine code on disk."""
    with tempfile.TemporaryDirectory() as empty:
        return _process(command, NUMBA_CACHE_DIR=empty)


def _outputs(files: dict[str, Path], options: argparse.Namespace) -> list[Row]:
    rows = []
    for shape in ("csv", "jsonl", "parquet"):
        arguments = ("output", "ca_head", str(files["five_axis"]), shape)
        found = [_measure(*arguments) for _ in range(options.runs)]
        seconds = [f["wall"] for f in found]
        rows.append((f"{shape} of {found[0]['moves']} moves", _range(seconds), "s"))
    return rows


def _kernels(options: argparse.Namespace) -> list[Row]:
    found = [_measure("kernels") for _ in range(options.runs)]
    rows = []
    for name in found[0]:
        values = [f[name] for f in found]
        if name.endswith("poses/s"):
            rows.append((name, _range([v / 1e6 for v in values]), "M poses/s"))
        else:
            rows.append((name.removesuffix(", us"), _range(values, 1), "us"))
    return rows


def _limits(files: dict[str, Path], options: argparse.Namespace) -> list[Row]:
    """Single stages beside what the machine can do at best."""
    found = [_measure("limits", str(files["five_axis"])) for _ in range(options.runs)]
    return [
        (name.rsplit(", ", 1)[0], _range([f[name] for f in found]), name.rsplit(", ", 1)[1])
        for name in found[0]
    ]


def _small(options: argparse.Namespace) -> list[Row]:
    """Short programs: most of the time is the start of Python."""
    five = ROOT / "examples" / "programs" / "five_axis.nc"
    plain = ROOT / "examples" / "programs" / "cs_3.nc"
    ca_head = str(ROOT / "examples" / "machines" / "ca_head")
    commands = {
        "ncscope --version": _ncscope("--version"),
        "ncscope run, 14 lines with #CS": _ncscope("run", str(plain)),
        "ncscope run, five axes with RTCP": _ncscope("run", str(five), "-m", ca_head),
    }
    rows: list[Row] = []
    for name, command in commands.items():
        _process(command)
        rows += _process_rows(name, [_process(command) for _ in range(options.runs)])[:1]
    return rows


def _long(options: argparse.Namespace) -> list[Row]:
    """Ten times the blocks: time grows with the length, memory does not."""
    lengths = (options.long // 10, options.long // 2, options.long)
    paths = [str(_long_program(blocks)) for blocks in lengths]
    timed = [_long_run(paths[-1]) for _ in range(options.runs)]
    rows = _process_rows(f"ncscope run --out x.parquet, {options.long} blocks", timed)
    found = [_measure("growth", "ca_head", *paths) for _ in range(options.runs)]
    for (few, first), (many, second) in itertools.pairwise(zip(lengths, paths, strict=True)):
        further = [(f[second] - f[first]) / (many - few) * 1e6 for f in found]
        name = f"five_axis: each further million from {few} to {many} blocks"
        rows.append((name, _range(further, 3), "s"))
    return rows


def _long_program(blocks: int) -> Path:
    path = WORK / f"five_axis_{blocks}.nc"
    if not path.exists():
        write("five_axis", blocks, path)
    return path


def _long_run(path: str) -> dict[str, float]:
    out = WORK / "out.parquet"
    ca_head = str(ROOT / "examples" / "machines" / "ca_head")
    timed = _process(_ncscope("run", path, "-m", ca_head, "--out", str(out)))
    out.unlink(missing_ok=True)
    return timed


# --- peers -------------------------------------------------------------------------------------


def _peers(files: dict[str, Path], options: argparse.Namespace) -> list[Row]:
    """Other tools over the five-axis blocks and over the contours."""
    rows: list[Row] = []
    python, rs274, runs = _peer_environment(), shutil.which("rs274"), options.runs
    for kind, what in (("peers", "five_axis"), ("contour", "contour")):
        program, million = str(files[kind]), options.blocks / 1e6
        name = f"{what}: {PEER}{'' if isinstance(python, str) else ' ' + _version(python)}"
        if isinstance(python, str):
            rows.append((name, "-", python))
        else:
            script = str(HERE / "measure.py")
            found = [_json([str(python), script, "nc_to_dataframe", program]) for _ in range(runs)]
            rates = [million / f["wall"] for f in found]
            rows.append((f"{name} nc_to_dataframe, no kinematics", _range(rates), "M blocks/s"))
        name = f"{what}: LinuxCNC rs274 -g, no kinematics"
        if rs274 is None:
            rows.append((name, "-", "rs274 is not on the path"))
        else:
            timed = [_process([rs274, "-g", program]) for _ in range(runs)]
            rates = [million / t["wall"] for t in timed]
            rows.append((name, _range(rates), "M blocks/s"))
    return rows


def _peer_environment() -> Path | str:
    """The Python of the peer's environment, or why there is none. Releases that matter need
    Python 3.12 or later."""
    home = WORK / "peers"
    python = home / "bin" / "python"
    if python.exists():
        return python
    newer = [f"python3.{minor}" for minor in (14, 13, 12)]
    candidates = [os.environ.get("PEER_PYTHON"), *map(shutil.which, newer), sys.executable]
    for base in filter(None, candidates):
        if subprocess.run([base, "-m", "venv", str(home)], capture_output=True).returncode == 0:
            pip = [str(python), "-m", "pip", "install", "--quiet", PEER]
            if subprocess.run(pip, capture_output=True).returncode == 0:
                return python
        shutil.rmtree(home, ignore_errors=True)
    return "could not be installed"


def _version(python: Path) -> str:
    code = f"import importlib.metadata as m; print(m.version('{PEER}'))"
    return subprocess.run([str(python), "-c", code], capture_output=True, text=True).stdout.strip()


# --- measuring ---------------------------------------------------------------------------------


def _ncscope(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "ncscope.cli", *arguments]


def _measure(*arguments: str) -> dict[str, Any]:
    return _json([sys.executable, str(HERE / "measure.py"), *arguments])


def _json(command: Sequence[str]) -> dict[str, Any]:
    found = subprocess.run(command, capture_output=True, text=True)
    if found.returncode:
        raise SystemExit(f"{' '.join(command)}\n{found.stderr}")
    return json.loads(found.stdout)


def _process(command: Sequence[str], **environment: str) -> dict[str, float]:
    """Wall and CPU seconds and peak memory (MB) of a whole process."""
    environment = {**os.environ, **environment}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # a warm start has its modules compiled
    begin = time.perf_counter()
    child = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment
    )
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.perf_counter() - begin
    if status:
        raise SystemExit(f"failed: {' '.join(command)}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak": usage.ru_maxrss / 1024}


def _process_rows(name: str, timed: list[dict[str, float]]) -> list[Row]:
    return [
        (f"{name}: whole process", _range([t["wall"] for t in timed]), "s"),
        (f"{name}: CPU time", _range([t["cpu"] for t in timed]), "s"),
        (f"{name}: peak memory", _range([t["peak"] for t in timed], 0), "MB"),
    ]


def _range(values: Sequence[float], digits: int = 2) -> str:
    middle = statistics.median(values)
    return f"{middle:.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def _machine() -> str:
    python = platform.python_version()
    return f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, Python {python}"


def _print(rows: list[Row]) -> None:
    print(_machine())
    width = max(len(name) for name, _, _ in rows)
    for name, value, unit in rows:
        print(f"{name:{width}}  {value:>26}  {unit}")


if __name__ == "__main__":
    main()
