"""#MEAS [TYPE=2], #MEAS MODE [2], #MEAS DEFAULT: how G100 measures (TF5200 #MEAS)."""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number
from ncscope.channel.measuring import LAST_TYPE
from ncscope.channel.state import Measuring
from ncscope.language import tree


def settings(draft: Draft, command: tree.HashCommand) -> None:
    """#MEAS [TYPE=.. ERR_NO_SIGNAL=..]; signals and edges of the probe change nothing here."""
    items = [item for group in command.groups for item in group.items]
    if not items:
        draft.fail(
            "20480", command.span, "#MEAS needs an option", "write for example #MEAS [TYPE=2]"
        )
    for item in items:
        if item.key == "TYPE" and item.value is not None:
            _set_type(draft, item.value)
        elif item.key == "ERR_NO_SIGNAL" and item.value is not None:
            must = abs(evaluate_number(draft, item.value)) >= 0.5
            held = replace(draft.state.measuring, must_answer=must)
            draft.state = draft.state.changed(measuring=held)
        elif item.key == "SIMU_OFFSET":
            hint = "give the contact as a row of --probe"
            draft.warn("N2006", item.span, "SIMU_OFFSET of #MEAS is ignored", hint)
        elif item.key is None:
            what = "an option of #MEAS has a name and a value"
            draft.fail("N1005", item.span, what, "write for example #MEAS [TYPE=2]")
        else:
            what = f"the option {item.key} of #MEAS has no effect on positions"
            draft.warn("N2006", item.span, what)


def mode(draft: Draft, command: tree.HashCommand) -> None:
    """#MEAS MODE [2]"""
    places = command.groups[0].places if len(command.groups) == 1 else ()
    if len(places) != 1 or places[0] is None:
        form = "write for example #MEAS MODE [2]"
        draft.fail("N1005", command.span, "#MEAS MODE needs a measuring type", form)
    _set_type(draft, places[0])


def default(draft: Draft, command: tree.HashCommand) -> None:
    """#MEAS DEFAULT: as the channel list says."""
    settings = draft.machine.settings
    held = Measuring(settings.measuring_type, settings.probe_must_answer)
    draft.state = draft.state.changed(measuring=held)


def _set_type(draft: Draft, value: tree.Expression) -> None:
    number = evaluate_number(draft, value)
    if number not in range(1, LAST_TYPE + 1):
        draft.fail("20138", value.span, f"measuring types are 1 to {LAST_TYPE}, not {number:g}")
    held = replace(draft.state.measuring, type=round(number))
    draft.state = draft.state.changed(measuring=held)


COMMANDS = {"MEAS": settings, "MEAS MODE": mode, "MEAS DEFAULT": default}
