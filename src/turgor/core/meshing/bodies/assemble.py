"""Bring the arrays of the mesh generator into the order and orientation of a `Mesh`."""

from dataclasses import dataclass
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import TETRAHEDRON_EDGES, Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.foundation.errors import TurgorError

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Raw:
    """Result of the generator, as arrays.

    Parameters
    ----------
    points : (n, 3) array [m]
        Positions of the nodes.
    cells : (c, 10) int array
        Nodes of each cell, vertices first, mid-side nodes in the order of the generator.
    cell_region : (c,) int array
        Place of the region of each cell in ``regions``.
    regions : tuple of str
        Names of the regions.
    corners : (f, 3) int array
        Corners of the triangles on faces.
    corner_face : (f,) int array
        Place of the face of each triangle in ``faces``.
    faces : tuple of str
        Names of the faces.
    """

    points: NDArray[np.float64]
    cells: Ints
    cell_region: Ints
    regions: tuple[str, ...]
    corners: Ints
    corner_face: Ints
    faces: tuple[str, ...]


def _mid_side_order(points: NDArray[np.float64], cells: Ints) -> list[int]:
    """Which of the generator's mid-side nodes lies on which of our edges, found from where they are."""
    mids = points[cells[:, 4:]]
    off = np.empty((6, 6))
    for i, (a, b) in enumerate(TETRAHEDRON_EDGES):
        middle = (points[cells[:, a]] + points[cells[:, b]]) / 2
        off[i] = np.linalg.norm(mids - middle[:, None], axis=2).mean(axis=0)
    return list(min(permutations(range(6)), key=lambda order: sum(off[i, j] for i, j in enumerate(order))))


def _turned(points: NDArray[np.float64], cells: Ints) -> Ints:
    """Swap two corners of each cell of negative volume, with the mid-side nodes between them."""
    a, b, c = (points[cells[:, i]] - points[cells[:, 0]] for i in (1, 2, 3))
    negative = np.einsum("ci,ci->c", a, np.cross(b, c)) < 0
    return np.where(negative[:, None], cells[:, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]], cells)


def assemble(raw: Raw, geometry: Geometry) -> Mesh:
    """Bring the arrays into the order and orientation of a `Mesh`."""
    if not len(raw.cells):
        raise TurgorError(f"'{geometry.name}' could not be meshed: the generator made no cells; try another size.")
    order = _mid_side_order(raw.points, raw.cells)
    by_region = np.argsort(raw.cell_region, kind="stable")
    cell_region = raw.cell_region[by_region]
    cells = _turned(raw.points, np.hstack([raw.cells[:, :4], raw.cells[:, 4:][:, order]])[by_region])
    nodes = np.concatenate([np.unique(cells[:, :4]), np.unique(cells[:, 4:])])
    number = np.full(len(raw.points), -1, dtype=np.int64)
    number[nodes] = np.arange(len(nodes))
    cells, corners = number[cells], number[raw.corners]
    sides = cell_sides(cells)
    # where two cells share a side, the first one counts: a face between regions points out of the one named first
    keys, index = np.unique(corner_keys(sides, len(nodes)), return_index=True)
    requested = corner_keys(corners, len(nodes))
    place = np.minimum(np.searchsorted(keys, requested), len(keys) - 1)
    if (keys[place] != requested).any():
        raise TurgorError(f"'{geometry.name}': the generator returned faces that are not sides of its cells.")
    triangles = sides[index[place]]
    faces = {
        name: triangles[np.isin(raw.corner_face, [i for i, n in enumerate(raw.faces) if n == name])]
        for name in sorted(set(raw.faces) & set(geometry.faces))
    }
    regions = {
        name: np.flatnonzero(np.isin(cell_region, [i for i, n in enumerate(raw.regions) if n == name]))
        for name in dict.fromkeys(raw.regions)
    }
    return Mesh(points=raw.points[nodes], cells=cells, regions=regions, faces=faces, name=geometry.name)
