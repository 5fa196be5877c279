"""A source finds lines and columns alike in text and in bytes, of any length of line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ncscope.diagnostics import Source
from ncscope.execution import Options, Program, run
from ncscope.language import iterate_blocks
from ncscope.loading import load_program
from ncscope.machine import Machine

LINES = st.lists(st.integers(0, 5000) | st.integers(0, 3), max_size=40)


def sources(text: str) -> tuple[Source, Source]:
    return Source("p", text), Source("p", np.frombuffer(text.encode("latin-1"), dtype=np.uint8))


@given(LINES, st.data())
def test_position_and_line_text(lengths, data):
    lines = ["x" * n for n in lengths] or [""]
    text = "\n".join(lines)
    offset = data.draw(st.integers(0, len(text)))
    line = data.draw(st.integers(1, len(lines)))
    begin = text.rfind("\n", 0, offset) + 1
    for source in sources(text):
        assert source.position(offset) == (text.count("\n", 0, offset) + 1, offset - begin + 1)
        assert source.line_text(line) == lines[line - 1]
        end = text.find("\n", offset)
        assert source.end_of_line(offset) == (len(text) if end < 0 else end)


@pytest.mark.parametrize("filler", [10, 4000, 20_000, 90_000])
def test_a_joined_line_of_any_length_is_one_block(filler):
    text = f"N10 X[1 + \\\n{'; remark' * (filler // 8)}\n2]\nN20 Y2\n"
    for source in sources(text):
        blocks = [block for block, _ in iterate_blocks(source)]
        assert len(blocks) == 2
        assert blocks[1].span.line == 4


def test_a_mapped_file_runs_like_a_read_one(tmp_path, monkeypatch):
    path = tmp_path / "long.nc"
    path.write_text("".join(f"N{i} G1 X{i / 10} Y{-i} F100\n" for i in range(1, 5000)) + "M30\n")
    read = run(Machine(), load_program(path), Options())
    monkeypatch.setattr("ncscope.loading.programs.MAPPED_FROM", 1)
    program = load_program(path)
    assert isinstance(program.source.content, np.memmap)
    mapped = run(Machine(), program, Options())
    assert np.array_equal(mapped.acs, read.acs) and len(read) == 4999
    program.source.forget(len(program.source))
    assert program.source.line_text(3) == "N3 G1 X0.3 Y-3 F100"


@given(st.lists(st.integers(0, 5000) | st.just(2047), max_size=40), st.data())
def test_what_a_reader_of_lines_knows_is_what_counting_finds(lengths, data):
    lines = ["x" * n for n in lengths] or [""]
    text = "\n".join(lines) + "\n"
    ends = [at + 1 for at, char in enumerate(text) if char == "\n"]
    first = data.draw(st.integers(0, len(lines) - 1))
    last = data.draw(st.integers(first, len(lines) - 1))
    offset = data.draw(st.integers(0, len(text)))
    for source in sources(text):
        start = ends[first - 1] if first else 0
        source.position(data.draw(st.integers(0, start)))
        source.learn(start, np.array(ends[first : last + 1]), first + 1)
        assert source.position(offset)[0] == text.count("\n", 0, offset) + 1


def test_lines_before_the_first_plain_block_are_counted_too():
    """A head of comments that is longer than the piece whose lines are counted together."""
    head = "".join(f"({'x' * 90} {line})\n" for line in range(1, 61))
    source = Source("part.nc", head + "G1 F100 X1\nX2\nX3\nM30\n")
    run(Machine(), Program(source), Options(bulk=True)).check()
    for line in (1, 30, 60):
        assert source.position(source.content.index(f" {line})"))[0] == line
        assert source.line_text(line).endswith(f" {line})")
