"""Functions that sensitivities evaluate at many points: runs themselves, or something fast in their place."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.run import Computed
from turgor.studies.runs.study import Row, Study
from turgor.studies.uncertainty.spread import Spread

Array = NDArray[np.float64]


class PredictionError(Protocol):
    """How well a measure is predicted."""

    @property
    def r_squared(self) -> float:
        """Share of the variance that is explained."""
        ...


class Predictor(Protocol):
    """A function of factors, such as a `Surrogate` or `Direct`."""

    @property
    def factors(self) -> tuple[Factor, ...]:
        """Inputs with their ranges."""
        ...

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the outputs."""
        ...

    @property
    def units(self) -> dict[str, str]:
        """Unit in which each measure is shown."""
        ...

    def means(self, points: Array) -> Array:
        """Return the measures at points [SI]: (q, k) to (q, m)."""
        ...

    def error(self, name: str) -> PredictionError | None:
        """Return how well a measure is predicted; None where it is computed."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Direct:
    """A function that is computed at every point: for formulas and other quick functions.

    Parameters
    ----------
    function : Computation or callable
        Takes the factors as keywords and returns a `Response`.
    factors : tuple of Factor
        What varies, numbers only.
    measures : tuple of str
        Columns of the response.
    at : (str, float), optional
        Column and value [SI] at which they are read; by default the last state.
    evaluations : Evaluations
        Where runs are computed and saved; by default in this process, without files.
    """

    function: Computation | Callable[..., Response | Computed]
    factors: tuple[Factor, ...]
    measures: tuple[str, ...]
    at: tuple[str, float] | None = None
    evaluations: Evaluations = field(default_factory=Evaluations)

    @property
    def units(self) -> dict[str, str]:
        """Unit in which each measure is shown, known after the first run."""
        study = Study(factors=self.factors, rows=self._rows([self._middle()]), source=Source(text="runs"))
        return {name: study.unit(name) for name in self.measures}

    def study(self, points: Array) -> Study:
        """Return the study of points, (q, k) [SI]."""
        names = [each.name for each in self.factors]
        values = [dict(zip(names, point, strict=True)) for point in np.asarray(points).tolist()]
        return Study(factors=self.factors, rows=self._rows(values), source=Source(text="runs"))

    def means(self, points: Array) -> Array:
        """Return the measures at points [SI]: (q, k) to (q, m); a run that fails is an error."""
        study = self.study(points)
        table = np.stack([study.column(name, self.at) for name in self.measures], axis=1)
        bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
        if len(bad):
            row = study.rows[int(bad[0])]
            why = row.problem or "its path does not reach the requested value."
            raise TurgorError(
                f"{len(bad)} of {len(table)} runs give no value, such as that with {study.values_text(row.values)}: "
                f"{why} "
                "Narrow the ranges, or fit a surrogate to the runs that end."
            )
        return table

    def error(self, name: str) -> None:
        """Return None: it is computed."""
        return

    def _middle(self) -> dict[str, float]:
        return {each.name: float(each.at(0.5)) for each in self.factors}

    def _rows(self, values: Sequence[Mapping[str, float]]) -> tuple[Row, ...]:
        computation = self.function if isinstance(self.function, Computation) else Computation(function=self.function)
        ended = self.evaluations.of([computation.run(each) for each in values])
        return tuple(Row(values=one, ended=other) for one, other in zip(values, ended, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Problem:
    """The sampled problem: the factors that vary, and those that are fixed.

    Parameters
    ----------
    predictor : Predictor
    varied : tuple of Factor
    fixed : mapping of str to float or str [SI]
    spreads : tuple of Spread
        Factors that are normal within their ranges; the others are uniform.
    """

    predictor: Predictor
    varied: tuple[Factor, ...]
    fixed: Mapping[str, Value]
    spreads: tuple[Spread, ...] = ()

    @property
    def names(self) -> list[str]:
        """Names of the factors that vary."""
        return [each.name for each in self.varied]

    @property
    def salib(self) -> dict[str, Any]:
        """The problem in the form of SALib."""
        normal = {each.name: each.standard for each in self.spreads}
        return {
            "num_vars": len(self.varied),
            "names": self.names,
            "bounds": [[*each.bounds, *normal.get(each.name, ())] for each in self.varied],
            "dists": ["truncnorm" if each.name in normal else "unif" for each in self.varied],
        }

    def values(self, sample: Array) -> Array:
        """Return the measures at a sample of the factors that vary, (q, m) [SI]."""
        points = np.empty((len(sample), len(self.predictor.factors)))
        for n, each in enumerate(self.predictor.factors):
            is_fixed = each.name in self.fixed
            points[:, n] = each.number(self.fixed[each.name]) if is_fixed else sample[:, self.names.index(each.name)]
            if each.whole and not is_fixed:
                points[:, n] = np.round(points[:, n])
        return self.predictor.means(points)


def problem_of(predictor: Predictor, fixed: Mapping[str, Value] | None, spreads: Sequence[Spread] = ()) -> Problem:
    """Return the problem to sample, after a check of the factors.

    Parameters
    ----------
    predictor : Predictor
    fixed : mapping of str to float or str, optional [SI]
        Factors that do not vary, with their values.
    spreads : sequence of Spread
        Factors that are normal within their ranges.

    Returns
    -------
    Problem

    Raises
    ------
    TurgorError
        If a name is unknown, a factor is a choice, fewer than two vary, or a spread does not fit its factor.
    """
    known = [each.name for each in predictor.factors]
    for name in fixed or {}:
        if name not in known:
            raise unknown("factor", name, known)
    varied = tuple(each for each in predictor.factors if each.name not in (fixed or {}))
    for each in varied:
        if each.is_choice:
            raise TurgorError(
                f"the factor '{each.name}' is a choice; samples take numbers only. Hold it at one, or take `anova`."
            )
    if len(varied) < 2:
        names = ", ".join(each.name for each in predictor.factors)
        raise TurgorError(f"{len(varied)} factors of {names} vary; sensitivities compare two or more.")
    for spread in spreads:
        _check_spread(spread, varied)
    twice = next((each.name for n, each in enumerate(spreads) if each.name in [one.name for one in spreads[:n]]), "")
    if twice:
        raise TurgorError(f"'{twice}' has two spreads; give it one.")
    return Problem(predictor=predictor, varied=varied, fixed=dict(fixed or {}), spreads=tuple(spreads))


def _check_spread(spread: Spread, varied: Sequence[Factor]) -> None:
    """Raise an error if a spread is not that of a factor that varies, or its mean lies beyond the range."""
    factors = {each.name: each for each in varied}
    if spread.name not in factors:
        raise unknown("factor with a spread that varies", spread.name, factors)
    factor, (mean, _) = factors[spread.name], spread.standard
    if factor.whole:
        raise TurgorError(f"'{factor.name}' is a whole number, which has no spread.")
    if not isfinite(mean):
        raise TurgorError(f"spread '{spread.name}' has no mean; give it one.")
    low, high = factor.bounds
    if not low <= mean <= high:
        raise TurgorError(
            f"the mean of '{spread.name}' is {factor.shown(mean)}; allowed is {factor.shown(low)} to "
            f"{factor.shown(high)}, its range."
        )
