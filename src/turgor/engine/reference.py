"""Shape functions and quadrature of the reference cells, in the node order of `turgor.meshing.mesh`."""

from dataclasses import dataclass
from functools import cache

import basix
import numpy as np
from numpy.typing import NDArray

from turgor.meshing.mesh import TETRAHEDRON_EDGES, TRIANGLE_EDGES

#: Exact for quartic polynomials, 14 points: four points are 0.9 % off at 90° of bending.
CELL_QUADRATURE_DEGREE = 4

#: N (quadratic) times x,r × x,s (quadratic) is quartic: integrated exactly by 6 points.
SURFACE_QUADRATURE_DEGREE = 4


@dataclass(frozen=True, slots=True, eq=False)
class ReferenceCell:
    """Tables of a quadratic simplex at its quadrature points.

    Parameters
    ----------
    points : (q, d) array
        Quadrature points.
    weights : (q,) array
        Quadrature weights.
    N : (q, n) array
        Quadratic shape functions.
    dN : (q, n, d) array
        Their derivatives.
    M : (q, d + 1) array
        Linear shape functions of the vertices.
    """

    points: NDArray[np.float64]
    weights: NDArray[np.float64]
    N: NDArray[np.float64]
    dN: NDArray[np.float64]
    M: NDArray[np.float64]


def reference_nodes(dimension: int) -> NDArray[np.float64]:
    """Positions of the nodes of the reference triangle (2) or tetrahedron (3): vertices, then mid-sides."""
    vertices = np.vstack([np.zeros(dimension), np.eye(dimension)])
    edges = TRIANGLE_EDGES if dimension == 2 else TETRAHEDRON_EDGES
    return np.vstack([vertices, [(vertices[a] + vertices[b]) / 2 for a, b in edges]])


def _tabulate(dimension: int, order: int, points: NDArray[np.float64]) -> tuple[NDArray, NDArray]:
    cell = basix.CellType.triangle if dimension == 2 else basix.CellType.tetrahedron
    element = basix.create_element(basix.ElementFamily.P, cell, order, basix.LagrangeVariant.equispaced)
    nodes = reference_nodes(dimension)[: None if order == 2 else dimension + 1]
    distance = np.linalg.norm(nodes[:, None] - element.points[None], axis=2)
    order_of_ours = distance.argmin(axis=1)  # the node order of basix is found by position, not assumed
    table = element.tabulate(1, points)[..., 0]
    values = table[0][:, order_of_ours]
    gradients = np.moveaxis(table[1:][:, :, order_of_ours], 0, -1)
    return np.ascontiguousarray(values), np.ascontiguousarray(gradients)


def tables_at(dimension: int, points: NDArray[np.float64], weights: NDArray[np.float64]) -> ReferenceCell:
    """Tabulate a quadratic triangle (2) or tetrahedron (3) at given reference points."""
    N, dN = _tabulate(dimension, 2, points)
    M, _ = _tabulate(dimension, 1, points)
    return ReferenceCell(points, weights, N, dN, M)


@cache
def reference_cell(dimension: int, degree: int) -> ReferenceCell:
    """Tables of the quadratic triangle (2) or tetrahedron (3) with a quadrature exact to ``degree``."""
    cell = basix.CellType.triangle if dimension == 2 else basix.CellType.tetrahedron
    points, weights = basix.make_quadrature(cell, degree)
    return tables_at(dimension, np.ascontiguousarray(points), np.ascontiguousarray(weights))
