"""Call every kernel once on one tetrahedron, so that compilation happens at a known time."""

import numpy as np

from turgor.engine import kernels, membranes, spectral, surfaces
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
    F = kernels.deformation_gradients(cells, u, r.dN, Jinv)
    bar, directions, scale = spectral.principal_stretches(F)
    one = np.ones((6, *dV.shape))
    more, material = spectral.spectral_response(bar, directions, scale, one[:3].copy(), one)
    rows = np.zeros(1, dtype=np.int64)
    W = np.ones((5, *dV.shape))
    compliance = np.zeros(1)
    kernels.residual(cells, u, p, r.dN, r.M, Jinv, dV, W[0], W[1], rows, more, compliance)
    kernels.extrapolated_stress(cells, u, p, u, p, r.dN, r.M, Jinv, W, rows, more, material)
    packed = kernels.tangent(
        cells, u, p, r.dN, r.M, Jinv, dV, W, rows, more, material, compliance, np.zeros((1, 1, 6)), False
    )
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
