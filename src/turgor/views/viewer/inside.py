"""Inside: the cells of the modeled part as straight tetrahedra, from which the viewer makes the face of a cut."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.results.fields.state_fields import StateFields
from turgor.views.viewer.settings import VIEWER

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Tetrahedra of a cell by its nodes: of ten-node tetrahedra, whose middle nodes count, and of the corners of hexahedra.
_FINE = ((0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3), (6, 8, 4, 5), (6, 8, 5, 9), (6, 8, 9, 7), (6, 8, 7, 4))
_BRICK = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inside:
    """Straight tetrahedra with their vertices; a node where regions meet has a vertex for each region.

    Parameters
    ----------
    tetrahedra : (t, 4) int array
        Vertices of each tetrahedron.
    node : (v,) int array
        Node of the mesh of each vertex.
    row : (v,) int array
        Row of the nodal fields of each vertex.
    count : int
        Nodes of the mesh.
    """

    tetrahedra: Ints
    node: Ints
    row: Ints
    count: int

    def pick(self, values: Array) -> Array:
        """Values at the vertices, (v, …), from values at the nodes of the mesh or of its regions."""
        return np.asarray(values[self.node if len(values) == self.count else self.row])


def inside_of(rest: StateFields, steps: int, each: int) -> Inside | None:
    """Cut the cells into straight tetrahedra, as finely as the page can hold.

    Parameters
    ----------
    rest : StateFields
        Any state.
    steps : int
        Steps that the viewer shows.
    each : int
        Bytes of a vertex in a step.

    Returns
    -------
    Inside or None
        None where even the corners of the cells are too many.
    """
    mesh, cells = rest.mesh, rest.facts.region_nodes.cells
    splits = (_FINE, (tuple(range(4)),)) if mesh.cell_type is TETRAHEDRON else (_BRICK,)
    for split in splits:
        corners = cells[:, np.array(split)].reshape(-1, 4)
        rows, same = np.unique(corners, return_inverse=True)
        if len(rows) * steps * each <= VIEWER.part_bytes:
            node = rest.facts.region_nodes.node[rows]
            return Inside(tetrahedra=same.reshape(-1, 4), node=node, row=rows, count=len(mesh.points))
    return None
