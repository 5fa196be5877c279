"""The own parts of the page: each is drawn by a script of the bundle, which asks `routes`.

Imported only by `page`: NiceGUI registers the scripts when the class is made.
"""

from __future__ import annotations

from typing import Any

from nicegui import ui


class Pane(ui.element, component="static/pane.js", esm={"ncscope-workbench": "static/dist"}):
    """One part of the page. kind: `code`, `scene`, `display`, `timeline`, `messages`, `jog`,
    `status`; the status pane also receives the state of the session."""

    def __init__(self, kind: str, session: str, state: dict[str, Any] | None = None) -> None:
        super().__init__()
        self._props["kind"] = kind
        self._props["session"] = session
        if state is not None:
            self._props["state"] = state

    def show(self, state: dict[str, Any]) -> None:
        """Sends another state to the page."""
        self._props["state"] = state
        self.update()
