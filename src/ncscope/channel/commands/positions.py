"""#GET CMDPOS [P1=X], #GET ACTPOS [V.P.A=Y]: axis positions into variables of the program.

Axes are ideal here, so command and actual positions are the same. Nothing is initialised.
Source: TF5200 requesting offset, command and actual values.
"""

from __future__ import annotations

from ncscope.channel import user_variables
from ncscope.channel.draft import Draft
from ncscope.channel.evaluation import indices
from ncscope.language import tree
from ncscope.language.cursor import Mistake
from ncscope.language.terms import parse_expression

_FORM = "write for example #GET CMDPOS [P1=X, V.P.POS=Y]"


def get(draft: Draft, command: tree.HashCommand) -> None:
    """The position of each axis that is named, with everything that lies on it."""
    items = [item for group in command.groups for item in group.items]
    if not items:
        draft.fail("20480", command.span, f"#{command.name} needs a variable and its axis", _FORM)
    for item in items:
        node = _target(draft, item)
        if not isinstance(item.value, tree.Name):
            draft.fail("N1005", item.span, "behind = stands the name of an axis", _FORM)
        axis = draft.axis_index(item.value.text, item.value.span, "20797")
        value = draft.shown(axis, float(draft.state.position.axes[axis]))
        user_variables.write(draft, node, indices(draft, node), value)


def _target(draft: Draft, item: tree.Item) -> tree.Variable | tree.Parameter:
    node = None if item.key is None else _parsed(item)
    if not isinstance(node, (tree.Variable, tree.Parameter)) or not user_variables.is_user(node):
        what = "the position goes to a P parameter or a variable of the program"
        draft.fail("N1005", item.span, what, _FORM)
    return node._replace(span=item.span)


def _parsed(item: tree.Item) -> tree.Expression | None:
    try:
        return parse_expression(item.key or "", item.span)
    except Mistake:
        return None


COMMANDS = {"GET CMDPOS": get, "GET ACTPOS": get}
