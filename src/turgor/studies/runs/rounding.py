"""Rounding of the values that functions are called with."""

from turgor.studies.runs.settings import RUNS


def rounded(value: float) -> float:
    """Return a value with the digits that functions are called with.

    Parameters
    ----------
    value : float

    Returns
    -------
    float

    Examples
    --------
    >>> rounded(0.1 + 0.2)
    0.3
    """
    return float(f"{value:.{RUNS.digits}g}")


def percent(share: float) -> str:
    """Write a share in percent with two digits, and whole percents in full.

    Examples
    --------
    >>> percent(0.9973), percent(0.0312), percent(1.234)
    ('100', '3.1', '123')
    """
    return f"{100 * share:.0f}" if abs(100 * share) >= 99.5 else f"{100 * share:.2g}"
