"""Rows of axis values from words, or from the columns of a table of poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ncscope.cli.files import reading
from ncscope.cli.screen import fail, show_diagnostics
from ncscope.cli.words import read_number, read_words

if TYPE_CHECKING:
    from ncscope.frames import Array
    from ncscope.loading.pose_tables import PoseTable

TIP = ("mcs_X", "mcs_Y", "mcs_Z")
MOST_POSES = 1_000_000
DIRECTION = ("direction_i", "direction_j", "direction_k")


def word_row(words: Sequence[str], names: Sequence[str], what: str) -> Array:
    """One row; axes that are not named are 0."""
    import numpy as np

    values = read_words(words, names, what)
    if not values:
        fail(f"write axis values, such as {names[0]}=10, or give --poses FILE")
    return np.array([[values.get(name, 0.0) for name in names]])


def near_values(words: Sequence[str] | None, names: Sequence[str]) -> Array | None:
    """The axis values of --near (n_channel,), None without the option."""
    return None if not words else word_row(words, names, "--near")[0]


def grid_rows(words: Sequence[str], names: Sequence[str]) -> Array:
    """Every combination of `X=FROM:TO:COUNT` words; axes that are not named are 0."""
    import numpy as np

    spans: dict[str, Array] = {}
    for word in words:
        name, _, text = word.partition("=")
        if name not in names:
            fail(f"--grid {word}: write NAME=FROM:TO:COUNT with a name of {' '.join(names)}")
        if name in spans:
            fail(f"--grid: {name} stands twice")
        parts = [read_number(part, f"--grid {word}") for part in text.split(":")]
        if len(parts) not in (1, 3) or (len(parts) == 3 and not _is_count(parts[2])):
            fail(f"--grid {word}: write FROM:TO:COUNT, such as {name}=-100:100:5, or one value")
        spans[name] = (
            np.linspace(parts[0], parts[1], int(parts[2])) if parts[1:] else np.array(parts)
        )
    total = math.prod(len(span) for span in spans.values())
    if total > MOST_POSES:
        fail(f"--grid has {total} poses; at most {MOST_POSES} are compared")
    axes = np.meshgrid(*(spans.get(name, np.zeros(1)) for name in names), indexing="ij")
    return np.stack([axis.reshape(-1) for axis in axes], axis=1)


def _is_count(value: float) -> bool:
    return value == int(value) and 1 <= value <= MOST_POSES


@dataclass(frozen=True)
class PoseFile:
    """A table of poses and what its columns mean. Ends the process where it cannot be read."""

    table: PoseTable

    def has_tool(self, names: Sequence[str]) -> bool:
        """Whether tool tip and direction are there, and no axis under its plain name."""
        there = set(self.table.names)
        return there.issuperset((*TIP, *DIRECTION)) and not there.intersection(names)

    def tool(self) -> tuple[Array, Array]:
        values = self._numbers((*TIP, *DIRECTION))
        return values[:, :3], values[:, 3:]

    def rows(self, names: Sequence[str], prefix: str) -> Array:
        """Columns by axis name, or by axis name behind the prefix of a run's csv; 0 without."""
        import numpy as np

        there = self.table.names
        plain = {name: name for name in names if name in there}
        columns = plain or {n: prefix + n for n in names if prefix + n in there}
        if not columns:
            shown = ", ".join(there[:12])
            fail(f"{self.table.path} has no column of the axes {' '.join(names)}; it has {shown}")
        values = self._numbers(tuple(columns.values()))
        rows = np.zeros((len(values), len(names)))
        for place, name in enumerate(columns):
            rows[:, list(names).index(name)] = values[:, place]
        self._say_unused(names, tuple(columns), bool(plain))
        return rows

    def _numbers(self, columns: Sequence[str]) -> Array:
        with reading(self.table.path):
            values, found = self.table.numbers(columns)
        if found:
            show_diagnostics(found)
            raise typer.Exit(1)
        return values

    def _say_unused(self, names: Sequence[str], used: Sequence[str], plain: bool) -> None:
        from ncscope.diagnostics import diagnostic

        file = self.table.path.name
        missing = [name for name in names if name not in used]
        unused = [name for name in self.table.names if plain and name not in used]
        if missing:
            text = f"{file} has no column for {', '.join(missing)}; 0 is taken"
            show_diagnostics([diagnostic("N4202", None, text)])
        if unused:
            text = f"{file}: no axis is called {', '.join(unused)}; the columns are not used"
            show_diagnostics([diagnostic("N4202", None, text)])


def poses_file(path: Path) -> PoseFile:
    """The table of --poses."""
    from ncscope.loading.pose_tables import open_pose_table

    with reading(path):
        table, found = open_pose_table(path)
    if table is None:
        show_diagnostics(found)
        raise typer.Exit(1)
    return PoseFile(table)
