"""Sampling: few cells whose weighted forces are those of all, by least squares without negative weights.

Rows are multiplied by the inverse of the reduced tangent, so that what is left is an error of the coordinates. Without
that, soft directions amplify what looks like a small error of forces. Many rows are combined at random to fewer, which
preserves the sizes of all combinations of the columns nearly (Clarkson and Woodruff 2013, doi 10.1145/2488608.2488620).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr_delete, solve_triangular
from scipy.sparse import csr_array

from turgor.reduced.settings import SAMPLING

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
    if len(b) > SAMPLING.rows:
        A, b = combined(A, b, SAMPLING.rows)
    size, left = float(np.linalg.norm(b)), b.copy()
    norms = np.linalg.norm(A, axis=0)
    scale = np.where(norms > 1e-12 * norms.max(initial=1e-300), 1.0 / np.maximum(norms, 1e-300), 0.0)
    if without is not None:
        scale[without] = 0.0
    passive: list[int] = []
    x, factors = np.zeros(0), (np.zeros((len(b), 0)), np.zeros((0, 0)))
    for _ in range(3 * most):
        if float(np.linalg.norm(left)) <= tolerance * size or len(passive) >= most:
            break
        gain = (left @ A) * scale
        gain[passive] = -np.inf
        best = int(gain.argmax())
        if gain[best] <= 1e-14 * size:
            break
        more = _appended(factors, A[:, best])
        if more is None:  # the columns that are taken give it already
            scale[best] = 0.0
            continue
        passive, x, factors = _inner(b, ([*passive, best], np.append(x, 0.0)), more)
        left = b - factors[0] @ (factors[1] @ x)
    order = np.argsort(passive)
    which = np.array(passive, dtype=np.int64)[order]
    return Sample(which, x[order], float(np.linalg.norm(left)) / size if size else 0.0)


def combined(A: Array, b: Array, rows: int) -> tuple[Array, Array]:
    """Add the rows of A and b up to fewer, as many to each, with random signs."""
    random, count = np.random.default_rng(0), len(b)
    place = random.permutation(np.arange(count) % rows)
    signs = random.choice([-1.0, 1.0], count)
    sums = csr_array((signs, (place, np.arange(count))), shape=(rows, count))
    return np.asarray(sums @ A), np.asarray(sums @ b)


def _appended(factors: tuple[Array, Array], column: Array) -> tuple[Array, Array] | None:
    """Factors Q and R of columns with one more; None if it depends on them.

    Gram and Schmidt's method, twice for its round-off. To begin again with every column would take most of the time
    of a training.
    """
    Q, R = factors
    k, part, rest = len(R), np.zeros(len(R)), column
    for _ in range(2):
        along = Q.T @ rest
        part, rest = part + along, rest - Q @ along
    size = float(np.linalg.norm(rest))
    if size <= 1e-10 * float(np.linalg.norm(column)):
        return None
    larger = np.zeros((k + 1, k + 1))
    larger[:k, :k], larger[:k, k], larger[k, k] = R, part, size
    return np.column_stack([Q, rest / size]), larger


def _inner(
    b: Array, taken: tuple[list[int], Array], factors: tuple[Array, Array]
) -> tuple[list[int], Array, tuple[Array, Array]]:
    """Least squares over the taken columns with factors Q and R; those whose number would be negative leave."""
    passive, x = taken
    while passive:
        Q, R = factors
        best: Array = solve_triangular(R, Q.T @ b).astype(np.float64)
        if (best > 0).all():
            return passive, best, factors
        bad = best <= 0
        share = float((x[bad] / np.maximum(x[bad] - best[bad], 1e-300)).min())
        x = x + share * (best - x)
        stay = x > 1e-12 * max(float(x.max()), 1e-300)
        if stay.all():
            stay[int(np.argmin(best))] = False
        passive, x = [p for p, s in zip(passive, stay, strict=True) if s], x[stay]
        for gone in np.flatnonzero(~stay)[::-1]:
            factors = qr_delete(*factors, gone, which="col")
    return passive, np.zeros(0), factors
