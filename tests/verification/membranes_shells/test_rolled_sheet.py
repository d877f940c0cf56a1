"""A shell is rolled up to a circle, on both kinds of cells alike, and bends as the elastica under a dead load.

Problem: strip of 50 mm, a sheet on a slab of 0.25 mm of very soft rubber, clamped at one end. (a) Sheet of 0.2 mm with
ν = 0; a rigid plate at the other end turns by 360° and may move. (b) Sheet of 0.1 mm with ν = 0.3 in plane strain, with
a dead load along it, up to 20 D/L³.
Exact: (a) the moment 2π D/L, all of the sheet on a circle through its clamp, energy ½ D (2π)²/L; (b) the inextensible
elastica, of which `test_elastica` has the numbers. Source: theory of rods.
Tolerance: moment 0.5 % and radius 0.1 % with 40 cells, where each bends by 9°, and at least
second order on tetrahedra; 0.1 % with 20 hexahedra, which bend by 18° each; the tip of (b) 1 %.
"""

import numpy as np
import pytest
from turgor.supports import ReferencePoint, Rotation

import meshes
import problems
import turgor as tg
from sheets import rates, sheet, stiffness
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

L, SLAB, TURN = 50e-3, 0.25e-3, 2 * np.pi
#: Load over D/L³, and how far the tip moves along and across over the length: table of `test_elastica`.
DEAD_LOAD = ((1, -0.008754, 0.123471), (5, -0.153343, 0.495905), (20, -0.554768, 0.829881))


def _rolled(cells, kind=TETRAHEDRON):
    """Moment and energy over those of the circle, and the least and the largest radius over its own."""
    width, D = L / cells, stiffness(1e8, 0.2e-3, nu=0.0)
    mesh = meshes.box((L, SLAB, width), (cells, 1, 1), kind=kind)
    plate = [ReferencePoint("plate", "x1", coupling="rigid"), Rotation("plate", TURN, (0, 0, 1))]
    materials = {"body": problems.rubber(tg.laws.NeoHooke(C10=250.0)), "y0": sheet(1e8, 0.2e-3, nu=0.0)}
    alone = tg.Contact(self_contact=False)
    model = tg.Model(mesh, materials, [tg.Fixed("x0"), *plate], [], contact=alone)
    state = problems.solve(model, tg.Static(first_step=0.05)).states[-1]
    radius, at = L / TURN, problems.current(state)[mesh.face_nodes("y0")]
    result = np.linalg.norm(at[:, :2] - (0, radius), axis=1) / radius
    moment = state.points["plate"].moment[2] / (D * TURN / L * width)
    return moment, problems.energy(state) / (0.5 * D * TURN**2 / L * width), result.min(), result.max()


def test_a_sheet_is_rolled_to_a_circle(record_verification):
    got = np.array([_rolled(cells) for cells in (10, 20, 40)])
    record_verification(
        claim="sheet on tetrahedra rolled to a circle, 10, 20, 40 cells: moment over the exact one",
        source="theory of rods",
        expected=1.0,
        got=got[:, 0],
        tolerance="0.5 % (40 cells), rate 2",
    )
    assert got[-1, :2] == pytest.approx([1.0, 1.0], abs=5e-3)
    assert got[-1, 2:] == pytest.approx([1.0, 1.0], abs=1e-3)
    assert rates(got[:, 0] - 1).min() > 2


def test_hexahedra_are_rolled_to_the_same_circle(record_verification):
    got = np.array(_rolled(20, HEXAHEDRON))
    record_verification(
        claim="sheet on hexahedra rolled to a circle, 20 cells: moment over the exact one",
        source="theory of rods",
        expected=1.0,
        got=got[0],
        tolerance="0.1 %",
    )
    assert got == pytest.approx(np.ones(4), abs=1e-3)


def test_a_sheet_under_a_dead_load_is_an_elastica(record_verification):
    cells, D, top = 40, stiffness(1e9, 0.1e-3), DEAD_LOAD[-1][0]
    mesh = meshes.box((L, SLAB, L / cells), (cells, 1, 1))
    materials = {"body": problems.rubber(tg.laws.NeoHooke(C10=100.0)), "y0": sheet(1e9, 0.1e-3)}
    load = [tg.Traction("y0", (0.0, top * D / L**3, 0.0))]
    model = tg.Model(mesh, materials, [tg.Fixed("x0"), *problems.PLANE_STRAIN], load)
    at = tuple(row[0] / top for row in DEAD_LOAD)
    solution = problems.solve(model, tg.Static(first_step=at[0], at=at))
    tip = meshes.node_at(mesh, (L, 0, 0))
    got = np.array([problems.state_at(solution, factor).displacement[tip, :2] / L for factor in at])
    expected = np.array(DEAD_LOAD)[:, 1:]
    record_verification(
        claim="sheet on tetrahedra, dead loads of 1, 5, 20 D/L³: tip (x, y) over the length",
        source="elastica",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert (np.linalg.norm(got - expected, axis=1) < 0.01 * np.linalg.norm(expected, axis=1)).all()
