"""ncscope: where every axis of a CNC machine goes, and why.

Read the source in this order: `diagnostics`, `frames`, `kinematics`, `language.tree`, `machine`,
`coordinates`, `channel.state`, `channel.block`, `execution`, `trajectory`, `lists`, `views`, `cli`.
"""

from __future__ import annotations

from typing import Any

__version__ = "0.1.0"
__all__ = [
    "Diagnostic",
    "Inspection",
    "Machine",
    "Options",
    "Program",
    "Trajectory",
    "inspect",
    "load_machine",
    "load_program",
    "load_rows",
    "render",
    "run",
    "with_user_kinematics",
]

_HOME = {
    "Diagnostic": "ncscope.diagnostics",
    "Inspection": "ncscope.inspection",
    "Machine": "ncscope.machine",
    "Options": "ncscope.execution",
    "Program": "ncscope.execution",
    "Trajectory": "ncscope.trajectory",
    "inspect": "ncscope.inspection",
    "load_machine": "ncscope.lists",
    "load_program": "ncscope.loading",
    "load_rows": "ncscope.loading",
    "render": "ncscope.diagnostics",
    "run": "ncscope.execution",
    "with_user_kinematics": "ncscope.loading.user_kinematics",
}


def __getattr__(name: str) -> Any:
    """Public names are imported when they are used: `ncscope --version` must not wait for numba."""
    if name not in _HOME:
        raise AttributeError(f"module 'ncscope' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
