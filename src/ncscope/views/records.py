"""A run as jsonl or csv: one line a move, numbers with full precision, mm and degrees."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable, Iterator
from typing import Any, TextIO

from ncscope.diagnostics import Diagnostic
from ncscope.trajectory import MOTIONS, NO_BLOCK, Stretch, Trajectory


def write_jsonl(out: TextIO, result: Trajectory, before: Iterable[Diagnostic], ok: bool) -> None:
    """Moves, diagnostics, messages, and the end with the status; one object a line."""
    for record in jsonl_records(result, before, ok):
        out.write(json.dumps(record, ensure_ascii=False, separators=(",", ":")) + "\n")


def jsonl_records(
    result: Trajectory, before: Iterable[Diagnostic], ok: bool
) -> Iterator[dict[str, Any]]:
    yield from map(diagnostic_record, before)
    index = 0
    for stretch in result.stretches:
        yield from _moves(stretch, index)
        index += len(stretch)
    yield from map(diagnostic_record, result.diagnostics)
    for message in result.messages:
        yield {"kind": "message", "file": message.file, "text": message.text}
    yield {"kind": "end", "status": "ok" if ok else "error", "moves": index}


def diagnostic_record(item: Diagnostic) -> dict[str, Any]:
    return {
        "kind": "diagnostic",
        "id": item.id,
        "severity": str(item.severity),
        "file": item.file,
        "line": item.line,
        "column": item.column,
        "message": item.message,
    }


def _moves(s: Stretch, first: int) -> Iterator[dict[str, Any]]:
    names, main = s.axes, s.axes[:3]
    lines, blocks, feeds = s.line.tolist(), s.block.tolist(), s.feed.tolist()
    motions = [MOTIONS[m] for m in s.motion.tolist()]
    pcs, wcs, acs = s.pcs.tolist(), s.wcs.tolist(), s.acs.tolist()
    mcs = s.mcs[:, :3].tolist()
    directions = [None] * len(s) if s.direction is None else s.direction.tolist()
    for i in range(len(s)):
        yield {
            "kind": "move",
            "index": first + i,
            "file": s.file,
            "line": lines[i],
            "block": None if blocks[i] == NO_BLOCK else blocks[i],
            "motion": motions[i],
            "feed": None if math.isnan(feeds[i]) else feeds[i],
            "pcs": dict(zip(names, pcs[i], strict=True)),
            "wcs": dict(zip(names, wcs[i], strict=True)),
            "mcs": dict(zip(main, mcs[i], strict=True)),
            "direction": directions[i],
            "acs": dict(zip(names, acs[i], strict=True)),
        }


def write_csv(out: TextIO, result: Trajectory) -> None:
    """A header line, then a line a move; empty where an axis was not in the channel."""
    writer = csv.writer(out, lineterminator="\n")
    systems = ("pcs", "wcs", "mcs", "acs")
    axes = result.axes
    header = [f"{s}_{a}" for s in systems for a in (axes[:3] if s == "mcs" else axes)]
    writer.writerow(
        ["file", "line", "block", "motion", "feed", *header,
         "direction_i", "direction_j", "direction_k"]
    )  # fmt: skip
    for stretch in result.stretches:
        for move in _moves(stretch, 0):
            direction = move["direction"] or ("", "", "")
            values = [
                move[s].get(a, "") for s in systems for a in (axes[:3] if s == "mcs" else axes)
            ]
            head = [move["file"], move["line"], move["block"], move["motion"], move["feed"]]
            writer.writerow([*("" if v is None else v for v in head), *values, *direction])
