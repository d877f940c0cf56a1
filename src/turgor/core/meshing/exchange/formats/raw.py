"""Content of a mesh file, before any check: nodes, blocks of cells of one kind, and their names."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class CellKind:
    """A kind of cell in a file.

    Parameters
    ----------
    name : str
        What it is called in messages.
    dimension : int
        3 for solids, 2 for surfaces, 1 for lines, 0 for points.
    nodes, corners : int
        Number of nodes, and of corners among them.
    """

    name: str
    dimension: int
    nodes: int
    corners: int


#: Every kind that one of the formats can hold and whose nodes can be counted.
KINDS: Mapping[str, CellKind] = {
    kind.name: kind
    for kind in (
        CellKind("point", 0, 1, 1),
        CellKind("line2", 1, 2, 2),
        CellKind("line3", 1, 3, 2),
        CellKind("triangle3", 2, 3, 3),
        CellKind("triangle6", 2, 6, 3),
        CellKind("quadrilateral4", 2, 4, 4),
        CellKind("quadrilateral8", 2, 8, 4),
        CellKind("quadrilateral9", 2, 9, 4),
        CellKind("tetrahedron4", 3, 4, 4),
        CellKind("tetrahedron10", 3, 10, 4),
        CellKind("hexahedron8", 3, 8, 8),
        CellKind("hexahedron20", 3, 20, 8),
        CellKind("hexahedron27", 3, 27, 8),
        CellKind("wedge6", 3, 6, 6),
        CellKind("wedge15", 3, 15, 6),
        CellKind("wedge18", 3, 18, 6),
        CellKind("pyramid5", 3, 5, 5),
        CellKind("pyramid13", 3, 13, 5),
        CellKind("pyramid14", 3, 14, 5),
    )
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Block:
    """Cells of one kind.

    Parameters
    ----------
    kind : CellKind
    nodes : (k, m) int array
        Rows of `RawMesh.points`; corners, then mid-side nodes in the order of VTK.
    groups : mapping of str to (g,) int array
        Rows of ``nodes`` in each named group of the file.
    """

    kind: CellKind
    nodes: Ints
    groups: Mapping[str, Ints] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawMesh:
    """Content of a mesh file.

    Parameters
    ----------
    path : Path
        The file, for messages.
    points : (n, 3) float array
        In the unit of the file.
    blocks : tuple of Block
        Cells in the order of the file.
    node_sets : mapping of str to (k,) int array
        Rows of ``points`` in each named set.
    surfaces : mapping of str to (s, 4) int array
        Corners of the sides of cells in each named surface, -1 in the last place of triangles and in two of edges.
    sections : tuple of str
        Groups that the file gives a material, which together hold every cell once.
    named : bool
        Whether the groups were named by a person: they then become regions and faces without a request.
    unit : str
        Unit of length that the file states; empty where it states none.
    omitted : tuple of str
        What of the file was not understood or is not needed, one clause each.
    node_numbers : (n,) int array, optional
        Number in the file of each of ``points``; None where the file has none, and nodes count from 0.
    revolved : str
        As for `Mesh`, where plane cells were turned about an axis.
    """

    path: Path
    points: Array
    blocks: tuple[Block, ...]
    node_sets: Mapping[str, Ints] = field(default_factory=dict)
    surfaces: Mapping[str, Ints] = field(default_factory=dict)
    sections: tuple[str, ...] = ()
    named: bool = True
    unit: str = ""
    omitted: tuple[str, ...] = ()
    node_numbers: Ints | None = None
    revolved: str = ""

    def solids(self) -> tuple[Block, ...]:
        """The blocks of solid cells."""
        return tuple(block for block in self.blocks if block.kind.dimension == 3 and len(block.nodes))


def rows_of(ids: Ints, known: Ints, path: Path, what: str) -> Ints:
    """Find the places of numbers that a file uses, refusing those that it never defines.

    Parameters
    ----------
    ids : int array of any shape
        Numbers used.
    known : (n,) int array
        Numbers defined, in the order of the file.
    path : Path
        The file, for the message.
    what : str
        What the numbers stand for, such as ``"node"``.

    Returns
    -------
    int array of the same shape

    Examples
    --------
    >>> rows_of(np.array([[30, 10]]), np.array([10, 20, 30]), Path("a.inp"), "node")
    array([[2, 0]])
    >>> rows_of(np.array([40]), np.array([10, 20, 30]), Path("a.inp"), "node")
    Traceback (most recent call last):
    turgor.TurgorError: 'a.inp': node 40 is used, but the file does not define it.
    """
    if not len(known):
        raise TurgorError(f"'{path}': the file defines no {what}s.")
    order = np.argsort(known, kind="stable")
    place = np.minimum(np.searchsorted(known[order], ids), len(known) - 1)
    rows = np.asarray(order[place])
    wrong = known[rows] != ids
    if wrong.any():
        raise TurgorError(f"'{path}': {what} {int(ids[wrong].flat[0])} is used, but the file does not define it.")
    return rows


def numbers(text: str, path: Path, what: str) -> list[float]:
    """Read the numbers of a line, separated by spaces or commas; nothing between two commas is 0."""
    words = text.strip().rstrip(",").split(",") if "," in text else text.split()
    try:
        return [float(word.strip().upper().replace("D", "E") or 0) for word in words]
    except ValueError:
        raise TurgorError(f"'{path}': '{text.strip()[:60]}' is not a line of numbers ({what}).") from None
