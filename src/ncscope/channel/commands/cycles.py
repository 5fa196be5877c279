"""#DISABLE MODAL CYCLE and #RETAIN CYCLE CHANGES (TF5200 programming manual, cycles)."""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.language import tree


def disable(draft: Draft, command: tree.HashCommand) -> None:
    """#DISABLE MODAL CYCLE: the cycle is not called again."""
    running = replace(draft.state.running, modal=None)
    draft.state = draft.state.changed(running=running)


def retain(draft: Draft, command: tree.HashCommand) -> None:
    """#RETAIN CYCLE CHANGES: what this cycle has changed in modal functions stays behind it."""
    draft.cycle_parameters(command.span)
    running = replace(draft.state.running, retain=True)
    draft.state = draft.state.changed(running=running)


COMMANDS = {"DISABLE MODAL CYCLE": disable, "RETAIN CYCLE CHANGES": retain}
