"""The manufactured problem of V24: its solution, its body force, and the errors of a state."""

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.core.engine.cells.element import element_of
from turgor.core.engine.cells.reference import reference_cell
from turgor.core.meshing.cells import TETRAHEDRON

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
        mesh, tg.laws.NeoHooke(C10=MU / 2), supports=supports, loads=[tg.loads.BodyForce(_body_force)]
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
