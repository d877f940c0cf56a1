"""A stiff sheet on hardly any rubber bends as Kirchhoff's plate, and keeps its bending stiffness with refinement.

Problem: square plate of 100 mm and 1 mm (E = 1 GPa, ν = 0.3) on a slab of 2 mm of very soft rubber, tetrahedra and
hexahedra, an even dead load that deflects the middle by 2 % of the thickness; a quarter is modeled. Its edges are
simply supported (the sides of the slab are held across the plate only) or clamped (they are held in all directions).
Also on a mesh whose lines are bent.
Exact: 0.00406235 q a⁴/D and 0.00126532 q a⁴/D (Timoshenko and Woinowsky-Krieger 1959, tables 8 and 35; series).
Tolerance: 1 % on 16 × 16 cells of the quarter on tetrahedra (2 % on bent lines) and 1.5 % on 8 × 8 hexahedra (3 %), and
each halving of the size divides the error by 3 at least (rate 1.58; the method is of second order). The rubber and the
finite deflection are 0.05 % together.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from sheets import rates, sheet, stiffness
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

A, SLAB, T, E = 0.1, 2e-3, 1e-3, 1e9
D = stiffness(E, T)
EXACT = {"simply supported": 0.00406235, "clamped": 0.00126532}


def _place(bent):
    def place(X):
        wave = bent * A * np.sin(4 * np.pi * X[:, 0] / A) * np.sin(4 * np.pi * X[:, 1] / A)
        return X + np.outer(wave, (1.0, -0.6, 0.0))

    return place


def _deflection(edges, cells, bent, kind):
    """Deflection of the middle over q a⁴/D."""
    mesh = meshes.box((A / 2, A / 2, SLAB), (cells, cells, 1), _place(bent), kind=kind)
    mesh = meshes.with_faces(mesh, symmetry_x=mesh.faces["x0"], symmetry_y=mesh.faces["y0"])
    held = "xyz" if edges == "clamped" else "z"
    load = 0.02 * T * D / A**4 / EXACT[edges]
    materials = {"body": problems.rubber(tg.laws.NeoHooke(C10=1e2)), "z0": sheet(E, T)}
    supports = [tg.Fixed("x1", held), tg.Fixed("y1", held)]
    model = tg.Model(mesh, materials, supports, [tg.Traction("z0", (0.0, 0.0, load))])
    state = problems.solve(model, tg.Static(first_step=1.0)).states[-1]
    return float(state.displacement[meshes.node_at(mesh, (0, 0, 0)), 2]) * D / load / A**4


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
@pytest.mark.parametrize(("edges", "bent"), [("simply supported", 0.0), ("clamped", 0.0), ("clamped", 0.03)])
def test_plate(edges, bent, kind, record_verification):
    counts, allowed = ((4, 8, 16), 0.01) if kind is TETRAHEDRON else ((2, 4, 8), 0.015)
    got = np.array([_deflection(edges, cells, bent, kind) for cells in counts])
    errors, allowed = got / EXACT[edges] - 1, 2 * allowed if bent else allowed
    record_verification(
        claim=f"{edges} plate, {kind.name}, {'bent' if bent else 'straight'} lines, {counts} cells: deflection",
        source="Kirchhoff",
        expected=EXACT[edges],
        got=got,
        tolerance=f"{allowed:.1%} ({counts[-1]} cells), rate 1.58",
    )
    assert abs(errors[-1]) < allowed
    assert rates(errors).min() > 1.58
