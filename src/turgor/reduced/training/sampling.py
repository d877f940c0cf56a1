"""Sampling: few cells whose weighted forces are those of all, by least squares without negative weights.

Rows are multiplied by the inverse of the reduced tangent, so that what is left is an error of the coordinates. Without
that, soft directions amplify what looks like a small error of forces.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """Chosen groups with their factors, and the error that is left, over the size of the right side."""

    which: Ints
    factors: Array
    error: float


def choose(A: Array, b: Array, tolerance: float, most: int, without: Ints | None = None) -> Sample:
    """Choose few columns of A (rows, groups) with ‖A x − b‖ ≤ tolerance ‖b‖ and x ≥ 0 (Lawson and Hanson 1974).

    Parameters
    ----------
    A : (rows, groups) array
    b : (rows,) array
    tolerance : float
    most : int
        Columns at most.
    without : (k,) int array, optional
        Columns that are not taken.

    Returns
    -------
    Sample
    """
    size, left = float(np.linalg.norm(b)), b.copy()
    norms = np.linalg.norm(A, axis=0)
    scale = np.where(norms > 1e-12 * norms.max(initial=1e-300), 1.0 / np.maximum(norms, 1e-300), 0.0)
    if without is not None:
        scale[without] = 0.0
    passive: list[int] = []
    x = np.zeros(0)
    for _ in range(3 * most):
        if float(np.linalg.norm(left)) <= tolerance * size or len(passive) >= most:
            break
        gain = (left @ A) * scale
        gain[passive] = -np.inf
        best = int(gain.argmax())
        if gain[best] <= 1e-14 * size:
            break
        passive, x = _inner(A, b, [*passive, best], np.append(x, 0.0))
        left = b - A[:, passive] @ x
    order = np.argsort(passive)
    which = np.array(passive, dtype=np.int64)[order]
    return Sample(which, x[order], float(np.linalg.norm(left)) / size if size else 0.0)


def _inner(A: Array, b: Array, passive: list[int], x: Array) -> tuple[list[int], Array]:
    """Least squares over the passive columns; those whose factor would be negative leave."""
    while passive:
        best: Array = np.linalg.lstsq(A[:, passive], b, rcond=None)[0].astype(np.float64)
        if (best > 0).all():
            return passive, best
        bad = best <= 0
        share = float((x[bad] / np.maximum(x[bad] - best[bad], 1e-300)).min())
        x = x + share * (best - x)
        stay = x > 1e-12 * max(float(x.max()), 1e-300)
        if stay.all():
            stay[int(np.argmin(best))] = False
        passive, x = [p for p, s in zip(passive, stay, strict=True) if s], x[stay]
    return passive, np.zeros(0)
