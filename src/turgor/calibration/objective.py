"""Objective: weighted differences of all trials and the priors, and their derivatives by finite differences."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.calibration.parameter import OFFSET, SCALE, Parameter, values_at
from turgor.calibration.trial import Data
from turgor.errors import TurgorError, unknown
from turgor.response import Response
from turgor.study.evaluations import Evaluations
from turgor.study.running.ended import Ended

Array = NDArray[np.float64]

#: Weighted difference of every row where a run failed: far above what a curve that misses the measured one has, and
#: small enough to be squared.
FAILED = 1e3

#: Smallest scatter that assumed spreads are lowered to: differences of a made-up curve may be zero.
LEAST_SCATTER = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Objective:
    """Weighted differences at a point of the search.

    Parameters
    ----------
    parameters : tuple of Parameter
        Those of the model, then those of the rig.
    models : int
        Number of those of the model; the others cost no run.
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
            scatter = max(float(np.sqrt(np.mean(rows**2))), LEAST_SCATTER)
            data.append(replace(each, spread=each.spread * scatter) if each.assumed else each)
        return replace(self, data=tuple(data))

    @property
    def limits(self) -> tuple[Array, Array]:
        """Bounds of the coordinates."""
        low, high = ([each.coordinate(each.bounds[side]) for each in self.parameters] for side in (0, 1))
        return np.array(low), np.array(high)

    def ended(self, points: Sequence[Array]) -> list[list[Ended]]:
        """Return how the runs of the trials ended at each point; all points are one batch."""
        runs = [each.trial.run(values_at(self.parameters, at), each.taken) for at in points for each in self.data]
        found, count = self.evaluations.of(runs), len(self.data)
        return [found[k * count : (k + 1) * count] for k in range(len(points))]

    def responses(self, at: Array) -> list[Response | None]:
        """Return what the trials compute at a point; None where a run failed."""
        return [_response(each) for each in self.ended([at])[0]]

    def residuals(self, at: Array) -> Array:
        """Return all weighted differences and priors at a point, (m,)."""
        return self._weighted(at, self.responses(at))

    def jacobian(self, at: Array) -> Array:
        """Return the derivatives of `residuals` at a point, (m, n): runs at once, for the parameters of the model."""
        steps = [self._step(k, at) for k in range(self.models)]
        moved = [at + step for step in steps]
        batches = self.ended([at, *moved])
        here = self._weighted(at, [_response(each) for each in batches[0]])
        table = np.empty((len(here), len(self.parameters)))
        for k, (step, batch) in enumerate(zip(steps, batches[1:], strict=True)):
            to, responses = moved[k], [_response(each) for each in batch]
            if any(each is None for each in responses):  # the other side may run
                to = at - step
                responses = self.responses(to)
            table[:, k] = self._slope(at, here, to, responses) if all(responses) else 0.0
        table[:, self.models :] = self.rig_jacobian(at)
        return table

    def rig_jacobian(self, at: Array) -> Array:
        """Return the derivatives by the parameters of the rig, (m, n); they cost no run."""
        responses = self.responses(at)
        here = self._weighted(at, responses)
        columns = []
        for k in range(self.models, len(self.parameters)):
            to = at + self._step(k, at)
            columns.append(self._slope(at, here, to, responses))
        return np.array(columns).T.reshape(len(here), len(columns))

    def _slope(self, at: Array, here: Array, to: Array, responses: Sequence[Response | None]) -> Array:
        return np.asarray((self._weighted(to, responses) - here) / (to - at).sum())

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
            rows = np.full(len(each.value), FAILED)
            if response is not None:
                rows = np.clip(each.differences(response, values) / each.spread, -FAILED, FAILED)
            parts.append(rows)
        priors = [
            (values[each.name] - each.prior[0]) / each.prior[1] for each in self.parameters if each.prior is not None
        ]
        return np.concatenate([*parts, priors])


def rig_parameter(asked: str | Parameter, data: Sequence[Data]) -> Parameter:
    """Return a parameter of the rig with default bounds where only its name is given.

    Parameters
    ----------
    asked : str or Parameter
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
    name = asked if isinstance(asked, str) else asked.name
    columns: dict[str, tuple[Data, bool]] = {}
    for each in data:
        columns.setdefault(each.x, (each, True))
        columns.setdefault(each.y, (each, False))
    known = [column + end for column in columns for end in (OFFSET, SCALE)]
    if name not in known:
        raise unknown("parameter of the rig", name, known)
    if isinstance(asked, Parameter):
        return asked
    if name.endswith(SCALE):
        return Parameter(name=name, start=1.0, lower=0.5, upper=2.0)
    each, driving = columns[name.removesuffix(OFFSET)]
    reach = 0.5 * float(np.ptp(each.drive if driving else each.value))
    unit = each.trial.measured.find(each.measured_x if driving else each.measured_y).unit
    return Parameter(name=name, start=0.0, lower=-reach, upper=reach, unit=unit)


def with_prior(parameters: Sequence[Parameter], priors: Mapping[str, tuple[float, float]]) -> tuple[Parameter, ...]:
    """Return parameters with priors laid over them.

    Parameters
    ----------
    parameters : sequence of Parameter
    priors : mapping of str to (float, float) [SI]
        Mean and standard deviation by name.

    Returns
    -------
    tuple of Parameter

    Raises
    ------
    TurgorError
        If no parameter has a name.
    """
    names = [each.name for each in parameters]
    for name in priors:
        if name not in names:
            raise unknown("parameter with a prior", name, names)
    return tuple(replace(each, prior=priors[each.name]) if each.name in priors else each for each in parameters)


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
