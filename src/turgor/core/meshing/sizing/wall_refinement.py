"""More cells through walls than the generator puts there."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.quality.checks import crossings
from turgor.core.meshing.refining.split import split_edges
from turgor.core.meshing.sizing.settings import FEATURES
from turgor.core.meshing.surface import outer_triangles

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def refine_walls(mesh: Mesh, wall_cells: int) -> Mesh:
    """Put more cells through every wall that one cell reaches through, by cutting those cells in the wall's middle.

    Each half is cut again where more than two are requested: three are four.
    Cells along the wall stay as long as they are: that is where the unknowns are saved against a smaller mesh size.

    Parameters
    ----------
    mesh : Mesh
    wall_cells : int
        1 leaves the mesh as it is, 2 cuts, 3 and 4 cut twice.

    Returns
    -------
    Mesh

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.quality.checks import check_mesh
    >>> from turgor.core.meshing.generate import mesh
    >>> coarse = mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3)
    >>> [found.code for found in check_mesh(coarse)], check_mesh(refine_walls(coarse, 2))
    (['G01'], ())
    """
    if wall_cells < 2:
        return mesh
    edges, _ = crossings(mesh)
    if not len(edges):
        return mesh
    halved = split_edges(mesh, edges)
    if wall_cells == 2:
        return halved
    tree = cKDTree(halved.points[: halved.vertex_count])
    ends = np.zeros(halved.vertex_count, dtype=bool)
    ends[tree.query(mesh.points[np.unique(outer_triangles(mesh)[:, :3])])[1]] = True
    middles = np.zeros(halved.vertex_count, dtype=bool)
    middles[tree.query(_middles(mesh, edges))[1]] = True
    pairs = np.unique(np.sort(np.concatenate([halved.cells[:, e] for e in TETRAHEDRON_EDGES]), axis=1), axis=0)
    inward = np.concatenate([pairs[ends[pairs[:, 0]]], pairs[ends[pairs[:, 1]]][:, ::-1]])
    middles[_between(halved.points, inward[~ends[inward[:, 1]]])] = True
    a, b = pairs.T
    return split_edges(halved, pairs[(middles[a] & ends[b]) | (ends[a] & middles[b])])


def _between(points: Array, pairs: Ints) -> Ints:
    """Inner vertices with edges (p, 2) from vertices of the surface on opposite sides: they lie in a thin wall."""
    order = np.argsort(pairs[:, 1], kind="stable")
    along = points[pairs[order, 1]] - points[pairs[order, 0]]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    inner, first = np.unique(pairs[order, 1], return_index=True)
    groups = np.split(along, first[1:])
    return inner[[bool((group @ group.T).min() < FEATURES.turned) for group in groups]]


def _middles(mesh: Mesh, edges: Ints) -> Array:
    """Positions of the mid-side nodes of edges (e, 2), which cuts turn into vertices."""
    count = len(mesh.points)
    ends = np.sort(np.concatenate([mesh.cells[:, e] for e in TETRAHEDRON_EDGES]), axis=1)
    keys, first = np.unique(ends[:, 0] * count + ends[:, 1], return_index=True)
    requested = np.sort(edges, axis=1)
    place = np.searchsorted(keys, requested[:, 0] * count + requested[:, 1])
    return np.asarray(mesh.points[mesh.cells[:, 4:].T.ravel()[first[place]]])
