"""Pictures: what is in the files, what a long run loses, and what bad input gets."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from typer.testing import CliRunner

import ncscope
from ncscope.cli import app
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.views.pictures.chain import chain_scene
from ncscope.views.pictures.files import chain_picture, path_picture
from ncscope.views.pictures.labels import Label, draw_labels
from ncscope.views.pictures.path import tool_path
from ncscope.views.pictures.projection import VIEWS
from ncscope.views.pictures.reduce import envelope, polyline

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES, PROGRAMS = EXAMPLES / "machines", EXAMPLES / "programs"
SVG = "{http://www.w3.org/2000/svg}"
WITH_CHAIN = sorted(
    p.name for p in MACHINES.iterdir() if "chain[0]" in (p / "sda.lis").read_text("latin-1")
)


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


def ids(svg):
    return {e.get("id") for e in ElementTree.fromstring(svg).iter() if e.get("id")}


def segments(svg, id):
    """Line segments of the path in the group `id`."""
    (group,) = (e for e in ElementTree.fromstring(svg).iter(f"{SVG}g") if e.get("id") == id)
    return sum(p.get("d").count("L") for p in group.iter(f"{SVG}path"))


# --- the path ----------------------------------------------------------------------------------


def test_svg_of_a_path_has_a_segment_for_each_move_in_each_view():
    text = "G00 X10 Y5 Z3\nG01 F100 X20 Y7 Z4\nX30 Y9 Z3\nX40 Y5 Z9\nG00 X0 Y0 Z1\nM30\n"
    assert call("plot", program(text), "-o", "x.svg").exit_code == 0
    svg = Path("x.svg").read_bytes()
    for view in ("top", "front", "right", "isometric"):
        assert segments(svg, f"{view}-feed") == 3
        # Two rapids apart from each other: one at the start, one at the end.
        assert segments(svg, f"{view}-rapid") == 2
    assert {"curve-X", "curve-Y", "curve-Z"} <= ids(svg)


def test_the_path_is_the_tool_tip_in_the_machine_system():
    # G54 shifts by 10; the system turned by 90 degrees about Z at (100, 0, 0) makes X to Y.
    text = (
        "V.G.NP[1].V.X = 10\nG54\n#CS ON [100,0,0,0,0,90]\nG00 X5 Y0 Z0\n#CS OFF\nG01 F1 X0\nM30\n"
    )
    path = tool_path(ncscope.run(ncscope.Machine(), text))
    assert path.end.tolist() == pytest.approx(np.array([[110, 5, 0], [10, 5, 0]]))
    assert path.start[1] == pytest.approx([110, 5, 0]) and path.rapid.tolist() == [True, False]
    triads = {t.name: t for t in path.triads}
    assert list(triads) == ["MCS", "WCS G54", "#CS 1"]
    assert triads["WCS G54"].origin == pytest.approx([10, 0, 0])
    assert triads["#CS 1"].origin == pytest.approx([110, 0, 0])
    assert triads["#CS 1"].axes == pytest.approx(np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]))


def test_same_run_same_bytes():
    result = ncscope.run(ncscope.Machine(), "G01 F1 X1 Y2 Z3\nX4\nM30\n")
    for form in ("svg", "png", "html"):
        assert path_picture(result, "p", form) == path_picture(result, "p", form)


def test_limits_are_drawn_and_blocks_beyond_them_marked():
    axes = (ncscope.machine.Axis("X", 1, limits=(0.0, 10.0)),)
    result = ncscope.run(ncscope.Machine("m", axes), "G01 F1 X5\nX12\nM30\n")
    svg = path_picture(result, "p", "svg").decode()
    assert "travel 0 to 10 mm" in svg and svg.count("#c62828") >= 2


def test_a_program_name_is_no_formula_and_no_markup():
    result = ncscope.run(ncscope.Machine(), "G01 F1 X1 Y2 Z3\nM30\n")
    name = r"$\frac{1}$<script>alert(1)</script>%{x}"
    svg = path_picture(result, name, "svg")
    ElementTree.fromstring(svg)
    assert b"<script" not in svg and rb"$\frac{1}$" in svg
    page = path_picture(result, name, "html").decode()
    assert "<script>alert" not in page and "%{x}\u003c" not in page


@pytest.mark.parametrize("form", ["html"])
def test_html_loads_nothing(form):
    result = ncscope.run(ncscope.Machine(), "G01 F1 X1 Y2 Z3\nM30\n")
    page = path_picture(result, "p", form).decode()
    assert re.findall(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=", page) == []
    assert "Plotly.newPlot" in page and len(page) > 1_000_000


# --- the chain ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", WITH_CHAIN)
def test_every_machine_of_the_manual_has_a_picture(name):
    done = call("plot", "--machine", MACHINES / name, "-o", "chain.svg")
    if name == "ac_table_as_printed":  # a printed slip makes two directions zero vectors
        assert done.exit_code == 1 and "292007" in done.output
        return
    assert done.exit_code == 0
    machine, _ = ncscope.load_machine(MACHINES / name)
    found = ids(Path("chain.svg").read_bytes())
    for axis in machine.axis_names:
        assert any(re.fullmatch(f"isometric-axis-{axis}(-toward|-away)?", i) for i in found)
    assert {"isometric-zero-orientation", "top-zero-position-point", "chain"} <= found


def test_machines_with_a_chain():
    assert len(WITH_CHAIN) == 9


def test_parts_stand_where_the_list_says():
    machine, _ = ncscope.load_machine(MACHINES / "kin9_head")
    scene = chain_scene(machine.kinematics[91], tool_length=20.0)
    parts = {p.id: p for p in scene.parts}
    assert parts["zero-position"].point == pytest.approx([5.4, -39.5, -95])
    assert parts["tool-tip"].point == pytest.approx([5.4, -39.5, -115])
    assert parts["axis-C"].point == pytest.approx([6.1, 19.5, 0])
    line = parts["axis-A"].line
    way = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    assert way == pytest.approx([1, 0, 0]) and line[:, 1:] == pytest.approx(
        np.array([[16.5, -70], [16.5, -70]])
    )
    assert [box.name for box in scene.boxes] == ["X", "Y", "Z", "C", "A"]


def test_a_turn_is_drawn_right_handed():
    machine, _ = ncscope.load_machine(MACHINES / "ac_table")
    for part in chain_scene(machine.kinematics[91]).parts:
        if part.turn is not None:
            way = part.line[1] - part.line[0]
            centre = part.turn.mean(axis=0)
            sense = np.cross(part.turn[:-1] - centre, part.turn[1:] - centre) @ way
            assert (sense > 0).all()


def test_a_forgotten_sign_is_marked():
    machine, _ = ncscope.load_machine(MACHINES / "ac_table")
    parameters = machine.kinematic_parameters[91]
    right = chain_scene(machine.kinematics[91]).boxes
    assert [(b.remark, b.side, b.doubtful) for b in right[:2]] == [
        ("−Z", "workpiece side", False),
        ("−X", "workpiece side", False),
    ]
    wrong = parameters.with_value(8 + 7 * 3 + 2, 1.0)  # the C axis turned round
    boxes = chain_scene(UniversalKinematics.from_parameters(wrong, machine.axis_names)).boxes
    assert (boxes[0].remark, boxes[0].side, boxes[0].doubtful) == ("+Z", "not inverted?", True)
    linear = parameters.with_value(7 + 1, -1.0)  # the X axis
    boxes = chain_scene(UniversalKinematics.from_parameters(linear, machine.axis_names)).boxes
    assert (boxes[2].remark, boxes[2].side, boxes[2].doubtful) == ("−X", "against X?", True)


def test_arrows_to_the_eye_and_away_from_it():
    """C of the head points up: to the eye from above. Y points away from the eye in front."""
    machine, _ = ncscope.load_machine(MACHINES / "ca_head")
    found = ids(chain_picture(machine.kinematics[91], "m", 0.0, "svg"))
    assert {"top-axis-C-toward", "front-axis-Y-away", "right-axis-X-toward"} <= found
    assert {v.name: v.toward.tolist() for v in VIEWS[2:]} == {
        "front": [0, -1, 0],
        "right": [1, 0, 0],
    }


def test_chain_as_png_and_html():
    for name in ("c.png", "c.html"):
        assert call("plot", "--machine", MACHINES / "cb_head", "-o", name).exit_code == 0
    assert Path("c.png").read_bytes().startswith(b"\x89PNG")
    assert "kinematics 91" in Path("c.html").read_text()


# --- long runs ---------------------------------------------------------------------------------


def test_a_short_line_is_left_as_it_is():
    start, end = np.array([[0.0, 0], [1, 0], [5, 5]]), np.array([[1.0, 0], [1, 1], [6, 5]])
    line = polyline(start, end, 10)
    assert np.array_equal(
        line.points, [[0, 0], [1, 0], [1, 1], [np.nan] * 2, [5, 5], [6, 5]], equal_nan=True
    )
    assert line.rows.tolist() == [0, 0, 1, 2, 2, 2] and line.hidden == 1


@pytest.mark.parametrize("columns", [2, 3])
def test_a_long_line_keeps_its_corners_and_loses_repetitions(columns):
    # A square of 100 steps an edge, gone round 500 times.
    edge = np.linspace(0, 1, 100, endpoint=False)
    square = np.concatenate(
        [np.c_[edge, 0 * edge], np.c_[0 * edge + 1, edge], np.c_[1 - edge, 0 * edge + 1],
         np.c_[0 * edge, 1 - edge]]
    )  # fmt: skip
    points = np.zeros((500 * 400 + 1, columns))
    points[:-1, :2] = np.tile(square, (500, 1))
    line = polyline(points[:-1], points[1:], 1000)
    drawn = line.points[~np.isnan(line.points[:, 0])]
    assert len(line.points) <= 3 * 400 and line.hidden == 1
    for corner in ((0, 0), (1, 0), (1, 1), (0, 1)):
        assert np.abs(drawn[:, :2] - corner).max(axis=1).min() < 1e-3


def test_wild_lines_say_how_many_segments_are_hidden():
    points = np.random.default_rng(1).uniform(size=(5001, 2))
    line = polyline(points[:-1], points[1:], 1000)
    assert line.hidden == 5


def test_an_envelope_keeps_every_peak():
    values = np.zeros(100_000)
    values[[777, 50_001, 99_500]] = 5, -7, 9
    values[-1] = np.nan
    rows = envelope(values, 100)
    assert {0, 777, 50_001, 99_500, 99_999} <= set(rows.tolist()) and len(rows) <= 202


# --- bad input ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["x.pdf", "x", "x.svgz", ".png"])
def test_unknown_suffix(name):
    done = call("plot", program("G01 X1\nM30\n"), "-o", name)
    assert done.exit_code == 2 and ".png, .svg or .html" in done.output


def test_a_file_that_cannot_be_written():
    done = call("plot", program("G01 F1 X1\nM30\n"), "-o", "missing/x.svg")
    assert done.exit_code == 2 and "cannot write" in done.output


def test_a_program_is_not_overwritten():
    path = program("G01 F1 X1\nM30\n", "main.svg")
    assert call("plot", path, "-o", path).exit_code == 2
    assert path.read_text().startswith("G01")


@pytest.mark.parametrize("text", ["", "M30\n", "; nothing\nM30\n", "G01 X1 B5\n"])
def test_a_program_without_moves(text):
    done = call("plot", program(text), "-o", "x.svg")
    assert done.exit_code == 1 and "no motion blocks" in done.output and not Path("x.svg").exists()


def test_a_run_that_fails_is_drawn_up_to_there():
    done = call("plot", program("G01 F1 X1\nX2 B5\nX9\nM30\n"), "-o", "x.svg")
    assert done.exit_code == 1 and "20200" in done.output
    assert segments(Path("x.svg").read_bytes(), "top-feed") == 1


def test_neither_program_nor_machine():
    assert call("plot", "-o", "x.svg").exit_code == 2


def test_machines_without_a_chain():
    done = call("plot", "--machine", MACHINES / "xyz", "-o", "x.svg")
    assert done.exit_code == 2 and "no kinematics" in done.output
    done = call("plot", "--machine", MACHINES / "ca_head", "--id", 7, "-o", "x.svg")
    assert done.exit_code == 2 and "91" in done.output


@pytest.mark.parametrize("axes", [1, 2])
def test_channels_with_few_axes(axes):
    channel = tuple(ncscope.machine.Axis(n, i + 1) for i, n in enumerate("XY"[:axes]))
    result = ncscope.run(ncscope.Machine("m", channel), "G01 F1 X5\nX0\nM30\n")
    assert segments(path_picture(result, "p", "svg"), "top-feed") == 2


@pytest.mark.parametrize("beyond", [0.95, 0.305])
def test_labels_stay_off_lines(beyond: float) -> None:
    """A line right of the point runs through the place of its label: above, below or left of it
    there is room."""
    from matplotlib.figure import Figure

    axes = Figure(figsize=(6, 6)).add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 1), ylim=(0, 1))
    line = np.array([[0.305, 0.52], [0.95, 0.56]]) if beyond > 0.5 else np.array(
        [[0.32, 0.1], [0.32, 0.95]]
    )  # fmt: skip
    labels = [Label(np.array([0.3, 0.5]), f"label {n}", "black") for n in (1, 2)]
    draw_labels(axes, labels, lines=[line])
    boxes = [text.get_window_extent().transformed(axes.transData.inverted()) for text in axes.texts]
    points = line[0] + np.linspace(0, 1, 200)[:, None] * (line[1] - line[0])
    for box in boxes:
        assert not any(box.contains(*point) for point in points)
        assert abs(box.y0 - 0.5) < 0.15 and min(abs(box.x0 - 0.3), abs(box.x1 - 0.3)) < 0.05
    assert not boxes[0].overlaps(boxes[1])
