"""Direct derivatives: how the solution changes with one number, and how any measure changes along.

Equilibrium R(u, p) = 0 and conditions c(u, s, p) = 0 hold at every value of p. The rates u′, s′ make the differences of
both vanish: (R(u + h u′, p + h) − R(u − h u′, p − h))/2h = 0. Each correction of the rates is one solution with the
factors at hand, and the difference that is left says how good they are. So neither single precision of the factors nor
an approximate tangent matters. Measures are then read at both ends, whatever they are.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.gradients.equilibrium import Equilibrium
from turgor.gradients.neighbors import Neighbors, Place

Array = NDArray[np.float64]

#: The rates are good where the difference that is left is this share of the first one.
TOLERANCE = 1e-8

#: Where round-off lets it fall no further, this is good enough.
ENOUGH = 1e-6

#: Corrections at most; the last one must at least halve what is left.
MOST, LEAST_CONTRACTION = 12, 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """How the solution changes with a number.

    Parameters
    ----------
    unknowns : (size,) array
    scalars : (k,) array
    places : tuple of Place
        The equations at the neighbors, with the unknowns moved at these rates.
    left : float
        Share of the first difference that is left.
    solves : int
        Solutions with the factors.
    """

    unknowns: Array
    scalars: Array
    places: tuple[Place, ...]
    left: float
    solves: int


def rates_of(base: Equilibrium, neighbors: Neighbors) -> Rates:
    """Find how the solution changes with a number.

    Parameters
    ----------
    base : Equilibrium
    neighbors : Neighbors

    Returns
    -------
    Rates

    Raises
    ------
    TurgorError
        If the corrections do not settle, as near a limit point.
    """
    held, conditions = base.system.held, base.conditions
    unknowns, scalars = np.zeros(base.system.size), np.zeros(len(base.scalars))
    unknowns[held] = neighbors.held()
    first, before = 0.0, np.inf
    best: Rates | None = None
    for number in range(MOST):
        places = neighbors.look(unknowns, scalars)
        residual, errors = differences(neighbors, places, held)
        size = float(np.hypot(np.linalg.norm(residual), np.linalg.norm(errors)))
        first = first or size
        if best is None or size < before:
            best = Rates(unknowns.copy(), scalars.copy(), places, size / first if first else 0.0, number)
        if best.left <= TOLERANCE or size > LEAST_CONTRACTION * before:
            break
        before = size
        update, change = base.border.update(-residual, conditions, errors)
        unknowns, scalars = unknowns + update, scalars + change
    assert best is not None
    if best.left > ENOUGH:
        raise unsettled(neighbors.name, best.left)
    return best


def differences(neighbors: Neighbors, places: tuple[Place, ...], held: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Return the difference quotients of the residual, zero at held unknowns, and of the conditions.

    Parameters
    ----------
    neighbors : Neighbors
    places : tuple of Place
    held : (size,) bool array

    Returns
    -------
    tuple of array
    """
    residual = neighbors.difference(lambda _, place: place.at.residual, places)
    residual[held] = 0.0
    return residual, neighbors.difference(lambda _, place: place.errors, places)


def unsettled(name: str, left: float) -> TurgorError:
    """Make the error for rates that do not settle.

    Parameters
    ----------
    name : str
    left : float

    Returns
    -------
    TurgorError
    """
    return TurgorError(
        f"the derivative by '{name}' does not settle: {left:.1e} of the change of the forces is left. The state is "
        "near a limit point, or something switches there, such as a thread that goes slack; take a state away from it."
    )
