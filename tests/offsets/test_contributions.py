"""The contributions that `explain` shows add up to the axis values, whatever a program mixes."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope
from ncscope.channel.given import read_rows
from ncscope.diagnostics import Source
from ncscope.machine import Axis, ChannelSettings, Machine, OffsetRecord, Tool, ZeroOffsets

EXAMPLES = Path(__file__).parents[2] / "examples"
HEAD, _ = ncscope.load_machine(EXAMPLES / "machines" / "ca_head")
AXES = (
    Axis("X", 1),
    Axis("Y", 2),
    Axis("Z", 3),
    Axis("C", 4, True),
    Axis("A", 5, True, reference=9.0),
)
LISTS = {
    "axes": AXES,
    "zero_offsets": ZeroOffsets(
        {1: OffsetRecord({0: 10.0, 1: -5.5, 4: 30.0}), 2: OffsetRecord({2: 3.0, 3: 12.0})}
    ),
    "clamp_positions": {1: OffsetRecord({0: 0.5, 3: -4.0})},
    "tools": {
        1: Tool(length=40.0, axis_offsets={0: 2.0, 3: 1.0}),
        2: Tool(length=7.0, axis_offsets={1: -3.0}, fixed=True),
        3: Tool(length=5.0, orientation=(0.0, -3.0, -4.0)),
    },
}
FLAT = Machine(**LISTS)
DIRECT = Machine(**LISTS, settings=ChannelSettings(tool_moves_at_once=True))
SPATIAL = Machine(
    **LISTS,
    kinematic_parameters=HEAD.kinematic_parameters,
)
PROBE, _ = read_rows(Source("probe.csv", "X\n" + "".join(f"{i}.25\n" for i in range(40))))
JOG, _ = read_rows(Source("jog.csv", "X,C\n" + "".join(f"{i}.5,{i}\n" for i in range(40))))

NUMBER = st.integers(-2000, 2000).map(lambda v: f"{v / 16:.4f}")
POSITIVE = st.integers(1, 64).map(lambda v: f"{v / 16:.4f}")
WORD = st.tuples(st.sampled_from("XYZCA"), NUMBER).map("".join)
MOTION = st.tuples(
    st.sampled_from(["", "G01 F500 ", "G00 ", "G91 ", "G90 "]),
    st.lists(WORD, min_size=1, max_size=4, unique_by=lambda w: w[0]),
).map(lambda p: p[0] + " ".join(p[1]))
VALUES = st.lists(NUMBER, min_size=6, max_size=6).map(",".join)
COMMAND = st.one_of(
    st.tuples(st.sampled_from(["G90 G92 ", "G91 G92 ", "#PSET "]), WORD).map("".join),
    st.tuples(st.sampled_from(["CS", "ACS", "BCS"]), VALUES).map(lambda p: f"#{p[0]} ON [{p[1]}]"),
    st.tuples(NUMBER, NUMBER).map(lambda p: f"#ROTATION ON [ANGLE={p[0]} CENTER1={p[1]}]"),
    st.tuples(POSITIVE, POSITIVE).map(lambda p: f"#SCALE OFF\n#SCALE ON X{p[0]} C{p[1]}"),
    st.tuples(NUMBER, NUMBER).map(lambda p: f"G68 R{p[0]} X{p[1]}"),
    WORD.map(lambda word: f"G90 #SUPPRESS OFFSETS {word}"),
    NUMBER.map(lambda value: f"V.G.WZ_AKT.L = {value}"),
    NUMBER.map(lambda value: f"V.G.NP_AKT.V.Y = {value}"),
    NUMBER.map(lambda value: f"#TLC OFF\n#TLC ON [{value}]"),
    st.sampled_from(["G53", "G54", "G55 X1", "#PRESET", "#TLC OFF", "G70", "G71"]),
    st.sampled_from(["#CS OFF ALL", "#ACS OFF", "#BCS OFF", "#CS OFF", "#MCS ON", "#MCS OFF"]),
    st.sampled_from(["#ROTATION OFF", "#SCALE OFF", "G69", "G17", "G18", "G19", "G20", "G21"]),
    st.sampled_from(["G351 Y-1", "G351 X1 Y1", "G23", "#SUPPRESS OFFSETS [ZERO TOOL MANUAL] X5"]),
    st.sampled_from(["D1", "D2 Z3", "D3", "D0", "#TLAX [X-]", "#TLAX DEFAULT"]),
    st.sampled_from(["G100 X50 F500", "G101 X1", "G102", "G100 X9 F500\nG101 X2"]),
    st.sampled_from(["G74 A1", "G201 X1 C1", "G200 X1 C1", "#CHANNEL INIT [CMDPOS]"]),
    st.sampled_from(["#TRAFO OFF", "#TRAFO [91]", "#MCS ON [EX TOOL]"]),
)
PROGRAM = st.lists(st.tuples(MOTION, COMMAND).map("\n".join), min_size=2, max_size=9)


def assert_sums(result: ncscope.Trajectory) -> int:
    """Contributions of every executed line of the main program add up; how many lines there are."""
    last = {}
    for stretch in result.stretches:
        for row, line in enumerate(stretch.line.tolist()):
            last[line] = stretch.acs[row]
    lines = sorted({*last, *result._places})
    for line in lines:
        explanation = result.explain(line=line)
        layers = explanation.layers
        total = layers[0].values + np.sum([layer.change for layer in layers], axis=0)
        shown = last.get(line, layers[-1].values)
        np.testing.assert_allclose(total, shown, rtol=0, atol=1e-9, err_msg=f"line {line}")
        np.testing.assert_allclose(layers[-1].values, shown, rtol=0, atol=1e-9)
        place = result.where(dict(zip(explanation.axes, shown, strict=True)), line=line)
        np.testing.assert_allclose(place.pcs, layers[0].values, rtol=0, atol=1e-7)
    return len(lines)


def _run(machine: Machine, blocks: list[str]) -> ncscope.Trajectory:
    """Without the blocks that are not allowed where they stand: those are tested elsewhere."""
    options = ncscope.Options(clamp=1, probe=PROBE, manual=JOG)
    lines = [line for block in blocks for line in block.split("\n")]
    while True:
        result = ncscope.run(machine, "\n".join([*lines, "M30"]), options)
        wrong = next((d.line for d in result.diagnostics if d.is_error), None)
        if wrong is None or wrong > len(lines):
            return result
        del lines[wrong - 1]


@pytest.mark.parametrize("machine", [FLAT, DIRECT, SPATIAL], ids=["flat", "direct", "spatial"])
@settings(max_examples=60)
@given(blocks=PROGRAM)
def test_contributions_of_random_programs(machine, blocks):
    if machine is SPATIAL:
        blocks = ["V.G.WZ_AKT.L = 80\n#TRAFO [91]", *blocks]
    result = _run(machine, blocks)
    assert result.ok, [ncscope.render(d) for d in result.diagnostics]
    assert_sums(result)


PROGRAMS = sorted((EXAMPLES / "programs").glob("*.nc"))
MACHINES = ("xyz", "ca_head", "ac_table", "xyzac_axes", "zero_list_repaired")


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda p: p.name)
def test_contributions_of_every_example(path):
    counted = 0
    own = (path.stem,) if (EXAMPLES / "machines" / path.stem).is_dir() else ()
    for name in (*MACHINES, *own):
        machine, _ = ncscope.load_machine(EXAMPLES / "machines" / name)
        counted += assert_sums(ncscope.run(machine, ncscope.load_program(path)))
    assert counted >= len(MACHINES)
