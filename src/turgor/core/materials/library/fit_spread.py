"""FitSpread: how far the constants of a fitted law are off, as a record states it and as sets that can be computed."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from turgor.core.materials.laws.conventions import has_no_unit
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import parse_quantity

#: What scatters where one fit to all tests states the spread.
SCATTER = "scatter about the curves"

_KEYS = ("of", "deviations", "correlation")


@dataclass(frozen=True, slots=True, kw_only=True)
class FitSpread:
    """Standard deviations of the constants of a law, and their correlation.

    Parameters
    ----------
    of : str
        What scatters, such as ``"5 batches"`` or ``"scatter about the curve"``.
    deviations : mapping of str to float [SI]
        By symbol; 0 for a constant that is fixed.
    correlation : tuple of tuple of float
        In the order of the deviations.
    """

    of: str
    deviations: Mapping[str, float] = field(hash=False)
    correlation: tuple[tuple[float, ...], ...]

    def __post_init__(self) -> None:
        count = len(self.deviations)
        if len(self.correlation) != count or any(len(row) != count for row in self.correlation):
            raise TurgorError(
                f"the spread has {count} deviations; its correlation needs as many rows of as many numbers."
            )
        matrix = np.array(self.correlation)
        if not (np.abs(matrix) <= 1 + ROUND_OFF.same).all() or not np.allclose(matrix, matrix.T, atol=1e-6):
            raise TurgorError("the correlation of the spread is not symmetric with numbers from -1 to 1.")

    def sets(self, constants: Mapping[str, float]) -> tuple[dict[str, float], ...]:
        """Return sets of constants whose mean and covariance are those of the fit.

        They lie on both sides of the fitted constants along the principal axes of the covariance, so that a response
        that is linear in the constants has exactly the standard deviation that the covariance gives.

        Parameters
        ----------
        constants : mapping of str to float [SI]
            The fitted ones, by symbol.

        Returns
        -------
        tuple of dict
            The fitted constants first.

        Examples
        --------
        >>> one = FitSpread(of="scatter", deviations={"C10": 2.0, "C20": 0.0}, correlation=((1.0, 0.0), (0.0, 1.0)))
        >>> one.sets({"C10": 50.0, "C20": 1.0})
        ({'C10': 50.0, 'C20': 1.0}, {'C10': 52.0, 'C20': 1.0}, {'C10': 48.0, 'C20': 1.0})
        """
        size = np.array(list(self.deviations.values()))
        free = np.flatnonzero(size > 0)
        values, vectors = np.linalg.eigh(np.array(self.correlation)[np.ix_(free, free)])
        there = values > ROUND_OFF.same * len(free)
        axes = size[free, None] * vectors[:, there] * np.sqrt(values[there] * there.sum())
        names = [list(self.deviations)[k] for k in free]
        sets = [dict(constants)]
        for axis in axes.T[::-1]:
            axis = axis * (1 if axis[np.argmax(np.abs(axis / size[free]))] > 0 else -1)
            for sign in (1, -1):
                moved = {name: constants[name] + sign * float(by) for name, by in zip(names, axis, strict=True)}
                sets.append({**constants, **moved})
        return tuple(sets)


def read_fit_spread(values: Any, where: str) -> FitSpread:
    """Read the table ``spread`` of a record.

    Parameters
    ----------
    values : mapping
    where : str
        Key of the table, for messages.

    Returns
    -------
    FitSpread

    Raises
    ------
    TurgorError
        If a key is unknown or a value cannot be read.
    """
    given = table(values, where, _KEYS, _KEYS)
    deviations = {}
    for symbol, value in table(given["deviations"], f"{where}.deviations").items():
        try:
            deviations[symbol] = float(value) if has_no_unit(symbol) else parse_quantity(value, "pressure")
        except (TypeError, ValueError, TurgorError) as error:
            raise TurgorError(f"{where}.deviations.{symbol}: {error}") from None
        if not deviations[symbol] >= 0:
            raise TurgorError(f"{where}.deviations.{symbol} is {value!r}; allowed is 0 or more.")
    try:
        correlation = tuple(tuple(float(each) for each in row) for row in given["correlation"])
        return FitSpread(of=str(given["of"]), deviations=deviations, correlation=correlation)
    except (TypeError, ValueError, TurgorError) as error:
        raise TurgorError(f"{where}: {error}") from None
