"""Direct derivatives: how the solution changes with one number, and how any measure changes along.

Equilibrium R(u, p) = 0 and conditions c(u, s, p) = 0 hold at every value of p, so K u′ + F s′ = −∂R/∂p and
C u′ + D s′ = −∂c/∂p with the tangent and its border at hand. The right sides are differences of residuals at the same
unknowns, right for every kind of number; the rates are one solution. A tiny motion along them, with p as it is, says
how good they are: the forces that it causes must balance ∂R/∂p. It corrects them where the tangent is approximate, and
measures are read at its ends, whatever they are.

The motion has a step of its own. A straight motion of a body that rotates strains it with the square of the step, and
a long soft body answers such strains with a stiffness far beyond that of its bending. A step that suits the number
would be too long.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.equilibrium import Equilibrium
from turgor.accuracy.gradients.neighbor_models import Neighbor, Neighbors, Place
from turgor.accuracy.gradients.settings import GRADIENTS
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A tiny motion along rates, forth and back, with all numbers as they are.

    Parameters
    ----------
    itself : Neighbor
        The equations at the state.
    ends : (Place, Place)
    step : float
        Of the number, that would cause it.
    """

    itself: Neighbor
    ends: tuple[Place, Place]
    step: float

    def forces(self) -> tuple[Array, Array]:
        """Rates of residual and conditions, from the difference of the ends."""
        one, other = self.ends
        residual = (one.at.residual - other.at.residual) / (2 * self.step)
        residual[self.itself.system.prescribed] = 0.0
        return residual, (one.errors - other.errors) / (2 * self.step)


@dataclass(frozen=True, slots=True, eq=False)
class Rates:
    """How the solution changes with a number.

    Parameters
    ----------
    unknowns : (size,) array
        Of the free unknowns; the motion of supports is that of ``places``.
    scalars : (k,) array
    places : tuple of Place
        The equations at the neighbors, with the unknowns of the state.
    motion : Motion or None
        None where nothing moves.
    residual : float
        Share of the forces ∂R/∂p that is left.
    solves : int
        Solutions with the factors.
    """

    unknowns: Array
    scalars: Array
    places: tuple[Place, ...]
    motion: Motion | None
    residual: float
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
    places, right, wrong = forces_of(base, neighbors)
    size = _size(right, wrong)
    if not size:
        return Rates(np.zeros(base.system.size), np.zeros(len(base.scalars)), places, None, 0.0, 0)
    unknowns, scalars = base.answer(-right, -wrong)
    best: Rates | None = None
    for number in range(1, GRADIENTS.corrections + 1):
        motion = motion_along(base, unknowns, scalars)
        caused = motion.forces()
        residual, error = right + caused[0], wrong + caused[1]
        share = _size(residual, error) / size
        before = np.inf if best is None else best.residual
        if share < before:
            best = Rates(unknowns, scalars, places, motion, share, number)
        if share <= GRADIENTS.accurate or share > GRADIENTS.contraction * before:
            break
        update, change = base.answer(-residual, -error)
        unknowns, scalars = unknowns + update, scalars + change
    assert best is not None
    if best.residual > GRADIENTS.good_enough:
        raise unsettled(neighbors.name, best.residual)
    return best


def forces_of(base: Equilibrium, neighbors: Neighbors) -> tuple[tuple[Place, ...], Array, Array]:
    """Evaluate the neighbors at the unknowns of the state, with moved supports: places, ∂R/∂p (size,) and ∂c/∂p (k,).

    Parameters
    ----------
    base : Equilibrium
    neighbors : Neighbors

    Returns
    -------
    tuple
    """
    moved = np.zeros(base.system.size)
    moved[base.system.prescribed] = neighbors.prescribed_rates()
    places = neighbors.look(moved)
    residual = neighbors.difference(lambda _, place: place.at.residual, places)
    residual[base.system.prescribed] = 0.0
    return places, residual, neighbors.difference(lambda _, place: place.errors, places)


def motion_along(base: Equilibrium, unknowns: Array, scalars: Array) -> Motion:
    """Move a state a little along rates, forth and back.

    Parameters
    ----------
    base : Equilibrium
    unknowns : (size,) array
    scalars : (k,) array

    Returns
    -------
    Motion

    Raises
    ------
    TurgorError
        If a cell turns inside out.
    """
    itself = Neighbor(base, base.system, base.state.model, base.constraint, 0, 0.0)
    fastest = max(float(np.abs(unknowns).max()), float(np.abs(scalars).max(initial=0.0)), 1e-300)
    step = GRADIENTS.step / fastest
    ends = itself.look(step * unknowns, step * scalars), itself.look(-step * unknowns, -step * scalars)
    if ends[0] is None or ends[1] is None:
        raise TurgorError("a cell is almost inside out at the state; mesh more finely.")
    return Motion(itself, (ends[0], ends[1]), step)


def unsettled(name: str, residual: float) -> TurgorError:
    """Make the error for rates that do not settle.

    Parameters
    ----------
    name : str
    residual : float

    Returns
    -------
    TurgorError
    """
    return TurgorError(
        f"the derivative by '{name}' does not settle: {residual:.1e} of the change of the forces is left. The state is "
        "near a limit point, or something switches there, such as a thread that goes slack; take a state away from it."
    )


def _size(residual: Array, errors: Array) -> float:
    return float(np.hypot(np.linalg.norm(residual), np.linalg.norm(errors)))
