"""sobol_indices and screening: shares of the variance, and elementary effects, over whole ranges (SALib)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column
from turgor.studies.runs.factor import Value
from turgor.studies.runs.optional_parts import needed
from turgor.studies.runs.rounding import percent
from turgor.studies.runs.settings import LEVEL
from turgor.studies.sensitivity.predictors import Predictor, Problem, problem_of
from turgor.studies.uncertainty.spread import Spread

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Indices:
    """Sobol indices of a measure: which share of its variance each factor brings.

    Parameters
    ----------
    measure, unit : str
    factors : tuple of str
        Factors that vary.
    first, total : (k,) array
        Share that a factor brings alone, and together with others.
    first_error, total_error : (k,) array
        Half widths of the 95 % intervals of the sample.
    deviation : float [SI]
        Standard deviation of the measure over the ranges.
    unexplained : float
        Share of the variance that a surrogate leaves unexplained in held-out rows, 1 − R²; 0 where runs were computed.
    fixed : mapping of str to float or str [SI]
        Factors that were fixed, with their values.
    count : int
        Number of points.
    normal : tuple of str
        Factors that are normal within their ranges; the others are uniform.
    """

    measure: str
    unit: str
    factors: tuple[str, ...]
    first: Array
    total: Array
    first_error: Array
    total_error: Array
    deviation: float
    unexplained: float
    fixed: Mapping[str, Value]
    count: int
    normal: tuple[str, ...] = ()

    def interval(self, which: str) -> tuple[Array, Array]:
        """Return the ends of the 95 % intervals, (k,) each, widened by the unexplained share of a surrogate.

        Of a variance V the surrogate has (1 − u) V. What is unexplained may belong to any factor: an index of the
        surrogate s ± e lies between (1 − u)(s − e) and (1 − u)(s + e) + u.

        Parameters
        ----------
        which : str
            ``"first"`` or ``"total"``.
        """
        if which not in ("first", "total"):
            raise unknown("index", which, ("first", "total"))
        index, error = (self.first, self.first_error) if which == "first" else (self.total, self.total_error)
        unexplained = self.unexplained
        return np.maximum((1 - unexplained) * (index - error), 0.0), np.minimum(
            (1 - unexplained) * (index + error) + unexplained, 1.0
        )

    @property
    def ranking(self) -> tuple[str, ...]:
        """Names of the factors, the one with the largest total index first."""
        return tuple(self.factors[n] for n in np.argsort(-self.total))

    def sentence(self) -> str:
        """Return the ranking with total indices in a sentence."""
        low, high = self.interval("total")
        shares = []
        for name in self.ranking:
            n = self.factors.index(name)
            shares.append(f"{name} {percent(self.total[n])} % ({percent(low[n])} to {percent(high[n])})")
        column = Column(self.measure, self.unit, np.array([self.deviation]))
        deviation = f"{column.in_unit[0]:.3g} {self.unit}".rstrip()
        unexplained = f"; the surrogate leaves {percent(self.unexplained)} % unexplained" if self.unexplained else ""
        alone = f"factors alone bring {percent(float(self.first.sum()))} %"
        how = f" with {', '.join(self.normal)} normal" if self.normal else ""
        return f"{column.words} varies by {deviation}{how}: {', '.join(shares)}; {alone}{unexplained}."


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Screening:
    """Elementary effects of a measure (Morris): how much it changes over the range of each factor.

    Parameters
    ----------
    measure, unit : str
    factors : tuple of str
    size : (k,) array [SI]
        Mean of the absolute effects, μ*, per whole range.
    size_error : (k,) array [SI]
        Half width of the 95 % interval.
    spread : (k,) array [SI]
        Standard deviation of the effects, σ: large where a factor interacts or is not linear.
    count : int
        Number of points.
    """

    measure: str
    unit: str
    factors: tuple[str, ...]
    size: Array
    size_error: Array
    spread: Array
    count: int

    @property
    def ranking(self) -> tuple[str, ...]:
        """Names of the factors, the largest effect first."""
        return tuple(self.factors[n] for n in np.argsort(-self.size))


def sobol_indices(
    predictor: Predictor,
    measures: Sequence[str] | None = None,
    *,
    spreads: Sequence[Spread] = (),
    fixed: Mapping[str, Value] | None = None,
    samples: int = 1024,
    seed: int = 0,
) -> tuple[Indices, ...]:
    """Divide the variance of measures among independent factors (Sobol indices).

    Factors are uniform over their ranges, and those with a spread normal, cut off at the ends of their ranges.

    The first index of a factor is the share that it brings alone, the total index that with all its interactions
    (Sobol 2001, Math. Comput. Simul. 55, 271; estimators and sample of Saltelli et al. 2010, Comput. Phys. Commun.
    181, 259, by SALib).

    Parameters
    ----------
    predictor : Predictor
        A `Surrogate`, or `Direct` for a function that is quick itself.
    measures : sequence of str, optional
        By default all of them.
    spreads : sequence of Spread
        Factors that are normal, as `turgor.studies.propagate` takes them: mean and standard deviation.
    fixed : mapping of str to float or str, optional [SI]
        Factors that do not vary, such as ``{"pressure": 40e3}``.
    samples : int
        A power of two. The function is computed at samples·(factors + 2) points.
    seed : int
        Equal seeds give equal samples.

    Returns
    -------
    tuple of Indices
        One for each measure.

    Raises
    ------
    TurgorError
        If samples is no power of two, a name is unknown, a factor is a choice, a mean lies beyond the range, or a run
        fails.

    Examples
    --------
    A plane whose slope along ``wall`` is twice that along ``gap`` has indices of 4/5 and 1/5:

    >>> from turgor.foundation.response import Response
    >>> from turgor.studies.sensitivity.predictors import Direct
    >>> from turgor.foundation.source import Source
    >>> from turgor.studies.runs.factor import Factor
    >>> def angle(wall, gap):
    ...     return Response(columns=(Column("angle", "", [10 - 2 * wall - gap]),), source=Source(text="a formula"))
    >>> factors = Factor(name="wall", low=1.0, high=2.0), Factor(name="gap", low=1.0, high=2.0)
    >>> (indices,) = sobol_indices(Direct(function=angle, factors=factors, measures=("angle",)), samples=256)
    >>> indices.ranking, indices.total.round(2)
    (('wall', 'gap'), array([0.8, 0.2]))
    """
    if samples < 2 or samples & (samples - 1):
        raise TurgorError(f"samples is {samples}; allowed are powers of two, such as 1024.")
    problem, names = problem_of(predictor, fixed, spreads), _names(predictor, measures)
    drawn: Any = needed("SALib.sample.sobol", "a sensitivity")
    values = problem.values(drawn.sample(problem.salib, samples, calc_second_order=False, seed=seed))
    return tuple(_indices(problem, name, values[:, predictor.measures.index(name)], seed) for name in names)


def _indices(problem: Problem, name: str, values: Array, seed: int) -> Indices:
    """Divide the variance of a measure at the points of a sample."""
    _check_varies(name, values)
    analyzed: Any = needed("SALib.analyze.sobol", "a sensitivity")
    sobol = analyzed.analyze(problem.salib, values, calc_second_order=False, conf_level=LEVEL, seed=seed)
    return Indices(
        measure=name, unit=problem.predictor.units[name], factors=tuple(problem.names), first=np.asarray(sobol["S1"]),
        total=np.asarray(sobol["ST"]), first_error=np.asarray(sobol["S1_conf"]),
        total_error=np.asarray(sobol["ST_conf"]), deviation=float(values.std()),
        unexplained=_unexplained(problem, name), fixed=problem.fixed,
        count=len(values),
        normal=tuple(each.name for each in problem.spreads),
    )  # fmt: skip


def screening(
    predictor: Predictor,
    measures: Sequence[str] | None = None,
    *,
    fixed: Mapping[str, Value] | None = None,
    trajectories: int = 10,
    seed: int = 0,
) -> tuple[Screening, ...]:
    """Rank many factors with few runs: elementary effects over the ranges (Morris 1991, Technometrics 33, 161).

    Parameters
    ----------
    predictor : Predictor
        `Direct` for runs, or a `Surrogate`.
    measures : sequence of str, optional
        By default all of them.
    fixed : mapping of str to float or str, optional [SI]
        Factors that do not vary.
    trajectories : int
        The function is computed at trajectories·(factors + 1) points, on four levels of each factor.
    seed : int
        Equal seeds give equal samples.

    Returns
    -------
    tuple of Screening
        One for each measure.

    Raises
    ------
    TurgorError
        If a name is unknown, a factor is a choice, or a run fails.
    """
    if trajectories < 2:
        raise TurgorError(f"trajectories is {trajectories}; allowed is 2 or more.")
    problem, names = problem_of(predictor, fixed), _names(predictor, measures)
    sample = needed("SALib.sample.morris", "a sensitivity").sample(problem.salib, trajectories, num_levels=4, seed=seed)
    values, units = problem.values(sample), predictor.units
    analyzed: Any = needed("SALib.analyze.morris", "a sensitivity")
    screenings = []
    for name in names:
        column = values[:, predictor.measures.index(name)]
        analysis = analyzed.analyze(problem.salib, sample, column, num_levels=4, conf_level=LEVEL, seed=seed)
        screenings.append(
            Screening(
                measure=name, unit=units[name], factors=tuple(problem.names), size=np.asarray(analysis["mu_star"]),
                size_error=np.asarray(analysis["mu_star_conf"]), spread=np.asarray(analysis["sigma"]),
                count=len(sample),
            )
        )  # fmt: skip
    return tuple(screenings)


def _names(predictor: Predictor, measures: Sequence[str] | None) -> tuple[str, ...]:
    for name in measures or ():
        if name not in predictor.measures:
            raise unknown("measure", name, predictor.measures)
    return tuple(measures or predictor.measures)


def _check_varies(name: str, values: Array) -> None:
    if np.ptp(values) <= 1e-12 * max(float(np.abs(values).max()), 1e-300):
        raise TurgorError(f"'{name}' is {values.flat[0]:.4g} all over these ranges; there is no variance to divide.")


def _unexplained(problem: Problem, name: str) -> float:
    error = problem.predictor.error(name)
    return 0.0 if error is None else float(np.clip(1.0 - error.r_squared, 0.0, 1.0))
