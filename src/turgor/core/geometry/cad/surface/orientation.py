"""Orientation of closed shells: normals out of the solid, into cavities."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.geometry.cad.facets import edge_pairs, flux, turned_alike
from turgor.core.geometry.cad.surface.grouping import vector_areas
from turgor.core.geometry.cad.surface.settings import SURFACE

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Directions of the rays that tell inside from outside: no part has walls along them.
RAYS = np.array([[0.8127, 0.3311, 0.4794], [-0.2713, 0.7861, -0.5553], [0.1931, -0.5777, 0.7931]])


def shells_of(triangles: Ints) -> Ints:
    """Number of the shell of each triangle; triangles of a shell hang together over edges."""
    count = len(triangles)
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    number = np.asarray(np.unique(edges, axis=0, return_inverse=True)[1]).ravel()
    owner = np.repeat(np.arange(count), 3)
    links = coo_array((np.ones(len(owner)), (owner, number)), shape=(count, int(number.max()) + 1)).tocsr()
    return np.asarray(connected_components(links @ links.T, directed=False)[1]).astype(np.int64)


def _pieces(triangles: Ints, pairs: Ints) -> Ints:
    """Number of the piece of each triangle; pieces hang together over edges of two triangles."""
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(triangles), len(triangles)))
    return np.asarray(connected_components(graph, directed=False)[1]).astype(np.int64)


def within(places: Array, corners: Array) -> NDArray[np.bool_]:
    """Whether points lie within a closed surface of triangles, whatever way these look.

    A ray from an inner point crosses the surface an odd number of times. Three rays vote, because one may meet an edge.

    Parameters
    ----------
    places : (k, 3) array
    corners : (t, 3, 3) array

    Examples
    --------
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    >>> tetrahedron = corners[np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])]
    >>> within(np.array([[0.2, 0.2, 0.2], [0.5, 0.5, 0.5]]), tetrahedron)
    array([ True, False])
    """
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    votes = np.zeros(len(places), dtype=np.int64)
    for along in RAYS:
        p = np.cross(along, v)
        determinant = np.einsum("ti,ti->t", u, p)
        inverse = np.divide(1.0, determinant, out=np.zeros(len(a)), where=determinant != 0)
        for k, place in enumerate(places):
            w = place - a
            r = np.einsum("ti,ti->t", w, p) * inverse
            q = np.cross(w, u)
            s, distance = q @ along * inverse, np.einsum("ti,ti->t", v, q) * inverse
            hit = (determinant != 0) & (r >= 0) & (s >= 0) & (r + s <= 1) & (distance > 0)
            votes[k] += int(hit.sum()) % 2
    return np.asarray(2 * votes > len(RAYS))


def oriented_shells(points: Array, triangles: Ints) -> tuple[Ints, int]:
    """Turn the triangles of closed shells so that their normals point out of the solid.

    A shell within an odd number of others encloses a cavity. Walls that touch along an edge split a shell into pieces;
    each of them is turned by itself.

    Parameters
    ----------
    points : (n, 3) array
    triangles : (t, 3) int array

    Returns
    -------
    triangles : (t, 3) int array
    overlapping : int
        Shells that lie partly within another one; they are cavities where the file has their normals inward.
    """
    pairs, _, coherent = edge_pairs(triangles)
    shell, piece = shells_of(triangles), _pieces(triangles, pairs)
    starts = [int(np.argmax(piece == i)) for i in range(int(piece.max()) + 1)]
    turned = turned_alike(triangles, pairs, coherent, starts)
    corners = points[turned]
    areas = vector_areas(points, turned)
    size = np.linalg.norm(areas, axis=1)
    flipped = np.zeros(len(starts), dtype=bool)
    for number in range(len(starts)):
        own = np.flatnonzero(piece == number)
        widest = own[size[own].argmax()]
        before = corners[widest].mean(axis=0) + SURFACE.ahead * size[widest] ** 0.5 * areas[widest] / size[widest]
        flipped[number] = within(before[None], corners[shell == shell[widest]])[0]
    turned = np.where(flipped[piece][:, None], turned[:, ::-1], turned)
    hollow, overlapping = _nested(points, turned, shell)
    # only the file states whether a shell that overlaps others is a cavity
    origin = points.mean(axis=0)
    for i in overlapping:
        hollow[i] = flux(points, triangles[shell == i], origin) < 0
    return np.asarray(np.where(hollow[shell][:, None], turned[:, ::-1], turned)), len(overlapping)


def _nested(points: Array, triangles: Ints, shell: Ints) -> tuple[NDArray[np.bool_], set[int]]:
    """Whether each shell lies within an odd number of others, and which overlap."""
    count = int(shell.max()) + 1
    depth, overlapping = np.zeros(count, dtype=np.int64), set[int]()
    for i in range(count):
        nodes = np.unique(triangles[shell == i])
        probes = points[nodes[np.linspace(0, len(nodes) - 1, min(SURFACE.probes, len(nodes))).astype(int)]]
        for j in range(count):
            if i != j:
                inner = within(probes, points[triangles[shell == j]])
                depth[i] += bool(inner.all())
                overlapping |= {i, j} if inner.any() and not inner.all() else set()
    return (depth % 2 == 1) & ~np.isin(np.arange(count), list(overlapping)), overlapping
