"""Self-intersection of the surface of a mesh: edges that pass through triangles of another wall or body."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.surface.crossing import winding
from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.meshing.cells import six_node_triangles
from turgor.core.meshing.mesh import TRIANGLE_EDGES, Mesh
from turgor.core.meshing.quality.facing_walls import edge_keys, unit_normals
from turgor.core.meshing.quality.quality_cache import once_per_mesh
from turgor.core.meshing.quality.settings import CHUNK, OVERLAPS
from turgor.core.meshing.surface import outer_triangles

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Four flat triangles that replace a curved one, so that plugs of round holes do not seem to overlap their walls.
QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


def find_overlaps(mesh: Mesh, points: Array | None = None) -> Array:
    """Find points where the surface intersects itself.

    Every edge of the surface is tested against the flat triangles around it. Where it crosses one, the winding number
    of the surface is evaluated at a point a little below both: it is 2 where two walls overlap. With several bodies,
    points all over the surface are tested too, because bodies with flush sides overlap without a crossing.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) array [m], optional
        Positions of the nodes; positions at rest by default.

    Returns
    -------
    (k, 3) array [m]
        Points where walls overlap by about a tenth of an edge or more; a selection if there are many.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.meshing.generate import mesh
    >>> len(find_overlaps(mesh(FastPneuNet(chambers=2, length=20e-3).build(), size=4e-3)))
    0
    """
    x = mesh.points if points is None else points
    curved = six_node_triangles(outer_triangles(mesh))
    triangles = curved[:, :3]
    normals = unit_normals(x, triangles)
    every = edge_keys(np.concatenate([triangles[:, e] for e in TRIANGLE_EDGES]), len(x))
    keys, index = np.unique(every, return_inverse=True)
    edges = np.stack(np.divmod(keys, len(x)), axis=1)
    at_edges = np.zeros((len(edges), 3))
    np.add.at(at_edges, index.ravel(), np.tile(normals, (3, 1)))
    at_edges /= np.maximum(np.linalg.norm(at_edges, axis=1, keepdims=True), 1e-30)
    longest = np.linalg.norm(x[triangles] - x[np.roll(triangles, 1, axis=1)], axis=2).max(axis=1)
    crossings, below = [np.zeros((0, 3))], [np.zeros((0, 3))]
    spheres = _spheres(x, triangles)
    for start in range(0, len(edges), CHUNK):
        part = slice(start, start + CHUNK)
        edge, triangle, place = _crossings(x, edges[part], triangles, normals, spheres)
        inward = normals[triangle] + at_edges[part][edge]
        leaning = np.linalg.norm(inward, axis=1) > OVERLAPS.steep  # walls in contact cross each other at flat angles
        edge, triangle, place, inward = edge[leaning], triangle[leaning], place[leaning], inward[leaning]
        length = np.maximum(longest[triangle], np.linalg.norm(np.diff(x[edges[part][edge]], axis=1)[:, 0], axis=1))
        crossings.append(place)
        below.append(place - OVERLAPS.depth * length[:, None] * inward)
    chosen = _spread(sum(map(len, crossings)), OVERLAPS.points)
    crossed, tested = np.concatenate(crossings)[chosen], np.concatenate(below)[chosen]
    several = len(find_bodies(mesh)) > 1
    middle, inner = _samples(x, triangles, normals, OVERLAPS.points if several else 0)
    fine = x[curved[:, QUARTERS].reshape(-1, 3)]
    inside = np.array([winding(each, fine) > 1.95 for each in (*tested, *inner)], dtype=bool)  # 2 in two walls
    return np.concatenate([crossed, middle])[inside]


@once_per_mesh  # a run checks before it solves, and `solve` itself does
def overlap_at_rest(mesh: Mesh) -> tuple[float, float, float] | None:
    """A place [m] where a mesh overlaps itself at rest; None where it does not.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (float, float, float) or None
    """
    places = find_overlaps(mesh)
    if not len(places):
        return None
    x, y, z = places[len(places) // 2]
    return float(x), float(y), float(z)


def _samples(x: Array, triangles: Ints, normals: Array, most: int) -> tuple[Array, Array]:
    """Points all over the surface, and the points a little below them."""
    some = _spread(len(triangles), most)
    corners = x[triangles[some]]
    length = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1, keepdims=True)
    middle = corners.mean(axis=1)
    return middle, middle - OVERLAPS.depth * length * normals[some]


def _spread(count: int, most: int) -> Ints:
    """At most ``most`` evenly spread numbers from 0 to ``count`` − 1."""
    return np.unique(np.linspace(0, max(count - 1, 0), min(most, count)).round().astype(np.int64))


def _crossings(
    x: Array, edges: Ints, triangles: Ints, normals: Array, spheres: "tuple[cKDTree, Array]"
) -> tuple[Ints, Ints, Array]:
    """Edges that pass through triangles, these triangles, and the points of intersection."""
    edge, triangle = _near(x, edges, triangles, spheres)
    a, b = x[edges[edge, 0]], x[edges[edge, 1]]
    corners, normal = x[triangles[triangle]], normals[triangle]
    above, below = (np.einsum("pi,pi->p", end - corners[:, 0], normal) for end in (a, b))
    crossing = np.flatnonzero(above * below < 0)  # few do
    edge, triangle, corners, normal = edge[crossing], triangle[crossing], corners[crossing], normal[crossing]
    share = above[crossing] / (above[crossing] - below[crossing])
    place = a[crossing] + share[:, None] * (b[crossing] - a[crossing])
    within = np.ones(len(edge), dtype=bool)
    for k in range(3):
        side = corners[:, (k + 1) % 3] - corners[:, k]
        within &= np.einsum("pi,pi->p", np.cross(side, place - corners[:, k]), normal) >= 0
    return edge[within], triangle[within], place[within]


def _spheres(x: Array, triangles: Ints) -> "tuple[cKDTree, Array]":
    """Centers and radii of spheres about triangles."""
    from scipy.spatial import cKDTree  # slow to load, and the results of a mesh are on disk

    center = x[triangles].mean(axis=1)
    return cKDTree(center), np.linalg.norm(x[triangles] - center[:, None], axis=2).max(axis=1)


def _near(x: Array, edges: Ints, triangles: Ints, spheres: "tuple[cKDTree, Array]") -> tuple[Ints, Ints]:
    """Pairs of an edge and a triangle that may intersect and share no corner."""
    from scipy.spatial import cKDTree

    centers, radius = spheres
    half = np.linalg.norm(x[edges[:, 1]] - x[edges[:, 0]], axis=1) / 2
    reach = float(half.max() + radius.max())
    pairs = cKDTree(x[edges].mean(axis=1)).sparse_distance_matrix(centers, reach, output_type="ndarray")
    pairs = pairs[pairs["v"] <= half[pairs["i"]] + radius[pairs["j"]]]
    edge, triangle = pairs["i"], pairs["j"]
    apart = (edges[edge][:, :, None] != triangles[triangle][:, None, :]).all(axis=(1, 2))
    return edge[apart], triangle[apart]
