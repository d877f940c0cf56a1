"""From the cell arrays of VTK files to blocks of cells of one kind."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.formats.raw import KINDS, Array, Block, Ints, RawMesh
from turgor.foundation.errors import TurgorError

#: VTK's numbers of the kinds of cells.
_KINDS = {
    1: "point",
    3: "line2",
    5: "triangle3",
    9: "quadrilateral4",
    10: "tetrahedron4",
    12: "hexahedron8",
    13: "wedge6",
    14: "pyramid5",
    21: "line3",
    22: "triangle6",
    23: "quadrilateral8",
    24: "tetrahedron10",
    25: "hexahedron20",
    26: "wedge15",
    32: "wedge18",
    27: "pyramid13",
    28: "quadrilateral9",
    29: "hexahedron27",
}

#: Kinds without a place here that bound no solid: strips, polylines, polygons.
_IGNORED = (0, 2, 4, 6, 7)


@dataclass(frozen=True, slots=True, eq=False)
class VtkCells:
    """The cell arrays of a VTK file.

    Parameters
    ----------
    connectivity : (m,) int array
        Nodes of all cells, one after the other.
    offsets : (c,) int array
        Where each cell ends in ``connectivity``.
    types : (c,) int array
        VTK's number of the kind of each cell.
    labels : dict of str to (c,) int array
        Whole numbers that the file gives its cells; each value makes a group such as ``"material 2"``.
    """

    connectivity: Ints
    offsets: Ints
    types: Ints
    labels: dict[str, Ints]


def vtk_mesh(path: Path, points: Array, content: VtkCells) -> RawMesh:
    """Sort the cells of a VTK file by kind.

    Parameters
    ----------
    path : Path
        The file, for messages.
    points : (n, 3) array
    content : VtkCells

    Returns
    -------
    RawMesh
        With groups that were not named by a person.
    """
    connectivity, offsets, types = content.connectivity, content.offsets, content.types
    starts = np.concatenate([[0], offsets[:-1]]).astype(np.int64)
    if len(offsets) and (len(offsets) != len(types) or offsets[-1] > len(connectivity)):
        raise TurgorError(f"'{path}' is damaged: {len(types)} cells have kinds, {len(offsets)} have nodes.")
    blocks = []
    for number in np.unique(types):
        if int(number) in _IGNORED:
            continue
        if int(number) not in _KINDS:
            raise TurgorError(f"'{path}' has cells of VTK's kind {number}; only first and second order can be read.")
        kind = KINDS[_KINDS[int(number)]]
        cells = np.flatnonzero(types == number)
        if (offsets[cells] - starts[cells] != kind.nodes).any():
            raise TurgorError(f"'{path}' is damaged: a {kind.name} has not {kind.nodes} nodes.")
        nodes = connectivity[starts[cells][:, None] + np.arange(kind.nodes)]
        if nodes.min() < 0 or nodes.max() >= len(points):
            raise TurgorError(f"'{path}': a cell uses node {int(nodes.max())}, but there are {len(points)}.")
        groups = {
            f"{name} {value}": np.flatnonzero(values[cells] == value)
            for name, values in content.labels.items()
            for value in np.unique(values[cells])
        }
        blocks.append(Block(kind=kind, nodes=nodes.astype(np.int64), groups=groups))
    return RawMesh(path=path, points=points, blocks=tuple(blocks), named=False)


def with_names(raw: RawMesh, regions: Sequence[str], faces: Mapping[str, Ints]) -> RawMesh:
    """Give the cells and sides of a file of our own their names.

    Parameters
    ----------
    raw : RawMesh
        Whose cells are numbered by their region in the groups ``"region 0"``, ``"region 1"`` …
    regions : sequence of str
    faces : mapping of str to (s, 4) int array
        Corners of sides, -1 in the last place of triangles.

    Returns
    -------
    RawMesh
    """
    keys = {name: f"region {i}" for i, name in enumerate(regions)}
    blocks = tuple(
        replace(block, groups={n: block.groups[k] for n, k in keys.items() if k in block.groups} | dict(block.groups))
        for block in raw.blocks
    )
    for name, corners in faces.items():
        outside = corners[(corners < -1) | (corners >= len(raw.points))]
        if len(outside):
            last = len(raw.points) - 1
            raise TurgorError(f"'{raw.path}' is damaged: face '{name}' names node {outside[0]}, outside 0..{last}.")
    return replace(raw, blocks=blocks, surfaces=dict(faces), sections=tuple(regions), named=True)
