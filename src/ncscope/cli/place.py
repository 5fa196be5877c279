"""`PROGRAM:LINE`: the block that a command is asked about."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ncscope.diagnostics import Diagnostic
    from ncscope.trajectory import Trajectory

_BLOCK = re.compile(r"(?P<letter>[Nn]?)(?P<number>[0-9]{1,18})")


@dataclass(frozen=True)
class Place:
    """A block of a program: by its block number, or else by its line."""

    path: Path
    line: int
    number: int | None = None

    @property
    def name(self) -> str:
        return str(self.line) if self.number is None else f"N{self.number}"

    def line_in(self, result: Trajectory) -> int:
        """The line. Raises KeyError for a block number that did not run."""
        return self.line if self.number is None else result.line_of_block(self.number)


def read_place(text: str) -> Place:
    """PROGRAM:LINE or PROGRAM:N40; ends the process when the text is neither."""
    name, _, where = text.rpartition(":")
    place = read_block(Path(name), where)
    if not name or place is None:
        fail(f"{text}: write PROGRAM:LINE or PROGRAM:N40")
    return place


def read_block(path: Path, text: str) -> Place | None:
    """A block of a program by N40, or by its line; None where the text is neither."""
    match = _BLOCK.fullmatch(text)
    if match is None:
        return None
    number = int(match["number"])
    return Place(path, 0, number) if match["letter"] else Place(path, number)


def fail_without_block(error: KeyError, found: Iterable[Diagnostic]) -> NoReturn:
    """Ends the process where the block did not run, with the errors that may be the reason."""
    show_diagnostics(d for d in found if d.is_error)
    fail(str(error.args[0]), code=1)
