"""Splines: the ends of blocks are shown where the curve leads through them.

Source: TF5200 programming manual, #SPLINE, G151.
"""

from __future__ import annotations

from ncscope.channel.draft import Draft
from ncscope.diagnostics import Span
from ncscope.language import tree


def begin(draft: Draft, span: Span, name: str) -> None:
    """#SPLINE ON, G151: a warning for Akima splines; B-splines miss their points."""
    if draft.modes.control_points:
        what = f"{name} with B-splines, which do not lead through the programmed points,"
        draft.refuse(span, what)
    what = f"{name}: the curve is not computed; straight lines between the same points are shown"
    draft.warn("N2038", span, what, "the ends of blocks are right, the path between them is not")


def _on(draft: Draft, command: tree.HashCommand) -> None:
    begin(draft, command.span, "#SPLINE ON")


def _type(draft: Draft, command: tree.HashCommand) -> None:
    draft.modal(control_points=command.name.endswith("BSPLINE"))


COMMANDS = {"SPLINE ON": _on, "SPLINE TYPE AKIMA": _type, "SPLINE TYPE BSPLINE": _type}
