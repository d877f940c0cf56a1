"""Force closure margin of a grasp: the smallest disturbance that contacts of unit force cannot resist."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.measures.grasping.settings import GRASP
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def force_closure_margin(
    points: Array, normals: Array, *, friction: float, center: Array | None = None, length: float | None = None
) -> float:
    """Return the force closure margin of point contacts with friction, after Ferrari and Canny.

    It is the radius of the largest ball around zero within the convex hull of the wrenches (f, τ/ρ) of all contacts,
    whose pressing forces are 1: contacts that press with 1 N together resist every wrench of this size [N], moments
    over the length ρ. 0 means no force closure: some wrench cannot be resisted however hard the contacts press.

    Parameters
    ----------
    points : (k, 3) array [m]
    normals : (k, 3) array
        Unit normals into the object, along which it is pressed.
    friction : float [-]
        Coulomb's coefficient.
    center : (3,) array [m], optional
        About which moments count; the mean of the points by default.
    length : float [m], optional
        Length ρ; the largest distance of a point from the center by default.

    Returns
    -------
    float

    References
    ----------
    Ferrari and Canny 1992, Planning optimal grasps, doi 10.1109/ROBOT.1992.219918.

    Examples
    --------
    Three fingers around a ball, without and with friction:

    >>> angles = 2 * np.pi * np.arange(3) / 3
    >>> around = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    >>> force_closure_margin(0.02 * around, -around, friction=0.0)
    0.0
    >>> round(force_closure_margin(0.02 * around, -around, friction=0.3), 2)
    0.16
    """
    points, normals = np.atleast_2d(points), np.atleast_2d(normals)
    if points.shape != normals.shape or points.shape[1:] != (3,):
        raise TurgorError(f"points have shape {points.shape}, normals {normals.shape}; both need (k, 3).")
    if not friction >= 0:
        raise TurgorError(f"friction is {friction:g}; allowed is 0 or more.")
    middle = points.mean(axis=0) if center is None else np.asarray(center, dtype=np.float64)
    arms = points - middle
    rho = float(np.linalg.norm(arms, axis=1).max(initial=0.0)) if length is None else length
    if len(points) < 2 or not friction or not rho > 0:
        return 0.0  # fewer or frictionless points never resist all six components, but for seven of them on edges
    chosen = _apart(arms, GRASP.most_points)
    return _radius(_wrenches(arms[chosen] / rho, normals[chosen], friction))


def _wrenches(arms: Array, normals: Array, friction: float) -> Array:
    """Wrenches (k m, 6) of the edges of the friction pyramids."""
    helper = np.eye(3)[np.abs(normals).argmax(axis=1) - 1]  # another axis than the one nearest to the normal
    first = np.cross(normals, helper)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(normals, first)
    angles = 2 * np.pi * np.arange(GRASP.edges) / GRASP.edges
    across = np.cos(angles)[:, None, None] * first + np.sin(angles)[:, None, None] * second
    forces = normals + friction * across
    return np.concatenate([forces, np.cross(np.broadcast_to(arms, forces.shape), forces)], axis=2).reshape(-1, 6)


def _radius(wrenches: Array) -> float:
    """Distance from zero to the nearest facet of the hull; 0 where zero is not within."""
    from scipy.spatial import ConvexHull, QhullError  # here: slow to load, and few runs ask for it

    if np.linalg.matrix_rank(wrenches, tol=1e-9) < 6:
        return 0.0
    try:
        offsets = ConvexHull(wrenches, qhull_options="QJ Pp").equations[:, -1]
    except QhullError:
        return 0.0
    return max(0.0, float(-offsets.max()))


def _apart(points: Array, most: int) -> NDArray[np.int64]:
    """Places of at most so many points, each as far as possible from those before it."""
    if len(points) <= most:
        return np.arange(len(points))
    chosen = [int(np.linalg.norm(points, axis=1).argmax())]
    away = np.linalg.norm(points - points[chosen[0]], axis=1)
    while len(chosen) < most:
        chosen.append(int(away.argmax()))
        away = np.minimum(away, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return np.array(chosen)
