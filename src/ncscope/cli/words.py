"""Words such as `X=10 C=30` on the command line, and options that take several of them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from typing import Any

from typer.core import TyperCommand

from ncscope.cli.screen import fail

_WORD = re.compile(r"[A-Za-z_]\w*=.*")


class WordsCommand(TyperCommand):
    """A command whose word options take all words behind them: `--near X=1 C=20`."""

    spreading = ("--axes", "--program", "--tip", "--near", "--grid")

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Repeats the option for each further word, which is the form that click knows."""
        spread: list[str] = []
        option = ""
        for place, arg in enumerate(args):
            follows = place > 0 and _WORD.fullmatch(args[place - 1])
            if option and follows and _WORD.fullmatch(arg):
                spread.append(option)
            elif not (place > 0 and args[place - 1] == option):
                option = arg if arg in self.spreading else ""
            spread.append(arg)
        return super().parse_args(ctx, spread)


def read_words(words: Iterable[str], names: Sequence[str], what: str) -> dict[str, float]:
    """`X=10` words by name; ends the process when a word is none or names nothing known."""
    found: dict[str, float] = {}
    for word in words:
        name, equals, text = word.partition("=")
        if name not in names or not equals:
            fail(f"{what} {word}: write NAME=NUMBER with a name of {' '.join(names)}")
        if name in found:
            fail(f"{what}: {name} stands twice")
        found[name] = read_number(text, f"{what} {word}")
    return found


def read_positions(words: Iterable[str]) -> dict[str, float]:
    """`X=1.5` to axis and position, mm or degrees, before the axes are known; as `read_words`."""
    given = list(words)
    for word in given:
        if word.find("=") < 1:
            fail(f"--axes {word}: write an axis and its position, for example X=12.5")
    return read_words(given, [word.partition("=")[0] for word in given], "--axes")


def read_number(text: str, what: str) -> float:
    """A finite number; ends the process when the text is none."""
    try:
        value = float(text)
    except ValueError:
        fail(f"{what}: {text!r} is not a number")
    if not math.isfinite(value):
        fail(f"{what}: {text} is not a finite number")
    return value
