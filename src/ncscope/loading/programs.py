"""Program files from disk; the lists have their own reader."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path, PurePosixPath

import numpy as np
from numpy.typing import NDArray

from ncscope.diagnostics import Source
from ncscope.execution import Program
from ncscope.loading.content import content

MAPPED_FROM = 32 * 1024 * 1024
"""Bytes from which a file is mapped."""


def load_program(path: str | Path) -> Program:
    """The NC program in a file, with every character kept (the control's texts are Latin-1).

    Raises OSError when the file cannot be read.
    """
    path = Path(path)
    return Program(Source(path.name, _content(path)))


def subprogram_loader(
    folders: Iterable[str | Path], search_paths: Iterable[str] = ()
) -> Callable[[str], Source | None]:
    """What `Options.load` needs: finds subprogram files in these folders and below them only.

    search_paths: folders of the channel list, searched behind the folders themselves and relative
    to them (P-CHAN-00401). A name that leads out of the folders, also by a link, is not found.
    Capitals do not count where only one file is meant: the control's own files lie on Windows.
    """
    roots = [Path(folder).resolve() for folder in folders]
    below = ["", *(path.replace("\\", "/") for path in search_paths)]

    def load(name: str) -> Source | None:
        relative = name.replace("\\", "/")
        places = [(root, PurePosixPath(folder, relative)) for folder in below for root in roots]
        for spelled in (_as_written, _in_any_case):
            for root, place in places:
                try:
                    path = spelled(root, place).resolve()
                    if path.is_relative_to(root) and path.is_file():
                        return Source(path.relative_to(root).as_posix(), _content(path))
                except (OSError, ValueError):
                    continue
        return None

    return load


def _as_written(root: Path, place: PurePosixPath) -> Path:
    return root / place


def _in_any_case(root: Path, place: PurePosixPath) -> Path:
    """The one path below the root that differs in capitals only; FileNotFoundError without."""
    path = root
    for part in place.parts:
        if part in ("..", "/"):
            raise FileNotFoundError(place)
        same = [p for p in path.iterdir() if p.name.casefold() == part.casefold()]
        if len(same) != 1:
            raise FileNotFoundError(place)
        path = same[0]
    return path


def _content(path: Path) -> NDArray[np.uint8]:
    """The bytes of a file. A very large one is mapped; a smaller one is read, because a mapped
    file that its editor shortens meanwhile would end the process."""
    if path.stat().st_size >= MAPPED_FROM:
        return np.memmap(path, dtype=np.uint8, mode="r")
    return np.frombuffer(content(path), dtype=np.uint8)
