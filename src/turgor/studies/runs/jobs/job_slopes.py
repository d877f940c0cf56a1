"""Slopes of jobs: derivatives of measures at the states of a path by the numbers of a job, where they are exact."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.result import Gradient
from turgor.accuracy.laboratory.compare import first_branch
from turgor.core.engine.runtime import EngineOptions
from turgor.core.results.drive import drive_of, pressures_in
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers.procedures.listed import prescribed_columns
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.job.job import Job
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_gradients import NearbyJobs, is_of_path, nearby_jobs
from turgor.studies.runs.jobs.solid_volume import SOLID_VOLUME, solid_volume
from turgor.studies.runs.settings import RUNS
from turgor.studies.runs.slopes import with_slopes
from turgor.studies.runs.study import place_on

Array = NDArray[np.float64]

#: Beginning of the sentence that names the numbers without slopes.
NO_SLOPES = "There are no slopes"

#: Columns that drive if both responses have them, besides the drive of the computed one.
USUAL_DRIVES = ("pressure", "time")


class SlopeRequest(TypedDict, total=False):
    """Which measures are differentiated, and at which states.

    Either ``readings``, each a measure with the column and its value at which it is read (None and 0 at the last
    state); or ``columns`` at every state of the loading branch along one of ``drives``: those that the response has, or
    all of its measures if it has none of them.
    """

    readings: Sequence[Sequence[str | float | None]]
    drives: Sequence[str]
    columns: Sequence[str]


def with_requested_slopes(
    job: Job, solution: Solution, response: Response, numbers: Mapping[str, Value], request: SlopeRequest
) -> tuple[Response, tuple[str, ...]]:
    """Add the requested derivatives by the numbers of a job; the path is not solved again.

    Parameters
    ----------
    job : Job
    solution : Solution
    response : Response
        A row for each state.
    numbers : mapping of str to number
        Numbers of the job by key.
    request : SlopeRequest

    Returns
    -------
    (Response, tuple of str)
        The unchanged response if nothing can be differentiated, and sentences that say why.
    """
    refused: dict[str, str] = {}
    if "readings" in request:
        measures, rows = _at_readings(solution, response, request["readings"])
    elif len(solution.states) < 2:
        return response, ()
    else:
        drive, measures = _along_path(response, request)
        rows = set(range(len(first_branch(response, drive)[0])))
        if drive in _prescribed():
            refused = {key: f"they change the {drive.replace('_', ' ')}, too." for key in numbers if is_of_path(key)}
    able = {key: value for key, value in numbers.items() if key not in refused}
    result, more = with_slopes_at(job, solution, response, able, measures, rows)
    return result, left_out(tuple(numbers), refused | more)


def _at_readings(
    solution: Solution, response: Response, readings: Sequence[Sequence[str | float | None]]
) -> tuple[list[Measure | str], set[int]]:
    """Return measures and states: each state that is read, or the two on both sides of a value."""
    at = [(drive, value) for name, drive, value in readings if name != SOLID_VOLUME] or [(None, 0.0)]
    if not solution.complete:  # the load at which it ended changes with the numbers as well
        at = [each for each in at if each[0] is not None]
    rows = {row for drive, value in at for row in _rows(response, drive, float(value or 0.0))}
    names = dict.fromkeys(str(name) for each, drive, _ in readings for name in (each, drive) if name is not None)
    return [solid_volume() if name == SOLID_VOLUME else name for name in names], rows


def _rows(response: Response, drive: str | float | None, value: float) -> tuple[int, ...]:
    """Return the rows from which a value is read; none if the path does not reach it."""
    if drive is None:
        return (len(response) - 1,)
    place = place_on(response.column(str(drive)), value) if str(drive) in response else None
    if place is None:
        return ()
    first, share = place
    return (first, first + 1) if share else (first,)


def _along_path(response: Response, request: SlopeRequest) -> tuple[str, list[Measure | str]]:
    """Return the drive, and the measures that are differentiated along it."""
    drives, columns = request["drives"], request["columns"]
    usual = [each for each in (drive_of(response), *USUAL_DRIVES) if each in drives]
    drive = next((each for each in (*usual, *drives[: len(drives) == 1]) if each in response), drive_of(response))
    pressures = [each.name for each in pressures_in(response)]
    able = [name for name in response.names if name not in (drive, *pressures) and _of_single_states(name)]
    compared, left_out = [name for name in able if name in columns] or able, _prescribed()
    return drive, [name for name in dict.fromkeys((drive, *pressures, *compared)) if name not in left_out]


def _prescribed() -> tuple[str, ...]:
    """Columns that the load factor alone determines, and numbers of procedures."""
    return ("load_factor", "time", "stage", *prescribed_columns())


def _of_single_states(name: str) -> bool:
    """Whether a column is a measure of single states."""
    try:
        return find_measure(name).along is None
    except TurgorError:  # a part of a measure, such as of each region, or an energy
        return False


def with_slopes_at(
    job: Job,
    solution: Solution,
    response: Response,
    numbers: Mapping[str, Value],
    measures: Sequence[Measure | str],
    rows: Collection[int],
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

    Returns
    -------
    (Response, dict of str to str)
        With slopes where there are any, nan at other states; and why there are none, by number.
    """
    names = [each if isinstance(each, str) else each.name for each in measures]
    slopes: dict[str, dict[str, Array]] = {name: {} for name in names}
    refused = refused_at_once(numbers)
    able = tuple(key for key in numbers if key not in refused)
    if able and rows:
        with nearby_jobs(job, solution) as nearby:
            question = _Question(nearby, tuple(measures))
            for row in sorted(rows):
                gradient, reasons = question.at(row, able)
                refused |= reasons
                able = tuple(key for key in able if key not in reasons)
                for name in names if gradient is not None else ():
                    for key in able:
                        column = slopes[name].setdefault(key, np.full(len(response), np.nan))
                        column[slice(None) if name == SOLID_VOLUME else row] = gradient[name, key]  # type: ignore[index]
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
        gradient, refused = self._gradient(row, keys)
        if gradient is not None or len(keys) < 2:
            return gradient, dict.fromkeys(keys, refused) if refused else {}
        reasons = {key: why for key in keys if (why := self._gradient(row, (key,))[1])}
        able = tuple(key for key in keys if key not in reasons)
        return (self._gradient(row, able)[0] if able else None), reasons

    def _gradient(self, row: int, keys: tuple[str, ...]) -> tuple[Gradient | None, str]:
        if not keys:
            return None, ""
        try:
            gradient = self.nearby.gradient(keys, self.measures, row, EngineOptions(threads=1))
        except TurgorError as error:
            return None, str(error).removeprefix("the gradient is not computed: ")
        share = gradient.residual
        return (gradient, "") if share < RUNS.exact_slopes else (None, f"their error is about {share:.1%}.")


def left_out(keys: Sequence[str], refused: Mapping[str, str]) -> tuple[str, ...]:
    """Return the numbers without slopes in sentences, one for each reason.

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
    sentences = []
    for why, which in reasons.items():
        by = "" if len(which) == len(keys) else f" by {', '.join(which)}"
        sentences.append(f"{NO_SLOPES}{by}: {why}")
    return tuple(sentences)
