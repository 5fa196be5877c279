"""The docs say what the program does: generated pages are current, examples give what they show.

A console block of the README is run as it stands, in a folder with `examples` and with the NC
blocks of the README as files (`; part.nc` in their first line). NCSCOPE_REWRITE=1 writes the
output of the commands and the generated pages anew; the diff is to be read before it is kept.
"""

from __future__ import annotations

import doctest
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from ncscope import docs
from ncscope.catalogue import CATALOGUE
from ncscope.seed_commands import SEED_COMMANDS, SeedCommand

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
PAGES = sorted([README, *(ROOT / "docs").rglob("*.md")])
REWRITE = bool(os.environ.get("NCSCOPE_REWRITE"))
NC_BLOCK = re.compile(r"```nc\n(; (\S+)\n.*?)```", re.DOTALL)
CONSOLE = re.compile(r"```console\n\$ ncscope (.*?)\n(.*?)```", re.DOTALL)
LINK = re.compile(r"\]\((?!https?:)([^)#]+)")


@pytest.mark.parametrize("name", sorted(docs.pages()))
def test_generated_page_is_current(name: str) -> None:
    path = ROOT / "docs" / name
    if REWRITE:
        docs.write(ROOT / "docs")
    assert path.read_text(encoding="utf-8") == docs.pages()[name], "run make docs"


def test_pages_are_written_into_a_new_folder(tmp_path: Path) -> None:
    docs.write(tmp_path / "a" / "b")
    assert {p.name for p in (tmp_path / "a" / "b").iterdir()} == set(docs.pages())


def test_every_diagnostic_is_on_its_page() -> None:
    lines = docs.diagnostics_page().splitlines()
    assert sum(line.startswith("| ") and line[2:8] != "id | s" for line in lines) == len(CATALOGUE)


@pytest.mark.parametrize("path", ["README.md", "docs/conventions.md"])
def test_examples_in_python(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    result = doctest.testfile(str(ROOT / path), module_relative=False, encoding="utf-8")
    assert result.attempted > 5
    assert result.failed == 0


def test_examples_in_the_console(tmp_path: Path) -> None:
    text = README.read_text(encoding="utf-8")
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    for body, name in NC_BLOCK.findall(text):
        (tmp_path / name).write_text(body, encoding="latin-1")
    shown = CONSOLE.findall(text)
    assert len(shown) >= 3
    for command, output in shown:
        said = _output(command, tmp_path)
        if REWRITE:
            text = text.replace(f"$ ncscope {command}\n{output}", f"$ ncscope {command}\n{said}")
        else:
            assert output == said
    if REWRITE:
        README.write_text(text, encoding="utf-8")


def _output(command: str, folder: Path) -> str:
    """What a command writes to both streams, without blanks at the ends of lines."""
    done = subprocess.run(
        [sys.executable, "-m", "ncscope.cli", *shlex.split(command)],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return "".join(line.rstrip() + "\n" for line in done.stdout.splitlines())


@pytest.mark.parametrize("path", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_links_lead_somewhere(path: Path) -> None:
    missing = [
        link for link in LINK.findall(path.read_text(encoding="utf-8"))
        if not (path.parent / link).exists()
    ]  # fmt: skip
    assert missing == []


def test_every_g_function_is_on_the_page() -> None:
    page = docs.commands_page()
    missing = [n for n in docs.GFUNCTIONS if f"G{n:02d}" not in page]
    assert missing == []


@pytest.mark.parametrize("row", SEED_COMMANDS, ids=lambda r: f"{r.form} {r.case}")
def test_the_case_of_a_seed_command_shows_it(row: SeedCommand) -> None:
    """The case exists, and its program or one of its lists holds what the manual writes."""
    folder = ROOT / "tests" / "cases" / row.case
    files = [folder / "main.nc", *folder.glob("*.lis")]
    for name, kind in (("program", "programs"), ("machine", "machines")):
        if (folder / name).exists():
            place = ROOT / "examples" / kind / (folder / name).read_text().strip()
            files += [place] if place.is_file() else place.glob("*.lis")
    text = " ".join(f.read_text(encoding="latin-1") for f in files if f.exists())
    squeezed = re.sub(r"\s+", " ", text)
    assert row.form in squeezed
    assert docs.seed_status(row) == "modelled"
