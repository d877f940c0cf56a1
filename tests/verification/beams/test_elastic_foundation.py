"""A long beam on springs sinks under a force as the theory of beams on an elastic foundation says.

Problem: half of a beam of 400 × 4 × 4 mm, whose bottom is bedded on 12 kPa/m along its normal; 2 mN at its middle, 1 mN
of it on the modeled half. Neo-Hookean with 49.9 % Poisson's ratio.
Exact: deflection F β / (2 k b) at the force, with β = (k b / (4 E I))^(1/4), and F β e^(−βx) (cos βx + sin βx) /
(2 k b) at a distance x; the springs bear F.
Source: Hetényi 1946, Beams on Elastic Foundation, section 2.1.
Tolerance: 1.5 % of the largest deflection (shear, which the theory leaves out, adds 1.2 E/G (β h)² / 12 ≈ 0.4 %); 1e-6
for the force.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.places import NodesAt

LENGTH, WIDTH, BED, FORCE = 200e-3, 4e-3, 12e3, 2e-3


def test_a_beam_on_springs(record_verification):
    mesh = meshes.box((LENGTH, WIDTH, WIDTH), (24, 1, 1), kind=HEXAHEDRON)
    shear = problems.NEO_HOOKE.shear_modulus
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.supports.Foundation("z0", BED)]
    loads = [tg.loads.Force(NodesAt("line", edge=("x0", "z1")), (0, 0, -FORCE / 2))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, 500 * shear, supports)
    solution = problems.solve(tg.Model(mesh, model.materials, supports, loads), tg.Static(first_step=1.0, max_step=1.0))
    beta = (BED * WIDTH / (4 * 3 * shear * WIDTH**4 / 12)) ** 0.25
    x, sinks = mesh.points[mesh.face_nodes("z0"), 0], -solution.states[-1].displacement[mesh.face_nodes("z0"), 2]
    deepest = FORCE * beta / (2 * BED * WIDTH)
    exact = deepest * np.exp(-beta * x) * (np.cos(beta * x) + np.sin(beta * x))
    off = np.abs(sinks - exact).max() / deepest
    reaction = tg.measure(solution, "reaction", mesh_error=False).column("reaction")[-1]
    record_verification(
        "Beam on an elastic foundation: deflection at the force; largest error along the beam; force of the springs",
        "Hetényi 1946, section 2.1",
        f"{deepest * 1e3:.5g} mm; 0; {FORCE / 2:.6g} N",
        f"{sinks[x == 0].mean() * 1e3:.5g} mm; {100 * off:.2g} %; {reaction:.6g} N",
        "1.5 %, 1e-6",
    )
    assert off < 0.015
    assert reaction == pytest.approx(FORCE / 2, rel=1e-6)


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_turned_block_on_springs_moves_evenly(kind):
    """Springs alone hold the block: along a slope it moves by stress over the tangential stiffness, across it too."""
    turn = problems.rotation((0, 1, 0), np.radians(30))
    mesh = meshes.box((1.0, 1.0, 1.0), (1, 1, 1), lambda points: points @ turn.T, kind=kind)
    bed, pull = (4e3, 1e3), np.array([3.0, 1.0, 8.0])
    loads = [tg.Traction("z0", tuple(turn @ pull))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, [tg.supports.Foundation("z0", *bed)])
    solution = problems.solve(tg.Model(mesh, model.materials, model.supports, loads), tg.Static(tolerance=1e-10))
    moved = solution.states[-1].displacement @ turn
    assert moved == pytest.approx(np.tile(pull / (bed[1], bed[1], bed[0]), (len(moved), 1)), rel=1e-6)
    stored = tg.measure(solution, "strain_energy", mesh_error=False).column("strain_energy")[-1]
    assert stored == pytest.approx(0.5 * (9 / 1e3 + 1 / 1e3 + 64 / 4e3), rel=1e-6)
