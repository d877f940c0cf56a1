"""Slopes of jobs: derivatives of measures at the states of a path by the numbers of a job, where they are exact."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.result import Gradient
from turgor.core.engine.runtime import EngineOptions
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.job.job import Job
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_gradients import NearbyJobs, nearby_jobs
from turgor.studies.runs.slopes import with_slopes

Array = NDArray[np.float64]

#: Beginning of the sentence that says what has none.
LEFT = "There are no slopes"

#: Slopes count as exact up to this estimate of their relative error.
ACCURATE = 0.01


def with_slopes_at(
    job: Job,
    solution: Solution,
    response: Response,
    numbers: Mapping[str, Value],
    measures: Sequence[Measure | str],
    rows: Collection[int],
    steady: Collection[str] = (),
) -> tuple[Response, dict[str, str]]:
    """Add the derivatives of measures by the numbers of a job at some states of its path, which is not solved again.

    Parameters
    ----------
    job : Job
    solution : Solution
    response : Response
        A row for each state.
    numbers : mapping of str to number
        Numbers of the job by key.
    measures : sequence of Measure or str
    rows : collection of int
        The states.
    steady : collection of str
        Names of measures that have the same value, and slope, at every state.

    Returns
    -------
    (Response, dict of str to str)
        With slopes where there are any, nan at other states; and why there are none, by number.
    """
    names = [each if isinstance(each, str) else each.name for each in measures]
    slopes: dict[str, dict[str, Array]] = {name: {} for name in names}
    refused = refused_at_once(numbers)
    left = tuple(key for key in numbers if key not in refused)
    if left and rows:
        with nearby_jobs(job, solution) as nearby:
            question = _Question(nearby, tuple(measures))
            for row in sorted(rows):
                found, reasons = question.at(row, left)
                refused |= reasons
                left = tuple(key for key in left if key not in reasons)
                for name in names if found is not None else ():
                    for key in left:
                        column = slopes[name].setdefault(key, np.full(len(response), np.nan))
                        column[slice(None) if name in steady else row] = found[name, key]  # type: ignore[index]
    return with_slopes(response, slopes), refused


def refused_at_once(numbers: Mapping[str, Value]) -> dict[str, str]:
    """Return why numbers have no derivative, where that is known without trying, which takes meshes and factors.

    Parameters
    ----------
    numbers : mapping of str to number

    Returns
    -------
    dict of str to str
    """
    why = "whole numbers and choices do not change by little."
    return {keys: why for keys, value in numbers.items() if not isinstance(value, float)}


@dataclass(frozen=True, slots=True, eq=False)
class _Question:
    """Derivatives of measures at the states of a path.

    Parameters
    ----------
    nearby : NearbyJobs
    measures : tuple of Measure or str
    """

    nearby: NearbyJobs
    measures: tuple[Measure | str, ...]

    def at(self, row: int, keys: tuple[str, ...]) -> tuple[Gradient | None, dict[str, str]]:
        """Return the derivatives at a state by the numbers that can be differentiated, and why others cannot."""
        found, refused = self._asked(row, keys)
        if found is not None or len(keys) < 2:
            return found, dict.fromkeys(keys, refused) if refused else {}
        reasons = {key: why for key in keys if (why := self._asked(row, (key,))[1])}
        able = tuple(key for key in keys if key not in reasons)
        return (self._asked(row, able)[0] if able else None), reasons

    def _asked(self, row: int, keys: tuple[str, ...]) -> tuple[Gradient | None, str]:
        if not keys:
            return None, ""
        try:
            found = self.nearby.gradient(keys, self.measures, row, EngineOptions(threads=1))
        except TurgorError as error:
            return None, str(error).removeprefix("the gradient is not computed: ")
        return (found, "") if found.left < ACCURATE else (None, f"their error is about {found.left:.1%}.")


def told(keys: Sequence[str], refused: Mapping[str, str]) -> tuple[str, ...]:
    """Say by which numbers there are no slopes, those with the same reason together.

    Parameters
    ----------
    keys : sequence of str
        All numbers.
    refused : mapping of str to str
        Why, by number.

    Returns
    -------
    tuple of str
    """
    reasons: dict[str, list[str]] = {}
    for key, why in refused.items():
        reasons.setdefault(why, []).append(key)
    told = []
    for why, which in reasons.items():
        by = "" if len(which) == len(keys) else f" by {', '.join(which)}"
        told.append(f"{LEFT}{by}: {why}")
    return tuple(told)
