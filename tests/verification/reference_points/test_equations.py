"""Linear equations between displacements: a periodic cell deforms evenly, a lever joins two bars, ties join two blocks.

Periodic cell: unit cube of irregular cells, neo-Hookean with κ = 50 μ. Each face follows the opposite one but for what
three corners are moved by. Exact: u = (F − 1) X of those corners, since the material is uniform; equations of edges
and corners follow from others and must drop out.
Lever: two bars of 1 × 1 × 1, neo-Hookean and incompressible. The top of one is pulled by F; it goes down by a half of
what the top of the other goes up. Exact: F = μ (λ − λ⁻²) − ½ μ (κ − κ⁻²) with κ = 1 − ½ (λ − 1), by virtual work.
Tied blocks: one block on another of larger cells, pulled. Exact: both are stretched as one, where the sides of one are
parts of those of the other; other sides give way a little, since nodes are tied and not the sides between them.
Tolerance: 1e-10 of the side for displacements and 1e-9 for the force; cells hold linear fields exactly. 2 % for tied
sides that are no parts of others.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON

MU = problems.NEO_HOOKE.shear_modulus
SHEARED = np.array([[1.2, 0.3, 0.0], [0.1, 0.9, 0.1], [0.0, 0.2, 1.1]])
CORNERS = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def _irregular_cube(kind):
    def skewed(points):
        wave = np.prod(np.sin(np.pi * points), axis=1)
        return points + 0.1 * wave[:, None] * [1.0, -0.5, 0.7]

    return meshes.box((1.0, 1.0, 1.0), (2, 2, 2), skewed, kind=kind)


def periodic(mesh: tg.Mesh, gradient) -> tg.Model:
    """A cell whose opposite faces follow each other; corners carry the gradient."""
    corners = {axis: tg.supports.NodesAt(f"corner_{axis}", near=at) for axis, at in CORNERS.items()}
    supports = [tg.Fixed(tg.supports.NodesAt("origin", near=(0, 0, 0)))]
    for axis, at in CORNERS.items():
        supports.append(tg.Displacement(corners[axis], tuple((gradient - np.eye(3)) @ at)))
        for along in "xyz":
            terms = [(f"{axis}1", along, 1.0), (f"{axis}0", along, -1.0), (corners[axis], along, -1.0)]
            supports.append(tg.supports.Equation(f"{axis}_{along}", terms))
    return problems.one_material(mesh, problems.NEO_HOOKE, 50 * MU, supports=supports)


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON], ids=["tetrahedra", "hexahedra"])
def test_a_uniform_periodic_cell_deforms_evenly(kind, record_verification):
    mesh = _irregular_cube(kind)
    solution = problems.solve(periodic(mesh, SHEARED), tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12))
    off = np.abs(solution.states[-1].displacement - mesh.points @ (SHEARED - np.eye(3)).T).max()
    record_verification(
        f"Periodic cell by linear equations, {kind.name}s: largest error of position",
        "uniform deformation",
        "0",
        f"{off:.1e}",
        "1e-10 of its side",
    )
    assert off < 1e-10


def test_a_lever_joins_two_bars(record_verification):
    boxes = [meshes.box((1.0, 1.0, 1.0), (1, 1, 1), lambda p, x=x: p + [x, 0, 0], kind=HEXAHEDRON) for x in (0.0, 3.0)]
    count = len(boxes[0].points)
    one, other = boxes
    vertices = np.r_[:8, count : count + 8]
    order = np.r_[vertices, np.setdiff1d(np.arange(2 * count), vertices)]
    number = np.argsort(order)
    faces = {f"{side}_a": number[face] for side, face in one.faces.items()}
    faces |= {f"{side}_b": number[face + count] for side, face in other.faces.items()}
    mesh = tg.Mesh(
        points=np.concatenate([one.points, other.points])[order],
        cells=number[np.concatenate([one.cells, other.cells + count])],
        regions={"body": np.arange(2)},
        faces=faces,
    )
    pull = 0.8 * MU
    a, b = (tg.supports.NodesAt(f"corner_{name}", near=(x, 0, 1)) for name, x in (("a", 0), ("b", 3)))
    supports = [tg.Fixed(f"{axis}0_{bar}", axis) for axis in "xyz" for bar in "ab"] + [
        tg.supports.Equation("plane_a", [("z1_a", "z", 1), (a, "z", -1)]),
        tg.supports.Equation("plane_b", [("z1_b", "z", 1), (b, "z", -1)]),
        tg.supports.Equation("lever", [(b, "z", 1), (a, "z", 0.5)]),
    ]
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, supports=supports)
    model = tg.Model(mesh, model.materials, supports, [tg.Traction("z1_a", (0, 0, pull))])
    state = problems.solve(model, tg.Static(tolerance=1e-12)).states[-1]
    top = state.displacement[mesh.face_nodes("z1_a"), 2]
    stretch, other_stretch = 1 + top[0], 1 - top[0] / 2
    force = MU * (stretch - stretch**-2) - 0.5 * MU * (other_stretch - other_stretch**-2)
    record_verification(
        "Two bars joined by a lever: force on the first", "virtual work", f"{pull:.6g} N", f"{force:.6g} N", "1e-9"
    )
    assert np.ptp(top) < 1e-12
    assert state.displacement[mesh.face_nodes("z1_b"), 2] == pytest.approx(-top[0] / 2, abs=1e-12)
    assert force == pytest.approx(pull, rel=1e-9)


def _two_blocks(coarse: int, fine: int) -> tg.Mesh:
    """Blocks of 1 × 1 × 1 on each other, the upper one of smaller cells."""
    lower = meshes.box((1.0, 1.0, 1.0), (coarse, coarse, 1), kind=HEXAHEDRON)
    upper = meshes.box((1.0, 1.0, 1.0), (fine, fine, 1), lambda points: points + [0, 0, 1.0], kind=HEXAHEDRON)
    return tg.bodies.together({"lower": lower, "upper": upper})


@pytest.mark.parametrize(
    ("coarse", "fine", "tolerance"), [(1, 2, 1e-10), (2, 3, 2e-2)], ids=["parts of sides", "other sides"]
)
def test_tied_blocks_of_other_cells_are_one_body(coarse, fine, tolerance, record_verification):
    mesh = _two_blocks(coarse, fine)
    held = [tg.Fixed(f"{axis}0_{body}", axis) for axis in "xy" for body in ("lower", "upper")]
    supports = [*held, tg.Fixed("z0_lower", "z"), tg.supports.Tied("z0_upper", "z1_lower")]
    rubber = problems.rubber(problems.NEO_HOOKE)
    load = tg.Traction("z1_upper", (0, 0, 0.8 * MU))
    model = tg.Model(mesh, dict.fromkeys(mesh.regions, rubber), supports, [load])
    state = problems.solve(model, tg.Static(tolerance=1e-12)).states[-1]
    stretch = 1 + state.displacement[mesh.face_nodes("z1_upper"), 2] / 2
    off = np.abs(MU * (stretch - stretch**-2) / (0.8 * MU) - 1).max()
    record_verification(
        f"Tied blocks, {fine} sides along an edge on {coarse}: force of the stretch",
        "uniaxial tension of one body",
        "1",
        f"1 ± {off:.1e}",
        f"{tolerance:g}",
    )
    assert off < tolerance
