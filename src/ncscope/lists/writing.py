"""Documents to files, byte for byte."""

from __future__ import annotations

from pathlib import Path

from ncscope.lists.document import ListDocument


def write_document(document: ListDocument, path: str | Path) -> None:
    """Write a list; an unchanged document gives the bytes that it was read from.

    Raises OSError when the file cannot be written.
    """
    Path(path).write_bytes(document.to_bytes())
