"""What a block calls: L, LL, cycles, sequences, G80 and its kin, M6, and returns.

Enters the words of a block. Leaves requests; the subprograms are found and entered behind the
block. Source: TF5200 programming manual; P-CHAN-00118, P-CHAN-00160 to 00169, P-CHAN-00187.
"""

from __future__ import annotations

from dataclasses import replace

from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number, evaluate_value
from ncscope.channel.state import CallRequest, Return
from ncscope.channel.words import Words
from ncscope.diagnostics import Span
from ncscope.language import tree

MODAL_WORDS = {"MODAL": "MODAL_MOVE", "MODAL_MOVE": "MODAL_MOVE", "MODAL_BLOCK": "MODAL_BLOCK"}
IMPLICIT = frozenset((*range(80, 90), *range(800, 840)))
"""G functions that call the file which is configured for them."""
MOST_PARAMETERS = 200
MOST_IMPLICIT_VALUES = 50
LONGEST_NAME = 83


def request(draft: Draft, call: tree.Call) -> None:
    """L, LL, L CYCLE or L SEQUENCE of a block."""
    if call.kind == "L SEQUENCE":
        draft.calls.append(_sequence(draft, call))
    elif call.kind.endswith("CYCLE"):
        _cycle(draft, call)
    else:
        draft.calls.append(CallRequest(call.kind, _name(draft, call.target, call.span), call.span))


def _name(draft: Draft, target: tree.Expression | None, span: Span) -> str:
    """The name of a subprogram: written, of a macro, or in a string variable.

    A macro that is not defined stands for its own name.
    """
    value: float | str = ""
    match target:
        case tree.Name(text=text):
            value = text
        case tree.Macro(name=text) | tree.Text(value=text):
            value = draft.state.macros.get(text, text)
        case tree.Variable() | tree.Parameter() | tree.CycleParameter():
            value = evaluate_value(draft, target)
    if not isinstance(value, str) or not value:
        draft.fail("20369", span, "the name of the subprogram is not a text")
    if len(value) > LONGEST_NAME:
        message = f"the name of the subprogram is longer than {LONGEST_NAME} characters"
        draft.fail("20369", span, message)
    return value


# --- cycles ------------------------------------------------------------------------------------


def _cycle(draft: Draft, call: tree.Call) -> None:
    running = draft.state.running
    if running.modal is not None and not running.in_modal:
        hint = "end it first with #DISABLE MODAL CYCLE"
        draft.fail("21381", call.span, "another modal cycle is active", hint)
    _refuse_twice(draft, call, "21379")
    modal = ""
    parameters: dict[int, float | str] = {}
    for item in call.arguments[0].items:
        if item.key is not None and item.key.startswith("@P"):
            _parameter(draft, item, parameters)
        elif item.key is None and isinstance(item.value, tree.Name):
            modal = MODAL_WORDS.get(item.value.text.upper(), "")
            if not modal:
                hint = f"known are {', '.join(MODAL_WORDS)}"
                draft.fail("N1005", item.span, f"{item.value.text} is unknown here", hint)
        elif item.key != "NAME":
            draft.fail("N1005", item.span, "only NAME=.. and @P..=.. can stand here")
    if call.target is None:
        draft.fail("N1005", call.span, "the cycle has no name", "write L CYCLE [NAME=.. @P1=..]")
    kind = call.kind.split()[0]
    name = _name(draft, call.target, call.span)
    draft.calls.append(CallRequest(kind, name, call.span, parameters, modal))
    if not modal:
        return
    if running.in_modal:
        draft.fail("21381", call.span, "a modal cycle cannot call a modal cycle")
    held = replace(draft.calls[-1], home=running.file)
    draft.state = draft.state.changed(running=replace(running, modal=held))


def _parameter(draft: Draft, item: tree.Item, parameters: dict[int, float | str]) -> None:
    number = int((item.key or "@P0")[2:])
    if not 1 <= number <= MOST_PARAMETERS:
        what = f"@P{number} does not exist; cycles have @P1 to @P{MOST_PARAMETERS}"
        draft.fail("20400", item.span, what)
    assert item.value is not None
    value = item.value.text if isinstance(item.value, tree.Name) else None
    parameters[number] = evaluate_value(draft, item.value) if value is None else value


def after_block(draft: Draft, moved: bool) -> None:
    """The modal cycle, called again after a motion (MODAL_MOVE) or after any block."""
    running = draft.state.running
    modal = running.modal
    if modal is None or running.in_modal or any(c.parameters is not None for c in draft.calls):
        return
    if moved or modal.modal == "MODAL_BLOCK":
        draft.calls.insert(draft.implicit_calls, modal)


# --- implicit calls ----------------------------------------------------------------------------


def implicit(draft: Draft, words: Words) -> None:
    """G80 to G89, G800 to G839 and M6, where a file is configured for them: before any L."""
    found = []
    for number, word in words.gfunctions.items():
        if number in IMPLICIT:
            found.append(_implicit(draft, number, word))
    name = tool_change_file(draft)
    if name and 6 in words.mfunctions:
        found.append(CallRequest("L", name, words.mfunctions.pop(6)))
    draft.calls[:0] = found
    draft.implicit_calls = len(found)


def tool_change_file(draft: Draft) -> str:
    """The subprogram that M6 calls, "" without."""
    return _file(draft, "M6")


def _file(draft: Draft, function: str) -> str:
    configured = draft.machine.settings.called_files.get(function, "")
    return draft.state.called_files.get(function, configured)


def _implicit(draft: Draft, number: int, word: tree.GWord) -> CallRequest:
    name = _file(draft, f"G{number}")
    if not name:
        hint = f"#FILE NAME [G{number}=..] or g{number}_prog_file of the channel list names one"
        what = f"G{number} is unknown: no subprogram is configured for it"
        draft.fail("20131", word.span, what, hint)
    if word.arguments is None:
        return CallRequest("L", name, word.span)
    places = word.arguments
    running = draft.state.running
    if running.modal is not None and not running.in_modal:
        draft.fail("21381", word.span, "another modal cycle is active")
    if len(places) > MOST_IMPLICIT_VALUES:
        draft.fail("N1005", word.span, f"G{number} takes at most {MOST_IMPLICIT_VALUES} values")
    parameters = {
        i: evaluate_value(draft, place) for i, place in enumerate(places, 1) if place is not None
    }
    return CallRequest("L", name, word.span, parameters)


def _refuse_twice(draft: Draft, call: tree.Call, id: str) -> None:
    """A keyword that the brackets of a call hold a second time."""
    seen: dict[str, Span] = {}
    for item in call.arguments[0].items:
        key = item.key or ""
        if item.key is None and isinstance(item.value, tree.Name):
            key = item.value.text.upper().partition("_")[0]  # MODAL, MODAL_MOVE, MODAL_BLOCK
        if key in seen:
            notes = (("the first one", seen[key]),)
            draft.fail(id, item.span, f"{key} is given twice", notes=notes)
        if key not in ("", "N", "LABEL"):
            seen[key] = item.span


# --- sequences and returns ---------------------------------------------------------------------


def _sequence(draft: Draft, call: tree.Call) -> CallRequest:
    """L SEQUENCE [NAME=file N10 N50 REPEAT=2 ENDTAG]: blocks of a program as a subprogram."""
    marks: list[str] = []
    repeat, endtag = 1, False
    _refuse_twice(draft, call, "21696")
    for item in call.arguments[0].items:
        if item.key == "N" and item.value is not None:
            marks.append(f"N{round(evaluate_number(draft, item.value))}")
        elif item.key == "LABEL" and isinstance(item.value, tree.Name):
            marks.append(f"[{item.value.text}]")
        elif item.key == "REPEAT" and item.value is not None:
            repeat = round(evaluate_number(draft, item.value))
        elif item.key == "ENDTAG":
            endtag = True
    if not 1 <= len(marks) <= 2 or repeat < 1:
        hint = "write L SEQUENCE [N10 N50] or L SEQUENCE [NAME=file N10 N50 REPEAT=2]"
        draft.fail(
            "N1005", call.span, "a sequence needs its first block, and may name a last", hint
        )
    name = _name(draft, call.target, call.span) if call.target is not None else ""
    last = marks[1] if len(marks) == 2 else ("" if endtag else marks[0])
    return CallRequest(
        "SEQUENCE", name, call.span, first=marks[0], last=last, repeat=repeat, endtag=endtag
    )


def returned(draft: Draft, word: tree.MWord) -> Return:
    """M17, M17 [MAIN], M17 [JUMPS=2], with [LABEL] or N20 behind."""
    levels, label = 1, ""
    for item in (item for group in word.arguments for item in group.items):
        if item.key == "N" and item.value is not None:
            label = f"N{round(evaluate_number(draft, item.value))}"
        elif item.key == "JUMPS" and item.value is not None:
            levels = round(evaluate_number(draft, item.value))
            if levels < 1:
                draft.fail("N1005", item.span, "JUMPS counts program levels from 1")
        elif isinstance(item.value, tree.Name) and item.key is None:
            text = item.value.text.upper()
            levels, label = (0, label) if text == "MAIN" else (levels, f"[{text}]")
        else:
            draft.fail("N1005", item.span, "only MAIN, JUMPS=.. and a label can stand here")
    return Return(word.span, levels, label)
