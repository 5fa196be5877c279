"""A run as one document: machine, messages, path, travel, pole, blocks, explained blocks.

Enters: a run with its machine and lists. Leaves: html that loads nothing and runs nothing.
Every text of a program or list is escaped by the template; pictures are images, not markup.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

import jinja2
import numpy as np
from rich.table import Table

from ncscope.diagnostics import Diagnostic, render
from ncscope.explanation import Explanation
from ncscope.inspection import Inspection, Travel, inspect, place
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.machine import Machine
from ncscope.trajectory import Trajectory
from ncscope.views.pictures.files import chain_picture, path_picture
from ncscope.views.table import explain_table, number, run_table

FIRST, LAST = 800, 200
"""Blocks of a long run that the table shows."""
MOST_EVENTS = 100
MOST_CHAINS = 3


@dataclass(frozen=True, slots=True)
class Subject:
    """What a report is about. lists: name and kind. options: how it was run, in words.

    explained: the source line and the explanation of each chosen block.
    """

    name: str
    machine: Machine
    result: Trajectory
    diagnostics: Sequence[Diagnostic] = ()
    lists: Sequence[tuple[str, str]] = ()
    options: str = ""
    explained: Sequence[tuple[str, Explanation]] = ()


def report_page(subject: Subject) -> bytes:
    """The report as html, utf-8."""
    result = subject.result
    inspection = inspect(result)
    values: dict[str, Any] = {
        "program": subject.name,
        "ok": result.ok,
        "summary": _summary(result),
        "machine": subject.machine.name,
        "axes": " ".join(result.axes),
        "lists": subject.lists,
        "options": subject.options,
        "diagnostics": [
            {"severity": str(d.severity), "text": render(d)}
            for d in (*subject.diagnostics, *result.diagnostics)
        ],
        "messages": [(m.text, m.file or "display") for m in result.messages],
        "path": _image(path_picture(result, subject.name, "svg")) if len(result) else "",
        "travel": [_travel_row(result, t) for t in inspection.travel],
        **_pole(result, inspection),
        "chain": _chains(subject),
        "blocks": _columns(run_table(result.at_ends(), first=FIRST, last=LAST)),
        "explained": [
            {"place": _where(e.line, e.block), "text": line, "table": _columns(explain_table(e))}
            for line, e in subject.explained
        ],
    }
    values["sections"] = _sections(values)
    return _template().render(values).encode()


def _template() -> jinja2.Template:
    text = resources.files("ncscope.views").joinpath("report.html").read_text(encoding="utf-8")
    surroundings = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return surroundings.from_string(text)


def _sections(values: dict[str, Any]) -> list[str]:
    names = ["Machine", "Messages and warnings", "Path", "Travel", "Pole", "Blocks"]
    if values["chain"]:
        names.insert(5, "Kinematics")
    return [*names, *(["Explained"] if values["explained"] else [])]


def _summary(result: Trajectory) -> str:
    status = "ran to its end" if result.ok else "stopped by an error"
    return f"{int(result.end.sum()):,} motion blocks, {status}"


def _image(svg: bytes) -> str:
    return "data:image/svg+xml;base64," + base64.b64encode(svg).decode()


def _travel_row(result: Trajectory, travel: Travel) -> dict[str, str]:
    axis, limits = travel.axis, travel.axis.limits
    row = {
        "name": axis.name,
        "low": number(travel.low),
        "low_block": _block(result, travel.low_row),
        "high": number(travel.high),
        "high_block": _block(result, travel.high_row),
        "limits": "no software limits",
        "left": "",
        "beyond": "",
    }
    if limits is not None:
        row["limits"] = f"{limits[0]:g} to {limits[1]:g}"
        row["left"] = number(min(travel.low - limits[0], limits[1] - travel.high))
        rows = np.concatenate([travel.below, travel.above])
        if len(rows):
            row["beyond"] = f"beyond, first at {_block(result, int(rows.min()))}"
    return row


def _pole(result: Trajectory, inspection: Inspection) -> dict[str, Any]:
    nearest, text = inspection.nearest_to_pole, ""
    if nearest is not None:
        text = (
            f"The tool comes as near as {nearest[0]:.4f} degrees to the singular direction, "
            f"at block {_block(result, nearest[1])}. Swings of the first rotary axis: "
            f"{len(inspection.swings)}."
        )
    swings = [
        (
            s.axis,
            " to ".join(dict.fromkeys((_block(result, s.row), _block(result, s.last)))),
            f"{s.swing:.4f}",
            f"{s.distance:.4f}",
        )
        for s in inspection.swings[:MOST_EVENTS]
    ]
    wraps = [
        (w.axis.name, _block(result, w.row), number(w.before), number(w.after))
        for w in inspection.wraps[:MOST_EVENTS]
    ]
    return {"pole": text, "swings": swings, "wraps": wraps}


def _chains(subject: Subject) -> list[str]:
    """A picture of each universal kinematics that was active, with the tool of its first block."""
    found: dict[int, tuple[UniversalKinematics, float]] = {}
    for s in subject.result.stretches:
        active = s.coordinates.kinematics
        if active is not None and isinstance(active.model, UniversalKinematics):
            found.setdefault(id(active.model), (active.model, s.coordinates.tool.length))
    return [
        _image(chain_picture(model, subject.machine.name, length, "svg"))
        for model, length in list(found.values())[:MOST_CHAINS]
    ]


def _columns(table: Table) -> dict[str, Any]:
    """A table of the screen as names and rows; numbers are the columns that stand right."""
    return {
        "names": [str(c.header) for c in table.columns],
        "numbers": [i for i, c in enumerate(table.columns) if c.justify == "right"],
        "rows": list(zip(*(list(c.cells) for c in table.columns), strict=True)),
    }


def _block(result: Trajectory, row: int) -> str:
    file, line, block = place(result, row)
    own = "" if file == result.stretches[0].file else f" in {file}"
    return _where(line, block) + own


def _where(line: int, block: int | None) -> str:
    return f"line {line}" if block is None else f"N{block}"
