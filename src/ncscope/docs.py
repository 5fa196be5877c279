"""The reference pages of the docs, generated from the tables that the program itself uses.

Enters: the tables of commands, G functions, NC variables, diagnostics and list parameters. Leaves:
Markdown pages by file name. `python -m ncscope.docs FOLDER` writes them into a folder.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from pathlib import Path

from ncscope.catalogue import CATALOGUE
from ncscope.channel.gfunctions import GFUNCTIONS
from ncscope.channel.variables import VARIABLES, Row
from ncscope.language.commands import COMMANDS
from ncscope.language.vocabulary import WORDS
from ncscope.lists import table
from ncscope.lists.reference_page import parameters_page
from ncscope.seed_commands import SEED_COMMANDS, SeedCommand

G_EFFECTS = {
    "motion": "Motion",
    "modal": "Modal state",
    "offset": "Offsets",
    "contour": "Programmed contour: mirror and rotation",
    "call": "Call of a configured subprogram",
    "quiet": "Noted once, without effect on positions",
    "refused": "Refused by name",
}
COMMAND_KINDS = {
    "modelled": "Modelled",
    "no effect": "Noted once, without effect on positions",
    "refused": "Refused by name",
}
OWN_RANGES = {
    "N1": "the language",
    "N2": "the channel",
    "N3": "the lists",
    "N4": "the run and its options",
}


PROGRAM_VARIABLES = (
    ("`P5`, `P[expr]`", "first write or `#VAR`", "parameter; numbers from 1"),
    ("`V.P.NAME`", "first write or `#VAR`", "variable of the program"),
    ("`V.S.NAME`", "first write or `#VAR`", "variable that outlives a program"),
    ("`V.L.NAME`", "`#VAR` only", "variable of a program level and those below"),
    ("`V.CYC.NAME`", "`#VAR` only", "as `V.L`, in cycles"),
    ("`V.E.NAME`", "list of external variables, `--set`", "variable of the PLC"),
    ("`@P1`", "call of a cycle", "parameter of a cycle"),
)
"""Name, what makes it, and what it is."""


def pages() -> dict[str, str]:
    """Markdown by file name; every page comes from one table."""
    return {
        "commands.md": commands_page(),
        "diagnostics.md": diagnostics_page(),
        "parameters.md": parameters_page(),
        "seed_commands.md": seed_commands_page(),
        "variables.md": variables_page(),
    }


def write(folder: Path) -> None:
    """Writes the pages into a folder, which is made when needed."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages().items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")


def commands_page() -> str:
    """What happens with each G function and each # command."""
    parts = [
        "# Commands",
        "A modelled command does what the control does.\n"
        "A command without effect on positions is noted once (N2002) and skipped.\n"
        "A command that is refused ends the run with N2001, because every position after it "
        "would be a guess.\n"
        "A command that stands in no table below is unknown (20131 for G functions, 20509 for "
        "# commands).",
        "## G functions",
    ]
    for effect, title in G_EFFECTS.items():
        found = [(f"G{n:02d}", g) for n, g in sorted(GFUNCTIONS.items()) if g.effect == effect]
        lines = [_cells(name, g.group or "", g.double_id or "", g.purpose) for name, g in found]
        parts += _section(title, "G function|group|two in a block|purpose", lines)
    parts.append("## # commands")
    for kind, title in COMMAND_KINDS.items():
        lines = [_cells(f"`#{c.name}`", c.purpose) for c in COMMANDS if c.kind == kind]
        parts += _section(title, "command|purpose", lines)
    parts.append("## Other words")
    for kind, title in COMMAND_KINDS.items():
        lines = [_cells(f"`{w.name}`", w.purpose) for w in WORDS if w.kind == kind]
        parts += _section(title, "word|purpose", lines)
    return _page(parts)


def seed_commands_page() -> str:
    """The commands of the manuals about offsets with status and test case."""
    lines = (
        _cells(row.place, f"`{row.form}`", seed_status(row), f"`{row.case}`")
        for row in SEED_COMMANDS
    )
    parts = [
        "# Commands of the manuals about offsets",
        "Every command, variable and list parameter of the manuals FCT-C2 (coordinate systems and "
        "offsets), ZERO (zero offsets) and of the definition of #CS.\n"
        "The status comes from the tables that the program uses; the last column is the folder in "
        "`tests/cases` that shows it.",
        _table("manual|form|status|test case", lines),
    ]
    return _page(parts)


def seed_status(row: SeedCommand) -> str:
    """`modelled`, or the title of the table of commands where it stands. Raises KeyError."""
    name = row.name
    if name.startswith("P-"):
        statuses = [p.status for p in table.rows() if p.id == name]
        return "modelled" if statuses and statuses[0] == "effective" else "without effect"
    if name.startswith("#"):
        return COMMAND_KINDS[{f"#{c.name}": c.kind for c in COMMANDS}[name]].lower()
    if name.startswith("V."):
        return "modelled" if name in VARIABLES else "unknown"
    if name[1:].isdigit():
        effect = GFUNCTIONS[int(name[1:])].effect
        return G_EFFECTS[effect].lower() if effect in ("quiet", "refused") else "modelled"
    return {"D": "modelled"}[name]


def diagnostics_page() -> str:
    """Every id with its severity: the control's numbers first, then ours."""
    parts = [
        "# Diagnostics",
        "A number without a letter is the control's own number for the same mistake.\n"
        "Ids that begin with N are ours.\n"
        "An error ends the run, a warning and a note do not; with `--strict` a warning ends it "
        "too.\n"
        "Ids are stable and never used for something else.",
        "## Numbers of the control",
        _diagnostics(id for id in CATALOGUE if id.isdigit()),
    ]
    for prefix, room in OWN_RANGES.items():
        parts.append(f"## {prefix}...: {room}")
        parts.append(_diagnostics(id for id in CATALOGUE if id.startswith(prefix)))
    return _page(parts)


def variables_page() -> str:
    """The NC variables that programs can read and write."""
    parts = [
        "# NC variables",
        "Lengths are in the programmed unit, millimetres or under G70 inches; angles are degrees.\n"
        "The parameters of a kinematics are in list units: 0.1 um for positions.\n"
        "`X` stands for the name of any axis of the channel, and the bracket beside it for its "
        "channel index from 0.\n"
        "A variable that is not below is unknown (20196).",
        "## Variables of the control",
        _table("variable|access|meaning", _variables()),
        "## Variables of the program",
        _table("variable|created by|meaning", (_cells(*row) for row in PROGRAM_VARIABLES)),
        "Arrays need `#VAR`; their indices count from 0.\n"
        "A run starts without variables: nothing is carried from one run to the next, `V.S` "
        "included.\n"
        "`V.G.NP[i].ALL` and `V.G.NP_AKT.ALL` stand for all axes of a record; records can be "
        "added and subtracted, and not mixed with single values.",
    ]
    return _page(parts)


# --- parts -------------------------------------------------------------------------------------


def _variables() -> Iterable[str]:
    spellings: dict[int, tuple[Row, list[str]]] = {}
    for pattern, row in VARIABLES.items():
        spellings.setdefault(id(row), (row, []))[1].append(_spelled(pattern))
    for row, names in spellings.values():
        access = "read" if row.write is None else "read, write"
        yield _cells(", ".join(f"`{name}`" for name in names), access, row.meaning)


def _spelled(pattern: str) -> str:
    """`V.A.ABS.<axis>` as `V.A.ABS.X`, and an empty bracket as `[i]`, a second one as `[j]`."""
    letters = iter("ijk")
    return re.sub(r"\[\]", lambda _: f"[{next(letters)}]", pattern).replace("<axis>", "X")


def _diagnostics(ids: Iterable[str]) -> str:
    ordered = sorted(ids, key=lambda id: int(id.lstrip("N")))
    return _table(
        "id|severity|meaning",
        (_cells(id, CATALOGUE[id].severity, CATALOGUE[id].title) for id in ordered),
    )


def _section(title: str, head: str, lines: list[str]) -> list[str]:
    """A table under its title; nothing without lines."""
    return [f"### {title}", _table(head, lines)] if lines else []


def _table(head: str, lines: Iterable[str]) -> str:
    names = head.split("|")
    return "\n".join([_cells(*names), "|" + "---|" * len(names), *lines])


def _cells(*texts: str) -> str:
    return "| " + " | ".join(text.replace("|", "\\|") for text in texts) + " |"


def _page(parts: Iterable[str]) -> str:
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m ncscope.docs FOLDER")
    write(Path(sys.argv[1]))
