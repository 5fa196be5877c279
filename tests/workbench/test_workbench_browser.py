"""The workbench in a real browser: what a user clicks, and what the page then shows."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser_page import Page, browser, chromium, server, window

pytest.importorskip("nicegui", reason="needs the extra workbench")
pytest.importorskip("playwright", reason="needs the extra browser")
pytestmark = pytest.mark.skipif(
    chromium() is None, reason="no Chromium is installed (apt-get install chromium)"
)

ROOT = Path(__file__).parents[2]
DOME, TABLE = "programs/dome.nc", "machines/ac_table"
HOSTILE = "<img src=x onerror=window.hacked=1>"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("workbench") / "examples"
    shutil.copytree(ROOT / "examples", place)
    (place / "zero.nc").write_text(
        "N10 G54\nN20 G00 X10 Y0 Z5\nN30 G01 X60 F1000\nN40 Y40\nN50 M30\n"
    )
    (place / "endless.nc").write_text("P1 = 0\n$WHILE 1\nP1 = P1 + 1\n$ENDWHILE\nM30\n")
    (place / "hostile.nc").write_text(
        f'X1 ({HOSTILE})\n#MSG ["{HOSTILE}"]\nX2\nX3 ; {HOSTILE}\n#{HOSTILE}\nM30\n'
    )
    return place


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    with server(folder) as found:
        yield found


@pytest.fixture(scope="module")
def chrome() -> Iterator[Any]:
    with browser() as found:
        yield window(found)


@pytest.fixture
def page(chrome: Any) -> Iterator[Page]:
    found = Page(chrome)
    yield found
    found.close()
    assert found.faults == []


def records(folder: Path, program: str, machine: str) -> list[dict[str, Any]]:
    """The moves of `ncscope run --format jsonl`."""
    command = [sys.executable, "-m", "ncscope.cli", "run", program, "--machine", machine]
    out = subprocess.run(
        [*command, "--format", "jsonl"], cwd=folder, capture_output=True, text=True, check=True
    ).stdout
    return [r for r in map(json.loads, out.splitlines()) if r["kind"] == "move"]


def test_a_line_shows_the_numbers_of_the_command_line(
    page: Page, address: str, folder: Path
) -> None:
    program, machine = "programs/five_axis.nc", "machines/ca_head"
    page.open(address, program, machine)
    for record in records(folder, program, machine)[1:3]:
        page.click_line(record["line"])
        page.wait_for_row(record["index"])
        shown = page.display()
        for system in ("pcs", "wcs", "mcs", "acs"):
            assert shown[system] == record[system]
    assert all(url.startswith(("http://127.0.0.1", "data:", "blob:")) for url in page.requests)
    assert "token" not in page.tab.url


def test_an_origin_leads_to_its_line(page: Page, address: str) -> None:
    page.open(address, "programs/five_axis.nc", "machines/ca_head")
    page.tab.locator(".nc-origins .nc-link", has_text="five_axis.nc:4").first.click()
    page.wait("() => window.ncscope.store.place.line === 4")
    assert "V.G.WZ_AKT.L" in page.tab.locator(".nc-current-line").inner_text()


def test_path_timeline_and_keys_move_one_selection(page: Page, address: str) -> None:
    page.open(address, DOME, TABLE)
    page.tab.locator(".nc-slider").fill("200")
    page.wait_for_row(199)
    page.tab.keyboard.press("Escape")
    page.tab.locator(".nc-brand").click()
    page.tab.keyboard.press("ArrowRight")
    page.wait_for_row(200)
    page.tab.keyboard.press("PageUp")
    page.wait_for_row(199)
    assert "ran 433 times" in page.tab.locator(".nc-runs").inner_text()
    assert "N100" in page.tab.locator(".nc-current-line").inner_text()
    page.tab.keyboard.press("End")
    page.wait_for_row(435)


def test_a_picked_move_is_selected(page: Page, address: str) -> None:
    page.open(address, "zero.nc")
    for row in (2, 1):
        x, y = page.tab.evaluate(f"() => window.ncscope.panes.scene.pixelOf({row})")
        page.tab.mouse.click(x, y)
        page.wait_for_row(row)
    assert page.tab.locator(".nc-current-line").inner_text() == "N30 G01 X60 F1000"


def test_the_path_moves_with_a_zero_offset(page: Page, address: str) -> None:
    page.open(address, "zero.nc")
    before = page.store("path.low")
    page.revision_after(lambda: page.replace_line(1, "N10 V.G.NP[1].V.X = 25 G54"))
    assert page.store("result.diagnostics.length") == 0
    assert page.store("path.high[0]") - 60 == 25
    assert page.store("path.low[1]") == before[1]


def test_a_broken_list_is_marked_at_its_line(page: Page, address: str, folder: Path) -> None:
    page.open(address, DOME, TABLE)
    before = (folder / TABLE / "sda.lis").read_bytes()
    page.tab.get_by_role("tab", name="sda.lis").click()
    page.tab.locator(".nc-text:not(.nc-hidden) .cm-line").nth(3).wait_for()
    page.revision_after(lambda: page.replace_line(3, "gruppe[0].achse[0].log_achs_nr none"))
    assert page.tab.locator(".nc-text:not(.nc-hidden) .cm-lint-marker-warning").count() > 0
    page.tab.get_by_role("tab", name="Messages").click()
    page.tab.locator(".nc-message.nc-warning", has_text="sda.lis:3").first.wait_for()
    assert (folder / TABLE / "sda.lis").read_bytes() == before
    page.revision_after(lambda: page.replace_line(3, "gruppe[0].achse[0].log_achs_nr 1   # mine"))
    page.tab.keyboard.press("Control+s")
    page.wait("() => !document.querySelector('.nc-file-tab.nc-chosen').textContent.includes('*')")
    after = (folder / TABLE / "sda.lis").read_bytes()
    lines = list(zip(before.split(b"\n"), after.split(b"\n"), strict=True))
    assert [i for i, (a, b) in enumerate(lines) if a != b] == [2]


def test_jogging_moves_the_machine_as_the_server_computes(page: Page, address: str) -> None:
    page.open(address, DOME, TABLE)
    page.tab.get_by_role("tab", name="Jog").click()
    page.tab.get_by_label("tool length in mm").fill("100")
    for name, value in (("X", 10), ("C", 30), ("A", -20)):
        field = page.tab.get_by_label(f"position of axis {name}")
        field.fill(str(value))
        field.press("Enter")
    page.wait(
        "() => [...document.querySelectorAll('.nc-jog-pose')]"
        ".some((row) => Math.abs(JSON.parse(row.dataset.axes)[4] + 20) < 1e-6)"
    )
    drawn = page.tab.evaluate("() => window.ncscope.panes.scene.tip.position.toArray()")
    poses = page.tab.locator(".nc-jog-pose")
    found = [json.loads(poses.nth(i).get_attribute("data-axes")) for i in range(2)]
    assert any(axes == pytest.approx([10, 0, 0, 30, -20], abs=1e-6) for axes in found)
    tip = [float(page.tab.get_by_label(f"tool tip {a}").input_value()) for a in "XYZ"]
    assert tip != [0, 0, 0]
    assert drawn == pytest.approx(tip, abs=1e-3)


def test_text_of_a_program_never_becomes_a_part_of_the_page(page: Page, address: str) -> None:
    page.open(address, "hostile.nc")
    page.tab.get_by_role("tab", name="Messages").click()
    page.tab.locator(".nc-message", has_text="onerror").first.wait_for()
    page.tab.keyboard.press("ArrowRight")
    assert page.tab.evaluate("() => window.hacked") is None
    assert page.tab.locator("img").count() == 0


def test_an_endless_program_is_stopped_from_the_page(page: Page, address: str) -> None:
    page.tab.goto(f"{address}&program=endless.nc&machine=")
    page.tab.get_by_role("button", name="stop the run").click()
    page.wait("() => window.ncscope.store.state.problem === 'stopped'")
    assert "stopped" in page.tab.locator(".nc-status-text").inner_text()


def test_two_pages_do_not_disturb_each_other(page: Page, chrome: Any, address: str) -> None:
    other = Page(chrome)
    page.open(address, DOME, TABLE)
    other.open(address, "zero.nc")
    other.revision_after(lambda: other.replace_line(2, "N20 G00 X-5"))
    other.tab.keyboard.press("Escape")
    assert page.store("result.moves") == 436
    assert page.store("revision") == 1
    assert other.store("path.low[0]") == -5
    other.close()


def test_a_reload_shows_the_same_program(page: Page, address: str) -> None:
    page.open(address, DOME, TABLE)
    page.tab.reload()
    page.wait()
    assert page.store("state.program") == DOME
    assert page.store("state.machine") == TABLE


def test_playback_runs_to_the_end(page: Page, address: str) -> None:
    page.open(address, "zero.nc")
    page.tab.get_by_label("speed of the playback").select_option("100")
    page.tab.locator(".nc-brand").click()
    page.tab.keyboard.press(" ")
    page.wait("() => window.ncscope.store.cursor === 3 && !window.ncscope.store.playing")


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Host": "evil.example", "Cookie": "yes"},
        {"Origin": "http://evil.example", "Cookie": "yes"},
    ],
)
@pytest.mark.parametrize("path", ["/", "/_nicegui_ws/socket.io/?EIO=4&transport=polling"])
def test_the_running_server_refuses_strangers(
    address: str, headers: dict[str, str], path: str
) -> None:
    base, token = address.split("/?token=")
    own = f"ncscope_{base.rsplit(':', 1)[1]}={token}"
    given = {k: own if v == "yes" else v for k, v in headers.items()}
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(urllib.request.Request(base + path, headers=given), timeout=10)
    assert refused.value.code == 403
    with urllib.request.urlopen(
        urllib.request.Request(base + "/", headers={"Cookie": own}), timeout=10
    ) as answer:
        assert answer.status == 200
