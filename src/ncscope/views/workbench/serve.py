"""The server: a socket on this machine, the guard in front, page and questions behind it."""

from __future__ import annotations

import secrets
import socket
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ncscope.views.workbench.files import Folder
from ncscope.views.workbench.guard import LOOPBACK, Guard
from ncscope.views.workbench.routes import routes
from ncscope.views.workbench.running import warm_up
from ncscope.views.workbench.session import Sessions

GRACE = 1
"""Seconds that open connections get at the end."""


def serve(
    folder: str | Path,
    start: tuple[str, str],
    announce: Callable[[str], None],
    host: str = "127.0.0.1",
    port: int = 0,
    token: str = "",
) -> None:
    """Serves the workbench until it is interrupted.

    start: program and machine (keys) that are shown first. announce: gets the address to open
    once it answers. port: 0 for any free one. token: chosen by chance when empty.
    Raises OSError when the address cannot be used, ImportError without the extra `workbench`.
    """
    import uvicorn

    listener = _listen(host, port)
    port = listener.getsockname()[1]
    token = token or secrets.token_urlsafe(24)
    shown = f"[{host}]" if ":" in host else host
    names = LOOPBACK if host in ("127.0.0.1", "::1", "localhost") else (shown.lower(),)
    guard = Guard(_app(Sessions(Folder.at(folder)), start), port, token, names)
    config = uvicorn.Config(
        guard, log_level="warning", timeout_graceful_shutdown=GRACE, server_header=False
    )
    threading.Thread(target=warm_up, daemon=True).start()
    announce(f"http://{shown}:{port}/?token={token}")
    uvicorn.Server(config).run(sockets=[listener])


def _app(sessions: Sessions, start: tuple[str, str]) -> Any:
    """The page and the answers to its questions, as an ASGI application."""
    from fastapi import FastAPI
    from nicegui import ui

    from ncscope.views.workbench.page import define_page

    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.router.routes.extend(routes(sessions))
    define_page(sessions, start)
    ui.run_with(
        app,
        title="ncscope workbench",
        dark=None,
        binding_refresh_interval=None,
        cache_control_directives="no-cache",
        gzip_middleware_factory=None,
        show_welcome_message=False,
    )
    return app


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen(128)
    except OSError:
        listener.close()
        raise
    return listener
