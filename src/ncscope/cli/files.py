"""Files that the user names: what cannot be read or written is said in one line."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

import typer

from ncscope.cli.screen import fail


@contextmanager
def reading(path: Path | None) -> Iterator[None]:
    """Ends the process when the file cannot be read inside."""
    try:
        yield
    except OSError as error:
        fail(f"cannot read {path}: {_reason(error)}")


@contextmanager
def writing(path: Path | None) -> Iterator[None]:
    """Ends the process when the file, None for the output, cannot be written inside."""
    try:
        yield
    except BrokenPipeError:  # the reader has seen enough
        raise
    except OSError as error:
        fail(f"cannot write {path or 'the output'}: {_reason(error)}")


@contextmanager
def text_output(path: Path | None) -> Iterator[TextIO]:
    """The file, or standard output for None; ends the process when it cannot be written."""
    with writing(path):
        if path is None:
            yield sys.stdout
            return
        with path.open("w", encoding="utf-8", newline="") as stream:
            yield stream


def _reason(error: OSError) -> str:
    """The reason alone; pyarrow writes it behind a sentence of its own."""
    text = error.strerror or str(error)
    behind = re.search(r"\[errno \d+\] (.+)", text)
    return behind[1] if behind else text


def exists(path: Path) -> bool:
    """Whether something has this name; ends the process where nobody may know."""
    with reading(path):
        found = path.exists()
    return found


def same_file(one: Path, other: Path) -> bool:
    """Whether both paths lead to one file that exists."""
    return one.exists() and other.exists() and one.samefile(other)


def check_target(out: Path, program: Path, *others: Path | None) -> None:
    """Ends the process when the output would overwrite the program or another file of the run."""
    with writing(out):
        if same_file(out, program):
            fail(f"--out {out} is the program itself")
        for other in others:
            if other is not None and other.is_file() and same_file(out, other):
                fail(f"--out {out} is a file that is read")


def write_document(out: Path, data: bytes) -> None:
    """Writes the file and names it; ends the process when it cannot be written."""
    with writing(out):
        out.write_bytes(data)
    typer.echo(f"wrote {out}")
