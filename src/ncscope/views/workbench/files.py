"""The files below the folder that the user opened; nothing else exists for the page.

A file is named by its key: the path below the folder with `/` between the parts. Links are
resolved before a path is accepted.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ncscope.lists.files import MAX_BYTES, kind_of_name

ENCODING = "latin-1"
"""Every byte is one character, so that any file can be written back unchanged."""
PROGRAM_SUFFIXES = (
    ".nc", ".cnc", ".ncp", ".ncf", ".mpf", ".spf", ".sub", ".cyc", ".ecy", ".iso", ".tap", ".din",
)  # fmt: skip
MAX_PROGRAM_BYTES = 2_000_000_000
MAX_FILES = 20_000
MAX_DEPTH = 8


class Refused(Exception):
    """A file that the page may not have, with the reason as a sentence."""


@dataclass(frozen=True)
class Listing:
    """Keys of programs and of machines (folders with lists), sorted; `cut`: there are more."""

    programs: tuple[str, ...]
    machines: tuple[str, ...]
    cut: bool = False


@dataclass(frozen=True)
class Folder:
    """The folder that the user opened; `root` is resolved."""

    root: Path

    @classmethod
    def at(cls, path: str | Path) -> Folder:
        return cls(Path(path).resolve())

    def path(self, key: str) -> Path:
        """The resolved path of a key. Raises Refused when it leaves the folder."""
        try:
            found = (self.root / key.replace("\\", "/")).resolve()
        except (OSError, ValueError, RuntimeError):
            raise Refused("this is not a file name") from None
        if not found.is_relative_to(self.root):
            raise Refused(f"{key} is outside of the opened folder")
        return found

    def key(self, path: Path) -> str:
        """The key of a path below the folder. Raises Refused for any other."""
        found = path.resolve()
        if not found.is_relative_to(self.root):
            raise Refused(f"{path.name} is outside of the opened folder")
        return found.relative_to(self.root).as_posix()

    def read(self, key: str) -> bytes:
        """The bytes of a file. Raises Refused."""
        path = self.path(key)
        most = MAX_BYTES if path.suffix.lower() == ".lis" else MAX_PROGRAM_BYTES
        try:
            if not path.is_file():
                raise Refused(f"there is no file {key}")
            if path.stat().st_size > most:
                raise Refused(f"{key} is too large")
            return path.read_bytes()
        except OSError as error:
            raise Refused(f"{key} cannot be read: {error.strerror or 'input error'}") from None

    def write(self, key: str, data: bytes, expected: bytes) -> None:
        """Writes a file that still holds `expected`. Raises Refused, then nothing is changed."""
        if self.read(key) != expected:
            raise Refused(f"{key} was changed on disk by another program; nothing was written")
        try:
            self.path(key).write_bytes(data)
        except OSError as error:
            raise Refused(f"{key} cannot be written: {error.strerror or 'output error'}") from None

    def listing(self) -> Listing:
        """All programs and machines below the folder, links to other places left out."""
        programs: list[str] = []
        machines: list[str] = []
        seen = 0
        for folder, names in self._folders():
            seen += len(names)
            prefix = folder.relative_to(self.root).as_posix()
            kinds = {kind_of_name(name) for name in names}
            if kinds & {"channel", "startup"}:
                machines.append(prefix)
            programs.extend(
                name if prefix == "." else f"{prefix}/{name}"
                for name in names
                if name.lower().endswith(PROGRAM_SUFFIXES)
            )
            if seen > MAX_FILES:
                return Listing(tuple(sorted(programs)), tuple(sorted(machines)), True)
        return Listing(tuple(sorted(programs)), tuple(sorted(machines)))

    def _folders(self) -> Iterator[tuple[Path, list[str]]]:
        for place, folders, names in os.walk(self.root):
            here = Path(place)
            depth = len(here.relative_to(self.root).parts)
            hidden = [f for f in folders if f.startswith(".") or f == "node_modules"]
            folders[:] = sorted(set(folders) - set(hidden)) if depth < MAX_DEPTH else []
            yield here, sorted(name for name in names if not name.startswith("."))
