"""Linear equations in .inp files: with moved nodes, with middles that files lack, and independent ones in a chain."""

import re

import numpy as np
import pytest
from lattice_cases import KINDS, lattice
from turgor.supports import Displacement, Equation, Fixed, NodesAt, ReferencePoint, Roller

import turgor as tg
from refused import refused
from turgor.core.inp.write_inp import write_inp

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6), bulk_modulus=0.6e6, density=1000.0)
MESH = lattice((2, 1, 1), KINDS["hex"])
UP, LOW, SIDE = (
    NodesAt(name, near=(x, y, z)) for name, x, y, z in [("up", 1, 1, 1), ("low", 1, 0, 0), ("side", 1, 1, 0)]
)
MIDDLE = NodesAt("middle", near=tuple(MESH.points[MESH.face("x1")[0, 8]]))


def written(folder, *supports, loads=()):
    write_inp(tg.Model(MESH, RUBBER, ["x0", *supports], list(loads)), folder / "a.inp")
    return (folder / "a.inp").read_text(encoding="ascii")


def equations(text: str) -> list[dict[tuple[int, int], float]]:
    """Factors of each equation by node and axis."""
    out = []
    for count, lines in re.findall(r"\*EQUATION\n(\d+)\n((?:\d+, \d, \S+\n)+)", text):
        terms = [line.split(", ") for line in lines.splitlines()]
        assert len(terms) == int(count)
        out.append({(int(node) - 1, int(axis) - 1): float(factor) for node, axis, factor in terms})
    return out


def node(place: NodesAt) -> int:
    return int(place.nodes(MESH)[0])


def test_a_moved_node_stays_in_its_equation_and_is_not_eliminated(tmp_path):
    tie = Equation("tie", [(LOW, "x", 1), (UP, "x", -1)])
    text = written(tmp_path, Displacement(LOW, (1e-3, 0, 0), "x"), tie)
    (terms,) = equations(text)
    assert list(terms.items()) == [((node(UP), 0), 1.0), ((node(LOW), 0), -1.0)]


def test_a_middle_that_the_file_lacks_is_a_sum_of_its_side(tmp_path):
    (terms,) = equations(written(tmp_path, Equation("tie", [(UP, "y", 1), (MIDDLE, "y", -1)])))
    field = MESH.points @ [0.3, -0.2, 0.7]  # a linear one is that of the middle, too
    assert sum(value * field[row] for (row, _), value in terms.items()) * terms[node(UP), 1] ** -1 == pytest.approx(
        (field[node(UP)] - field[node(MIDDLE)]) / 1.25
    )
    assert {row for row, _ in terms} == set(MESH.face("x1")[0, :8].tolist())


def test_independent_equations_of_the_same_nodes_are_all_written(tmp_path):
    pairs = [(UP, LOW, 1), (LOW, SIDE, 1), (UP, LOW, 2)]
    chain = [Equation(f"{k}", [(one, "x", 1), (other, "x", by)]) for k, (one, other, by) in enumerate(pairs)]
    text = written(tmp_path, *chain)
    rows = set(re.search(r"\*BOUNDARY\n((?:.*\n)+?)\*", text)[1].splitlines())
    assert {f"{node(each) + 1}, 1" for each in (UP, LOW, SIDE)} <= rows  # together they fix all three
    assert not equations(text)


def test_no_component_is_eliminated_twice(tmp_path):
    text = written(tmp_path, Roller(UP, (1, 0, 1)), Equation("tie", [(UP, "x", 1), (LOW, "z", 0.3)]))
    firsts = re.findall(r"\*EQUATION\n\d\n(\d+, \d), ", text)
    assert len(firsts) == 2
    assert len(set(firsts)) == 2
    with refused("equation 'tie'", "rigid faces"):
        written(tmp_path, ReferencePoint("plate", "x1"), Equation("tie", [(UP, "x", 1), (LOW, "z", 0.3)]))


@pytest.mark.parametrize("support", [Fixed(MIDDLE), Displacement(MIDDLE, (1e-3, 0, 0)), Roller(MIDDLE, (1, 1, 0))])
def test_a_support_of_a_middle_alone_is_refused(tmp_path, support):
    with refused("'middle'", "20 nodes"):
        written(tmp_path, support, loads=[tg.Pressure("x1", 1e3)])


def test_a_force_is_spread_over_nodes_of_the_file(tmp_path):
    low, high = np.array([1, 0.4, 0.4]), np.array([1.01, 1.01, 1.01])
    text = written(tmp_path, loads=[tg.loads.Force(NodesAt("quarter", box=(low, high)), (1.0, 0, 0))])
    rows = re.search(r"\*CLOAD.*\n((?:\d.*\n)+)", text)[1].splitlines()
    assert {int(row.split(",")[0]) - 1 for row in rows} <= set(MESH.cells[:, :20].ravel().tolist())
