"""Located: the parameters of nodes on the surface of a CAD face, found from node to node."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.spatial import cKDTree

from turgor.core.meshing.moving.settings import MOVING
from turgor.core.meshing.moving.surfaces import Surface

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def located(surface: Surface, points: Array, triangles: Ints, nodes: Ints) -> tuple[Array, Array] | None:
    """Find the nearest points of a surface to nodes of a face: the first by a search, others from their neighbors.

    A search has no range of the parameters, and a surface may come near a node in several places; what is found from
    a neighbor goes on with its parameters.

    Parameters
    ----------
    surface : Surface
    points : (n, 3) array [m]
        Of all nodes of the mesh.
    triangles : (f, 6) int array
        Of the face.
    nodes : (k,) int array
        Those to locate.

    Returns
    -------
    (k, 2) array, (k, 3) array, or None
        Parameters and points [m]; None if the surface passes by.
    """
    own, size = points[nodes], float(np.ptp(points[triangles.ravel()], axis=0).max())
    if surface.plane is not None or not len(nodes):
        return surface.nearest(own, np.zeros((len(nodes), 2)))
    start, away = surface.searched(own[0], size)
    if away > MOVING.near * size:
        return None
    uv, known = np.zeros((len(nodes), 2)), np.zeros(len(nodes), dtype=bool)
    uv[0], known[0] = start, True
    adjacency = _adjacency(triangles, nodes)
    while not known.all():
        reached, parents = _reached(adjacency, own, known)
        uv[reached], _ = surface.nearest(own[reached], uv[parents])
        known[reached] = True
    return surface.nearest(own, uv)


def _adjacency(triangles: Ints, nodes: Ints) -> coo_array:
    """Which of the nodes share a triangle, (k, k)."""
    place = np.searchsorted(nodes, triangles)
    place[place == len(nodes)] = 0
    row, column = np.nonzero(nodes[place] == triangles)
    shape = (len(triangles), len(nodes))
    within = coo_array((np.ones(len(row)), (row, place[row, column])), shape=shape).tocsr()
    return (within.T @ within).tocoo()


def _reached(adjacency: coo_array, own: Array, known: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Nodes next to known ones, and which known one each follows; the nearest one of all where none is adjacent."""
    one, other = adjacency.row[known[adjacency.row]], adjacency.col[known[adjacency.row]]
    one, other = one[~known[other]], other[~known[other]]
    if len(one):
        reached, first = np.unique(other, return_index=True)
        return reached, one[first]
    others, settled = np.flatnonzero(~known), np.flatnonzero(known)
    away, nearest = cKDTree(own[settled]).query(own[others])
    return others[[away.argmin()]], settled[nearest[[away.argmin()]]]
