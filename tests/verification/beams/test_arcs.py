"""V12: slender beams by arc length and `Auto`: Euler's load as a bifurcation, the elastica beyond it, a snapping arch.

Problem: (a) a straight column under a dead force of 1.5 times Euler's load; (b) the same column bowed by 0.1 % of its
length as it buckles, under the force at which the tip of the elastica has turned by 100°; (c) half of a shallow clamped
arch under a dead force at its crown, which must find the same largest force as an arch whose crown is moved.
Reference: (a) π²EI/4L², where the square section makes two modes unstable at once, and the load goes on rising;
(b) inextensible elastica, elliptic integrals; (c) the reaction of the moved arch in steps of 0.02 mm.
Tolerance: (a) 1 % with 16 cells (1.3, 0.8 and 0.5 % with 10, 16 and 24), (b) 1 % of the deflection: few cells along a
slenderness of 100; (c) 2 %: a single point of the crown is moved, the force is spread. Load control steps over the top
of the arch to a branch whose top is 40 % higher.
"""

import re

import numpy as np
import pytest
from scipy.special import ellipk

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.auto import Auto

MM = problems.MM
LENGTH, SIDE = 100 * MM, 1 * MM
YOUNG = 6 * 0.12 * problems.MPA
EULER = np.pi**2 * YOUNG * SIDE**4 / 12 / (4 * LENGTH**2)
BOTH = pytest.mark.parametrize("procedure", [ArcLength(), Auto()], ids=["arc length", "auto"])

SPAN, RISE, THICK, PUSH = 60 * MM, 6 * MM, 1 * MM, 1.8e-3


def column(force, bow=0.0, cells=16):
    """A cantilever along x under an axial force [N] at its tip, bowed as it would buckle."""

    def place(points):
        return points + np.outer(bow * (1 - np.cos(np.pi * points[:, 0] / (2 * LENGTH))), [0, 0, 1])

    mesh = meshes.box((LENGTH, SIDE, SIDE), (cells, 1, 1), place, kind=HEXAHEDRON)
    loads = [tg.Traction("x1", (-force / SIDE**2, 0.0, 0.0))]
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=loads)


@BOTH
def test_a_straight_column_passes_a_bifurcation_at_eulers_load(procedure, record_verification):
    solution = problems.solve(column(1.5 * EULER), procedure)
    (factor, modes) = re.findall(r"Bifurcation: at load factor ([\d.]+), where (\d) modes become", solution.message)[0]
    record_verification(
        claim=f"straight column by {type(procedure).__name__}: load at the bifurcation over Euler's",
        source="V12, Euler",
        expected=1.0,
        got=1.5 * float(factor),
        tolerance="1 %",
    )
    assert solution.converged
    assert not solution.limit_points
    assert 1.5 * float(factor) == pytest.approx(1.0, rel=0.01)
    assert modes == "2"
    assert "branch = 1 of arc_length" in solution.advice


@BOTH
def test_a_bowed_column_becomes_an_elastica_in_few_arcs(procedure, record_verification):
    m = np.sin(np.deg2rad(50)) ** 2
    ratio, expected = (2 * ellipk(m) / np.pi) ** 2, 2 * np.sqrt(m) / ellipk(m)
    solution = problems.solve(column(ratio * EULER, 1e-3 * LENGTH, cells=24), procedure)
    last = solution.states[-1]
    got = last.displacement[last.model.mesh.face_nodes("x1"), 2].mean() / LENGTH
    record_verification(
        claim=f"bowed column by {type(procedure).__name__}: deflection of the tip over the length",
        source="V12, elastica",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert solution.converged
    assert got == pytest.approx(expected, rel=0.01)
    assert not any(state.unstable_modes for state in solution.states)
    assert "Bifurcation" not in solution.message
    assert len(solution.steps) < 80  # in the scale of the first step it would be a thousand


def arch(moved=None):
    """Half of a clamped arch of two millimeters' width; a force at its crown, or the crown moved down [m]."""

    def place(points):
        return points + np.outer(RISE * 0.5 * (1 + np.cos(2 * np.pi * points[:, 0] / SPAN)), [0, 0, 1])

    mesh = meshes.box((SPAN / 2, 2 * MM, THICK), (12, 1, 1), place, kind=HEXAHEDRON)
    names = {"x0": "symmetry_x", "y0": "symmetry_y"}
    faces = {names.get(name, name): sides for name, sides in mesh.faces.items()}
    faces["crown"] = meshes.single_node(meshes.node_at(mesh, (0, 0, RISE + THICK / 2)), 9)
    mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=mesh.regions, faces=faces)
    if moved is None:
        load = tg.Traction("symmetry_x", (0.0, 0.0, -PUSH / (2 * THICK * MM)))
        return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x1")], loads=[load])
    down = tg.Displacement("crown", lambda points, s: np.tile([0.0, 0.0, -moved * s], (len(points), 1)), "z")
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x1"), down])


@pytest.fixture(scope="module")
def largest_force():
    """Largest force of the moved arch [N]."""
    steps = tg.Static(first_step=0.01, max_step=0.01)
    forces = [-problems.reaction(state, "crown")[2] for state in problems.solve(arch(2 * MM), steps).states]
    assert 0 < int(np.argmax(forces)) < len(forces) - 1
    return max(forces)


@BOTH
def test_an_arch_turns_where_its_moved_crown_says(procedure, largest_force, record_verification):
    solution = problems.solve(arch(), procedure)
    limit = solution.limit_points[0]
    factors = [state.load_factor for state in solution.states]
    record_verification(
        claim=f"shallow arch by {type(procedure).__name__}: largest force [mN]",
        source="V12, moved crown",
        expected=1e3 * largest_force,
        got=1e3 * PUSH * limit.load_factor,
        tolerance="2 %",
    )
    assert limit.kind == "maximum"
    assert max(factors) == limit.load_factor
    assert PUSH * limit.load_factor == pytest.approx(largest_force, rel=0.02)
    assert [state.unstable_modes for state in solution.states[1 : limit.state]] == [0] * (limit.state - 1)
    assert {state.unstable_modes for state in solution.states[limit.state + 1 :]} == {1}
    assert "Bifurcation" not in solution.message
