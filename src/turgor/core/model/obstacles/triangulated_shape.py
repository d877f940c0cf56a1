"""TriangulatedShape: the base of shapes whose distance is that to triangles."""

import numpy as np

from turgor.core.geometry.cad.surface.crossing import winding
from turgor.core.model.obstacles.rigid_shape import Array, Ints, RigidShape
from turgor.foundation.errors import TurgorError


class TriangulatedShape(RigidShape):
    """A shape that gives triangles by `surface`, counterclockwise seen from outside; contact refines them as needed."""

    __slots__ = ()

    def surface(self) -> tuple[Array, Ints]:
        """Return the points (p, 3) [m] and the triangles (t, 3) of the closed surface."""
        raise TurgorError(f"shape {type(self).__name__} has no method surface, which gives its triangles.")

    def outline(self, place: Array, extent: Array) -> tuple[Array, Ints]:
        """Return the triangles."""
        points, triangles = self.surface()
        return points + place, triangles

    def nearest(self, points: Array) -> int:
        """Return which of some points is nearest to the middle of a triangle."""
        own, triangles = self.surface()
        from scipy.spatial import cKDTree  # here: few models have an obstacle in a cavity

        return int(cKDTree(own[triangles].mean(axis=1)).query(points)[0].argmin())

    def clearance(self, points: Array) -> float:
        """Return the distance of the box around it from the nearest of some points [m]; 0 inside."""
        own, _ = self.surface()
        low, high = own.min(axis=0), own.max(axis=0)
        return float(np.linalg.norm(np.maximum(0.0, np.maximum(low - points, points - high)), axis=1).min())

    def depths(self, points: Array, allowed: float) -> Array:
        """Return inf of points inside, where the depth is not known, and 0 of others."""
        own, triangles = self.surface()
        low, high = own.min(axis=0) + allowed, own.max(axis=0) - allowed
        near = np.flatnonzero(((points > low) & (points < high)).all(axis=1))
        depth, corners = np.zeros(len(points)), own[triangles]
        depth[near] = [np.inf if winding(points[node], corners) > 0.5 else 0.0 for node in near]
        return depth
