"""Laws of the chain and of a run: there and back, composition, layers, blocks, no exception."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ncscope
from ncscope.catalogue import CATALOGUE
from ncscope.channel.block import execute
from ncscope.channel.start import start_state
from ncscope.coordinates import (
    BASE_LEVEL,
    OFFSET_KINDS,
    ActiveKinematics,
    ActiveTool,
    Coordinates,
    Level,
    Offset,
)
from ncscope.diagnostics import Source
from ncscope.frames import Frame, sequence_rotation
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.language import iterate_blocks
from ncscope.machine import Machine

MACHINES = Path(__file__).parent.parent / "examples" / "machines"
HEADS = ("ca_head", "cb_head", "ac_table", "kin9_head", "compensated_head")
LOADED = {name: ncscope.load_machine(MACHINES / name)[0] for name in HEADS}
RELATIVE = 1e-9
quick = settings(max_examples=60, deadline=None)

lengths = st.floats(-1e4, 1e4, allow_nan=False).map(lambda v: round(v, 4))
angles = st.floats(-360, 360, allow_nan=False).map(lambda v: round(v, 4))


def vectors(n: int) -> st.SearchStrategy[tuple[float, ...]]:
    return st.tuples(*[lengths] * min(n, 3), *[angles] * (n - 3))


def kinematics_of(name: str) -> ActiveKinematics:
    machine = LOADED[name]
    model = UniversalKinematics.from_parameters(
        machine.kinematic_parameters[91], machine.axis_names, machine.settings.orientation_mode
    )
    return ActiveKinematics(model)


KINEMATICS = {name: kinematics_of(name) for name in HEADS}


@st.composite
def levels(draw: st.DrawFn, n: int) -> tuple[Level, ...]:
    chain = []
    for k in range(draw(st.integers(1, 4 if n >= 3 else 1))):
        level = BASE_LEVEL
        if k:
            turn = sequence_rotation(draw(st.tuples(angles, angles, angles)), "ZYX", False)
            shift = np.array(draw(st.tuples(lengths, lengths, lengths)))
            level = Level(f"#CS {k}", "#CS", Frame(f"level {k - 1}", f"level {k}", turn, shift))
        for kind in draw(st.lists(st.sampled_from(OFFSET_KINDS), unique=True, max_size=3)):
            offset = Offset(kind, draw(vectors(n)), (None,) * n, "here")
            level = level.with_offset(kind, offset)
        chain.append(level)
    return tuple(chain)


@st.composite
def coordinates(draw: st.DrawFn, kinematics: bool | None = None, axes: int = 1) -> Coordinates:
    with_kinematics = draw(st.booleans()) if kinematics is None else kinematics
    active = KINEMATICS[draw(st.sampled_from(HEADS))] if with_kinematics else None
    n = 5 if with_kinematics else draw(st.integers(axes, 6))
    tool = ActiveTool(
        draw(st.floats(0, 300)),
        draw(vectors(n)),
        draw(st.sampled_from([(0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])),
        draw(st.booleans()),
        "tool D1",
    )
    return Coordinates(n, draw(levels(n)), tool, active)


def programs(n: int, rows: int) -> st.SearchStrategy[np.ndarray]:
    return st.lists(vectors(n), min_size=rows, max_size=rows).map(np.array)


def assert_close(actual: np.ndarray, wanted: np.ndarray, size: float) -> None:
    scale = max(1.0, size, float(np.max(np.abs(wanted), initial=0.0)))
    np.testing.assert_allclose(actual, wanted, rtol=0, atol=RELATIVE * scale)


def size_of(c: Coordinates) -> float:
    """Length of the longest way through the chain: the scale of rounding."""
    ways = [np.abs(level.frame.shift).max() + np.abs(level.total(6 if c.axis_count > 6 else
            c.axis_count)).max() for level in c.levels]  # fmt: skip
    return float(sum(ways)) + 1e3


# --- the chain ---------------------------------------------------------------------------------


@quick
@given(st.data())
def test_program_to_axes_to_program(data: st.DataObject) -> None:
    c = data.draw(coordinates())
    program = data.draw(programs(c.axis_count, 2))
    axes = c.to_axes(program, near=np.zeros(c.axis_count))
    assert_close(c.to_program(axes), program, size_of(c))


@quick
@given(st.data())
def test_columns_equal_one_by_one(data: st.DataObject) -> None:
    c = data.draw(coordinates())
    program = data.draw(programs(c.axis_count, 5))
    near = np.zeros(c.axis_count)
    together = c.to_axes(program, near=near)
    single = np.array([c.to_axes(row, near=near) for row in program])
    assert together.shape == program.shape
    assert_close(together, single, size_of(c))


def four_by_four(level: Level, n: int) -> np.ndarray:
    """Level below from level values: frame after own offsets, written out as one matrix."""
    own = np.eye(4)
    for _, offset in level.offsets:
        own[: min(3, n), 3] += offset.values[: min(3, n)]
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = level.frame.rotation, level.frame.shift
    return frame @ own


@quick
@given(st.data())
def test_levels_compose_like_matrices(data: st.DataObject) -> None:
    n = data.draw(st.integers(3, 6))
    c = Coordinates(n, data.draw(levels(n)))
    (program,) = data.draw(programs(n, 1))
    product = np.eye(4)
    for level in c.levels:
        product = product @ four_by_four(level, n)
    wanted = product @ np.array([*program[:3], 1.0])
    assert_close(c.to_mcs(program)[:3], wanted[:3], size_of(c))
    rest = sum(np.array(o.values) for level in c.levels for _, o in level.offsets)
    if n > 3:
        assert_close(c.to_mcs(program)[3:], (program + rest)[3:], size_of(c))


@quick
@given(st.tuples(angles, angles, angles))
def test_rotation_is_z_then_y_then_x(turn: tuple[float, float, float]) -> None:
    """R = Rz(f3) Ry(f2) Rx(f1), written out here from the definition of #CS."""
    (a, b, g) = (math.radians(v) for v in turn)
    rx = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    ry = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    rz = np.array([[math.cos(g), -math.sin(g), 0], [math.sin(g), math.cos(g), 0], [0, 0, 1]])
    np.testing.assert_allclose(sequence_rotation(turn, "ZYX", False), rz @ ry @ rx, atol=1e-12)
    np.testing.assert_allclose(sequence_rotation(turn, "ZYX", True), rx @ ry @ rz, atol=1e-12)


@quick
@given(st.data())
def test_layers_add_up_to_the_axes(data: st.DataObject) -> None:
    c = data.draw(coordinates(axes=3))
    (program,) = data.draw(programs(c.axis_count, 1))
    near = np.zeros(c.axis_count)
    layers = c.layers(program, near=near)
    total = program + sum(layer.change for layer in layers)
    axes = c.to_axes(program, near=near)
    assert (layers[0].name, layers[-1].name) == ("programmed", "axes")
    assert_close(total, axes, size_of(c))
    assert_close(layers[-1].values, axes, size_of(c))
    for before, after in pairwise(layers):
        assert_close(before.values + after.change, after.values, size_of(c))


def test_coordinate_systems_need_three_main_axes() -> None:
    level = Level("a", "#CS", Frame("level 0", "level 1"))
    with pytest.raises(ValueError, match="three main axes"):
        Coordinates(2, (BASE_LEVEL, level))


@quick
@given(st.data())
def test_level_values_there_and_back(data: st.DataObject) -> None:
    c = data.draw(coordinates())
    (program,) = data.draw(programs(c.axis_count, 1))
    assert_close(c.program_from_level(c.level_from_program(program)), program, size_of(c))


# --- blocks and runs ---------------------------------------------------------------------------

GOOD = (
    "G00 X1 Y2", "G91 X5", "G90", "G54", "G55 X0", "G53", "G92 X3 Y-1", "#PSET X4", "#PRESET",
    "#CS ON [1,2,3,4,5,6]", "#CS OFF", "#CS DEF [2] [1,1,1]", "#CS ON [2]", "V.G.NP[1].V.X=7",
    "P1=3 XP1", "G70 X1", "G71", "G18", "G17", "V.G.WZ_AKT.L=4", "Z9", "#KIN ID [91]",
    "#TRAFO ON", "#TRAFO OFF", "C30 A10", "G01 F100 X2", "M30", "G91 G92 X1", "#CS OFF ALL",
)  # fmt: skip
BAD = (
    "X1 X2", "G90 G91", "G24", "Q4", "X[1/0]", "#CS DEF [1]", "#NOPE", "XP99", "G54 G55", "G92",
    "V.A.ABS.X=1", "G02 X1 I1", "D77", "G01 F0", "#SET AX [X,1,0] [X,2,1]", "G159=999",
    "P1=5 G54 X3 X[1/0]", "V.G.NP[1].V.X=1 G54 X9 Q3", "X1e400",
)  # fmt: skip
PIECES = (
    *GOOD, *BAD, "(", ")", "[", "]", '"', "#", "$", "%", "\\", "/", "/3", "N", "N10", "=", "@P1",
    "$IF 1", "$ENDIF", "$FOR P1=1,3,1", "#VAR", "#ENDVAR", "V.L.A[3]=[1,2]", "V.", "V.P.A=", "L x",
    "LL y", "#COMMENT BEGIN", "#COMMENT END", '#MSG SAVE ["%f %d", 1]', '#FILE NAME [MSG="a"]', ";",
    "X", "Y-", "Z+-1", "**", "SIN[", "\x00", "\xff", "\t", "\r", "99999999999999999999", "G", "M",
    "#CS ON [", "#SET AX [X,1,0] [Y,2,1]", "#CHANNEL INIT [CMDPOS]", "M02", "G0X1Y2Z3", "P[P1]=1",
)  # fmt: skip


@pytest.mark.parametrize("bad", BAD)
@settings(max_examples=8, deadline=None)
@given(lines=st.lists(st.sampled_from(GOOD[:-3]), max_size=5))
def test_error_leaves_the_state_as_before(bad: str, lines: list[str]) -> None:
    machine = LOADED["ca_head"]
    state = start_state(machine)
    source = Source("p.nc", "\n".join([*lines, "G90 G00", bad]) + "\n")
    last = None
    for block, found in iterate_blocks(source):
        last = (block, found)
        if block is None:
            continue
        step = execute(machine, state, block)
        if step.failed:
            assert step.state is state
            assert step.moves == () and step.messages == () and not step.ended
        state = step.state
    assert last is not None


@settings(max_examples=250, deadline=None)
@given(
    st.lists(
        st.lists(st.sampled_from(PIECES) | st.text(max_size=4), max_size=5).map(" ".join),
        max_size=12,
    ),
    st.sampled_from(["\n", "\r\n", " "]),
    st.sampled_from([None, *HEADS]),
    st.booleans(),
)
def test_run_never_raises(lines: list[str], end: str, name: str | None, strict: bool) -> None:
    machine = LOADED[name] if name else Machine()
    text = end.join(lines)
    result = ncscope.run(machine, text, ncscope.Options(strict=strict, max_blocks=100))
    stopped = [d for d in result.diagnostics if d.is_error or (strict and d.severity == "warning")]
    assert result.ok == (not stopped)
    columns = (result.pcs, result.wcs, result.mcs, result.acs)
    assert {c.shape for c in columns} == {(len(result), len(result.axes))}
    for d in result.diagnostics:
        assert d.id in CATALOGUE and ncscope.render(d)
        assert d.span is None or 0 <= d.span.start <= d.span.end <= len(text)
    for line in sorted({int(n) for n in result.line}):
        assert result.explain(line=line).layers


@settings(max_examples=60, deadline=None)
@given(st.lists(st.sampled_from(GOOD), max_size=12))
def test_run_twice_gives_the_same(lines: list[str]) -> None:
    text = "\n".join(lines) + "\n"
    one, two = (ncscope.run(LOADED["ca_head"], text) for _ in range(2))
    np.testing.assert_array_equal(one.acs, two.acs)
    assert one.diagnostics == two.diagnostics and one.messages == two.messages


@settings(max_examples=100, deadline=None)
@given(st.lists(st.sampled_from(GOOD), max_size=14))
def test_axes_of_a_run_follow_from_its_programmed_values(lines: list[str]) -> None:
    """For every move: explain ends at the axes that the run reports."""
    result = ncscope.run(LOADED["ca_head"], "\n".join(lines) + "\n")
    for i, line in enumerate(result.line.tolist()):
        layers = result.explain(line=line).layers
        np.testing.assert_allclose(layers[0].values, result.pcs[i], atol=1e-9)
        np.testing.assert_allclose(layers[-1].values, result.acs[i], atol=1e-6)
