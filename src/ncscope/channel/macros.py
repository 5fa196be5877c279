"""Macros: a text under a name, which stands for itself wherever the name is written.

A macro is valid until #INIT MACRO TAB. What is wrong inside of a text is reported where the macro
is used. Source: TF5200 programming manual, macros; P-CHAN-00511.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache

from ncscope.channel.draft import BlockError, Draft
from ncscope.channel.layered import with_value
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.language import tree
from ncscope.language.failures import used_at
from ncscope.language.macro_texts import DEEPEST_MACRO, MOST_USES
from ncscope.language.parser import parse_block

TEXT = "text of the macro "
"""How the source of a macro's text is named, before the name of the macro."""


def define(draft: Draft, word: tree.MacroDefinition) -> None:
    """`"NAME" = "text"`; a later definition replaces the text."""
    if not word.name:
        draft.fail("20619", word.span, "a macro needs a name")
    _check_length(draft, word.name, word.span)
    macros = with_value(draft.state.macros, word.name, word.text)
    draft.state = draft.state.changed(macros=macros)


def _check_length(draft: Draft, name: str, span: Span) -> None:
    longest = draft.machine.settings.macro_name_length
    if len(name) > longest:
        what = f"the name of the macro has {len(name)} characters; {longest} are allowed"
        draft.fail("20614", span, what)


def words(draft: Draft, word: tree.Macro, depth: int, uses: int) -> tuple[tree.Word, ...]:
    """The words that a macro stands for; they stand where the macro is used.

    depth: macros around this one. uses: macros of the block up to here.
    """
    text = draft.state.macros.get(word.name)
    if text is None:
        _check_length(draft, word.name, word.span)
        hint = f'define it first: "{word.name}" = "text"'
        draft.fail("20619", word.span, f"the macro {word.name!r} is not defined", hint)
    if depth >= DEEPEST_MACRO:
        hint = "a macro cannot stand in its own text, nor in the text of a macro that it uses"
        draft.fail("20734", word.span, f"the macro {word.name!r} contains itself", hint)
    if uses > MOST_USES:
        what = f"the block uses more than {MOST_USES} macros, those inside of macros included"
        draft.fail("20734", word.span, what)
    found, error = _parsed(text, TEXT + word.name)
    if error is not None:
        raise BlockError(error)
    return tuple(item._replace(span=word.span) for item in found)


@contextmanager
def used(draft: Draft, word: tree.Macro) -> Iterator[None]:
    """An error in the text of the macro becomes one at the place where the macro stands.

    The innermost text is shown with it.
    """
    try:
        yield
    except BlockError as error:
        item = used_at(error.diagnostic, word.span)
        text = draft.state.macros.get(word.name)
        if text and not any(span.source.name.startswith(TEXT) for _, span in item.notes):
            stands = Span(Source(TEXT + word.name, text), 0, len(text))
            item = replace(item, notes=(*item.notes, ("the macro stands for this", stands)))
        raise BlockError(item) from error


@lru_cache(maxsize=1000)
def _parsed(text: str, name: str) -> tuple[tuple[tree.Word, ...], Diagnostic | None]:
    source = Source(name, text.replace("\n", " "))
    block, found, _ = parse_block(source, 0)
    error = next((d for d in found if d.is_error), None)
    if error is not None or block is None:
        return (), error
    if block.control or block.commands or block.number or block.labels or block.header:
        message = "a macro holds words; $ and # commands and block numbers cannot stand in it"
        return (), diagnostic("20644", block.span, message)
    return block.words, None
