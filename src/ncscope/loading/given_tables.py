"""Tables of what the machine would answer: probe positions and jog increments."""

from __future__ import annotations

from pathlib import Path

from ncscope.channel.given import GivenRows, read_rows
from ncscope.diagnostics import Diagnostic, Source


def load_rows(path: str | Path) -> tuple[GivenRows, tuple[Diagnostic, ...]]:
    """Probe answers or jog increments from a table of text, and what is wrong with it.

    Raises OSError when the file cannot be read.
    """
    path = Path(path)
    text = path.read_bytes().decode("utf-8-sig", "replace")
    return read_rows(Source(path.name, text))
