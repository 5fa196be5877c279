"""What is known of an id."""

from __future__ import annotations

from typing import NamedTuple


class Entry(NamedTuple):
    """Severity (`error`, `warning`, `note`) and a sentence that explains the id."""

    severity: str
    title: str
