"""The report: what it holds, that it loads nothing, and that no text of a program is markup."""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ncscope.cli import app

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES, PROGRAMS = EXAMPLES / "machines", EXAMPLES / "programs"
SECTIONS = ["Machine", "Messages and warnings", "Path", "Travel", "Pole", "Kinematics", "Blocks"]


class Page(HTMLParser):
    """Tags with their attributes, headings, and the text of the cells of every table row."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.headings, self.rows, self._in = [], [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        self._in = tag
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        self._in = ""

    def handle_data(self, data):
        if self._in == "h2":
            self.headings.append(data)
        if self._in in ("td", "th", "pre") and self.rows and self.rows[-1]:
            self.rows[-1][-1] += data


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def call(*arguments):
    result = CliRunner().invoke(app, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def program(text, name="main.nc"):
    Path(name).write_text(text, encoding="latin-1")
    return Path(name)


def test_report_of_the_five_axis_example():
    source = PROGRAMS / "five_axis.nc"
    done = call("report", source, "--machine", MACHINES / "ca_head", "-o", "r.html",
                "--explain", "N60,9")  # fmt: skip
    assert done.exit_code == 0, done.output
    page = Page(Path("r.html").read_text())
    assert page.headings == [*SECTIONS, "Explained blocks"]
    assert ["sda.lis", "channel list"] in page.rows
    pictures = [a["src"] for tag, a in page.tags if tag == "img"]
    assert len(pictures) == 2
    assert all(p.startswith("data:image/svg+xml;base64,") for p in pictures)
    # N60 stands in line 9, so both choices show the same block: the kinematics is a layer of it.
    assert sum(row[:1] == ["kinematics"] for row in page.rows) == 2
    listed = [row for row in page.rows if len(row) > 4 and row[4] == "PCS"]
    assert [row[1] for row in listed] == ["30", "60", "80", "90", "110"]


def test_limits_and_swings_in_the_report(tmp_path):
    lists = tmp_path / "lists"
    lists.mkdir()
    for path in (MACHINES / "ca_head").iterdir():
        text = path.read_text("latin-1")
        if path.name == "achs1.lis":
            text = text.replace("Ende", "kenngr.swe_neg -1000000\nkenngr.swe_pos 1000000\nEnde")
        (lists / path.name).write_text(text, "latin-1")
    text = "N1 #TRAFO [91]\nN2 G00 C0 A0.5\nN3 G01 F1 C180\nN4 #TRAFO OFF\nN5 X150\nM30\n"
    assert call("report", program(text), "--machine", lists, "-o", "r.html").exit_code == 0
    page = Page(Path("r.html").read_text())
    (travel,) = (row for row in page.rows if row[:1] == ["X"] and len(row) == 8)
    assert travel[3:] == ["150.0000", "N5", "-100 to 100", "-50.0000", "beyond, first at N5"]
    assert ["C", "N3", "180.0000", "0.5000"] in page.rows
    text = Path("r.html").read_text()
    assert "N4101" in text and "N4102" in text


def test_nothing_is_loaded_and_nothing_runs():
    call("report", program("G01 F1 X1 Y2\nM30\n"), "-o", "r.html")
    page = Page(Path("r.html").read_text())
    assert {tag for tag, _ in page.tags} & {"script", "link", "iframe", "object", "base"} == set()
    for _, attributes in page.tags:
        for name in ("src", "href", "action"):
            assert attributes.get(name, "#").startswith(("#", "data:image/"))
        assert not any(name.startswith("on") for name in attributes)
    policy = [a["content"] for tag, a in page.tags if a.get("http-equiv")]
    assert policy == ["default-src 'none'; img-src data:; style-src 'unsafe-inline'"]


def test_hostile_text_is_only_text():
    evil = "<img src=x onerror=alert(1)>\"'&"
    name = "<b onload=x>.nc"
    text = f'N10 G01 F1 X1 ; {evil}\nN20 #MSG SAVE EXCLUSIVE ["<script>x</script>"]\nN30 X2 B<i>\n'
    done = call("report", program(text, name), "-o", "r.html", "--explain", "N10")
    assert done.exit_code == 1
    html = Path("r.html").read_text()
    page = Page(html)
    assert {tag for tag, _ in page.tags} & {"script", "b", "i"} == set()
    assert all(a["src"].startswith("data:") for tag, a in page.tags if tag == "img")
    assert "&lt;img src=x onerror" in html and "&lt;script&gt;" in html


def test_a_run_that_fails_is_reported_to_there():
    done = call("report", program("G01 F1 X1\nX2 B5\nM30\n"), "-o", "r.html")
    assert done.exit_code == 1
    html = Path("r.html").read_text()
    assert "1 motion blocks, stopped by an error" in html and "20200" in html


def test_an_empty_program_has_a_report():
    assert call("report", program("M30\n"), "-o", "r.html").exit_code == 0
    assert "no motion blocks" in Path("r.html").read_text()


def test_same_run_same_report():
    path = program("G01 F1 X1 Y2\nG02 X3 Y2 I1 J0\nM30\n")
    call("report", path, "-o", "a.html")
    call("report", path, "-o", "b.html")
    assert Path("a.html").read_bytes() == Path("b.html").read_bytes()


def test_a_long_run_shows_its_first_and_last_blocks():
    text = "G01 F1\n" + "".join(f"N{i} X{i % 7}\n" for i in range(1, 2001)) + "M30\n"
    call("report", program(text), "-o", "r.html")
    rows = [r for r in Page(Path("r.html").read_text()).rows if len(r) > 4 and r[4] == "PCS"]
    assert [int(r[1]) for r in rows] == [*range(1, 801), *range(1801, 2001)]


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["-o", "r.pdf"], 2, ".html"),
        (["-o", "missing/r.html"], 2, "cannot write"),
        (["-o", "r.html", "--explain", "N7"], 1, "N7"),
        (["-o", "r.html", "--explain", "X7"], 2, "N40,N60"),
        (["-o", "r.html", "--sample", "-1"], 2, "--sample"),
        (["-o", "r.html", "--sample", "nan"], 2, "--sample"),
    ],
)
def test_wrong_use(arguments, code, said):
    done = call("report", program("N1 G01 F1 X1\nM30\n"), *arguments)
    assert done.exit_code == code and said in done.output
    assert not Path("r.html").exists() and re.search("Traceback", done.output) is None
