"""A cantilever bends under a force on the edge of its tip, and one on a box, as beam theory says.

Problem: beam of 100 × 4 × 4 mm, clamped at x = 0, with 0.2 mN down on the lower edge of its tip, on a box around the
tip, or on the face of the tip; neo-Hookean with 49.9 % Poisson's ratio.
Exact: deflection F L³ / (3 E I) + 1.2 F L / (G A); the force on the box and on the face is one load.
Source: Timoshenko and Gere 1972, section 7.7 (shear factor of a rectangle 6/5).
Tolerance: 2 % for the beam (the clamp hinders the cross-section), 6 % with one layer of tetrahedra; 1e-9 between box
and face; 0.5 % between edge and face, since the section at the tip is deformed where a line pushes.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.places import NodesAt

LENGTH, WIDTH, HEIGHT, FORCE = 100e-3, 4e-3, 4e-3, 0.2e-3

PLACES = {
    "edge": NodesAt("line", edge=("x1", "z0")),
    "box": NodesAt("end", box=((LENGTH, 0, 0), (LENGTH, WIDTH, HEIGHT))),
    "face": "x1",
}


def deflection(mesh: tg.Mesh, place: NodesAt | str) -> tuple[float, float]:
    """Mean deflection of the tip [m] and vertical reaction [N]."""
    loads = [tg.loads.Force(place, (0, 0, -FORCE))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, 500 * problems.NEO_HOOKE.shear_modulus, [tg.Fixed("x0")])
    model = tg.Model(mesh, model.materials, model.supports, loads)
    state = problems.solve(model, tg.Static(first_step=1.0, max_step=1.0, tolerance=1e-11)).states[-1]
    return -state.displacement[mesh.face_nodes("x1"), 2].mean(), problems.reaction(state, "x0")[2]


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_force_on_an_edge_bends_a_beam(kind, record_verification):
    mesh = meshes.box((LENGTH, WIDTH, HEIGHT), (12, 1, 1), kind=kind)
    shear = problems.NEO_HOOKE.shear_modulus
    exact = FORCE * LENGTH**3 / (3 * 3 * shear * WIDTH * HEIGHT**3 / 12)
    exact += 1.2 * FORCE * LENGTH / (shear * WIDTH * HEIGHT)
    tips = {name: deflection(mesh, place) for name, place in PLACES.items()}
    record_verification(
        f"Cantilever, force on the edge of its tip, {kind.name}s: deflection",
        "Timoshenko and Gere 1972, section 7.7",
        f"{exact * 1e3:.5g} mm",
        f"{tips['edge'][0] * 1e3:.5g} mm",
        "2 %" if kind is HEXAHEDRON else "6 %",
    )
    assert tips["edge"][0] == pytest.approx(exact, rel=0.02 if kind is HEXAHEDRON else 0.06)
    assert tips["edge"][0] == pytest.approx(tips["face"][0], rel=5e-3)
    assert tips["box"][0] == pytest.approx(tips["face"][0], rel=1e-9)
    assert [force for _, force in tips.values()] == pytest.approx([FORCE] * 3, rel=1e-8)


def test_forces_on_a_corner_and_on_one_of_two_images(record_verification):
    """A corner bears the whole force; of a half model each image bears a half of a total."""
    mesh = meshes.box((2.0, 1.0, 1.0), (2, 1, 1), kind=HEXAHEDRON)
    half = meshes.with_faces(mesh, symmetry_y=mesh.face("y0"))
    loads = [tg.loads.Force(NodesAt("corner", near=(2, 1, 1)), (0, 0, -3.0))]
    pulls = []
    for each in (mesh, half):
        model = problems.one_material(each, problems.NEO_HOOKE, np.inf, [tg.Fixed("x0")])
        state = problems.solve(tg.Model(each, model.materials, model.supports, loads)).states[-1]
        pulls.append(problems.reaction(state, "x0")[2])
    record_verification(
        "Force on a corner: reaction of the whole, and of the modeled half",
        "equilibrium",
        "3 N; 1.5 N",
        f"{pulls[0]:.6g} N; {pulls[1]:.6g} N",
        "1e-6",
    )
    assert pulls == pytest.approx([3.0, 1.5], rel=1e-6)
