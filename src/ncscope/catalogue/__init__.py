"""Every diagnostic id with its severity and explanation: tables, from which the docs page comes.

`control` holds the numbers of the control, `own` ours, which begin with N. Ids are stable and never
reused.
"""

from ncscope.catalogue.control import OF_CONTROL
from ncscope.catalogue.entry import Entry
from ncscope.catalogue.own import OWN

__all__ = ["CATALOGUE", "Entry"]

CATALOGUE: dict[str, Entry] = {**OF_CONTROL, **OWN}
