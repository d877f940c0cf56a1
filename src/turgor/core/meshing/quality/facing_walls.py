"""Walls that face each other across a gap, found by ray casting along the outward normals."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.bodies.groups import groups_of
from turgor.core.meshing.mesh import TRIANGLE_EDGES
from turgor.core.meshing.quality.settings import CHUNK, FACING

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def edge_keys(edges: Ints, node_count: int) -> Ints:
    """One number for each edge (e, 2), the same for both directions, in the order of the smaller and larger node."""
    return np.asarray(edges.min(axis=1) * node_count + edges.max(axis=1))


def unit_normals(points: Array, triangles: Ints) -> Array:
    """Return the unit normals of the flat triangles between the corners, (f, 3)."""
    corners = points[triangles[:, :3]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(normal / np.linalg.norm(normal, axis=1, keepdims=True))


def first_hits(points: Array, triangles: Ints, reach: float, rays: NDArray[np.bool_] | None = None) -> Ints:
    """Find the first triangle that the ray from each triangle along its outward normal hits.

    The rays start at the centroids. They leave the solid there, so only air lies between a triangle and its hit.

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 3 or more) int array
        The whole surface, normals pointing out of the solid.
    reach : float [m]
        Length of the rays.
    rays : (f,) bool array, optional
        Triangles whose ray is followed; all by default.

    Returns
    -------
    (f,) int array
        Triangle that is hit first, -1 where there is none within reach, or no ray.
    """
    from scipy.spatial import cKDTree  # slow to load, and what the next run asks of its mesh is on disk

    corners = points[triangles[:, :3]]
    origin, normal = corners.mean(axis=1), unit_normals(points, triangles)
    radii = np.linalg.norm(corners - origin[:, None], axis=2).max(axis=1)
    radius = float(radii.max())
    tree, stride = cKDTree(origin), 2 * radius
    low, high = points.min(axis=0), points.max(axis=0)
    hit = np.full(len(triangles), -1, dtype=np.int64)
    active = np.arange(len(triangles)) if rays is None else np.flatnonzero(rays)
    for k in range(int(np.ceil(reach / stride))):
        begin, along = origin[active] + k * stride * normal[active], normal[active]
        inside = ((begin < high) | (along <= 0)) & ((begin > low) | (along >= 0))
        active = active[inside.all(axis=1)]  # the other rays leave the bounding box, or have left it
        for start in range(0, len(active), CHUNK):
            part = active[start : start + CHUNK]
            middle = origin[part] + (k + 0.5) * stride * normal[part]
            # a hit in this stride is at most stride / 2 from the middle, the centroid of its triangle radius further
            near = cKDTree(middle).sparse_distance_matrix(tree, stride / 2 + radius, output_type="ndarray")
            near = near[near["v"] <= (stride / 2 + radii[near["j"]]) * (1 + TOLERANCE.round_off)]
            ray, target = part[near["i"]], near["j"]
            close = _passing(origin, normal, radii, ray, target)
            ray, target = ray[close], target[close]
            distance = _ray_distances(origin[ray], normal[ray], corners[target])
            within = np.flatnonzero((ray != target) & (distance <= min((k + 1) * stride, reach)))
            order = within[np.lexsort((target[within], distance[within], ray[within]))]
            first = order[np.flatnonzero(np.diff(ray[order], prepend=-1))]
            hit[ray[first]] = target[first]
        active = active[hit[active] < 0]
    return hit


def _passing(origin: Array, direction: Array, radii: Array, ray: Ints, target: Ints) -> NDArray[np.bool_]:
    """Which rays pass a triangle no further from its centroid than its corners, as one that hits it does."""
    away = origin[target] - origin[ray]
    along = np.einsum("ij,ij->i", away, direction[ray])
    aside = np.einsum("ij,ij->i", away, away) - along * along
    return np.asarray(aside <= (radii[target] * (1 + TOLERANCE.round_off)) ** 2)


def _ray_distances(origin: Array, direction: Array, corners: Array) -> Array:
    """Distance along each ray to its triangle, inf where it misses (Möller and Trumbore 1997)."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(direction, b)
    determinant = np.einsum("ij,ij->i", a, p)
    scale = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    parallel = np.abs(determinant) < 1e-9 * scale
    inverse = 1 / np.where(parallel, 1.0, determinant)
    t = origin - corners[:, 0]
    u = np.einsum("ij,ij->i", t, p) * inverse
    q = np.cross(t, a)
    v = np.einsum("ij,ij->i", direction, q) * inverse
    distance = np.einsum("ij,ij->i", b, q) * inverse
    tolerance = 1e-9  # the tolerance lets a ray through an edge hit one of its two triangles
    miss = parallel | (u < -tolerance) | (v < -tolerance) | (u + v > 1 + tolerance) | (distance <= 0)
    return np.where(miss, np.inf, distance)


def find_walls(points: Array, triangles: Ints, hit: Ints) -> tuple[Ints, Ints]:
    """Group triangles that face an opposed triangle into walls, and list which walls face each other.

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 6) int array
    hit : (f,) int array
        Triangle that each triangle faces, -1 for none.

    Returns
    -------
    wall : (f,) int array
        Wall of each triangle, -1 for triangles that face no other.
    pairs : (p, 2) int array
        Walls that face each other and share no node, the smaller number first.
    """
    normal = unit_normals(points, triangles)
    seeing = np.flatnonzero(hit >= 0)
    seeing = seeing[np.einsum("ij,ij->i", normal[seeing], normal[hit[seeing]]) < -FACING.opposed]
    facing = np.zeros(len(triangles), dtype=bool)
    facing[seeing] = facing[hit[seeing]] = True
    left, right = _neighbors(triangles)
    smooth = np.einsum("ij,ij->i", normal[left], normal[right]) > FACING.smooth
    left, right = left[smooth], right[smooth]
    facing = _extended(facing, normal, left, right)
    together = facing[left] & facing[right]
    size = len(triangles)
    label = groups_of(size, left[together], right[together])
    wall = np.full(size, -1, dtype=np.int64)
    wall[facing] = np.unique(label[facing], return_inverse=True)[1]
    pairs = np.sort(np.stack([wall[seeing], wall[hit[seeing]]], axis=1), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)
    nodes = [np.unique(triangles[wall == i]) for i in range(int(wall.max(initial=-1)) + 1)]
    apart = [not np.isin(nodes[a], nodes[b]).any() for a, b in pairs]
    return wall, pairs[np.array(apart, dtype=bool)]


def _extended(facing: NDArray[np.bool_], normal: Array, left: Ints, right: Ints) -> NDArray[np.bool_]:
    """Extend walls over the triangles that continue them, because a partner may face a part of a wall only.

    A triangle joins if its normal is near the normal at which the extension started, so no wall continues round a
    fillet.
    """
    facing, start = facing.copy(), normal.copy()
    from_, to = np.concatenate([left, right]), np.concatenate([right, left])
    while True:
        joins = facing[from_] & ~facing[to] & (np.einsum("ij,ij->i", start[from_], normal[to]) > FACING.continued)
        if not joins.any():
            return facing
        start[to[joins]] = start[from_[joins]]
        facing[to[joins]] = True


def _neighbors(triangles: Ints) -> tuple[Ints, Ints]:
    """Pairs of triangles that share an edge; an edge of more than two triangles makes no pair."""
    edges = edge_keys(np.concatenate([triangles[:, e] for e in TRIANGLE_EDGES]), int(triangles.max(initial=0)) + 1)
    owner = np.tile(np.arange(len(triangles)), 3)
    _, inverse, count = np.unique(edges, return_inverse=True, return_counts=True)
    order = np.argsort(inverse, kind="stable")
    order = order[count[inverse[order]] == 2]
    return owner[order[0::2]], owner[order[1::2]]
