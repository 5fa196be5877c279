"""Program files from disk; the lists have their own reader."""

from __future__ import annotations

from pathlib import Path

from ncscope.diagnostics import Source
from ncscope.execution import Program


def load_program(path: str | Path) -> Program:
    """The NC program in a file, with every character kept (the control's texts are Latin-1).

    Raises OSError when the file cannot be read.
    """
    path = Path(path)
    text = path.read_bytes().decode("latin-1")
    return Program(Source(path.name, text))
