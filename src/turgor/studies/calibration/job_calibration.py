"""Calibration of jobs: experiments whose function is a job, the parameters of it, and the search."""

from collections.abc import Sequence
from dataclasses import dataclass

from turgor.foundation.response import Response
from turgor.studies.calibration.calibrate import calibrate
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.result import Calibration
from turgor.studies.calibration.trial import Trial
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.jobs.job_function import JobFunction

#: The job with the calibrated values.
CALIBRATED = "calibrated.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationPlan:
    """What a calibration of a job fits.

    Parameters
    ----------
    free : tuple of Parameter
        Numbers of the job by key.
    experiments, hold_out : tuple of Response
        Those that are fitted, and those that are predicted.
    spreads : tuple of float or None [SI]
        Standard deviation of a measured value of each of both; None if it is not known.
    rig : tuple of str
        Parameters of the rig.
    y, x : str or None
        What is compared and what drives, as `turgor.compare` takes them.
    most_solves : int or None
    """

    free: tuple[Parameter, ...]
    experiments: tuple[Response, ...]
    hold_out: tuple[Response, ...] = ()
    spreads: tuple[float | None, ...] = ()
    rig: tuple[str, ...] = ()
    y: str | None = None
    x: str | None = None
    most_solves: int | None = None


def calibrate_job(plan: CalibrationPlan, job: JobFunction, evaluations: Evaluations) -> Calibration:
    """Calibrate numbers of a job.

    Parameters
    ----------
    plan : CalibrationPlan
    job : JobFunction
    evaluations : Evaluations

    Returns
    -------
    Calibration
    """
    measured = (*plan.experiments, *plan.hold_out)
    spreads = plan.spreads or (None,) * len(measured)
    trials = [
        job_trial(job, each, y=plan.y, x=plan.x, spread=spread, fitted=plan.experiments)
        for each, spread in zip(measured, spreads, strict=True)
    ]
    count = len(plan.experiments)
    return calibrate(
        trials[:count], plan.free, rig=plan.rig, hold_out=trials[count:], most_solves=plan.most_solves,
        evaluations=evaluations,
    )  # fmt: skip


def job_trial(
    job: JobFunction,
    measured: Response,
    *,
    y: str | None = None,
    x: str | None = None,
    spread: float | None = None,
    fitted: Sequence[Response] = (),
) -> Trial:
    """Return an experiment with a job as its model.

    Parameters
    ----------
    job : JobFunction
    measured : Response
    y, x, spread
        Of `Trial`.
    fitted : sequence of Response
        All experiments that are fitted with the job, so that one run serves them all; by default this one alone.

    Returns
    -------
    Trial
    """
    columns = list(dict.fromkeys(name for each in fitted or (measured,) for name in each.names))
    drives = [x.partition("=")[0].strip()] if x else columns
    names = [y.partition("=")[0].strip()] if y else columns
    computation = job.computation()
    return Trial(
        measured=measured, function=computation.function, y=y, x=x, spread=spread, values=computation.values,
        gather=computation.gather, prescribed=True, slopes={"slopes": {"drives": drives, "columns": names}},
    )  # fmt: skip


def equal_constants(parameters: Sequence[Parameter], job: JobFunction) -> tuple[str, ...]:
    """Say which fixed constants of other regions are equal to a free one.

    Parameters
    ----------
    parameters : sequence of Parameter
    job : JobFunction

    Returns
    -------
    tuple of str
    """
    free = {key for each in parameters for key in each.name.split(",")}
    notes = []
    for key in sorted(free):
        parts = key.split(".")
        if parts[0] != "materials" or key not in job.numbers:
            continue
        alike = [
            other
            for other, number in job.numbers.items()
            if other not in free
            and other.startswith("materials.")
            and other.split(".")[2:] == parts[2:]
            and number.value == job.numbers[key].value
        ]
        for other in alike:
            notes.append(
                f"{other} has the same value as {key} and is fixed; the key {key},{other} frees both as one number"
            )
    return tuple(notes)
