"""One program on one machine, run in a thread of its own that can be stopped from the page."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath

from ncscope.diagnostics import Diagnostic, Source
from ncscope.execution import Options, Program, run
from ncscope.inspection import Inspection, inspect
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.lists.check import check_loaded
from ncscope.lists.document import ListDocument
from ncscope.lists.files import ListFile, find_lists
from ncscope.lists.reading import assemble
from ncscope.loading import subprogram_loader
from ncscope.machine import Axis, Machine
from ncscope.trajectory import Trajectory
from ncscope.views.workbench.files import Folder

Texts = Callable[[str], str | None]
"""The text that the page shows for a key, None where the file has not been opened."""


SAMPLE = 0.02
"""Chord error of the path that is drawn, mm and degrees."""
SAMPLED_UP_TO = 4_000_000
"""Characters of a program above which arcs are drawn as their chords."""


class Stopped(Exception):
    """Raised inside the run when the user stops it."""


@dataclass(frozen=True)
class Task:
    """What is to be run. `machine`: key of a folder of lists or of a list; empty for X Y Z."""

    program: str
    machine: str
    options: Options = field(default_factory=Options)


@dataclass(frozen=True)
class Outcome:
    """What a run gave. files: name in results -> (key, kind), kind program, subprogram or list.

    drawn: with points along arcs, to be drawn. trajectory: the same with the ends of moves only.
    found: what the lists have wrong, and what is worth saying about them.
    """

    machine: Machine
    drawn: Trajectory
    trajectory: Trajectory
    found: tuple[Diagnostic, ...]
    files: dict[str, tuple[str, str]]
    inspection: Inspection


def run_task(
    folder: Folder, task: Task, texts: Texts, progress: Callable[[float], None]
) -> Outcome:
    """Reads lists and program, with the texts of open editors in place of the files, and runs.

    progress: called with the part of the program that is done, 0..1; may raise to stop.
    Raises Refused when the program or the machine cannot be read.
    """
    files: dict[str, tuple[str, str]] = {}
    machine, found = _machine(folder, task.machine, texts, files)
    name = PurePosixPath(task.program).name
    files[name] = (task.program, "program")
    text = texts(task.program)
    source = Source(name, folder.read(task.program).decode("latin-1") if text is None else text)
    load = _loader(folder, task.program, texts, files)
    if any(d.is_error for d in found):
        result = Trajectory((), machine.axis_names, ok=False)
    else:
        length = max(1, len(source.text))
        result = run(
            machine,
            Program(source),
            replace(task.options, load=load, sample=SAMPLE if length < SAMPLED_UP_TO else None),
            lambda offset, _: progress(offset / length),
        )
    ends = result.at_ends()
    return Outcome(machine, result, ends, found, files, inspect(ends))


def _machine(
    folder: Folder, key: str, texts: Texts, files: dict[str, tuple[str, str]]
) -> tuple[Machine, tuple[Diagnostic, ...]]:
    if not key:
        return Machine(), ()
    path = folder.path(key)
    base = PurePosixPath(key) if path.is_dir() else PurePosixPath(key).parent
    lists, complaints = find_lists(path)
    shown = []
    for item in lists:
        own = (base / item.document.name).as_posix()
        files[item.document.name] = (own, "list")
        shown.append(_shown(item, texts(own)))
    loaded = assemble(tuple(shown), path.name, complaints)
    return loaded.machine, check_loaded(loaded)


def _shown(item: ListFile, text: str | None) -> ListFile:
    if text is None:
        return item
    return replace(item, document=ListDocument.from_text(text, item.document.name))


def _loader(
    folder: Folder, program: str, texts: Texts, files: dict[str, tuple[str, str]]
) -> Callable[[str], Source | None]:
    """Subprograms beside the program and below, as everywhere; never outside of the folder."""
    parent = PurePosixPath(program).parent
    load = subprogram_loader([folder.path(parent.as_posix())])

    def shown(name: str) -> Source | None:
        source = load(name)
        if source is None:
            return None
        key = (parent / source.name).as_posix()
        files[source.name] = (key, "subprogram")
        text = texts(key)
        return source if text is None else Source(source.name, text)

    return shown


def warm_up() -> None:
    """Loads the compiled loops with a small program, so that the first large one need not wait."""
    turning = [{"type": 2, "orientation": way} for way in ((0, 0, 1), (1, 0, 0))]
    linear = [{"type": 1, "orientation": way} for way in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    head = KinematicParameters.from_fields(
        {
            "zero_orientation": (0, 0, 1),
            "number_of_axes": 5,
            "axis": [*linear, *turning],
            "chain": tuple(range(5)),
            "programming_mode": 17,
            "rtcp": 1,
        }
    )
    axes = tuple(Axis(name, i + 1, rotary=i > 2) for i, name in enumerate("XYZCA"))
    machine = Machine("warm", axes, kinematic_parameters={91: head})
    run(machine, "#TRAFO [91]\nG1 X1 A5 F100\nX2 C3\n#TRAFO OFF\nX3\nM30\n", Options(bulk=True))


class Runner:
    """Runs one task at a time; a new task stops the one that is running and takes its place."""

    def __init__(self, work: Callable[[Task, Callable[[float], None]], None]) -> None:
        self._work = work
        self._lock = threading.Lock()
        self._stop: threading.Event | None = None
        self._next: Task | None = None
        self._thread: threading.Thread | None = None

    @property
    def busy(self) -> bool:
        with self._lock:
            return self._thread is not None

    def start(self, task: Task) -> None:
        with self._lock:
            self._next = task
            if self._stop is not None:
                self._stop.set()
            if self._thread is None:
                self._thread = threading.Thread(target=self._loop, daemon=True)
                self._thread.start()

    def stop(self) -> None:
        """Ends what is running and forgets what waits."""
        with self._lock:
            self._next = None
            if self._stop is not None:
                self._stop.set()

    def _loop(self) -> None:
        while True:
            with self._lock:
                task, self._next = self._next, None
                if task is None:
                    self._thread = self._stop = None
                    return
                stop = self._stop = threading.Event()
            self._work(task, _checked(stop))


def _checked(stop: threading.Event) -> Callable[[float], None]:
    def progress(part: float) -> None:
        if stop.is_set():
            raise Stopped

    return progress
