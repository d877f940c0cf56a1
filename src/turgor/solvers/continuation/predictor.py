"""Predictor: where the next equilibrium is expected, from the last ones."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.engine.system import Evaluation, Stresses, System
from turgor.engine.tangent import Tangent
from turgor.solvers.constraints.loads import load_control
from turgor.solvers.newton.convergence import relative_residual
from turgor.solvers.newton.line_search import evaluate
from turgor.solvers.newton.newton import Start

Array = NDArray[np.float64]

#: States used at most: a quartic through the last five.
HISTORY = 5

#: An extrapolation that leaves a smaller relative residual is taken without trying a lower order.
GOOD_PREDICTION = 0.05

#: An extrapolation is shortened this often at most where it presses walls into each other.
SHORTENINGS = 3

#: A load factor with the unknowns and stresses of its equilibrium.
Known = tuple[float, Array, Stresses]


def lagrange_weights(load_factors: Sequence[float], load_factor: float) -> list[float]:
    """Weights of the states at ``load_factors`` in their polynomial's value at ``load_factor``.

    Examples
    --------
    >>> lagrange_weights([0.0, 1.0, 2.0], 3.0)
    [1.0, -3.0, 3.0]
    """
    weights = []
    for i, t_i in enumerate(load_factors):
        weight = 1.0
        for j, t_j in enumerate(load_factors):
            if i != j:
                weight *= (load_factor - t_j) / (t_i - t_j)
        weights.append(weight)
    return weights


def predicted(system: System, tangent: Tangent, history: Sequence[Known], load: float) -> Start:
    """Extrapolate with the highest order whose residual a lower order does not improve."""
    _, unknowns, stresses = history[-1]
    constraint, best, smallest = load_control(system), Start(unknowns, stresses), np.inf
    if tangent.plain:
        return best
    for count in range(len(history), 0, -1):
        used = history[-count:]
        weights = lagrange_weights([factor for factor, _, _ in used], load)
        trial = np.asarray(sum(w * x for w, (_, x, _) in zip(weights, used, strict=True)))
        at = evaluate(constraint, tangent, (trial, best.scalars), load)
        if at is not None and system.contact.parts and count > 1:
            trial, at = _not_deeper(system, tangent, unknowns, at)
        residual = np.inf if at is None else relative_residual(system, at)
        if np.isfinite(smallest) and residual >= smallest:
            break
        if residual < smallest:
            stresses = Stresses.combine([(w, s) for w, (_, _, s) in zip(weights, used, strict=True)])
            best = Start(trial, stresses, evaluation=at)
            smallest = residual
        if smallest <= GOOD_PREDICTION:
            break
    return best


def _not_deeper(system: System, tangent: Tangent, last: Array, at: Evaluation) -> tuple[Array, Evaluation | None]:
    """Shorten an extrapolation until it presses no wall much deeper into another."""
    constraint, nothing = load_control(system), np.empty(0)
    here = evaluate(constraint, tangent, (last, nothing), at.load_factor)
    found: Evaluation | None = at
    for _ in range(SHORTENINGS):
        if found is None or here is None:
            break
        share = system.contact.shortening(here.contacts, found.contacts)
        if share == 1:
            return found.unknowns, found
        place = last + share * (found.unknowns - last)
        found = evaluate(constraint, tangent, (place, nothing), at.load_factor)
    return (last, here) if found is None else (found.unknowns, found)
