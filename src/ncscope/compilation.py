"""Compiled loops: the one place that knows numba.

numba takes longer to load than a short program takes to run. So it is loaded when a loop has
enough to do, not when a loop is defined: a few rows are computed by the same functions as Python.
They use nothing but what gives the same bits in both: + - * /, square roots, roundings and the
functions of the C library behind `math`. They write into arrays that they are given and make
none, so that numba need not count references at each call (`_nrt`). Machine code is kept on
disk; only the first run on a machine compiles, and `when_compiling` tells of it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import cache
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])

MANY_ROWS = 1000
"""Rows of a table (two dimensions) in one call from which machine code is used."""
MANY_CALLS = 20_000
"""Calls, those of compiled functions among themselves included, after which it is used anyway:
some 2,500 poses, which take as long as numba takes to load."""


def compiled(function: Function) -> Function:
    """The function as machine code once it is worth it; cached on disk."""
    if _loaded:
        return cast(Function, _loaded[0](function))
    waiting = _Waiting(function)
    _all_waiting.append(waiting)
    return cast(Function, waiting)


def load() -> None:
    """Machine code from here on: for work that is known to be long."""
    with _lock:
        _load()


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

    calls = 0

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.code: Callable[..., Any] | None = None

    def __call__(self, *arguments: Any) -> Any:
        if self.code is None:
            import numpy as np

            _Waiting.calls += 1
            if _Waiting.calls <= MANY_CALLS and not _many(arguments):
                with np.errstate(all="ignore"):
                    return self.function(*arguments)
            load()
        assert self.code is not None
        return self.code(*arguments)


def _many(arguments: tuple[Any, ...]) -> bool:
    for argument in arguments:  # `any` of a generator takes as long as a small loop itself
        if getattr(argument, "ndim", 0) > 1 and len(argument) > MANY_ROWS:
            return True
    return False


_lock = threading.Lock()
_loaded: list[Callable[[Callable[..., Any]], Any]] = []
_all_waiting: list[_Waiting] = []
_listeners: list[Callable[[], None]] = []


def _load() -> None:
    if not _all_waiting:  # another thread was faster
        return
    _loaded.append(_machine_code)
    for waiting in _all_waiting:
        waiting.code = _loaded[0](waiting.function)
    for waiting in _all_waiting:
        names = waiting.function.__globals__
        names.update({n: v.code for n, v in names.items() if isinstance(v, _Waiting)})
    _all_waiting.clear()
    _listen()


def _machine_code(function: Callable[..., Any]) -> Callable[..., Any]:
    from numba import njit

    options: dict[str, Any] = {"cache": True, "error_model": "numpy", "nogil": True, "_nrt": False}
    dispatcher = njit(**options)(function)
    if hasattr(dispatcher._cache, "_load_overload"):
        dispatcher._cache = _quick_cache()(function)
    return dispatcher


@cache
def _quick_cache() -> type:
    """numba's cache, without the tables of all that numba can compile: code from disk needs
    none of them, and they take longer to fill than numba to load."""
    from numba.core.caching import FunctionCache

    class QuickCache(FunctionCache):
        def load_overload(self, sig: Any, target_context: Any) -> Any:
            with self._guard_against_spurious_io_errors():
                return self._load_overload(sig, target_context)

    return QuickCache


def _listen() -> None:
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: Any) -> None:
            for listener in tuple(_listeners):
                listener()

        def on_end(self, event: Any) -> None:
            pass

    event.register("numba:compile", Listener())
