"""The loop: program and machine in, trajectory out.

Blocks come one after the other from the language; the channel makes a step of each. Nothing here
touches files: messages are values of the result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import chain

from ncscope.channel.block import Step, execute
from ncscope.channel.start import start_state
from ncscope.channel.state import State
from ncscope.diagnostics import Diagnostic, Severity, Source, Span, diagnostic
from ncscope.language import iterate_blocks, tree
from ncscope.machine import Machine
from ncscope.trajectory import Recorder, Trajectory


@dataclass(frozen=True, slots=True)
class Options:
    """How a program is run.

    clamp: clamp position handed over at program start. skip: skip levels that are switched on.
    max_blocks: blocks after which the run stops, 0 for no limit. strict: a warning stops too.
    """

    clamp: int | None = None
    skip: frozenset[int] = frozenset()
    max_blocks: int = 0
    strict: bool = False


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
    recorder, log = Recorder(source.name), _Log()
    state = start_state(machine, options.clamp)
    messages: list = []
    ended, count = False, 0
    for block, found in iterate_blocks(source):
        for item in found:
            log.add(item, options.strict)
        if log.stop:
            break
        if block is None or _skipped(block, options):
            continue
        count += 1
        if options.max_blocks and count > options.max_blocks:
            log.add(_too_many(options, block.span), options.strict)
            break
        before, step = state, execute(machine, state, block)
        state = step.state
        _record(recorder, before, step, block)
        messages.extend(step.messages)
        for item in step.diagnostics:
            log.add(item, options.strict)
        ended = step.ended
        if ended or log.stop:
            break
        if progress is not None and count % 1000 == 0:
            progress(block.span.end)
    if not ended and not log.stop and count:
        log.add(_no_end(source), options.strict)
    recorder.close()
    axes = tuple(recorder.axes) or state.axis_names
    return Trajectory(
        tuple(recorder.stretches),
        axes,
        tuple(log.items),
        tuple(messages),
        not log.stop,
        recorder.places,
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


def blocks_of(program: Program) -> Iterator[tree.Block]:
    """The blocks of a program, for checks that do not run it."""
    return (block for block, _ in iterate_blocks(program.source) if block is not None)


def check_program(machine: Machine, program: Program) -> tuple[Diagnostic, ...]:
    """What `run` would say of the program."""
    return tuple(chain(run(machine, program).diagnostics))
