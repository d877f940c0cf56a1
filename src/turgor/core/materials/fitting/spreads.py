"""Spread of fitted constants: from the scatter about the curves, or between specimens and batches."""

from collections.abc import Sequence
from math import isfinite

import numpy as np

from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.library.fit_spread import SCATTER, FitSpread
from turgor.foundation.errors import TurgorError


def scatter(fit: Fit) -> FitSpread | None:
    """Return the standard errors of a fit as a spread; None where the tests determine only combinations of constants.

    Parameters
    ----------
    fit : Fit
    """
    if fit.undetermined or not all(map(isfinite, fit.errors.values())):
        return None
    return FitSpread(
        of=SCATTER, deviations=dict(fit.errors),
        correlation=tuple(tuple(map(float, row)) for row in fit.correlation),
    )  # fmt: skip


def spread_between(fits: Sequence[Fit], of: str) -> FitSpread:
    """Return the spread of the constants between fits of one law to several specimens or batches.

    Parameters
    ----------
    fits : sequence of Fit
        Two or more of one law.
    of : str
        What they are, such as ``"batches"``.

    Returns
    -------
    FitSpread
        Standard deviations with n − 1, and the correlation.

    Raises
    ------
    TurgorError
        If there are fewer than two, or their laws differ.
    """
    laws = {fit.spec.name for fit in fits}
    if len(fits) < 2 or len(laws) > 1:
        raise TurgorError(
            f"a spread between {of} needs two fits or more of one law; given: {len(fits)} of {', '.join(sorted(laws))}."
        )
    table = np.array([list(fit.values.values()) for fit in fits])
    deviation = table.std(axis=0, ddof=1)
    safe = np.where(deviation > 0, deviation, np.inf)
    away = (table - table.mean(axis=0)) / safe
    correlation = np.clip(away.T @ away / (len(fits) - 1), -1.0, 1.0)
    np.fill_diagonal(correlation, 1.0)
    return FitSpread(
        of=f"{len(fits)} {of}", deviations=dict(zip(fits[0].values, map(float, deviation), strict=True)),
        correlation=tuple(tuple(row) for row in correlation.tolist()),
    )  # fmt: skip
