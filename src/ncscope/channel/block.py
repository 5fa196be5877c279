"""One block: collected, checked, committed.

Enters: machine, state, block. Leaves: the next state with moves, messages and diagnostics. On an
error the state is as before the block.
"""

from __future__ import annotations

from typing import NamedTuple

from ncscope.channel import calls, macros, modulo, radius_compensation, tools
from ncscope.channel.commands import COMMANDS, LAST, point_to_point
from ncscope.channel.commands.bare import refuse_arguments
from ncscope.channel.commands.declarations import declare
from ncscope.channel.commands.machine_system import refuse_inside
from ncscope.channel.draft import BlockError, Draft, Message
from ncscope.channel.evaluation import evaluate_number, write_variable
from ncscope.channel.gfunctions import GFUNCTIONS
from ncscope.channel.rules import awake, reject_unused
from ncscope.channel.state import CallRequest, Return, State
from ncscope.channel.words import Words, collect_axes, cycle_letter, refuse_path_condition
from ncscope.diagnostics import Diagnostic, diagnostic
from ncscope.kinematics.step import KinematicsError
from ncscope.language import tree
from ncscope.language.commands import READING, SMOOTHING, lookup
from ncscope.machine import Machine
from ncscope.motion import Move
from ncscope.motion.corners import Corner


class Step(NamedTuple):
    """What one block did.

    corner: a chamfer or rounding before the next move. ended: M02 or M30 was reached.
    returned: what M17 or M29 asks for, None without. calls: the subprograms that run behind the
    block.
    """

    state: State
    moves: tuple[Move, ...] = ()
    messages: tuple[Message, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    ended: bool = False
    returned: Return | None = None
    corner: Corner | None = None
    calls: tuple[CallRequest, ...] = ()

    @property
    def failed(self) -> bool:
        return any(d.is_error for d in self.diagnostics)


def execute(machine: Machine, state: State, block: tree.Block) -> Step:
    """The step that a block makes."""
    draft = Draft(machine, state, block.span)
    try:
        _execute(draft, block)
    except BlockError as error:
        return Step(state, diagnostics=(*draft.diagnostics, error.diagnostic))
    except KinematicsError as error:
        found = diagnostic(error.id, block.span, error.message, error.hint)
        return Step(state, diagnostics=(*draft.diagnostics, found))
    return Step(
        draft.state,
        tuple(draft.moves),
        tuple(draft.messages),
        tuple(draft.diagnostics),
        draft.ended,
        draft.returned,
        draft.corner,
        tuple(draft.calls),
    )


LARGEST_NUMBER = 10**15


def _block_number(draft: Draft, block: tree.Block) -> int | None:
    if block.number is None:
        return None
    number = round(evaluate_number(draft, block.number))
    if abs(number) > LARGEST_NUMBER:
        draft.fail("N2099", block.number.span, f"the block number {number:.3g} is too large")
    return number


def _execute(draft: Draft, block: tree.Block) -> None:
    """The order of effects inside a block (TF5200 programming manual)."""
    # 1. Block number; what is not supported is refused by name.
    number = _block_number(draft, block)
    if number != draft.state.block:
        draft.state = draft.state.changed(block=number)
    _refuse_axis_commands(draft, block)
    # 2. # commands and declarations.
    for declaration in block.declarations:
        declare(draft, declaration)
    for command in block.commands:
        if command.name not in LAST:
            _command(draft, command, block)
    # 3. Words from left to right; an assignment acts before the words that follow it.
    words = Words()
    _collect(draft, words, block.words)
    # 4. Modal functions, 5. offsets, 6. tool, feed, 7. motion, 8. program end.
    for rule in awake(draft, words):
        rule(draft, words)
    for command in block.commands:
        if command.name in LAST:
            _command(draft, command, block)
    reject_unused(draft, words)
    if block.words or block.commands:
        calls.after_block(draft, bool(draft.moves))


def _refuse_axis_commands(draft: Draft, block: tree.Block) -> None:
    for word in block.words:
        if isinstance(word, tree.AxisCommand):
            draft.refuse(word.span, f"the axis command {word.name}[{word.keyword} ..]")


def _command(draft: Draft, command: tree.HashCommand, block: tree.Block) -> None:
    refuse_inside(draft, command)
    radius_compensation.refuse(draft, command)
    point_to_point.refuse_inside(draft, command)
    refuse_path_condition(draft, command.name, block.words)
    refuse_arguments(draft, command)
    row = lookup(command.name)
    if command.name in COMMANDS:
        COMMANDS[command.name](draft, command)
    elif command.name in READING:
        what = f"#{command.name} asks the machine, and its answer is not known here"
        hint = "the variables that it writes keep their values"
        draft.warn("N2002", command.span, what, hint)
    elif row is not None and row.kind == "no effect":
        what = "has no effect on positions"
        if command.name in SMOOTHING:
            what = "smooths the path between the ends of blocks; it is shown without"
        draft.warn("N2002", command.span, f"#{command.name} {what}")
    else:
        draft.refuse(command.span, f"#{command.name}")


# --- collect -----------------------------------------------------------------------------------


def _collect(draft: Draft, collected: Words, words: tuple[tree.Word, ...], depth: int = 0) -> None:
    for word in words:
        match word:
            case tree.Assignment():
                tools.note_write(draft, collected, word)
                write_variable(draft, word)
            case tree.GWord():
                _collect_g(draft, collected, word)
            case tree.MWord():
                _collect_m(draft, collected, word)
            case tree.AddressWord():
                _collect_address(draft, collected, word)
            case tree.AxisWord():
                axis = collect_axes(draft, collected.axes, word)
                modulo.keep_sign(draft, collected, axis, word)
            case tree.SpindleWord():
                draft.warn("N2002", word.span, f"spindle word {word.name} does not move an axis")
            case tree.Call():
                calls.request(draft, word)
            case tree.MacroDefinition():
                macros.define(draft, word)
            case tree.Macro():
                collected.macro_uses += 1
                with macros.used(draft, word):
                    found = macros.words(draft, word, depth, collected.macro_uses)
                    _collect(draft, collected, found, depth + 1)


RETURNS = (17, 29)
ENDS = (2, 30, *RETURNS)


def _collect_m(draft: Draft, collected: Words, word: tree.MWord) -> None:
    number = round(evaluate_number(draft, word.number))
    for other in ENDS:
        if number in ENDS and other in collected.mfunctions:
            notes = (("the other one", collected.mfunctions[other]),)
            what = f"M{number:02d} and M{other:02d} cannot stand in one block"
            draft.fail("20158", word.span, what, notes=notes)
    collected.mfunctions[number] = word.span
    if number in RETURNS:
        draft.returned = calls.returned(draft, word)


def _collect_g(draft: Draft, collected: Words, word: tree.GWord) -> None:
    number = round(evaluate_number(draft, word.number))
    known = GFUNCTIONS.get(number)
    if known is None:
        draft.fail("20131", word.span, f"G{number} is unknown")
    for other, first in collected.gfunctions.items():
        group = GFUNCTIONS[other]
        if known.group is not None and group.group == known.group:
            draft.fail(
                known.double_id or "20108",
                word.span,
                f"G{number:02d} and G{other:02d} exclude each other in one block",
                notes=(("the other one", first.span),),
            )
    collected.gfunctions[number] = word
    if word.value is not None:
        collected.values[number] = evaluate_number(draft, word.value)


ADDRESS_TWICE = {"D": "20170", "F": "20175", "T": "20165", "I": "20205", "J": "20205", "K": "20205"}


def _collect_address(draft: Draft, collected: Words, word: tree.AddressWord) -> None:
    letter = cycle_letter(draft, word)
    if letter in collected.addresses:
        draft.fail(
            ADDRESS_TWICE.get(letter, "N2003"),
            word.span,
            f"the block has two {letter} words",
        )
    collected.addresses[letter] = (evaluate_number(draft, word.value), word.span)
