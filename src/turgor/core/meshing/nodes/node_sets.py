"""Node sets: named edges and points of mesh files, on quadratic and on refined cells."""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON, cell_type
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]


def with_new_middles(cells: Ints, members: Flags, new: Flags) -> Flags:
    """Return the members of a set, and those new nodes that lie between members alone.

    Parameters
    ----------
    cells : (c, m) int array
        Quadratic cells.
    members : (n,) bool array
        Nodes that are in the set.
    new : (n,) bool array
        Nodes that the set cannot have named, because they were added later.

    Returns
    -------
    (n,) bool array

    Examples
    --------
    >>> row = np.arange(10)[None]  # a tetrahedron; its node 4 lies between the corners 0 and 1
    >>> np.flatnonzero(with_new_middles(row, np.arange(10) < 2, np.arange(10) > 3)).tolist()
    [0, 1, 4]
    """
    members = members.copy()
    for corners, middle in _between(cells.shape[1]):
        inside = members[cells[:, list(corners)]].all(axis=1)
        between = cells[inside, middle]
        members[between[new[between]]] = True
    return members


def _between(nodes: int) -> Iterator[tuple[tuple[int, ...], int]]:
    """Corners of each edge, side and cell, and the place of the node in its middle."""
    kind = cell_type(nodes)
    yield from ((edge, kind.corners + k) for k, edge in enumerate(kind.edges))
    if kind is HEXAHEDRON:
        yield from ((side[:4], side[8]) for side in kind.sides)
        yield tuple(range(8)), 26


def refined_sets(mesh: Mesh, points: Array, cells: Ints) -> dict[str, Ints]:
    """Return the node sets of a mesh on cells that are parts of its cells.

    Parameters
    ----------
    mesh : Mesh
        Before refinement.
    points : (n, 3) array [m]
        Nodes after it; those of the mesh are among them.
    cells : (c, m) int array
    """
    if not mesh.node_sets:
        return {}
    from scipy.spatial import cKDTree  # slow to load, and only meshes of files have sets

    away, old = cKDTree(mesh.points).query(points)
    new = away > ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max())
    sets: Mapping[str, Flags] = {
        name: with_new_middles(cells, ~new & np.isin(old, nodes), new) for name, nodes in mesh.node_sets.items()
    }
    return {name: np.flatnonzero(members) for name, members in sets.items()}
