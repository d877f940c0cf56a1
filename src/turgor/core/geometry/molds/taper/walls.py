"""Walls of a part that a draft can taper: plane ones, and round ones with their axis along the pull."""

from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.cad.facets import Facets
from turgor.core.geometry.molds.parting import SLOPE, areas
from turgor.core.geometry.molds.taper.pull import Pull, polygon, space_behind

Array = NDArray[np.float64]

#: Corners of facets are on their plane or circle to this share of the size of the part.
ON_SURFACE = 1e-6

#: How far tools reach past the part [CAD units].
MARGIN = 1.0

#: A round face is open where no corner of a facet is within this angle [rad]: a full circle has 36.
OPEN = np.radians(25)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlatFace:
    """A plane face.

    Parameters
    ----------
    point, normal : (3,) float array [CAD units, -]
        A point of the plane, and the normal out of the part.
    lacking : bool
        Whether it is a wall with less draft than requested.
    """

    point: Array
    normal: Array
    lacking: bool

    def plane(self, pull: Pull) -> tuple[Array, Array]:
        """Return a point and the normal of the plane, after the draft where it is a wall."""
        if not self.lacking:
            return self.point, self.normal
        level = self.normal - (self.normal @ pull.along) * pull.along
        level /= np.linalg.norm(level)
        return self._foot(pull), np.cos(pull.draft) * level + np.sin(pull.draft) * pull.along

    def inside(self, pull: Pull, reach: float) -> Any:
        """Return what lies behind the plane."""
        return space_behind(*self.plane(pull), reach)

    def wedge(self, pull: Pull, low: Array, high: Array) -> Any:
        """Return what lies between the wall and the wall with draft, across the whole part from low to high."""
        foot, tilted = self.plane(pull)
        end = float(pull.depth(np.stack([low, high])).max()) + MARGIN
        size = float(np.linalg.norm(high - low)) + MARGIN
        way = np.cross(self.normal, pull.along)
        way /= np.linalg.norm(way)
        start = foot - ((foot - (low + high) / 2) @ way + size) * way
        rises = [np.cross(way, each) for each in (self.normal, tilted)]
        ends = [start + each * (end / (each @ pull.along)) for each in rises]
        return polygon([start, *ends]).Extrude(occ.Vec(*map(float, 2 * size * way)))

    def _foot(self, pull: Pull) -> Array:
        """A point where the wall, or what continues it, meets the plane from which it is tapered."""
        level = self.normal - (self.normal @ pull.along) * pull.along
        rise = pull.along - level * (self.normal @ pull.along) / (level @ level)
        return np.asarray(self.point - float(pull.depth(self.point)) * rise)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RoundFace:
    """A wall round about an axis along the pull.

    Parameters
    ----------
    center : (3,) float array [CAD units]
        Point of the axis in the plane from which it is tapered.
    radius : float [CAD units]
    outward : bool
        Whether the part is inside of it, as of a post.
    start, span : float [rad]
        Where it begins, from the first axis across the pull, and how far it goes around.
    """

    center: Array
    radius: float
    outward: bool
    start: float
    span: float

    lacking = True

    def inside(self, pull: Pull, reach: float) -> Any:
        """Return the post after the draft."""
        return self._turned(pull, [(0.0, 0.0), (self.radius, 0.0), *self._rise(pull, reach), (0.0, reach)], 2 * np.pi)

    def wedge(self, pull: Pull, low: Array, high: Array) -> Any:
        """Return what lies between the wall and the wall with draft."""
        end = float(pull.depth(np.stack([low, high])).max()) + MARGIN
        return self._turned(pull, [(self.radius, 0.0), (self.radius, end), *self._rise(pull, end)[::-1]], self.span)

    def _rise(self, pull: Pull, depth: float) -> list[tuple[float, float]]:
        """Radius and depth of the wall with draft at a depth, below it the apex where a post ends before."""
        radius = self.radius + (-1 if self.outward else 1) * pull.recess(depth)
        return [(radius, depth)] if radius > 0 else [(0.0, self.radius / pull.recess(1.0)), (0.0, depth)]

    def _turned(self, pull: Pull, outline: list[tuple[float, float]], span: float) -> Any:
        first, second = pull.across
        way = np.zeros(3)
        way[first], way[second] = np.cos(self.start), np.sin(self.start)
        corners = [self.center + r * way + depth * pull.along for r, depth in dict.fromkeys(outline)]
        axis = occ.Axis(occ.Pnt(*map(float, self.center)), (occ.X, occ.Y, occ.Z)[pull.axis])
        return polygon(corners).Revolve(axis, degrees(span))


#: A face that bounds what a draft removes; None for other surfaces.
KnownFace = FlatFace | RoundFace | None


def known_faces(faces: list[Any], facets: Facets, pull: Pull) -> list[KnownFace]:
    """Return for each face whether it is flat, or round about the pull, and lacks draft.

    Facets say what kind of face it is. Its place comes from the CAD kernel, because facets have seven digits.

    Parameters
    ----------
    faces : list of CAD faces
    facets : Facets
        Their triangles.
    pull : Pull

    Returns
    -------
    list of FlatFace, RoundFace or None
    """
    near = ON_SURFACE * float(np.ptp(facets.points, axis=0).max())
    return [_known(face, facets.corners(np.array([i])), pull, near) for i, face in enumerate(faces)]


def _known(face: Any, corners: Array, pull: Pull, near: float) -> KnownFace:
    area, normals = areas(corners)
    normal = (area[:, None] * normals).sum(axis=0)
    points = corners.reshape(-1, 3)
    if np.linalg.norm(normal) > 0.5 * area.sum() and np.ptp(points @ normal) < near * np.linalg.norm(normal):
        exact = _vector(face.surf.Normal(0.0, 0.0))
        exact *= np.sign(exact @ normal)
        lacking = -SLOPE < float(exact @ pull.along) < np.sin(pull.draft) - 1e-9
        return FlatFace(point=_vector(face.vertices[0].p), normal=exact, lacking=lacking)
    if np.abs(normals @ pull.along).max() > SLOPE:
        return None
    return _round(face, corners, normals, pull, near)


def _vector(point: Any) -> Array:
    """Coordinates of a point or a direction of the CAD kernel."""
    return np.array([point.x, point.y, point.z]) if hasattr(point, "x") else np.array([point[i] for i in range(3)])


def _round(face: Any, corners: Array, normals: Array, pull: Pull, near: float) -> RoundFace | None:
    first, second = across = list(pull.across)
    of_surface = [_vector(face.surf.Value(u, 0.0))[across] for u in (0.0, np.pi / 2, np.pi)]
    center = (of_surface[0] + of_surface[2]) / 2
    radius = float(np.linalg.norm(of_surface[0] - center))
    spokes = corners[..., across] - center
    if np.abs(np.linalg.norm(spokes, axis=-1) - radius).max() > near or radius < near:
        return None  # a wall round about the pull that is no cylinder
    angle = np.unique(np.arctan2(spokes[..., 1], spokes[..., 0]).round(5))
    gaps = np.diff(np.append(angle, angle[0] + 2 * np.pi))
    widest = int(gaps.argmax())
    start, span = 0.0, 2 * np.pi
    if gaps[widest] > OPEN:
        ends = [_vector(vertex.p)[across] - center for vertex in face.vertices]
        exact = np.array([np.arctan2(y, x) for x, y in ends])
        start, end = (_nearest(exact, angle[(widest + 1) % len(angle)]), _nearest(exact, angle[widest]))
        span = float((end - start) % (2 * np.pi))
    outward = float((normals[:, across] * spokes.mean(axis=1)).sum(axis=1).mean()) > 0
    foot = np.zeros(3)
    foot[first], foot[second], foot[pull.axis] = *center, pull.height
    return RoundFace(center=foot, radius=radius, outward=outward, start=start, span=span)


def _nearest(angles: Array, angle: float) -> float:
    away = np.abs((angles - angle + np.pi) % (2 * np.pi) - np.pi)
    return float(angles[away.argmin()])
