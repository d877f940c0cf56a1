"""Job as the model of a trial: solved with other numbers, measured, and differentiated at its states."""

from collections.abc import Mapping, Sequence

from turgor.accuracy.laboratory.compare import first_branch
from turgor.core.results.drive import drive_of, pressures_in
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.job.job import Job
from turgor.studies.runs.factor import Value
from turgor.studies.runs.jobs.job_gradients import is_of_path
from turgor.studies.runs.jobs.job_runs import forget_path, measured_job, solution_of_job
from turgor.studies.runs.jobs.job_slopes import told, with_slopes_at
from turgor.studies.runs.run import Computed

#: Columns that drive where both responses have them, besides that which drives the computed one.
_USUAL = ("pressure", "time")

#: Columns that the load factor alone determines, and numbers of the procedure.
_PRESCRIBED = ("load_factor", "time", "stage", "injected_volume", "gas_mass_ratio")


def calibrated_job(
    job: str, digest: str, numbers: Mapping[str, Value], slopes: Sequence[Sequence[str]] = ()
) -> Computed:
    """Solve a job with other numbers and measure it, and differentiate what is compared at every state.

    Parameters
    ----------
    job, digest, numbers
        As those of `turgor.studies.runs.jobs.job_runs.solved_job`.
    slopes : (drives, names) of lists of str
        Columns that may drive, and that may be compared: those of them that the response has are differentiated, or all
        of its measures where it has none. Nothing is differentiated without.

    Returns
    -------
    Computed
        With notes on what could not be differentiated.
    """
    asked, solution = solution_of_job(job, digest, numbers)
    response = measured_job(asked, solution)
    notes: tuple[str, ...] = ()
    if slopes and len(solution.states) > 1:
        response, notes = _with_slopes(asked, solution, response, numbers, slopes)
    forget_path(job, digest, numbers)
    return Computed(response=response, notes=notes)


def _with_slopes(
    job: Job, solution: Solution, response: Response, numbers: Mapping[str, Value], asked: Sequence[Sequence[str]]
) -> tuple[Response, tuple[str, ...]]:
    drives, names = asked
    usual = [each for each in (drive_of(response), *_USUAL) if each in drives]
    drive = next((each for each in (*usual, *drives[: len(drives) == 1]) if each in response), drive_of(response))
    pressures = [each.name for each in pressures_in(response)]
    able = [name for name in response.names if name not in (drive, *pressures) and _alone(name)]
    compared = [name for name in able if name in names] or able
    measures = [name for name in dict.fromkeys((drive, *pressures, *compared)) if name not in _PRESCRIBED]
    refused = {}
    if drive in _PRESCRIBED:
        refused = {key: f"they change the {drive.replace('_', ' ')}, too." for key in numbers if is_of_path(key)}
    left = {key: value for key, value in numbers.items() if key not in refused}
    rows = range(len(first_branch(response, drive)[0]))
    found, more = with_slopes_at(job, solution, response, left, measures, rows)
    return found, told(tuple(numbers), refused | more)


def _alone(name: str) -> bool:
    """Whether a column is a measure of single states."""
    try:
        return find_measure(name).along is None
    except TurgorError:  # a part of a measure, such as of each region, or an energy
        return False
