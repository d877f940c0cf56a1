"""Gap between walls that face each other, for the warning before they touch."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.facing_walls import find_walls, first_hits, unit_normals
from turgor.core.meshing.quality.settings import PROXIMITY
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Reference coordinates (r, s) of the six nodes of a triangle.
NODES = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """Nodes of one wall of a pair, and nodes (partners) and triangles of the other wall."""

    nodes: Ints
    partners: Ints
    triangles: Ints
    around: Ints  # rows of triangles, sorted by the partner node they touch
    corner: Ints  # local number of this node in the triangle
    start: Ints  # first entry of each partner node in `around`


def _side(nodes: Ints, triangles: Ints) -> _Side:
    partners, local = np.unique(triangles, return_inverse=True)
    order = np.argsort(local.ravel(), kind="stable")
    start = np.searchsorted(local.ravel()[order], np.arange(len(partners) + 1))
    return _Side(nodes, partners, triangles, order // 6, order % 6, start)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FacingWalls:
    """Pairs of walls that face each other through air.

    Parameters
    ----------
    points : (n, 3) array [m]
        Reference positions of the nodes of the mesh.
    walls : tuple of (f, 6) int arrays
        Triangles of each wall.
    pairs : (p, 2) int array
        Which walls face each other.
    """

    points: Array
    walls: tuple[Ints, ...]
    pairs: Ints
    _sides: tuple[_Side, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        both = [*self.pairs.tolist(), *self.pairs[:, ::-1].tolist()]
        sides = tuple(_side(np.unique(self.walls[a]), self.walls[b]) for a, b in both)
        object.__setattr__(self, "_sides", sides)


def find_facing_walls(mesh: Mesh, reach: float | None = None, cavity: str | None = None) -> FacingWalls:
    """Find the outside walls that face each other through air, or the facing walls of one cavity.

    A ray from every outer triangle follows its normal. If the ray hits an opposed triangle first, both face each other.
    Cavities are left out unless one is named, because pressure pushes their walls apart. Walls that share an edge are
    left out, because their distance is zero from the start. A wall is not compared with its own mirror image.

    Parameters
    ----------
    mesh : Mesh
    reach : float [m], optional
        Largest distance; a quarter of the longest side by default.
    cavity : str, optional
        Name of a cavity, whose walls are taken instead of the outside walls.

    Returns
    -------
    FacingWalls

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> walls = find_facing_walls(mesh(FastPneuNet(chambers=3, length=30e-3).build(), size=4e-3))
    >>> len(walls.pairs), round(smallest_gap(walls) * 1e3, 9)  # mm
    (2, 1.0)
    """
    if reach is None:
        reach = PROXIMITY.reach * float(np.ptp(mesh.points, axis=0).max())
    if not (isfinite(reach) and reach > 0):
        raise TurgorError(f"reach is {reach / mm:g} mm; allowed is more than 0.")
    surface = six_node_triangles(outer_triangles(mesh))
    excluded = _of_faces(mesh, surface, mesh.cavities) if cavity is None else ~_of_faces(mesh, surface, [cavity])
    hit = first_hits(mesh.points, surface, reach, ~excluded)
    hit[(hit >= 0) & excluded[hit]] = -1
    wall, pairs = find_walls(mesh.points, surface, hit)
    used = np.unique(pairs)
    walls = tuple(surface[wall == i] for i in used)
    return FacingWalls(points=mesh.points, walls=walls, pairs=np.searchsorted(used, pairs).reshape(-1, 2))


def _of_faces(mesh: Mesh, triangles: Ints, names: Iterable[str]) -> NDArray[np.bool_]:
    """Mask of the triangles of the named faces."""
    n = len(mesh.points)
    keys = [corner_keys(six_node_triangles(mesh.face(name)), n) for name in names]
    return np.isin(corner_keys(triangles, n), np.concatenate([np.zeros(0, dtype=np.int64), *keys]))


def smallest_gap(walls: FacingWalls, displacement: Array | None = None) -> float:
    """Return the smallest gap between facing walls in a deformed state.

    The gap is the distance of the nodes of one wall to the curved triangles of the other, along their normals.

    Parameters
    ----------
    walls : FacingWalls
    displacement : (n, 3) array [m], optional
        Displacement of every node of the mesh; zero by default.

    Returns
    -------
    float [m]
        Smallest distance, negative by the depth of the overlap once walls have passed through each other;
        infinite if no walls face each other.
    """
    x = walls.points if displacement is None else walls.points + displacement
    near = [_nearest(x, side) for side in walls._sides]
    if not near:
        return inf
    guess = np.concatenate([estimate for estimate, _ in near])
    limit = np.partition(guess, min(PROXIMITY.measured, len(guess) - 1))[min(PROXIMITY.measured, len(guess) - 1)]
    for bound in (limit, inf):  # all nodes, in the rare case that none of the nearest has a foot point
        gaps = [
            _gaps(x, side, np.flatnonzero((estimate <= bound) & np.isfinite(estimate)), index)
            for side, (estimate, index) in zip(walls._sides, near, strict=True)
        ]
        smallest = float(min(gap.min(initial=inf) for gap in gaps))
        if isfinite(smallest):
            return smallest
    return inf


def _nearest(x: Array, side: _Side) -> tuple[Array, Ints]:
    """Gap of each node to the tangent plane at its nearest partner node, and the nearest partner node."""
    from scipy.spatial import cKDTree  # slow to load, and few runs follow gaps

    partners = x[side.partners]
    _, index = cKDTree(partners).query(x[side.nodes])
    normals = unit_normals(x, side.triangles)
    edge = x[side.triangles[:, [0, 1, 2]]] - x[side.triangles[:, [1, 2, 0]]]
    at_node = np.add.reduceat(normals[side.around], side.start[:-1], axis=0)
    at_node /= np.linalg.norm(at_node, axis=1, keepdims=True)
    away = x[side.nodes] - partners[index]
    guess = np.einsum("ij,ij->i", away, at_node[index])
    aside = np.linalg.norm(away - guess[:, None] * at_node[index], axis=1)
    spacing = np.sqrt(np.einsum("fei,fei->fe", edge, edge).max())
    return np.where(aside < 0.6 * spacing, guess, inf), index


def _gaps(x: Array, side: _Side, rows: Ints, index: Ints) -> Array:
    """Signed distances of chosen nodes to the triangles around their nearest partner node that hold a foot point."""
    near = index[rows]
    count = side.start[near + 1] - side.start[near]
    owner = np.repeat(side.nodes[rows], count)
    slot = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(side.start[near], count)
    corners, p = x[side.triangles[side.around[slot]]], x[owner]
    rs = NODES[side.corner[slot]]
    for _ in range(PROXIMITY.iterations):
        y, tangents = _surface(corners, rs)
        rs = np.clip(rs + _in_plane(tangents, p - y), -1, 2)
    y, tangents = _surface(corners, rs)
    normal = np.cross(tangents[:, 0], tangents[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    gap = np.einsum("mi,mi->m", p - y, normal)
    aside = np.linalg.norm(p - y - gap[:, None] * normal, axis=1)
    size = np.linalg.norm(tangents[:, 0], axis=1)
    opposite = (rs.min(axis=1) > -PROXIMITY.overhang) & (rs.sum(axis=1) < 1 + PROXIMITY.overhang)
    return np.asarray(gap[opposite & (aside < 0.1 * np.abs(gap) + 1e-3 * size)])


def _in_plane(tangents: Array, offset: Array) -> Array:
    """Components (m, 2) of offsets along the tangents (least squares); zero where the tangents are parallel."""
    a, b, c = (np.einsum("mi,mi->m", tangents[:, i], tangents[:, j]) for i, j in ((0, 0), (0, 1), (1, 1)))
    f, g = (np.einsum("mi,mi->m", tangents[:, i], offset) for i in (0, 1))
    determinant = a * c - b * b
    inverse = np.divide(1, determinant, out=np.zeros_like(a), where=determinant > 1e-12 * a * c)
    return np.stack([(c * f - b * g) * inverse, (a * g - b * f) * inverse], axis=1)


def _surface(corners: Array, rs: Array) -> tuple[Array, Array]:
    """Positions (m, 3) and tangents (m, 2, 3) of six-node triangles at their reference coordinates."""
    r, s = rs[:, 0], rs[:, 1]
    t = 1 - r - s
    N = np.stack([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t], axis=1)
    zero = np.zeros_like(r)
    dr = np.stack([1 - 4 * t, 4 * r - 1, zero, 4 * (t - r), 4 * s, -4 * s], axis=1)
    ds = np.stack([1 - 4 * t, zero, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)], axis=1)
    tangents = np.stack([np.einsum("ma,mai->mi", d, corners) for d in (dr, ds)], axis=1)
    return np.einsum("ma,mai->mi", N, corners), tangents
