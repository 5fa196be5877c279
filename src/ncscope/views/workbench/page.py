"""The page: its layout, the choice of program and machine, and the way of the state to it."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from pathlib import PurePosixPath

from nicegui import Client, ui

from ncscope.views.workbench.elements import Pane
from ncscope.views.workbench.files import Listing, Refused
from ncscope.views.workbench.session import Session, Sessions

KEYS = (
    ("Right, Left", "next and previous block"),
    ("Home, End", "first and last block"),
    ("Space", "play and pause"),
    ("PageDown, PageUp", "next and previous run of the line"),
    ("1 2 3 0", "top, front, right, isometric view"),
    ("F, A", "fit the path, or path and machine, into the view"),
    ("O", "orthographic or perspective"),
    ("Ctrl+S", "save the file of the editor"),
    ("Ctrl+F", "search in the editor"),
)
"""Keys of the page; single keys count outside of the editor and of fields."""
NO_MACHINE = "axes X Y Z"
LEVELS = [str(level) for level in range(1, 11)]
Choices = tuple[ui.select, ui.select]
"""Where program and machine are chosen."""


def define_page(sessions: Sessions, start: tuple[str, str]) -> None:
    """Registers the page. start: program and machine that are shown first, empty for none."""

    @ui.page("/", title="ncscope workbench", response_timeout=10)
    def workbench(client: Client, program: str = "", machine: str | None = None) -> None:
        try:
            session = sessions.create()
            listing = sessions.folder.listing()
        except Refused as refused:
            ui.label(str(refused))
            return
        client.on_delete(lambda: sessions.close(session))
        _layout(session, listing)
        first = program or start[0]
        if first in listing.programs:
            if machine is None:
                machine = start[1] or guess_machine(first, listing)
            session.open(first, machine if machine in listing.machines else "")


def guess_machine(program: str, listing: Listing) -> str:
    """The machine that a program lies in or beside, or the only one there is; else none."""
    parents = [str(parent) for parent in PurePosixPath(program).parents]
    near = [parent for parent in parents if parent in listing.machines]
    if near:
        return near[0]
    return listing.machines[0] if len(listing.machines) == 1 else ""


def _layout(session: Session, listing: Listing) -> None:
    ui.query(".nicegui-content").classes("p-0 gap-0")
    with ui.column().classes("nc-page w-full gap-0 no-wrap"):
        status, choices = _header(session, listing)
        with (
            ui.splitter(horizontal=True, value=72, limits=(30, 92)).classes(
                "nc-grow w-full"
            ) as rows,
            rows.before,
        ):
            _upper(session)
        with rows.after:
            _lower(session)
    _tell_page(session, status, choices)


def _header(session: Session, listing: Listing) -> tuple[Pane, Choices]:
    theme = ui.dark_mode(value=None)
    with ui.row().classes("nc-header w-full items-center no-wrap gap-2"):
        ui.label("ncscope").classes("nc-brand")
        program = ui.select(
            list(listing.programs), label="program", with_input=True,
            on_change=lambda event: _choose(session, event.value, session.state.machine),
        ).props("dense options-dense outlined hide-bottom-space").classes("nc-choice")  # fmt: skip
        machines = {"": NO_MACHINE, **{key: key for key in listing.machines}}
        machine = ui.select(
            machines, label="machine", value="",
            on_change=lambda event: _choose(session, session.state.program, event.value),
        ).props("dense options-dense outlined hide-bottom-space").classes("nc-choice")  # fmt: skip
        status = Pane("status", session.key, session.state.as_dict())
        status.classes("nc-status")
        _icon("tune", "options of the run", _options_dialog(session).open)
        _icon("contrast", "dark or light", lambda: theme.set_value(not theme.value))
        _icon("keyboard", "keys", _keys_dialog().open)
    return status, (program, machine)


def _choose(session: Session, program: str | None, machine: str) -> None:
    """Opens what the user chose; what the page shows already was not chosen by the user."""
    if (program, machine) != (session.state.program, session.state.machine):
        session.open(program or "", machine)


def _icon(name: str, hint: str, action) -> None:
    ui.button(icon=name, on_click=action).props(f'flat dense round aria-label="{hint}"').tooltip(
        hint
    )


def _options_dialog(session: Session) -> ui.dialog:
    with ui.dialog() as dialog, ui.card():
        ui.label("Options of the run").classes("text-h6")
        clamp = ui.number("clamp position", format="%d").props("clearable dense outlined")
        skip = ui.input("skip levels that are on, such as 1,3").props("dense outlined")
        problem = ui.label().classes("nc-bad")

        def run() -> None:
            levels = [part.strip() for part in str(skip.value or "").split(",") if part.strip()]
            if not all(level in LEVELS for level in levels):
                problem.set_text("skip levels are 1 to 10 with commas between them")
                return
            problem.set_text("")
            position = None if clamp.value in (None, "") else int(clamp.value)
            options = replace(session.options, clamp=position, skip=frozenset(map(int, levels)))
            session.open(session.state.program, session.state.machine, options)
            dialog.close()

        ui.button("run", on_click=run).props("no-caps")
    return dialog


def _keys_dialog() -> ui.dialog:
    with ui.dialog() as dialog, ui.card():
        ui.label("Keys").classes("text-h6")
        with ui.grid(columns="auto auto").classes("gap-x-6 gap-y-1"):
            for key, meaning in KEYS:
                ui.label(key).classes("nc-mono")
                ui.label(meaning)
    return dialog


def _upper(session: Session) -> None:
    with ui.splitter(value=26, limits=(12, 60)).classes("nc-fill") as left:
        with left.before:
            Pane("code", session.key).classes("nc-fill")
        with left.after, ui.splitter(value=60, limits=(20, 90)).classes("nc-fill") as right:
            with right.before:
                Pane("scene", session.key).classes("nc-fill")
            with right.after:
                _tabs(session, (("display", "Display"), ("jog", "Jog")))


def _lower(session: Session) -> None:
    _tabs(session, (("timeline", "Timeline"), ("messages", "Messages")))


def _tabs(session: Session, kinds: tuple[tuple[str, str], ...]) -> None:
    with ui.column().classes("nc-fill gap-0 no-wrap"):
        with ui.tabs().props("dense no-caps align=left inline-label").classes("nc-tabs") as tabs:
            made = {kind: ui.tab(kind, label=label) for kind, label in kinds}
        with ui.tab_panels(tabs, value=made[kinds[0][0]], animated=False, keep_alive=True).classes(
            "nc-grow w-full"
        ):
            for kind, tab in made.items():
                with ui.tab_panel(tab).classes("p-0"):
                    Pane(kind, session.key).classes("nc-fill")


def _tell_page(session: Session, status: Pane, choices: Choices) -> None:
    """Every new state goes to the status pane, from whatever thread it comes."""
    loop = asyncio.get_running_loop()

    def show() -> None:
        state = session.state
        status.show(state.as_dict())
        for choice, value in zip(choices, (state.program, state.machine), strict=True):
            if choice.value != value:
                choice.set_value(value)

    def changed() -> None:
        loop.call_soon_threadsafe(show)

    session.changed = changed
