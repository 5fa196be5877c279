"""Which files make up a machine: a folder, a start-up list, or one list.

Only regular files below the machine folder are read; a name or link that leaves it is refused.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from ncscope.diagnostics import Diagnostic, Span, diagnostic
from ncscope.lists import table
from ncscope.lists.document import ListDocument
from ncscope.lists.values import Reading, read_values

MAX_BYTES = 64_000_000

FILE_NAMES = (
    ("startup", re.compile(r"(hochlauf|startup).*\.lis")),
    ("channel", re.compile(r"(default_)?(sda|channel).*\.lis")),
    ("zero", re.compile(r"(default_)?(nullp|zero).*\.lis")),
    ("tool", re.compile(r"(default_)?(werkz|tool).*\.lis")),
    ("clamp", re.compile(r"(default_)?(pzv|clamp).*\.lis")),
    ("axis", re.compile(r"(default_)?(achs|axis).*\.lis")),
    ("external", re.compile(r"(default_)?ext_?var.*\.lis")),
)
"""Kind of list by file name, upper and lower case alike."""

STARTUP_KINDS = {
    "default_sda_mds": "channel",
    "sda_mds": "channel",
    "nullp_data": "zero",
    "werkz_data": "tool",
    "pzv_data": "clamp",
    "default_achs_mds": "axis",
    "achs_mds": "axis",
}


@dataclass(frozen=True, slots=True)
class ListFile:
    """One list of a machine. `number`: index under which a start-up list names it."""

    list_kind: str
    document: ListDocument
    number: int | None = None
    is_default: bool = False


Found = tuple[tuple[ListFile, ...], tuple[Diagnostic, ...]]


def read_document(path: str | Path, name: str | None = None) -> ListDocument:
    """The document of a list file. Raises OSError when the file cannot be read."""
    return ListDocument.from_bytes(Path(path).read_bytes(), name or Path(path).name)


def find_lists(path: str | Path) -> Found:
    """The lists of a machine, default lists before specific ones, and files that were refused."""
    place = Path(path)
    if place.is_dir():
        return _lists_of_folder(place)
    if place.is_symlink():
        place = place.resolve()
    document, found = _read_below(place.parent, place.name, None)
    if document is None:
        return (), found
    kind = kind_of_name(place.name) or kind_of_content(document)
    if kind == "startup":
        return _lists_of_startup(place.parent, document)
    if kind is None:
        return (), (_no_list(f"{place.name} is none of the lists of a machine"),)
    return (ListFile(kind, document, _number_of_name(place.name)),), ()


def kind_of_name(name: str) -> str | None:
    """The kind of list that a file name says, None when it says none."""
    return next((kind for kind, names in FILE_NAMES if names.fullmatch(name.lower())), None)


def kind_of_content(document: ListDocument) -> str | None:
    """The kind of list that knows most of the keys, None when no kind knows any."""
    votes = Counter(kind for entry in document.entries for kind in table.kinds_of(entry.key))
    return max(table.LIST_KINDS, key=lambda kind: votes[kind]) if votes else None


def _lists_of_folder(folder: Path) -> Found:
    names = sorted(_file_names(folder), key=lambda name: (not _is_default(name), _natural(name)))
    startup = next((name for name in names if kind_of_name(name) == "startup"), None)
    if startup is not None:
        document, found = _read_below(folder, startup, None)
        return _lists_of_startup(folder, document) if document else ((), found)
    files: list[ListFile] = []
    complaints: list[Diagnostic] = []
    for name in names:
        kind = kind_of_name(name)
        if kind is None:
            complaints.extend(_unnamed(name))
            continue
        document, found = _read_below(folder, name, None)
        complaints.extend(found)
        if document is not None:
            files.append(ListFile(kind, document, _number_of_name(name), _is_default(name)))
    if not files and not any(item.is_error for item in complaints):
        complaints.append(_no_list(f"the folder {folder.name} has no machine list"))
    return tuple(files), tuple(complaints)


def _lists_of_startup(folder: Path, document: ListDocument) -> Found:
    readings, complaints = read_values(document, "startup")
    found = list(complaints)
    files: list[ListFile] = []
    for reading in _in_reading_order(readings):
        name = str(reading.value).replace("\\", "/")
        listed, refused = _read_below(folder, name, reading.entry.value_span)
        found.extend(refused)
        if listed is not None:
            files.append(_startup_file(reading, listed))
    if not files and not any(item.is_error for item in found):
        found.append(_no_list(f"the start-up list {document.name} names no list"))
    return tuple(files), tuple(found)


def _in_reading_order(readings: tuple[Reading, ...]) -> list[Reading]:
    """Entries that name lists: defaults first, and of each kind only those of the first channel."""
    last = {r.entry.key.lower(): r for r in readings if r.value is not None}
    named = [r for r in last.values() if _startup_name(r) in STARTUP_KINDS]
    first: dict[str, int] = {}
    for reading in named:
        if reading.indices:
            name, index = _startup_name(reading), reading.indices[0]
            first[name] = min(first.get(name, index), index)
    chosen = [r for r in named if not r.indices or _counts(r, first)]
    return sorted(chosen, key=lambda r: (bool(r.indices), r.indices))


def _counts(reading: Reading, first: dict[str, int]) -> bool:
    name = _startup_name(reading)
    return name == "achs_mds" or reading.indices[0] == first[name]


def _startup_name(reading: Reading) -> str:
    return reading.row.key.removesuffix("[]")


def _startup_file(reading: Reading, document: ListDocument) -> ListFile:
    name = _startup_name(reading)
    number = reading.indices[0] if reading.indices else None
    return ListFile(STARTUP_KINDS[name], document, number, name.startswith("default_"))


def _read_below(
    folder: Path, name: str, span: Span | None
) -> tuple[ListDocument | None, tuple[Diagnostic, ...]]:
    """The list `name` of a folder, or N3006 when it is missing or outside of the folder."""
    reason = _refusal(folder, name)
    if reason is None:
        try:
            return read_document(folder / name, PurePosixPath(name).as_posix()), ()
        except OSError as error:
            reason = f"it cannot be read ({error.strerror or 'input error'})"
    message = f"the list {_shown(name)} is not read: {reason}"
    return None, (diagnostic("N3006", span, message),)


def _refusal(folder: Path, name: str) -> str | None:
    try:
        if re.match(r"[A-Za-z]:|/", name):
            return "its path must be relative to the folder of the machine"
        target = (folder / name).resolve()
        if not target.is_relative_to(folder.resolve()):
            return "it is outside of the folder of the machine"
        if not target.is_file():
            return "there is no such file"
        return "it is too large" if target.stat().st_size > MAX_BYTES else None
    except (OSError, ValueError, RuntimeError):
        return "its name is not a file name"


def _file_names(folder: Path) -> Iterator[str]:
    try:
        yield from (item.name for item in folder.iterdir() if not item.is_dir())
    except OSError:
        return


def _is_default(name: str) -> bool:
    return name.lower().startswith("default_")


def _natural(name: str) -> tuple[tuple[int, str], ...]:
    """Sort key with `achs2` before `achs10`."""
    parts = re.findall(r"[0-9]+|[^0-9]+", name.lower())
    return tuple((int(p), "") if p.isdecimal() and p.isascii() else (-1, p) for p in parts)


def _number_of_name(name: str) -> int | None:
    """The last number in a file name: 3 of `achs3.lis`."""
    numbers = re.findall(r"[0-9]{1,6}", name)
    return int(numbers[-1]) if numbers else None


def _unnamed(name: str) -> Iterator[Diagnostic]:
    """A list that nobody reads because of its name."""
    if name.lower().endswith(".lis"):
        message = f"{_shown(name)} is not read: its name does not say what kind of list it is"
        hint = (
            "lists begin with sda, nullp, werkz, pzv, achs or extvar; "
            "or name it in a start-up list (hochlauf.lis)"
        )
        yield diagnostic("N3012", None, message, hint)


def _no_list(message: str) -> Diagnostic:
    return diagnostic("N3008", None, message, "name the files as sda.lis, nullp.lis, achs1.lis ...")


def _shown(name: str) -> str:
    return "".join(c if c.isprintable() else "?" for c in name)[:200]
