"""RigidSurface: a rigid body of triangles."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.model.obstacles.rigid_shape import Array, Ints
from turgor.core.model.obstacles.triangulated_shape import TriangulatedShape
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RigidSurface(TriangulatedShape):
    """A rigid body given by triangles, for instance from an STL file (`read_rigid`).

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 3) int array
        Counterclockwise seen from outside, so that normals point out of the rigid body.
    name : str
        Where it came from, for messages.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    name: str = "triangles"

    in_job_files = False

    __repr__ = brief

    def __post_init__(self) -> None:
        points = np.ascontiguousarray(self.points, dtype=np.float64)
        triangles = np.ascontiguousarray(self.triangles, dtype=np.int64)
        if points.ndim != 2 or points.shape[1:] != (3,) or not np.isfinite(points).all():
            raise TurgorError(f"rigid surface '{self.name}': points must be an (n, 3) array of finite numbers.")
        if triangles.ndim != 2 or triangles.shape[1:] != (3,) or not len(triangles):
            raise TurgorError(f"rigid surface '{self.name}': triangles must be an (f, 3) array with at least one row.")
        if triangles.min() < 0 or triangles.max() >= len(points):
            raise TurgorError(f"rigid surface '{self.name}': triangles name points that are not there.")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "triangles", triangles)

    def text(self) -> str:
        """Return the number of triangles and the name."""
        return f"{len(self.triangles):,} triangles of {self.name}"

    def surface(self) -> tuple[Array, Ints]:
        """Return the points and the triangles."""
        return self.points, self.triangles
