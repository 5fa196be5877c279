"""Every name of the dialect is modelled, without effect, or refused by name; none is unknown.

tests/data/commands.tsv has the 401 names of the vendor's editor plug-in, one a line. The words
of the editor itself (a comment box, a date, folding marks) insert text or comments and are no part
of the language.
"""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import pytest

import ncscope
from ncscope import docs
from ncscope.channel.gfunctions import GFUNCTIONS
from ncscope.language.commands import COMMANDS, READING, lookup
from ncscope.language.vocabulary import WORDS, word_entry
from ncscope.machine import Machine

NAMES = (Path(__file__).parent / "data" / "commands.tsv").read_text(encoding="utf-8").splitlines()
KINDS = {"modelled", "no effect", "refused"}
EDITOR = {
    "commentbox", "date", "Header", "region-start", "region-end", "region-block", "variables",
}  # fmt: skip
OTHER_SPELLINGS = {
    "%Filename": "%", "skipblock": "/", "Spindle": "S", "M19S": "M19", "M/H": "H",
    "M40 - 45": "M40", "L , LL CYCLE": "L CYCLE", "V.A.variables": "V.A.",
    "V.G.variables": "V.G.", "V.G.WZ_AKT.variables": "V.G.", "V.G.WZ.variables": "V.G.",
    "V.SPDL.variables": "V.SPDL.", "V.SPDL_PROG.variables": "V.SPDL_PROG.",
}  # fmt: skip
OTHER_COMMANDS = {
    "#INIT V.E.xx": ["INIT V"],
    "#VAR...#ENDVAR": ["VAR", "ENDVAR"],
    "#ENABLE AX LINK|||#DISABLE AX LINK": ["ENABLE AX LINK", "DISABLE AX LINK"],
    "#AX LINK ON/OFF/OFF ALL": ["AX LINK ON", "AX LINK OFF", "AX LINK OFF ALL"],
}


def commands_of(name: str) -> list[str]:
    """`#CS ON/OFF` as `CS ON` and `CS OFF`."""
    if name in OTHER_COMMANDS:
        return OTHER_COMMANDS[name]
    text = re.sub(r"\s*/\s*", "/", name[1:].replace("|||", "/"))
    choices = [[part for part in word.split("/") if part] for word in text.split()]
    return [" ".join(words) for words in itertools.product(*choices)]


def g_numbers(name: str) -> list[int]:
    numbers = [int(n) for n in re.findall(r"G(\d+)", name)]
    return list(range(numbers[0], numbers[1] + 1)) if "-" in name else numbers


def words_of(name: str) -> list[str]:
    if name == "LIFT LIFT_START / LIFT_END":
        return ["LIFT", "LIFT_START", "LIFT_END"]
    if name == "SYNC IN / OUT":
        return ["SYNC IN", "SYNC OUT"]
    return [OTHER_SPELLINGS.get(name, name.removesuffix(" …"))]


@pytest.mark.parametrize("name", [n for n in NAMES if n not in EDITOR])
def test_name_is_known(name: str) -> None:
    if name.startswith("#"):
        for command in commands_of(name):
            row = lookup(command)
            assert row is not None and row.name == command and row.kind in KINDS, command
    elif re.match(r"G\d", name):
        assert [n for n in g_numbers(name) if n not in GFUNCTIONS] == []
    else:
        for word in words_of(name):
            row = word_entry(word)
            assert row is not None and row.kind in KINDS, word


def test_the_list_is_whole() -> None:
    assert len(NAMES) == 401
    assert set(NAMES) > EDITOR


def test_no_name_is_in_the_tables_twice() -> None:
    for table in (COMMANDS, WORDS):
        names = [row.name for row in table]
        assert len(names) == len(set(names))


def test_every_word_is_on_the_page() -> None:
    page = docs.commands_page()
    assert [w.name for w in WORDS if f"`{w.name}" not in page] == []


@pytest.mark.parametrize("row", [c for c in COMMANDS if c.kind == "refused"])
def test_refused_command_stops_the_run_by_name(row) -> None:
    result = ncscope.run(Machine(), f"X1\n#{row.name}\nX2\nM30\n")
    errors = [d for d in result.diagnostics if d.is_error]
    assert len(errors) == 1 and len(result) == 1
    assert errors[0].id == "N2001" and row.name in errors[0].message


@pytest.mark.parametrize("row", [c for c in COMMANDS if c.kind == "no effect"])
def test_command_without_effect_is_noted_once(row) -> None:
    result = ncscope.run(Machine(), f"X1\n#{row.name}\n#{row.name}\nX2\nM30\n").check()
    notes = [d for d in result.diagnostics if d.id == "N2002"]
    assert len(notes) == 1 and row.name in notes[0].message
    assert result.acs[:, 0].tolist() == [1, 2]


@pytest.mark.parametrize("name", sorted(READING))
def test_a_command_that_asks_the_machine_says_that_its_answer_is_not_known(name: str) -> None:
    result = ncscope.run(Machine(), f"P1=7\n#{name} [ID1 P=P1]\nXP1\nM30\n").check()
    (note,) = [d for d in result.diagnostics if d.id == "N2002"]
    assert "answer is not known" in note.message and result.acs[0, 0] == 7


KEYWORDS = [w.name for w in WORDS if w.kind == "refused" and not w.name.startswith("V.")]


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_axis_command_is_refused_by_name(keyword: str) -> None:
    result = ncscope.run(Machine(), f"X1\nX[{keyword} POS=5]\nX2\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert error.id == "N2001" and keyword.split()[0] in error.message and len(result) == 1
