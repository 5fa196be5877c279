"""A server of the workbench and a page of it in Chromium, for tests and screenshots."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

TOKEN = "token-of-the-browser-tests"
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)
LOADED = (
    "() => { const s = window.ncscope?.store; return s && !s.state.running && s.revision > 0 &&"
    " s.revision === s.state.revision && (s.block !== null || s.path.moves === 0) }"
)


def chromium() -> str | None:
    """The path of a Chromium, None where there is none; NCSCOPE_CHROMIUM names another."""
    named = os.environ.get("NCSCOPE_CHROMIUM")
    found = [named] if named else [shutil.which(name) for name in NAMES]
    return next((path for path in found if path), None)


@contextmanager
def server(folder: Path, *options: str) -> Iterator[str]:
    """The address of a workbench on a folder, with its token."""
    command = [sys.executable, "-m", "ncscope.cli", "workbench", str(folder), "--no-browser"]
    process = subprocess.Popen(
        [*command, "--token", TOKEN, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True,
    )  # fmt: skip
    try:
        assert process.stdout is not None
        first = process.stdout.readline()
        assert "open http://127.0.0.1:" in first, first + process.stdout.read()
        yield first.split()[-1]
    finally:
        process.terminate()
        process.wait(timeout=20)


@contextmanager
def browser() -> Iterator[Any]:
    """A Chromium without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=chromium(), args=list(FLAGS))
        try:
            yield found
        finally:
            found.close()


def window(browser: Any, size: tuple[int, int] = (1280, 720), dark: bool = False) -> Any:
    """A window of the browser with its own cookies, for several pages."""
    scheme = "dark" if dark else "light"
    return browser.new_context(viewport={"width": size[0], "height": size[1]}, color_scheme=scheme)


class Page:
    """One page of the workbench; what a user would see and do."""

    def __init__(self, context: Any) -> None:
        self.tab = context.new_page()
        self.requests: list[str] = []
        self.faults: list[str] = []
        self.tab.on("request", lambda request: self.requests.append(request.url))
        self.tab.on("pageerror", lambda error: self.faults.append(str(error)))

    def open(self, address: str, program: str, machine: str = "") -> None:
        self.tab.goto(f"{address}&program={program}&machine={machine}")
        self.wait()

    def wait(self, condition: str = LOADED) -> None:
        self.tab.wait_for_function(condition, timeout=30_000)

    def store(self, what: str) -> Any:
        return self.tab.evaluate(f"() => window.ncscope.store.{what}")

    def revision_after(self, action) -> None:
        """Does something that runs the program again, and waits for the result."""
        before = self.store("revision")
        action()
        self.wait(f"() => window.ncscope.store.revision > {before}")
        self.wait()

    def click_line(self, line: int) -> None:
        self.tab.locator(".nc-text:not(.nc-hidden) .cm-line").nth(line - 1).click()

    def display(self) -> dict[str, dict[str, float]]:
        """The numbers on the right, by system and axis."""
        found: dict[str, dict[str, float]] = {}
        for cell in self.tab.locator(".nc-positions td").all():
            value = cell.get_attribute("data-value")
            if value:
                system = found.setdefault(cell.get_attribute("data-system"), {})
                system[cell.get_attribute("data-axis")] = float(value)
        return found

    def wait_for_row(self, row: int) -> None:
        self.wait(f"() => window.ncscope.store.block?.move?.index === {row}")
        self.tab.locator(".nc-display-head", has_text=f"move {row + 1} of").wait_for()

    def replace_line(self, line: int, text: str) -> None:
        """Types another text in place of a line."""
        self.click_line(line)
        self.tab.keyboard.press("Home")
        self.tab.keyboard.press("Shift+End")
        self.tab.keyboard.type(text)

    def close(self) -> None:
        self.tab.close(run_before_unload=False)
