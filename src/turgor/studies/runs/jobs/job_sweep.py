"""Sweep of a job: what a study file asks for, computed in a folder."""

from pathlib import Path

from turgor.foundation.source import Source
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.jobs.job_file import job_file
from turgor.studies.runs.jobs.study_file import StudyFile
from turgor.studies.runs.study import Study
from turgor.studies.runs.sweep import study_of


def sweep_job(asked: StudyFile, folder: str | Path, evaluations: Evaluations) -> Study:
    """Compute the designs of a study file.

    Parameters
    ----------
    asked : StudyFile
    folder : str or Path
        Where the job is written with every value.
    evaluations : Evaluations

    Returns
    -------
    Study

    Raises
    ------
    TurgorError
        If the folder holds something else.
    """
    base = job_file(asked.job, Path(folder))
    computation = base.computation(mesh_error=asked.mesh_error, measures=asked.measures)
    source = Source(text=f"sweep of the job '{asked.job.name}', {asked.designs.rule}")
    return study_of(computation, asked.designs, evaluations, source)
