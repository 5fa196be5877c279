"""How long the workbench takes to show a program of a million blocks, and how much memory.

    python benchmarks/workbench.py [--blocks N] [--runs N]

A Chromium without a window and without a graphics card opens the page: the frame times are those
of software drawing. Needs the extras workbench and browser, and a Chromium.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from programs import write

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "workbench"))

from browser_page import Page, browser, server, window  # noqa: E402

PICTURE = "() => window.ncscope?.store.firstPath > 0 && window.ncscope.panes.scene.drawnMoves > 0"
ORBIT = """async () => {
  const { scene } = window.ncscope.panes, times = [];
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  for (let i = 0; i < 24; i++) {
    const start = performance.now();
    scene.spin(0.05);
    await frame();
    await frame();
    times.push(performance.now() - start);
  }
  return times.slice(4);
}"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])  # type: ignore[union-attr]
    parser.add_argument("--blocks", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        shutil.copytree(ROOT / "examples" / "machines" / "ca_head", folder / "machine")
        write("five_axis", options.blocks, folder / "long.nc")
        size = (folder / "long.nc").stat().st_size / 1e6
        print(f"{options.blocks} blocks, {size:.0f} MB, five axes with RTCP")
        with server(folder) as address, browser() as chrome:
            for run in range(options.runs):
                _run(chrome, address, folder, "cold" if run == 0 else "warm")


def _run(chrome: Any, address: str, folder: Path, name: str) -> None:
    context = window(chrome)
    page = Page(context)
    start = time.perf_counter()
    page.tab.goto(f"{address}&program=long.nc&machine=machine")
    page.wait(PICTURE)
    picture = time.perf_counter() - start
    page.wait()
    numbers = time.perf_counter() - start
    frames = page.tab.evaluate(ORBIT)
    start = time.perf_counter()
    page.tab.evaluate("() => window.ncscope.panes.scene.pick(0.4, 0.5)")
    picked = time.perf_counter() - start
    heap = page.tab.evaluate("() => performance.memory.usedJSHeapSize") / 1e6
    print(
        f"{name}: first picture {picture:.2f} s, numbers of the block {numbers:.2f} s, "
        f"turning {statistics.median(frames):.0f} ms a frame (longest {max(frames):.0f}), "
        f"picking {1000 * picked:.0f} ms, script heap {heap:.0f} MB, "
        f"server {_server_memory(folder):.0f} MB"
    )
    context.close()


def _server_memory(folder: Path) -> float:
    """Resident memory of the server in MB, 0 where the system does not say."""
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            command = (status.parent / "cmdline").read_bytes()
            if b"workbench" in command and str(folder).encode() in command:
                line = next(x for x in status.read_text().splitlines() if x.startswith("VmRSS"))
                return int(line.split()[1]) / 1000
        except (OSError, StopIteration):
            continue
    return 0.0


if __name__ == "__main__":
    main()
