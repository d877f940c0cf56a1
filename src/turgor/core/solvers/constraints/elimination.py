"""Elimination: solve a system with a few further unknowns by solutions of its own matrix alone."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """Conditions besides equilibrium: errors (k,), and their derivatives by unknowns (k, size) and scalars (k, k)."""

    errors: Array
    rows: Array
    corner: Array


def eliminated(free: Array, responses: Array, conditions: Conditions, errors: Array) -> tuple[Array, Array]:
    """Solve K Δu + F Δs = −r and C Δu + D Δs = −c for Δu and Δs by block elimination.

    Parameters
    ----------
    free : (size,) array
        −K⁻¹ r, the update of the unknowns without scalars.
    responses : (k, size) array
        −K⁻¹ F, the response to each scalar.
    conditions : Conditions
        With C and D.
    errors : (k,) array
        The errors c.

    Returns
    -------
    ((size,) array, (k,) array)

    Examples
    --------
    >>> line = Conditions(np.zeros(1), np.array([[1.0, 1.0]]), np.zeros((1, 1)))
    >>> eliminated(np.array([1.0, 0.0]), np.array([[0.0, 1.0]]), line, np.array([-3.0]))
    (array([1., 2.]), array([2.]))
    """
    rest = -errors - conditions.rows @ free
    stiffness = np.asarray(conditions.corner + conditions.rows @ responses.T)
    scalars = np.asarray(np.linalg.solve(stiffness, rest), dtype=np.float64)
    return free + scalars @ responses, scalars
