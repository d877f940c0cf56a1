"""Call the kernels that a model needs once on one cell, so that compilation happens at a known time."""

import numpy as np

from turgor.engine.algebra.pattern import build_pattern, cell_places, locate, scatter_add
from turgor.engine.cells import kernels, kernels_geometry, spectral
from turgor.engine.cells.element import DISPLACEMENT_DEGREE
from turgor.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell, reference_nodes, side_tables
from turgor.engine.faces import membranes, surfaces
from turgor.materials.laws.laws import StretchLaw
from turgor.meshing.cells import cell_type
from turgor.model.model import Model

#: Kernels that few models need: those of laws in stretches and of rubber that remembers, and those of membranes.
STRETCHES, SHEETS = "stretches", "sheets"


def needed_by(model: Model) -> frozenset[str]:
    """Return which of the kernels that few models need a model does."""
    materials = model.region_materials.values()
    stretched = any(
        isinstance(each.law, StretchLaw) or each.viscoelasticity is not None or each.stress_softening is not None
        for each in materials
    )
    return frozenset(({STRETCHES} if stretched else set()) | ({SHEETS} if model.membranes else set()))


def touch_kernels(nodes: int, mixed: bool = True, more: frozenset[str] = frozenset((STRETCHES, SHEETS))) -> None:
    """Call every kernel with the types that `turgor.engine.system.System` uses for cells of ``nodes`` nodes."""
    kind = cell_type(nodes)
    points = np.ascontiguousarray(reference_nodes(27 if nodes == 20 else nodes))[:nodes]
    shape, modes = (0,) * nodes, (0,) * kind.corners if mixed else ()
    cells = np.arange(nodes, dtype=np.int64)[None]
    mean = np.arange(len(modes), dtype=np.int64)[None]
    r = reference_cell(nodes, CELL_QUADRATURE_DEGREE if mixed else DISPLACEMENT_DEGREE[nodes])
    Jinv, dV = kernels_geometry.reference_geometry(shape, points, cells, r.dN, r.weights)
    u, p = np.zeros((nodes, 3)), np.zeros(len(modes))
    kernels_geometry.kinematics(shape, cells, u, r.dN, Jinv)
    F = kernels_geometry.deformation_gradients(shape, cells, u, r.dN, Jinv)
    if STRETCHES in more:
        bar, directions, scale = spectral.principal_stretches(F)
        one = np.ones((6, *dV.shape))
        spectral.spectral_response(bar, directions, scale, one[:3], one)
    rows = np.zeros(1, dtype=np.int64)
    W = np.ones((5, *dV.shape))
    compliance, penalty = np.ones(1), np.zeros((*dV.shape, 0))
    loops = kernels.Cells(shape, modes, cells, mean, r.dN, r.M, Jinv, dV, compliance, penalty)
    laws = kernels.Response(W, rows, np.zeros((1, *dV.shape[1:], 6)), np.zeros((1, *dV.shape[1:], spectral.TANGENT)))
    kernels.residual(loops, u, p, laws)
    kernels.extrapolated_stress(loops, u, p, u, p, laws)
    packed = kernels.tangent(loops, u, p, laws, np.zeros((1, 1, 6)), False)
    scatter_add(np.zeros(packed.size), np.arange(packed.size, dtype=np.int32), packed.ravel())
    sides = np.array(kind.sides[-1:], dtype=np.int64)
    r = side_tables(sides.shape[1])
    surfaces.pressure_forces(points, sides, r.N, r.dN, r.weights)
    surfaces.pressure_tangents(points, sides, r.N, r.dN, r.weights)
    if SHEETS in more:
        _touch_sheets(points, sides)


def touch_first_kernel() -> bool:
    """Call one small kernel; return whether it had to be compiled, as all others then will."""
    pattern = build_pattern(np.arange(3)[None], 3)
    cell_places(pattern, np.arange(3)[None])
    locate(pattern.indptr, pattern.indices, np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64))
    return bool(locate.stats.cache_misses)


def _touch_sheets(points: np.ndarray, sides: np.ndarray) -> None:
    gradients, areas = membranes.surface_gradients(points, sides)
    stress = membranes.membrane_stress(points, points, sides, gradients, areas, np.eye(3))
    membranes.membrane_forces(points, sides, gradients, areas, stress)
    membranes.membrane_tangents(points, sides, gradients, areas, np.zeros((*areas.shape, 3, 3)), stress)
