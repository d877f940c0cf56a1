"""Slopes of jobs: derivatives of what the goals read by the numbers of a job, where they are exact."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.engine.mass import cell_volumes
from turgor.engine.runtime import EngineOptions
from turgor.errors import TurgorError
from turgor.gradients.result import Gradient
from turgor.job.job import Job
from turgor.meshing.mesh import Mesh
from turgor.optimization.goals import Goal, TipPath
from turgor.optimization.slopes import with_slopes
from turgor.response import Response
from turgor.results.measures.reading import Measure
from turgor.solvers.solution import Solution
from turgor.study.factor import Value
from turgor.study.job_gradients import gradient_of_job
from turgor.study.study import place_on
from turgor.study.workspaces import REACHED

Array = NDArray[np.float64]

#: The volume of rubber of a design: a column of the responses of jobs.
SOLID_VOLUME = "solid_volume"

#: Beginning of the sentence that says what is left to the surfaces.
LEFT = "There are no slopes"

#: Slopes count as exact up to this estimate of their relative error.
ACCURATE = 0.01


def solid_volume_of(mesh: Mesh) -> float:
    """Return the volume of rubber of the whole part [m³]."""
    return float(cell_volumes(mesh).sum()) * mesh.symmetry_factor


def asked_slopes(goals: Sequence[Goal], factors: Collection[str]) -> list[list[Any]]:
    """Return what is differentiated for goals: measures, each with the column and its value at which it is read.

    Parameters
    ----------
    goals : sequence of Goal
    factors : collection of str
        Names of the factors, which need no derivatives where goals read them.

    Returns
    -------
    list of [str, str or None, float]
        Empty where a goal reads what has none: a function, a path that is compared at shares of its length, or a
        workspace.
    """
    found: list[list[Any]] = []
    for goal in goals:
        if isinstance(goal, TipPath):
            if goal.at is None:
                return []
            found += [[each, goal.at[0], float(value)] for value in goal.at[1] for each in goal.measures]
        elif not isinstance(goal.measure, str) or goal.measure in REACHED:
            return []
        elif goal.measure not in factors:
            found.append([goal.measure, *(goal.at or (None, 0.0))])
    return found


def with_job_slopes(
    job: Job, solution: Solution, response: Response, numbers: Mapping[str, Value], asked: Sequence[Sequence[Any]]
) -> tuple[Response, tuple[str, ...]]:
    """Add the derivatives of what goals read by the numbers of a job, and say which are left out.

    The path is not solved again: each state that is read, or the two on both sides of a value, is differentiated.

    Parameters
    ----------
    job : Job
    solution : Solution
    response : Response
        A row for each state.
    numbers : mapping of str to number
        Numbers of the job by key.
    asked : sequence of (str, str or None, float)
        As `asked_slopes` gives them.

    Returns
    -------
    (Response, tuple of str)
        The response as it was where nothing can be differentiated, and sentences for a reader.
    """
    of_states = [(drive, value) for name, drive, value in asked if name != SOLID_VOLUME]
    read = of_states or [(None, 0.0)]
    if not solution.complete:  # the load at which it ended changes with the numbers as well
        read = [each for each in read if each[0] is not None]
    rows = sorted({row for each in read for row in _rows(response, *each)})
    names = dict.fromkeys(name for each, drive, _ in asked for name in (each, drive) if name is not None)
    question = _Question(job, solution, tuple(_measure(each) for each in names))
    slopes: dict[str, dict[str, Array]] = {name: {} for name in names}
    notes = refused_at_once(numbers)
    left = tuple(key for key in numbers if key not in notes)
    for row in rows:
        found, refused = question.at(row, left)
        notes |= refused
        left = tuple(key for key in left if key not in refused)
        for name in names if found is not None else ():
            for key in left:
                column = slopes[name].setdefault(key, np.full(len(response), np.nan))
                column[slice(None) if name == SOLID_VOLUME else row] = found[name, key]  # type: ignore[index]
    return with_slopes(response, slopes), _told(tuple(numbers), notes)


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
    job : Job
    solution : Solution
    measures : tuple of Measure or str
    """

    job: Job
    solution: Solution
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
        options = EngineOptions(threads=1)
        try:
            found = gradient_of_job(
                self.job, keys, self.measures, solution=self.solution, state=row, options=options
            )  # fmt: skip
        except TurgorError as error:
            return None, str(error).removeprefix("the gradient is not computed: ")
        return (found, "") if found.left < ACCURATE else (None, f"their error is about {found.left:.1%}.")


def _rows(response: Response, drive: str | None, value: float) -> tuple[int, ...]:
    """Return the rows from which a value is read; none where the path does not reach it."""
    if drive is None:
        return (len(response) - 1,)
    place = place_on(response.column(drive), value) if drive in response else None
    if place is None:
        return ()
    first, share = place
    return (first, first + 1) if share else (first,)


def _measure(name: str) -> Measure | str:
    if name != SOLID_VOLUME:
        return name
    return Measure(
        name=name, unit="mL", function=lambda at: solid_volume_of(at.state.model.mesh), definition="volume of rubber"
    )


def _told(keys: Sequence[str], refused: dict[str, str]) -> tuple[str, ...]:
    """Say by which numbers there are no slopes, those with the same reason together."""
    reasons: dict[str, list[str]] = {}
    for key, why in refused.items():
        reasons.setdefault(why, []).append(key)
    told = []
    for why, which in reasons.items():
        by = "" if len(which) == len(keys) else f" by {', '.join(which)}"
        told.append(f"{LEFT}{by}: {why}")
    return tuple(told)
