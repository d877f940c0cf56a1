"""V24: with the right body force the discrete solution tends to a chosen one, at the rates of the element.

Problem: plane strain unit square (one layer of cells between frictionless walls), incompressible neo-Hookean,
chosen solution x = X + A sin(kY), y = Y (volume-preserving), A = 0.2, k = π, multiplier p = −μ + p₀ cos(πX/2)
cos(πY) with p₀ = μ/2. The table prescribes the whole boundary, which leaves the mean stress of an incompressible
body open by a constant; here p is chosen so that the normal traction at X = 1 vanishes and that side is free along
x, which fixes the constant.
Exact: body force of the table, B_X = μ A k² sin kY − p,X, B_Y = A k cos kY p,X − p,Y; our mean stress, which
belongs to Ī₁, is p + μ I₁/3 with I₁ = 3 + A² k² cos² kY.
Source: method of manufactured solutions, table V24. Expected rates of Taylor–Hood: displacement 3 in L², 2 in H¹,
mean stress 2.
Tolerance: a rate may be 0.25 below the theoretical one on the last halving, because meshes of 4 to 16 cells are not
yet at the limit, and the errors themselves must be small (1e-3 of A, 1 % of μ).
"""

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.engine.cells.element import element_of
from turgor.engine.cells.reference import reference_cell
from turgor.meshing.cells import TETRAHEDRON

A, K, MU = 0.2, np.pi, 1.0e5
P0 = MU / 2


def _multiplier(X):
    return -MU + P0 * np.cos(np.pi * X[..., 0] / 2) * np.cos(np.pi * X[..., 1])


def _body_force(X):
    p_x = -P0 * np.pi / 2 * np.sin(np.pi * X[:, 0] / 2) * np.cos(np.pi * X[:, 1])
    p_y = -P0 * np.pi * np.cos(np.pi * X[:, 0] / 2) * np.sin(np.pi * X[:, 1])
    first = MU * A * K**2 * np.sin(K * X[:, 1]) - p_x
    second = A * K * np.cos(K * X[:, 1]) * p_x - p_y
    return np.column_stack([first, second, 0 * first])


def _displacement(X):
    return np.stack([A * np.sin(K * X[..., 1]), 0 * X[..., 0], 0 * X[..., 0]], axis=-1)


def _mean_stress(X):
    return _multiplier(X) + MU / 3 * (3 + (A * K * np.cos(K * X[..., 1])) ** 2)


def manufactured(count, kind=TETRAHEDRON):
    """State of the manufactured problem on ``count`` cells a side."""
    mesh = meshes.box((1.0, 1.0, 1 / count), (count, count, 1), kind=kind)

    def moved(X, load_factor):
        return load_factor * _displacement(X)

    supports = [tg.Displacement(side, moved, "xy") for side in ("x0", "y0", "y1")]
    supports += [tg.Displacement("x1", moved, "y"), *problems.PLANE_STRAIN]
    model = problems.one_material(
        mesh, tg.laws.NeoHooke(C10=MU / 2), supports=supports, loads=[tg.BodyForce(_body_force)]
    )
    return problems.solve(model, tg.Static(first_step=0.25, tolerance=1e-10)).states[-1]


def errors_of(state):
    """L² and H¹ norms of the displacement error, L² norm of the mean stress error, per unit of the area."""
    mesh = state.model.mesh
    rule = reference_cell(mesh.cells.shape[1], 6)
    corners = mesh.points[mesh.cells]
    X = np.einsum("qa,cai->cqi", rule.N, corners)
    jacobian = np.einsum("cai,qaj->cqij", corners, rule.dN)
    weight = np.linalg.det(jacobian) * rule.weights
    gradient = np.einsum("qaj,cqji->cqai", rule.dN, np.linalg.inv(jacobian))
    u = state.displacement[mesh.cells]
    H = np.einsum("cai,cqaj->cqij", u, gradient)
    exact_H = np.zeros_like(H)
    exact_H[..., 0, 1] = A * K * np.cos(K * X[..., 1])
    p = np.einsum("qm,cm->cq", rule.M, state.mean_stress[element_of(state.model).mean])
    squares = (
        ((np.einsum("qa,cai->cqi", rule.N, u) - _displacement(X)) ** 2).sum(axis=-1),
        ((H - exact_H) ** 2).sum(axis=(-2, -1)),
        (p - _mean_stress(X)) ** 2 / MU**2,
    )
    return np.sqrt([float((weight * square).sum() / weight.sum()) for square in squares])


def test_convergence_orders(record_verification):
    errors = np.array([errors_of(manufactured(count)) for count in (4, 8, 16)])
    rates = np.log2(errors[:-1] / errors[1:])
    record_verification(
        claim="manufactured solution, 8 to 16 cells a side: rate of u in L², u in H¹, mean stress in L²",
        source="V24, theory of Taylor–Hood elements",
        expected=[3, 2, 2],
        got=rates[-1],
        tolerance="0.25 below",
    )
    record_verification(
        claim="manufactured solution, 16 cells: L² error of u over A, of ∇u, of the mean stress over μ",
        source="V24, exact",
        expected=[0.0, 0.0, 0.0],
        got=errors[-1] / [A, 1, 1],
        tolerance="1e-3, 1e-2, 1e-2",
    )
    assert (rates[-1] > [2.75, 1.75, 1.75]).all()
    assert (errors[-1] < [1e-3 * A, 1e-2, 1e-2]).all()
