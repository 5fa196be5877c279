"""Pictures: the path of a run, its axis curves, and the chain of a machine.

Read in this order: `projection` (the four views), `reduce` (a million blocks on a thousand pixels),
`path` and `chain` (what is to be seen, in mm), `image` (png and svg), `page` (html).
Nothing here is drawn in another system than the MCS, and nothing depends on a clock or on chance:
the same run gives the same bytes.
"""
