"""Which control statements of a program belong together: a table, computed once per source.

Enters the blocks of a source. Leaves a frozen `Layout`: program levels, labels, and for every
control block the statement it is part of. Nothing is evaluated here.
Source: TF5200 programming manual
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ncscope.diagnostics import Diagnostic, Severity, Source, Span, diagnostic
from ncscope.language.parser import BlockReader, is_comment
from ncscope.language.scanner import AXIS_LETTERS, CHUNK, Scanner
from ncscope.language.tree import Block, Call, Control

Diagnostics = tuple[Diagnostic, ...]
Level = tuple[int, int]
"""First index of a program level, and the index behind its last block."""

LOOPS = {"FOR": "ENDFOR", "WHILE": "ENDWHILE", "DO": "ENDDO", "REPEAT": "UNTIL"}
OPENINGS = {**LOOPS, "IF": "ENDIF", "SWITCH": "ENDSWITCH", "#IF": "#ENDIF"}
BRANCHES = {
    "ELSEIF": "IF",
    "IFELSE": "IF",
    "ELSE": "IF",
    "#ELSE": "#IF",
    "CASE": "SWITCH",
    "DEFAULT": "SWITCH",
}
UNEXPECTED = {
    "ELSE": "20214",
    "ELSEIF": "20216",
    "IFELSE": "20216",
    "ENDIF": "20218",
    "CASE": "20221",
    "DEFAULT": "20223",
    "ENDSWITCH": "20225",
    "ENDFOR": "20232",
    "ENDWHILE": "20237",
    "BREAK": "20243",
    "CONTINUE": "20244",
}
"""Numbers for a statement that does not belong to the open one; N1007 for the others."""
ENDINGS = {end: opening for opening, end in OPENINGS.items()}
MOST_NESTED = 100


@dataclass(frozen=True, slots=True)
class Entry:
    """One block as it is executed: without the words behind a call.

    keyword: the control statement without `$` (`#IF` with its `#`), "" for none. plain: so many
    plain blocks, which nothing can jump to, stand for this entry; its own block is empty.
    """

    block: Block
    found: Diagnostics
    keyword: str = ""
    plain: int = 0

    @property
    def span(self) -> Span:
        return self.block.span if self.block.control is None else self.block.control.span


@dataclass
class Statement:
    """A structured statement: indices of its first block, its branches and its end (or None)."""

    keyword: str
    first: int
    branches: list[int] = field(default_factory=list)
    end: int | None = None


@dataclass(frozen=True, slots=True)
class Layout:
    """A source as entries with its jump table.

    statements: by the index of any of their own blocks; $BREAK and $CONTINUE map to the statement
    that they leave or go on with. around: the statements around a block, outermost first.
    computed: blocks whose label is an expression (`N[P1*10]:`), by the start of their level.
    """

    source: Source
    entries: tuple[Entry, ...]
    main: Level | None
    subprograms: Mapping[str, Level]
    statements: Mapping[int, Statement]
    around: tuple[tuple[Statement, ...], ...]
    labels: Mapping[tuple[int, str], int]
    computed: Mapping[int, list[int]]
    diagnostics: Diagnostics


def layout(
    source: Source, skip: frozenset[int] = frozenset(), shortest: int | None = None
) -> Layout:
    """The table of a source; blocks of the skip levels that are on are left out.

    shortest: runs of so many plain blocks and more are one entry each; None for no such entries.
    """
    entries = tuple(_entries(source, skip, shortest))
    main, subprograms = _levels(entries)
    builder = _Builder(entries)
    for level in [*([main] if main else []), *subprograms.values()]:
        builder.level(level)
    return Layout(
        source, entries, main, subprograms, builder.statements, tuple(builder.around),
        builder.labels, builder.computed, tuple(builder.found),
    )  # fmt: skip


def _entries(source: Source, skip: frozenset[int], shortest: int | None) -> Iterator[Entry]:
    reader = BlockReader(source)
    runs = None if shortest is None else _PlainRuns(source, shortest)
    for block, found in reader:
        if block.skip is None or block.skip not in skip:
            yield _entry(block, found)
        run = None if runs is None or reader.in_area else runs.at(reader.at)
        if run is not None:
            reader.skip_to(run.block.span.end)
            yield run


class _PlainRuns:
    """Runs of plain blocks, looked for with the scanner of the bulk lane."""

    def __init__(self, source: Source, shortest: int) -> None:
        self._source, self._shortest = source, shortest
        self._scanner = Scanner(source.data, AXIS_LETTERS)
        self._looked_at = 0

    def at(self, offset: int) -> Entry | None:
        """The run that begins at an offset; None where there is none that is long enough."""
        if offset < self._looked_at:
            return None
        count, stop = 0, offset
        while True:
            rows = self._scanner.scan(stop, 1)
            if len(rows):
                count, stop = count + len(rows), int(rows.stops[-1])
            if len(rows) < CHUNK:
                break
        self._looked_at = stop
        if count < max(1, self._shortest):
            return None
        span = Span(self._source, offset, stop)
        block = Block(None, (), None, (), (), None, (), None, True, span)
        return Entry(block, (), plain=count)


def _entry(block: Block, found: Diagnostics) -> Entry:
    if block.control is not None:
        return Entry(block, found, block.control.keyword)
    name = block.commands[0].name if block.commands else ""
    if name in ("IF", "ELSE", "ENDIF"):
        return Entry(block, found, f"#{name}")
    calls = [i for i, w in enumerate(block.words) if isinstance(w, Call)]
    if not calls:
        return Entry(block, found)
    call, rest = block.words[calls[0]], block.words[calls[0] + 1 :]
    assert isinstance(call, Call)
    if calls[0] and call.kind.endswith("CYCLE"):
        found = (*found, _before_cycle(call))
    if not rest:
        return Entry(block, found)
    found = (*found, _behind_call(call, rest[0].span))
    return Entry(block._replace(words=block.words[: calls[0] + 1]), found)


def _before_cycle(call: Call) -> Diagnostic:
    message = f"{call.kind} must stand in a block of its own; the words before it run first."
    hint = "put them on a line of their own"
    return diagnostic("20209", call.span, message, hint, severity=Severity.WARNING)


def _behind_call(call: Call, span: Span) -> Diagnostic:
    message = f"What follows the call {call.kind} in its line is not executed."
    hint = "put it on a line of its own"
    return diagnostic("20209", span, message, hint, severity=Severity.WARNING)


def _levels(entries: tuple[Entry, ...]) -> tuple[Level | None, dict[str, Level]]:
    """The main program and the subprograms; of two with one name the first counts."""
    heads = [i for i, e in enumerate(entries) if e.block.header is not None]
    first = heads[0] if heads else len(entries)
    nameless = not heads or not all(is_comment(e.block) for e in entries[:first])
    main: Level | None = (0, first) if first and nameless else None
    subprograms: dict[str, Level] = {}
    for at, stop in zip(heads, [*heads[1:], len(entries)], strict=False):
        header = entries[at].block.header or ""
        if header.startswith("L "):
            subprograms.setdefault(header[2:].strip(), (at + 1, stop))
        elif main is None:
            main = (at, stop)
    return main, subprograms


@dataclass
class _Builder:
    """The table while it grows."""

    entries: tuple[Entry, ...]
    statements: dict[int, Statement] = field(default_factory=dict)
    labels: dict[tuple[int, str], int] = field(default_factory=dict)
    computed: dict[int, list[int]] = field(default_factory=dict)
    found: list[Diagnostic] = field(default_factory=list)
    around: list[tuple[Statement, ...]] = field(default_factory=list)
    open: tuple[Statement, ...] = ()

    def __post_init__(self) -> None:
        self.around = [()] * len(self.entries)

    def level(self, level: Level) -> None:
        self.open = ()
        for at in range(*level):
            entry = self.entries[at]
            for label in entry.block.labels:
                self._label(level, at, label)
            self.around[at] = self.open
            if len(self.open) == MOST_NESTED and _opens(entry):
                self._too_deep(entry)
                return
            if entry.keyword:
                self._statement(at, entry)
            elif not entry.block.ok and entry.block.span.text.lstrip("/N0123456789 ")[:1] == "$":
                self.found.extend(entry.found)

    def _label(self, level: Level, at: int, label: str) -> None:
        if label[0] != "[" and not label[1:].isdigit():
            self.computed.setdefault(level[0], []).append(at)
            return
        first = self.labels.setdefault((level[0], label), at)
        if first != at:
            notes = (("the first one", self.entries[first].block.span),)
            message = f"The label {label} is defined twice."
            self.found.append(
                diagnostic("20836", self.entries[at].block.span, message, notes=notes)
            )

    def _statement(self, at: int, entry: Entry) -> None:
        keyword = entry.keyword
        if keyword.startswith("#") and entry.block.number is not None:
            message = f"{keyword} must stand first in its line, without a block number."
            self.found.append(diagnostic("20593", entry.block.span, message))
        if _opens(entry):
            self._begin(at, keyword)
        elif keyword in BRANCHES:
            self._branch(at, keyword)
        elif keyword in ENDINGS:
            self._end(at, keyword)
        elif keyword in ("BREAK", "CONTINUE"):
            self._leave(at, keyword)

    def _begin(self, at: int, keyword: str) -> None:
        statement = Statement(keyword, at)
        self.statements[at] = statement
        self.open = (*self.open, statement)

    def _too_deep(self, entry: Entry) -> None:
        """The rest of the level is not looked at: the program does not run."""
        message = f"Control statements are nested more than {MOST_NESTED} deep."
        hint = "move the inner statements into a subprogram"
        self.found.append(diagnostic("20211", entry.span, message, hint))

    def _branch(self, at: int, keyword: str) -> None:
        top = self._expected(at, keyword, BRANCHES[keyword])
        if top is None:
            return
        if top.branches and keyword != "CASE" and BRANCHES[keyword] != "SWITCH":
            last = self.entries[top.branches[-1]]
            if last.keyword.endswith("ELSE") and last.keyword != "IFELSE":
                message = f"{shown(keyword)} stands behind {shown(last.keyword)}."
                id = UNEXPECTED.get(keyword, "N1007")
                self.found.append(diagnostic(id, self.entries[at].span, message))
        top.branches.append(at)
        self.statements[at] = top
        self.around[at] = self.open

    def _end(self, at: int, keyword: str) -> None:
        top = self._expected(at, keyword, ENDINGS[keyword])
        if top is None:
            return
        top.end = at
        self.statements[at] = top
        self.open = self.open[:-1]

    def _leave(self, at: int, keyword: str) -> None:
        wanted = LOOPS if keyword == "CONTINUE" else {*LOOPS, "SWITCH"}
        inner = next((s for s in reversed(self.open) if s.keyword in wanted), None)
        if inner is None:
            place = "a loop" if keyword == "CONTINUE" else "a loop or $SWITCH"
            message = f"${keyword} stands outside of {place}."
            self.found.append(diagnostic(UNEXPECTED[keyword], self.entries[at].span, message))
            return
        self.statements[at] = inner

    def _expected(self, at: int, keyword: str, opening: str) -> Statement | None:
        if self.open and self.open[-1].keyword == opening:
            return self.open[-1]
        notes: tuple[tuple[str, Span], ...] = ()
        message = f"{shown(keyword)} has no {shown(opening)} before it."
        if self.open:
            top = self.open[-1]
            message = f"{shown(keyword)} does not belong to {shown(top.keyword)}, which is open."
            notes = ((f"{shown(top.keyword)} begins here", self.entries[top.first].span),)
        id = UNEXPECTED.get(keyword, "N1007")
        self.found.append(diagnostic(id, self.entries[at].span, message, notes=notes))
        return None


def shown(keyword: str) -> str:
    """A keyword as it is written."""
    return keyword if keyword.startswith("#") else f"${keyword}"


def _opens(entry: Entry) -> bool:
    return entry.keyword in OPENINGS and not (entry.keyword == "IF" and jumps(entry.block.control))


def jumps(control: Control | None) -> bool:
    """Whether `$IF` is the one-line form with $GOTO."""
    return control is not None and (control.target is not None or len(control.values) > 1)
