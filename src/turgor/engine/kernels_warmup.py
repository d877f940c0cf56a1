"""Call every kernel once on one tetrahedron, so that compilation happens at a known time."""

import numpy as np

from turgor.engine import kernels, membranes, surfaces
from turgor.engine.pattern import build_pattern, locate, scatter_add
from turgor.engine.reference import (
    CELL_QUADRATURE_DEGREE,
    SURFACE_QUADRATURE_DEGREE,
    reference_cell,
    reference_nodes,
)


def touch_kernels() -> None:
    """Call every kernel with the argument types that `turgor.engine.system.System` uses."""
    points = np.ascontiguousarray(reference_nodes(3))
    cells = np.arange(10, dtype=np.int64)[None]
    r = reference_cell(3, CELL_QUADRATURE_DEGREE)
    Jinv, dV = kernels.reference_geometry(points, cells, r.dN, r.weights)
    u, p = np.zeros((10, 3)), np.zeros(4)
    kernels.kinematics(cells, u, r.dN, Jinv)
    kernels.deformation_gradients(cells, u, r.dN, Jinv)
    W = np.ones((5, *dV.shape))
    compliance = np.zeros(1)
    kernels.residual(cells, u, p, r.dN, r.M, Jinv, dV, W[0], W[1], compliance)
    kernels.extrapolated_stress(cells, u, p, u, p, r.dN, r.M, Jinv, W, compliance)
    packed = kernels.tangent(cells, u, p, r.dN, r.M, Jinv, dV, W, compliance, np.zeros((1, 1, 6)), False)
    rows, columns = np.tril_indices(kernels.UNKNOWNS)
    pattern = build_pattern(np.arange(kernels.UNKNOWNS)[None], kernels.UNKNOWNS)
    positions = locate(pattern.indptr, pattern.indices, rows, columns)
    scatter_add(np.zeros(len(pattern.indices)), positions, packed.ravel())
    _touch_surfaces(points)


def _touch_surfaces(points: np.ndarray) -> None:
    triangles = np.array([[0, 1, 2, 4, 5, 6]])
    r = reference_cell(2, SURFACE_QUADRATURE_DEGREE)
    surfaces.pressure_forces(points, triangles, r.N, r.dN, r.weights)
    surfaces.pressure_tangents(points, triangles, r.N, r.dN, r.weights)
    gradients, areas = membranes.surface_gradients(points, triangles)
    stress = membranes.membrane_stress(points, points, triangles, gradients, areas, np.eye(3))
    membranes.membrane_forces(points, triangles, gradients, areas, stress)
    membranes.membrane_tangents(points, triangles, gradients, areas, np.eye(3), stress)
