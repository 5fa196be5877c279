"""Blocks with control statements and calls: a table of the program, walked from block to block."""

from __future__ import annotations

from ncscope.channel.endless import Watch
from ncscope.channel.flow import Walker
from ncscope.channel.state import CallRequest
from ncscope.channel.subprograms import call, leave, nesting_warning, return_in_main
from ncscope.channel.unfolding import unfold
from ncscope.diagnostics import diagnostic
from ncscope.execution.loop import Loop
from ncscope.language import BlockReader
from ncscope.language.structure import Entry, Layout, layout


def run_files(loop: Loop, calls: tuple[CallRequest, ...]) -> None:
    """Subprogram files, called from where no table of control statements is needed."""
    empty = Layout(loop.source, (), None, {}, {}, (), {}, {}, ())
    walker = _walker(loop, empty)
    ended, loop.ended = loop.ended, False
    loop.accept(call(walker, loop.state, calls))
    _drive(loop, walker)
    loop.ended = loop.ended or ended
    loop.watch = None


def walk(loop: Loop) -> None:
    """A program with control statements or calls: read once, then walked."""
    table = layout(loop.source, loop.options.skip, loop.shortest_run(loop.source))
    loop.add(table.diagnostics)
    if table.main is None and table.entries:
        message = "the file has subprograms only: a main program begins with % and its name"
        loop.add([diagnostic("20368", table.entries[0].block.span, message)])
    walker = _walker(loop, table)
    _drive(loop, walker)
    if not loop.log.stop:
        loop.add(walker.open_warnings())


def _walker(loop: Loop, table: Layout) -> Walker:
    options = loop.options
    return Walker(loop.machine, table, options.load, options.skip, loop.shortest_run)


def _drive(loop: Loop, walker: Walker) -> None:
    """Block by block until the outermost level of the walker ends."""
    entry = None
    loop.watch = watch = Watch(walker, not loop.options.max_blocks)
    while not loop.over:
        entry = walker.entry
        if entry is None:
            if not walker.calls:
                break
            loop.accept(leave(walker, loop.state))
            continue
        table, at, count = walker.layout, walker.at, loop.count
        if entry.plain:
            _take_run(loop, walker, entry)
            continue
        if loop.take_loop(walker):
            loop.add_one(watch.look(table, at, loop.state, loop.count - count))
            loop.report(loop.reached)
            continue
        if entry.keyword and not entry.block.words:
            loop.meet(entry.block, entry.found)
        else:
            loop.take(entry.block, entry.found)
        if not loop.log.stop:
            _go_on(loop, walker)
            loop.add_one(watch.look(table, at, loop.state))
        in_main = not walker.calls and walker.layout.source is loop.source
        loop.report(entry.block.span.start if in_main else loop.reached)
    if loop.ended and walker.calls and entry is not None:
        loop.add([nesting_warning(entry.block.span)])


def _take_run(loop: Loop, walker: Walker, entry: Entry) -> None:
    """A run of plain blocks: in the bulk lane, and what that leaves in the step lane."""
    if loop.state.running.modal is not None:  # its cycle is called behind each motion
        unfold(walker)
        return
    assert loop.watch is not None
    table, at, count = walker.layout, walker.at, loop.count
    reader, span = BlockReader(table.source), entry.block.span
    blocks = iter(reader)
    reader.skip_to(span.start)
    while reader.at < span.end and not loop.over:
        loop.take_plain(reader)
        if reader.at < span.end:
            loop.take(*next(blocks))
    if not loop.log.stop:
        walker.at += 1
        loop.add_one(loop.watch.look(table, at, loop.state, loop.count - count, new=True))


def _go_on(loop: Loop, walker: Walker) -> None:
    """The jump, calls or return behind the words of a block."""
    order, calls = loop.returned, loop.calls
    if order is not None and not walker.calls:
        loop.add([return_in_main(order.span)])
        return
    if order is None and not loop.ended:
        loop.state, found = walker.step(loop.state)
        loop.add(found)
    if loop.log.stop:
        return
    if calls:
        then = "end" if loop.ended else order or ""
        loop.ended = False
        loop.accept(call(walker, loop.state, calls, then))
    elif order is not None and not loop.ended:
        loop.accept(leave(walker, loop.state, order))
