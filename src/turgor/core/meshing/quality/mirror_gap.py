"""Gap between walls and their mirror images, from the distance to the mirror plane."""

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.facing_walls import first_hits, unit_normals
from turgor.core.meshing.quality.settings import FACING, PROXIMITY
from turgor.core.meshing.surface import outer_triangles

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class MirrorWalls:
    """Nodes of walls on one side of a mirror plane.

    Parameters
    ----------
    nodes : (k,) int array
        Nodes that do not lie in the plane.
    axis : int
        Direction of the normal of the plane, which is ``x[axis] == level``.
    level : float [m]
        Position of the plane.
    side : float
        1 where the body lies above the level, -1 where it lies below.
    """

    nodes: Ints
    axis: int
    level: float
    side: float


def find_mirror_walls(mesh: Mesh, cavity: str | None = None) -> tuple[MirrorWalls, ...]:
    """Find the nodes of walls that touch their mirror image when they reach a mirror plane.

    Parameters
    ----------
    mesh : Mesh
    cavity : str, optional
        Name of a cavity, whose walls are taken instead of the outside walls.

    Returns
    -------
    tuple of MirrorWalls
        One for each mirror plane.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> half = mesh(FastPneuNet(chambers=2, length=20e-3, symmetric=True).build(), size=4e-3)
    >>> [(walls.axis, walls.side) for walls in find_mirror_walls(half)]
    [(1, 1.0)]
    """
    if cavity is None:
        inside = [mesh.face_nodes(name) for name in mesh.cavities]
        nodes = np.setdiff1d(outer_triangles(mesh), np.concatenate([np.zeros(0, dtype=np.int64), *inside]))
    else:
        nodes = mesh.face_nodes(cavity)
    size = float(np.ptp(mesh.points, axis=0).max())
    walls = []
    for name in mesh.symmetry_faces:
        plane = mesh.points[mesh.face_nodes(name)]
        axis = int(np.ptp(plane, axis=0).argmin())
        level = float(plane[:, axis].mean())
        side = 1.0 if mesh.points[:, axis].mean() > level else -1.0
        off = side * (mesh.points[nodes, axis] - level) > TOLERANCE.round_off * size
        walls.append(MirrorWalls(nodes[off], axis, level, side))
    return tuple(walls)


def mirror_gap(walls: tuple[MirrorWalls, ...], points: Array) -> float:
    """Return the smallest distance of walls from their mirror planes.

    Parameters
    ----------
    walls : tuple of MirrorWalls
    points : (n, 3) array [m]
        Current positions of all nodes.

    Returns
    -------
    float [m]
        Smallest distance of a node from its plane, which is half of the distance from its image. The distance is
        negative once the node has passed through the plane, and infinite without mirror planes.
    """
    gaps = [each.side * (points[each.nodes, each.axis] - each.level) for each in walls]
    return float(min((gap.min(initial=inf) for gap in gaps), default=inf))


def faces_its_image(mesh: Mesh) -> bool:
    """Return whether an outside wall faces its own mirror image through air, near the plane.

    A triangle faces its image if its normal points to the plane and nothing lies between. Walls that end in the plane
    are left out, because their distance is zero from the start.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    bool

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> faces_its_image(mesh(FastPneuNet(chambers=2, length=20e-3, symmetric=True).build(), size=4e-3))
    False
    """
    planes = find_mirror_walls(mesh)
    if not planes:
        return False
    reach = PROXIMITY.reach * float(np.ptp(mesh.points, axis=0).max()) / 2
    surface = six_node_triangles(outer_triangles(mesh))
    normal, center = unit_normals(mesh.points, surface), mesh.points[surface[:, :3]].mean(axis=1)
    facing, offs = [], []
    for each in planes:
        away = each.side * (center[:, each.axis] - each.level)
        offs.append(np.isin(surface[:, :3], each.nodes))
        facing.append((each.side * normal[:, each.axis] < -FACING.opposed) & (away < reach) & offs[-1].any(axis=1))
    free = first_hits(mesh.points, surface, reach, np.any(facing, axis=0)) < 0
    sees = [free & faces for faces in facing]
    return any(_apart(surface[triangles, :3], off[triangles]) for triangles, off in zip(sees, offs, strict=True))


def _apart(triangles: Ints, off: NDArray[np.bool_]) -> bool:
    """Return whether any connected group of triangles (f, 3) has no corner in the plane."""
    nodes, local = np.unique(triangles, return_inverse=True)
    rows = local.reshape(-1, 3)
    label = groups_of(len(nodes), np.tile(rows[:, 0], 2), rows[:, 1:].T.ravel())
    touching = np.unique(label[rows[~off]])
    return bool(np.setdiff1d(label, touching).size)
