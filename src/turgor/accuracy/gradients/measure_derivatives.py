"""Derived: the derivatives of measures by all numbers of a variation, directly or by adjoints, whichever is cheaper."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.adjoint import Adjoint, adjoint_of, has_adjoint
from turgor.accuracy.gradients.differentiated import Reading
from turgor.accuracy.gradients.direct import forces_of, rates_of
from turgor.accuracy.gradients.equilibrium import Equilibrium
from turgor.accuracy.gradients.neighbor_models import neighbors_of
from turgor.accuracy.gradients.settings import GRADIENTS
from turgor.accuracy.gradients.variation import Variation

Array = NDArray[np.float64]

#: How the derivatives are found: a solution for each number, or for each measure.
DIRECT, ADJOINT = "direct", "adjoint"


@dataclass(frozen=True, slots=True, eq=False)
class Derived:
    """Derivatives of measures by numbers.

    Parameters
    ----------
    slopes : (m, n) array [SI]
    way : str
    solves : int
        Solutions with the factors.
    residual : float
        Largest share of a change of the forces that is left unbalanced.
    """

    slopes: Array
    way: str
    solves: int
    residual: float


def derived(base: Equilibrium, reading: Reading, variation: Variation) -> Derived:
    """Differentiate measures by all numbers of a variation.

    Parameters
    ----------
    base : Equilibrium
    reading : Reading
        Of the measures.
    variation : Variation

    Returns
    -------
    Derived
    """
    if len(reading.measures) < len(variation.values) and has_adjoint(base, reading.measures):
        adjoint = adjoint_of(base, reading.measures, reading.facts())
        if adjoint.mismatch <= GRADIENTS.consistent:
            return _by_adjoint(base, reading, variation, adjoint)
    return _directly(base, reading, variation)


def _directly(base: Equilibrium, reading: Reading, variation: Variation) -> Derived:
    """One solution for each number."""
    slopes, solves, residual = [], 0, 0.0
    for name in variation.values:
        neighbors = neighbors_of(base, variation, name)
        rates = rates_of(base, neighbors)
        slopes.append(reading.slopes(neighbors, rates))
        solves, residual = solves + rates.solves, max(residual, rates.residual)
    return Derived(np.array(slopes).T, DIRECT, solves, residual)


def _by_adjoint(base: Equilibrium, reading: Reading, variation: Variation, adjoint: Adjoint) -> Derived:
    """One solution for each measure."""
    slopes = []
    for name in variation.values:
        neighbors = neighbors_of(base, variation, name)
        places, residual, errors = forces_of(base, neighbors)
        slopes.append(reading.by_number(neighbors, places) + adjoint.slopes(residual, errors))
    return Derived(np.array(slopes).T, ADJOINT, len(reading.measures), adjoint.mismatch)
