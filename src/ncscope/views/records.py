"""A run as jsonl or csv: one line a move, numbers with full precision, mm and degrees.

A row is a template with gaps (`splicing`); the numbers of many moves become text in one call.
"""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any, TextIO

import numpy as np
import orjson
from numpy.typing import NDArray

from ncscope.diagnostics import Diagnostic
from ncscope.frames import Array
from ncscope.motion import MOTIONS
from ncscope.trajectory import SYSTEMS, Stretch, Trajectory
from ncscope.views.splicing import Template

ROWS = 20_000
"""Moves that are turned into text at a time."""
Lines = NDArray[np.uint8] | bytes
"""Text in UTF-8."""


class NewAxis(Exception):
    """A move has an axis for which the file has no column."""


class JsonlWriter:
    """One object a line: diagnostics from before the run, moves, diagnostics, messages, the end.

    A point on the way to the end of a move has the kind `point` and the index of its move.
    """

    def __init__(self, out: TextIO, before: Iterable[Diagnostic] = ()) -> None:
        self.out, self.moves = out, 0
        self._diagnostics(before)

    def write(self, stretch: Stretch) -> None:
        for lines in _json_moves(stretch, self.moves):
            _put(self.out, lines)
        self.moves += int(stretch.end.sum())

    def finish(self, result: Trajectory | None, ok: bool) -> None:
        """What a run says at its end; without a result it was broken off."""
        if result is not None:
            self._diagnostics(result.diagnostics)
            for message in result.messages:
                record = {"kind": "message", "file": message.file, "text": message.text}
                self.out.write(_json(record))
        status = "ok" if ok else "error"
        self.out.write(_json({"kind": "end", "status": status, "moves": self.moves}))

    def _diagnostics(self, items: Iterable[Diagnostic]) -> None:
        for item in items:
            self.out.write(_json(diagnostic_record(item)))


class CsvWriter:
    """A header line, then a line a move; empty where an axis was not in the channel.

    A sampled run has a last column `end`: 1 at the end of a move, 0 on the way there.
    `write` raises NewAxis for a stretch with an axis that is none of `axes`.
    """

    def __init__(self, out: TextIO, axes: tuple[str, ...], sampled: bool = False) -> None:
        self.out, self.axes, self.sampled = out, axes, sampled
        names = [f"{s}_{a}" for s in SYSTEMS for a in _columns(s, axes)]
        direction = [f"direction_{c}" for c in "ijk"]
        head = ["file", "line", "block", "motion", "feed"]
        csv.writer(out, lineterminator="\n").writerow(
            [*head, *names, *direction, *(["end"] if sampled else [])]
        )

    def write(self, stretch: Stretch) -> None:
        if not set(stretch.axes) <= set(self.axes):
            raise NewAxis
        for lines, ends in _csv_moves(stretch, self.axes):
            _put(self.out, _with_ends(lines, ends) if self.sampled else lines)

    def finish(self, result: Trajectory | None, ok: bool) -> None:
        """Nothing follows the moves."""


def write_jsonl(out: TextIO, result: Trajectory, before: Iterable[Diagnostic], ok: bool) -> None:
    """A finished run as `JsonlWriter` writes it."""
    writer = JsonlWriter(out, before)
    for stretch in result.stretches:
        writer.write(stretch)
    writer.finish(result, ok)


def write_csv(out: TextIO, result: Trajectory) -> None:
    """A finished run as `CsvWriter` writes it."""
    writer = CsvWriter(out, result.axes, result.sampled)
    for stretch in result.stretches:
        writer.write(stretch)


def move_record(result: Trajectory, index: int) -> str:
    """The line of one move of a run without points on the way, by its row. Raises IndexError."""
    stretch, row = result.locate(index)
    one = slice(row, row + 1)
    columns = ("line", "block", "motion", "feed", "pcs", "acs")
    part = replace(stretch, **{name: getattr(stretch, name)[one] for name in columns})
    return bytes(next(_json_moves(part, index))).decode()


def diagnostic_record(item: Diagnostic) -> dict[str, Any]:
    """The object of one diagnostic; `file`, `line` and `column` are null without a place."""
    return {
        "kind": "diagnostic",
        "id": item.id,
        "severity": str(item.severity),
        "file": item.file,
        "line": item.line,
        "column": item.column,
        "message": item.message,
    }


def _json(record: Any) -> str:
    return orjson.dumps(record, option=orjson.OPT_APPEND_NEWLINE).decode()


def _put(out: TextIO, lines: Lines) -> None:
    """Lines in UTF-8 to a stream of text: past its encoder where that would change nothing."""
    below = getattr(out, "buffer", None)
    if below is None or out.encoding.lower() not in ("utf-8", "utf8") or os.linesep != "\n":
        out.write(bytes(lines).decode())
    else:
        out.flush()
        below.write(lines)


def _json_moves(s: Stretch, first: int) -> Iterator[Lines]:
    """Chunks of lines, one object a move."""
    template = _json_template(s.file, s.axes, s.direction is not None)
    index = first + np.cumsum(s.end) - s.end
    for start, stop in _chunks(len(s)):
        whole = np.column_stack([index[start:stop], s.line[start:stop], s.block[start:stop]])
        lines = template.rows(whole, s.motion[start:stop], _matrix(s, s.axes, start, stop))
        yield lines if s.ends is None else _with_points(lines, s.ends[start:stop])


def _with_points(lines: Lines, ends: Iterable[bool]) -> bytes:
    """The lines of moves with the kind `point` where they are no ends."""
    move, point = b'{"kind":"move"', b'{"kind":"point"'
    pairs = zip(bytes(lines).splitlines(keepends=True), ends, strict=True)
    return b"".join(line if end else point + line[len(move) :] for line, end in pairs)


@cache
def _json_template(file: str, axes: tuple[str, ...], directed: bool) -> Template:
    gap = "\0"

    def system(name: str) -> str:
        keys = (_json(axis).strip() for axis in _columns(name, axes))
        return '"{}":{{{}}}'.format(name, ",".join(f"{key}:{gap}" for key in keys))

    direction = f"[{gap},{gap},{gap}]" if directed else "null"
    row = (
        f'{{"kind":"move","index":{gap},"file":{_json(file).strip()},"line":{gap},"block":{gap},'
        f'"motion":"{gap}","feed":{gap},{system("pcs")},{system("wcs")},{system("mcs")},'
        f'"direction":{direction},{system("acs")}}}\n'
    )
    return Template(tuple(row.split(gap)), MOTIONS, "null")


def _csv_moves(s: Stretch, axes: tuple[str, ...]) -> Iterator[tuple[Lines, NDArray[np.bool_]]]:
    template = _csv_template(s.file, axes)
    for start, stop in _chunks(len(s)):
        whole = np.column_stack([s.line[start:stop], s.block[start:stop]])
        matrix = _matrix(s, axes, start, stop, direction_last=True)
        yield template.rows(whole, s.motion[start:stop], matrix), s.end[start:stop]


def _with_ends(lines: Lines, ends: Iterable[bool]) -> bytes:
    """Lines with the column `end`."""
    pairs = zip(bytes(lines).splitlines(), ends, strict=True)
    return b"".join(b"%s,%d\n" % (line, end) for line, end in pairs)


@cache
def _csv_template(file: str, axes: tuple[str, ...]) -> Template:
    quoted = io.StringIO()
    csv.writer(quoted, lineterminator="").writerow([file])
    numbers = 1 + sum(len(_columns(system, axes)) for system in SYSTEMS) + 3
    gaps = 3 + numbers  # line, block, motion
    return Template((f"{quoted.getvalue()},", *[","] * (gaps - 1), "\n"), MOTIONS, "")


def _chunks(count: int) -> Iterator[tuple[int, int]]:
    for start in range(0, count, ROWS):
        yield start, min(start + ROWS, count)


def _columns(system: str, axes: tuple[str, ...]) -> tuple[str, ...]:
    """The machine system has the three main axes only."""
    return axes[:3] if system == "mcs" else axes


def _matrix(
    s: Stretch, axes: tuple[str, ...], start: int, stop: int, direction_last: bool = False
) -> Array:
    """Rows `start` to `stop`: feed, the four systems, the tool direction before or behind the
    ACS."""
    parts = [s.feed[start:stop, None]]
    for system in SYSTEMS:
        values = getattr(s, system)[start:stop]
        wanted = _columns(system, axes)
        missing = np.full(stop - start, np.nan)
        parts.append(
            np.column_stack(
                [values[:, s.axes.index(a)] if a in s.axes else missing for a in wanted]
            )
        )
    if s.direction is not None:
        parts.insert(5 if direction_last else 4, s.direction[start:stop])
    elif direction_last:
        parts.append(np.full((stop - start, 3), np.nan))
    return np.ascontiguousarray(np.concatenate(parts, axis=1))
