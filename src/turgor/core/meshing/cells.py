"""Kinds of cells and of their sides: how many nodes, which are corners, and which lie between which.

Every kind is quadratic. Nodes follow VTK and Abaqus: corners, then mid-side nodes in the order of ``edges``, then, for
27 nodes, the middles of the sides and of the cell.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError

Pairs = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class SideType:
    """A kind of face: a curved triangle or quadrilateral.

    Parameters
    ----------
    name : str
        What it is called in messages.
    nodes, corners : int
        Number of nodes, and of corners among them.
    edges : tuple of pairs
        Mid-side node ``corners + i`` lies between the corners ``edges[i]``.
    triangles : tuple of six places each
        Six-node triangles that cover the side with its own nodes; empty where its nodes do not allow it.
    vtk : int
        Number of the kind in VTK files.
    """

    name: str
    nodes: int
    corners: int
    edges: Pairs
    triangles: tuple[tuple[int, ...], ...]
    vtk: int


@dataclass(frozen=True, slots=True)
class CellType:
    """A kind of cell.

    Parameters
    ----------
    name : str
        What it is called in messages.
    nodes, corners : int
        Number of nodes, and of corners among them.
    edges : tuple of pairs
        Mid-side node ``corners + i`` lies between the corners ``edges[i]``.
    sides : tuple of tuples
        Nodes of each side in the order of its `SideType`, normals pointing out of the cell.
    side : SideType
        Kind of the sides.
    vtk : int
        Number of the kind in VTK files.
    """

    name: str
    nodes: int
    corners: int
    edges: Pairs
    sides: tuple[tuple[int, ...], ...]
    side: SideType
    vtk: int


_QUAD_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0))

TRIANGLE = SideType("six-node triangle", 6, 3, ((0, 1), (1, 2), (2, 0)), ((0, 1, 2, 3, 4, 5),), 22)
QUADRILATERAL_8 = SideType("eight-node quadrilateral", 8, 4, _QUAD_EDGES, (), 23)
QUADRILATERAL = SideType(
    "nine-node quadrilateral", 9, 4, _QUAD_EDGES, ((0, 1, 2, 4, 5, 8), (0, 2, 3, 8, 6, 7)), 28
)  # the middle of the side lies on the diagonal that both triangles share

TETRAHEDRON = CellType(
    name="ten-node tetrahedron",
    nodes=10,
    corners=4,
    edges=((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    sides=((0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (2, 0, 3, 6, 7, 9), (0, 2, 1, 6, 5, 4)),
    side=TRIANGLE,
    vtk=24,
)

_HEX_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0)) + ((4, 5), (5, 6), (6, 7), (7, 4)) + ((0, 4), (1, 5), (2, 6), (3, 7))

#: Sides at ξ = 0, 1, η = 0, 1, ζ = 0, 1; the last node is the middle.
_HEX_SIDES = (
    (0, 4, 7, 3, 16, 15, 19, 11, 20),
    (1, 2, 6, 5, 9, 18, 13, 17, 21),
    (0, 1, 5, 4, 8, 17, 12, 16, 22),
    (3, 7, 6, 2, 19, 14, 18, 10, 23),
    (0, 3, 2, 1, 11, 10, 9, 8, 24),
    (4, 5, 6, 7, 12, 13, 14, 15, 25),
)

HEXAHEDRON_20 = CellType(
    name="20-node hexahedron",
    nodes=20,
    corners=8,
    edges=_HEX_EDGES,
    sides=tuple(side[:8] for side in _HEX_SIDES),
    side=QUADRILATERAL_8,
    vtk=25,
)
HEXAHEDRON = CellType(
    name="27-node hexahedron",
    nodes=27,
    corners=8,
    edges=_HEX_EDGES,
    sides=_HEX_SIDES,
    side=QUADRILATERAL,
    vtk=29,
)

CELL_TYPES = (TETRAHEDRON, HEXAHEDRON_20, HEXAHEDRON)
SIDE_TYPES = (TRIANGLE, QUADRILATERAL_8, QUADRILATERAL)


def cell_type(nodes: int) -> CellType:
    """Find the kind of cell with a number of nodes.

    Examples
    --------
    >>> cell_type(27).name
    '27-node hexahedron'
    """
    for kind in CELL_TYPES:
        if kind.nodes == nodes:
            return kind
    known = ", ".join(str(kind.nodes) for kind in CELL_TYPES)
    raise TurgorError(f"cells have {nodes} nodes; allowed are {known}.")


def side_type(nodes: int) -> SideType:
    """Find the kind of side with a number of nodes.

    Examples
    --------
    >>> side_type(6).corners
    3
    """
    for kind in SIDE_TYPES:
        if kind.nodes == nodes:
            return kind
    known = ", ".join(str(kind.nodes) for kind in SIDE_TYPES)
    raise TurgorError(f"faces have {nodes} nodes; allowed are {known}.")


def six_node_triangles(sides: NDArray[np.int64]) -> NDArray[np.int64]:
    """Cover sides of any kind by six-node triangles on the same nodes, for geometry and pictures.

    Parameters
    ----------
    sides : (f, 6) or (f, 9) int array
        Six-node triangles, returned as they are, or nine-node quadrilaterals, of which each gives two.

    Returns
    -------
    (t, 6) int array

    Raises
    ------
    TurgorError
        For eight-node quadrilaterals, which have no node on their diagonal.

    Examples
    --------
    >>> import numpy as np
    >>> six_node_triangles(np.arange(9)[None])
    array([[0, 1, 2, 4, 5, 8],
           [0, 2, 3, 8, 6, 7]])
    """
    kind = side_type(sides.shape[1])
    if kind is TRIANGLE:
        return sides
    if not kind.triangles:
        raise TurgorError(f"{kind.name}s cannot be covered by six-node triangles; use 27-node hexahedra.")
    return np.asarray(sides[:, np.array(kind.triangles)].reshape(-1, 6))
