"""SurfaceShape: a part that is given by the facets of its surface, in the place of a CAD shape."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import flux
from turgor.core.geometry.cad.surface.grouping import grouped, vector_areas

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceFace:
    """A group of facets.

    Parameters
    ----------
    name : str
    mass : float [CAD units²]
        Area; the CAD kernel calls the measure of a face so.
    """

    name: str
    mass: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceShape:
    """One body within a closed surface of flat triangles, grouped into faces.

    Parameters
    ----------
    points : (n, 3) array [CAD units]
    triangles : (t, 3) int array
        Corners, with the normal out of the solid.
    face : (t,) int array
        Number of the face of each triangle.
    faces : tuple of SurfaceFace
        The faces.
    """

    points: Array
    triangles: Ints
    face: Ints
    faces: tuple[SurfaceFace, ...]

    @property
    def bounding_box(self) -> tuple[Corner, Corner]:
        """Lowest and highest corner of the box around it, in CAD units."""
        low, high = self.points.min(axis=0).tolist(), self.points.max(axis=0).tolist()
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])

    @property
    def corners(self) -> Array:
        """Corners of the triangles, (t, 3, 3) [CAD units]."""
        return np.asarray(self.points[self.triangles])

    @property
    def vector_areas(self) -> Array:
        """Vector area of each triangle, (t, 3) [CAD units²]."""
        return vector_areas(self.points, self.triangles)

    @property
    def mass(self) -> float:
        """Enclosed volume [CAD units³]; the CAD kernel calls it so."""
        return flux(self.points, self.triangles, self.points.mean(axis=0))

    def named(self, names: tuple[str, ...]) -> "SurfaceShape":
        """Return the same surface with other names of its faces."""
        return replace(self, faces=tuple(replace(f, name=name) for f, name in zip(self.faces, names, strict=True)))

    def scaled(self, factor: float) -> "SurfaceShape":
        """Return the surface in another unit."""
        faces = tuple(replace(f, mass=f.mass * factor**2) for f in self.faces)
        return replace(self, points=self.points * factor, faces=faces)


def surface_shape(points: Array, triangles: Ints) -> SurfaceShape:
    """Group the triangles of a closed surface into faces without names.

    Parameters
    ----------
    points : (n, 3) array [CAD units]
    triangles : (t, 3) int array
        With the normal out of the solid.
    """
    face = grouped(points, triangles)
    areas = np.bincount(face, weights=np.linalg.norm(vector_areas(points, triangles), axis=1))
    faces = tuple(SurfaceFace(name="", mass=float(area)) for area in areas)
    return SurfaceShape(points=points, triangles=triangles, face=face, faces=faces)
