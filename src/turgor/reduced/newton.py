"""Newton's method in reduced coordinates: linearized stresses, damping by the natural norm, substeps."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.reduced.equations import Equations, EquationsAt
from turgor.reduced.settings import NEWTON

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """An equilibrium of the reduced equations.

    Parameters
    ----------
    at : EquationsAt
    inverse : (r + m, r + m) array
        Of the tangent there, or of that of the last update.
    iterations : int
        Updates of all substeps.
    """

    at: EquationsAt
    inverse: Array
    iterations: int


def newton(equations: Equations, start: Array, inputs: Array, size: float) -> Found | int:
    """Solve for inputs from a start; return the number of updates in vain where nothing is found.

    Parameters
    ----------
    equations : Equations
    start : (r + m,) array
    inputs : (n,) array
    size : float
        Size of trained coordinates.

    Returns
    -------
    Found or int
    """
    at = equations.at(start, inputs)
    if at is None:
        return 0
    geometric, residual, r = None, at.residual, equations.sizes[0]
    for iteration in range(1, NEWTON.iterations + 1):
        try:
            inverse = np.linalg.inv(at.tangent(geometric))
        except np.linalg.LinAlgError:
            return iteration
        update = -(inverse @ residual)
        before = float(np.linalg.norm(update[:r]))
        if not np.isfinite(before):
            return iteration
        taken = _damped(equations, at, (inverse, update), inputs, before)
        if taken is None:
            return iteration
        length, new, residual, after = taken
        geometric = at.linearized(length * update)
        at = new
        if length == 1.0 and after <= NEWTON.tolerance * size:
            return Found(at, inverse, iteration)
    return NEWTON.iterations


def _damped(
    equations: Equations, at: EquationsAt, step: tuple[Array, Array], inputs: Array, before: float
) -> tuple[float, EquationsAt, Array, float] | None:
    """Shorten an update until the next one, with the same tangent, is shorter: length, place, residual, its size."""
    inverse, update = step
    length = 1.0
    while length >= NEWTON.shortest:
        new = equations.at(at.y + length * update, inputs)
        if new is not None:
            residual = new.residual
            after = float(np.linalg.norm((inverse @ residual)[: equations.sizes[0]]))
            if after <= (1.0 - 0.25 * length) * before or after == 0.0:
                return length, new, residual, after
        length *= 0.5
    return None


def follow(equations: Equations, start: Array, way: tuple[Array, Array], size: float) -> Found | int:
    """Solve at the end of a straight way of inputs from an equilibrium at its beginning, in substeps where needed.

    Parameters
    ----------
    equations : Equations
    start : (r + m,) array
        The equilibrium.
    way : ((n,), (n,)) arrays
        Inputs at the beginning and at the end.
    size : float

    Returns
    -------
    Found or int
        Number of updates in vain where nothing was found.
    """
    begin, end = way
    done, share, y, count = 0.0, 1.0, start, 0
    while True:
        aim = min(1.0, done + share)
        found = newton(equations, y, begin + aim * (end - begin), size)
        if isinstance(found, int):
            count += found
            share *= 0.5
            if share < 0.5**NEWTON.substeps:
                return count
            continue
        count += found.iterations
        if aim == 1.0:
            return Found(found.at, found.inverse, count)
        done, y, share = aim, found.at.y, 2.0 * share
