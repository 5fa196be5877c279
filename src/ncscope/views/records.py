"""A run as jsonl or csv: one line a move, numbers with full precision, mm and degrees.

The numbers of many moves are turned into text by orjson in one call; a million moves are written
in seconds.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from typing import Any, TextIO

import numpy as np
import orjson

from ncscope.diagnostics import Diagnostic
from ncscope.frames import Array
from ncscope.trajectory import MOTIONS, NO_BLOCK, Stretch, Trajectory

ROWS = 20_000
"""Moves that are turned into text at a time."""
SYSTEMS = ("pcs", "wcs", "mcs", "acs")


def write_jsonl(out: TextIO, result: Trajectory, before: Iterable[Diagnostic], ok: bool) -> None:
    """Moves, diagnostics, messages, and the end with the status; one object a line."""
    for item in before:
        out.write(_json(diagnostic_record(item)))
    index = 0
    for stretch in result.stretches:
        for text in _json_moves(stretch, index):
            out.write(text)
        index += len(stretch)
    for item in result.diagnostics:
        out.write(_json(diagnostic_record(item)))
    for message in result.messages:
        out.write(_json({"kind": "message", "file": message.file, "text": message.text}))
    out.write(_json({"kind": "end", "status": "ok" if ok else "error", "moves": index}))


def write_csv(out: TextIO, result: Trajectory) -> None:
    """A header line, then a line a move; empty where an axis was not in the channel."""
    names = [f"{s}_{a}" for s in SYSTEMS for a in _columns(s, result.axes)]
    direction = [f"direction_{c}" for c in "ijk"]
    head = ["file", "line", "block", "motion", "feed"]
    csv.writer(out, lineterminator="\n").writerow([*head, *names, *direction])
    for stretch in result.stretches:
        for text in _csv_moves(stretch, result.axes):
            out.write(text)


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


def _json_moves(s: Stretch, first: int) -> Iterator[str]:
    """Chunks of lines; every number of a move goes into its place of one template."""
    template = _template(s)
    for start, stop in _chunks(len(s)):
        rows = _numbers(_matrix(s, s.axes, start, stop))
        heads = zip(*_heads(s, start, stop, "null"), strict=True)
        yield "".join(
            template % (first + start + i, *head, *row.split(","))
            for i, (head, row) in enumerate(zip(heads, rows, strict=True))
        )


def _template(s: Stretch) -> str:
    def system(name: str) -> str:
        keys = (_json(axis).strip().replace("%", "%%") for axis in _columns(name, s.axes))
        return '"{}":{{{}}}'.format(name, ",".join(f"{key}:%s" for key in keys))

    file = _json(s.file).strip().replace("%", "%%")
    direction = "null" if s.direction is None else "[%s,%s,%s]"
    return (
        f'{{"kind":"move","index":%d,"file":{file},"line":%s,"block":%s,"motion":"%s","feed":%s,'
        f"{system('pcs')},{system('wcs')},{system('mcs')},"
        f'"direction":{direction},{system("acs")}}}\n'
    )


def _csv_moves(s: Stretch, axes: tuple[str, ...]) -> Iterator[str]:
    quoted = io.StringIO()
    csv.writer(quoted, lineterminator="").writerow([s.file])
    for start, stop in _chunks(len(s)):
        matrix = _matrix(s, axes, start, stop, direction_last=True)
        rows = (row.replace("null", "") for row in _numbers(matrix))
        heads = zip(*_heads(s, start, stop, ""), strict=True)
        yield "".join(
            f"{quoted.getvalue()},{','.join(head)},{row}\n"
            for head, row in zip(heads, rows, strict=True)
        )


def _chunks(count: int) -> Iterator[tuple[int, int]]:
    for start in range(0, count, ROWS):
        yield start, min(start + ROWS, count)


def _heads(s: Stretch, start: int, stop: int, none: str) -> tuple[list[str], ...]:
    """Line, block, motion and feed of each move as text."""
    part = slice(start, stop)
    blocks = [none if b == NO_BLOCK else str(b) for b in s.block[part].tolist()]
    feeds = [none if f == "null" else f for f in _numbers(s.feed[part, None])]
    motions = [MOTIONS[m] for m in s.motion[part].tolist()]
    return [str(line) for line in s.line[part].tolist()], blocks, motions, feeds


def _columns(system: str, axes: tuple[str, ...]) -> tuple[str, ...]:
    """The machine system has the three main axes only."""
    return axes[:3] if system == "mcs" else axes


def _matrix(
    s: Stretch, axes: tuple[str, ...], start: int, stop: int, direction_last: bool = False
) -> Array:
    """Rows `start` to `stop`: the four systems, the tool direction before or behind the ACS."""
    parts = []
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
        parts.insert(4 if direction_last else 3, s.direction[start:stop])
    elif direction_last:
        parts.append(np.full((stop - start, 3), np.nan))
    return np.ascontiguousarray(np.concatenate(parts, axis=1))


def _numbers(matrix: Array) -> list[str]:
    """Each row as text with commas: the shortest digits that read back as the same number."""
    text = orjson.dumps(np.ascontiguousarray(matrix), option=orjson.OPT_SERIALIZE_NUMPY)
    return text.decode()[2:-2].split("],[")
