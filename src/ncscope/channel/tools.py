"""T and D: which tool data record acts (TF5200 tool data)."""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel import offsets
from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span
from ncscope.kinematics.parameters import KinematicParameters
from ncscope.machine import Tool

SHIFT_PARAMETERS = range(3, 6)
"""The kinematic parameters that a tool may change: zero_position (decision D-17)."""


def select(draft: Draft, index: int, span: Span) -> None:
    """D word: the record counts from the next absolute word, or moves at once (P-CHAN-00100)."""
    before = draft.state
    tool = Tool() if index == 0 else _record(draft, index, span)
    _check_kinematics(draft, index, tool, span)
    draft.state = offsets.select_tool(draft.state, index, tool, draft.place)
    if draft.machine.settings.tool_moves_at_once and before.coordinates.kinematics is None:
        draft.move_to(before.position.program, span)


def _record(draft: Draft, index: int, span: Span) -> Tool:
    tool = draft.machine.tools.get(index)
    if tool is None:
        has = " ".join(f"D{i}" for i in sorted(draft.machine.tools)) or "no tool data at all"
        draft.fail("20172", span, f"tool data D{index} does not exist; the lists have {has}")
    if not tool.valid:
        draft.fail(
            "20691",
            span,
            f"tool data D{index} is not valid",
            f"set wz[{index}].gueltig to 1 ({tool.origin})",
        )
    return tool


def _check_kinematics(draft: Draft, index: int, tool: Tool, span: Span) -> None:
    """A tool may preselect a kinematics and shift its zero position; both only while it is off."""
    held = draft.state.kinematics
    active = draft.state.coordinates.kinematics is not None
    if tool.kinematic_id:
        if active and tool.kinematic_id != held.selected:
            draft.fail(
                "20990",
                span,
                f"tool D{index} belongs to kinematics {tool.kinematic_id}, "
                f"but kinematics {held.selected} is active",
            )
        draft.state = replace(draft.state, kinematics=replace(held, selected=tool.kinematic_id))
    others = [i for i, v in tool.kinematic_parameters.items() if v and i not in SHIFT_PARAMETERS]
    if others:
        draft.fail(
            "N2001",
            span,
            f"wz[{index}].kinematic.param[{others[0]}] is not supported; "
            "a tool may only change param[3] to param[5]",
        )
    old = draft.state.tool.record.kinematic_parameters
    if active and dict(old) != dict(tool.kinematic_parameters):
        draft.fail(
            "N2001",
            span,
            f"tool D{index} changes the kinematics; that is not supported while it is active",
            "switch the transformation off first (#TRAFO OFF)",
        )


def with_tool_parameters(parameters: KinematicParameters, tool: Tool) -> KinematicParameters:
    """The data set with the tool's parameters added (wz[].kinematic.param[])."""
    for index, value in tool.kinematic_parameters.items():
        if value:
            parameters = parameters.with_value(index, parameters.values[index] + value)
    return parameters
