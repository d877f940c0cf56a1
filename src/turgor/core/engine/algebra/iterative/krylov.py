"""GMRES with a preconditioner on the right, its basis in single precision (Saad and Schultz 1986)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Map = Callable[[Array], Array]


def gmres(product: Map, precondition: Map, right: Array, tolerance: float, limit: int) -> tuple[Array | None, int]:
    """Solve a system to a relative residual; return None where that takes more than so many iterations, and how many.

    The basis in single precision needs half the memory and time. What its round-off hides is seen in the residual,
    which is computed in double precision before every start. It starts again where that is not small enough yet.
    """
    target = tolerance * float(np.linalg.norm(right))
    solution, residual, used = np.zeros_like(right), right, 0
    while float(np.linalg.norm(residual)) > target:
        if used >= limit:
            return None, used
        change, steps = _cycle(product, precondition, residual, target, limit - used)
        used += steps
        solution = solution + change
        residual = right - product(solution)
    return solution, used


def _cycle(product: Map, precondition: Map, right: Array, target: float, limit: int) -> tuple[Array, int]:
    """One start: the change of the solution, and the iterations."""
    from scipy.linalg import lstsq  # slow to load, and factors serve most models

    size = float(np.linalg.norm(right))
    basis = np.empty((limit + 1, len(right)), dtype=np.float32)  # pages that are never written take no memory
    basis[0] = right / size
    hessenberg = np.zeros((limit + 1, limit))
    first = np.zeros(limit + 1)
    first[0] = size
    for k in range(limit):
        new = product(precondition(basis[k].astype(np.float64))).astype(np.float32)
        for _ in range(2):  # twice is enough
            part = basis[: k + 1] @ new
            new -= part @ basis[: k + 1]
            hessenberg[: k + 1, k] += part
        hessenberg[k + 1, k] = norm = float(np.linalg.norm(new))
        small = hessenberg[: k + 2, : k + 1]
        shares = lstsq(small, first[: k + 2])[0]
        residual = float(np.linalg.norm(first[: k + 2] - small @ shares))
        if residual <= 0.9 * target or norm <= 1e-6 * float(np.linalg.norm(hessenberg[: k + 1, k])):
            break
        basis[k + 1] = new / norm
    return precondition((shares.astype(np.float32) @ basis[: k + 1]).astype(np.float64)), k + 1
