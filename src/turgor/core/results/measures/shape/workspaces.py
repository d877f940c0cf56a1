"""Workspace: the places that the tip of an actuator with several cavities reaches."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from turgor.core.results.measures.shape.settings import SHAPE
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response

Array = NDArray[np.float64]

#: Columns of a response that say where the tip is.
COLUMNS = ("tip_displacement_x", "tip_displacement_y", "tip_displacement_z")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Workspace:
    """Places that the tip reaches, and the smallest convex body or area around them.

    Parameters
    ----------
    points : (p, 3) array [m]
        Displacements of the tip from rest.
    corners : (k,) int array
        Which points are corners of the convex hull, in order around it where it is flat.
    sides : (s, 3) int array
        Triangles of the hull, by points; none where it is flat.
    area : float [m²]
        Area that a flat hull encloses; of a body the area of its surface.
    volume : float [m³]
        Volume of the hull; 0 where it is flat.

    Raises
    ------
    TurgorError
        When it is made, if the points lie on a line.
    """

    points: Array
    corners: NDArray[np.int64]
    sides: NDArray[np.int64]
    area: float
    volume: float

    __repr__ = brief

    @property
    def flat(self) -> bool:
        """Whether all points lie in one plane."""
        return not len(self.sides)

    @property
    def extent(self) -> Array:
        """Least and greatest displacement along x, y and z, (2, 3) [m]."""
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])


def workspace(responses: Sequence[Response]) -> Workspace:
    """Gather the places that the tip reaches along some paths, and find the convex hull around them.

    Each response is measured with ``tip_displacement_x``, ``tip_displacement_y`` and ``tip_displacement_z``, one for
    each combination of pressures. Every state of every path counts. Between the places that were computed the hull
    assumes that the tip gets everywhere; a workspace with dents is smaller.

    Parameters
    ----------
    responses : sequence of Response
        Four states at least that are not on a line.

    Returns
    -------
    Workspace

    Raises
    ------
    TurgorError
        If a column is missing, or the points lie on a line.

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> def to(x, y, z):
    ...     ends = zip(COLUMNS, (x, y, z), strict=True)
    ...     columns = tuple(Column(name, "mm", [0, end * 1e-3]) for name, end in ends)
    ...     return Response(columns=columns, source=Source(text="a ruler"))
    >>> flat = workspace([to(0, 20, 0), to(0, 20, 10), to(0, 0, 10)])
    >>> flat.flat, round(flat.area * 1e6, 6)  # mm²
    (True, 200.0)
    >>> round(workspace([to(0, 20, 0), to(0, 0, 10), to(30, 0, 0)]).volume * 1e9, 6)  # mm³
    1000.0
    """
    missing = next((name for each in responses for name in COLUMNS if name not in each.names), None)
    if missing is not None:
        raise TurgorError(f"a response has no column '{missing}'; measure {', '.join(COLUMNS)} of every path.")
    if not responses:
        raise TurgorError("a workspace needs the responses of some paths.")
    points = np.concatenate([np.stack([each[name] for name in COLUMNS], axis=1) for each in responses])
    centered = points - points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(centered, full_matrices=False)
    dimensions = int((sizes > SHAPE.no_direction * sizes[0]).sum())
    if dimensions < 2:
        raise TurgorError("all places of the tip lie on a line, so they enclose nothing; vary another pressure.")
    if dimensions == 2:
        hull = ConvexHull(centered @ axes[:2].T)
        none = np.zeros((0, 3), dtype=np.int64)
        return Workspace(points=points, corners=hull.vertices, sides=none, area=float(hull.volume), volume=0.0)
    hull = ConvexHull(points)
    return Workspace(
        points=points, corners=hull.vertices, sides=hull.simplices, area=float(hull.area), volume=float(hull.volume)
    )
