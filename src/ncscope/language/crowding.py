"""What must stand alone in its block: control statements and most # commands.

Enters the parts of a block. Leaves a diagnostic where one of them has company. What stands behind a
control statement is found where it is read (`controls.behind`).
Source: TF5200 programming manual
"""

from __future__ import annotations

from collections.abc import Sequence

from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.language.commands import lookup
from ncscope.language.tree import Control, Declaration, HashCommand, Word

Part = Word | Declaration | HashCommand

NOT_ALONE = {"COMMENT BEGIN": "20566", "COMMENT END": "20569"}
"""Numbers for # commands that have company; 20207 for the others."""
FIRST = ("IF", "ELSE", "ENDIF")
"""# commands that must stand first; 20593 where they do not."""
ALONE = "put the other words on their own line"


def crowded(
    words: Sequence[Word | Declaration],
    commands: Sequence[HashCommand],
    statement: Control | None,
) -> tuple[Diagnostic, ...]:
    """What stands beside a statement or command that must stand alone."""
    parts: list[Part] = [*words, *commands]
    if statement is not None and statement.keyword != "GOTO":
        return _before(parts, statement)
    for command in commands:
        row = lookup(command.name)
        if len(parts) > 1 and command.known and row is not None and row.stands_alone:
            id = NOT_ALONE.get(command.name, "20207")
            if command.name in FIRST and any(p.span.start < command.span.start for p in parts):
                id = "20593"
            message = f"#{command.name} must stand alone in its block."
            return (diagnostic(id, command.span, message, ALONE),)
    return ()


def _before(parts: list[Part], statement: Control) -> tuple[Diagnostic, ...]:
    """A control statement may have a block number or skip mark before it, and nothing else."""
    if not any(part.span.start < statement.span.start for part in parts):
        return ()
    message = f"${statement.keyword} must stand alone in its block."
    hint = "put what stands before it on a line of its own"
    return (diagnostic("20206", statement.span, message, hint),)
