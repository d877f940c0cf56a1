"""local_sensitivities: how much a measure changes where an input is off by its tolerance."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.run import Computed
from turgor.studies.runs.study import Row, Study


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """An input with its nominal value, and how far it may be off.

    Parameters
    ----------
    name : str
        Keyword of the function, or key of a job.
    nominal, off : float [SI]
    unit : str
        Unit in which it is shown.

    Raises
    ------
    TurgorError
        If ``off`` is not positive.
    """

    name: str
    nominal: float
    off: float
    unit: str = ""

    def __post_init__(self) -> None:
        if not self.off > 0:
            raise TurgorError(f"'{self.name}' is off by {self.off:g}; allowed is above 0.")

    @property
    def factor(self) -> Factor:
        """The factor from nominal − off to nominal + off."""
        return Factor(name=self.name, low=self.nominal - self.off, high=self.nominal + self.off, unit=self.unit)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalSensitivity:
    """Sensitivity of a measure to one input at the nominal design.

    Parameters
    ----------
    measure, unit : str
    tolerance : Tolerance
    value : float [SI]
        Measure at the nominal design.
    derivative : float [SI over SI]
    error : float [SI over SI]
        How far the derivative changes within the tolerance: half the difference of the slopes on both sides. NaN where
        the derivative was given.
    """

    measure: str
    unit: str
    tolerance: Tolerance
    value: float
    derivative: float
    error: float

    @property
    def change(self) -> float:
        """Change of the measure where the input is off by its tolerance [SI]."""
        return self.derivative * self.tolerance.off

    @property
    def elasticity(self) -> float:
        """Relative change of the measure over that of the input, d ln m / d ln p; NaN where the measure is 0."""
        return self.derivative * self.tolerance.nominal / self.value if self.value else float("nan")

    def sentence(self) -> str:
        """Return the effect of a tolerance in a sentence."""
        factor = self.tolerance.factor
        column = Column(self.measure, self.unit, np.array([self.change, self.error * self.tolerance.off, self.value]))
        change, error, value = column.in_unit
        more = "" if np.isnan(error) else f" ± {error:.2g}"
        unit = f" {self.unit}" if self.unit else ""
        nominal, off = factor.shown(self.tolerance.nominal), factor.shown(self.tolerance.off)
        share = f" ({100 * change / value:+.2g} %)" if value else ""
        effect = f"{change:+.3g}{more}{unit}{share}, elasticity {self.elasticity:+.2g}"
        return f"{factor.name} {nominal} + {off}: {column.words} {effect}."


def local_sensitivities(
    function: Computation | Callable[..., Response | Computed],
    tolerances: Sequence[Tolerance],
    measures: Sequence[str],
    *,
    at: tuple[str, float] | None = None,
    evaluations: Evaluations | None = None,
) -> tuple[LocalSensitivity, ...]:
    """Differentiate measures with respect to inputs, by central differences over the tolerances of the inputs.

    There are 2n + 1 runs for n inputs. The difference of the slopes on both sides says how far a derivative can be
    trusted within its tolerance.

    Parameters
    ----------
    function : Computation or callable
        Takes the inputs as keywords and returns a `Response`.
    tolerances : sequence of Tolerance
    measures : sequence of str
        Columns of the response.
    at : (str, float), optional
        Column and value [SI] at which measures are read; by default the last state.
    evaluations : Evaluations, optional
        Where runs are computed and saved; by default in this process, without files.

    Returns
    -------
    tuple of LocalSensitivity
        By measure, the largest change first.

    Raises
    ------
    TurgorError
        If a run fails, or a measure is unknown.

    Examples
    --------
    >>> def angle(wall):
    ...     return Response(columns=(Column("angle", "", [8 / wall**3]),), source=Source(text="a formula"))
    >>> (sensitivity,) = local_sensitivities(angle, [Tolerance(name="wall", nominal=2.0, off=0.02)], ["angle"])
    >>> round(sensitivity.elasticity, 3), sensitivity.sentence()
    (-3.001, 'wall 2 + 0.02: angle -0.03 ± 0.0006 (-3 %), elasticity -3.')
    """
    if not tolerances or not measures:
        raise TurgorError("local sensitivities need a tolerance and a measure.")
    nominal = {each.name: each.nominal for each in tolerances}
    designs = [nominal]
    for each in tolerances:
        designs += [nominal | {each.name: each.nominal + sign * each.off} for sign in (1, -1)]
    study = _study(function, tolerances, designs, evaluations or Evaluations())
    sensitivities = []
    for name in measures:
        values = study.column(name, at)
        _check(study, values)
        lines = []
        for n, each in enumerate(tolerances):
            above, below = values[1 + 2 * n] - values[0], values[0] - values[2 + 2 * n]
            lines.append(
                LocalSensitivity(
                    measure=name, unit=study.unit(name), tolerance=each, value=float(values[0]),
                    derivative=float(above + below) / (2 * each.off), error=abs(float(above - below)) / (2 * each.off),
                )
            )  # fmt: skip
        sensitivities += sorted(lines, key=lambda each: -abs(each.change))
    return tuple(sensitivities)


def sensitivities_of(
    derivatives: Mapping[str, float], tolerances: Sequence[Tolerance], *, measure: str, value: float, unit: str = ""
) -> tuple[LocalSensitivity, ...]:
    """Return sensitivities from derivatives that are known, such as those of `tg.gradient` or `Surrogate.slopes`.

    Parameters
    ----------
    derivatives : mapping of str to float [SI over SI]
        By the name of the input.
    tolerances : sequence of Tolerance
    measure : str
    value : float [SI]
        Measure at the nominal design.
    unit : str
        Unit in which the measure is shown.

    Returns
    -------
    tuple of LocalSensitivity
        The largest change first.

    Raises
    ------
    TurgorError
        If a derivative is missing.
    """
    sensitivities = []
    for each in tolerances:
        if each.name not in derivatives:
            raise unknown("derivative", each.name, derivatives)
        sensitivities.append(
            LocalSensitivity(
                measure=measure, unit=unit, tolerance=each, value=value, derivative=derivatives[each.name],
                error=float("nan"),
            )
        )  # fmt: skip
    return tuple(sorted(sensitivities, key=lambda each: -abs(each.change)))


def _study(
    function: Computation | Callable[..., Response | Computed],
    tolerances: Sequence[Tolerance],
    designs: Sequence[Mapping[str, float]],
    evaluations: Evaluations,
) -> Study:
    computation = function if isinstance(function, Computation) else Computation(function=function)
    ended = evaluations.of([computation.run(each) for each in designs])
    rows = tuple(Row(values=one, ended=other) for one, other in zip(designs, ended, strict=True))
    return Study(factors=tuple(each.factor for each in tolerances), rows=rows, source=Source(text="differences"))


def _check(study: Study, values: np.ndarray) -> None:
    for row, value in zip(study.rows, values, strict=True):
        if not np.isfinite(value):
            why = row.problem or "its path does not reach the requested value."
            raise TurgorError(
                f"the run with {study.values_text(row.values)} gives no value: {why} Smaller tolerances may help."
            )
