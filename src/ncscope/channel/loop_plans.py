"""Blocks and control statements as compiled steps: what a loop repeats.

Enters the entries of a layout. Leaves for each a function that makes its step on a `LoopState` and
gives the index of the next entry, or None for what only the step lane knows: anything but plain
variables, straight motions, G0 G1 G90 G91, F, $FOR, $WHILE, $DO, $REPEAT and $IF. A step that
cannot be made raises before it changes anything; the step lane makes it then and reports it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ncscope.language import inline, tree
from ncscope.language.inline import NotInline, condition, source, variable_key
from ncscope.language.structure import LOOPS, Entry, Layout, Statement, jumps

PLAIN_G = (0, 1, 90, 91)
Row = list[float]


class StepLane(Exception):
    """The step is one for the step lane; nothing has been changed."""


@dataclass(slots=True)
class LoopState:
    """What compiled steps change: plain variables, programmed values and a few modal values.

    v: values by name. p: programmed values; each motion makes a new list. info: for each motion
    entry index, motion code, feed and block number. visits: for each entry without motion how many
    motions were before it and its block number. passes: of the walker, by loop.
    """

    v: dict[str, float]
    p: Row
    passes: dict[tuple[str, int], int]
    motion: int
    absolute: bool
    feed: float | None
    feed_warned: bool
    block: int | None
    rows: list[Row] = field(default_factory=list)
    info: list[tuple[int, int, float | None, int | None]] = field(default_factory=list)
    visits: dict[int, tuple[int, int | None]] = field(default_factory=dict)


Step = Callable[[LoopState], int]


@dataclass(frozen=True, slots=True)
class Units:
    """The channel as far as compiled steps depend on it.

    axes: name and index of the axes that are not modulo axes. factors: mm or degrees of a
    programmed unit, by index. feed: mm of a programmed unit of F.
    """

    axes: tuple[tuple[str, int], ...]
    factors: tuple[float, ...]
    feed: float


def plan(layout: Layout, at: int, units: Units) -> Step | None:
    """The compiled step of an entry, None where the step lane has to make it."""
    entry = layout.entries[at]
    try:
        if entry.found or not entry.block.ok or entry.block.header is not None:
            return None
        if entry.keyword:
            return _control(layout, at, entry)
        return _compiled(_Block(at, entry.block, units).text())
    except NotInline:
        return None


def _compiled(text: str) -> Step:
    space = {**inline.NAMESPACE, "StepLane": StepLane}
    exec(compile(text, "<loop>", "exec"), space)  # the text is made of numbers and names of ours
    return space["step"]


# --- motions and assignments -------------------------------------------------------------------


class _Block:
    """The Python text of one block: all values first, then all changes."""

    def __init__(self, at: int, block: tree.Block, units: Units) -> None:
        self.at, self.block, self.units = at, block, units
        self.names: dict[str, str] = {}
        self.lines: list[str] = []
        self.axes: dict[int, str] = {}
        self.codes: set[int] = set()
        self.feed = ""
        if block.commands or block.declarations or not block.words:
            raise NotInline
        if block.number is not None and not isinstance(block.number, tree.Number):
            raise NotInline

    def text(self) -> str:
        for word in self.block.words:
            self._word(word)
        if {0, 1} <= self.codes or {90, 91} <= self.codes:
            raise NotInline
        body = [*self.lines, *self._checks(), *self._changes(), f"return {self.at + 1}"]
        return "def step(m):\n    v = m.v\n" + "".join(f"    {line}\n" for line in body)

    def _word(self, word: tree.Word) -> None:
        match word:
            case tree.Assignment():
                self._assign(word)
            case tree.GWord(value=None, arguments=None):
                self._code(word)
            case tree.AxisWord():
                self._axis(word)
            case tree.AddressWord(letter="F") if not self.feed:
                self.feed = self._local(source(word.value, self.names))
                self.lines.append(f"if {self.feed} <= 0.0: raise StepLane")
            case _:
                raise NotInline

    def _local(self, text: str) -> str:
        """A new local name for a value, which has to be finite."""
        name = f"t{len(self.lines)}"
        self.lines.append(f"{name} = finite({text})")
        return name

    def _assign(self, word: tree.Assignment) -> None:
        key = variable_key(word.target)
        if isinstance(word.value, (tree.Text, tree.Name, tree.Macro)):
            raise NotInline
        value = source(word.value, self.names)
        if word.operator != "=":
            old = self.names.get(key, f"v[{key!r}]")
            sign = word.operator[0]
            value = f"quotient({old}, {value})" if sign == "/" else f"{old} {sign} ({value})"
        if key not in self.names:
            self.lines.append(f"v[{key!r}]")  # a variable that does not exist is not for us
        self.names[key] = self._local(value)

    def _code(self, word: tree.GWord) -> None:
        if not isinstance(word.number, tree.Number) or word.number.value not in PLAIN_G:
            raise NotInline
        if word.number.value in self.codes:
            raise NotInline
        self.codes.add(int(word.number.value))

    def _axis(self, word: tree.AxisWord) -> None:
        index = dict(self.units.axes).get(word.name)
        if index is None or index in self.axes:
            raise NotInline
        self.axes[index] = self._local(source(word.value, self.names))

    def _checks(self) -> list[str]:
        """A feed motion without a feed is for the step lane, which warns."""
        if not self.axes or self.feed or 0 in self.codes:
            return []
        moved = "" if 1 in self.codes else "m.motion and "
        return [f"if {moved}m.feed is None and not m.feed_warned: raise StepLane"]

    def _changes(self) -> list[str]:
        number = self.block.number
        block = round(number.value) if isinstance(number, tree.Number) else None
        result = [f"v[{key!r}] = {name}" for key, name in self.names.items()]
        result.append(f"m.block = {block}")
        for code in sorted(self.codes):
            result.append(f"m.motion = {code}" if code < 2 else f"m.absolute = {code == 90}")
        if self.feed:
            result.append(f"m.feed = {_scaled(self.feed, self.units.feed)}")
        if not self.axes:
            return [*result, f"m.visits[{self.at}] = (len(m.rows), {block})"]
        result.append("m.p = p = m.p[:]")
        for index, name in self.axes.items():
            length = _scaled(name, self.units.factors[index])
            if {90, 91} & self.codes:
                added = "" if 90 in self.codes else f"p[{index}] + "
                result.append(f"p[{index}] = {added}{length}")
            else:
                added = f"{length} if m.absolute else p[{index}] + {length}"
                result.append(f"p[{index}] = {added}")
        result.append("m.rows.append(p)")
        result.append(f"m.info.append(({self.at}, m.motion, m.feed, {block}))")
        return result


def _scaled(name: str, factor: float) -> str:
    return name if factor == 1.0 else f"{name} * {factor!r}"


# --- control statements ------------------------------------------------------------------------


def _control(layout: Layout, at: int, entry: Entry) -> Step:
    statement = layout.statements.get(at)
    if statement is None or statement.end is None or entry.block.words:
        raise NotInline
    if not layout.entries[statement.end].block.ok:
        raise NotInline
    keyword = entry.keyword
    if keyword == "IF" and not jumps(entry.block.control):
        return _compiled(_branches(layout, statement))
    if keyword in ("ELSEIF", "IFELSE", "ELSE", "BREAK"):
        return _goes_to(statement.end + 1)
    if keyword == "ENDIF":
        return _goes_to(at + 1)
    if keyword == "CONTINUE":
        return _goes_to(statement.end)
    if keyword in LOOPS:
        return _compiled(_loop(layout, statement, begins=True))
    if keyword in ("ENDFOR", "ENDWHILE", "ENDDO", "UNTIL"):
        return _compiled(_loop(layout, statement, begins=False))
    raise NotInline


def _goes_to(target: int) -> Step:
    return lambda m: target


def _values(layout: Layout, at: int) -> tuple[tree.Expression, ...]:
    control = layout.entries[at].block.control
    if control is None or layout.entries[at].found:
        raise NotInline
    return control.values


def _branches(layout: Layout, statement: Statement) -> str:
    """$IF: the first branch whose condition is met."""
    lines = []
    for at in (statement.first, *statement.branches):
        values = _values(layout, at)
        lines.append(f"if {condition(values[0], {})}: return {at + 1}" if values else "")
        if not values:
            lines[-1] = f"return {at + 1}"
            break
    assert statement.end is not None
    lines.append(f"return {statement.end + 1}")
    return "def step(m):\n    v = m.v\n" + "".join(f"    {line}\n" for line in lines)


def _loop(layout: Layout, statement: Statement, *, begins: bool) -> str:
    """The begin of a loop, or its end: whether another pass follows."""
    assert statement.end is not None
    key = (layout.source.name, statement.first)
    lines: list[str] = []
    names: dict[str, str] = {}
    keyword = statement.keyword
    if keyword == "FOR":
        names = _count(layout, statement, lines, begins)
    if not begins and keyword in ("DO", "REPEAT"):
        stop = condition(_values(layout, statement.end)[0], {})
        lines.append(f"if {'not ' if keyword == 'DO' else ''}({stop}): return {statement.end + 1}")
    test = _test(layout, statement, names)
    lines.append(f"again = {test or True}")
    lines += [f"v[{name!r}] = {local}" for name, local in names.items()]
    lines.append(f"m.passes[{key!r}] = " + ("1" if begins else f"m.passes.get({key!r}, 0) + 1"))
    if test:
        lines.append(f"if not again: return {statement.end + 1}")
    lines.append(f"return {statement.first + 1}")
    return "def step(m):\n    v = m.v\n" + "".join(f"    {line}\n" for line in lines)


def _count(layout: Layout, statement: Statement, lines: list[str], begins: bool) -> dict[str, str]:
    """The counter of $FOR in a local name; its step is a literal number that is not 0."""
    control = layout.entries[statement.first].block.control
    first, last, step = _values(layout, statement.first)
    if control is None or control.target is None or not _step(step):
        raise NotInline
    key = variable_key(control.target)
    old = f"v[{key!r}]"
    lines += [old, f"n = finite({source(first, {}) if begins else f'{old} + {_step(step)!r}'})"]
    lines.append(f"last = finite({source(last, {key: 'n'})})")
    return {key: "n"}


def _step(node: tree.Expression) -> float:
    """The value of a literal with its sign, 0 for anything else."""
    if isinstance(node, tree.Unary) and node.operator == "-":
        return -_step(node.operand)
    return node.value if isinstance(node, tree.Number) else 0.0


def _test(layout: Layout, statement: Statement, names: Mapping[str, str]) -> str:
    values: Any = _values(layout, statement.first)
    if statement.keyword == "FOR":
        return "n <= last" if _step(values[2]) > 0 else "n >= last"
    return condition(values[0], names) if statement.keyword == "WHILE" else ""
