"""A bar pulled between a face, an edge and a corner is stretched evenly, as one that hangs in space is.

Problem: box of 2 × 1 × 1, x = 0 fixed along x, the edge between x = 0 and z = 0 along z, the corner at the origin along
y; the face x = 2 moves out by 1. Neo-Hookean, incompressible; tetrahedra and hexahedra.
Exact: stretch λ = 1.5 along x, λ^(-1/2) across; force μ (λ − λ^-2) on the cross-section of 1; edge and corner carry
nothing.
Source: uniaxial tension of a neo-Hookean body, Holzapfel 2000, section 6.5.
Tolerance: 1e-9, since the elements hold linear fields exactly.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.supports import NodesAt

STRETCH = 1.5


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_bar_on_an_edge_and_a_corner_is_stretched_evenly(kind, record_verification):
    mesh = meshes.box((2.0, 1.0, 1.0), (3, 2, 2), kind=kind)
    supports = [
        tg.Fixed("x0", "x"),
        tg.Fixed(NodesAt("rim", edge=("x0", "z0")), "z"),
        tg.Fixed(NodesAt("corner", near=(0, 0, 0)), "y"),
        tg.Displacement("x1", (2 * (STRETCH - 1), 0, 0), "x"),
    ]
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, supports=supports)
    state = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12)).states[-1]
    exact = mesh.points * (np.array([STRETCH, STRETCH**-0.5, STRETCH**-0.5]) - 1)
    off = np.abs(state.displacement - exact).max()
    force = problems.NEO_HOOKE.shear_modulus * (STRETCH - STRETCH**-2)
    pull = state.nodal_force[mesh.face_nodes("x1"), 0].sum()
    idle = np.abs(state.nodal_force[:, 1:]).max() / force
    record_verification(
        f"Bar on an edge and a corner, {kind.name}s: largest error of position; force",
        "Holzapfel 2000, section 6.5",
        f"0; {force:.6g} N",
        f"{off:.1e}; {pull:.6g} N",
        "1e-9",
    )
    assert off < 1e-9
    assert pull == pytest.approx(force, rel=1e-9)
    assert idle < 1e-9
