"""Nearest places on a surface of triangles, and on its sharp edges and corners."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.core.geometry.cad.facets import edge_pairs
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.meshing.tetwild.settings import TETWILD

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class NearestPlaces:
    """A surface that answers where its nearest places are.

    Parameters
    ----------
    shape : SurfaceShape
    spacing : float [CAD units]
        About the distance of the points that are looked up.
    """

    shape: SurfaceShape
    spacing: float
    _of: Ints = field(init=False)
    _tree: cKDTree = field(init=False)

    def __post_init__(self) -> None:
        places, of = _samples(self.shape, self.spacing)
        object.__setattr__(self, "_of", of)
        object.__setattr__(self, "_tree", cKDTree(places))

    def faces(self, points: Array) -> Ints:
        """Return the number of the face nearest to each point, (k,)."""
        near = self._candidates(points)
        places = _on_triangles(points[:, None], self.shape.corners[near])
        away = np.linalg.norm(places - points[:, None], axis=2)
        return np.asarray(self.shape.face[near[np.arange(len(points)), away.argmin(axis=1)]])

    def on_face(self, points: Array, face: Ints) -> Array:
        """Return the nearest place of each point on a face, (k, 3); the point itself where the face is not near."""
        near = self._candidates(points)
        places = _on_triangles(points[:, None], self.shape.corners[near])
        away = np.linalg.norm(places - points[:, None], axis=2)
        away[self.shape.face[near] != face[:, None]] = np.inf
        best = away.argmin(axis=1)
        rows = np.arange(len(points))
        return np.where(np.isfinite(away[rows, best])[:, None], places[rows, best], points)

    def _candidates(self, points: Array) -> Ints:
        count = min(TETWILD.candidates, len(self._of))
        return np.asarray(self._of[self._tree.query(points, k=count)[1].reshape(len(points), count)])


@dataclass(frozen=True, slots=True, eq=False)
class SharpEdges:
    """Edges between the faces of a surface, and the corners where three faces meet.

    Parameters
    ----------
    ends : (e, 2, 3) array
    faces : (e, 2) int array
        The two faces of each edge, the smaller number first.
    corners : (n, 3) array
    corner_faces : tuple of frozenset
        Faces at each corner.
    """

    ends: Array
    faces: Ints
    corners: Array
    corner_faces: tuple[frozenset[int], ...]

    def on_edge(self, point: Array, faces: frozenset[int]) -> Array | None:
        """Return the nearest place on the edges between two of the faces; None if they do not meet."""
        between = np.isin(self.faces, list(faces)).all(axis=1)
        if not between.any():
            return None
        start, along = self.ends[between, 0], self.ends[between, 1] - self.ends[between, 0]
        square = np.einsum("ei,ei->e", along, along)
        share = np.clip(np.einsum("ei,ei->e", point - start, along) / np.where(square > 0, square, 1.0), 0, 1)
        places = start + share[:, None] * along
        return np.asarray(places[np.linalg.norm(places - point, axis=1).argmin()])

    def at_corner(self, point: Array, faces: frozenset[int]) -> Array | None:
        """Return the nearest corner of all these faces; None if they have none."""
        places = [place for place, around in zip(self.corners, self.corner_faces, strict=True) if faces <= around]
        if not places:
            return None
        return np.asarray(min(places, key=lambda place: float(np.linalg.norm(place - point))))


def sharp_edges(shape: SurfaceShape) -> SharpEdges:
    """Find the edges between the faces of a surface, and its corners."""
    pairs, edges, _ = edge_pairs(shape.triangles)
    faces = np.sort(shape.face[pairs], axis=1)
    border = faces[:, 0] != faces[:, 1]
    around: dict[int, set[int]] = {}
    for node, number in zip(shape.triangles.ravel().tolist(), np.repeat(shape.face, 3).tolist(), strict=True):
        around.setdefault(node, set()).add(number)
    corners = {node: frozenset(faces_there) for node, faces_there in around.items() if len(faces_there) > 2}
    return SharpEdges(
        ends=shape.points[edges[border]],
        faces=faces[border],
        corners=shape.points[list(corners)].reshape(-1, 3),
        corner_faces=tuple(corners.values()),
    )


def _samples(shape: SurfaceShape, spacing: float) -> tuple[Array, Ints]:
    """Points all over the triangles, no further apart than a spacing, and the triangle of each."""
    corners = shape.corners
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    steps = np.maximum(1, np.ceil(longest / spacing)).astype(np.int64)
    places, of = [], []
    for count in np.unique(steps):
        own = np.flatnonzero(steps == count)
        i, j = np.meshgrid(np.arange(count + 1), np.arange(count + 1), indexing="ij")
        inside = (i + j) <= count
        u, v = i[inside] / count, j[inside] / count
        weights = np.stack([1 - u - v, u, v], axis=1)
        places.append(np.einsum("wc,tci->twi", weights, corners[own]).reshape(-1, 3))
        of.append(np.repeat(own, len(weights)))
    return np.concatenate(places), np.concatenate(of)


def _on_triangles(points: Array, corners: Array) -> Array:
    """Nearest place on each triangle, (k, c, 3), for points (k, 1, 3) and corners (k, c, 3, 3)."""
    a, u, v = corners[..., 0, :], corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :]
    normal = np.cross(u, v)
    square = np.einsum("kci,kci->kc", normal, normal)
    safe = np.where(square > 0, square, 1.0)
    w = points - a
    s = np.einsum("kci,kci->kc", np.cross(w, v), normal) / safe
    t = np.einsum("kci,kci->kc", np.cross(u, w), normal) / safe
    inside = (square > 0) & (s >= 0) & (t >= 0) & (s + t <= 1)
    best = a + s[..., None] * u + t[..., None] * v
    away = np.where(inside, np.linalg.norm(best - points, axis=2), np.inf)
    for i in range(3):
        start, along = corners[..., i, :], corners[..., (i + 1) % 3, :] - corners[..., i, :]
        length = np.einsum("kci,kci->kc", along, along)
        share = np.clip(np.einsum("kci,kci->kc", points - start, along) / np.where(length > 0, length, 1.0), 0, 1)
        place = start + share[..., None] * along
        distance = np.linalg.norm(place - points, axis=2)
        nearer = distance < away
        best, away = np.where(nearer[..., None], place, best), np.where(nearer, distance, away)
    return np.asarray(best)
