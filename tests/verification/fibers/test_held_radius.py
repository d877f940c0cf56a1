"""V07: a tube whose outside is held radially stretches under pressure as if dense hoops held it; it is free to twist.

Problem: inner radius 6.35 mm, outer 8.35 mm, neo-Hookean (C10 = 0.12 MPa) and Yeoh (0.11, 0.02 MPa); a quarter of a
slice between two planes, stretched along the axis to λz while the outside is held with `Radial`, under the exact
pressure P.
Exact: the tube is at rest with closed ends where its wall carries the force P π a², with a² = B² − (B² − A²)/λz.
Twist: the whole tube, one end turned by 1 mrad: torque μ π (B⁴ − A⁴)/2 θ/h, which a tangential hold would raise.
Tolerance: 0.2 % of the axial force, 0.01 % of the inner radius; 0.5 % of the torque.
"""

import numpy as np
import pytest
import scipy.sparse
from hoops import INNER, LAW, OUTER, PRESSURE, STRETCH

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.model.supports import Displacement, Radial

HEIGHT = 2e-3
TESTED = (1.02, 1.05, 1.10, 1.30)  # λz


def _stretched(law, stretch, pressure, kind, count):
    """Axial force of the wall of the whole tube [N], and the inner radius [m]."""
    mesh = meshes.tube_sector(INNER, OUTER, HEIGHT, count, kind=kind)
    pull = Displacement("z1", lambda points, factor: np.full((len(points), 3), factor * (stretch - 1) * HEIGHT), "z")
    supports = [tg.Fixed("z0", "z"), pull, Radial("outside", axis=(0.0, 0.0, 1.0))]
    model = problems.one_material(mesh, law, supports=supports, loads=[tg.Pressure("cavity", pressure * problems.MPA)])
    state = problems.solve(model, tg.Static(first_step=0.5)).states[-1]
    moved = mesh.points + state.displacement
    assert np.linalg.norm(moved[mesh.face_nodes("outside"), :2], axis=1) == pytest.approx(OUTER, rel=1e-6)
    return 4 * float(problems.reaction(state, "z1")[2]), problems.mean_radius(state, "cavity", (0, 1))


@pytest.mark.parametrize(("kind", "count"), [(HEXAHEDRON, (2, 4, 1)), (TETRAHEDRON, (2, 4, 1))], ids=["hex", "tet"])
@pytest.mark.parametrize("name", LAW)
def test_axial_force_of_closed_ends(name, kind, count, record_verification):
    expected, radii, got = [], [], []
    for stretch in TESTED:
        pressure = PRESSURE[name][STRETCH.index(stretch)]
        inner = np.sqrt(OUTER**2 - (OUTER**2 - INNER**2) / stretch)
        expected.append(pressure * problems.MPA * np.pi * inner**2)
        force, radius = _stretched(LAW[name], stretch, pressure, kind, count)
        got.append(force)
        radii.append(radius / inner)
    record_verification(
        claim=f"tube with its outside held radially, {name}, {kind.name}: axial force that closes the ends [N]",
        source="V07, exact",
        expected=expected,
        got=got,
        tolerance="0.2 %",
    )
    assert radii == pytest.approx([1.0] * len(radii), rel=1e-4)
    assert got == pytest.approx(expected, rel=2e-3)


def _ring():
    def place(parameters):
        r, angle = INNER + (OUTER - INNER) * parameters[:, 0], 2 * np.pi * parameters[:, 1]
        return np.column_stack([r * np.cos(angle), r * np.sin(angle) + 3e-3, HEIGHT * parameters[:, 2]])

    names = {"x0": "cavity", "x1": "outside", "z0": "z0", "z1": "z1"}
    return meshes.glued([meshes.Block((1, 12, 1), place, names)], kind=HEXAHEDRON)


def test_a_radially_held_tube_twists_freely(record_verification):
    """The axis lies off the origin, so that its place is found from the face."""
    mesh, angle = _ring(), 1e-3

    def turn(points, factor):
        x, y = points[:, 0], points[:, 1] - 3e-3
        return factor * angle * np.column_stack([-y, x, np.zeros(len(x))])

    supports = [tg.Fixed("z0"), Displacement("z1", turn), Radial("outside", axis=(0.0, 0.0, 1.0))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[tg.Pressure("cavity", 0.0)])
    state = problems.solve(model, tg.Static(first_step=1.0)).states[-1]
    nodes = mesh.face_nodes("z1")
    arm, force = mesh.points[nodes] - [0, 3e-3, 0], state.nodal_force[nodes]
    torque = float((arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).sum())
    exact = problems.NEO_HOOKE.shear_modulus * np.pi / 2 * (OUTER**4 - INNER**4) * angle / HEIGHT
    claim = "tube held radially, turned by 1 mrad: torque [N m]"
    record_verification(claim, "V07, torsion of a tube", exact, torque, "0.5 %")
    assert torque == pytest.approx(exact, rel=5e-3)


def test_what_is_no_cylinder_cannot_be_held_radially():
    mesh = meshes.box((1e-3, 1e-3, 1e-3), (1, 1, 1))
    mesh = meshes.with_faces(mesh, sides=np.concatenate([mesh.face(n) for n in ("y0", "y1", "z0", "z1")]))
    model = problems.one_material(
        mesh, problems.NEO_HOOKE, supports=[tg.Fixed("x0"), Radial("sides")], loads=[tg.Pressure("x1", 1.0)]
    )
    with refused("'sides'", "0.104 mm", "radius 0.6036 mm"):
        tg.solve(model)


@pytest.mark.parametrize("kind", [HEXAHEDRON, TETRAHEDRON], ids=["hex", "tet"])
def test_the_tangent_is_turned_with_the_unknowns(kind, record_verification):
    """With pressure on one end only, which is open and has a skew part too."""
    mesh = meshes.tube_sector(INNER, OUTER, HEIGHT, (1, 2, 1), kind=kind)
    loads = [tg.Pressure("z1", 1e4)]
    held = [tg.Fixed("z0"), Radial("outside", axis=(0.0, 0.0, 1.0))]
    plain = System(problems.one_material(mesh, problems.NEO_HOOKE, supports=held[:1], loads=loads))
    turned = System(problems.one_material(mesh, problems.NEO_HOOKE, supports=held, loads=loads))
    rng = np.random.default_rng(5)
    unknowns = 0.02 * rng.standard_normal(plain.size)
    frames = prescribed_components(turned.model).frames
    assert len(frames.nodes) > 5
    local = unknowns.copy()
    local[: 3 * plain.node_count] = frames.to_local(unknowns[: 3 * plain.node_count].reshape(-1, 3)).ravel()
    turn = frames.turn_matrix(scipy.sparse.identity(plain.size, format="csc"))
    assert abs(turn - scipy.sparse.identity(plain.size)).max() < 1e-14  # A Aᵀ = 1
    expected = frames.turn_matrix(plain.tangent(unknowns, 1.0))
    got = turned.tangent(local, 1.0)
    worst = abs(got - expected).max() / abs(expected).max()
    claim = f"tangent in directions of a radial support against the plain one turned, {kind.name}: worst entry"
    record_verification(claim, "V07, exact", 0.0, worst, "1e-12 of the largest")
    assert worst < 1e-12
    assert abs(got - plain.tangent(unknowns, 1.0)).max() > 0.1 * abs(expected).max()
