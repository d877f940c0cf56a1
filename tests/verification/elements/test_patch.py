"""V01.1: a homogeneous deformation of the boundary moves every interior node exactly with it.

Problem: unit cube of irregular cells (interior vertex moved by 0.15 in each direction; sides straight, or bent at
random), boundary displaced by a volume-preserving F̄; neo-Hookean and Yeoh, incompressible and with κ = 1000 μ.
Exact: interior nodes at F̄ X, uniform stress; with κ and F̄ = 1.01·1 the mean stress is κ (J − 1) = 1000 μ ·
0.030301.
Source: Irons' patch test.
Tolerance: 1e-10 of the cube's side for positions, 1e-8 for stress: the elements hold linear fields exactly, so only
round-off and the Newton tolerance of 1e-12 remain. With its whole boundary prescribed an incompressible body has no
mean stress to find (any constant will do), so there the top face is left free along its normal, which sets P₃₃ = 0
and does not change the exact answer.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg

MU = problems.NEO_HOOKE.shear_modulus
SHEARED = np.array([[1.2, 0.3, 0.0], [0.0, 1 / 1.2, 0.1], [0.0, 0.0, 1.0]])


def _path(load_factor):
    """A path of determinant 1 from rest to `SHEARED`."""
    stretch = 1 + 0.2 * load_factor
    return np.array([[stretch, 0.3 * load_factor, 0], [0, 1 / stretch, 0.1 * load_factor], [0, 0, 1]])


def _irregular_cube(bent):
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    inside = np.setdiff1d(np.arange(len(mesh.points)), meshes.surface(mesh))
    vertex = meshes.node_at(mesh, (0.5, 0.5, 0.5))
    points = mesh.points.copy()
    points[vertex] += 0.15
    for k, (a, b) in enumerate(meshes.TETRAHEDRON_EDGES):
        middle = mesh.cells[:, 4 + k]
        moved = np.isin(middle, inside)
        points[middle[moved]] = ((points[mesh.cells[:, a]] + points[mesh.cells[:, b]]) / 2)[moved]
    if bent:
        sides = inside[inside >= mesh.vertex_count]
        points[sides] += np.random.default_rng(5).uniform(-0.02, 0.02, (len(sides), 3))
    return meshes.with_points(mesh, points)


def _solve(bent, law, bulk_modulus, path):
    def moved(X, load_factor):
        return X @ (path(load_factor) - np.eye(3)).T

    if np.isfinite(bulk_modulus):
        supports = [tg.Displacement("*", moved)]
    else:
        supports = [tg.Displacement(face, moved) for face in ("x0", "x1", "y0", "y1", "z0")]
        supports.append(tg.Displacement("z1", moved, "xy"))
    model = problems.one_material(_irregular_cube(bent), law, bulk_modulus, supports=supports)
    return problems.solve(model, tg.Static(first_step=0.5, max_step=0.5, tolerance=1e-12)).states[-1]


def _exact_stress(law, bulk_modulus):
    """Cauchy stress at `SHEARED`: deviator of 2 W₁ B; mean stress κ (J − 1) = 0, or what makes P₃₃ = (σ F⁻ᵀ)₃₃ zero."""
    B = SHEARED @ SHEARED.T
    W1 = law.C10 + (2 * law.C20 * (np.trace(B) - 3) if isinstance(law, tg.Yeoh) else 0.0)
    deviator = 2 * W1 * (B - np.trace(B) / 3 * np.eye(3))
    if np.isfinite(bulk_modulus):
        return deviator
    inverse = np.linalg.inv(SHEARED).T
    return deviator - (deviator @ inverse)[2, 2] / inverse[2, 2] * np.eye(3)


@pytest.mark.parametrize("bent", [False, True])
@pytest.mark.parametrize("bulk_modulus", [np.inf, 1000 * MU])
@pytest.mark.parametrize("law", [problems.NEO_HOOKE, problems.YEOH])
def test_interior_follows_a_homogeneous_boundary(bent, bulk_modulus, law, record_verification):
    state = _solve(bent, law, bulk_modulus, _path)
    error = np.abs(problems.current(state) - state.model.mesh.points @ SHEARED.T).max()
    stress = problems.fields(state).cauchy / MU
    exact = _exact_stress(law, bulk_modulus) / MU
    record_verification(
        claim=f"patch test, {type(law).__name__}, {'bent' if bent else 'straight'} cells, κ/μ = {bulk_modulus / MU:g}: "
        "worst node over the side, worst stress over μ",
        source="V01, exact",
        expected=[0.0, 0.0],
        got=[float(error), float(np.abs(stress - exact).max())],
        tolerance="1e-10, 1e-8",
    )
    assert error < 1e-10
    assert np.abs(stress - exact).max() < 1e-8


@pytest.mark.parametrize("bent", [False, True])
def test_dilated_cube_carries_the_bulk_stress(bent, record_verification):
    kappa = 1000 * MU
    state = _solve(bent, problems.NEO_HOOKE, kappa, lambda t: (1 + 0.01 * t) * np.eye(3))
    stress = problems.fields(state).cauchy
    expected = kappa * 0.030301
    record_verification(
        claim=f"patch test, dilated by 1 %, {'bent' if bent else 'straight'} cells: Cauchy stress [Pa]",
        source="V01, κ (J − 1)",
        expected=expected,
        got=float(stress[..., 0, 0].mean()),
        tolerance="1e-8",
    )
    assert np.abs(stress - expected * np.eye(3)).max() < 1e-8 * expected
    assert state.mean_stress == pytest.approx(expected, rel=1e-8)
