"""Where a program goes on: control statements, jumps, calls and returns.

Enters the layouts of sources and the state behind a block. Leaves the next block, the state and
diagnostics. The words of a block are executed elsewhere, before its jump.
Source: TF5200 programming manual The two limits of $FOR are evaluated before every pass.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable

from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.evaluation import evaluate_number, evaluate_value, write_variable
from ncscope.channel.state import State
from ncscope.channel.subprograms import Frame, Load
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.language import tree
from ncscope.language.structure import (
    LOOPS,
    OPENINGS,
    Entry,
    Layout,
    Level,
    Statement,
    jumps,
    layout,
    shown,
)
from ncscope.machine import Machine

_NUMBERED = re.compile(r"N[0-9]+")
EQUAL = 0.001
"""Values of $SWITCH and $CASE that differ by less are the same."""


def _no_runs(source: Source) -> None:
    return None


class Walker:
    """The place in the program, from block to block.

    shortest: of a source, how many plain blocks in a row are one entry of its table.

    `at` is the index of the next block. `passes` counts the passes of each loop and backward jump,
    by file and index. `astray` counts those that need not come to an end: all but the passes of a
    $FOR that brought its counter nearer to the last value.
    """

    def __init__(
        self,
        machine: Machine,
        main: Layout,
        load: Load | None,
        skip: frozenset[int],
        shortest: Callable[[Source], int | None] = _no_runs,
    ) -> None:
        self.machine, self.load, self.skip, self.shortest = machine, load, skip, shortest
        self.layout, self.main = main, main.source
        self.level: Level = main.main or (0, 0)
        self.at = self.level[0]
        self.calls: list[Frame] = []
        self.layouts: dict[str, Layout] = {main.source.name: main}
        self.passes: dict[tuple[str, int], int] = {}
        self.complained: set[tuple[str, int]] = set()
        self.astray = 0
        self.counters: dict[tuple[str, int], tuple[int, float]] = {}

    @property
    def entry(self) -> Entry | None:
        """The next block; None at the end of the program level."""
        return self.layout.entries[self.at] if self.at < self.level[1] else None

    def table(self, source: Source) -> Layout:
        """The table of a further source."""
        return layout(source, self.skip, self.shortest(source))

    def open_statements(self) -> tuple[Statement, ...]:
        """Statements without an end that are open where the program stands."""
        last = min(self.at, self.level[1] - 1)
        if last < self.level[0]:
            return ()
        own = self.layout.statements.get(last)
        around = self.layout.around[last] + ((own,) if own is not None else ())
        return _open(around)

    def open_warnings(self) -> tuple[Diagnostic, ...]:
        """20375, once for each statement that is open where this program level ends."""
        place, found = self._level_kind()[1], []
        for statement in self.open_statements():
            key = self.layout.source.name, statement.first
            if key not in self.complained:
                self.complained.add(key)
                message = f"{shown(statement.keyword)} is still open at the end of {place}"
                hint = f"{shown(OPENINGS[statement.keyword])} is missing"
                span = self.layout.entries[statement.first].span
                found.append(diagnostic("20375", span, message, hint))
        return tuple(found)

    # --- one step ------------------------------------------------------------------------------

    def step(self, state: State) -> tuple[State, tuple[Diagnostic, ...]]:
        """The jump of the block whose words have been executed."""
        entry = self.layout.entries[self.at]
        draft = Draft(self.machine, state, entry.span)
        try:
            if entry.keyword:
                self.at = self._target(draft, entry)
            else:
                self.at += 1
        except BlockError as error:
            return state, (*draft.diagnostics, error.diagnostic)
        return draft.state, tuple(draft.diagnostics)

    def _target(self, draft: Draft, entry: Entry) -> int:
        keyword, at = entry.keyword, self.at
        if keyword == "GOTO":
            return self._goto(draft, _control(entry))
        if keyword == "IF" and jumps(entry.block.control):
            control = _control(entry)
            return self._goto(draft, control) if _true(draft, control.values[0]) else at + 1
        statement = self.layout.statements[at]
        match keyword:
            case "IF" | "#IF":
                return self._if(draft, statement)
            case "ELSEIF" | "IFELSE" | "ELSE" | "#ELSE":
                return self._behind(draft, statement, ran=True)
            case "SWITCH":
                return self._switch(draft, statement)
            case "BREAK":
                return self._behind(draft, statement, ran=True)
            case "CONTINUE":
                return (
                    self._behind(draft, statement, True) - 1
                    if statement.end is None
                    else (statement.end)
                )
            case "FOR" | "WHILE" | "DO" | "REPEAT":
                return self._begin(draft, statement)
            case "ENDFOR" | "ENDWHILE" | "ENDDO" | "UNTIL":
                return self._again(draft, statement)
        return at + 1

    def _behind(self, draft: Draft, statement: Statement, ran: bool) -> int:
        """Behind the end of a statement; without an end, the end of the program level.

        To the end itself where its block is wrong: executing it reports that.
        """
        if statement.end is not None:
            return statement.end + self.layout.entries[statement.end].block.ok
        if ran:
            return self.level[1]
        id, place = self._level_kind()
        message = f"{shown(statement.keyword)} was skipped and is still open at the end of {place}"
        hint = f"{shown(OPENINGS[statement.keyword])} is missing"
        draft.fail(id, self.layout.entries[statement.first].span, message, hint)

    def _level_kind(self) -> tuple[str, str]:
        """Number and name of the end of this program level: of a subprogram or of the program."""
        if any(self.level[0] == level[0] for level in self.layout.subprograms.values()):
            return "21500", "the local subprogram"
        if self.layout.source is self.main:
            return "21501", "the program"
        return "21502", "the subprogram file"

    # --- $IF and $SWITCH -----------------------------------------------------------------------

    def _if(self, draft: Draft, statement: Statement) -> int:
        for at in (statement.first, *statement.branches):
            if not self.layout.entries[at].block.ok:
                return at  # executing it reports what is wrong with it
            condition = _condition(self.layout.entries[at])
            if condition is None or _true(draft, condition):
                return at + 1
        return self._behind(draft, statement, ran=False)

    def _switch(self, draft: Draft, statement: Statement) -> int:
        entries, default = self.layout.entries, None
        value = evaluate_number(draft, _control(entries[statement.first]).values[0])
        for at in statement.branches:
            if not entries[at].block.ok:
                return at  # executing it reports what is wrong with it
            case = _condition(entries[at])
            if case is None:
                default = at + 1
            elif abs(evaluate_number(draft, case) - value) < EQUAL:
                return at + 1
        return default or self._behind(draft, statement, ran=False)

    # --- loops ---------------------------------------------------------------------------------

    def _begin(self, draft: Draft, statement: Statement) -> int:
        self.passes[self.layout.source.name, statement.first] = 0
        control = _control(self.layout.entries[statement.first])
        if statement.keyword == "FOR":
            write_variable(draft, _assignment(control, "=", control.values[0]))
            if evaluate_number(draft, control.values[2]) == 0:
                draft.warn("20852", control.values[2].span, "the step is 0: the loop has no end")
        return self._pass(draft, statement, control)

    def _pass(self, draft: Draft, statement: Statement, control: tree.Control) -> int:
        """The first block of the body, or behind the loop when its test at the top fails."""
        key = self.layout.source.name, statement.first
        self.passes[key] = self.passes.get(key, 0) + 1
        if statement.keyword == "FOR" and not _counts(draft, control):
            return self._behind(draft, statement, ran=self.passes[key] > 1)
        if statement.keyword == "WHILE" and not _true(draft, control.values[0]):
            return self._behind(draft, statement, ran=self.passes[key] > 1)
        return statement.first + 1

    def _again(self, draft: Draft, statement: Statement) -> int:
        entries = self.layout.entries
        control = _control(entries[statement.first])
        if statement.keyword == "FOR":
            write_variable(draft, _assignment(control, "+=", control.values[2]))
            self._count(draft, statement, control)
        else:
            self.astray += 1
        if statement.keyword in ("DO", "REPEAT"):
            ending = _control(entries[self.at])
            if _true(draft, ending.values[0]) != (statement.keyword == "DO"):
                return self.at + 1
        return self._pass(draft, statement, control)

    def _count(self, draft: Draft, statement: Statement, control: tree.Control) -> None:
        """Notes a pass of $FOR that did not bring it nearer to its end.

        The loop began anew where it has no more passes than before.
        """
        assert control.target is not None
        key = self.layout.source.name, statement.first
        step, count = evaluate_number(draft, control.values[2]), self.passes.get(key, 0)
        now = math.copysign(1.0, step) * evaluate_number(draft, control.target)
        passes, before = self.counters.get(key, (count, now))
        self.astray += step == 0 or (passes < count and now <= before)
        self.counters[key] = count, now

    # --- jumps ---------------------------------------------------------------------------------

    def _goto(self, draft: Draft, control: tree.Control) -> int:
        label = _label(draft, control)
        target = self.find_label(draft, label, control.span)
        if not self.level[0] <= target < self.level[1]:
            draft.fail("N2001", control.span, "a jump out of L SEQUENCE is not supported")
        here = self.layout.around[self.at]
        for statement in self.layout.around[target]:
            if statement.keyword in LOOPS and not any(s is statement for s in here):
                note = ("the loop", self.layout.entries[statement.first].span)
                message = f"the jump to {label} leads into a loop"
                draft.fail("21480", control.span, message, notes=(note,))
        if target <= self.at:
            key = self.layout.source.name, self.at
            self.passes[key] = self.passes.get(key, 0) + 1
            self.astray += 1
        return target

    def find_label(self, draft: Draft, label: str, span: Span) -> int:
        """The block with a label of this program level; N[expr]: is evaluated now."""
        start = self.level[0]
        target = self.layout.labels.get((start, label))
        if target is not None:
            return target
        for at in self.layout.computed.get(start, ()):
            number = self.layout.entries[at].block.number
            if number is not None and f"N{round(evaluate_number(draft, number))}" == label:
                return at
        hint = "a label is written N20: or [NAME], first in a block of the same program level"
        draft.fail("20840", span, f"the label {label} is not found", hint)


def _open(around: tuple[Statement, ...]) -> tuple[Statement, ...]:
    """Those without an end; #IF is no statement of the control."""
    result: list[Statement] = []
    for statement in around:
        if statement.end is None and not any(s is statement for s in result):
            result.append(statement)
    return tuple(result)


def _condition(entry: Entry) -> tree.Expression | None:
    """What $IF, $ELSEIF, $CASE or #IF evaluates; None for $ELSE and $DEFAULT."""
    if entry.block.control is not None:
        return entry.block.control.values[0] if entry.block.control.values else None
    return entry.block.commands[0].value


def _control(entry: Entry) -> tree.Control:
    assert entry.block.control is not None
    return entry.block.control


def _true(draft: Draft, expression: tree.Expression) -> bool:
    return abs(evaluate_number(draft, expression)) >= 0.5


def _counts(draft: Draft, control: tree.Control) -> bool:
    """Whether the counter of $FOR has not passed its last value."""
    step = evaluate_number(draft, control.values[2])
    if step == 0:
        return True
    assert control.target is not None
    at, last = evaluate_number(draft, control.target), evaluate_number(draft, control.values[1])
    return at <= last if step > 0 else at >= last


def _assignment(control: tree.Control, operator: str, value: tree.Expression) -> tree.Assignment:
    assert isinstance(control.target, (tree.Variable, tree.Parameter))
    return tree.Assignment(control.target, operator, value, control.span)


def _label(draft: Draft, control: tree.Control) -> str:
    if isinstance(control.target, tree.Name):
        return f"[{control.target.text}]"
    if isinstance(control.target, tree.Number):
        return f"N{round(control.target.value)}"
    value = evaluate_value(draft, control.values[-1])
    if isinstance(value, str):  # of an external variable
        name = value.strip().upper()
        bare = not name.startswith("[") and not _NUMBERED.fullmatch(name)
        return f"[{name}]" if bare else name
    return f"N{round(evaluate_number(draft, control.values[-1]))}"
