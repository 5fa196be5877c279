"""NC text to program tree.

Enters a source. Leaves blocks and diagnostics, never an exception: a block that cannot be read has
`ok` False and says why. Knows no machine; axis names are not checked here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.language.controls import behind, broken, control
from ncscope.language.crowding import crowded
from ncscope.language.cursor import Cursor, Mistake
from ncscope.language.hashes import declaration, hash_command, unknown_command
from ncscope.language.lexer import BLANKS, LONGEST_LINE, Line, read_line
from ncscope.language.terms import value
from ncscope.language.tree import (
    Block,
    Control,
    Declaration,
    Expression,
    HashCommand,
    Number,
    Word,
)
from ncscope.language.words import simple_words, word

Diagnostics = tuple[Diagnostic, ...]

_SKIP = re.compile(r"/[ \t\0\r]*(10|[1-9])?(?![0-9])")
_LABEL = re.compile(r"\[[ \t\0\r]*([^\s\0\[\]]+)[ \t\0\r]*\]")
_LOCAL = re.compile(r"[Ll][ \t\0\r]+(.*)", re.DOTALL)
_COMMENT_END = re.compile(
    r"[ \t\0\r]*(?:N[ \t]*[0-9]+)?(?:[ \t\0\r]|\([^()\n]*\))*#[ \t\0\r]*COMMENT[ \t\0\r]+END\b",
    re.IGNORECASE,
)
_BYTE_ORDER_MARKS = ("\ufeff", "\xef\xbb\xbf", "\xff\xfe", "\xfe\xff")
"""As a character, and as UTF-8 and UTF-16 look when they are read as Latin-1."""


@dataclass(frozen=True)
class Program:
    """All blocks of a source. `subprograms` has the block indices of every local subprogram."""

    source: Source
    blocks: tuple[Block, ...]
    diagnostics: Diagnostics
    subprograms: Mapping[str, range]


@dataclass(slots=True)
class _Draft:
    """What has been read of a block."""

    number: Expression | None = None
    labels: tuple[str, ...] = ()
    skip: int | None = None
    words: list[Word] = field(default_factory=list)
    commands: list[HashCommand] = field(default_factory=list)
    control: Control | None = None
    declarations: list[Declaration] = field(default_factory=list)
    header: str | None = None


def parse_program(source: Source) -> Program:
    """The whole program. Local subprograms run from behind their header to the next header."""
    blocks: list[Block] = []
    found: list[Diagnostic] = []
    for block, diagnostics in iterate_blocks(source):
        blocks.append(block)
        found.extend(diagnostics)
    return Program(source, tuple(blocks), tuple(found), _subprograms(blocks))


def iterate_blocks(source: Source) -> Iterator[tuple[Block, Diagnostics]]:
    """The blocks of a source one by one, each with its diagnostics."""
    return iter(BlockReader(source))


class BlockReader:
    """Reads the blocks of a source one by one, each with its diagnostics.

    Block comments, the order of headers and #VAR areas are followed from block to block.
    `at` is the offset of the next line; a reader of plain blocks may move it with `skip_to`.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self.at = 0
        self.in_area = False
        self._in_main = False
        self._in_sub = False

    def skip_to(self, offset: int) -> None:
        """The lines up to `offset`, where a line begins, have been read by somebody else."""
        self.at = offset
        self._in_main = self._in_main or not self._in_sub

    def __iter__(self) -> Iterator[tuple[Block, Diagnostics]]:
        source, declaring = self.source, False
        pending: Diagnostics = ()
        if self.at == 0:  # else the beginning was read by somebody else
            mark = next((m for m in _BYTE_ORDER_MARKS if source.part(0, 3).startswith(m)), "")
            if mark:
                pending, self.at = (_byte_order_mark(source),), len(mark)
            elif _has_no_line_end(source):
                pending = (_no_line_end(source),)
        while self.at < len(source):
            block, found, self.at = parse_block(source, self.at, declarations=declaring)
            if block is None:
                continue
            if pending:
                found, pending = (*pending, *found), ()
            block, found = _with(block, found)
            block, found = self._follow_header(block, found)
            name = block.commands[0].name if block.commands else ""
            if name == "ENDVAR" and not declaring:
                message = "#ENDVAR has no #VAR before it."
                block, found = _with(block, (*found, diagnostic("N1007", block.span, message)))
            declaring = name == "VAR" or (declaring and name != "ENDVAR")
            self.in_area = declaring or name == "COMMENT BEGIN"
            if name == "COMMENT BEGIN":
                yield from self._comment(block, found)
                continue
            if name == "COMMENT END":
                message = "#COMMENT END stands without #COMMENT BEGIN."
                block, found = _with(block, (*found, diagnostic("20567", block.span, message)))
            yield block, found
        if pending:
            yield _empty(source), pending

    def _follow_header(self, block: Block, found: Diagnostics) -> tuple[Block, Diagnostics]:
        if block.header is not None:
            self._in_sub = _is_local(block.header)
            block, found = _checked_header(block, found, self._in_main)
        self._in_main = self._in_main or not (self._in_sub or is_comment(block))
        return block, found

    def _comment(self, block: Block, found: Diagnostics) -> Iterator[tuple[Block, Diagnostics]]:
        """#COMMENT BEGIN and the #COMMENT END behind the lines that it takes away."""
        self.at, more = _behind_comment(self.source, self.at, block.span)
        yield _with(block, (*found, *more))
        if self.at < len(self.source):
            ending, found, self.at = parse_block(self.source, self.at)
            self.in_area = False
            if ending is not None:
                yield ending, found


def parse_block(
    source: Source, start: int, *, declarations: bool = False
) -> tuple[Block | None, Diagnostics, int]:
    """The block of the logical line at `start`, its diagnostics, and where the next line begins.

    None for a line with nothing but blanks and comments. `declarations`: the line stands between
    #VAR and #ENDVAR.
    """
    line = read_line(source, start)
    cursor = Cursor(source, line.code, line.start)
    if not cursor.skip():
        return None, (), line.stop
    span = cursor.span(cursor.at, len(line.code.rstrip(BLANKS)))
    draft, found = _Draft(), _too_long(line, span)
    if not found:
        found = _read(cursor, draft, declarations) + _crowded(draft)
    return _block(draft, span, not found or not any(d.is_error for d in found)), found, line.stop


def _read(cursor: Cursor, draft: _Draft, declarations: bool) -> Diagnostics:
    """line = header | [ skip ] , [ blockno ] , [ label ] , content ;"""
    try:
        if cursor.char == "%":
            draft.header = _header(cursor)
            return ()
        _block_start(cursor, draft)
        while cursor.skip():
            if not declarations and draft.control is None:
                simple_words(cursor, draft.words)
                if cursor.at_end:
                    break
            _content(cursor, draft, declarations)
    except Mistake as mistake:
        return (mistake.item,)
    return ()


def _header(cursor: Cursor) -> str:
    """header = "%" , [ "L" , sep ] , name ;"""
    name = " ".join(cursor.code[cursor.at + 1 :].strip(BLANKS + "\n").split("\n"))
    local = _LOCAL.fullmatch(name)
    return f"L {local.group(1).strip(BLANKS)}" if local else name


def _block_start(cursor: Cursor, draft: _Draft) -> None:
    """start = [ "/" , [ level ] ] , [ "N" , expr , [ ":" ] ] , [ "[" , name , "]" ] ;"""
    skip = cursor.match(_SKIP)
    if skip is not None:
        draft.skip = int(skip.group(1) or 1)
        cursor.skip()
    if cursor.char in ("N", "n"):
        _block_number(cursor, draft)
        cursor.skip()
    label = cursor.match(_LABEL)
    if label is not None:
        draft.labels += (f"[{label.group(1).upper()}]",)


def _block_number(cursor: Cursor, draft: _Draft) -> None:
    """blockno = "N" , expr , [ ":" ] ;  with the colon, the number is a label too"""
    start = cursor.at
    if draft.number is not None:
        raise cursor.mistake("20105", "The block has two block numbers.")
    cursor.at += 1
    draft.number = value(cursor)
    if not cursor.take(":"):
        return
    number = draft.number
    written = cursor.code[start : cursor.at - 1].upper()
    draft.labels += (f"N{round(number.value)}" if isinstance(number, Number) else written,)


def _content(cursor: Cursor, draft: _Draft, declarations: bool) -> None:
    """content = control | hashcmd | declaration | word ;"""
    if draft.control is not None and draft.control.keyword != "GOTO":
        raise behind(cursor, draft.control)
    match cursor.char:
        case "#":
            _hash(cursor, draft)
        case "$":
            _control(cursor, draft)
        case "N" | "n":
            start, labels = cursor.at, draft.labels
            _block_number(cursor, draft)
            if draft.labels != labels:
                raise _late_label(cursor, start)
        case "%":
            raise cursor.mistake("20193", "A program header must begin its line.")
        case "[" if found := cursor.match(_LABEL):
            raise _late_label(cursor, found.start())
        case _ if declarations:
            draft.declarations.append(declaration(cursor))
            cursor.take(",")
        case _:
            draft.words.append(word(cursor))


def _late_label(cursor: Cursor, start: int) -> Mistake:
    message = "A label must stand first in its block."
    return cursor.mistake("21187", message, span=cursor.span(start))


def _hash(cursor: Cursor, draft: _Draft) -> None:
    start = cursor.at
    try:
        draft.commands.append(hash_command(cursor))
    except Mistake as mistake:
        if mistake.item.id == "20509":
            draft.commands.append(unknown_command(cursor, start))
        raise


def _control(cursor: Cursor, draft: _Draft) -> None:
    if draft.control is not None:
        raise behind(cursor, draft.control)
    start = cursor.at
    try:
        draft.control, assigned = control(cursor)
    except Mistake:
        draft.control = broken(cursor, start)
        raise
    if assigned is not None:
        draft.words.append(assigned)


def _crowded(draft: _Draft) -> Diagnostics:
    if not draft.commands and draft.control is None:
        return ()
    return crowded([*draft.words, *draft.declarations], draft.commands, draft.control)


def _block(draft: _Draft, span: Span, ok: bool) -> Block:
    return Block(
        draft.number,
        draft.labels,
        draft.skip,
        tuple(draft.words),
        tuple(draft.commands),
        draft.control,
        tuple(draft.declarations),
        draft.header,
        ok,
        span,
    )


def _empty(source: Source) -> Block:
    return _block(_Draft(), Span(source, 0, 0), False)


def _with(block: Block, found: Diagnostics) -> tuple[Block, Diagnostics]:
    """The block, which is not ok if an error was found."""
    if not found and block.ok:
        return block, found
    ok = not any(d.is_error for d in found)
    return (block if ok == block.ok else block._replace(ok=ok)), found


def _too_long(line: Line, span: Span) -> Diagnostics:
    if not line.too_long:
        return ()
    return (diagnostic("N1004", span, f"The block is longer than {LONGEST_LINE} characters."),)


def _byte_order_mark(source: Source) -> Diagnostic:
    hint = "save the file as plain ASCII, without a byte order mark"
    span = Span(source, 0, 1)
    return diagnostic("21798", span, "The file begins with a byte order mark.", hint)


def _has_no_line_end(source: Source) -> bool:
    """Whether lines end with CR alone; a last line may lack its end."""
    if source.end_of_line(0) < len(source):
        return False
    return "\r" in source.part(0, len(source)).strip(BLANKS)


def _no_line_end(source: Source) -> Diagnostic:
    hint = "save the file with line ends CR LF or LF; in this one they are CR alone"
    return diagnostic("20301", Span(source, 0, 1), "The file has no end of line.", hint)


def is_comment(block: Block) -> bool:
    """#COMMENT BEGIN and #COMMENT END, which may stand outside of programs."""
    return any(command.name.startswith("COMMENT ") for command in block.commands)


def _is_local(header: str) -> bool:
    return header.startswith("L ")


def _checked_header(block: Block, found: Diagnostics, in_main: bool) -> tuple[Block, Diagnostics]:
    """A second main program is an error; local subprograms may stand before and behind it."""
    assert block.header is not None
    if _is_local(block.header) or not in_main:
        return block, found
    message = "A program header stands inside the main program."
    hint = "local subprograms are written %L name"
    return _with(block, (*found, diagnostic("20193", block.span, message, hint)))


def _behind_comment(source: Source, at: int, begin: Span) -> tuple[int, Diagnostics]:
    """The offset of the line with #COMMENT END, or the end of the file and what is wrong."""
    while at < len(source):
        end = source.end_of_line(at)
        if _COMMENT_END.match(source.part(at, end)):
            return at, ()
        at = min(end + 1, len(source))
    message = "The file ends inside a block comment."
    return at, (diagnostic("20568", begin, message, "write #COMMENT END on a line of its own"),)


def _subprograms(blocks: list[Block]) -> dict[str, range]:
    """Of two subprograms with one name the first counts."""
    result: dict[str, range] = {}
    headers = [i for i, block in enumerate(blocks) if block.header is not None]
    for at, stop in zip(headers, [*headers[1:], len(blocks)], strict=False):
        header = blocks[at].header or ""
        if _is_local(header):
            result.setdefault(header[2:], range(at + 1, stop))
    return result
