"""What changes the path between the ends of blocks says so in its note."""

import pytest

import ncscope
from ncscope import Machine


@pytest.mark.parametrize(
    ("block", "words"),
    [
        ("G61 X2", "rounds corners"),
        ("G261 X2", "rounds corners"),
        ("#HSC ON [BSPLINE PATH_DEV 0.2]", "smooths the path"),
        ("#CONTOUR MODE [DEV PATH_DEV 0.1]", "smooths the path"),
        ("G60 X2", "has no effect"),
        ("G260 X2", "has no effect"),
        ("#HSC OFF", "has no effect"),
        ("H5", "taken as without effect"),
    ],
)
def test_note_says_what_is_not_shown(block, words):
    result = ncscope.run(Machine(), f"X1\nN5 {block}\nN6 {block}\nM30\n").check()
    (note,) = [d for d in result.diagnostics if d.id == "N2002"]
    assert words in note.message and (note.line, note.column) == (2, 4)
