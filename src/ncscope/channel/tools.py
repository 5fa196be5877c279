"""T and D: which tool data record acts (TF5200 tool data)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.channel.selection import kinematics_of, refuse_unmodelled
from ncscope.diagnostics import Span
from ncscope.language import tree
from ncscope.machine import Tool

if TYPE_CHECKING:
    from ncscope.channel.words import Words


def select(draft: Draft, index: int, span: Span, together: bool = False) -> None:
    """D word: the record counts from the next absolute word, or moves at once (P-CHAN-00100).

    together: axis words of the block move with it, so there is one motion.
    """
    before = draft.state
    tool = Tool() if index == 0 else _record(draft, index, span)
    _check_kinematics(draft, index, tool, span)
    draft.state = offsets.select_tool(draft.state, index, tool, draft.place)
    if before.coordinates.kinematics is not None:
        refuse_unmodelled(draft, span)
    if dict(before.tool.record.kinematic_parameters) != dict(tool.kinematic_parameters):
        renew_kinematics(draft, span)
    moved = not np.array_equal(draft.state.position.program, before.position.program)
    at_once = draft.machine.settings.tool_moves_at_once and before.coordinates.kinematics is None
    if not (moved and at_once):
        return
    program = before.position.program
    if together:
        position = replace(draft.state.position, program=program)
        draft.state = draft.state.changed(position=position)
    else:
        draft.move_to(program, span)


def note_write(draft: Draft, words: Words, word: tree.Assignment) -> None:
    """Remembers a write to V.G.WZ_AKT.*; fails for the second one of a field in a block."""
    target = word.target
    if not isinstance(target, tree.Variable) or len(target.parts) < 4:
        return
    if [part.name.upper() for part in target.parts[:3]] != ["V", "G", "WZ_AKT"]:
        return
    name = target.span.text.strip().upper()
    if name in words.tool_writes:
        first = words.tool_writes[name]
        what = f"{name} is written twice in one block"
        draft.fail("20741", target.span, what, notes=(("the other one", first),))
    words.tool_writes[name] = target.span


def refuse_written(draft: Draft, words: Words, span: Span) -> None:
    """Fails for a D word in a block that writes data of the selected tool."""
    for name, place in words.tool_writes.items():
        what = f"{name} cannot be written in a block with a D word"
        draft.fail("20738", place, what, "write D in a block before it", notes=(("here", span),))


def _record(draft: Draft, index: int, span: Span) -> Tool:
    tool = draft.state.tools.get(index)
    if tool is None:
        has = " ".join(f"D{i}" for i in sorted(draft.state.tools)) or "no tool data at all"
        draft.fail("20172", span, f"tool data D{index} does not exist; the lists have {has}")
    if not tool.valid:
        draft.fail(
            "20691",
            span,
            f"tool data D{index} is not valid",
            f"set wz[{index}].gueltig or V.G.WZ[{index}].OK to 1 ({tool.origin})",
        )
    return tool


def _check_kinematics(draft: Draft, index: int, tool: Tool, span: Span) -> None:
    """A tool preselects its kinematics; an active one must be the same (P-TOOL-00011)."""
    held = draft.state.kinematics
    if not tool.kinematic_id:
        return
    if held.is_on and tool.kinematic_id != held.ids[0]:
        draft.fail(
            "20990",
            span,
            f"tool D{index} belongs to kinematics {tool.kinematic_id}, "
            f"but kinematics {held.ids[0]} is active",
        )
    ids = (tool.kinematic_id, held.ids[1])
    draft.state = draft.state.changed(kinematics=replace(held, ids=ids))


def renew_kinematics(draft: Draft, span: Span) -> None:
    """The active kinematics with the parameters that the tool adds; axes and pose stay."""
    coordinates = draft.state.coordinates
    if coordinates.kinematics is None:
        return
    model = kinematics_of(draft, span, draft.state.kinematics.active)
    active = replace(coordinates.kinematics, model=model)
    draft.set_coordinates(replace(coordinates, kinematics=active), span)
