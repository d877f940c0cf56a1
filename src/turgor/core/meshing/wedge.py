"""Wedges of meshes: cut faces whose nodes match to the last digit, and the whole of which a mesh is one sector."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.wedge import HIGH, LOW, Wedge
from turgor.core.meshing.mesh import Mesh

Array = NDArray[np.float64]


def with_wedge(mesh: Mesh, before: Mesh, wedge: Wedge | None) -> Mesh:
    """Move the nodes of both cut faces to the mean of where they are, turned into one, and say that it is a wedge.

    Parameters
    ----------
    mesh : Mesh
        Of which some mid-side nodes were moved.
    before : Mesh
        The same with all nodes where the generator has put them, so that partners are found there.
    wedge : Wedge or None
        Nothing is done without one.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the cut faces do not match.
    """
    if wedge is None:
        return mesh
    low, high = before.face_nodes(LOW), before.face_nodes(HIGH)
    partners = wedge.partners(before.points, low, high)
    points = mesh.points.copy()
    middle = (points[partners] + wedge.images(points[high], -1)) / 2
    on_axis = np.intersect1d(low, high)
    points[partners] = middle
    points[high] = wedge.images(middle)
    for axis in wedge.across:
        points[on_axis, axis] = wedge.center[axis]
    return replace(mesh, points=points, wedge=wedge)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sectors:
    """Several sectors of a whole, side by side, as one mesh.

    Parameters
    ----------
    mesh : Mesh
        Without a wedge; it has cut faces unless it is the whole.
    nodes : (s, n) int array
        Its node for each node of each sector.
    """

    mesh: Mesh
    nodes: NDArray[np.int64]

    def displacement(self, wedge: Wedge, of_one: Array) -> Array:
        """Displacement (m, 3) of its nodes, of that of the nodes of the modeled sector (n, 3)."""
        out = np.zeros_like(self.mesh.points)
        for number, nodes in enumerate(self.nodes):
            out[nodes] = of_one @ wedge.turn(number).T
        return out


def sectors(mesh: Mesh, count: int | None = None) -> Sectors:
    """Join the sector of a wedge and its turned images to one mesh.

    Parameters
    ----------
    mesh : Mesh
        With a wedge.
    count : int, optional
        How many sectors; all of the whole by default.

    Returns
    -------
    Sectors
    """
    wedge = mesh.wedge
    assert wedge is not None
    count = wedge.fold if count is None else count
    n, leaders = len(mesh.points), mesh.leaders
    high = np.flatnonzero(leaders != np.arange(n))
    owner = np.arange(count * n).reshape(count, n)
    for number in range(count):  # the lower cut of the next sector lies on the higher one of this sector
        if number + 1 < count or count == wedge.fold:
            owner[number, high] = owner[(number + 1) % count, leaders[high]]
    on_axis = np.intersect1d(mesh.face_nodes(LOW), mesh.face_nodes(HIGH))
    owner[:, on_axis] = on_axis
    vertex = np.tile(np.arange(n) < mesh.vertex_count, count)
    used = np.unique(owner)
    used = np.concatenate([used[vertex[used]], used[~vertex[used]]])
    place = np.empty(count * n, dtype=np.int64)
    place[used] = np.arange(len(used))
    nodes = place[owner]
    points = np.concatenate([wedge.images(mesh.points, number) for number in range(count)])[used]
    cuts = {} if count == wedge.fold else {LOW: nodes[0][mesh.faces[LOW]], HIGH: nodes[-1][mesh.faces[HIGH]]}
    faces = {name: np.concatenate([to[face] for to in nodes]) for name, face in mesh.faces.items()}
    cells = len(mesh.cells) * np.arange(count)[:, None]
    joined = replace(
        mesh,
        points=points,
        cells=np.concatenate([to[mesh.cells] for to in nodes]),
        regions={name: (cells + own).ravel() for name, own in mesh.regions.items()},
        faces={name: face for name, face in faces.items() if name not in (LOW, HIGH)} | cuts,
        wedge=None,
    )
    return Sectors(mesh=joined, nodes=nodes)
