"""`ncscope workbench` refuses what would open the folder to others."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ncscope.cli import app


def said(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(app, ["workbench", *arguments, "--no-browser"])
    return done.exit_code, done.output


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--host", "0.0.0.0", "--token", "0123456789abcdef"], "name the one address"),
        (["--host", "::", "--token", "0123456789abcdef"], "name the one address"),
        (["--host", "192.0.2.1"], "give --token"),
        (["--host", "192.0.2.1", "--token", "short"], "give --token"),
    ],
)
def test_other_addresses_need_a_token(tmp_path: Path, arguments: list[str], sentence: str) -> None:
    code, output = said(str(tmp_path), *arguments)
    assert code == 2
    assert sentence in output


def test_only_a_folder_is_opened(tmp_path: Path) -> None:
    assert said(str(tmp_path / "none")) == (2, f"ncscope: {tmp_path / 'none'} is not a folder\n")


def test_a_port_in_use_is_said(tmp_path: Path) -> None:
    pytest.importorskip("nicegui", reason="needs the extra workbench")
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        code, output = said(str(tmp_path), "--port", str(other.getsockname()[1]))
    assert code == 2
    assert "cannot listen on 127.0.0.1" in output
