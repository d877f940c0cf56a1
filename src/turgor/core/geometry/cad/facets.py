"""Facets: the surface of a CAD part as flat triangles, for cavities and wall thickness.

The triangles are those of the display of the CAD kernel. They are available at once and share their corners, but a
circle has 36 corners only. They give positions and topology; volumes need the exact faces. SciPy's graphs and trees are
imported in functions, because they are slow to load and every job loads this file.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Into how many flat pieces a patch of a film is cut along each edge where one of them is an arc, for pictures.
FILM_CUTS = 6

#: An axis and a position: a mirror plane.
Mirror = tuple[int, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Facets:
    """Triangles of a part.

    Parameters
    ----------
    points : (n, 3) float array [CAD units]
    triangles : (t, 3) int array
        Corners, with the normal out of the solid; between two bodies in either direction.
    face : (t,) int array
        Index of the CAD face in the list of the part.
    outer : (t,) bool array
        False for faces between two bodies.
    """

    points: Array
    triangles: Ints
    face: Ints
    outer: NDArray[np.bool_]

    def corners(self, faces: Ints | None = None) -> Array:
        """Return the corners of the triangles of some faces, or of all, (t, 3, 3)."""
        chosen = self.triangles if faces is None else self.triangles[np.isin(self.face, faces)]
        return np.asarray(self.points[chosen])


def find_facets(shape: Any, faces: list[Any]) -> Facets:
    """Triangulate a part, with normals that point out of its bodies.

    Parameters
    ----------
    shape : CAD shape
        Glued bodies.
    faces : list of CAD faces
        Each once.

    Raises
    ------
    TurgorError
        If a body is not closed.
    """
    data = occ.OCCGeometry(shape)._visualizationData()
    number = {face: i for i, face in enumerate(faces)}
    drawn = np.array([number[face] for face in _unique(occ.OCCGeometry(shape).faces)], dtype=np.int64)
    corners = data["vertices"].reshape(-1, 3).astype(np.float64)
    face = drawn[data["indices"].astype(np.int64)]
    points, triangles = weld(corners)
    flat = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
    triangles, face = triangles[~flat], face[~flat]
    bodies = [np.array([number[f] for f in _unique(body.faces)]) for body in shape.solids]
    for body, which in zip(shape.solids, bodies, strict=True):
        rows = np.flatnonzero(np.isin(face, which))
        triangles[rows] = _outward(points, triangles[rows], str(body.name or "body"))
    shared = np.bincount(np.concatenate(bodies), minlength=len(faces)) > 1
    return Facets(points=points, triangles=triangles, face=face, outer=~shared[face])


def named_facets(shape: Any) -> list[tuple[str, Array]]:
    """Return the name and the triangles (t, 3, 3) [CAD units] of each face of a shape, for pictures.

    Parameters
    ----------
    shape : CAD shape or SurfaceShape
        Glued bodies with named faces.

    Returns
    -------
    list of (str, array)
    """
    if hasattr(shape, "corners"):  # facets are all there is
        return [(face.name, shape.corners[shape.face == i]) for i, face in enumerate(shape.faces)]
    data = occ.OCCGeometry(shape)._visualizationData()
    corners = data["vertices"].reshape(-1, 3, 3).astype(np.float64)
    number = data["indices"].astype(np.int64)
    return [(str(face.name), corners[number == i]) for i, face in enumerate(_unique(occ.OCCGeometry(shape).faces))]


def faces_between(shape: Any) -> list[bool]:
    """Return whether each face of a shape lies between two of its bodies, in the order of `round_facets`."""
    if isinstance(shape, FilmShape):
        return [False] * len(shape.patches)
    if hasattr(shape, "corners"):  # one body
        return [False] * len(shape.faces)
    owners = Counter(face for solid in shape.solids for face in _unique(solid.faces))
    return [owners[face] > 1 for face in _unique(occ.OCCGeometry(shape).faces)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RoundFacets:
    """Triangles of a shape with the normals of the true surface at their corners.

    Parameters
    ----------
    corners, normals : (t, 3, 3) float array [CAD units, -]
    face : (t,) int array
        Place of the face of each triangle in ``faces``.
    faces : list of CAD faces
        Each once.
    """

    corners: Array
    normals: Array
    face: Ints
    faces: list[Any]

    @property
    def areas(self) -> Array:
        """Area of each triangle, (t,) [CAD units²]."""
        a, b, c = (self.corners[:, i] for i in range(3))
        return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)

    @property
    def radii(self) -> Array:
        """Smallest radius of curvature of each triangle, (t,) [CAD units]; inf for plane ones.

        Along an edge of length d whose normals differ by n it is d / |n|: exact for circles.
        """
        length = np.linalg.norm(self.corners - np.roll(self.corners, 1, axis=1), axis=2)
        turned = np.linalg.norm(self.normals - np.roll(self.normals, 1, axis=1), axis=2)
        turned[turned < TOLERANCE.round_off] = 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(turned > 0, length / turned, np.inf).min(axis=1)


def round_facets(shape: Any) -> RoundFacets:
    """Return the triangles of the display of a shape, with the normals of the true surface at their corners.

    Of a patch of a film these are the two between its corners.
    """
    if isinstance(shape, FilmShape):
        return _film_facets(shape)
    geometry = occ.OCCGeometry(shape)
    data = geometry._visualizationData()
    return RoundFacets(
        corners=data["vertices"].reshape(-1, 3, 3).astype(np.float64),
        normals=data["normals"].reshape(-1, 3, 3).astype(np.float64),
        face=data["indices"].astype(np.int64),
        faces=_unique(geometry.faces),
    )


def _film_facets(shape: FilmShape) -> RoundFacets:
    """Flat triangles of a film: two of a patch with straight edges, more where an edge is an arc."""
    grids = [patch.grid(*(2 * [FILM_CUTS if any(patch.arcs) else 1])) for patch in shape.patches]
    quads = [[grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]] for grid in grids]
    each = [np.stack(quad, axis=2).reshape(-1, 4, 3) / METERS_PER_CAD_UNIT for quad in quads]
    corners = np.concatenate(each)[:, [[0, 2, 1], [0, 3, 2]]].reshape(-1, 3, 3)  # seen from outside the cavity
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return RoundFacets(
        corners=corners,
        normals=np.repeat(normal[:, None], 3, axis=1),
        face=np.repeat(np.arange(len(each)), [2 * len(quad) for quad in each]),
        faces=list(shape.patches),
    )


def mirrored(facets: Facets, mirrors: Sequence[Mirror], cuts: Sequence[int]) -> Facets:
    """Add the mirror images to a half or quarter, so that an inlet in a mirror plane is complete.

    Parameters
    ----------
    facets : Facets
        Surface of the modeled part.
    mirrors : sequence of (int, float)
        Axis and position of each mirror plane [CAD units].
    cuts : sequence of int
        CAD faces in these planes, which are not on the surface of the whole part.

    Returns
    -------
    Facets
        A face and its images have the same number.
    """
    points, triangles, face = facets.points, facets.triangles, facets.face
    outer = facets.outer & ~np.isin(face, cuts)
    for axis, position in mirrors:
        image = points.copy()
        image[:, axis] = 2 * position - points[:, axis]
        on = np.abs(points[:, axis] - position) <= TOLERANCE.round_off * float(np.ptp(points, axis=0).max())
        number = np.where(on, np.arange(len(points)), np.arange(len(points)) + len(points))
        points = np.vstack([points, image])
        triangles = np.vstack([triangles, number[triangles][:, ::-1]])
        face, outer = np.tile(face, 2), np.tile(outer, 2)
    return Facets(points=points, triangles=triangles, face=face, outer=outer)


def edge_pairs(triangles: Ints) -> tuple[Ints, Ints, NDArray[np.bool_]]:
    """Find the pairs of triangles that share an edge, without edges of three or more triangles.

    Returns
    -------
    pairs : (p, 2) int array
        The two triangles.
    edges : (p, 2) int array
        The two corners.
    coherent : (p,) bool array
        Whether both have the same orientation, with opposite directions along the edge.
    """
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    owner = np.tile(np.arange(len(triangles)), 3)
    unique, inverse, count = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    inverse = inverse.ravel()
    order = np.argsort(inverse, kind="stable")
    order = order[count[inverse[order]] == 2]
    one, other = order[0::2], order[1::2]
    coherent = directed[one, 0] != directed[other, 0]
    return np.stack([owner[one], owner[other]], axis=1), unique[inverse[one]], coherent


def flux(points: Array, triangles: Ints, origin: Array) -> float:
    """Return ⅓ ∮ (x − origin)·n da over triangles, which is the volume within a closed surface."""
    a, b, c = (points[triangles[:, i]] - origin for i in range(3))
    return float(np.einsum("ti,ti->", a, np.cross(b, c)) / 6)


def _unique(shapes: Any) -> list[Any]:
    return list(dict.fromkeys(shapes))


def weld(corners: Array) -> tuple[Array, Ints]:
    """Join the corners of separate triangles, (3t, 3), to points (n, 3) and triangles (t, 3) that share them."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    points, index = np.unique(corners, axis=0, return_inverse=True)
    reach = TOLERANCE.round_off * float(np.ptp(points, axis=0).max())
    near = cKDTree(points).query_pairs(reach, output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(points), len(points)))
    label = connected_components(graph, directed=False)[1]
    _, first = np.unique(label, return_index=True)
    return points[first], label[index.ravel()].reshape(-1, 3).astype(np.int64)


def _outward(points: Array, triangles: Ints, body: str) -> Ints:
    """Orient the triangles of one body: its largest shell is the outside, all others are voids."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    pairs, _, coherent = edge_pairs(triangles)
    count = len(triangles)
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count)).tocsr()
    shells, shell = connected_components(graph, directed=False)
    turned = turned_alike(triangles, pairs, coherent, [int(np.argmax(shell == i)) for i in range(shells)])
    origin = points[triangles].mean(axis=(0, 1))
    volumes = np.array([flux(points, turned[shell == i], origin) for i in range(shells)])
    if not np.abs(volumes).max() > 0:
        raise TurgorError(f"'{body}' encloses no volume; export it as a solid.")
    signs = np.where(np.arange(shells) == np.abs(volumes).argmax(), 1.0, -1.0)
    wrong = (volumes * signs < 0)[shell]
    return np.asarray(np.where(wrong[:, None], turned[:, ::-1], turned))


def turned_alike(triangles: Ints, pairs: Ints, coherent: NDArray[np.bool_], starts: list[int]) -> Ints:
    """Orient triangles alike: neighbors have opposite directions along their common edge."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order

    pairs, first = np.unique(pairs, axis=0, return_index=True)
    sign = np.where(coherent[first], 1.0, 2.0)  # no entry of a sparse matrix may be zero
    count = len(triangles)
    both = np.concatenate([pairs, pairs[:, ::-1]])
    graph = coo_array((np.tile(sign, 2), (both[:, 0], both[:, 1])), shape=(count, count)).tocsr()
    steps = {(int(i), int(j)): bool(k == 2.0) for (i, j), k in zip(both, np.tile(sign, 2), strict=True)}
    flipped = np.zeros(count, dtype=bool)
    for start in starts:
        order, before = breadth_first_order(graph, start, directed=False)
        for i in order[1:]:
            flipped[i] = flipped[before[i]] ^ steps[int(before[i]), int(i)]
    return np.asarray(np.where(flipped[:, None], triangles[:, ::-1], triangles))
