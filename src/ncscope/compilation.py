"""Compiled loops: the one place that knows numba.

numba is loaded with the first compiled function, not before, so that what needs none starts
without it. Compiled code is kept on disk; only the first run on a machine compiles.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

_listeners: list[Callable[[], None]] = []


def compiled(function: Function) -> Function:
    """The function as machine code, compiled at its first call and cached on disk."""
    from numba import njit

    if not _listening:
        _listen()
    machine_code: Any = njit(cache=True, error_model="numpy")(function)
    return machine_code


def when_compiling(listener: Callable[[], None] | None) -> None:
    """`listener` is called before each function that is compiled and not found on disk; None
    takes all listeners away."""
    if listener is None:
        _listeners.clear()
    else:
        _listeners.append(listener)


_listening: list[Any] = []


def _listen() -> None:
    from numba.core import event

    class Listener(event.Listener):
        def on_start(self, event: Any) -> None:
            for listener in _listeners:
                listener()

        def on_end(self, event: Any) -> None:
            pass

    listener = Listener()
    event.register("numba:compile", listener)
    _listening.append(listener)
