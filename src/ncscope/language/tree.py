"""The program tree: frozen values, each with the span it was read from.

Enters nothing, leaves nothing: these are the nouns that the parser makes and the channel reads.
An expression is any of the classes of `Expression`; a word is any of the classes of `Word`.
"""

from __future__ import annotations

from typing import NamedTuple

from ncscope.diagnostics import Span

# --- expressions -------------------------------------------------------------------------------


class Number(NamedTuple):
    """A literal number, as written (no unit is applied here)."""

    value: float
    span: Span


class Text(NamedTuple):
    """A string literal without its quotes."""

    value: str
    span: Span


class Name(NamedTuple):
    """A bare identifier in the brackets of a # command: an axis, a keyword or a file name."""

    text: str
    span: Span


class Unary(NamedTuple):
    """`-x`, `+x`; `operator` is the sign."""

    operator: str
    operand: Expression
    span: Span


class Binary(NamedTuple):
    """`operator` is one of + - * / ** MOD & | ^ && || XOR == != < <= > >=."""

    operator: str
    left: Expression
    right: Expression
    span: Span


class Function(NamedTuple):
    """`SIN[..]`: name in capitals, its arguments in order. Includes NOT, INV, EXIST, SIZEOF."""

    name: str
    arguments: tuple[Expression, ...]
    span: Span


class Part(NamedTuple):
    """One dotted part of a variable with the indices that follow it."""

    name: str
    indices: tuple[Expression, ...]


class Variable(NamedTuple):
    """`V.G.KIN[91].POINT[0]`: parts V, G, KIN[91], POINT[0], names as written."""

    parts: tuple[Part, ...]
    span: Span


class Parameter(NamedTuple):
    """`P5`, `P[expr]`, `P5[1][2]`; `number` is the expression after the P."""

    number: Expression
    indices: tuple[Expression, ...]
    span: Span


class CycleParameter(NamedTuple):
    """`@P1`."""

    number: Expression
    span: Span


class Macro(NamedTuple):
    """`"NAME"` used as a value or as a word."""

    name: str
    span: Span


Expression = (
    Number | Text | Name | Unary | Binary | Function | Variable | Parameter | CycleParameter | Macro
)

# --- words -------------------------------------------------------------------------------------


class GWord(NamedTuple):
    """`G01`, `G[expr]`, `G159=3`, `G82 [1,2]`: `value` after `=`, `arguments` in brackets."""

    number: Expression
    value: Expression | None
    arguments: tuple[Expression | None, ...] | None
    span: Span


class MWord(NamedTuple):
    """`M30`, `M17 [JUMPS=2]`."""

    number: Expression
    arguments: tuple[Group, ...]
    span: Span


class AddressWord(NamedTuple):
    """One of D E F H I J K R S T with its value; `letter` is a capital."""

    letter: str
    value: Expression
    span: Span


class AxisWord(NamedTuple):
    """`X10`, `X_ACHSE1=5`. `sign` is the first sign after a one-letter name ('' + -), which is
    also part of `value`; on a modulo axis it is the turning direction."""

    name: str
    value: Expression
    sign: str
    span: Span


class AxisCommand(NamedTuple):
    """`X[INDP_SYN POS=5 ..]`: an axis-specific command; `keyword` in capitals."""

    name: str
    keyword: str
    span: Span


class Assignment(NamedTuple):
    """`P1 = 5`, `V.P.A += 1`; `operator` is = += -= *= /=. A list value is for arrays."""

    target: Variable | Parameter | CycleParameter
    operator: str
    value: Expression
    span: Span


class MacroDefinition(NamedTuple):
    """`"NAME" = "text"`."""

    name: str
    text: str
    span: Span


class Call(NamedTuple):
    """`LL name`, `L file.nc`, `L CYCLE [..]`: a subprogram call; `kind` is L, LL or
    `L CYCLE`, `LL CYCLE`, `L SEQUENCE`."""

    kind: str
    target: Expression | None
    arguments: tuple[Group, ...]
    span: Span


class SpindleWord(NamedTuple):
    """`S1=1000`, `S.POS=90`, `S[...]`: a spindle word with a longer name."""

    name: str
    span: Span


Word = (
    GWord
    | MWord
    | AddressWord
    | AxisWord
    | AxisCommand
    | Assignment
    | Macro
    | MacroDefinition
    | Call
    | SpindleWord
)

# --- commands and blocks -----------------------------------------------------------------------


class Item(NamedTuple):
    """One argument in brackets: `key=value`, `key value`, or a value alone (`key` None).

    Keys are capitals. An empty place between commas has neither key nor value.
    """

    key: str | None
    value: Expression | None
    span: Span


class Group(NamedTuple):
    """One `[..]` of a command: cells between commas, each with blank-separated items."""

    cells: tuple[tuple[Item, ...], ...]
    span: Span

    @property
    def items(self) -> tuple[Item, ...]:
        """All items, whether a comma or a blank stands between them; empty places left out."""
        return tuple(
            i for cell in self.cells for i in cell if i.key is not None or i.value is not None
        )

    @property
    def places(self) -> tuple[Expression | None, ...]:
        """The values between commas, in order; None for an empty place."""
        return tuple(cell[0].value if cell else None for cell in self.cells)


class HashCommand(NamedTuple):
    """`#CS ON [1][..]`: `name` is the longest known command name in capitals with single blanks
    (`CS ON`), `modifiers` the further keywords before or after brackets (`EXCLUSIVE`),
    `words` the axis and G words in the command (`#PSET X20`, `#CHR=2`)."""

    name: str
    modifiers: tuple[str, ...]
    groups: tuple[Group, ...]
    words: tuple[Word, ...]
    value: Expression | None
    known: bool
    span: Span


class Control(NamedTuple):
    """`$IF e`, `$FOR P1 = 1, 5, 1`, `$GOTO N10`, `$ENDIF`: `keyword` in capitals without `$`.

    `values` has the condition, or the three values of $FOR; `target` is the $FOR variable, the
    label name or the label number of $GOTO.
    """

    keyword: str
    values: tuple[Expression, ...]
    target: Variable | Parameter | Name | Number | None
    span: Span


class Declaration(NamedTuple):
    """A line between #VAR and #ENDVAR: `V.P.A[3] : SGN32 = [1,2,3]`."""

    target: Variable | Parameter
    type: str | None
    length: Expression | None
    initial: tuple[Expression, ...]
    span: Span


class Block(NamedTuple):
    """One block: what stands in one line (or in lines joined by a backslash).

    `labels` are those of `N10: [NAME]`, in capitals, string labels with their brackets. `skip` is
    the level of a leading `/` (1 for a plain one), None without. `ok` is False when the parser
    reported an error in the block: it must not be executed.
    """

    number: Expression | None
    labels: tuple[str, ...]
    skip: int | None
    words: tuple[Word, ...]
    commands: tuple[HashCommand, ...]
    control: Control | None
    declarations: tuple[Declaration, ...]
    header: str | None
    ok: bool
    span: Span
