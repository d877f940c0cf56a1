"""Forcing term: the relative residual that each linear solution may leave, so that Newton's method loses little."""

from collections.abc import Sequence

from turgor.core.engine.algebra.linear import REFINED, ROUGH

#: Where digits cost iterations, no solution leaves more than the first, unless the second share of the tolerance does,
#: of which no solution leaves more than the last.
LARGEST, LAST_SHARE, LARGEST_OF_ALL = 1e-2, 0.3, 0.1

#: No more digits are required: the next tangent is cheap. With 1e-5, the sixth of a million unknowns took more than 160
#: iterations, and was factored.
SMALLEST = 1e-3


def forcing(fresh: bool, iterative: bool, residuals: Sequence[float], tolerance: float) -> float:
    """Relative residual of the next linear solution.

    Factors give all digits for little more than one; those of another iterate are not worth it. GMRES pays for each
    digit. It leaves the square of the last reduction (Eisenstat and Walker 1996, choice 2, doi 10.1137/0917003).

    Parameters
    ----------
    fresh : bool
        Whether the tangent is that of the iterate.
    iterative : bool
        Whether digits cost iterations.
    residuals : sequence of float
        Relative residuals of the iterates so far.
    tolerance : float
        Relative residual that ends the iteration.

    Returns
    -------
    float

    Examples
    --------
    >>> forcing(fresh=True, iterative=False, residuals=[1.0], tolerance=1e-6)
    1e-05
    >>> forcing(fresh=True, iterative=True, residuals=[1.0, 0.0625], tolerance=1e-6)
    0.00390625
    >>> forcing(fresh=True, iterative=True, residuals=[1.0, 1e-6], tolerance=1e-6)  # the last one
    0.1
    """
    if not iterative:
        return REFINED if fresh else ROUGH
    reduction = residuals[-1] / residuals[-2] if len(residuals) > 1 else 1.0
    share = min(LARGEST, max(SMALLEST, reduction**2))
    return max(share, min(LARGEST_OF_ALL, LAST_SHARE * tolerance / max(residuals[-1], tolerance)))
