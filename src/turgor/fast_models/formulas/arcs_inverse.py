"""Inverse kinematics of several segments of constant curvature, by least squares from several starts."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares

from turgor.fast_models.formulas.arcs import Arc, poses
from turgor.foundation.errors import TurgorError
from turgor.units import deg, mm

Array = NDArray[np.float64]

#: Distance over the total length below which a target counts as reached.
REACHED = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """Segments that reach for a target.

    Parameters
    ----------
    arcs : tuple of Arc
    position_error : float [m]
        Distance of the tip from the target.
    direction_error : float [rad]
        Angle between the tip's x axis and the requested one; 0 where none was requested.
    """

    arcs: tuple[Arc, ...]
    position_error: float
    direction_error: float


def reach(
    position: ArrayLike,
    lengths: Sequence[float],
    *,
    direction: ArrayLike | None = None,
    largest_angle: float = pi,
    throw: bool = True,
) -> Reach:
    """Find curvatures and planes of segments in series whose tip comes to a position, and looks in a direction.

    Where many solutions exist, the one that the starts lead to first is returned; each start bends all segments alike
    by another amount, so that the gentlest comes first.

    Parameters
    ----------
    position : (3,) array [m]
        Where the tip should be; x leads out of the base.
    lengths : sequence of float [m]
        Lengths of the segments, which stay the same. A single segment of free length is `arc_to`.
    direction : (3,) array, optional
        Where the tip's x axis is to look.
    largest_angle : float [rad]
        Most that a segment may bend.
    throw : bool
        Whether a target out of reach is an error; else the nearest is returned.

    Returns
    -------
    Reach

    Raises
    ------
    TurgorError
        If the target was not reached.

    Examples
    --------
    >>> arm = [Arc(curvature=8.0, plane=0.5, length=0.1), Arc(curvature=5.0, plane=2.0, length=0.1)]
    >>> found = reach(poses(arm)[-1][:3, 3], [0.1, 0.1])
    >>> found.position_error < 1e-7, len(found.arcs)
    (True, 2)
    """
    target = np.asarray(position, dtype=np.float64)
    sizes = np.asarray(lengths, dtype=np.float64)
    if target.shape != (3,) or not np.isfinite(target).all():
        raise TurgorError(f"position is {position!r}; three finite coordinates are needed.")
    if not len(sizes) or not (sizes > 0).all():
        raise TurgorError(f"lengths is {lengths!r}; a positive length for each segment is needed.")
    look = None if direction is None else np.asarray(direction, dtype=np.float64)
    if look is not None and (look.shape != (3,) or not np.linalg.norm(look) > 0):
        raise TurgorError(f"direction is {direction!r}; three coordinates of a direction are needed.")
    look = None if look is None else look / np.linalg.norm(look)
    best = _attempts(target, sizes, look, largest_angle)[-1][1]
    result = _reach(best, sizes, target, look)
    total = float(sizes.sum())
    if throw and max(result.position_error / total, result.direction_error) > REACHED:
        raise TurgorError(
            f"the target was not reached: the tip stays {result.position_error / mm:.3g} mm and "
            f"{result.direction_error / deg:.3g} deg away. Segments of {total / mm:g} mm in all may be too short, or "
            "largest_angle too small; throw=False returns the nearest."
        )
    return result


def _attempts(target: Array, sizes: Array, look: Array | None, most: float) -> list[tuple[float, Array]]:
    """Solutions from several starts, the best one last: cost and components (κ l cos φ, κ l sin φ) of each segment."""
    total, count = float(sizes.sum()), len(sizes)
    towards = float(np.arctan2(target[2], target[1]))

    def residual(bends: Array) -> Array:
        tip = poses(_arcs(bends, sizes))[-1]
        off = (tip[:3, 3] - target) / total
        over = np.maximum(np.hypot(*bends.reshape(-1, 2).T) - most, 0.0)
        return np.concatenate([off, [] if look is None else tip[:3, 0] - look, over])

    attempts: list[tuple[float, Array]] = []
    for size in (0.3, 0.9, 1.8):
        for turn in (0.0, pi, 2 * pi / 3):
            plane = towards + turn * np.arange(count)
            start = (size * np.stack([np.cos(plane), np.sin(plane)], axis=1)).ravel()
            solved = least_squares(residual, start, xtol=1e-12, ftol=1e-15, gtol=1e-15, max_nfev=60)
            attempts.append((float(solved.cost), solved.x))
            if solved.cost < (REACHED * 1e-3) ** 2:
                return attempts
    return sorted(attempts, key=lambda each: -each[0])


def _arcs(bends: Array, sizes: Array) -> tuple[Arc, ...]:
    return tuple(
        Arc(curvature=float(np.hypot(c, s)) / size, plane=float(np.arctan2(s, c)), length=size)
        for (c, s), size in zip(bends.reshape(-1, 2).tolist(), sizes.tolist(), strict=True)
    )


def _reach(bends: Array, sizes: Array, target: Array, look: Array | None) -> Reach:
    arcs = _arcs(bends, sizes)
    tip = poses(arcs)[-1]
    off = 0.0 if look is None else float(2 * np.arcsin(min(1.0, float(np.linalg.norm(tip[:3, 0] - look)) / 2)))
    return Reach(arcs=arcs, position_error=float(np.linalg.norm(tip[:3, 3] - target)), direction_error=off)
