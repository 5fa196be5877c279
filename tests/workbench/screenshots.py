"""Pictures of the main states of the workbench, to be looked at; the first one is in the README.

python tests/workbench/screenshots.py [FOLDER]
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from browser_page import Page, browser, server, window

ROOT = Path(__file__).parents[2]
DOME, TABLE = "programs/dome.nc", "machines/ac_table"
REST = 1500
"""Milliseconds in which fonts and animations of the shell come to rest."""


def main() -> None:
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "screenshots"
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "examples"
        shutil.copytree(ROOT / "examples", folder)
        with server(folder) as address, browser() as chrome:
            for dark in (False, True):
                context = window(chrome, dark=dark)
                for name, state in STATES.items():
                    page = Page(context)
                    state(page, address)
                    page.tab.wait_for_timeout(REST)
                    page.tab.screenshot(path=out / f"{name}_{'dark' if dark else 'light'}.png")
                    page.close()


def overview(page: Page, address: str) -> None:
    """A table machine in the middle of a five-axis path."""
    page.open(address, DOME, TABLE)
    page.tab.locator(".nc-slider").fill("304")
    page.wait_for_row(303)
    page.tab.get_by_label("colour of the path").select_option("A")
    page.tab.get_by_role("button", name="fit the path into the view (F)").click()
    page.tab.locator(".nc-slider").blur()


def jog(page: Page, address: str) -> None:
    """Both poses of a tool position."""
    page.open(address, DOME, TABLE)
    page.tab.locator(".nc-slider").fill("200")
    page.tab.get_by_role("tab", name="Jog").click()
    page.tab.get_by_role("button", name="positions of the current block").click()


def systems(page: Page, address: str) -> None:
    """Coordinate systems in each other, and where each number comes from."""
    page.open(address, "programs/five_axis.nc", "machines/ca_head")
    page.tab.get_by_label("machine", exact=True).last.select_option("hidden")
    page.tab.get_by_role("button", name="fit the path into the view (F)").click()
    page.click_line(9)
    page.wait_for_row(1)


def broken(page: Page, address: str) -> None:
    """A program that stops, with the message at its place."""
    page.open(address, "programs/test_program_as_printed.nc", "machines/xyzac_axes")
    page.tab.get_by_role("tab", name="Messages").click()
    page.tab.locator(".nc-message.nc-error").first.click()


STATES: dict[str, Callable[[Page, str], None]] = {
    "overview": overview, "jog": jog, "systems": systems, "broken": broken,
}  # fmt: skip


if __name__ == "__main__":
    main()
