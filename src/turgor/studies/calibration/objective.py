"""Objective: weighted differences of all trials and the priors, and their derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.studies.calibration.parameter import OFFSET, SCALE, Parameter, values_at
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.calibration.trial import Data
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Objective:
    """Weighted differences at a point of the search.

    Parameters
    ----------
    parameters : tuple of Parameter
        Those of the model, then those of the rig.
    models : int
        Number of those of the model; derivatives by the others cost no run.
    data : tuple of Data
        One for each trial.
    evaluations : Evaluations
    """

    parameters: tuple[Parameter, ...]
    models: int
    data: tuple[Data, ...]
    evaluations: Evaluations

    @property
    def rows(self) -> int:
        """Number of measured rows of all trials."""
        return sum(len(each.value) for each in self.data)

    @property
    def assumed(self) -> bool:
        """Whether the spread of any measurement was assumed."""
        return any(each.assumed for each in self.data)

    def reweighted(self, residuals: Array) -> "Objective":
        """Return the objective with assumed spreads replaced by those of the differences, as priors need them."""
        data, first = [], 0
        for each in self.data:
            rows = residuals[first : first + len(each.value)]
            first += len(each.value)
            scatter = max(float(np.sqrt(np.mean(rows**2))), CALIBRATION.least_scatter)
            data.append(replace(each, spread=each.spread * scatter) if each.assumed else each)
        return replace(self, data=tuple(data))

    @property
    def limits(self) -> tuple[Array, Array]:
        """Bounds of the coordinates."""
        low, high = ([each.coordinate(each.bounds[side]) for each in self.parameters] for side in (0, 1))
        return np.array(low), np.array(high)

    def ended(self, points: Sequence[Array], slopes: bool = True) -> list[list[Ended]]:
        """Return how the runs of the trials ended at each point; all points are one batch."""
        runs = [
            each.trial.run(values_at(self.parameters, at), each.taken, slopes) for at in points for each in self.data
        ]
        outcomes, count = self.evaluations.of(runs), len(self.data)
        return [outcomes[k * count : (k + 1) * count] for k in range(len(points))]

    def responses(self, at: Array) -> list[Response | None]:
        """Return what the trials compute at a point; None where a run failed."""
        return [_response(each) for each in self.ended([at])[0]]

    def residuals(self, at: Array) -> Array:
        """Return all weighted differences and priors at a point, (m,)."""
        return self._weighted(at, self.responses(at))

    def jacobian(self, at: Array) -> Array:
        """Return the derivatives of `residuals` at a point, (m, n): what is not known costs runs, all at once."""
        table = self.known_jacobian(at)
        unknown = np.flatnonzero(~known_columns(table))
        if not len(unknown):
            return table
        here, steps = self.residuals(at), [self._step(int(k), at) for k in unknown]
        batches = self.ended([at + step for step in steps], slopes=False)
        for k, step, batch in zip(unknown, steps, batches, strict=True):
            to, responses = at + step, [_response(each) for each in batch]
            if any(each is None for each in responses):  # the other side may run
                to = at - step
                responses = [_response(each) for each in self.ended([to], slopes=False)[0]]
            known = all(each is not None for each in responses)
            table[:, k] = (self._weighted(to, responses) - here) / (to - at).sum() if known else 0.0
        return table

    def known_jacobian(self, at: Array) -> Array:
        """Return the derivatives that cost no run besides that at the point, (m, n); nan in columns that are unknown.

        Known are those by parameters of the rig, and by those of the model of which the responses have slopes.
        """
        values, names = values_at(self.parameters, at), [each.name for each in self.parameters]
        by_coordinate = np.array([each.slope(values[each.name]) for each in self.parameters])
        parts = []
        for each, response in zip(self.data, self.responses(at), strict=True):
            rows = np.zeros((len(each.value), len(names)))
            if response is None:
                rows[:, : self.models] = np.nan
            else:
                rows = each.slopes(response, values, names) / each.spread[:, None]
                far = np.abs(each.differences(response, values) / each.spread) >= CALIBRATION.failed
                rows[far] = np.where(np.isnan(rows[far]), np.nan, 0.0)
            parts.append(rows)
        priors = [(np.array(names) == each.name) / each.prior[1] for each in self.parameters if each.prior is not None]
        return np.vstack([*parts, *priors]) * by_coordinate

    def derivatives(self, at: Array) -> str:
        """Say by which parameters of the model the derivatives at a point are exact, and why not by others."""
        known = known_columns(self.known_jacobian(at))
        names = [each.name for each in self.parameters[: self.models]]
        exact = [name for name, is_known in zip(names, known, strict=False) if is_known]
        others = [name for name in names if name not in exact]
        notes = [note for each in self.ended([at])[0] if each.found is not None for note in each.found.notes]
        if not others:
            return "The derivatives are exact, from each run itself."
        if not exact:
            return " ".join(["The derivatives are differences of runs.", *dict.fromkeys(notes)])
        mixed = f"The derivatives by {', '.join(exact)} are exact, those by {', '.join(others)} differences of runs."
        return " ".join([mixed, *dict.fromkeys(notes)])

    def _step(self, k: int, at: Array) -> Array:
        """Step of the differences of one parameter, away from the nearer bound."""
        low, high = self.limits
        step = np.zeros(len(at))
        step[k] = self.parameters[k].step if at[k] - low[k] < high[k] - at[k] else -self.parameters[k].step
        return step

    def _weighted(self, at: Array, responses: Sequence[Response | None]) -> Array:
        values = values_at(self.parameters, at)
        parts = []
        for each, response in zip(self.data, responses, strict=True):
            rows = np.full(len(each.value), CALIBRATION.failed)
            if response is not None:
                rows = np.clip(
                    each.differences(response, values) / each.spread, -CALIBRATION.failed, CALIBRATION.failed
                )
            parts.append(rows)
        priors = [
            (values[each.name] - each.prior[0]) / each.prior[1] for each in self.parameters if each.prior is not None
        ]
        return np.concatenate([*parts, priors])


def known_columns(table: Array) -> NDArray[np.bool_]:
    """Return which columns of a Jacobian are known.

    Parameters
    ----------
    table : (m, n) array

    Returns
    -------
    (n,) array of bool
    """
    return np.asarray(~np.isnan(table).any(axis=0))


def rig_parameter(requested: str | Parameter, data: Sequence[Data]) -> Parameter:
    """Return a parameter of the rig with default bounds where only its name is given.

    Parameters
    ----------
    requested : str or Parameter
        A measured column with ``_offset`` or ``_scale``.
    data : sequence of Data

    Returns
    -------
    Parameter
        An offset starts at 0 and stays within half the measured range; a scale starts at 1, within a half and two.

    Raises
    ------
    TurgorError
        If no trial has such a column.
    """
    name = requested if isinstance(requested, str) else requested.name
    columns: dict[str, tuple[Data, bool]] = {}
    for each in data:
        columns.setdefault(each.x, (each, True))
        columns.setdefault(each.y, (each, False))
    known = [column + end for column in columns for end in (OFFSET, SCALE)]
    if name not in known:
        raise unknown("parameter of the rig", name, known)
    if isinstance(requested, Parameter):
        return requested
    if name.endswith(SCALE):
        return Parameter(name=name, start=1.0, lower=0.5, upper=2.0)
    each, driving = columns[name.removesuffix(OFFSET)]
    reach = 0.5 * float(np.ptp(each.drive if driving else each.value))
    unit = each.trial.measured.find(each.measured_x if driving else each.measured_y).unit
    return Parameter(name=name, start=0.0, lower=-reach, upper=reach, unit=unit)


def first_responses(ended: Sequence[Ended]) -> list[Response]:
    """Return the responses at the start.

    Parameters
    ----------
    ended : sequence of Ended

    Returns
    -------
    list of Response

    Raises
    ------
    TurgorError
        If a run failed: without a curve there is nothing to begin with.
    """
    for each in ended:
        if each.found is None:
            raise TurgorError(f"the run at the start failed ({each.run.name}): {each.problem}")
    return [each.found.response for each in ended if each.found is not None]


def _response(ended: Ended) -> Response | None:
    """Return what a run computed; a path of one state is a failure, too."""
    if ended.found is None or len(ended.found.response) < 2:
        return None
    return ended.found.response
