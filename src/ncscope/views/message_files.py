"""Messages of a program as files, only below the folder that the user gave."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from ncscope.channel.draft import Message
from ncscope.diagnostics import Diagnostic, diagnostic


def write_messages(
    folder: Path, messages: Iterable[Message], protected: Iterable[Path] = ()
) -> tuple[Diagnostic, ...]:
    """Appends each message to its file, as the control does; the folder is made when needed.

    Of the name that the program gave only the last part counts. A file that is a link, or that is
    one of `protected` (the program itself), is not written.
    """
    texts: dict[str, list[str]] = {}
    for message in messages:
        if message.file is not None:
            texts.setdefault(safe_name(message.file), []).append(message.text + message.end)
    guarded = [p for p in protected if p.exists()]
    faults = (_append(folder / name, "".join(parts), guarded) for name, parts in texts.items())
    return tuple(diagnostic("N4003", None, fault) for fault in faults if fault)


def _append(target: Path, text: str, guarded: list[Path]) -> str:
    """Writes behind what the file holds; why that cannot be, else an empty text."""
    if target.is_symlink() or target.is_dir() or _is_one_of(target, guarded):
        return f"{target.name} is not written: it is a link, a folder or a file of this run"
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("a", encoding="latin-1", errors="replace", newline="") as out:
            out.write(text)
    except OSError as error:
        return f"{target.name} cannot be written: {error.strerror}"
    return ""


def _is_one_of(target: Path, files: list[Path]) -> bool:
    """Whether the path is one of the files, also under another name (a hard link)."""
    return target.exists() and any(target.samefile(file) for file in files)


def safe_name(name: str) -> str:
    """The last part of a path in either notation, without control characters."""
    last = PurePosixPath(name.replace("\\", "/")).name
    plain = "".join(c for c in last if c.isprintable() and c not in '<>:"|?*')
    return plain[:120] if plain.strip(". ") else "message.txt"
