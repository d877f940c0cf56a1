"""Wall thickness of a part, measured along rays into the material."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import Facets
from turgor.core.geometry.shapes.tolerances import TOLERANCE

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class WallSettings:
    """How walls are measured.

    Parameters
    ----------
    work, fewest, most : float, int, int
        Tests of a ray with a triangle, a quarter of a second of them, which give the number of rays; and its limits.
    opposed : float
        Cosine of the largest angle, 25°, between the ray and the normal of the opposite wall; it excludes wedges.
    thinner : float
        Share of the surface that may be thinner than the reported wall: chips, sharp edges, ends of fillets.
    """

    work: float = 3e7
    fewest: int = 1_000
    most: int = 3_000
    opposed: float = 0.9
    thinner: float = 0.01


WALLS = WallSettings()

#: Rays evaluated together: so few that their tests stay close to the processor; 200 take twice as long.
CHUNK = 25


def smallest_wall(facets: Facets) -> float:
    """Return the thickness that 99 % of the walls of a part exceed [CAD units].

    Rays start at points spread evenly over the surface and follow the inward normal to the opposite face.

    Parameters
    ----------
    facets : Facets
        Surface of the part.

    Returns
    -------
    float
        At most the extent of the part, if no walls face each other.
    """
    extent = float(np.ptp(facets.points, axis=0).max())
    return min(thinnest_wall(facets.corners()[facets.outer])[0], extent)


def thinnest_wall(
    triangles: Array, chosen: NDArray[np.bool_] | None = None, most: int = WALLS.most
) -> tuple[float, Array | None]:
    """Return the thickness that 99 % of walls exceed, and a place on the surface behind which it is.

    Parameters
    ----------
    triangles : (t, 3, 3) array
        The surface, with normals out of the solid, in any unit of length.
    chosen : (t,) bool array, optional
        Triangles whose walls are looked at; all by default.
    most : int
        Largest number of rays.

    Returns
    -------
    thickness : float
        In the unit of the triangles; inf if no walls face each other.
    place : (3,) array or None

    Examples
    --------
    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> slab = np.stack([corners + [0, 0, 0.1], corners[::-1]])
    >>> round(thinnest_wall(slab)[0], 12)
    0.1
    """
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    area = np.linalg.norm(normal, axis=1)
    solid = area > 0
    weights = area[solid] if chosen is None else np.where(chosen, area, 0.0)[solid]
    triangles, normal = triangles[solid], normal[solid] / area[solid, None]
    start, of = _starts(triangles, weights, most)
    thickness = _through(start, -normal[of], triangles, normal)
    walls = thickness[np.isfinite(thickness)]
    if not len(walls):
        return np.inf, None
    thinnest = float(np.quantile(walls, WALLS.thinner))
    return thinnest, start[int(np.abs(thickness - thinnest).argmin())]


def _starts(triangles: Array, area: Array, most: int) -> tuple[Array, NDArray[np.int64]]:
    """Points spread evenly over triangles by their areas, with a fixed seed."""
    generator = np.random.default_rng(0)
    rays = int(np.clip(WALLS.work / len(area), min(WALLS.fewest, most), most))
    of = np.searchsorted(np.cumsum(area) / area.sum(), (np.arange(rays) + 0.5) / rays)
    of = np.minimum(of, len(area) - 1)
    u, v = generator.random((2, rays))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    a, b, c = (triangles[of, i] for i in range(3))
    return a + u[:, None] * (b - a) + v[:, None] * (c - a), of


def _through(start: Array, along: Array, triangles: Array, normal: Array) -> Array:
    """Length of each ray in the material; inf if it leaves through a face that is not opposite.

    A line intersects a triangle if it passes all three edges on the same side. The test is a matrix product of the
    Plücker coordinates of lines and edges.
    """
    size, out = float(np.ptp(triangles, axis=(0, 1)).max()), np.empty(len(start))
    ends = [(triangles[:, i], triangles[:, (i + 1) % 3]) for i in range(3)]
    edges = [np.concatenate([np.cross(p, q), q - p], axis=1).T for p, q in ends]
    offset = np.einsum("ti,ti->t", normal, triangles[:, 0])
    for k in range(0, len(start), CHUNK):
        place, way = start[k : k + CHUNK], along[k : k + CHUNK]
        line, leaving = np.concatenate([way, np.cross(place, way)], axis=1), way @ normal.T
        hit = leaving > TOLERANCE.round_off
        for edge in edges:
            hit &= line @ edge >= -1e-9 * size**2
        distance = np.where(hit, (offset - place @ normal.T) / np.where(hit, leaving, 1.0), np.inf)
        distance[distance < TOLERANCE.round_off * size] = np.inf
        first, rays = distance.argmin(axis=1), np.arange(len(place))
        out[k : k + CHUNK] = np.where(leaving[rays, first] > WALLS.opposed, distance[rays, first], np.inf)
    return out
