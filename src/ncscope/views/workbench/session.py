"""What one page works on: the chosen program and machine, open texts, the last result.

Every page has a session of its own, so that two pages do not disturb each other. The page learns
of changes through `State`, a small value that is sent whenever it changes.
"""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

from ncscope.execution import Options
from ncscope.views.workbench.buffers import Buffer, Change
from ncscope.views.workbench.files import Folder, Refused
from ncscope.views.workbench.running import Outcome, Runner, Stopped, Task, run_task

MOST_SESSIONS = 32


@dataclass(frozen=True, slots=True)
class State:
    """What the page is told. revision: counts results; running, progress 0..1; problem: why there
    is no result for the last request."""

    program: str = ""
    machine: str = ""
    revision: int = 0
    running: bool = False
    progress: float = 0.0
    problem: str = ""

    def as_dict(self) -> dict[str, object]:
        return {name: getattr(self, name) for name in self.__slots__}


class Session:
    """See the module. Methods may be called from any thread."""

    def __init__(self, folder: Folder, changed: Callable[[], None] = lambda: None) -> None:
        self.key = secrets.token_urlsafe(16)
        self.folder = folder
        self.changed = changed
        self.state = State()
        self.outcome: Outcome | None = None
        self.options = Options()
        self._buffers: dict[str, Buffer] = {}
        self._lock = threading.RLock()
        self._latest: Task | None = None
        self._runner = Runner(self._work)

    # --- choosing and running ------------------------------------------------------------------

    def open(self, program: str, machine: str, options: Options | None = None) -> None:
        """Shows another program or machine and runs it."""
        with self._lock:
            if options is not None:
                self.options = options
            self._tell(program=program, machine=machine)
        self.run()

    def run(self) -> None:
        if self.state.program:
            self._tell(running=True, progress=0.0, problem="")
            self._latest = Task(self.state.program, self.state.machine, self.options)
            self._runner.start(self._latest)

    def stop(self) -> None:
        self._runner.stop()

    def close(self) -> None:
        """The page has gone; what it held is let go, whoever still knows the session."""
        self.changed = lambda: None
        self.stop()
        with self._lock:
            self.outcome = None
            self._buffers.clear()

    def _work(self, task: Task, check: Callable[[float], None]) -> None:
        def progress(part: float) -> None:
            check(part)
            if part > self.state.progress + 0.01:
                self._tell(progress=part)

        try:
            outcome = run_task(self.folder, task, self.exact_text, progress)
            check(1.0)
        except Stopped:
            if task is self._latest:  # else the next one is about to start
                self._tell(running=False, problem="stopped")
        except Refused as refused:
            self._tell(running=False, problem=str(refused))
        except KeyError as missing:
            self._tell(running=False, problem=str(missing.args[0]))
        except Exception as fault:  # a page that waits for ever would hide the fault
            self._tell(running=False, problem=f"fault in ncscope: {type(fault).__name__}: {fault}")
            raise
        else:
            with self._lock:
                self.outcome = outcome
                self._tell(running=False, progress=1.0, revision=self.state.revision + 1)

    def _tell(self, **what: object) -> None:
        with self._lock:
            self.state = replace(self.state, **what)  # type: ignore[arg-type]
        self.changed()

    def result(self, revision: int) -> Outcome | None:
        """The result with this number, None when there is a newer one."""
        with self._lock:
            return self.outcome if revision == self.state.revision else None

    # --- texts ---------------------------------------------------------------------------------

    def exact_text(self, key: str) -> str | None:
        """The text of an open editor with its own line ends, None when the file is not open."""
        with self._lock:
            buffer = self._buffers.get(key)
        return buffer.exact if buffer else None

    def buffer(self, key: str, fresh: bool = False) -> Buffer:
        """The text of a file, opened when it is not yet; `fresh` drops changes. Raises Refused."""
        with self._lock:
            if fresh or key not in self._buffers:
                self._buffers[key] = Buffer.of(self.folder.read(key))
            return self._buffers[key]

    def edit(self, key: str, version: int, changes: Iterable[Change]) -> Buffer:
        """Takes a change set and runs again. Raises Refused, OutOfStep and ValueError."""
        with self._lock:
            buffer = self._buffers[key] = self.buffer(key).edited(version, changes)
        self.run()
        return buffer

    def replace_text(self, key: str, text: str) -> Buffer:
        with self._lock:
            buffer = self._buffers[key] = self.buffer(key).replaced(text)
        self.run()
        return buffer

    def save(self, key: str) -> Buffer:
        """Writes the text to its file. Raises Refused."""
        with self._lock:
            buffer = self.buffer(key)
            data = buffer.data
            self.folder.write(key, data, buffer.saved)
            self._buffers[key] = buffer.after_save(data)
            return self._buffers[key]


@dataclass
class Sessions:
    """All pages that are open on one folder."""

    folder: Folder
    by_key: dict[str, Session] = field(default_factory=dict)

    def create(self) -> Session:
        """Raises Refused when too many pages are open."""
        if len(self.by_key) >= MOST_SESSIONS:
            raise Refused(f"{MOST_SESSIONS} pages are open: close some first")
        session = Session(self.folder)
        self.by_key[session.key] = session
        return session

    def close(self, session: Session) -> None:
        self.by_key.pop(session.key, None)
        session.close()
