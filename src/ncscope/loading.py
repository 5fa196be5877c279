"""Program files from disk; the lists have their own reader."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from ncscope.diagnostics import Source
from ncscope.execution import Program


def load_program(path: str | Path) -> Program:
    """The NC program in a file, with every character kept (the control's texts are Latin-1).

    Raises OSError when the file cannot be read.
    """
    path = Path(path)
    return Program(Source(path.name, _text(path)))


def subprogram_loader(folders: Iterable[str | Path]) -> Callable[[str], Source | None]:
    """What `Options.load` needs: finds subprogram files in these folders and below them only.

    A name that leads out of the folders, also by a link, is not found.
    """
    roots = [Path(folder).resolve() for folder in folders]

    def load(name: str) -> Source | None:
        relative = name.replace("\\", "/")
        for root in roots:
            try:
                path = (root / relative).resolve()
                if path.is_relative_to(root) and path.is_file():
                    return Source(path.relative_to(root).as_posix(), _text(path))
            except (OSError, ValueError):
                continue
        return None

    return load


def _text(path: Path) -> str:
    return path.read_bytes().decode("latin-1")
