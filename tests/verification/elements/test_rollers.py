"""A bar on rollers on slopes is stretched evenly, as one along the axes is.

Problem: box of 2 × 1 × 1, turned by 30° about y and by 20° about z, so that no face looks along an axis. The faces of
its three planes of symmetry are rollers; the end bears a traction along the turned axis. Neo-Hookean, incompressible.
Exact: stretch λ = 1.5 along the bar, λ^(-1/2) across; force μ (λ − λ^-2) on the cross-section of 1. The rollers
bear the traction, and nothing else.
Source: uniaxial tension of a neo-Hookean body, Holzapfel 2000, section 6.5.
Tolerance: 1e-9, since the elements hold linear fields exactly.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

STRETCH = 1.5
TURN = problems.rotation((0, 0, 1), np.radians(20)) @ problems.rotation((0, 1, 0), np.radians(30))
MU = problems.NEO_HOOKE.shear_modulus


def turned_bar(kind) -> tg.Mesh:
    return meshes.box((2.0, 1.0, 1.0), (3, 2, 2), lambda points: points @ TURN.T, kind=kind)


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_turned_bar_on_rollers_is_stretched_evenly(kind, record_verification):
    mesh, pull = turned_bar(kind), MU * (STRETCH - STRETCH**-2)
    supports = [tg.supports.Roller("x0"), tg.supports.Roller("y0"), tg.supports.Roller("z0", tuple(TURN[:, 2]))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, supports=supports)
    model = tg.Model(mesh, model.materials, supports, [tg.Traction("x1", tuple(pull * TURN[:, 0]))])
    solution = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12))
    state = solution.states[-1]
    stretches = TURN @ np.diag([STRETCH, STRETCH**-0.5, STRETCH**-0.5]) @ TURN.T
    off = np.abs(state.displacement - mesh.points @ (stretches - np.eye(3)).T).max()
    reaction = tg.measure(solution, "reaction", mesh_error=False).column("reaction")[-1]
    record_verification(
        f"Bar on rollers on slopes, {kind.name}s: largest error of position; reaction",
        "Holzapfel 2000, section 6.5",
        f"0; {pull:.6g} N",
        f"{off:.1e}; {reaction:.6g} N",
        "1e-9",
    )
    assert off < 1e-9
    assert reaction == pytest.approx(pull, rel=1e-8)


def test_a_face_that_slides_along_its_normal_stretches_the_bar_evenly(record_verification):
    turn, pull = problems.rotation((0, 1, 0), np.radians(30)), MU * (STRETCH - STRETCH**-2)
    mesh = meshes.box((2.0, 1.0, 1.0), (3, 2, 2), lambda points: points @ turn.T, kind=HEXAHEDRON)
    corner = tg.supports.NodesAt("corner", edge=("x0", "z0"))
    supports = [tg.supports.Roller("x0"), tg.Fixed("y0", "y"), tg.supports.Roller(corner, tuple(turn[:, 2]))]
    slide = tg.supports.Slide("x1", tuple(3 * turn[:, 0]), 2.0 * (STRETCH - 1))
    free = tg.supports.Slide("x1", tuple(turn[:, 0]), 1.0, history=((0, 0), (0.5, STRETCH - 1), (1, 2 * STRETCH - 2)))
    ends = []
    for moved in (slide, free):
        model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, supports=[*supports, moved])
        solution = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12))
        state = solution.states[-1]
        stretches = turn @ np.diag([STRETCH, STRETCH**-0.5, STRETCH**-0.5]) @ turn.T
        reaction = tg.measure(solution, "reaction", mesh_error=False).column("reaction")[-1]
        off = np.abs(state.displacement - mesh.points @ (stretches - np.eye(3)).T).max()
        work = tg.measure(solution, "outside_work", mesh_error=False).column("outside_work")[-1]
        ends.append((off, reaction, work))
    record_verification(
        "Bar with an end that slides along its normal: largest error of position; reaction of the other supports",
        "Holzapfel 2000, section 6.5",
        f"0; {pull:.6g} N",
        f"{ends[0][0]:.1e}; {ends[0][1]:.6g} N",
        "1e-9",
    )
    assert ends[0][0] < 1e-9 and ends[1][0] < 1e-9
    assert ends[0][1] == pytest.approx(pull, rel=1e-8) == ends[1][1]
    assert ends[0][2] < 0
