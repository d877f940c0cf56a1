"""Bodies of a mesh: the parts that no cell connects to each other."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.bodies.parted import partners
from turgor.core.meshing.mesh import Mesh

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A corner of a cell, moved this far towards the middle of its cell, is in another body where they overlap, and not
#: where they only touch.
INWARD = 0.2

#: A point is looked for in this many cells whose middles are nearest.
NEAREST = 16


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Body:
    """A connected part of a mesh.

    Parameters
    ----------
    cells : (c,) int array
        Its cells, or the sides of its films where the mesh has no cells.
    nodes : (n,) int array
        Their nodes, sorted.
    regions : tuple of str
        Regions that its cells belong to.
    faces : tuple of str
        Faces that lie on it alone; a mirror plane that several bodies share is not among them.
    """

    cells: Ints
    nodes: Ints
    regions: tuple[str, ...]
    faces: tuple[str, ...]


@lru_cache(maxsize=4)  # several checks need it
def find_bodies(mesh: Mesh) -> tuple[Body, ...]:
    """Find the parts of a mesh that share no vertex and no bond: one for an actuator, several of `together`.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    tuple of Body
        In the order of their first cells.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> [body.regions for body in find_bodies(mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3))]
    [('body', 'base')]
    """
    corners = mesh.pieces[:, : mesh.cell_type.corners if len(mesh.cells) else mesh.cell_type.side.corners]
    owner = np.repeat(np.arange(len(corners)), corners.shape[1])
    nodes = len(corners) + corners.ravel()
    bonds = [partners(mesh, faces) for faces in mesh.parted]
    ends = [
        np.concatenate([given, *(len(corners) + pair[k] for pair in bonds)]) for k, given in ((0, owner), (1, nodes))
    ]
    label = groups_of(len(corners) + len(mesh.points), *ends)[: len(corners)]
    return tuple(_body(mesh, np.flatnonzero(label == one)) for one in dict.fromkeys(label.tolist()))


def _body(mesh: Mesh, cells: Ints) -> Body:
    nodes = np.unique(mesh.pieces[cells])
    here, within = np.zeros(len(mesh.pieces), dtype=bool), np.zeros(len(mesh.points), dtype=bool)
    here[cells], within[nodes] = True, True
    return Body(
        cells=cells,
        nodes=nodes,
        regions=tuple(name for name, rows in mesh.regions.items() if here[rows].any()),
        faces=tuple(name for name, sides in mesh.faces.items() if len(sides) and within[sides].all()),
    )


def find_overlap(first: Mesh, second: Mesh) -> Array | None:
    """Find a place that two meshes both fill, by more than a fifth of a cell.

    Parameters
    ----------
    first, second : Mesh

    Returns
    -------
    (3,) array [m] or None
        One such place; None where they are apart, or only touch.

    Examples
    --------
    >>> from turgor.core.geometry.solids import Block
    >>> from turgor.core.meshing.generate import mesh
    >>> cube = mesh(Block().build(), size=10e-3)
    >>> find_overlap(cube, cube) is None
    False
    """
    for one, other in ((first, second), (second, first)):
        corners = one.points[one.cells[:, : one.cell_type.corners]]
        probes = ((1 - INWARD) * corners + INWARD * corners.mean(axis=1, keepdims=True)).reshape(-1, 3)
        inside = probes[_is_inside(other, probes)]
        if len(inside):
            return np.asarray(inside[0])
    return None


def _is_inside(mesh: Mesh, points: Array) -> NDArray[np.bool_]:
    """Which points lie in a cell, its edges taken as straight."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    inside = ((points > low) & (points < high)).all(axis=1)
    rows = np.flatnonzero(inside)
    if not len(rows):
        return inside
    from scipy.spatial import cKDTree  # slow to load, and few meshes have several bodies

    kind = mesh.cell_type
    corners = mesh.points[mesh.cells[:, : kind.corners]]
    near = cKDTree(corners.mean(axis=1)).query(points[rows], k=min(NEAREST, len(corners)))[1].reshape(len(rows), -1)
    fans = np.array([[side[0], side[i], side[i + 1]] for side in kind.sides for i in range(1, kind.side.corners - 1)])
    within = np.zeros(len(rows), dtype=bool)
    for cells in near.T:
        a, b, c = (corners[cells[:, None], fans[:, i]] for i in range(3))
        beyond = np.einsum("pti,pti->pt", np.cross(b - a, c - a), points[rows, None] - a)
        within |= (beyond < 0).all(axis=1)
    inside[rows] = within
    return inside
