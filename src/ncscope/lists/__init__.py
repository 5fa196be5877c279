"""ASCII list files and the machine that they describe.

Read in this order: `document` (text and entries), `table` (what every key means), `values`
(text to number), `files` (which files belong together), `axes`, `records` and `kinematic_sets`
(parts of a machine), `reading` (the whole), `check`, `writing`.
"""

from ncscope.lists.check import check_lists
from ncscope.lists.document import ListDocument
from ncscope.lists.reading import load_machine

__all__ = ["ListDocument", "check_lists", "load_machine"]
