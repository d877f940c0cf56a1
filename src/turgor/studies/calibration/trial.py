"""Trials: an experiment, and the function that computes the measured quantities."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from inspect import signature
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.laboratory.compare import compare, first_branch
from turgor.accuracy.laboratory.runs import SPREAD
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.studies.calibration.curve import PathCurve
from turgor.studies.calibration.parameter import OFFSET, SCALE, Parameter
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.run import Computed, Run

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trial:
    """An experiment and the function that computes it.

    Parameters
    ----------
    measured : Response
        What was measured, of `turgor.experiments.read_experiment` for example.
    function : callable
        Function of a module that takes parameters as keywords, in SI units, and returns a `Response`.
    y, x : str or None
        What is compared and what drives, as `turgor.compare` takes them.
    spread : float or None [SI]
        Standard deviation of one measured value. By default the column ``NAME_spread`` of the experiment, if there is
        one; else it is not known, and what remains of the differences stands for it.
    values : mapping of str to number, str, bool, None or a list of these
        Further arguments of the function in this trial.
    gather : str
        Name of an argument of the function that takes all parameters as one mapping; by default each is a keyword.
    slopes : mapping
        Further arguments with which the function adds derivatives by the parameters (`turgor.studies.with_slopes`),
        where they cost something. A function that adds them anyway needs none.
    name : str
        Short name; by default the source of the experiment.
    prescribed : bool
        Whether the function prescribes the drive, so that its curve ends at the same value for all parameters: measured
        rows beyond it are refused. Else they are compared with a straight continuation.
    """

    measured: Response
    function: Callable[..., Response | Computed]
    y: str | None = None
    x: str | None = None
    spread: float | None = None
    values: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    gather: str = ""
    slopes: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    name: str = ""
    prescribed: bool = False

    def __post_init__(self) -> None:
        if not self.name:
            object.__setattr__(self, "name", self.measured.source.text)
        if self.spread is not None and not self.spread > 0:
            raise TurgorError(f"trial '{self.name}': spread is {self.spread:g}; allowed is above 0.")

    def taken(self, parameters: Sequence[Parameter]) -> tuple[str, ...]:
        """Return the names of the parameters that the function takes."""
        names = tuple(each.name for each in parameters)
        if self.gather:
            return names
        takes = signature(self.function).parameters
        return tuple(name for name in names if name in takes)

    def run(self, values: Mapping[str, float], taken: Sequence[str], slopes: bool = True) -> Run:
        """Return the run of the function with values of parameters, with or without its derivatives."""
        given = {name: values[name] for name in taken}
        shown = ", ".join(f"{name} {value:.5g}" for name, value in given.items())
        slope_values = self.slopes if slopes else {}
        keywords: dict[str, Any] = {self.gather: given} if self.gather else given
        return Run(
            name=f"{self.name}: {shown}", function=self.function, values={**self.values, **slope_values, **keywords}
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Data:
    """The numbers of a trial that the search needs.

    Parameters
    ----------
    trial : Trial
    x, y : str
        Columns of the computed response.
    measured_x, measured_y : str
        Columns of the measured one.
    drive, value, spread : (n,) array [SI]
        Measured rows without missing values, and the standard deviation of each.
    assumed : bool
        Whether the standard deviation was assumed.
    taken : tuple of str
        Parameters that the function takes.
    notes : tuple of str
        How the columns were paired.
    """

    trial: Trial
    x: str
    y: str
    measured_x: str
    measured_y: str
    drive: Array
    value: Array
    spread: Array
    assumed: bool
    taken: tuple[str, ...]
    notes: tuple[str, ...] = ()

    def corrected(self, rig: Mapping[str, float]) -> tuple[Array, Array]:
        """Return the measured drive and values with the offsets and scales of the rig."""
        columns = []
        for name, values in ((self.x, self.drive), (self.y, self.value)):
            columns.append(values * rig.get(name + SCALE, 1.0) + rig.get(name + OFFSET, 0.0))
        return columns[0], columns[1]

    def differences(self, computed: Response, rig: Mapping[str, float]) -> Array:
        """Return computed minus measured, (n,) [SI]; beyond its ends the computed curve goes on straight."""
        drive, value = self.corrected(rig)
        return PathCurve.of(computed, self.x, self.y).at(drive) - value

    def slopes(self, computed: Response, rig: Mapping[str, float], names: Sequence[str]) -> Array:
        """Return the derivatives (n, k) [SI] of the differences by parameters of the model or the rig by name.

        They are nan by a parameter of the model of which the response has no slopes.
        """
        drive, _ = self.corrected(rig)
        curve = PathCurve.of(computed, self.x, self.y)
        table = np.zeros((len(drive), len(names)))
        taken = [k for k, name in enumerate(names) if name in self.taken]
        table[:, taken] = curve.slopes(drive, computed, (self.x, self.y), [names[k] for k in taken])
        one = np.ones(len(drive))
        of_rig = {self.y + OFFSET: -one, self.y + SCALE: -self.value}  # of one name the drive comes first
        of_rig |= {self.x + OFFSET: curve.rise(drive), self.x + SCALE: curve.rise(drive) * self.drive}
        for k, name in enumerate(names):
            if name in of_rig:
                table[:, k] = of_rig[name]
        return table

    def beyond(self, computed: Response, rig: Mapping[str, float], margin: float = 1e-6) -> int:
        """Count the measured rows that lie beyond the computed range by more than a share of it."""
        drive, _ = self.corrected(rig)
        known = first_branch(computed, self.x)[0].column(self.x)
        reach = margin * float(np.ptp(known))
        return int(np.sum((drive > np.nanmax(known) + reach) | (drive < np.nanmin(known) - reach)))


def data_of(trial: Trial, computed: Response, taken: tuple[str, ...]) -> Data:
    """Pair the columns of a trial with those of a computed response.

    Parameters
    ----------
    trial : Trial
    computed : Response
        Of its function, at any values.
    taken : tuple of str
        Parameters that the function takes.

    Returns
    -------
    Data

    Raises
    ------
    TurgorError
        If the two cannot be compared.
    """
    comparison = compare(computed, trial.measured, trial.y, x=trial.x)
    drive, value = trial.measured.column(comparison.measured_x), trial.measured.column(comparison.measured_y)
    known = np.isfinite(drive) & np.isfinite(value)
    spread, assumed = _spread(trial, comparison.measured_y, value[known], known)
    return Data(
        trial=trial, x=comparison.x, y=comparison.y, measured_x=comparison.measured_x, measured_y=comparison.measured_y,
        drive=drive[known], value=value[known], spread=spread, assumed=assumed, taken=taken,
        notes=tuple(note for note in comparison.notes if "beyond" not in note),
    )  # fmt: skip


def _spread(trial: Trial, name: str, values: Array, known: NDArray[np.bool_]) -> tuple[Array, bool]:
    """Standard deviation of each measured value, and whether it was assumed."""
    reach = float(np.ptp(values))
    if reach == 0:
        raise TurgorError(f"trial '{trial.name}': all measured values of '{name}' are equal, {values[0]:g}.")
    if trial.spread is not None:
        return np.full(len(values), trial.spread), False
    if name + SPREAD in trial.measured:
        spread = np.array(trial.measured.column(name + SPREAD)[known])
        # where repeated runs meet, such as at zero, their spread says nothing about the gauge
        return np.maximum(
            np.nan_to_num(spread), 0.25 * float(np.nanmedian(spread)) or CALIBRATION.assumed_spread * reach
        ), False
    return np.full(len(values), CALIBRATION.assumed_spread * reach), True


def check_taken(trials: Sequence[Trial], parameters: Sequence[Parameter]) -> None:
    """Raise an error unless every parameter is one of some function.

    Parameters
    ----------
    trials : sequence of Trial
    parameters : sequence of Parameter
    """
    for each in parameters:
        if not any(each.name in trial.taken(parameters) for trial in trials):
            takes = {name for trial in trials for name in signature(trial.function).parameters}
            raise unknown("parameter", each.name, takes - {name for trial in trials for name in trial.values})
