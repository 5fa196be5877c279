"""What a run produced, as columns.

Stored are the programmed values (PCS) and the axis positions (ACS) of every motion block; the
workpiece and machine systems and the tool direction are computed from the `Coordinates` of the
block when asked. Arrays have one row per move and one column per axis name of the run; an axis
that was not in the channel at a block is NaN there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, render
from ncscope.explanation import Explanation, Visit, Whereabouts, whereabouts
from ncscope.frames import Array
from ncscope.machine import Axis
from ncscope.motion import MOTIONS
from ncscope.motion.paths import Paths
from ncscope.motion.turning import TurningPoints

SYSTEMS = ("pcs", "wcs", "mcs", "acs")
NO_BLOCK = -1
"""In the column `block`: the line has no N number."""


@dataclass(frozen=True)
class Stretch:
    """Consecutive moves under one `Coordinates` and one set of axes.

    line, block: int64 (m,). motion: index into MOTIONS, int8 (m,). feed: NaN where none.
    pcs, acs: (m, n). start: (n,) axis positions before the first move. ends: (m,) whether the row
    is the end of its move and not a point on the way there, None where all are ends.
    turning: where axes turn back on the arcs of the stretch, and where a straight move takes one
    beyond its limit; its rows count the moves. between: the paths of the moves, while they run.
    """

    coordinates: Coordinates
    axes: tuple[str, ...]
    file: str
    line: NDArray[np.int64]
    block: NDArray[np.int64]
    motion: NDArray[np.int8]
    feed: Array
    pcs: Array
    acs: Array
    start: Array
    ends: NDArray[np.bool_] | None = None
    turning: TurningPoints | None = None
    between: Callable[[], Paths] | None = field(default=None, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.line)

    @property
    def end(self) -> NDArray[np.bool_]:
        """(m,) whether the row is the end of its move."""
        return np.ones(len(self), dtype=bool) if self.ends is None else self.ends

    def at_ends(self) -> Stretch:
        """The stretch with the ends of moves only."""
        if self.ends is None:
            return self
        columns = ("line", "block", "motion", "feed", "pcs", "acs")
        kept = {name: getattr(self, name)[self.end] for name in columns}
        return replace(self, **kept, ends=None)

    def to_arrow(self, axes: tuple[str, ...], sampled: bool) -> Any:
        """The columns of `Trajectory.to_arrow`; an axis that was not in the channel is NaN."""
        import pyarrow as pa

        columns = {
            "line": pa.array(self.line),
            "block": pa.array(self.block),
            "motion": _names(self.motion),
            "feed": pa.array(self.feed),
        }
        if sampled:
            columns["end"] = pa.array(self.end)
        names = [f"{name}_{axis}" for name in SYSTEMS for axis in axes]
        names += [f"direction_{c}" for c in "ijk"]
        rows = zip(names, self._rows(axes), strict=True)
        return pa.table(columns | {name: pa.array(row) for name, row in rows})

    def _rows(self, axes: tuple[str, ...]) -> Array:
        """(4 len(axes) + 3, m): the four systems and the direction, one row a column of the
        table, in one piece of memory: many small ones take longer to be had than to be filled."""
        rows = np.full((len(SYSTEMS) * len(axes) + 3, len(self)), np.nan)
        at = [axes.index(axis) for axis in self.axes]
        for i, name in enumerate(SYSTEMS):
            rows[i * len(axes) :][at] = getattr(self, name).T
        if self.direction is not None:
            rows[-3:] = self.direction.T
        return rows

    @cached_property
    def mcs(self) -> Array:
        return self.coordinates.to_mcs(self.pcs)

    @cached_property
    def wcs(self) -> Array:
        return self.coordinates.wcs_from_mcs(self.mcs)

    @cached_property
    def direction(self) -> Array | None:
        return self.coordinates.direction(self.acs)


@dataclass(frozen=True)
class Trajectory:
    """The result of a run.

    axes: every axis name that was in the channel, in order of appearance. messages: what the
    program wrote. diagnostics: in the order they arose. ok: the program ran to its end.
    channels: the axes of the channel, each set with the row from which it counts.
    nearest_to_pole: smallest angle, degrees, of the tool to its singular direction at the end of
    a move, with file and line; None without such a direction.
    """

    stretches: tuple[Stretch, ...]
    axes: tuple[str, ...]
    diagnostics: tuple[Diagnostic, ...] = ()
    messages: tuple[Any, ...] = ()
    ok: bool = True
    channels: tuple[tuple[int, tuple[Axis, ...]], ...] = ()
    nearest_to_pole: tuple[float, tuple[str, int]] | None = None
    _places: Mapping[int, Visit] = field(default_factory=dict, repr=False)
    _file: str = ""

    def __len__(self) -> int:
        return sum(len(s) for s in self.stretches)

    @property
    def sampled(self) -> bool:
        """Whether there may be rows between the ends of moves (`Options.sample`)."""
        return any(s.ends is not None for s in self.stretches)

    @property
    def end(self) -> NDArray[np.bool_]:
        """Whether a row is the end of its move, or a point on the way there."""
        return self._column(lambda s: s.end, np.bool_)

    @property
    def line(self) -> NDArray[np.int64]:
        """Source lines, counted from 1."""
        return self._column(lambda s: s.line, np.int64)

    @property
    def block(self) -> NDArray[np.int64]:
        """Block numbers; -1 where the line has none."""
        return self._column(lambda s: s.block, np.int64)

    @property
    def motion(self) -> NDArray[np.str_]:
        codes = self._column(lambda s: s.motion, np.int8)
        return np.array(MOTIONS)[codes] if len(codes) else np.array([], dtype="U3")

    @property
    def feed(self) -> Array:
        """Programmed feed, mm or degrees per minute; NaN where none."""
        return self._column(lambda s: s.feed, np.float64)

    @property
    def pcs(self) -> Array:
        """(moves, axes): programmed values made absolute; mm and degrees."""
        return self._matrix(lambda s: s.pcs)

    @property
    def wcs(self) -> Array:
        """(moves, axes): the workpiece system, all coordinate systems undone."""
        return self._matrix(lambda s: s.wcs)

    @property
    def mcs(self) -> Array:
        """(moves, axes): the tool tip in the Cartesian machine system; other axes beside it."""
        return self._matrix(lambda s: s.mcs)

    @property
    def acs(self) -> Array:
        """(moves, axes): axis positions; mm and degrees."""
        return self._matrix(lambda s: s.acs)

    @property
    def direction(self) -> Array:
        """(moves, 3): unit vector tip -> flange in the MCS; NaN without a kinematics."""
        rows = [
            np.full((len(s), 3), np.nan) if s.direction is None else s.direction
            for s in self.stretches
        ]
        return np.concatenate(rows) if rows else np.empty((0, 3))

    def at_ends(self) -> Trajectory:
        """The trajectory with the ends of moves only, as a run without points gives it."""
        if not self.sampled:
            return self
        ends = np.concatenate([[0], np.cumsum(self.end)])
        channels = tuple((int(ends[row]), axes) for row, axes in self.channels)
        return replace(
            self, stretches=tuple(s.at_ends() for s in self.stretches), channels=channels
        )

    def check(self) -> Trajectory:
        """This result; raises RuntimeError with the rendered errors when the run failed."""
        errors = [d for d in self.diagnostics if d.is_error]
        if errors or not self.ok:
            raise RuntimeError("\n".join(render(d) for d in errors) or "the run did not end")
        return self

    def explain(self, line: int) -> Explanation:
        """The layers at a line of the main program; of several runs of the line, the last.

        Raises KeyError, naming the nearest line, when the line was not executed.
        """
        at = self._at(line)
        layers = at.coordinates.layers(at.program, near=at.start)
        return Explanation(at.file, line, at.block, at.axes, layers)

    def where(self, axes: Mapping[str, float], line: int) -> Whereabouts:
        """Where the machine is with these axis positions, under the state of a line.

        axes: positions by axis name, mm and degrees; the others stand where the line left them.
        line: of the main program; of several runs of the line, the last counts.
        Raises KeyError for an axis that is not in the channel there, and for a line that was not
        executed, naming the nearest.
        """
        return whereabouts(self._at(line), line, axes)

    def explain_move(self, index: int) -> Explanation:
        """The layers of one move by its row. Raises IndexError without such a row."""
        s, row = self.locate(index)
        block = None if s.block[row] == NO_BLOCK else int(s.block[row])
        near = s.acs[row - 1] if row else s.start
        layers = s.coordinates.layers(s.pcs[row], near=near)
        return Explanation(s.file, int(s.line[row]), block, s.axes, layers)

    def locate(self, index: int) -> tuple[Stretch, int]:
        """The stretch that holds a move, and the row there. Raises IndexError."""
        row = index
        for s in self.stretches if index >= 0 else ():
            if row < len(s):
                return s, row
            row -= len(s)
        raise IndexError(f"the run has no move {index}")

    def line_of_block(self, number: int) -> int:
        """The line of the block with this N number that was executed last; KeyError without."""
        for s in reversed(self.stretches):
            rows = np.flatnonzero(s.block == number)
            if len(rows) and self._is_main(s):
                return int(s.line[rows[-1]])
        lines = [line for line, place in self._places.items() if place.block == number]
        if not lines:
            raise KeyError(f"block N{number} was not executed")
        return lines[-1]

    def to_arrow(self) -> Any:
        """A pyarrow Table: line, block, motion, feed, then pcs_X .. wcs_X .. mcs_X .. acs_X, and
        direction_i .. direction_k.

        A sampled run has the column `end` besides: whether the row is the end of its move.
        """
        import pyarrow as pa

        stretches = self.stretches or (no_moves(self.axes),)
        tables = [s.to_arrow(self.axes, self.sampled) for s in stretches]
        return pa.concat_tables(tables).combine_chunks()

    def to_pandas(self) -> Any:
        """The table of `to_arrow` as a DataFrame; needs pandas."""
        return self.to_arrow().to_pandas()

    def write(self, path: str | Path) -> None:
        """The table of `to_arrow` as a .parquet or .csv file; raises ValueError for another."""
        import pyarrow.csv
        import pyarrow.parquet

        path = Path(path)
        if path.suffix not in (".parquet", ".csv"):
            raise ValueError(f"{path.name}: the name must end in .parquet or .csv")
        if path.suffix == ".parquet":
            table = self.to_arrow()
            pyarrow.parquet.write_table(table, path, **parquet_options(table.schema))
        else:
            pyarrow.csv.write_csv(self.to_arrow(), path)

    # --- parts ---------------------------------------------------------------------------------

    def _at(self, line: int) -> Visit:
        """The last run of a line; KeyError, naming the nearest line, when there was none."""
        found = self._last_row(line) or self._places.get(line)
        if found is None:
            lines = [s.line for s in self.stretches if self._is_main(s)]
            executed = [*self._places, *(int(v) for column in lines for v in np.unique(column))]
            near = min(executed, key=lambda other: abs(other - line), default=None)
            hint = f"; the nearest is line {near}" if near is not None else ""
            raise KeyError(f"line {line} was not executed{hint}")
        return found

    def _last_row(self, line: int) -> Visit | None:
        for s in reversed(self.stretches):
            rows = np.flatnonzero(s.line == line)
            if len(rows) and self._is_main(s):
                i = int(rows[-1])
                block = None if s.block[i] == NO_BLOCK else int(s.block[i])
                near = s.acs[i - 1] if i else s.start
                return Visit(s.coordinates, s.axes, s.file, block, s.pcs[i], near, s.acs[i])
        return None

    def _is_main(self, s: Stretch) -> bool:
        return not self._file or s.file == self._file

    def _column(self, pick: Callable[[Stretch], Any], dtype: Any) -> Any:
        parts = [pick(s) for s in self.stretches]
        return np.concatenate(parts) if parts else np.array([], dtype=dtype)

    def _matrix(self, pick: Callable[[Stretch], Array]) -> Array:
        result = np.full((len(self), len(self.axes)), np.nan)
        row = 0
        for s in self.stretches:
            columns = [self.axes.index(a) for a in s.axes]
            result[row : row + len(s), columns] = pick(s)
            row += len(s)
        return result


def no_moves(axes: tuple[str, ...]) -> Stretch:
    """A stretch without rows, for the columns of a run without moves."""
    none, rows = np.empty(0), np.empty((0, len(axes)))
    lines = np.empty(0, dtype=np.int64)
    motion = np.empty(0, dtype=np.int8)
    start = np.zeros(len(axes))
    return Stretch(Coordinates(len(axes)), axes, "", lines, lines, motion, none, rows, rows, start)


def parquet_options(schema: Any) -> dict[str, Any]:
    """How the columns of a table are written. Coordinates rarely repeat, so a dictionary of them
    would be as long as they are; their bytes are put together by place, of which the upper ones
    hardly change from move to move."""
    encodings = {"double": "BYTE_STREAM_SPLIT", "int64": "DELTA_BINARY_PACKED"}
    kinds = {field.name: str(field.type) for field in schema}
    return {
        "compression": "snappy",
        "use_dictionary": ["motion"],
        "column_encoding": {n: encodings[k] for n, k in kinds.items() if k in encodings},
    }


def _names(codes: NDArray[np.int8]) -> Any:
    """The names of motions as an Arrow array of strings, without loading Arrow's functions."""
    import pyarrow as pa

    padded = np.array(MOTIONS, dtype="S")
    letters = padded.view(np.uint8).reshape(len(MOTIONS), -1)[codes]
    ends = np.zeros(len(codes) + 1, dtype=np.int32)
    np.cumsum(np.char.str_len(padded)[codes], out=ends[1:])
    text = letters[letters != 0]
    return pa.StringArray.from_buffers(len(codes), pa.py_buffer(ends), pa.py_buffer(text))
