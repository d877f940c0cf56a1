"""Rounding of the values that functions are called with."""

#: Digits of the values that functions are called with: the last ones of a float may differ from machine to machine,
#: and a run is found again by its values.
DIGITS = 9


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
    return float(f"{value:.{DIGITS}g}")
