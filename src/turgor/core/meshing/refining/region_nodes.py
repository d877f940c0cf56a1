"""Nodes of the regions: a node where regions meet stands once for each of them, so that fields may jump there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.mesh import Mesh

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class RegionNodes:
    """The nodes of a mesh, doubled where regions meet.

    The nodes of the mesh come first, in their order; each stands for the first region that it touches. The doubles for
    the other regions follow. In a mesh of one region there are none.

    Parameters
    ----------
    node : (d,) int array
        Node of the mesh.
    region : (d,) int array
        Number of the region, in the order of ``mesh.regions``.
    cells : (c, k) int array
        Rows of ``node`` in place of the nodes of each cell.
    """

    node: Ints
    region: Ints
    cells: Ints

    def of(self, nodes: Ints, region: Ints) -> Ints:
        """Return the rows of ``node`` for nodes of the mesh in given regions; both arrays have one shape."""
        count = int(self.node.max()) + 1
        keys = self.region * count + self.node
        order = np.argsort(keys)
        return np.asarray(order[np.searchsorted(keys[order], region * count + nodes)])


def region_nodes(mesh: Mesh) -> RegionNodes:
    """Double the nodes of a mesh where regions meet.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    RegionNodes

    Examples
    --------
    >>> import numpy as np
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1.0]])
    >>> from turgor.core.meshing.mesh import TETRAHEDRON_EDGES
    >>> corners = np.array([[0, 1, 2, 3], [1, 0, 2, 4]])
    >>> pairs = np.sort([[cell[list(edge)] for edge in TETRAHEDRON_EDGES] for cell in corners], axis=2)
    >>> edges, place = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    >>> two = Mesh(
    ...     points=np.concatenate([points, points[edges].mean(axis=1)]),
    ...     cells=np.concatenate([corners, 5 + place.reshape(2, 6)], axis=1),
    ...     regions={"top": [0], "bottom": [1]},
    ...     faces={},
    ... )
    >>> len(two.points), len(region_nodes(two).node)  # six nodes lie on the triangle between the two cells
    (14, 20)
    """
    pieces = mesh.pieces
    region = np.zeros(len(pieces), dtype=np.int64)
    for number, cells in enumerate(mesh.regions.values()):
        region[cells] = number
    count = len(mesh.points)
    keys, place = np.unique((region[:, None] * count + pieces).ravel(), return_inverse=True)
    node = keys % count
    used, first = np.unique(node, return_index=True)
    row = np.full(len(keys), -1)
    row[first] = used
    more = np.flatnonzero(row < 0)
    row[more] = count + np.arange(len(more))
    all_nodes = np.concatenate([np.arange(count), node[more]])
    all_regions = np.zeros(len(all_nodes), dtype=np.int64)
    all_regions[row] = keys // count
    return RegionNodes(all_nodes, all_regions, row[place].reshape(pieces.shape))
