"""The loop: program and machine in, trajectory out.

Blocks come one after the other from the language; the channel makes a step of each. Nothing here
touches files: messages are values of the result.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from ncscope.channel.block import Step, execute
from ncscope.channel.bulk import advance
from ncscope.channel.draft import Message
from ncscope.channel.start import start_state
from ncscope.channel.state import State
from ncscope.diagnostics import Diagnostic, Severity, Source, Span, diagnostic
from ncscope.language import BlockReader, tree
from ncscope.language.scanner import Scanner
from ncscope.machine import Machine
from ncscope.trajectory import Recorder, Trajectory


@dataclass(frozen=True, slots=True)
class Options:
    """How a program is run.

    clamp: clamp position handed over at program start. skip: skip levels that are switched on.
    max_blocks: blocks after which the run stops, 0 for no limit. strict: a warning stops too.
    bulk: plain blocks are taken many at a time; the result is the same without.
    """

    clamp: int | None = None
    skip: frozenset[int] = frozenset()
    max_blocks: int = 0
    strict: bool = False
    bulk: bool = True


@dataclass(frozen=True, slots=True)
class Program:
    """An NC program: its text under the name that the user gave."""

    source: Source


@dataclass
class _Log:
    """Diagnostics in order; a note about the same thing is kept once per run."""

    items: list[Diagnostic] = field(default_factory=list)
    noted: set[tuple[str, str]] = field(default_factory=set)
    stop: bool = False

    def add(self, item: Diagnostic, strict: bool) -> None:
        if item.severity is Severity.NOTE:
            if (item.id, item.message) in self.noted:
                return
            self.noted.add((item.id, item.message))
        self.items.append(item)
        self.stop |= item.is_error or (strict and item.severity is Severity.WARNING)


def run(
    machine: Machine,
    program: Program | str,
    options: Options | None = None,
    progress: Callable[[int], None] | None = None,
) -> Trajectory:
    """Every motion block of the program, in all coordinate systems.

    program: from `load_program`, or NC text. progress: called now and then with the offset in the
    text that was reached. What is wrong with the program is in `Trajectory.diagnostics`.
    Raises KeyError for a clamp position that the machine does not have.
    """
    options = options or Options()
    source = program.source if isinstance(program, Program) else Source("program", program)
    loop = _Loop(machine, source, options)
    reader = BlockReader(source)
    blocks = iter(reader)
    while not loop.over:
        loop.take_plain(reader)
        block, found = next(blocks, (None, ()))
        if block is None:
            break
        loop.take(block, found)
        if progress is not None:
            progress(reader.at)
    return loop.result()


class _Loop:
    """What a run holds from block to block."""

    def __init__(self, machine: Machine, source: Source, options: Options) -> None:
        self.machine, self.source, self.options = machine, source, options
        self.state = start_state(machine, options.clamp)
        self.recorder, self.log = Recorder(source.name), _Log()
        self.messages: list[Message] = []
        self.count = 0
        self.ended = False
        self.scanner: Scanner | None = None

    @property
    def over(self) -> bool:
        return self.ended or self.log.stop

    def take(self, block: tree.Block, found: tuple[Diagnostic, ...]) -> None:
        """One block in the step lane."""
        for item in found:
            self.log.add(item, self.options.strict)
        if self.log.stop or _skipped(block, self.options) or not self._counted(block.span):
            return
        before, step = self.state, execute(self.machine, self.state, block)
        self.state = step.state
        _record(self.recorder, before, step, block)
        self.messages.extend(step.messages)
        for item in step.diagnostics:
            self.log.add(item, self.options.strict)
        self.ended = step.ended
        if step.state.axes is not before.axes:
            self.scanner = None

    def take_plain(self, reader: BlockReader) -> None:
        """All plain blocks that follow, in the bulk lane."""
        if not self.options.bulk or reader.in_area:
            return
        if self.scanner is None:
            self.scanner = Scanner(self.source.data, self.state.axis_names)
        while True:
            rows = self.scanner.scan(reader.at, self.source.position(reader.at)[0])
            left = self.options.max_blocks - self.count if self.options.max_blocks else len(rows)
            if min(len(rows), left) == 0:
                return
            self.state, stretch = advance(self.state, rows, self.source.name, left)
            if stretch is None:
                return
            self.recorder.extend(stretch)
            self.count += len(stretch)
            reader.skip_to(int(rows.stops[len(stretch) - 1]))

    def _counted(self, span: Span) -> bool:
        self.count += 1
        if self.options.max_blocks and self.count > self.options.max_blocks:
            self.log.add(_too_many(self.options, span), self.options.strict)
            return False
        return True

    def result(self) -> Trajectory:
        if not self.over and self.count:
            self.log.add(_no_end(self.source), self.options.strict)
        self.recorder.close()
        return Trajectory(
            tuple(self.recorder.stretches),
            tuple(self.recorder.axes) or self.state.axis_names,
            tuple(self.log.items),
            tuple(self.messages),
            not self.log.stop,
            self.recorder.places,
        )


def _skipped(block: tree.Block, options: Options) -> bool:
    return block.skip is not None and block.skip in options.skip


def _record(recorder: Recorder, before: State, step: Step, block: tree.Block) -> None:
    state = step.state
    start = before.position.axes
    for move in step.moves:
        if len(start) != len(move.axes):
            start = move.axes
        recorder.add(move.coordinates or state.coordinates, state.axis_names, move, start)
        start = move.axes
    if not step.moves:
        recorder.visit(
            block.span.line,
            state.block,
            state.coordinates,
            state.axis_names,
            state.position.program,
            state.position.axes,
        )


def _too_many(options: Options, span: Span) -> Diagnostic:
    return diagnostic(
        "N4001",
        span,
        f"the program has more than {options.max_blocks} blocks",
        "raise --max-blocks, or leave it out for no limit",
    )


def _no_end(source: Source) -> Diagnostic:
    end = len(source.text.rstrip())
    span = Span(source, max(0, end - 1), end)
    return diagnostic("21129", span, "the main program does not end with M02 or M30")
