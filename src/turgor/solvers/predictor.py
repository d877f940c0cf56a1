"""Predictor: where the next equilibrium is expected, from the last ones."""

from collections.abc import Sequence

#: States used at most: a quartic through the last five.
HISTORY = 5


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
