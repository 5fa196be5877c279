"""What csv and jsonl hold is what the run produced, number by number."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ncscope
from ncscope import compilation
from ncscope.views import splicing
from ncscope.views.records import write_csv, write_jsonl
from ncscope.views.splicing import Template

EXAMPLES = Path(__file__).parents[1] / "examples"
NUMBERS = st.floats(allow_infinity=False) | st.just(math.nan)
ROWS = st.lists(
    st.tuples(st.integers(0, 10**12), st.integers(-1, 10**9), st.integers(0, 1), NUMBERS, NUMBERS),
    min_size=1,
    max_size=6,
)


def as_python(patch: pytest.MonkeyPatch) -> None:
    compilation.load()
    for name in ("splice", "_copied", "_written"):
        patch.setattr(splicing, name, getattr(splicing, name).py_func)


@pytest.mark.parametrize("compiled", [False, True])
@given(rows=ROWS)
def test_a_template_keeps_every_number(compiled, rows):
    template = Template(('{"a":', ',"b":', ',"m":"', '","f":[', ",", "]}\n"), ("G00", "G1"), "null")
    whole = np.array([row[:2] for row in rows])
    codes = np.array([row[2] for row in rows], dtype=np.int8)
    real = np.array([row[3:] for row in rows])
    with pytest.MonkeyPatch.context() as patch:
        if compiled:
            compilation.load()
        else:
            as_python(patch)
        lines = bytes(template.rows(whole, codes, real)).splitlines()
    for line, (a, b, code, *numbers) in zip(lines, rows, strict=True):
        record = json.loads(line)
        assert record["a"] == a and record["b"] == (None if b < 0 else b)
        assert record["m"] == ("G00", "G1")[code]
        assert record["f"] == [None if math.isnan(n) else n for n in numbers]


def test_an_empty_word_stands_for_nothing():
    template = Template(("", ",", ",", "\n"), ("G00",), "")
    row = template.rows(np.array([[-1]]), np.array([0], dtype=np.int8), np.array([[math.nan]]))
    assert bytes(row) == b",G00,\n"


def test_csv_and_jsonl_say_the_same():
    machine, _ = ncscope.load_machine(EXAMPLES / "machines" / "ca_head")
    result = ncscope.run(machine, ncscope.load_program(EXAMPLES / "programs" / "five_axis.nc"))
    table, lines = io.StringIO(), io.StringIO()
    write_csv(table, result)
    write_jsonl(lines, result, [], True)
    rows = list(csv.DictReader(io.StringIO(table.getvalue())))
    moves = [r for r in map(json.loads, lines.getvalue().splitlines()) if r["kind"] == "move"]
    assert len(rows) == len(moves) == len(result) == 5
    for i, (row, move) in enumerate(zip(rows, moves, strict=True)):
        assert move["index"] == i and int(row["line"]) == move["line"] == result.line[i]
        assert row["motion"] == move["motion"] and row["file"] == move["file"]
        for system in ("pcs", "wcs", "mcs", "acs"):
            for axis, value in move[system].items():
                assert float(row[f"{system}_{axis}"]) == value
                assert value == getattr(result, system)[i, result.axes.index(axis)]
        if move["direction"] is not None:
            assert [float(row[f"direction_{c}"]) for c in "ijk"] == move["direction"]
