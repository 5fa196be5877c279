"""The parameter page of the docs, generated from the table."""

from __future__ import annotations

from ncscope.lists import table
from ncscope.lists.table import ParameterRow

_HEAD = "| id | key | type | default | unit | meaning |\n|---|---|---|---|---|---|"


def parameters_page() -> str:
    """Markdown: the entries with an effect, list by list, then the keys that are only known."""
    parts = ["# List parameters", _introduction()]
    for kind in table.LIST_KINDS:
        rows = [row for row in table.rows() if row.list_kind == kind]
        shown = [row for row in rows if row.status != "-"]
        parts.append(f"## {table.LIST_NAMES[kind].capitalize()}")
        parts.append("\n".join([_HEAD, *(_line(row) for row in shown)]))
        silent = [f"`{row.key}` ({row.id})" for row in rows if row.status == "-"]
        if silent:
            parts.append(f"Known, without effect ({len(silent)}): " + ", ".join(silent) + ".")
    return "\n\n".join(parts) + "\n"


def _introduction() -> str:
    count = len(table.rows())
    return (
        f"ncscope knows {count} entries of the lists.\n"
        "Those with a meaning below change what a run gives or are checked.\n"
        "Lengths are 0.1 um and angles 0.0001 degrees unless a unit says otherwise."
    )


def _line(row: ParameterRow) -> str:
    cells = (row.id, f"`{row.key}`", row.type, row.default, row.unit, row.meaning)
    return "| " + " | ".join(cell.replace("|", "\\|") or " " for cell in cells) + " |"
