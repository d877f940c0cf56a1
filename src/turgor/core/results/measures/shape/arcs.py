"""Arcs: the circle nearest to points along a line, which may also be straight."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.directions import rotation_of

Array = NDArray[np.float64]


def distance_from_arc(points: Array) -> float:
    """Root mean square distance of points from the circle, or the straight line, that is nearest to them.

    The circle is written by its curvature, which is zero for a line, and by its tangent near the middle of the points,
    so that nearly straight lines are no special case (Karimäki 1991, Nucl. Instrum. Methods A 305, 187).

    Parameters
    ----------
    points : (p, 3) array [m]
        In order along the line; five at least.

    Returns
    -------
    float [m]

    Examples
    --------
    >>> angle = np.linspace(0, 5, 20)
    >>> circle = np.stack([np.cos(angle), np.sin(angle), 0.3 * np.cos(angle)], axis=1)
    >>> distance_from_arc(np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)) < 1e-9
    True
    >>> distance_from_arc(np.outer(angle, [1.0, 2.0, 0.5])) < 1e-9
    True
    >>> distance_from_arc(circle) > 1e-3  # an ellipse
    True
    """
    from scipy.optimize import least_squares  # slow to load, and every job loads the list of measures

    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    scaled = (points - points.mean(axis=0)) / size
    frame, curvature = _first(scaled)
    start = np.array([0.0, 0.0, 0.0, 0.0, 0.0, curvature])
    local = (scaled - scaled[len(scaled) // 2]) @ frame
    fitted = least_squares(_distances, start, args=(local,), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    return size * float(np.sqrt(2 * fitted.cost / len(points)))


def _distances(parameters: Array, points: Array) -> Array:
    """Distances of points from a circle, within its plane and across it, (2 p,)."""
    u, n, w = (points @ rotation_of(parameters[:3])).T
    n, w, c = n - parameters[3], w - parameters[4], parameters[5]
    square = u**2 + n**2
    within = (2 * n - c * square) / (1 + np.sqrt(np.maximum(1 - 2 * c * n + c**2 * square, 0.0)))
    return np.concatenate([within, w])


def _first(points: Array) -> tuple[Array, float]:
    """Axes (tangent, normal, across the plane) at the middle point, and the curvature, of a first circle."""
    across = np.linalg.svd(points - points.mean(axis=0))[2]
    plane = points @ across[:2].T
    (x, y), middle = plane.T, plane[len(plane) // 2]
    # nearest in the sense of a linear equation (Kasa): x² + y² = 2 a x + 2 b y + c
    a, b, c = np.linalg.lstsq(np.stack([2 * x, 2 * y, np.ones_like(x)], axis=1), x**2 + y**2, rcond=None)[0]
    radius = np.sqrt(max(c + a**2 + b**2, 1e-12))
    inward = np.array([a, b]) - middle
    inward /= max(float(np.linalg.norm(inward)), 1e-12)
    normal = inward @ across[:2]
    return np.stack([np.cross(normal, across[2]), normal, across[2]], axis=1), float(1 / radius)
