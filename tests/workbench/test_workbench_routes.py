"""The questions of the page, asked without a browser."""

from __future__ import annotations

import json
import struct
import subprocess
import sys
import threading
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("starlette", reason="needs the extra workbench")
pytest.importorskip("httpx", reason="needs the extra workbench")
from starlette.applications import Starlette

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the client may be built on another library one day
    from starlette.testclient import TestClient

from ncscope.views.workbench.files import Folder
from ncscope.views.workbench.routes import routes
from ncscope.views.workbench.session import Session, Sessions

PROGRAM = """N10 G92 X5 Y-2
N20 V.G.WZ_AKT.L = 99
N30 #CS ON [100,50,0,0,0,30]
N40 #KIN ID [91]
N50 #TRAFO ON
N60 G00 X0 Y0 Z10 C0 A0
N70 G01 X10 Y5 Z2 C30 A20 F1000
N80 #TRAFO OFF
N90 M30
"""
EXAMPLES = Path(__file__).parents[2] / "examples"


class Page:
    """A page without a browser: a session, its questions, and waiting for results."""

    def __init__(self, client: TestClient, session: Session) -> None:
        self.client, self.session = client, session
        self.idle = threading.Condition()
        session.changed = self._changed

    def _changed(self) -> None:
        with self.idle:
            self.idle.notify_all()

    def wait(self) -> Any:
        with self.idle:
            assert self.idle.wait_for(lambda: not self.session.state.running, timeout=60)
        return self.session.state

    def open(self, program: str, machine: str = "") -> Any:
        self.post("/open", {"program": program, "machine": machine})
        return self.wait()

    def get(self, path: str) -> Any:
        return self.client.get(f"/api/{self.session.key}{path}")

    def post(self, path: str, body: Any = None) -> Any:
        return self.client.post(f"/api/{self.session.key}{path}", content=json.dumps(body or {}))

    def result(self) -> Any:
        return self.get(f"/result/{self.session.state.revision}").json()


@pytest.fixture
def sessions(tmp_path: Path) -> Sessions:
    (tmp_path / "head").mkdir()
    for source in (EXAMPLES / "machines" / "ca_head").iterdir():
        (tmp_path / "head" / source.name).write_bytes(source.read_bytes())
    (tmp_path / "part.nc").write_text(PROGRAM)
    return Sessions(Folder.at(tmp_path))


@pytest.fixture
def client(sessions: Sessions) -> Iterator[TestClient]:
    with TestClient(Starlette(routes=routes(sessions))) as client:
        yield client


@pytest.fixture
def page(sessions: Sessions, client: TestClient) -> Page:
    return Page(client, sessions.create())


def test_move_is_the_record_of_the_command_line(page: Page, tmp_path: Path) -> None:
    assert page.open("part.nc", "head").problem == ""
    command = [sys.executable, "-m", "ncscope.cli", "run", "part.nc", "--machine", "head"]
    out = subprocess.run(
        [*command, "--format", "jsonl"], cwd=tmp_path, capture_output=True, text=True, check=True
    ).stdout
    records = [json.loads(line) for line in out.splitlines() if '"kind":"move"' in line]
    assert len(records) == 2
    for row, record in enumerate(records):
        view = page.get(f"/move/{page.session.state.revision}/{row}").json()
        assert view["move"] == record
        assert view["explanation"]["layers"][-1]["values"] == pytest.approx(record["acs"], abs=1e-9)


def unpack(content: bytes) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    assert content[:8] == b"NCPATH01"
    (length,) = struct.unpack_from("<I", content, 8)
    header = json.loads(content[12 : 12 + length])
    arrays = {
        name: np.frombuffer(
            content, a["dtype"], int(np.prod(a["shape"])), a["offset"]
        ).reshape(a["shape"])
        for name, a in header["arrays"].items()
    }  # fmt: skip
    assert all(a["offset"] % 8 == 0 for a in header["arrays"].values())
    assert all(a["offset"] >= 12 + length for a in header["arrays"].values())
    return header, arrays


def test_path_holds_every_move(page: Page) -> None:
    revision = page.open("part.nc", "head").revision
    header, arrays = unpack(page.get(f"/path/{revision}").content)
    ends = arrays["end"] == 1
    assert header["axes"] == ["X", "Y", "Z", "C", "A"]
    assert arrays["line"][ends].tolist() == [6, 7]
    assert arrays["motion"][ends].tolist() == [0, 1]
    # the tool tips of the README's table: MCS of lines 6 and 7
    rows = np.flatnonzero(ends)
    stretch = np.searchsorted(arrays["stretch_first"], rows, side="right") - 1
    tips = (arrays["point"] + np.array(header["origin"]))[rows + stretch + 1]
    assert tips == pytest.approx(np.array([[105, 48, 10], [111.1603, 57.3301, 2]]), abs=1e-4)
    assert arrays["axes"][-1] == pytest.approx([131.1087, 20.2798, 93.7212, 30, 20], abs=1e-4)
    assert (np.diff(arrays["time"]) > 0).all()


def test_arcs_are_drawn_with_points_and_shown_as_one_move(page: Page, tmp_path: Path) -> None:
    (tmp_path / "arc.nc").write_text("G00 X10 Y0\nG17 G03 X-10 Y0 I-10 J0 F1000\nM30\n")
    revision = page.open("arc.nc").revision
    header, arrays = unpack(page.get(f"/path/{revision}").content)
    assert arrays["end"].sum() == page.result()["moves"] == 2
    middle = (arrays["point"] + np.array(header["origin"]))[3:-1]
    assert len(middle) > 10
    assert np.hypot(middle[:, 0], middle[:, 1]) == pytest.approx(10.0, abs=1e-4)
    assert page.get(f"/move/{revision}/1").json()["move"]["index"] == 1


def test_curves_mark_limits_and_poses(page: Page, tmp_path: Path) -> None:
    limits = "kopf.achs_nr 1\nkenngr.swe_neg -50000\nkenngr.swe_pos 50000\n"  # 0.1 um: 5 mm
    (tmp_path / "head" / "achs1.lis").write_text(limits)
    (tmp_path / "turn.nc").write_text(
        "#TRAFO [91]\nG01 X1 A10 F1000\nX2\nX9 A-10\nX1 A-20\n#TRAFO OFF\nM30\n"
    )
    page.open("turn.nc", "head")
    found = page.result()["events"]
    assert found["poses"] == [2]  # the tool leans to the other side in the third move
    assert [(e["axis"], e["rows"]) for e in found["limits"]] == [("X", [2])]


def test_a_message_knows_its_line(page: Page, tmp_path: Path) -> None:
    (tmp_path / "say.nc").write_text('G00 X1\n#MSG ["hello"]\nM30\n')
    page.open("say.nc")
    assert page.result()["messages"] == [
        {"file": None, "text": "hello", "source": "say.nc", "line": 2}
    ]


def test_subprograms_are_named_and_can_be_edited(page: Page, tmp_path: Path) -> None:
    (tmp_path / "sub.nc").write_text("G00 X3\nM17\n")
    (tmp_path / "main.nc").write_text("L sub.nc\nM30\n")
    page.open("main.nc")
    assert page.result()["files"]["sub.nc"] == ["sub.nc", "subprogram"]
    page.get("/text?key=sub.nc")
    page.post("/edit?key=sub.nc", {"text": "G00 X4\nM17\n"})
    revision = page.wait().revision
    move = page.get(f"/move/{revision}/0").json()["move"]
    assert (move["file"], move["line"], move["pcs"]["X"]) == ("sub.nc", 1, 4.0)


def test_playback_takes_the_time_of_the_feed(page: Page, tmp_path: Path) -> None:
    (tmp_path / "feed.nc").write_text("G01 X100 F1000\nY50\nM30\n")
    revision = page.open("feed.nc").revision
    _, arrays = unpack(page.get(f"/path/{revision}").content)
    assert arrays["time"] == pytest.approx([6.0, 9.0])  # 100 mm and 50 mm at 1000 mm/min


def test_an_edit_runs_again_and_a_save_keeps_the_rest(page: Page, tmp_path: Path) -> None:
    page.open("part.nc", "head")
    text = page.get("/text?key=part.nc")
    assert (text.text, text.headers["content-type"]) == (PROGRAM, "text/plain; charset=utf-8")
    at = PROGRAM.index("X5") + 1
    answer = page.post("/edit?key=part.nc", {"version": 0, "changes": [[at, at + 1, "6"]]})
    assert answer.json() == {"version": 1, "changed": True}
    revision = page.wait().revision
    assert page.get(f"/move/{revision}/0").json()["move"]["mcs"]["X"] == 106.0
    assert (tmp_path / "part.nc").read_text() == PROGRAM
    assert page.post("/save?key=part.nc").json() == {"version": 1, "changed": False}
    assert (tmp_path / "part.nc").read_text() == PROGRAM.replace("G92 X5", "G92 X6")


def test_a_list_is_checked_while_it_is_edited(page: Page) -> None:
    page.open("part.nc", "head")
    text = page.get("/text?key=head/sda.lis").text
    broken = text.replace("\n", "\n=== no entry\n", 1)
    page.post("/edit?key=head/sda.lis", {"text": broken})
    page.wait()
    found = [d for d in page.result()["diagnostics"] if d["file"] == "sda.lis" and d["line"] == 2]
    assert [d["id"] for d in found] == ["N3001"]


def test_characters_that_no_list_can_hold_are_refused(page: Page) -> None:
    page.open("part.nc", "head")
    answer = page.post("/edit?key=part.nc", {"version": 0, "changes": [[0, 0, "\u20ac"]]})
    assert answer.status_code == 422
    assert "Latin-1" in answer.json()["error"]


def test_an_endless_program_is_stopped(page: Page, tmp_path: Path) -> None:
    endless = "%L SUB\nN10 $WHILE 1\nN20 P1 = P1 + 1\n$ENDWHILE\nM17\n%MAIN\nP1 = 0\nLL SUB\nM30\n"
    (tmp_path / "endless.nc").write_text(endless)
    page.post("/open", {"program": "endless.nc", "machine": ""})
    page.post("/stop")
    assert page.wait().problem == "stopped"
    assert page.open("part.nc", "head").problem == ""


def test_two_pages_do_not_disturb_each_other(
    page: Page, sessions: Sessions, client: TestClient
) -> None:
    other = Page(client, sessions.create())
    page.open("part.nc", "head")
    other.open("part.nc")
    other.post("/edit?key=part.nc", {"text": "X7\nM30\n"})
    other.wait()
    assert page.get("/text?key=part.nc").text == PROGRAM
    assert (page.result()["moves"], other.result()["moves"]) == (2, 1)


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/result/99", 404),
        ("/move/1/2", 404),
        ("/move/1/-1", 404),
        ("/line/1/3", 200),
        ("/line/1/400", 404),
        ("/text?key=../secret", 422),
        ("/text", 404),
    ],
)
def test_questions_without_an_answer(page: Page, path: str, status: int) -> None:
    page.open("part.nc", "head")
    assert page.get(path).status_code == status


@pytest.mark.parametrize("body", [b"[]", b"{", b"null", b'{"program":3}', b'{"skip":["x"]}'])
def test_requests_that_no_page_sends(page: Page, body: bytes) -> None:
    answer = page.client.post(f"/api/{page.session.key}/open", content=body)
    assert answer.status_code in (200, 400)
    assert page.client.get("/api/guess/files").status_code == 410


def test_jogging_there_and_back(page: Page) -> None:
    page.open("part.nc", "head")
    axes = [1.0, 2.0, 3.0, 30.0, 20.0]
    there = page.post("/jog", {"id": 91, "axes": axes, "length": 99}).json()
    wanted = {"tip": there["tip"], "direction": there["direction"]}
    back = page.post("/jog", {"id": 91, "length": 99, "axes": [0] * 5, **wanted}).json()
    assert back[0]["axes"] == pytest.approx(axes)
    again = page.post("/jog", {"id": 91, "axes": back[1]["axes"], "length": 99}).json()
    assert again["tip"] == pytest.approx(there["tip"])
    assert (there["pose"], again["pose"]) == (1, -1)
