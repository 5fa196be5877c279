"""Libraries that only some commands need, and how to get them."""

from __future__ import annotations

from ncscope.cli.screen import fail


def need_pictures() -> None:
    """Ends the process where a library of the extra `plot` is missing."""
    if missing := _missing("matplotlib", "plotly", "jinja2"):
        fail(f'pictures need {missing}: pip install "ncscope[plot]"')


def need_parquet() -> None:
    """Ends the process where a library of the extra `table` is missing."""
    if missing := _missing("pyarrow"):
        fail(f"Parquet needs {missing}: pip install 'ncscope[table]'")


def _missing(*names: str) -> str:
    from importlib.util import find_spec

    return " and ".join(name for name in names if find_spec(name) is None)
