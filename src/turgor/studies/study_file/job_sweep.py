"""Sweep of a job: what a study file states, computed in a folder."""

from pathlib import Path

from turgor.core.geometry.cad.parametric.drawn import files_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.studies.runs.designs import Designs
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
        If the study file has no sweep, the folder holds something else, or a file that is a factor is missing or has
        changed since the study began.
    """
    plan = study.sweep
    if plan is None:
        raise TurgorError(f"the study file '{study.name}' has no sweep; add the table [sweep].")
    base = job_function(study.job, Path(folder))
    _copy_files(study, plan.designs, Path(folder))
    computation = base.computation(mesh_error="every" if plan.mesh_error else "none", measures=plan.measures)
    source = Source(text=f"sweep of the job '{study.job.name}', {plan.designs.rule}")
    return study_of(computation, plan.designs, evaluations, source)


def _copy_files(study: StudyFile, designs: Designs, folder: Path) -> None:
    """Copy the files that are factors next to the job of the study, so that its runs belong to what they hold now."""
    named = {(key, value) for row in designs.values for key, value in row.items() if key.endswith(".file")}
    for key, name in sorted((key, name) for key, name in named if isinstance(name, str)):
        if Path(name).is_absolute() or ".." in Path(name).parts:
            raise TurgorError(f"factors.{key}: '{name}' must lie in the folder of the job, '{study.folder}'.")
        if not (study.folder / name).is_file():
            raise TurgorError(f"factors.{key}: there is no file '{study.folder / name}'.")
        for source in sorted(files_of(study.folder / name)):
            _copy(key, source, folder / source.relative_to(study.folder), folder)


def _copy(key: str, source: Path, target: Path, folder: Path) -> None:
    """Copy a file, unless another one is there."""
    content = source.read_bytes()
    if target.is_file() and target.read_bytes() != content:
        raise TurgorError(
            f"factors.{key}: '{source}' has changed since the study in '{folder}' began; name another folder of "
            "results, or give the file another name."
        )
    target.parent.mkdir(parents=True, exist_ok=True)
    with whole(target) as part:
        part.write_bytes(content)
