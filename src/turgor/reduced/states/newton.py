"""Newton's method in reduced coordinates: linearized stresses, whole updates, substeps."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.reduced.settings import NEWTON
from turgor.reduced.states.equations import Equations, EquationsAt

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Balance:
    """An equilibrium of the reduced equations.

    Parameters
    ----------
    before : EquationsAt
        Before the last update, which is smaller than the tolerance.
    y : (r + m,) array
        Unknowns of the equilibrium.
    inverse : (r + m, r + m) array
        Of the tangent before the last update.
    iterations : int
        Updates of all substeps.
    """

    before: EquationsAt
    y: Array
    inverse: Array
    iterations: int

    @staticmethod
    def of(at: EquationsAt, iterations: int) -> "Balance":
        """Equations that are in balance, with the inverse of their own tangent."""
        return Balance(at, at.y, np.linalg.inv(at.tangent()).astype(np.float64), iterations)

    @property
    def at(self) -> EquationsAt:
        """The equations at the equilibrium, evaluated once more."""
        at = self.before.equations.at(self.y, self.before.inputs)
        assert at is not None  # so small an update turns no point inside out
        return at


def newton(equations: Equations, start: Array, inputs: Array, size: float) -> Balance | int:
    """Solve for inputs from a start; return the number of updates in vain where nothing is found.

    The geometric stiffness has stresses linearized for the last update (Magisano, Leonetti and Garcea 2017, doi
    10.1016/j.cma.2016.10.023). Sheets make a narrow curved valley, across which every update overshoots: so whole
    updates are taken, and shortened only where a point would be turned inside out or the update is too long.

    Parameters
    ----------
    equations : Equations
    start : (r + m,) array
    inputs : (n,) array
    size : float
        Size of trained coordinates.

    Returns
    -------
    Balance or int
    """
    at = equations.at(start, inputs)
    geometric, r = None, equations.sizes[0]
    for iteration in range(1, NEWTON.iterations + 1):
        if at is None:
            return iteration - 1
        try:
            inverse: Array = np.linalg.inv(at.tangent(geometric)).astype(np.float64)
        except np.linalg.LinAlgError:
            return iteration
        update = -(inverse @ at.residual)
        change = float(np.linalg.norm(update[:r]))
        if not np.isfinite(change):
            return iteration
        # a start a little off the valley of a stiff sheet has stresses, and so a tangent, that are far off
        if change <= NEWTON.tolerance * size and iteration > 1:
            return Balance(at, at.y + update, inverse, iteration)
        length = min(1.0, NEWTON.longest * size / max(change, 1e-300))
        length, new = _inside(equations, at, length, update)
        # nearby the tangent itself is as good, and the derivatives by the inputs are those of the last one
        geometric = at.linearized(length * update) if change > NEWTON.near * size else None
        at = new
    return NEWTON.iterations


def _inside(equations: Equations, at: EquationsAt, length: float, update: Array) -> tuple[float, EquationsAt | None]:
    """Shorten an update until no point is turned inside out or too much deeper in an obstacle: length, and place."""
    while length >= NEWTON.shortest:
        new = equations.at(at.y + length * update, at.inputs)
        if new is not None:
            share = min([1.0, *(one.share(other) for one, other in zip(at.obstacles, new.obstacles, strict=True))])
            if share == 1.0:
                return length, new
            return length * share, equations.at(at.y + length * share * update, at.inputs)
        length *= 0.5
    return length, None


def follow(equations: Equations, start: Array, way: tuple[Array, Array], size: float) -> Balance | int:
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
    Balance or int
        Number of updates in vain where nothing was found.
    """
    begin, end = way
    done, share, y, count = 0.0, 1.0, start, 0
    while True:
        aim = min(1.0, done + share)
        result = newton(equations, y, begin + aim * (end - begin), size)
        if isinstance(result, int):
            count += result
            share *= 0.5
            if share < 0.5**NEWTON.substeps:
                return count
            continue
        count += result.iterations
        if aim == 1.0:
            return replace(result, iterations=count)
        done, y, share = aim, result.y, 2.0 * share
