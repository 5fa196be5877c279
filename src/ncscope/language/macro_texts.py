"""Limits of macros, and the text of a macro with the macros that it uses."""

from __future__ import annotations

import re
from collections.abc import Callable

from ncscope.diagnostics import Span
from ncscope.language.failures import failure

DEEPEST_MACRO = 20
MOST_USES = 10_000
"""Macros of one block, those inside of macros included: short texts can call for millions."""
LONGEST_TEXT = 4000
"""Characters of a text, as many as a block has: a loop must not fill the memory."""

_NESTED = re.compile(r'"([^"]*)"')


def content(name: str, text_of: Callable[[str], str | None], span: Span) -> str:
    """The text of a macro with the texts of the macros that it uses."""
    uses = 0

    def resolved(name: str, depth: int) -> str:
        nonlocal uses
        uses += 1
        text = text_of(name)
        if text is None:
            raise failure("22276", span, f"The macro {name!r} is not defined.")
        if depth > DEEPEST_MACRO or uses > MOST_USES:
            raise failure("22276", span, f"The macro {name!r} contains itself, or too many others.")
        text = _NESTED.sub(lambda use: resolved(use.group(1), depth + 1), text)
        if len(text) > LONGEST_TEXT:
            message = f"The text of the macro is longer than {LONGEST_TEXT} characters."
            raise failure("22276", span, message)
        return text

    return resolved(name, 1)
