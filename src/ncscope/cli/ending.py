"""The end of the process: its exit code, output that nobody takes, and no delay."""

from __future__ import annotations

import atexit
import os
import sys
import threading
from collections.abc import Callable
from typing import NoReturn

INTERRUPTED = 130
"""Exit code after Ctrl-C."""
NOT_WRITTEN = 2
"""Exit code where the output could not be written."""


def end_with(work: Callable[[], None]) -> NoReturn:
    """Does the work of the process and ends it; what is wrong is said in one line."""
    _open_closed()
    try:
        code = _code_of(work)
        sys.stdout.flush()
    except BrokenPipeError:  # the reader has seen enough
        code = 0
    except KeyboardInterrupt:  # while a reader lets the last output wait
        code = INTERRUPTED
    except OSError as error:
        where = error.filename or "the output"
        print(f"ncscope: cannot write {where}: {error.strerror or error}", file=sys.stderr)
        code = NOT_WRITTEN
    _leave(code)


def _open_closed() -> None:
    """Output that was closed from the start (`>&-`) goes nowhere."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            nowhere = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # to the end
            setattr(sys, name, nowhere)


def _code_of(work: Callable[[], None]) -> int:
    try:
        work()
    except KeyboardInterrupt:
        return INTERRUPTED
    except SystemExit as end:
        if isinstance(end.__context__, BrokenPipeError):  # typer makes it an error
            raise end.__context__ from None
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    return 0


def _leave(code: int) -> NoReturn:
    """Ends the process without taking its memory apart, which takes as long as a short program.

    All files are closed by those who opened them; threads that still run are waited for.
    """
    if threading.active_count() > 1:
        sys.exit(code)
    atexit._run_exitfuncs()
    os._exit(code)
