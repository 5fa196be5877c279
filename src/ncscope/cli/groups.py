"""Options in groups: a dataclass of options stands for all of them in a command.

    @with_groups
    def run_command(program: ..., *, setup: MachineOptions, format: ... = None) -> None:

gives the command the options `program`, those of `MachineOptions`, and `format`, in this order.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import cache, wraps
from typing import Any, get_type_hints


def with_groups(command: Callable[..., None]) -> Callable[..., None]:
    """The command with the fields of each group in place of the parameter of its type."""
    parameters = inspect.signature(command, eval_str=True).parameters.values()
    groups = {p.name: p.annotation for p in parameters if _is_group(p.annotation)}

    @wraps(command)
    def ungrouped(**values: Any) -> None:
        for name, group in groups.items():
            values[name] = group(**{field.name: values.pop(field.name) for field in fields(group)})
        command(**values)

    options = [option for parameter in parameters for option in _options_of(parameter)]
    ungrouped.__signature__ = inspect.Signature(options)  # type: ignore[attr-defined]
    return ungrouped


def _is_group(annotation: object) -> bool:
    return is_dataclass(annotation)


def _options_of(parameter: inspect.Parameter) -> tuple[inspect.Parameter, ...]:
    """The parameter itself, or one for each field where its type is a group."""
    if _is_group(parameter.annotation):
        return _fields_of(parameter.annotation)
    return (parameter.replace(kind=parameter.KEYWORD_ONLY),)


@cache
def _fields_of(group: type[Any]) -> tuple[inspect.Parameter, ...]:
    types, kind = get_type_hints(group, include_extras=True), inspect.Parameter.KEYWORD_ONLY
    return tuple(
        inspect.Parameter(field.name, kind, default=field.default, annotation=types[field.name])
        for field in fields(group)
    )
