"""V24 for hexahedra and for cells without mean stress: tangent, rates, patch.

Problems: those of tetrahedra (`test_tangent`, `test_orders`, `test_patch`), on 27-node hexahedra with
mean stresses at their corners, and on the displacement formulation of tetrahedra and 20-node hexahedra.
Exact: the derivative of the residual; the chosen solution; a homogeneous deformation. Rates of the pair Q2/Q1:
displacement 3 in L², 2 in H¹, mean stress 2.
Tolerance: as for tetrahedra: 1e-6 of the largest entry, 0.25 below a rate, 1e-8 for what is exact.
"""

import numpy as np
import pytest
from chosen_solution import errors_of, manufactured

import meshes
import problems
import turgor as tg
from differences import difference
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import Ogden
from turgor.core.meshing.cells import HEXAHEDRON, HEXAHEDRON_20, TETRAHEDRON

SHEET = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e6, nu=0.3)), 5e-4)
LOADS = [tg.Pressure("z1", 4e4)]
CASES = {
    "27 nodes, mixed": (HEXAHEDRON, problems.YEOH, np.inf, "mixed"),
    "27 nodes, mixed, law in stretches": (HEXAHEDRON, Ogden(mu=(8e4, 2e3), alpha=(1.7, 5.0)), 1e6, "mixed"),
    "20 nodes, mixed": (HEXAHEDRON_20, problems.YEOH, np.inf, "mixed"),
    "27 nodes, displacement": (HEXAHEDRON, problems.YEOH, 1e6, "displacement"),
    "20 nodes, displacement": (HEXAHEDRON_20, tg.laws.MooneyRivlin(C10=1e4, C01=9e4), 1e6, "displacement"),
    "10 nodes, displacement": (TETRAHEDRON, problems.YEOH, 1e6, "displacement"),
}


@pytest.mark.parametrize("name", CASES)
def test_tangent_is_the_derivative_of_the_residual(name, record_verification):
    kind, law, kappa, formulation = CASES[name]
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1), lambda X: X + 3 * X[:, [1, 2, 0]] ** 2, kind=kind)
    materials = {"body": problems.rubber(law, kappa), "y1": SHEET}
    system = System(tg.Model(mesh, materials, [tg.Fixed("x0")], LOADS, formulation))
    rng = np.random.default_rng(17)
    X = mesh.points
    u = X @ (0.25 * rng.uniform(-1, 1, (3, 3))) + 10 * X[:, [2, 0, 1]] * X + rng.normal(0, 1e-4, X.shape)
    unknowns = np.concatenate([u.ravel() / system.length, rng.uniform(-1, 1, system.element.mean_count)])
    free = np.flatnonzero(~system.prescribed)
    exact = difference(system, unknowns)[np.ix_(free, free)]
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    record_verification(
        claim=f"tangent against differences of the residual, {name}: worst entry over the largest",
        source="V24",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6


def test_convergence_orders(record_verification):
    errors = np.array([errors_of(manufactured(count, HEXAHEDRON)) for count in (2, 4, 8)])
    rates = np.log2(errors[:-1] / errors[1:])
    record_verification(
        claim="manufactured solution, 27-node hexahedra, 4 to 8 cells a side: rate of u in L², u in H¹, mean stress",
        source="V24, theory of Taylor–Hood elements",
        expected=[3, 2, 2],
        got=rates[-1],
        tolerance="0.25 below",
    )
    assert (rates[-1] >= np.array([3, 2, 2]) - 0.25).all()
    assert errors[-1, 0] < 1e-3 * 0.2
    assert errors[-1, 2] < 1e-2


@pytest.mark.parametrize("name", ["27 nodes, mixed", "20 nodes, displacement", "10 nodes, displacement"])
def test_patch_of_distorted_cells_deforms_homogeneously(name, record_verification):
    kind, _, kappa, formulation = CASES[name]
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2), kind=kind)
    inside = int(np.linalg.norm(mesh.points - 0.5, axis=1).argmin())
    points = mesh.points.copy()
    points[inside] += [0.08, -0.06, 0.05]
    for k, (a, b) in enumerate(kind.edges):  # straight edges, so that a linear displacement stays in the space
        points[mesh.cells[:, kind.corners + k]] = (points[mesh.cells[:, a]] + points[mesh.cells[:, b]]) / 2
    if kind is HEXAHEDRON:
        for side, corners in zip(range(20, 26), (s[:4] for s in kind.sides), strict=True):
            points[mesh.cells[:, side]] = points[mesh.cells[:, list(corners)]].mean(axis=1)
        points[mesh.cells[:, 26]] = points[mesh.cells[:, :8]].mean(axis=1)
    mesh = meshes.with_points(mesh, points)
    F = np.array([[1.2, 0.1, 0.0], [0.05, 0.9, 0.02], [0.0, 0.03, 1.0]])
    F /= np.cbrt(np.linalg.det(F)) if formulation == "mixed" else 1.0

    def moved(X, load_factor):
        return X @ (load_factor * (F - np.eye(3))).T

    kappa = 1e6 if formulation == "displacement" else 1e5
    rubber = problems.rubber(problems.NEO_HOOKE, kappa)
    model = tg.Model(mesh, {"body": rubber}, [tg.Displacement("*", moved)], [], formulation)
    state = problems.solve(model, tg.Static(first_step=1.0, tolerance=1e-12)).states[-1]
    error = float(np.abs(state.displacement - moved(points, 1.0)).max())
    J = problems.fields(state).volume_ratio
    record_verification(
        claim=f"patch of distorted cells under a homogeneous deformation, {name}: largest error of the displacement",
        source="V01",
        expected=0.0,
        got=error,
        tolerance="1e-9",
    )
    assert error < 1e-9
    assert np.abs(J - np.linalg.det(F)).max() < 1e-8
