"""Calibration: the fitted parameters, their errors, and the curves before and after."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.calibration.estimate import Estimate
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Data

Array = NDArray[np.float64]


class CalibrationStatus(StrEnum):
    """How a calibration ended."""

    CONVERGED = "converged"
    AT_BOUND = "at_bound"
    NOT_CONVERGED = "not_converged"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fitted:
    """One trial with its curves.

    Parameters
    ----------
    data : Data
        The measured rows and how they are compared.
    start, fitted : Response
        What the function computes at the start, and with the fitted values.
    rms_start, rms : float [SI]
        Roots of the mean squares of the differences.
    rig : mapping of str to float [SI]
        Fitted offsets and scales of the rig.
    beyond : int
        Number of measured rows beyond the end of the fitted curve; it was continued straight there.
    """

    data: Data
    start: Response
    fitted: Response
    rms_start: float
    rms: float
    rig: Mapping[str, float]
    beyond: int

    @property
    def unit(self) -> str:
        """Unit in which the compared column is shown."""
        return self.fitted.find(self.data.y).unit

    def shown(self, value: float) -> str:
        """Return a value of the compared column with its unit."""
        return f"{Column('y', self.unit, np.array([value])).in_unit[0]:.3g} {self.unit}".rstrip()

    def to_response(self) -> Response:
        """Return the measured rows, corrected for the rig, with the curves before and after."""
        data = self.data
        drive, value = data.corrected(self.rig)
        x, y = self.fitted.find(data.x), self.fitted.find(data.y)
        raw_drive, raw_value = data.corrected({})
        columns = (
            Column(data.x, x.unit, drive),
            Column(f"{data.y}_measured", y.unit, value),
            Column(f"{data.y}_start", y.unit, raw_value + data.differences(self.start, {})),
            Column(f"{data.y}_fitted", y.unit, value + data.differences(self.fitted, self.rig)),
            Column(f"{data.x}_as_measured", x.unit, raw_drive),
        )
        return Response(columns=columns, source=Source(text=data.trial.name))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Calibration:
    """Parameters fitted to experiments.

    Parameters
    ----------
    parameters : tuple of Parameter
        Those of the model, then those of the rig.
    values : mapping of str to float [SI]
        The fitted values.
    estimate : Estimate
        Standard errors, intervals, correlation, and what is not determined.
    fits : tuple of Fitted
        The trials.
    held_out : tuple of Fitted
        Trials that were not fitted: what the values predict for them.
    status : CalibrationStatus
    message, advice : str
        What happened, and what to do.
    solves : int
        Number of runs of all functions.
    computed : int
        Those that were not read from disk.
    derivatives : str
        How the derivatives were computed, and why.
    failures : tuple of str
        Runs that failed on the way, with the reasons.
    """

    parameters: tuple[Parameter, ...]
    values: Mapping[str, float]
    estimate: Estimate
    fits: tuple[Fitted, ...]
    held_out: tuple[Fitted, ...]
    status: CalibrationStatus
    message: str
    advice: str
    solves: int
    computed: int
    derivatives: str = ""
    failures: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"Calibration({self.table()[0]}; {self.status})" if len(self.parameters) == 1 else self.summary()

    @property
    def converged(self) -> bool:
        """Whether the search ended because no better values were near, at a bound or not."""
        return self.status is not CalibrationStatus.NOT_CONVERGED

    @property
    def errors(self) -> Mapping[str, float]:
        """Standard errors by name [SI]; nan for a parameter at its bound."""
        return {each.name: float(e) for each, e in zip(self.parameters, self.estimate.errors, strict=True)}

    @property
    def intervals(self) -> Mapping[str, tuple[float, float]]:
        """95 % intervals by name [SI]; nan for a parameter at its bound."""
        rows = zip(self.parameters, self.estimate.intervals.tolist(), strict=True)
        return {each.name: (low, high) for each, (low, high) in rows}

    @property
    def correlation(self) -> Array:
        """Correlation of the errors, (n, n), in the order of the parameters."""
        return self.estimate.correlation

    @property
    def undetermined(self) -> tuple[str, ...]:
        """A sentence for each combination of parameters that the curves do not determine."""
        return self.estimate.undetermined

    def table(self) -> tuple[str, ...]:
        """Return a line for each parameter: value, standard error, 95 % interval."""
        lines = []
        for each in self.parameters:
            value, error, (low, high) = self.values[each.name], self.errors[each.name], self.intervals[each.name]
            if not np.isfinite(low):
                side = "lower" if value - each.bounds[0] < each.bounds[1] - value else "upper"
                lines.append(f"{each.name} = {each.shown(value)}, its {side} bound")
                continue
            lines.append(
                f"{each.name} = {each.shown(value)} ± {each.shown(error, 2)} (standard error; 95 %: {each.shown(low)} "
                f"to {each.shown(high)})"
            )
        return tuple(lines)

    def summary(self) -> str:
        """Return the result in several lines."""
        lines = list(self.table())
        for label, fits in (("", self.fits), ("held out: ", self.held_out)):
            for each in fits:
                lines.append(
                    f"{label}{each.data.trial.name}: {each.data.y.replace('_', ' ')} differs by "
                    f"{each.shown(each.rms)} (RMS), {each.shown(each.rms_start)} at the start"
                )
        lines += [*self._correlated(), *self.undetermined, *self.estimate.notes]
        lines += [self.derivatives] if self.derivatives else []
        lines.append(f"{self.message} {self.advice}".strip())
        return "\n".join(lines)

    def _correlated(self) -> list[str]:
        sentences = []
        for i, one in enumerate(self.parameters):
            for j, other in enumerate(self.parameters[:i]):
                value = self.correlation[i, j]
                if np.isfinite(value) and abs(value) >= 0.9:
                    sentences.append(f"The errors of {other.name} and {one.name} are correlated ({value:+.3f}).")
        return sentences


def rms(values: Sequence[float] | Array) -> float:
    """Return the root of the mean square.

    Parameters
    ----------
    values : (n,) array

    Returns
    -------
    float

    Examples
    --------
    >>> rms([3.0, 4.0, 0.0, 0.0])
    2.5
    """
    return float(np.sqrt(np.mean(np.asarray(values) ** 2)))
