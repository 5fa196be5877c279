"""`ncscope convert`: a channel list in another spelling of its kinematics."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ncscope.cli.files import exists, reading, writing
from ncscope.cli.screen import fail, show_diagnostics

if TYPE_CHECKING:
    from ncscope.lists.document import ListDocument


class Syntax(StrEnum):
    """Versions whose lists spell kinematics differently."""

    OLD = "v2"
    NEW = "v3"


def convert_command(
    path: Annotated[Path, typer.Argument(metavar="LIST", help="Channel list.")],
    to: Annotated[
        Syntax | None,
        typer.Option("--to", help="v2: kinematik[91].x, up to V2.11; v3: trafo[0].x, from V3.00."),
    ] = None,
    fields: Annotated[bool, typer.Option("--fields", help="param[i] to named fields.")] = False,
    param: Annotated[bool, typer.Option("--param", help="Named fields to param[i].")] = False,
    kin: Annotated[
        int | None, typer.Option("--kin", help="Library kinematics, such as 9, to an ID 91 list.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", help="File instead of the screen.")] = None,
) -> None:
    """Write a list in another spelling; comments, order and all other characters stay."""
    from ncscope.lists.files import read_document

    _check(path, to, fields, param, kin)
    with reading(path):
        document = read_document(path)
    _check_text(document)
    if kin is not None:
        data = _library(document, kin, to is Syntax.OLD)
    else:
        data = _spelling(document, to, fields, param)
    _write(out, data)


def _check(path: Path, to: Syntax | None, fields: bool, param: bool, kin: int | None) -> None:
    """Ends the process for options that do not go together, and for a path without a list."""
    if fields and param:
        fail("--fields and --param are opposites")
    if kin is not None and (fields or param):
        fail("--kin writes named fields; use --param on its result")
    if kin is None and not (to or fields or param):
        fail("what to? give --to v3, --to v2, --fields, --param or --kin ID")
    if exists(path) and path.is_dir():
        fail(f"{path} is a folder; give one of its lists, such as {path / 'sda.lis'}")
    if not path.is_file():
        fail(f"there is no list {path}")


def _check_text(document: ListDocument) -> None:
    """Ends the process for a file that is no text."""
    if any(d.id == "N3006" for d in document.diagnostics):
        show_diagnostics(document.diagnostics)
        raise typer.Exit(1)


def _write(out: Path | None, data: bytes) -> None:
    if out is None:
        typer.echo(data, nl=False)
        return
    with writing(out):
        out.write_bytes(data)


def _library(document: ListDocument, id: int, old_syntax: bool) -> bytes:
    from ncscope.lists.document import ENCODING
    from ncscope.lists.universal_text import from_library

    text, found = from_library(document, id, old_syntax)
    show_diagnostics(found)
    if text is None:
        raise typer.Exit(1)
    return text.encode(ENCODING)


def _spelling(document: ListDocument, to: Syntax | None, fields: bool, param: bool) -> bytes:
    from ncscope.lists import conversion

    before = document
    if to is not None:
        turn = conversion.to_new_syntax if to is Syntax.NEW else conversion.to_old_syntax
        document, found = turn(document)
        show_diagnostics(found)
    if fields:
        document = conversion.to_names(document)
    if param:
        document = conversion.to_parameters(document)
    if document.text == before.text:
        typer.echo(f"{document.name}: there was nothing to convert", err=True)
    return document.to_bytes()
