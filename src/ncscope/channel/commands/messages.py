"""#MSG SAVE, #MSG and #FILE NAME: texts that a program writes (TF5200 #MSG)."""

from __future__ import annotations

import re

from ncscope.channel.draft import Draft, Message
from ncscope.channel.evaluation import evaluate_value
from ncscope.language import tree
from ncscope.language.functions import rounded

FORMAT_ITEM = re.compile(r"%(.?)")
MAX_VALUES = 10
SAVE_MODES = frozenset(("EXCLUSIVE", "CONTINUE"))
SHOW_MODES = frozenset(("SYN", "SYN_ACK", "ACK"))
RECEIVERS = frozenset(("ISG_DIAG_BED", "DIAG", "HMI", "PLC", "EVENT_LOGGER"))
MAX_TEXT = 512


def save(draft: Draft, command: tree.HashCommand) -> None:
    """#MSG SAVE [EXCLUSIVE] [CONTINUE] ["text %f", value ..]: one line of the message file.

    EXCLUSIVE writes the text alone; without it the text stands in quotes. The time stamp of the
    control is left out: the same program writes the same file.
    """
    words = _modes(draft, command, SAVE_MODES)
    text = _text(draft, command)
    if "EXCLUSIVE" not in words:
        text = f'"{text}"'
    end = "" if "CONTINUE" in words else "\n"
    draft.messages.append(Message(draft.state.message_file, text, end, command.span))


def show(draft: Draft, command: tree.HashCommand) -> None:
    """#MSG SYN HMI ["text", value ..]: a message to a display or to the PLC.

    The receiver is a word or stands in brackets of its own.
    """
    _modes(draft, command, SHOW_MODES | RECEIVERS)
    if len(command.groups) == 2:
        _check_receiver(draft, command.groups[0])
    elif len(command.groups) > 2:
        draft.fail("N1005", command.groups[2].span, "#MSG has a receiver and a text", _FORM)
    draft.messages.append(Message(None, _text(draft, command), span=command.span))


_FORM = 'write #MSG ["text"], or with a receiver #MSG HMI ["text"]'


def _modes(draft: Draft, command: tree.HashCommand, known: frozenset[str]) -> set[str]:
    words = {m.upper() for m in command.modifiers}
    for word in sorted(words - known):
        hint = f"known are {', '.join(sorted(known))}"
        draft.fail("N1005", command.span, f"{word} is unknown in #{command.name}", hint)
    return words


def _check_receiver(draft: Draft, group: tree.Group) -> None:
    for item in group.items:
        name = item.value.text.upper() if isinstance(item.value, tree.Name) else ""
        if name not in RECEIVERS:
            hint = f"receivers are {', '.join(sorted(RECEIVERS))}"
            draft.fail("N1005", item.span, "the receiver of the message is unknown", hint)


def file_name(draft: Draft, command: tree.HashCommand) -> None:
    """#FILE NAME [MSG=file M6=file G80=file]: where #MSG SAVE writes, and what M6 and G80 call."""
    items = [item for group in command.groups for item in group.items]
    if not items:
        draft.fail("20480", command.span, "#FILE NAME needs a name, for example [MSG=log.txt]")
    for item in items:
        called = re.fullmatch(r"M6|G8[0-9]|G8[0-3][0-9]", item.key or "")
        if item.key != "MSG" and called is None:
            what = f"#FILE NAME [{item.key or ''}=..]"
            draft.fail("N2001", item.span, f"{what} is not supported")
        name = item.value.text if isinstance(item.value, tree.Name) else None
        if item.value is not None and name is None:
            name = str(evaluate_value(draft, item.value))
        if not name:
            draft.fail("N1005", item.span, "a file name is missing")
        if called is None:
            draft.state = draft.state.changed(message_file=name)
        else:
            files = {**draft.state.called_files, called.group(): name}
            draft.state = draft.state.changed(called_files=files)


def _text(draft: Draft, command: tree.HashCommand) -> str:
    if not command.groups or not command.groups[-1].places:
        draft.fail("20480", command.span, 'a message needs its text: ["text"]')
    first, *rest = command.groups[-1].places
    if first is None:
        draft.fail("20726", command.span, "the text of the message is missing")
    _refuse_names(draft, command)
    template = evaluate_value(draft, first)
    if not isinstance(template, str):
        draft.fail("20721", first.span, "a message begins with its text in quotes")
    if len(template) > MAX_TEXT:
        draft.fail("20723", first.span, f"the text is longer than {MAX_TEXT} characters")
    if len(rest) > MAX_VALUES:
        what = f"a message has at most {MAX_VALUES} values"
        draft.fail("20724", command.groups[-1].span, what)
    values = []
    for place in rest:
        if place is None:
            draft.fail("20726", command.groups[-1].span, "a value of the message is missing")
        values.append((evaluate_value(draft, place), place))
    return _format(draft, template, first, values)


def _refuse_names(draft: Draft, command: tree.HashCommand) -> None:
    """A word without quotes is neither a text nor a value."""
    for place in command.groups[-1].places:
        if isinstance(place, tree.Name):
            what = f"{place.text} is neither a text nor a value"
            hint = f'write "{place.text}", or for the position of an axis V.A.ABS.X'
            draft.fail("20721", place.span, what, hint)


def _format(draft: Draft, template: str, text: tree.Expression, values: list) -> str:
    """%d %D whole number, %f %F six decimals, %s %S text, %% a percent sign."""
    remaining = list(values)

    def item(match: re.Match[str]) -> str:
        letter = match.group(1)
        if letter == "%":
            return "%"
        if letter.lower() not in ("d", "f", "s") or not letter:
            draft.fail(
                "21180",
                text.span,
                f"the format item %{letter} is unknown",
                "known are %d, %f, %s and %%",
            )
        if not remaining:
            draft.fail("20726", text.span, "the text has more format items than values")
        value, place = remaining.pop(0)
        if letter in "sS":
            return value if isinstance(value, str) else f"{value:g}"
        if isinstance(value, str):
            draft.fail("20721", place.span, f"%{letter} needs a number")
        return f"{rounded(value):d}" if letter in "dD" else f"{value:f}"

    result = FORMAT_ITEM.sub(item, template)
    if remaining:
        draft.fail("20724", remaining[0][1].span, "the message has more values than format items")
    return result


COMMANDS = {
    "MSG SAVE": save,
    "MSG": show,
    "MSG INFO": show,
    "FILE NAME": file_name,
    "FILENAME": file_name,
}
