"""Arc: the circle that is closest to a center line, as models of constant curvature have it."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from turgor.systems.robots.backbone import Array


@dataclass(frozen=True, slots=True, eq=False)
class Arc:
    """An arc that begins at the base along x.

    Parameters
    ----------
    curvature : float [1/m]
    direction : float [rad]
        Of bending, about x from y: 90° bends to +z.
    length : float [m]
    misfit : float [m]
        Largest distance of a slice from its place on the arc.
    """

    curvature: float
    direction: float
    length: float
    misfit: float


def arc_places(bends: Array, length: float, shares: Array) -> Array:
    """Places (m, 3) on an arc at shares (m,) of its length, from its base; ``bends`` are its curvatures to y and z."""
    curvature = float(np.hypot(*bends))
    angles = curvature * length * shares
    along = length * shares * np.sinc(angles / np.pi)
    across = length * shares * np.sinc(angles / (2 * np.pi)) * np.sin(angles / 2)
    way = np.asarray(bends) / curvature if curvature else np.zeros(2)
    return np.column_stack([along, across * way[0], across * way[1]])


def arc_of(places: Array, turns: Array, rest: Array) -> Arc:
    """Find the arc that is closest to the slices.

    Parameters
    ----------
    places : (m + 1, 3) array [m]
        Of the slices, the base first.
    turns : (m + 1, 3, 3) array
        Their rotations.
    rest : (m + 1, 3) array [m]
        At rest: what the centers are away from the axis of the base moves along with each slice.

    Returns
    -------
    Arc
    """
    offset = rest - rest[0]
    shares = offset[:, 0] / offset[-1, 0]
    offset = np.column_stack([np.zeros(len(rest)), offset[:, 1:]])
    line = places - places[0] - np.einsum("mab,mb->ma", turns, offset)
    length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
    relative = np.swapaxes(turns[:-1], 1, 2) @ turns[1:]
    bends = relative[:, 1:, 0].sum(axis=0) / length

    def away(x: Array) -> Array:
        return np.asarray((arc_places(x[:2], x[2], shares) - line)[1:].ravel() / length)

    best = least_squares(away, [*bends, length], x_scale=[1 / length, 1 / length, length]).x
    misfit = float(np.linalg.norm(away(best).reshape(-1, 3), axis=1).max()) * length
    return Arc(float(np.hypot(*best[:2])), float(np.arctan2(best[1], best[0])), float(best[2]), misfit)
