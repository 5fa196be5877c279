"""The rules of the house, checked on the source text: import directions, file access, sizes.

Every rule is a function over a folder, so that a test can plant the fault and see it caught.
"""

from __future__ import annotations

import ast
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import ncscope
from ncscope.catalogue import CATALOGUE

SOURCE = Path(ncscope.__file__).parent
LAYERS = (
    "catalogue seed_commands",
    "diagnostics compilation",
    "frames",
    "kinematics language contour",
    "levels",
    "coordinates",
    "machine",
    "motion",
    "explanation",
    "trajectory",
    "recording",
    "transitions",
    "inspection",
    "channel",
    "program",
    "execution lists",
    "loading",
    "views",
    "cli docs",
)
"""From the lowest to the highest room; rooms of one height do not know each other."""
ROOMS = {name: height for height, names in enumerate(LAYERS) for name in names.split()}
MAX_LINES = 400
FILE_ROOMS = {"lists", "views", "cli", "loading", "docs"}
FILE_CALLS = {
    "read_text", "read_bytes", "write_text", "write_bytes", "mkdir", "unlink", "touch",
    "rename", "rmdir", "iterdir", "glob", "rglob", "symlink_to", "makedirs", "remove",
}  # fmt: skip
DATA_READERS = {"read_text", "read_bytes"}


def modules(root: Path) -> Iterator[tuple[Path, str, ast.Module]]:
    """Each module below `root` with the room it belongs to."""
    for path in sorted(root.rglob("*.py")):
        room = path.relative_to(root).parts[0].removesuffix(".py")
        yield path, room, ast.parse(path.read_text(encoding="utf-8"))


def imported_rooms(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Every room of ncscope that a module imports, also inside functions, with the line."""
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [a.name for a in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level:
            names = ["ncscope.<relative import>"]
        elif isinstance(node, ast.ImportFrom) and node.module == "ncscope":
            names = [f"ncscope.{a.name}" for a in node.names if not a.name.startswith("__")]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = [node.module]
        for name in names:
            if name.startswith("ncscope."):
                yield node.lineno, name.split(".")[1]


def import_faults(root: Path) -> list[str]:
    """Imports that go up, or across between rooms of one height."""
    faults = []
    for path, room, tree in modules(root):
        if room == "__init__":
            continue
        for line, other in imported_rooms(tree):
            if other not in ROOMS or room not in ROOMS:
                faults.append(f"{path.name}:{line}: {room} -> {other}: not a room of the design")
            elif other != room and ROOMS[other] >= ROOMS[room]:
                faults.append(f"{path.name}:{line}: {room} -> {other}")
    return faults


def file_faults(root: Path) -> list[str]:
    """Calls that touch files outside the rooms that may."""
    faults = []
    for path, room, tree in modules(root):
        if room in FILE_ROOMS:
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and _touches_files(node):
                faults.append(f"{path.relative_to(root)}:{node.lineno}")
    return faults


def _touches_files(call: ast.Call) -> bool:
    match call.func:
        case ast.Name(id="open"):
            return True
        case ast.Attribute(attr="open"):
            return True
        case ast.Attribute(attr=name, value=value) if name in FILE_CALLS:
            own_data = any(
                isinstance(n, ast.Call)
                and getattr(n.func, "id", getattr(n.func, "attr", "")) in ("files", "_files")
                for n in ast.walk(value)
            )  # package data through importlib.resources is not a file of the user
            return not (own_data and name in DATA_READERS)
    return False


def long_modules(root: Path) -> list[str]:
    counts = {p: len(p.read_text(encoding="utf-8").splitlines()) for p in root.rglob("*.py")}
    return [f"{p.relative_to(root)}: {n} lines" for p, n in sorted(counts.items()) if n > MAX_LINES]


ID = re.compile(r"N\d{4}|1\d{5}|2\d{4}|29\d{4}|10[12]\d|5\d{4}")


def used_ids(root: Path) -> set[str]:
    """Every string of the source that has the form of a diagnostic id, except the catalogue's."""
    return {
        node.value
        for _, room, tree in modules(root)
        if room != "catalogue"
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        if ID.fullmatch(node.value)
    }


# --- the rules hold ----------------------------------------------------------------------------


def test_imports_go_one_way() -> None:
    assert import_faults(SOURCE) == []


def test_only_the_file_rooms_touch_files() -> None:
    assert file_faults(SOURCE) == []


def test_no_module_is_too_long() -> None:
    assert long_modules(SOURCE) == []


def test_every_id_is_explained() -> None:
    assert used_ids(SOURCE) - set(CATALOGUE) == set()


def test_every_room_of_the_source_has_a_height() -> None:
    rooms = {room for _, room, _ in modules(SOURCE)} - {"__init__"}
    assert rooms <= set(ROOMS)


@pytest.mark.parametrize("name", ncscope.__all__)
def test_public_names_exist(name: str) -> None:
    assert getattr(ncscope, name) is not None


# --- and the faults are caught -----------------------------------------------------------------


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    target = tmp_path / "ncscope"
    shutil.copytree(SOURCE, target, ignore=shutil.ignore_patterns("__pycache__"))
    return target


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("language/lexer.py", "from ncscope.machine import Machine"),
        ("kinematics/chain.py", "import ncscope.language.parser"),
        ("coordinates.py", "import ncscope.machine"),
        ("channel/state.py", "def f():\n    from ncscope.views import table"),
        ("lists/document.py", "from ncscope.execution import run"),
        ("frames.py", "from .diagnostics import Span"),
        ("trajectory.py", "from ncscope.utils import helper"),
    ],
)
def test_planted_import_is_caught(copy: Path, module: str, line: str) -> None:
    before = import_faults(copy)
    path = copy / module
    path.write_text(path.read_text(encoding="utf-8") + f"\n{line}\n", encoding="utf-8")
    (fault,) = [f for f in import_faults(copy) if f not in before]
    assert path.name in fault


@pytest.mark.parametrize(
    "code", ["open('x')", "Path('x').read_bytes()", "Path('x').write_text('')", "p.open('w')"]
)
def test_planted_file_access_is_caught(copy: Path, code: str) -> None:
    before = file_faults(copy)
    path = copy / "channel" / "state.py"
    path.write_text(path.read_text(encoding="utf-8") + f"\n{code}\n", encoding="utf-8")
    assert len(set(file_faults(copy)) - set(before)) == 1


def test_planted_length_and_id_are_caught(copy: Path) -> None:
    path = copy / "motion" / "arc.py"
    text = path.read_text(encoding="utf-8") + "\nBAD = 'N9876'\n" + "#\n" * MAX_LINES
    path.write_text(text, encoding="utf-8")
    assert any(f.startswith("motion/arc.py") for f in long_modules(copy))
    assert "N9876" in used_ids(copy) - set(CATALOGUE)
