"""The draft of one block: what it collects before it is committed, or dropped whole.

A rule reports the user's mistake with `Draft.fail`, which ends the block; the state stays as it
was before the block.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NoReturn

import numpy as np

from ncscope.channel.state import CallRequest, Modal, Position, Return, State
from ncscope.coordinates import Coordinates
from ncscope.diagnostics import Diagnostic, Span, diagnostic
from ncscope.kinematics.step import KinematicsError
from ncscope.machine import Machine
from ncscope.motion import Move
from ncscope.motion.arc import Arc
from ncscope.motion.corners import Corner


@dataclass(frozen=True, slots=True)
class Message:
    """A text that the program wrote; `file` is None for a message to a display.

    end: what follows the text in the file (a line end, or nothing with CONTINUE).
    span: the command that wrote it.
    """

    file: str | None
    text: str
    end: str = "\n"
    span: Span | None = None


class BlockError(Exception):
    """Carries the diagnostic that ends the block; caught where the block is executed."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


@dataclass(slots=True)
class Draft:
    """The working copy of the state during one block.

    at: the block, or in words what stands for one. calls: the subprograms that run behind it, the
    implicit ones (G80, M6) first.
    """

    machine: Machine
    state: State
    at: Span | str
    diagnostics: list[Diagnostic] = field(default_factory=list)
    messages: list[Message] = field(default_factory=list)
    moves: list[Move] = field(default_factory=list)
    calls: list[CallRequest] = field(default_factory=list)
    implicit_calls: int = 0
    ended: bool = False
    returned: Return | None = None
    inserts: dict[str, tuple[float, Span]] = field(default_factory=dict)
    corner: Corner | None = None

    @property
    def place(self) -> str:
        """The block as origins name it."""
        return self.at if isinstance(self.at, str) else self.at.place

    def fail(self, id: str, span: Span, message: str, hint: str = "", **more: Any) -> NoReturn:
        raise BlockError(diagnostic(id, span, message, hint, **more))

    def warn(self, id: str, span: Span, message: str, hint: str = "") -> None:
        self.diagnostics.append(diagnostic(id, span, message, hint))

    def refuse(self, span: Span, what: str) -> NoReturn:
        """The refusal by name of what moves positions and is not modelled."""
        hint = "the run stops here, because positions after it would not be right"
        self.fail("N2001", span, f"{what} is not supported", hint)

    # --- axes ----------------------------------------------------------------------------------

    def axis_index(self, name: str, span: Span, id: str = "20200") -> int:
        """Channel index of an axis; fails with the axes that exist."""
        for index, axis in enumerate(self.state.axes):
            if axis.name == name:
                return index
        names = self.state.axis_names
        if name.startswith("@"):
            self.cycle_parameters(span, "21383")
            return self.state.main_axes["XYZ".index(name[1])]
        other = [n for n in names if n.lower() == name.lower()]
        hint = f"axis names are case-sensitive: write {other[0]}" if other else ""
        joined = re.fullmatch(r"([A-Z])([0-9.]+)(\D\w*)", name)
        if joined and joined[1] in names:
            word, rest = joined[1] + joined[2], joined[3]
            hint = f"all before = is one name: write a blank after the value, {word} {rest}=.."
        has = f"the axes {' '.join(names)}" if names else "no axes"
        self.fail(id, span, f"axis {name} is not in this channel; it has {has}", hint)

    def length(self, axis: int, value: float) -> float:
        """A programmed value of an axis in mm or degrees."""
        return value * self.state.unit(axis)

    def shown(self, axis: int, value: float) -> float:
        """A value in mm or degrees as the program reads it (inches under G70)."""
        return value / self.state.unit(axis)

    def cycle_parameters(self, span: Span, id: str = "21382") -> Mapping[int, float | str]:
        """The @P values of the running cycle; fails outside of cycles."""
        held = self.state.running.parameters
        if held is None:
            what = span.text.strip()
            hint = "call it with L CYCLE [NAME=.. @P1=..]"
            self.fail(id, span, f"{what} has a meaning in cycles only", hint)
        return held

    # --- changes -------------------------------------------------------------------------------

    def modal(self, **changes: Any) -> None:
        modes = self.state.modal
        for name, value in changes.items():
            if getattr(modes, name) != value:
                self.state = self.state.changed(modal=modes.changed(**changes))
                return

    @property
    def modes(self) -> Modal:
        return self.state.modal

    def set_coordinates(self, coordinates: Coordinates, span: Span) -> None:
        """Other coordinates with the axes where they are."""
        transformed = coordinates.kinematics is not None or coordinates.length_step is not None
        if transformed and coordinates.manual is not None:
            what = "a transformation is not supported while manual offsets are superimposed"
            self.fail("N2001", span, what, "write #CHANNEL INIT [CMDPOS] before it")
        try:
            self.state = self.state.with_coordinates(coordinates)
        except KinematicsError as error:
            self.fail(error.id, span, error.message, error.hint)

    def move_to(
        self,
        program: np.ndarray,
        span: Span,
        coordinates: Coordinates | None = None,
        arc: Arc | None = None,
        direction: Span | None = None,
        way: np.ndarray | None = None,
    ) -> None:
        """A motion to programmed values (n,), mm and degrees; `coordinates` for this one alone.

        direction: the word that gives the tool direction, blamed where that cannot be reached.
        way: programmed values at the end before modulo axes are wrapped, None where that is
        `program`.
        """
        state = self.state
        chain = coordinates or state.coordinates
        try:
            start = state.position.program
            if coordinates is not None:
                start = coordinates.to_program(state.position.axes)
            axes = chain.to_axes(program, near=state.position.axes)
            shown = program
            if coordinates is not None:
                shown = state.coordinates.to_program(axes, near=program)
        except KinematicsError as error:
            if direction is not None and error.id in ("292014", "292007"):
                span = direction
            self.fail(error.id, span, error.message, error.hint)
        if not all(map(math.isfinite, axes.tolist())):
            self.fail("21883", span, "the axis position is too large to be computed")
        self.state = state.changed(position=Position(axes, shown))
        modes = state.modal
        self.moves.append(
            Move(
                modes.motion,
                modes.feed,
                start,
                program,
                axes,
                state.block,
                span,
                coordinates,
                arc,
                way,
            )
        )

    def rapid_to(
        self, program: np.ndarray, span: Span, coordinates: Coordinates | None = None
    ) -> None:
        """`move_to` as a rapid motion, whatever motion is modal."""
        motion = self.modes.motion
        self.modal(motion="G00")
        self.move_to(program, span, coordinates)
        self.modal(motion=motion)
