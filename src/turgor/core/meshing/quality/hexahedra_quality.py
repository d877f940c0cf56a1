"""Quality of hexahedra: Jacobian determinant of the curved cells, volume and shape."""

from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON, HEXAHEDRON_20
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.settings import CHUNK
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Sampling points of the Jacobian along each direction: the nodes and points between them.
SAMPLES = np.linspace(0, 1, 5)

#: Gauss points along each direction; they integrate the Jacobian of 27 nodes, a polynomial of degree 5, exactly.
GAUSS = 3

#: The neighbors of each corner along ξ, η, ζ, in right-handed order.
NEIGHBORS = ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))


@cache
def node_places(nodes: int) -> Array:
    """Return the reference coordinates of the nodes of a hexahedron, (nodes, 3), between 0 and 1."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
    mids = [corners[list(edge)].mean(axis=0) for edge in HEXAHEDRON.edges]
    middles = [corners[list(side[:4])].mean(axis=0) for side in HEXAHEDRON.sides]
    return np.array([*corners, *mids, *middles, [0.5, 0.5, 0.5]])[:nodes]


def gradients(places: Array, nodes: int) -> Array:
    """Return the derivatives of the shape functions of a 20- or 27-node hexahedron, (p, nodes, 3).

    Parameters
    ----------
    places : (p, 3) array
        Reference coordinates between 0 and 1.
    nodes : int
        20 or 27.

    Returns
    -------
    (p, nodes, 3) array

    Examples
    --------
    >>> at = np.array([[0.3, 0.2, 0.9]])
    >>> np.allclose(np.einsum("pad,ai->pid", gradients(at, 20), node_places(20)), np.eye(3))
    True
    """
    exponents = np.array([p for p in product(range(3), repeat=3) if nodes == 27 or _serendipity(p)])
    at_nodes = np.prod(node_places(nodes)[:, None, :] ** exponents, axis=2)
    coefficients = np.linalg.inv(at_nodes)  # column a holds the monomials of the shape function of node a
    derivatives = np.empty((len(places), len(exponents), 3))
    for d in range(3):
        lower = exponents - np.eye(3, dtype=int)[d]
        powers = np.where(lower < 0, 0, lower)
        derivatives[:, :, d] = exponents[:, d] * np.prod(places[:, None, :] ** powers, axis=2)
    return np.asarray(np.einsum("pmd,ma->pad", derivatives, coefficients))


def _serendipity(powers: tuple[int, ...]) -> bool:
    """Return whether a monomial is one of the 20 of the serendipity space: superlinear degree of at most 2."""
    return sum(power for power in powers if power == 2) <= 2


def determinants(mesh: Mesh, places: Array) -> Array:
    """Return the Jacobian determinants of all cells at points in reference coordinates, (c, p) [m³]."""
    if mesh.cell_type not in (HEXAHEDRON, HEXAHEDRON_20):
        raise TurgorError(f"the cells are {mesh.cell_type.name}s; hexahedra are needed.")
    dN = gradients(places, mesh.cell_type.nodes)
    pieces = []
    for start in range(0, len(mesh.cells), CHUNK):
        J = np.einsum("cai,pad->cpid", mesh.points[mesh.cells[start : start + CHUNK]], dN, optimize=True)
        pieces.append(np.einsum("cpi,cpi->cp", J[..., 0], np.cross(J[..., 1], J[..., 2])))
    return np.concatenate(pieces)


def hexahedra_jacobian_range(mesh: Mesh) -> tuple[Array, Array]:
    """Return smallest and largest Jacobian determinant of each curved hexahedron, (c,) [m³]: the volume for a box."""
    determinant = determinants(mesh, np.array(list(product(SAMPLES, repeat=3))))
    return determinant.min(axis=1), determinant.max(axis=1)


def hexahedra_volumes(mesh: Mesh) -> Array:
    """Return the volume of each curved hexahedron, (c,) [m³]; the quadrature is exact."""
    x, w = np.polynomial.legendre.leggauss(GAUSS)
    weights = np.array([np.prod(group) for group in product(w / 2, repeat=3)])
    return determinants(mesh, np.array(list(product((x + 1) / 2, repeat=3)))) @ weights


def hexahedra_shapes(mesh: Mesh) -> Array:
    """Return the scaled Jacobian of each hexahedron with straight edges, (c,): 1 for a box, 0 if a corner is flat.

    The scaled Jacobian is the smallest of the eight triple products of the unit vectors along the edges of a corner.
    Long boxes are as good as cubes.
    """
    corners = mesh.points[mesh.cells[:, :8]]
    worst = np.ones(len(corners))
    for corner, ends in enumerate(NEIGHBORS):
        a, b, c = (corners[:, end] - corners[:, corner] for end in ends)
        lengths = np.prod([np.linalg.norm(e, axis=1) for e in (a, b, c)], axis=0)
        volume = np.einsum("ci,ci->c", a, np.cross(b, c))
        worst = np.minimum(worst, volume / np.maximum(lengths, 1e-300))
    return np.maximum(worst, 0)
