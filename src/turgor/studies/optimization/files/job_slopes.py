"""Slopes of jobs: derivatives of what the goals read by the numbers of a job, where they are exact."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from turgor.core.engine.mass import cell_volumes
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Response
from turgor.job.job import Job
from turgor.studies.optimization.goals import Goal, TipPath
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_slopes import told, with_slopes_at
from turgor.studies.runs.study import place_on
from turgor.studies.runs.workspaces import REACHED

#: The volume of rubber of a design: a column of the responses of jobs.
SOLID_VOLUME = "solid_volume"


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
    rows = {row for each in read for row in _rows(response, *each)}
    names = dict.fromkeys(name for each, drive, _ in asked for name in (each, drive) if name is not None)
    measures = [_measure(each) for each in names]
    found, refused = with_slopes_at(job, solution, response, numbers, measures, rows, steady=(SOLID_VOLUME,))
    return found, told(tuple(numbers), refused)


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
