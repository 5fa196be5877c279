"""What a run holds from block to block, and what each block does to it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from ncscope.channel.block import Step, execute
from ncscope.channel.draft import Message
from ncscope.channel.endless import Watch, too_long
from ncscope.channel.flow import Walker
from ncscope.channel.given import unused
from ncscope.channel.loop_lane import MOST_ENTRIES, LoopLane, Visited
from ncscope.channel.start import start_state, switch_on, with_stack
from ncscope.channel.state import CallRequest, Return, Running, State
from ncscope.channel.subprograms import Passage
from ncscope.diagnostics import Diagnostic, Severity, Source, Span, diagnostic
from ncscope.inspection import Inspector
from ncscope.language import BlockReader, tree
from ncscope.machine import Machine
from ncscope.program import Options, Progress, Sink
from ncscope.recording import Recorder, with_bulges
from ncscope.trajectory import Stretch, Trajectory
from ncscope.transitions import Transitions

if TYPE_CHECKING:
    from ncscope.channel.bulk import BulkLane

BULK_FROM = 70_000
"""Characters from which the compiled bulk lane is worth the time of its loading."""
SHORTEST_RUN = 64
"""Plain blocks in a row that the bulk lane takes faster than the loop lane, where both can."""


@dataclass
class _Log:
    """Diagnostics in order; of those that do not end the run, a note about the same thing is kept
    once, and a warning once for its place, however often a loop brings it."""

    items: list[Diagnostic] = field(default_factory=list)
    known: set[tuple[str, str, str, int]] = field(default_factory=set)
    stop: bool = False

    def add(self, item: Diagnostic, strict: bool) -> None:
        if not item.is_error:
            place = item.span if item.severity is Severity.WARNING else None
            file, start = (place.source.name, place.start) if place is not None else ("", 0)
            if (item.id, item.message, file, start) in self.known:
                return
            self.known.add((item.id, item.message, file, start))
        self.items.append(item)
        self.stop |= item.is_error or (strict and item.severity is Severity.WARNING)


class Loop:
    """What a run holds from block to block."""

    def __init__(
        self,
        machine: Machine,
        source: Source,
        options: Options,
        progress: Progress | None,
        sink: Sink | None,
    ) -> None:
        self.machine, self.source, self.options = machine, source, options
        self.progress, self.sink, self.reached = progress, sink, 0
        state = start_state(machine, options.clamp, options.probe, options.external, options.manual)
        state, found = with_stack(machine, state)
        self.state = state.changed(running=Running(file=source.name))
        self.stretches: list[Stretch] = []
        self.taken = 0
        self.recorder, self.log = Recorder(source, options.sample, self._take), _Log()
        self.transitions = Transitions(self.recorder)
        self.inspector = Inspector()
        self.messages: list[Message] = []
        self.channels = [(0, self.state.axes)]
        self.named = self.state.axes, self.state.axis_names
        self.sources = {source.name: source}
        self.count = 0
        self.ended = False
        self.returned: Return | None = None
        self.calls: tuple[CallRequest, ...] = ()
        self.watch: Watch | None = None
        self.bulk_lanes: dict[str, BulkLane] = {}
        self.loops = LoopLane() if options.bulk is not False else None
        self.add(found)
        self.state, found = switch_on(machine, self.state, Span(source, 0, 0))
        self.add(found)

    @property
    def over(self) -> bool:
        return self.ended or self.log.stop

    def take(self, block: tree.Block, found: tuple[Diagnostic, ...]) -> None:
        """One block in the step lane."""
        if not self.meet(block, found):
            return
        before, step = self.state, execute(self.machine, self.state, block)
        self.state = step.state
        self.messages.extend(step.messages)
        self.add(step.diagnostics)
        if step.state.axes is not self.named[0]:
            self.named = step.state.axes, step.state.axis_names
        self.add(_record(self.transitions, before, step, block, self.named[1]))
        self.ended, self.returned, self.calls = step.ended, step.returned, step.calls
        if step.state.axes is not before.axes:
            self.recorder.split()
            self.channels.append((self.recorder.moves, step.state.axes))

    def meet(self, block: tree.Block, found: Iterable[Diagnostic]) -> bool:
        """Whether a block that was reached is to be executed; says what was found in it."""
        self.returned, self.calls = None, ()
        self.sources.setdefault(block.span.source.name, block.span.source)
        self.add(found)
        return not (self.log.stop or _skipped(block, self.options)) and self._counted(block.span)

    def add(self, found: Iterable[Diagnostic]) -> None:
        """Diagnostics of the run, in order."""
        for item in found:
            self.log.add(item, self.options.strict)

    def add_one(self, item: Diagnostic | None) -> None:
        """A diagnostic, where there is one."""
        if item is not None and not self.over:
            self.log.add(item, self.options.strict)

    def accept(self, passage: Passage) -> None:
        """The state behind a call or a return."""
        self.state, self.ended = passage.state, self.ended or passage.ended
        self.add(passage.diagnostics)

    def take_plain(self, reader: BlockReader) -> None:
        """All plain blocks that follow, in the bulk lane."""
        source = reader.source
        if reader.in_area or self.transitions.waiting is not None or not self._in_bulk(source):
            return
        lane, more = self._bulk_lane(source), True
        while more:
            left = self.options.max_blocks - self.count if self.options.max_blocks else None
            start = self.state.position.program
            taken = lane.take(reader, self.state, left)
            if taken is None:
                return
            more = taken.more
            self.state = taken.state
            self.recorder.extend(taken.stretch, start, taken.ways, taken.arcs)
            self.count += len(taken.stretch)
            self.report(reader.at if source is self.source else self.reached)
            source.forget(reader.at)

    def shortest_run(self, source: Source) -> int | None:
        """How many plain blocks of a source in a row are taken together where blocks are walked."""
        if not self._in_bulk(source):
            return None
        return SHORTEST_RUN if self.options.bulk is None else 2

    def _in_bulk(self, source: Source) -> bool:
        wanted = self.options.bulk
        return len(source) >= BULK_FROM if wanted is None else wanted

    def _bulk_lane(self, source: Source) -> BulkLane:
        from ncscope.channel.bulk import BulkLane

        if source.name not in self.bulk_lanes:
            self.bulk_lanes[source.name] = BulkLane(source, self.machine.settings)
        return self.bulk_lanes[source.name]

    def report(self, offset: int) -> None:
        """The offset in the main program that was reached."""
        self.reached = offset
        if self.progress is not None:
            self.progress(offset, self.count)

    def _take(self, stretch: Stretch) -> None:
        """Moves that are recorded for good."""
        axes = [axes for moves, axes in self.channels if moves <= self.taken]
        stretch = with_bulges(stretch, axes[-1])
        ends = stretch.at_ends()
        self.inspector.see(ends, axes[-1])
        self.taken += len(ends)
        (self.sink or self.stretches.append)(stretch)

    def take_loop(self, walker: Walker) -> bool:
        """Blocks that are executed again and again, in the loop lane; whether there were any."""
        if self.transitions.waiting is not None:
            return False
        limit = self.options.max_blocks - self.count if self.options.max_blocks else MOST_ENTRIES
        piece = self.loops.advance(walker, self.state, limit) if self.loops else None
        if piece is None:
            return False
        if piece.stretch is not None:
            self.recorder.extend(piece.stretch, self.state.position.program)
        self.count += piece.count
        self.state = piece.state
        if walker.layout.source.name == self.recorder.file:
            self._visit(walker, piece.visits)
        return True

    def _visit(self, walker: Walker, visits: Iterable[Visited]) -> None:
        state = self.state
        for place in visits:
            line = walker.layout.entries[place.at].block.span.line
            self.recorder.visit(
                line, place.block, state.coordinates, state.axis_names, place.program, place.axes
            )

    def _counted(self, span: Span) -> bool:
        self.count += 1
        limit = self.options.max_blocks
        if limit and self.count > limit:
            found = self.watch.too_many(limit, span) if self.watch else too_long(limit, span)
            self.add([found])
            return False
        return True

    def result(self) -> Trajectory:
        if not self.over:
            self.log.add(_no_end(self.source), self.options.strict)
        if not self.log.stop:
            self.add([*unused(self.state.probe), *unused(self.state.manual)])
            self.add(self.transitions.finish())
        self.recorder.finish()
        self.add(self.recorder.complaints())
        done = Trajectory(
            tuple(self.stretches),
            tuple(self.recorder.axes) or self.state.axis_names,
            messages=tuple(self.messages),
            channels=tuple((self.recorder.rows_of(moves), axes) for moves, axes in self.channels),
            nearest_to_pole=self.inspector.nearest,
            _places=self.recorder.places,
            _file=self.source.name,
        )
        self.add(self.inspector.inspection(done).diagnostics(self.sources))
        return replace(done, diagnostics=tuple(self.log.items), ok=not self.log.stop)


def _skipped(block: tree.Block, options: Options) -> bool:
    return block.skip is not None and block.skip in options.skip


def _record(
    transitions: Transitions, before: State, step: Step, block: tree.Block, names: tuple[str, ...]
) -> tuple[Diagnostic, ...]:
    state, recorder = step.state, transitions.recorder
    start = before.position.axes
    found = transitions.take(state.coordinates, names, step.moves, start)
    if step.corner is not None:
        found += transitions.insert(step.corner)
    if not step.moves and block.span.source.name == recorder.file:
        recorder.visit(
            block.span.line,
            state.block,
            state.coordinates,
            names,
            state.position.program,
            state.position.axes,
        )
    return found


def _no_end(source: Source) -> Diagnostic:
    first = max(0, len(source) - 1000)
    end = first + len(source.part(first, len(source)).rstrip())
    span = Span(source, max(0, end - 1), end)
    return diagnostic("21129", span, "the main program does not end with M02 or M30")
