"""A folder below `cases` is a test: program, machine, expected text.

`main.nc`      the program, or `program` with the name of one in examples/programs
`machine`      name of a folder in examples/machines; without it, lists in the case folder; without
               those, axes X Y Z
`probe.csv`    answers of the probe; `manual.csv` jog increments
`options`      lines `skip 1 3`, `clamp 2`, `max_blocks 5`, `strict`, `sample 0.1`
`known_bug`    why the case fails today; the case must be freed of it when it passes
`expected.txt` one line per move, then diagnostics and messages:

    N40 acs X 10 Y 0 Z 0        block N40; L7 instead when line 7 has no block number
    N40 pcs X 10                the same move in another system; only axes named are compared
    diagnostic 20396 @ 5:11     every error and warning of the run, id and line:column
    list 1019 @ nullp.lis:4:5   every error and warning of the lists, where one line names any
    message message.txt: text   every message in order; `-` when it is for the display

NCSCOPE_REWRITE=1 writes the expected texts anew; the diff is to be read before it is kept.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest

import ncscope
from ncscope.machine import Machine

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"
CASES = sorted(p.parent for p in (HERE / "cases").glob("*/expected.txt"))
SYSTEMS = ("acs", "pcs", "wcs", "mcs")
TOLERANCE = 1e-6
MOVE = re.compile(r"([NL]\d+) (acs|pcs|wcs|mcs) (.*)")


@dataclass
class Expected:
    """An expected text: moves as (label, {system: {axis: value}}), and the other lines."""

    moves: list[tuple[str, dict[str, dict[str, float]]]] = field(default_factory=list)
    rest: list[str] = field(default_factory=list)
    lists: list[str] = field(default_factory=list)


def read_expected(text: str) -> Expected:
    expected = Expected()
    for line in text.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("list "):
            expected.lists.append(line)
            continue
        match = MOVE.fullmatch(line)
        if match is None:
            assert line.startswith(("diagnostic ", "message ")), f"not an expectation: {line}"
            expected.rest.append(line)
            continue
        label, system, values = match.groups()
        words = values.split()
        pairs = zip(words[::2], map(float, words[1::2]), strict=True)
        moves = expected.moves
        if not moves or moves[-1][0] != label or system in moves[-1][1]:
            moves.append((label, {}))
        moves[-1][1][system] = dict(pairs)
    return expected


def run_case(folder: Path, bulk: bool | None = None) -> ncscope.Trajectory:
    """bulk: whether every plain block takes the bulk lane, None as the length of the program is."""
    shared = folder / "program"
    path = EXAMPLES / "programs" / shared.read_text().strip() if shared.exists() else None
    machine = machine_of(folder)
    options = replace(options_of(folder), bulk=bulk)
    return ncscope.run(machine, ncscope.load_program(path or folder / "main.nc"), options)


def machine_of(folder: Path) -> Machine:
    name = folder / "machine"
    if name.exists():
        return ncscope.load_machine(EXAMPLES / "machines" / name.read_text().strip())[0]
    if list(folder.glob("*.lis")):
        return ncscope.load_machine(folder)[0]
    return Machine()


def lists_of(folder: Path) -> list[str]:
    _, found = ncscope.load_machine(folder)
    serious = [d for d in found if d.severity != "note"]
    return [f"list {d.id} @ {d.file}:{d.line}:{d.column}" for d in serious]


def options_of(folder: Path) -> ncscope.Options:
    given: dict = {}
    file = folder / "options"
    for line in file.read_text().splitlines() if file.exists() else ():
        key, *values = line.split()
        if key == "skip":
            given[key] = frozenset(map(int, values))
        elif key == "sample":
            given[key] = float(values[0])
        else:
            given[key] = int(values[0]) if values else True
    for name in ("probe", "manual"):
        if (folder / f"{name}.csv").exists():
            given[name], problems = ncscope.load_rows(folder / f"{name}.csv")
            assert problems == ()
    return ncscope.Options(**given)


def labels_of(result: ncscope.Trajectory) -> list[str]:
    blocks, lines = result.block.tolist(), result.line.tolist()
    return [f"N{b}" if b >= 0 else f"L{n}" for b, n in zip(blocks, lines, strict=True)]


def rest_of(result: ncscope.Trajectory) -> list[str]:
    lines = [
        f"diagnostic {d.id} @ {d.line}:{d.column}"
        for d in result.diagnostics
        if d.severity != "note"
    ]
    return [*lines, *(f"message {m.file or '-'}: {m.text}".rstrip() for m in result.messages)]


def written(result: ncscope.Trajectory, old: Expected) -> str:
    """The run as an expected text, with the systems that the old text showed."""
    lines = []
    for i, label in enumerate(labels_of(result)):
        shown = old.moves[i][1] if i < len(old.moves) else {"acs": {}}
        for system in shown:
            values = zip(result.axes, getattr(result, system)[i].tolist(), strict=True)
            text = " ".join(f"{axis} {_short(v)}" for axis, v in values if v == v)
            lines.append(f"{label} {system} {text}")
    return "\n".join([*lines, *rest_of(result), *old.lists]) + "\n"


def _short(value: float) -> str:
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


@pytest.mark.parametrize("bulk", [None, True], ids=["short", "bulk"])
@pytest.mark.parametrize("folder", CASES, ids=lambda p: p.name)
def test_case(folder: Path, bulk: bool | None, request: pytest.FixtureRequest) -> None:
    bug = folder / "known_bug"
    if bug.exists():
        reason = bug.read_text(encoding="utf-8").strip()
        request.applymarker(pytest.mark.xfail(reason=reason, strict=True))
    file = folder / "expected.txt"
    expected = read_expected(file.read_text(encoding="utf-8"))
    result = run_case(folder, bulk)
    if os.environ.get("NCSCOPE_REWRITE"):
        file.write_text(written(result, expected), encoding="utf-8")
        return
    shown = "\n".join(ncscope.render(d) for d in result.diagnostics)
    assert rest_of(result) == expected.rest, shown
    if expected.lists:
        assert lists_of(folder) == expected.lists
    assert labels_of(result) == [label for label, _ in expected.moves], shown
    for i, (label, systems) in enumerate(expected.moves):
        for system, values in systems.items():
            row = dict(zip(result.axes, getattr(result, system)[i].tolist(), strict=True))
            actual = {axis: row.get(axis) for axis in values}
            assert actual == pytest.approx(values, abs=TOLERANCE, rel=0), f"{label} {system}"


def test_every_case_folder_has_an_expected_text() -> None:
    folders = {p for p in (HERE / "cases").iterdir() if p.is_dir()}
    assert folders == set(CASES)


def test_case_may_name_only_axes_that_exist() -> None:
    """A wrong axis name in an expected text must fail, not pass unseen."""
    expected = read_expected("N1 acs Q 1\n")
    result = ncscope.run(Machine(), "N1 X1\nM30\n")
    row = dict(zip(result.axes, result.acs[0].tolist(), strict=True))
    assert {a: row.get(a) for a in expected.moves[0][1]["acs"]} == {"Q": None}


def test_printed_list_fails_with_the_lines_that_overwrote_the_axis() -> None:
    """FCT-C27 4.1.2 as printed: `axis[0].orientation[0] 0` three times too often."""
    folder = EXAMPLES / "machines" / "ac_table_as_printed"
    machine, _ = ncscope.load_machine(folder)
    result = ncscope.run(machine, "N10 #KIN ID [91]\nN20 #TRAFO ON\nN30 X1\nM30\n")
    assert not result.ok and len(result) == 0
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.id, error.line) == ("292007", 2)
    assert "axis 0" in error.message.lower()
    lines = (folder / "sda.lis").read_text().splitlines()
    writers = [n for n, t in enumerate(lines, 1) if "axis[0].orientation[0]" in t]
    assert len(writers) == 4
    blamed = [span.line for _, span in error.notes if span.source.name == "sda.lis"]
    assert set(writers) <= set(blamed)


def test_unknown_axis_names_the_axes_of_the_channel() -> None:
    path = EXAMPLES / "programs" / "test_program_as_printed.nc"
    result = ncscope.run(Machine(), ncscope.load_program(path))
    (error,) = [d for d in result.diagnostics if d.is_error]
    text = ncscope.render(error)
    assert error.id == "20200" and "X Y Z A C" in text and "N00910 G00 X0 Y0 Z0 B0" in text


def test_unknown_command_has_a_hint() -> None:
    result = ncscope.run(Machine(), "#TRAFFO ON\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert error.id == "20509" and "#TRAFO" in error.hint


def test_two_of_a_group_point_at_both_words() -> None:
    result = ncscope.run(Machine(), "N10 G17 G18 X1\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (error.column, error.span.text.strip()) == (9, "G18")
    assert [span.column for _, span in error.notes] == [5]


def test_unsupported_command_is_named_and_marked() -> None:
    result = ncscope.run(Machine(), "N10 X1\nN20   G303 X10 Y0 I5\nN30 X2\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert error.id == "N2001" and "G303" in error.message
    marker = next(t for t in ncscope.render(error).splitlines() if "^" in t)
    line = next(t for t in ncscope.render(error).splitlines() if "G303 X10" in t)
    assert marker.index("^") == line.index("G303")
    assert len(result) == 1 and not result.ok
