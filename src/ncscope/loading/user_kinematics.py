"""Kinematics of the user (ids 500 to 999): classes from a Python file, or from installed packages.

A file is only read when the user names it. Installed packages are asked through the entry points
of the group `ncscope.kinematics`, and only for a machine whose lists use such an id.
"""

from __future__ import annotations

import sys
import types
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import replace
from importlib import metadata
from pathlib import Path

from ncscope.diagnostics import Diagnostic, Severity, Source, Span, diagnostic
from ncscope.kinematics.step import Builder
from ncscope.kinematics.user import DEVIATION, builder_of, faults_of
from ncscope.loading.content import content
from ncscope.machine import Machine

GROUP = "ncscope.kinematics"


def with_user_kinematics(
    machine: Machine, path: str | Path | None = None
) -> tuple[Machine, tuple[Diagnostic, ...]]:
    """The machine with the kinematics of a Python file and of installed packages.

    Faulty files and classes are diagnostics N4301: errors in the file that the user names, warnings
    in installed packages, which this machine may not need. Raises OSError when the file cannot be
    read. The file is run as a program: name only a file that you trust.
    """
    types: dict[int, Builder] = {}
    found: list[Diagnostic] = []
    if machine.kinematic_ids_of_user:
        types, found = _installed(machine.settings.deviation)
    if path is not None:
        own, problems = read_kinematics(path, machine.settings.deviation)
        types = {**types, **own}
        found.extend(problems)
    if not types:
        return machine, tuple(found)
    return replace(machine, kinematic_types={**machine.kinematic_types, **types}), tuple(found)


def read_kinematics(
    path: str | Path, deviation: float = DEVIATION
) -> tuple[Mapping[int, Builder], tuple[Diagnostic, ...]]:
    """The kinematics classes that a Python file defines, by id. Raises OSError."""
    path = Path(path)
    data = content(path)
    source = Source(path.name, data.decode("utf-8", "replace"))
    module = types.ModuleType(f"ncscope_user_{path.stem}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # dataclasses look their module up
    try:
        exec(compile(data, str(path), "exec"), module.__dict__)
    except (Exception, SystemExit) as error:
        return {}, (_not_run(source, path, error),)
    classes = [
        item
        for item in vars(module).values()
        if isinstance(item, type) and item.__module__ == module.__name__ and hasattr(item, "id")
    ]
    if not classes:
        hint = "write a class with id = 500, forward and inverse; see docs/user_kinematics.md"
        message = f"{path.name} defines no kinematics class"
        return {}, (diagnostic("N4301", None, message, hint),)
    return _builders(((path.name, cls) for cls in classes), deviation)


def _installed(deviation: float) -> tuple[dict[int, Builder], list[Diagnostic]]:
    """Classes of installed packages. What is wrong with one of them does not stop the others.

    Of several with one id none is taken: which one is meant only the user can say, with a file.
    """
    classes: list[tuple[str, type]] = []
    found: list[Diagnostic] = []
    for point in sorted(metadata.entry_points(group=GROUP), key=lambda p: (p.name, p.value)):
        try:
            classes.append((f"entry point {point.name}", point.load()))
        except (Exception, SystemExit) as error:
            what = f"entry point {point.name} ({point.value}) cannot be loaded: {_said(error)}"
            found.append(diagnostic("N4301", None, what, severity=Severity.WARNING))
    builders, problems = _builders(classes, deviation)
    found.extend(replace(d, severity=Severity.WARNING) for d in problems)
    sound = (cls for _, cls in classes if isinstance(cls, type) and not faults_of(cls))
    ids = Counter(getattr(cls, "id", 0) for cls in sound)
    return {id: b for id, b in builders.items() if ids[id] == 1}, found


def _builders(
    classes: Iterable[tuple[str, type]], deviation: float
) -> tuple[dict[int, Builder], tuple[Diagnostic, ...]]:
    builders: dict[int, Builder] = {}
    taken: dict[int, str] = {}
    found = []
    for place, cls in classes:
        name = getattr(cls, "__name__", str(cls))
        faults = faults_of(cls) if isinstance(cls, type) else ("it is no class",)
        if not faults and cls.id in builders:  # type: ignore[attr-defined]
            other = taken[cls.id]  # type: ignore[attr-defined]
            faults = (f"its id {cls.id} is used by {other}",)  # type: ignore[attr-defined]
        if faults:
            message = f"{place}: {name} is no kinematics: {'; '.join(faults)}"
            found.append(diagnostic("N4301", None, message))
            continue
        builders[cls.id] = builder_of(cls, deviation)  # type: ignore[attr-defined]
        taken[cls.id] = f"{place}: {name}"  # type: ignore[attr-defined]
    return builders, tuple(found)


def _not_run(source: Source, path: Path, error: BaseException) -> Diagnostic:
    """The error of the file, at its line when that is known."""
    line = error.lineno if isinstance(error, SyntaxError) else _line_of(error, path)
    span = None
    if line and line <= source.text.count("\n") + 1:
        start = source.line_start(line)
        span = Span(source, start, start + len(source.line_text(line)))
    return diagnostic("N4301", span, f"{path.name} cannot be run: {_said(error)}")


def _line_of(error: BaseException, path: Path) -> int:
    """The last line of the file itself in the traceback."""
    line, trace = 0, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    return line


def _said(error: BaseException) -> str:
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    return f"{type(error).__name__}: {(text or 'no message').splitlines()[0][:200]}"
