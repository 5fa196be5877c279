"""`ncscope workbench`: program, machine and every number on a page in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ncscope.cli.screen import fail

LOOPBACK = ("127.0.0.1", "::1", "localhost")
EVERY_ADDRESS = ("0.0.0.0", "::", "")


def workbench_command(
    folder: Annotated[Path, typer.Argument(help="Folder with programs and machines.")] = Path("."),
    program: Annotated[
        str, typer.Option("--program", help="Program that is shown first, below the folder.")
    ] = "",
    machine: Annotated[
        str, typer.Option("--machine", "-m", help="Its machine, a folder below the folder.")
    ] = "",
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="0: any free port.")] = 0,
    host: Annotated[
        str, typer.Option("--host", help="Listen on another address; needs --token.")
    ] = "127.0.0.1",
    token: Annotated[
        str, typer.Option("--token", help="Token of the address; by chance when left out.")
    ] = "",
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
) -> None:
    """Open a folder of programs and machines in the browser workbench."""
    if not folder.is_dir():
        fail(f"{folder} is not a folder")
    if host in EVERY_ADDRESS:
        fail(f"--host {host}: name the one address that other computers know")
    if host not in LOOPBACK and len(token) < 16:
        fail("--host opens the folder to other computers: give --token with 16 characters or more")
    try:
        from ncscope.views.workbench.serve import serve

        serve(folder, (program, machine), lambda url: _announce(url, browser), host, port, token)
    except ImportError as missing:
        fail(f"the workbench needs {missing.name}: pip install 'ncscope[workbench]'")
    except OSError as error:
        fail(f"cannot listen on {host}:{port}: {error.strerror}")


def _announce(url: str, browser: bool) -> None:
    typer.echo(f"ncscope workbench: open {url}")
    typer.echo("Ctrl-C ends it.")
    if browser:
        import webbrowser

        webbrowser.open(url)
