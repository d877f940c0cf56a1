"""Sweep of a job: what a study file states, computed in a folder."""

from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.runs.study import Study
from turgor.studies.runs.sweep import study_of
from turgor.studies.study_file.study_file import StudyFile


def sweep_job(study: StudyFile, folder: str | Path, evaluations: Evaluations) -> Study:
    """Compute the designs of a study file.

    Parameters
    ----------
    study : StudyFile
    folder : str or Path
        Where the job is written with every value.
    evaluations : Evaluations

    Returns
    -------
    Study

    Raises
    ------
    TurgorError
        If the study file has no sweep, or the folder holds something else.
    """
    plan = study.sweep
    if plan is None:
        raise TurgorError(f"the study file '{study.name}' has no sweep; add the table [sweep].")
    base = job_function(study.job, Path(folder))
    computation = base.computation(mesh_error="every" if plan.mesh_error else "none", measures=plan.measures)
    source = Source(text=f"sweep of the job '{study.job.name}', {plan.designs.rule}")
    return study_of(computation, plan.designs, evaluations, source)
