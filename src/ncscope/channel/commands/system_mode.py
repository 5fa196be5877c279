"""#CS MODE ON, OFF: how the angles of coordinate systems turn, and offsets per level.

Source: P-CHAN-00393, P-CHAN-00394, P-CHAN-00397; TF5200 coordinate systems and offsets
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.frames import ROTATION_SEQUENCES
from ncscope.language import tree

MODES = ("ROTATION_SEQUENCE", "ROTATION_MODE_FIXED", "AXES_OFFSETS_LAYER_SPECIFIC")


def mode_on(draft: Draft, command: tree.HashCommand) -> None:
    """#CS MODE ON [ROTATION_SEQUENCE=XYZ ROTATION_MODE_FIXED]: for systems switched on later."""
    items = _mode_items(draft, command)
    mode = draft.state.system_mode
    if "ROTATION_SEQUENCE" in items:
        sequence = items["ROTATION_SEQUENCE"].upper()
        if sequence not in ROTATION_SEQUENCES:
            what = f"{sequence or 'nothing'} is no rotation sequence"
            draft.fail("20675", command.span, what, "known are " + " ".join(ROTATION_SEQUENCES))
        mode = replace(mode, sequence=sequence)
    if "ROTATION_MODE_FIXED" in items:
        mode = replace(mode, fixed=True)
    if "AXES_OFFSETS_LAYER_SPECIFIC" in items:
        mode = replace(mode, per_level=True)
    draft.state = draft.state.changed(system_mode=mode)


def mode_off(draft: Draft, command: tree.HashCommand) -> None:
    """#CS MODE OFF [..]: the sequence of the channel parameter; turns about the new axes."""
    items = _mode_items(draft, command)
    mode = draft.state.system_mode
    if "ROTATION_SEQUENCE" in items:
        mode = replace(mode, sequence=None)
    if "ROTATION_MODE_FIXED" in items:
        mode = replace(mode, fixed=False)
    if "AXES_OFFSETS_LAYER_SPECIFIC" in items:
        _check_levels(draft, command)
        mode = replace(mode, per_level=False)
    draft.state = draft.state.changed(system_mode=mode)


def _mode_items(draft: Draft, command: tree.HashCommand) -> dict[str, str]:
    """Option -> its word, '' without; `ROTATION_SEQUENCE=XYZ` and `ROTATION_SEQUENCE XYZ`."""
    found: dict[str, str] = {}
    last = ""
    for item in (i for group in command.groups for i in group.items):
        word = item.value.text if isinstance(item.value, tree.Name) else ""
        key = item.key or word.upper()
        if key in MODES:
            found[key], last = word if item.key else "", key
        elif last == "ROTATION_SEQUENCE" and not found[last] and not item.key:
            found[last] = word
        else:
            what = f"{item.span.text.strip()} is no option of #CS MODE"
            draft.fail("20675", item.span, what, "known are " + " ".join(MODES))
    if not found:
        draft.fail("20480", command.span, "#CS MODE needs an option", "known: " + " ".join(MODES))
    return found


def _check_levels(draft: Draft, command: tree.HashCommand) -> None:
    """What levels already hold for the axes beyond the third could not be told from one common
    offset afterwards."""
    for level in draft.state.coordinates.levels[1:]:
        if any(any(offset.values[3:]) for _, offset in level.offsets):
            what = f"{level.name} has offsets of its own for the axes beyond the third"
            hint = (
                "write #CS MODE OFF [AXES_OFFSETS_LAYER_SPECIFIC] before the system is switched on"
            )
            draft.fail("N2052", command.span, what, hint)


COMMANDS = {"CS MODE ON": mode_on, "CS MODE OFF": mode_off}
