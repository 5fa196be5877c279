"""NC programs as text: tokens, tree, expressions. Knows no machine and opens no files.

Read `tree` first, then `parser`, `words`, `hashes`, `controls`, `terms`; `expressions` gives
values to what `terms` has read.
"""

from ncscope.language.expressions import (
    Environment,
    EvaluationError,
    evaluate,
    indices_of,
)
from ncscope.language.parser import BlockReader, Program, iterate_blocks, parse_block, parse_program

__all__ = [
    "BlockReader",
    "Environment",
    "EvaluationError",
    "Program",
    "evaluate",
    "indices_of",
    "iterate_blocks",
    "parse_block",
    "parse_program",
]
