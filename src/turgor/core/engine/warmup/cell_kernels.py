"""Call the kernels of cells, pressure and membranes once on one cell, so that they are compiled at a known time.

The types are those with which `turgor.core.engine.system.System` calls them.
"""

import numpy as np

from turgor.core.engine.algebra.pattern import build_pattern, cell_places, locate, scatter_add
from turgor.core.engine.cells import kernels, kernels_geometry, kernels_tangent, spectral
from turgor.core.engine.cells.element import DISPLACEMENT_DEGREE
from turgor.core.engine.cells.reference import CELL_QUADRATURE_DEGREE, reference_cell, reference_nodes, side_tables
from turgor.core.engine.faces import membranes, surfaces
from turgor.core.meshing.cells import cell_type

Array = np.ndarray


def compile_pattern() -> None:
    """Compile the kernels of the sparsity pattern."""
    pattern = build_pattern(np.arange(3)[None], 3)
    cell_places(pattern, np.arange(3)[None])
    locate(pattern.indptr, pattern.indices, np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64))
    scatter_add(np.zeros(1), np.zeros(1, dtype=np.int32), np.ones(1))


def compile_tangent(nodes: int, mixed: bool) -> None:
    """Compile the kernel of element tangents."""
    loops, u, p, laws = _cell(nodes, mixed)
    kernels_tangent.tangent(loops, u, p, laws, np.zeros((1, 1, 6)), False)


def compile_updates(nodes: int, mixed: bool) -> None:
    """Compile the kernel that extrapolates the stress of elements to a new iterate."""
    loops, u, p, laws = _cell(nodes, mixed)
    kernels.extrapolated_stress(loops, u, p, u, p, laws)


def compile_residual(nodes: int, mixed: bool) -> None:
    """Compile the kernel of element residuals."""
    loops, u, p, laws = _cell(nodes, mixed)
    kernels.residual(loops, u, p, laws)


def compile_geometry(nodes: int, mixed: bool) -> None:
    """Compile the kernels of the reference geometry and of the invariants."""
    points, cells = _one_cell(nodes)
    r = reference_cell(nodes, _degree(nodes, mixed))
    Jinv, _ = kernels_geometry.reference_geometry((0,) * nodes, points, cells, r.dN, r.weights)
    kernels_geometry.kinematics((0,) * nodes, cells, np.zeros((nodes, 3)), r.dN, Jinv)


def compile_gradients(nodes: int, mixed: bool) -> None:
    """Compile the kernel of deformation gradients, which laws in stretches and results need."""
    loops, u, _, _ = _cell(nodes, mixed)
    kernels_geometry.deformation_gradients(loops.shape, loops.nodes, u, loops.dN, loops.Jinv)


def _cell(nodes: int, mixed: bool) -> tuple[kernels.Cells, Array, Array, kernels.Response]:
    """Return one element with displacements, mean stresses and the response of its law, made without a kernel."""
    kind = cell_type(nodes)
    cells = _one_cell(nodes)[1]
    shape, modes = (0,) * nodes, (0,) * kind.corners if mixed else ()
    mean = np.arange(len(modes), dtype=np.int64)[None]
    r = reference_cell(nodes, _degree(nodes, mixed))
    Jinv, dV = np.tile(np.eye(3), (1, len(r.weights), 1, 1)), r.weights[None].copy()
    W = np.ones((5, *dV.shape))
    loops = kernels.Cells(shape, modes, cells, mean, r.dN, r.M, Jinv, dV, np.ones(1), np.zeros((*dV.shape, 0)))
    rows = np.zeros(1, dtype=np.int64)
    laws = kernels.Response(W, rows, np.zeros((1, *dV.shape[1:], 6)), np.zeros((1, *dV.shape[1:], spectral.TANGENT)))
    return loops, np.zeros((nodes, 3)), np.zeros(len(modes)), laws


def compile_stretches(nodes: int, mixed: bool) -> None:
    """Compile the kernels of laws in stretches and of history-dependent rubber."""
    F = np.tile(np.eye(3), (1, len(reference_cell(nodes, _degree(nodes, mixed)).weights), 1, 1))
    bar, directions, scale = spectral.principal_stretches(F)
    one = np.ones((6, *F.shape[:2]))
    spectral.spectral_response(bar, directions, scale, one[:3], one)


def compile_pressure(nodes: int) -> None:
    """Compile the kernels of follower pressure on element sides."""
    points, sides = _one_cell(nodes)[0], _one_side(nodes)
    r = side_tables(sides.shape[1])
    surfaces.pressure_forces(points, sides, r.N, r.dN, r.weights[None].copy())
    surfaces.pressure_tangents(points, sides, r.N, r.dN, r.weights[None].copy())


def compile_sheets(nodes: int) -> None:
    """Compile the kernels of membranes on element sides."""
    points, sides = _one_cell(nodes)[0], _one_side(nodes)
    gradients, areas = membranes.surface_gradients(points, sides)
    stress = membranes.membrane_stress(points, points, sides, gradients, areas, np.eye(3))
    membranes.membrane_forces(points, sides, gradients, areas, stress)
    membranes.membrane_tangents(points, sides, gradients, areas, np.zeros((*areas.shape, 3, 3)), stress)


def _degree(nodes: int, mixed: bool) -> int:
    return CELL_QUADRATURE_DEGREE if mixed else DISPLACEMENT_DEGREE[nodes]


def _one_cell(nodes: int) -> tuple[Array, Array]:
    points = np.ascontiguousarray(reference_nodes(27 if nodes == 20 else nodes))[:nodes]
    return points, np.arange(nodes, dtype=np.int64)[None]


def _one_side(nodes: int) -> Array:
    return np.array(cell_type(nodes).sides[-1:], dtype=np.int64)
