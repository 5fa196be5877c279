"""`PROGRAM:LINE`: the block that a command is asked about."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ncscope.diagnostics import Diagnostic
    from ncscope.trajectory import Trajectory


@dataclass(frozen=True)
class Place:
    """A block of a program: by its block number, or else by its line."""

    path: Path
    line: int
    number: int | None = None

    def line_in(self, result: Trajectory) -> int:
        """The line. Raises KeyError for a block number that did not run."""
        return self.line if self.number is None else result.line_of_block(self.number)


def read_place(text: str) -> Place:
    """PROGRAM:LINE or PROGRAM:N40; ends the process when the text is neither."""
    name, _, where = text.rpartition(":")
    number = where[1:] if where[:1] in ("N", "n") else None
    if not name or not (number or where).isdigit():
        fail(f"{text}: write PROGRAM:LINE or PROGRAM:N40")
    if number:
        return Place(Path(name), 0, int(number))
    return Place(Path(name), int(where))


def fail_without_block(error: KeyError, found: Iterable[Diagnostic]) -> NoReturn:
    """Ends the process where the block did not run, with the errors that may be the reason."""
    show_diagnostics(d for d in found if d.is_error)
    fail(str(error.args[0]), code=1)
