"""Compiled loops: the one place that knows numba.

numba is loaded when the first compiled function is called, not when it is defined, so that a run
that needs none starts without it. Machine code is kept on disk; only the first run on a machine
compiles, and `when_compiling` tells of it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """The function as machine code, compiled at its first call and cached on disk."""
    if _loaded:
        return cast(Function, _loaded[0](function))
    waiting = _Waiting(function)
    _all_waiting.append(waiting)
    return cast(Function, waiting)


def when_compiling(listener: Callable[[], None] | None) -> None:
    """`listener` is called before each function that is compiled and not found on disk; None
    takes all listeners away."""
    if listener is None:
        _listeners.clear()
    else:
        _listeners.append(listener)


class _Waiting:
    """A function before numba is loaded. Compiled functions call each other by their names in
    their modules, so all names are given to the machine code at once."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.code: Callable[..., Any] | None = None

    def __call__(self, *arguments: Any) -> Any:
        if self.code is None:
            with _lock:
                _load()
        assert self.code is not None
        return self.code(*arguments)


_lock = threading.Lock()
_loaded: list[Callable[[Callable[..., Any]], Any]] = []
_all_waiting: list[_Waiting] = []
_listeners: list[Callable[[], None]] = []


def _load() -> None:
    from numba import njit

    if not _all_waiting:  # another thread was faster
        return
    _loaded.append(njit(cache=True, error_model="numpy", nogil=True))
    for waiting in _all_waiting:
        waiting.code = _loaded[0](waiting.function)
    for waiting in _all_waiting:
        names = waiting.function.__globals__
        names.update({n: v.code for n, v in names.items() if isinstance(v, _Waiting)})
    _all_waiting.clear()
    _listen()


def _listen() -> None:
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: Any) -> None:
            for listener in tuple(_listeners):
                listener()

        def on_end(self, event: Any) -> None:
            pass

    event.register("numba:compile", Listener())
