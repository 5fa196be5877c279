"""Coordinate systems and stacks of the channel list: what is read, said and explained."""

from pathlib import Path

import numpy as np
import pytest

import ncscope
from ncscope.lists.document import ListDocument
from ncscope.lists.files import ListFile
from ncscope.lists.reading import machine_from_documents

CA_HEAD = Path(__file__).parents[2] / "examples" / "machines" / "ca_head" / "sda.lis"
SYSTEM = """coordinate_system.def[{i}].id {name}
coordinate_system.def[{i}].path[0].translation.t1 {t1}
coordinate_system.def[{i}].path[0].rotation.a3 {a3}
"""


def machine_of(text):
    return machine_from_documents([ListFile("channel", ListDocument.from_text(text, "sda.lis"))])


def system(i, name, t1=0, a3=0):
    return SYSTEM.format(i=i, name=name, t1=t1, a3=a3)


def test_values_are_mm_and_degrees():
    machine, found = machine_of(system(0, "plane", 12.5, -30) + system(1, 4, 1))
    assert found == ()
    assert machine.systems["plane"].values == (12.5, 0, 0, 0, 0, -30)
    assert (machine.systems["plane"].origin, machine.systems[4].origin) == (
        "sda.lis:1",
        "sda.lis:4",
    )


BAD = [
    ("two", system(0, "a") + system(1, "a", 5), "22163", 4, 29),
    ("long", system(0, "abcdefgh"), "110552", 1, 29),
    ("nameless", "coordinate_system.def[2].path[0].rotation.a1 5\n", "N3003", 1, 1),
    ("path", system(0, "a") + "coordinate_system.def[0].path[1].rotation.a1 5\n", "N3003", 4, 1),
    ("twice", "trafo_stack[0].name S\ntrafo_stack[1].name S\n", "22164", 2, 21),
    ("unnamed", "trafo_stack[0].kin_id[0] 91\n", "N3003", 1, 1),
    ("unknown", "trafo_stack[0].name S\ntrafo_stack[0].acs.id[0] b\n", "22166", 2, 26),
    ("start", "trafo_stack_name_active_prog_start S\n", "22169", 1, 36),
    ("plane", "mach_plane_of_2nd_ecs_ax XZ\n", "110552", 1, 26),
    ("axis", "kind_of_2nd_ecs_ax Z\n", "110552", 1, 20),
    ("sequence", "coordinate_system.rotation_sequence XXY\n", "22190", 1, 37),
]


@pytest.mark.parametrize("text,id,line,column", [b[1:] for b in BAD], ids=[b[0] for b in BAD])
def test_what_is_wrong_has_its_place(text, id, line, column):
    _, found = machine_of(text)
    assert [(d.id, d.line, d.column) for d in found] == [(id, line, column)]


def test_a_stack_has_at_most_ten_systems():
    names = "".join(
        f"trafo_stack[0].{group}.id[{k}] a\n" for group in ("bcs", "acs", "cs") for k in range(5)
    )
    machine, found = machine_of(system(0, "a") + "trafo_stack[0].name S\n" + names)
    assert [d.id for d in found] == ["22168"] * 5
    assert machine.stacks["S"].systems == (("#BCS", "a"),) * 5 + (("#ACS", "a"),) * 5


STACK = """trafo_stack[0].name S1
trafo_stack[0].kin_id[0] 91
trafo_stack[0].cs.id[0] up
trafo_stack[0].cs.id[1] down
trafo_stack[0].bcs.id[0] base
trafo_stack_name_active_prog_start S1
"""


def with_stack(extra=""):
    text = CA_HEAD.read_text().replace("Ende", "")
    text += system(0, "up", 5, 90) + system(1, "down", 7) + system(2, "base", 100, 20)
    machine, found = machine_of(text + STACK + extra)
    assert not [d for d in found if d.is_error]
    line = 1 + text.count("\n")
    return machine, line


def test_explain_shows_the_levels_of_the_list():
    machine, line = with_stack()
    result = ncscope.run(machine, "N10 X1 Y2 Z3 C30 A20\nM30\n").check()
    layers = result.explain(1).layers
    assert [(layer.name, layer.origin) for layer in layers[1:-1]] == [
        ("#CS down", f"sda.lis:{line - 6}"),
        ("#CS up", f"sda.lis:{line - 9}"),
        ("#BCS base", f"sda.lis:{line - 3}"),
        ("kinematics", f"sda.lis:{line + 5}"),
    ]
    total = layers[0].values + np.sum([layer.change for layer in layers], axis=0)
    assert total == pytest.approx(result.acs[0], abs=1e-9)
    # (1 + 7, 2) about Z by 90: (-2, 8) + (5, 0) = (3, 8); about Z by 20, + (100, 0)
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    assert layers[3].values[:3] == pytest.approx([100 + 3 * c - 8 * s, 3 * s + 8 * c, 3])


def test_the_stack_at_start_is_the_one_of_the_program():
    machine, _ = with_stack()
    other = "#TRAFO STACK OFF\n#TRAFO [91]\n#BCS ON [base]\n#CS ON [up]\n#CS ON [down]\n"
    motion = "X1 Y2 Z3 C30 A20\nX-4 Y7 Z1 C-10 A35\nM30\n"
    first = ncscope.run(machine, motion).check()
    for text in (other, "#TRAFO STACK ON [NAME=S1]\n"):
        assert ncscope.run(machine, text + motion).check().acs == pytest.approx(first.acs)


def test_a_stack_that_cannot_start_stops_the_run_at_the_list():
    machine, _ = machine_of(
        "trafo_stack[0].name S\ntrafo_stack[0].kin_id[0] 17\n"
        + "trafo_stack_name_active_prog_start S\n"
    )
    result = ncscope.run(machine, "X1\nM30\n")
    (error,) = [d for d in result.diagnostics if d.is_error]
    assert (len(result), error.file, error.line) == (0, "sda.lis", 3)
