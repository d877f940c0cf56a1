"""Middles of hexahedra that follow the other nodes of their side or cell: 20-node hexahedra with 27 places.

The shape functions of a 20-node hexahedron are those of one with 27 nodes whose middles are weighted sums of the other
nodes. A mesh whose middles follow has the unknowns of 20-node cells; its middles still have a place and a displacement,
so that everything that works on nine-node sides (contact, sheets, pictures) works on it too.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import HEXAHEDRON, HEXAHEDRON_20

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Weights of the corners of a side and of its mid-side nodes at its middle; then those in a cell.
SIDE_WEIGHTS = np.repeat([-0.25, 0.5], [4, 4])
CELL_WEIGHTS = np.repeat([-0.25, 0.25], [8, 12])


@dataclass(frozen=True, slots=True, eq=False)
class Middles:
    """Nodes that follow others, and the nodes that they follow.

    Parameters
    ----------
    followers, leaders : (k,) int arrays
        A middle stands there once for each node that it follows.
    weights : (k,) array
    """

    followers: Ints
    leaders: Ints
    weights: Array

    def values(self, at_nodes: Array) -> Array:
        """Values (n, d) at the nodes with those of the middles taken from the others."""
        out = at_nodes.copy()
        for axis in range(at_nodes.shape[1]):
            sums = np.bincount(self.followers, self.weights * at_nodes[self.leaders, axis], minlength=len(out))
            nodes = np.unique(self.followers)
            out[nodes, axis] = sums[nodes]
        return out


def middles_of(cells: Ints) -> Middles:
    """Find the middles of 27-node hexahedra (c, 27) and what they follow."""
    sides = cells[:, np.array(HEXAHEDRON.sides)].reshape(-1, HEXAHEDRON.side.nodes)
    middle, first = np.unique(sides[:, 8], return_index=True)
    leaders = [sides[first, :8].ravel(), cells[:, : HEXAHEDRON_20.nodes].ravel()]
    followers = [np.repeat(middle, 8), np.repeat(cells[:, 26], HEXAHEDRON_20.nodes)]
    weights = [np.tile(SIDE_WEIGHTS, len(middle)), np.tile(CELL_WEIGHTS, len(cells))]
    return Middles(np.concatenate(followers), np.concatenate(leaders), np.concatenate(weights))
