"""Macros: a text under a name, which stands for itself wherever the name is written.

Source: TF5200 programming manual, macros. A macro is valid until #INIT MACRO TAB.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from ncscope.channel.draft import BlockError, Draft
from ncscope.diagnostics import Diagnostic, Source, diagnostic
from ncscope.language import tree
from ncscope.language.parser import parse_block

DEEPEST = 20


def define(draft: Draft, word: tree.MacroDefinition) -> None:
    """`"NAME" = "text"`; a later definition replaces the text."""
    if not word.name:
        draft.fail("20619", word.span, "a macro needs a name")
    macros = {**draft.state.macros, word.name: word.text}
    draft.state = replace(draft.state, macros=macros)


def words(draft: Draft, word: tree.Macro, depth: int) -> tuple[tree.Word, ...]:
    """The words that a macro stands for."""
    text = draft.state.macros.get(word.name)
    if text is None:
        hint = f'define it first: "{word.name}" = "text"'
        draft.fail("20619", word.span, f"the macro {word.name!r} is not defined", hint)
    if depth >= DEEPEST:
        draft.fail("20386", word.span, f"the macro {word.name!r} calls itself")
    found, error = _parsed(text, f"text of the macro {word.name}")
    if error is not None:
        note = ("used here", word.span)
        raise BlockError(replace(error, notes=(*error.notes, note)))
    return found


@lru_cache(maxsize=1000)
def _parsed(text: str, name: str) -> tuple[tuple[tree.Word, ...], Diagnostic | None]:
    source = Source(name, text.replace("\n", " "))
    block, found, _ = parse_block(source, 0)
    error = next((d for d in found if d.is_error), None)
    if error is not None or block is None:
        return (), error
    if block.control or block.commands or block.number or block.label or block.header:
        message = "a macro holds words; $ and # commands and block numbers cannot stand in it"
        return (), diagnostic("20644", block.span, message)
    return block.words, None
