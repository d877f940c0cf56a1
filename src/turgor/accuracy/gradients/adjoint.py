"""Adjoint derivatives: one solution for each measure, whatever the number of numbers.

With Kᵀ a + Cᵀ b = ∂m/∂u and Fᵀ a + Dᵀ b = ∂m/∂s the derivative is m′ = ∂m/∂p − a · ∂R/∂p − b · ∂c/∂p. The tangent is
symmetric wherever all forces have a potential, so that its factors serve again.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.direct import motion_along
from turgor.accuracy.gradients.equilibrium import Equilibrium
from turgor.accuracy.gradients.smooth_measures import by_unknowns, is_smooth
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.core.results.measures.measure import Measure

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Adjoint:
    """Sensitivity of each measure to a force on every unknown.

    Parameters
    ----------
    unknowns : (m, size) array [SI]
        Change of each measure by a unit of residual, zero at fixed unknowns.
    scalars : (m, k) array [SI]
        By a unit of error of each condition.
    mismatch : float
        Largest relative difference of what the tangent says about them and what residuals do.
    """

    unknowns: Array
    scalars: Array
    mismatch: float

    def slopes(self, residual: Array, errors: Array) -> Array:
        """Changes (m,) of the measures that changes of residual and conditions cause."""
        return -(self.unknowns @ residual) - self.scalars @ errors


def has_adjoint(base: Equilibrium, measures: tuple[Measure, ...]) -> bool:
    """Return whether measures have an adjoint: all are smooth, and the tangent is symmetric.

    Parameters
    ----------
    base : Equilibrium
    measures : tuple of Measure

    Returns
    -------
    bool
    """
    symmetric = base.system.terms.symmetric and base.system.rubbing(base.at) is None
    return symmetric and all(is_smooth(base, each) for each in measures)


def adjoint_of(base: Equilibrium, measures: tuple[Measure, ...], facts: MeshFacts) -> Adjoint:
    """Solve for the adjoint of each measure.

    Parameters
    ----------
    base : Equilibrium
    measures : tuple of Measure
        Smooth ones, which do not depend on the scalars by themselves.
    facts : MeshFacts

    Returns
    -------
    Adjoint
    """
    fixed, adjoints, mismatch = base.system.prescribed, [], 0.0
    for each in measures:
        right = np.where(fixed, 0.0, by_unknowns(base, each, facts))
        unknowns, scalars = base.transposed_answer(right)
        adjoints.append((unknowns, scalars))
        mismatch = max(mismatch, _difference(base, unknowns))
    return Adjoint(np.array([a for a, _ in adjoints]), np.array([b for _, b in adjoints]), mismatch)


def _difference(base: Equilibrium, unknowns: Array) -> float:
    """Relative difference of the forces that a motion causes by the tangent and by residuals."""
    predicted = np.where(base.system.prescribed, 0.0, base.border.tangent.product(unknowns))
    caused, _ = motion_along(base, unknowns, np.zeros(len(base.scalars))).forces()
    return float(np.linalg.norm(caused - predicted)) / max(float(np.linalg.norm(predicted)), 1e-300)
