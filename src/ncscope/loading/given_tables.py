"""Tables of what the machine would answer: probe positions and jog increments."""

from __future__ import annotations

from pathlib import Path

from ncscope.channel.given import GivenRows, read_rows
from ncscope.diagnostics import Diagnostic, Source, Span, diagnostic
from ncscope.loading.content import content


def load_rows(path: str | Path) -> tuple[GivenRows, tuple[Diagnostic, ...]]:
    """Probe answers or jog increments from a table of text, and what is wrong with it.

    Raises OSError when the file cannot be read.
    """
    path = Path(path)
    text = content(path).decode("utf-8-sig", "replace")
    source = Source(path.name, text)
    if "\0" in text:
        what = "the file is no text: it holds zero bytes"
        return GivenRows(path.name, ()), (diagnostic("N4010", Span(source, 0, 0), what),)
    return read_rows(source)
