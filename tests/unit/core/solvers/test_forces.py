"""Forces on faces: a total that is spread evenly, its mirror image, its history, and what is refused."""

import numpy as np
import pytest
from scipy.optimize import brentq
from turgor.loads import Force

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.solvers.checks.supports import check_supports
from turgor.units import mm

WIDTH, LENGTH = 4 * mm, 12 * mm


def bar(kind=HEXAHEDRON, mirrored=False):
    """A bar along x; its half is cut at y = 0."""
    size = (LENGTH, WIDTH / 2 if mirrored else WIDTH, WIDTH)
    made = meshes.box(size, (3, 1, 2), kind=kind)
    faces = {"symmetry_y" if name == "y0" and mirrored else name: sides for name, sides in made.faces.items()}
    return tg.Mesh(points=made.points, cells=made.cells, regions=made.regions, faces=faces)


def pulled(mesh, vector, history="ramp", supports=None):
    held = supports or [tg.Fixed("x0", "x"), tg.Fixed("z0", "z")]
    held += [] if "symmetry_y" in mesh.faces else [tg.Fixed("y0", "y")]
    more = {} if history == "ramp" else {"history": history}
    return problems.one_material(mesh, problems.NEO_HOOKE, supports=held, loads=[Force("x1", vector, **more)])


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=["hex", "tet"])
def test_a_bar_stretches_as_its_law_says(kind, mirrored):
    """Uniaxial tension: the nominal stress is the force over the whole area, 2 C10 (λ − 1/λ²)."""
    force = 1.5
    C10 = problems.NEO_HOOKE.C10
    exact = brentq(lambda x: 2 * C10 * (x - x**-2) * WIDTH**2 - force, 1, 5)
    state = problems.solve(pulled(bar(kind, mirrored), (force, 0, 0)), tg.Static(tolerance=1e-9)).states[-1]
    end = state.displacement[state.model.mesh.face_nodes("x1"), 0]
    assert exact > 1.1
    assert 1 + end / LENGTH == pytest.approx(exact, rel=1e-7)
    factor = state.model.mesh.symmetry_factor
    assert factor * problems.reaction(state, "x0")[0] == pytest.approx(-force, rel=1e-6)


def test_a_force_has_a_history():
    solution = problems.solve(pulled(bar(), (1.0, 0, 0), [(0, 0), (0.5, 1), (1, 0)]), tg.Static(tolerance=1e-9))
    middle, end = problems.state_at(solution, 0.5), solution.states[-1]
    assert problems.reaction(middle, "x0")[0] == pytest.approx(-1.0, rel=1e-6)
    assert np.abs(end.displacement).max() < 1e-6 * LENGTH


def test_a_force_across_the_mirror_plane_is_refused():
    with refused("force on 'x1'", "0.2 N along y", "'symmetry_y'"):
        pulled(bar(mirrored=True), (1.0, 0.2, 0))


def test_a_weight_across_the_mirror_plane_is_refused():
    heavy = tg.Material(name="rubber", law=problems.NEO_HOOKE, density=1e3)
    with refused("gravity", "-1 along y", "'symmetry_y'"):
        tg.Model(bar(mirrored=True), {"body": heavy}, [tg.Fixed("x0")], [tg.Gravity((0, -1, 0))])


def test_a_force_is_said_in_words():
    from turgor.views.report.describe import loads

    model = pulled(bar(), (0, 0, -0.05 * 9.80665))
    check_supports(model)
    assert loads(model) == ["Force (0, 0, -0.490333) N on x1, fixed in direction."]
    assert "Force(x1)" in repr(model)


@pytest.mark.parametrize(
    ("face", "vector", "facts"),
    [
        ("x7", (1, 0, 0), ("'x7'", "x0, x1, y0, y1, z0, z1")),
        ("x1", (1, 0), ("force on 'x1'", "(1, 0)", "three numbers")),
        ("x1", (np.nan, 0, 0), ("force on 'x1'", "nan", "in N")),
    ],
)
def test_what_is_no_force(face, vector, facts):
    with refused(*facts):
        problems.one_material(bar(), problems.NEO_HOOKE, supports=[tg.Fixed("x0")], loads=[Force(face, vector)])
