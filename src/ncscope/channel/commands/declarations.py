"""#VAR .. #ENDVAR, #DELETE and #INIT MACRO TAB: variables come and go (TF5200 variables)."""

from __future__ import annotations

from ncscope.channel import user_variables
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import evaluate_number, evaluate_value, indices
from ncscope.language import tree


def declare(draft: Draft, item: tree.Declaration) -> None:
    """One line between #VAR and #ENDVAR."""
    external = isinstance(item.target, tree.Variable) and item.target.parts[1].name.upper() == "E"
    if external or not user_variables.is_user(item.target):
        draft.fail("20908", item.target.span, "only P, V.P, V.S, V.L and V.CYC can be declared")
    values = tuple(evaluate_value(draft, e) for e in item.initial)
    length = user_variables.LONGEST_STRING
    if item.length is not None:
        length = round(evaluate_number(draft, item.length))
        if not 0 <= length <= user_variables.LONGEST_STRING:
            what = f"a STRING has 0 to {user_variables.LONGEST_STRING} characters"
            draft.fail("20906", item.span, what)
    user_variables.declare(draft, item, indices(draft, item.target), values, length)


def area(draft: Draft, command: tree.HashCommand) -> None:
    """#VAR, #ENDVAR, #COMMENT BEGIN and #COMMENT END do nothing themselves: the language has
    read the lines between them."""


def delete(draft: Draft, command: tree.HashCommand) -> None:
    """#DELETE V.P.A, V.S.B"""
    nodes = [i.value for group in command.groups for i in group.items]
    for node in nodes:
        if not isinstance(node, (tree.Variable, tree.Parameter)) or not user_variables.is_user(
            node
        ):
            draft.fail("20908", command.span, "#DELETE needs variables of the program")
        user_variables.delete(draft, node, indices(draft, node))
    if not nodes:
        draft.fail("N1005", command.span, "#DELETE needs a variable")


def clear_macros(draft: Draft, command: tree.HashCommand) -> None:
    """#INIT MACRO TAB: the macros of the channel list stay."""
    draft.state = draft.state.changed(macros=draft.machine.settings.macros)


COMMANDS = {
    "COMMENT BEGIN": area,
    "COMMENT END": area,
    "VAR": area,
    "ENDVAR": area,
    "DELETE": delete,
    "INIT MACRO TAB": clear_macros,
    "INIT MAKRO TAB": clear_macros,
}
