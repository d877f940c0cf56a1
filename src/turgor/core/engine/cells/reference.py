"""Shape functions and quadrature of the reference cells and sides, in the node order of `turgor.core.meshing.cells`."""

from dataclasses import dataclass
from functools import cache

import basix
import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON, QUADRILATERAL, TETRAHEDRON, TRIANGLE, CellType, SideType

Array = NDArray[np.float64]

#: Exact for quartic polynomials on tetrahedra, 14 points: four are 0.9 % off at 90° of bending. Hexahedra get 27.
CELL_QUADRATURE_DEGREE = 4

#: N (quadratic) times x,r × x,s (quadratic) is quartic on triangles: integrated exactly by 6 points. On
#: quadrilaterals the product is of degree 5 in each direction: 9 points.
SURFACE_QUADRATURE_DEGREE = {TRIANGLE.corners: 4, QUADRILATERAL.corners: 5}

#: A pressure that is linear in x (quadratic) makes that product one of degree 6, and 7 in each direction.
LIQUID_QUADRATURE_DEGREE = {TRIANGLE.corners: 6, QUADRILATERAL.corners: 7}


@dataclass(frozen=True, slots=True, eq=False)
class ReferenceCell:
    """Tables of a quadratic cell or side at its quadrature points.

    Parameters
    ----------
    points : (q, d) array
        Quadrature points.
    weights : (q,) array
        Quadrature weights.
    N : (q, n) array
        Shape functions of the nodes.
    dN : (q, n, d) array
        Their derivatives.
    M : (q, m) array
        Linear shape functions of the corners: bilinear and trilinear for quadrilaterals and hexahedra.
    """

    points: Array
    weights: Array
    N: Array
    dN: Array
    M: Array


def reference_nodes(nodes: int) -> Array:
    """Positions of the nodes of a reference cell or side with that many nodes; coordinates run from 0 to 1."""
    kind = _kind(nodes)
    dimension = 2 if isinstance(kind, SideType) else 3
    if kind.corners == dimension + 1:
        corners = np.vstack([np.zeros(dimension), np.eye(dimension)])
    else:
        square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        low, high = np.c_[square, np.zeros(4)], np.c_[square, np.ones(4)]
        corners = square if dimension == 2 else np.vstack([low, high])
    mids = [(corners[a] + corners[b]) / 2 for a, b in kind.edges]
    out = np.vstack([corners, mids])
    if nodes == HEXAHEDRON.nodes:
        out = np.vstack([out, [corners[list(side[:4])].mean(axis=0) for side in HEXAHEDRON.sides]])
    if nodes in (HEXAHEDRON.nodes, QUADRILATERAL.nodes):
        out = np.vstack([out, corners.mean(axis=0)])
    return out


def _kind(nodes: int) -> CellType | SideType:
    kinds: dict[int, CellType | SideType] = {6: TRIANGLE, 9: QUADRILATERAL, 10: TETRAHEDRON, 27: HEXAHEDRON}
    return kinds[nodes]


_BASIX = {
    6: basix.CellType.triangle,
    8: basix.CellType.quadrilateral,
    9: basix.CellType.quadrilateral,
    10: basix.CellType.tetrahedron,
    20: basix.CellType.hexahedron,
    27: basix.CellType.hexahedron,
}

#: Cells whose shape functions are those of a fuller cell with the middles of sides and cell tied to the other nodes.
_SERENDIPITY = {8: 9, 20: 27}


def tied(nodes: int) -> Array:
    """Values at all nodes of the fuller cell from those of the serendipity cell, (full, nodes)."""
    full = _kind(_SERENDIPITY[nodes])
    out = np.zeros((full.nodes, nodes))
    out[:nodes] = np.eye(nodes)
    middles = [tuple(range(nodes))] if nodes == 8 else [side[:8] for side in HEXAHEDRON.sides]
    for row, side in enumerate(middles, start=nodes):
        out[row, list(side[:4])], out[row, list(side[4:])] = -0.25, 0.5
    if nodes == 20:
        out[26, :8], out[26, 8:20] = -0.25, 0.25
    return out


def _tabulate(nodes: int, order: int, points: Array) -> tuple[Array, Array]:
    element = basix.create_element(basix.ElementFamily.P, _BASIX[nodes], order, basix.LagrangeVariant.equispaced)
    ours = reference_nodes(nodes)[: len(element.points)]
    distance = np.linalg.norm(ours[:, None] - element.points[None], axis=2)
    order_of_ours = distance.argmin(axis=1)  # the node order of basix is found by position, not assumed
    table = element.tabulate(1, points)[..., 0]
    values = table[0][:, order_of_ours]
    gradients = np.moveaxis(table[1:][:, :, order_of_ours], 0, -1)
    return np.ascontiguousarray(values), np.ascontiguousarray(gradients)


def tables_at(nodes: int, points: Array, weights: Array) -> ReferenceCell:
    """Tabulate a cell or side with that many nodes at given reference points."""
    N, dN = _tabulate(_SERENDIPITY.get(nodes, nodes), 2, points)
    if nodes in _SERENDIPITY:
        tie = tied(nodes)
        N, dN = N @ tie, np.ascontiguousarray(np.einsum("qad,ab->qbd", dN, tie))
    M, _ = _tabulate(_SERENDIPITY.get(nodes, nodes), 1, points)
    return ReferenceCell(points, weights, N, dN, M)


def smooth_basis(nodes: int, points: Array) -> Array:
    """Basis of fields fitted in a cell or a side with four corners, at reference points.

    Linear in tetrahedra, trilinear in hexahedra, bilinear in sides.
    """
    if points.shape[1] == 2:
        return np.column_stack([np.ones(len(points)), points, points.prod(axis=1)])
    x, y, z = points.T
    linear = [np.ones(len(points)), x, y, z]
    return np.column_stack(linear if nodes == TETRAHEDRON.nodes else [*linear, x * y, y * z, z * x, x * y * z])


@cache
def reference_cell(nodes: int, degree: int) -> ReferenceCell:
    """Tables of a cell or side with that many nodes and a quadrature exact to ``degree``."""
    points, weights = basix.make_quadrature(_BASIX[nodes], degree)
    return tables_at(nodes, np.ascontiguousarray(points), np.ascontiguousarray(weights))


@cache
def product_rule(nodes: int, degree: int) -> ReferenceCell:
    """Tables of a cell with that many nodes and a quadrature of equally many points in all directions.

    All weights are positive, so that parts of a cell can be weighted with the points in them.
    """
    points, weights = basix.make_quadrature(_BASIX[nodes], degree, rule=basix.QuadratureType.gauss_jacobi)
    return tables_at(nodes, np.ascontiguousarray(points), np.ascontiguousarray(weights))


def side_tables(nodes: int) -> ReferenceCell:
    """Tables of a side with that many nodes for the integrals of pressure, volume and area."""
    return reference_cell(nodes, SURFACE_QUADRATURE_DEGREE[3 if nodes == TRIANGLE.nodes else 4])


def liquid_tables(nodes: int) -> ReferenceCell:
    """Tables of a side with that many nodes for the integral of a pressure that grows with depth."""
    return reference_cell(nodes, LIQUID_QUADRATURE_DEGREE[3 if nodes == TRIANGLE.nodes else 4])
