"""The loop: program and machine in, trajectory out.

Blocks come one after the other from the language; the channel makes a step of each. Nothing here
touches files: messages are values of the result. `loop` is what a run holds from block to block,
`walking` follows control statements and calls.
"""

from __future__ import annotations

import numpy as np

from ncscope.channel.state import CallRequest
from ncscope.channel.subprograms import return_in_main
from ncscope.diagnostics import Source, Span
from ncscope.execution.loop import Loop
from ncscope.execution.walking import run_files, walk
from ncscope.language import BlockReader
from ncscope.language.detection import needs_layout
from ncscope.machine import Machine
from ncscope.program import Options, Program, Progress, Sink
from ncscope.trajectory import Trajectory

__all__ = ["Options", "Program", "Progress", "Sink", "run"]


def run(
    machine: Machine,
    program: Program | str,
    options: Options | None = None,
    progress: Progress | None = None,
    sink: Sink | None = None,
) -> Trajectory:
    """Every motion block of the program, in all coordinate systems.

    program: from `load_program`, or NC text. progress: what it raises ends the run. sink: gets
    the moves while the program runs; the result then holds everything but them. What is wrong
    with the program is in `Trajectory.diagnostics`.
    Raises KeyError for a clamp position or an external variable that the machine does not have.
    """
    options = options or Options()
    source = program.source if isinstance(program, Program) else Source("program", program)
    loop = Loop(machine, source, options, progress, sink)
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # too large a value is 21883
            _run_all(loop)
    except BaseException:  # broken off from outside: what was reached belongs to the sink
        loop.recorder.finish()
        raise
    return loop.result()


def _run_all(loop: Loop) -> None:
    settings = loop.machine.settings
    _run_configured(loop, settings.start_file)
    if not loop.over:
        if needs_layout(loop.source):
            walk(loop)
        else:
            _stream(loop)
    if not loop.log.stop:
        _run_configured(loop, settings.end_file)


def _run_configured(loop: Loop, name: str) -> None:
    """A file that the channel list names to run before or behind every program."""
    if name:
        run_files(loop, (CallRequest("L", name, Span(loop.source, 0, 0)),))


def _stream(loop: Loop) -> None:
    """A program whose blocks follow each other: read as it runs, plain blocks in bulk."""
    reader = BlockReader(loop.source)
    blocks = iter(reader)
    while not loop.over:
        loop.take_plain(reader)
        block, found = next(blocks, (None, ()))
        if block is None:
            break
        loop.take(block, found)
        if loop.returned is not None:
            loop.add([return_in_main(loop.returned.span)])
        elif loop.calls and not loop.log.stop:
            run_files(loop, loop.calls)
        loop.report(reader.at)
