"""Parted mesh: the nodes between two bodies are doubled, so that the bodies can come off each other."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.round_off import ROUND_OFF

Ints = NDArray[np.int64]


def parted_faces(name: str, between: tuple[str, str]) -> tuple[str, str]:
    """Names of the two faces of a bond, one on each body.

    Examples
    --------
    >>> parted_faces("glue", ("body", "base"))
    ('glue_body', 'glue_base')
    """
    return f"{name}_{between[0]}", f"{name}_{between[1]}"


@lru_cache(maxsize=4)  # models that differ in their loads share a mesh
def parted(mesh: Mesh, name: str, between: tuple[str, str]) -> Mesh:
    """Double the nodes on the sides that two regions share.

    A node at the rim of these sides is doubled where nothing else joins the two bodies there; where another region
    does, the node stays one. The two sides become the faces ``NAME_FIRST`` and ``NAME_SECOND``, with normals out of
    their bodies. A face that lay between the bodies stays on the first one.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of the bond.
    between : (str, str)
        Regions.

    Returns
    -------
    Mesh
        The same mesh where it has these two faces already.

    Raises
    ------
    TurgorError
        If a region is unknown, or the two share no side.
    """
    faces = parted_faces(name, between)
    if faces in mesh.parted:
        return mesh
    taken = [face for face in faces if face in mesh.faces]
    if taken:
        raise TurgorError(f"bond '{name}': the face '{taken[0]}' is there already; give the bond another name.")
    for each in between:
        if each not in mesh.regions:
            raise unknown(f"region for the bond '{name}'", each, mesh.regions)
    first, second = _shared_sides(mesh, between)
    if not len(first):
        raise TurgorError(
            f"bond '{name}': '{between[0]}' and '{between[1]}' share no side of a cell; nothing is bonded."
        )
    cells, origin = _with_copies(mesh, np.unique(cell_sides(mesh.cells)[first]), first)
    sides = cell_sides(cells)
    named = {face: _moved(mesh, face, cells, first) for face in mesh.faces}
    named |= {faces[0]: sides[first], faces[1]: sides[second]}
    order = _vertices_first(cells, mesh.cell_type.corners)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return replace(
        mesh, points=mesh.points[origin[order]], cells=place[cells], parted=(*mesh.parted, faces),
        faces={key: place[at] for key, at in named.items()},
    )  # fmt: skip


def partners(mesh: Mesh, faces: tuple[str, str]) -> tuple[Ints, Ints]:
    """Nodes of the first face of a bond, and those in the same places on the second one; a node may be its own.

    Raises
    ------
    TurgorError
        If a node on one side has none on the other: the two sides were cut differently.
    """
    from scipy.spatial import cKDTree  # here: slow to load, and few meshes are parted

    first, second = (np.unique(mesh.carrying_sides(face)) for face in faces)
    distance, nearest = cKDTree(mesh.points[second]).query(mesh.points[first])
    if float(distance.max()) > ROUND_OFF.mesh_digits * float(np.ptp(mesh.points, axis=0).max()):
        raise TurgorError(f"the faces '{faces[0]}' and '{faces[1]}' of a bond do not match node by node.")
    return first, second[nearest]


def _shared_sides(mesh: Mesh, between: tuple[str, str]) -> tuple[Ints, Ints]:
    """Rows of `cell_sides` that the two regions share: of the first, and of the second in the same order."""
    keys = corner_keys(cell_sides(mesh.cells), len(mesh.points))
    count = len(keys) // len(mesh.cells)
    rows = [(count * mesh.regions[name][:, None] + np.arange(count)).ravel() for name in between]
    _, one, other = np.intersect1d(keys[rows[0]], keys[rows[1]], return_indices=True)
    return rows[0][one], rows[1][other]


def _with_copies(mesh: Mesh, nodes: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Cells with a copy of each node for every group of cells around it, and the node that each node comes from.

    Two cells around a node are of one group if they share a side with this node that is not bonded.
    """
    count = len(mesh.points)
    cell, column = np.nonzero(np.isin(mesh.cells, nodes))
    at = mesh.cells[cell, column]
    group = groups_of(len(cell), *_joined(mesh, nodes, first, cell * count + at))
    lowest = np.full(count, len(cell))
    np.minimum.at(lowest, at, group)
    new = group != lowest[at]
    copies, number = np.unique(group[new], return_inverse=True)
    cells = mesh.cells.copy()
    cells[cell[new], column[new]] = count + number
    source = np.empty(len(copies), dtype=np.int64)
    source[number] = at[new]
    return cells, np.concatenate([np.arange(count), source])


def _joined(mesh: Mesh, nodes: Ints, first: Ints, keys: Ints) -> tuple[Ints, Ints]:
    """Pairs of places (cell, node) that share a node across a side which is not bonded, by their number in ``keys``."""
    sides, count = cell_sides(mesh.cells), len(mesh.points)
    per_cell, by_side = len(sides) // len(mesh.cells), corner_keys(sides, count)
    rows = np.flatnonzero(np.isin(sides, nodes).any(axis=1) & ~np.isin(by_side, by_side[first]))
    rows = rows[np.argsort(by_side[rows], kind="stable")]
    twins = np.flatnonzero(by_side[rows][1:] == by_side[rows][:-1])
    one, other = rows[twins], rows[twins + 1]
    shared = np.isin(sides[one], nodes)
    node = sides[one][shared]
    order = np.argsort(keys)
    ends = [
        order[np.searchsorted(keys, np.repeat(end // per_cell, shared.sum(axis=1)) * count + node, sorter=order)]
        for end in (one, other)
    ]
    return ends[0], ends[1]


def _moved(mesh: Mesh, name: str, cells: Ints, first: Ints) -> Ints:
    """Sides of a face with the nodes that their cells have now; a side that was bonded stays on the first body."""
    before, after, count = cell_sides(mesh.cells), cell_sides(cells), len(mesh.points)
    keys = corner_keys(before, count)
    rank = np.ones(len(keys))
    rank[first] = 0
    order = np.lexsort((rank, keys))
    face = mesh.faces[name]
    row = order[np.searchsorted(keys[order], corner_keys(face, count))]
    column = (face[:, :, None] == before[row][:, None, :]).argmax(axis=2)
    return np.take_along_axis(after[row], column, axis=1)


def _vertices_first(cells: Ints, corners: int) -> Ints:
    """Order of the nodes in which vertices come first."""
    count = int(cells.max()) + 1
    other = np.ones(count, dtype=bool)
    other[cells[:, :corners]] = False
    return np.argsort(other, kind="stable")
