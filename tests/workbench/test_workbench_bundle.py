"""The bundle of scripts is the one of the sources that are checked in."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from pathlib import Path

import pytest

import ncscope

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "workbench_js"
BUNDLE = Path(ncscope.__file__).parent / "views" / "workbench" / "static" / "dist" / "index.js"


def test_bundle_is_made_from_the_sources() -> None:
    digest = hashlib.sha256()
    names = [f"src/{path.name}" for path in sorted((SOURCES / "src").iterdir())]
    for name in [*names, "package-lock.json"]:
        digest.update(name.encode())
        digest.update((SOURCES / name).read_bytes())
    first = BUNDLE.read_text(encoding="utf-8").split("\n", 1)[0]
    assert first.endswith(digest.hexdigest()), "run make workbench-js"


def test_text_never_becomes_html() -> None:
    for path in (SOURCES / "src").glob("*.js"):
        text = path.read_text(encoding="utf-8")
        for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval("):
            assert word not in text, path.name


def test_lock_file_names_no_host() -> None:
    assert "://" not in (SOURCES / "package-lock.json").read_text(encoding="utf-8")


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_scripts_pass_their_own_tests() -> None:
    tests = sorted(str(path) for path in (SOURCES / "test").glob("*.test.mjs"))
    done = subprocess.run(["node", "--test", *tests], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-3000:]
