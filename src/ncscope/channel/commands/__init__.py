"""The # commands that change state: one table from name to rule.

Commands without effect on positions and commands that are refused stand in the table of
`language.commands`; what is in neither is unknown.
"""

from ncscope.channel import corner, manual
from ncscope.channel.commands import (
    axes,
    contour,
    conversion,
    cycles,
    effector_system,
    errors,
    exchange,
    length_axis,
    length_correction,
    machine_data,
    machine_system,
    measuring_mode,
    messages,
    named_systems,
    point_to_point,
    positions,
    preset,
    program_transformation,
    spline,
    system_mode,
    systems,
    tool_orientation,
    transformation,
    transformation_stack,
)
from ncscope.channel.commands import declarations as declared

COMMANDS = {
    **systems.COMMANDS,
    **system_mode.COMMANDS,
    **named_systems.COMMANDS,
    **effector_system.COMMANDS,
    **preset.COMMANDS,
    **machine_system.COMMANDS,
    **length_correction.COMMANDS,
    **length_axis.COMMANDS,
    **manual.COMMANDS,
    **measuring_mode.COMMANDS,
    **corner.COMMANDS,
    **contour.COMMANDS,
    **transformation.COMMANDS,
    **point_to_point.COMMANDS,
    **tool_orientation.COMMANDS,
    **program_transformation.COMMANDS,
    **transformation_stack.COMMANDS,
    **conversion.COMMANDS,
    **axes.COMMANDS,
    **messages.COMMANDS,
    **positions.COMMANDS,
    **declared.COMMANDS,
    **cycles.COMMANDS,
    **exchange.COMMANDS,
    **machine_data.COMMANDS,
    **errors.COMMANDS,
    **spline.COMMANDS,
}

LAST = frozenset({"SUPPRESS OFFSETS", "TOOL ORI CS"})
"""Commands that move: they act after the words of their block, such as G90, G01 and F."""
