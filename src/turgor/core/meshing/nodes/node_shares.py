"""Node shares: how a total is spread over some nodes of a mesh, by area, by length, or equally."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON_20, QUADRILATERAL_8
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Integral of each shape function over a side of area one: corners, mid-side nodes, and the middle where there is one.
_ON_SIDE: Mapping[int, tuple[float, ...]] = {
    6: (0.0,) * 3 + (1 / 3,) * 3,
    8: (-1 / 12,) * 4 + (1 / 3,) * 4,
    9: (1 / 36,) * 4 + (1 / 9,) * 4 + (4 / 9,),
}
#: The same along an edge of length one: its ends and its middle.
_ON_EDGE = (1 / 6, 1 / 6, 2 / 3)


def node_shares(mesh: Mesh, nodes: Ints, middles: bool = True) -> Array:
    """Return the share of each node of a mesh in a total that some nodes bear, (n,); the sum is one.

    Sides and edges are taken as flat and straight between their corners.

    Parameters
    ----------
    mesh : Mesh
    nodes : (k,) int array
        A total is spread by area over the sides of the surface whose nodes are all among them. Where there are none,
        it is spread by length along the edges of cells; without any, equally over the nodes.
    middles : bool
        Whether the middle of a side with nine nodes bears a share; files of other programs have none.

    Returns
    -------
    array
    """
    inside = np.zeros(len(mesh.points), dtype=bool)
    inside[nodes] = True
    sides = _surface(mesh)
    sides = sides[inside[sides[:, : QUADRILATERAL_8.nodes]].all(axis=1)]
    if len(sides):
        return side_shares(mesh, sides, middles)
    edges = _edges(mesh)
    edges = edges[inside[edges].all(axis=1)]
    if len(edges):
        lengths = np.linalg.norm(mesh.points[edges[:, 1]] - mesh.points[edges[:, 0]], axis=1)
        return _summed(mesh, edges, lengths, _ON_EDGE)
    carrying = np.intersect1d(nodes, mesh.pieces[:, : HEXAHEDRON_20.nodes])
    out = np.zeros(len(mesh.points))
    out[carrying if len(carrying) else nodes] = 1 / (len(carrying) or len(nodes))
    return out


def side_shares(mesh: Mesh, sides: Ints, middles: bool = True) -> Array:
    """Return the share of each node of a mesh in a total that is spread by area over sides, (n,); the sum is one."""
    if mesh.serendipity or not middles:
        sides = sides[:, : QUADRILATERAL_8.nodes]
    return _summed(mesh, sides, areas(mesh.points, sides), _ON_SIDE[sides.shape[1]])


def _surface(mesh: Mesh) -> Ints:
    """Sides of the surface of the whole: those of cuts through it are none."""
    sides, count = outer_triangles(mesh), len(mesh.points)
    cut = [corner_keys(mesh.face(name), count) for name in mesh.cut_faces]
    return sides[~np.isin(corner_keys(sides, count), np.concatenate([np.zeros(0, dtype=np.int64), *cut]))]


def _edges(mesh: Mesh) -> Ints:
    """Edges of all cells, (e, 3): two corners and the node between them."""
    kind = mesh.cell_type if len(mesh.cells) else mesh.cell_type.side
    every = np.concatenate([mesh.pieces[:, [a, b, kind.corners + i]] for i, (a, b) in enumerate(kind.edges)])
    _, first = np.unique(np.sort(every[:, :2], axis=1), axis=0, return_index=True)
    return np.asarray(every[first])


def areas(points: Array, sides: Ints) -> Array:
    """Return the areas of sides (f,) that are flat between their corners [m²]."""
    corners = points[sides[:, : 4 if sides.shape[1] >= QUADRILATERAL_8.nodes else 3]]
    one, other = corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1]
    return np.asarray(np.linalg.norm(np.cross(one, other), axis=1) / 2)


def _summed(mesh: Mesh, parts: Ints, sizes: Array, shares: tuple[float, ...]) -> Array:
    local = sizes[:, None] * np.array(shares)
    total = np.bincount(parts.ravel(), local.ravel(), minlength=len(mesh.points))
    return np.asarray(total / sizes.sum())
