"""Where `turgor sweep` computes: on this machine, on the workers of a Dask scheduler, or as tasks of a SLURM array."""

import re
import shlex
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from turgor.cli.options import check_new
from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import whole
from turgor.studies.runs.executors.array_tasks import Gathering, share
from turgor.studies.runs.executors.dask_workers import OnDask
from turgor.studies.runs.executors.executor import Executor
from turgor.studies.runs.executors.worker_processes import Workers
from turgor.studies.runs.jobs.job_function import job_function
from turgor.studies.study_file.study_file import StudyFile
from turgor.studies.study_file.sweep_table import SweepPlan

#: A job script of SLURM: an array of tasks that each compute a share.
SCRIPT = """\
#!/bin/bash
#SBATCH --job-name={name}
#SBATCH --array=1-{tasks}
#SBATCH --cpus-per-task=1
#SBATCH --output={log}
#SBATCH --chdir={here}
# {designs} designs in {tasks} tasks, on machines that share this folder.
exec {command} --index "$SLURM_ARRAY_TASK_ID" --of {tasks}
"""


def check_together(scheduler: str | None, index: int | None, of: int | None, gather: bool, sbatch: Path | None) -> None:
    """Raise an error if options exclude each other."""
    given = {"--scheduler": scheduler, "--index": index, "--gather": gather or None, "--sbatch": sbatch}
    named = [name for name, value in given.items() if value is not None]
    if len(named) > 1:
        raise TurgorError(f"{' and '.join(named)} exclude each other; give one of them.")
    if of is not None and index is None and sbatch is None:
        raise TurgorError("--of is the number of tasks for --index or --sbatch; give one of these, too.")


def check_retry(retry: bool, gather: bool, sbatch: Path | None) -> None:
    """Raise an error if failed runs are to be computed again by a call that computes nothing."""
    other = "--gather" if gather else "--sbatch" if sbatch is not None else ""
    if retry and other:
        raise TurgorError(f"--retry computes failed runs again, and {other} computes nothing; give it where runs are.")


def executor_of(scheduler: str | None, gather: bool, processes: int) -> Executor:
    """Return where runs are computed."""
    if gather:
        return Gathering()
    return Workers(processes=processes) if scheduler is None else OnDask(scheduler=scheduler)


def share_of(given: SweepPlan, index: int, of: int | None) -> SweepPlan:
    """Return a sweep with the designs of one task alone; an error if it has none."""
    count = len(given.designs)
    places = share(count, index, count if of is None else of)
    if not places:
        raise TurgorError(f"--index is {index}, but there are {count} designs only; give fewer tasks to --of.")
    values = tuple(given.designs.values[k] for k in places)
    return replace(given, designs=replace(given.designs, values=values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Script:
    """A job script to write.

    Parameters
    ----------
    file : Path
    tasks : int or None
        Number of tasks; by default one for each design.
    force : bool
        Whether a file that exists is replaced.
    """

    file: Path
    tasks: int | None
    force: bool


def write_script(given: StudyFile, study: Path, folder: Path, script: Script) -> str:
    """Write a job script of SLURM, and return what to do with it.

    Parameters
    ----------
    given : StudyFile
    study : Path
        The file that it was read from.
    folder : Path
        Folder of results. The job is written there at once, so that tasks do not all write it; SLURM adds its logs.
    script : Script

    Raises
    ------
    TurgorError
        If the file exists, or the name of a file or folder has a line break, which would add lines to the script.
    """
    check_new(script.file, script.force, "--sbatch")
    designs = 0 if given.sweep is None else len(given.sweep.designs)
    tasks = min(script.tasks or designs, designs)
    job_function(given.job, folder)
    _directive(str(study))
    arguments = ["sweep", str(study), "--output", str(folder)]
    text = SCRIPT.format(
        name=_directive(given.name), tasks=tasks, designs=designs, here=_directive(str(Path.cwd())),
        log=_directive(str(folder).replace("%", "%%") + "/slurm-%A-%a.log"),
        command=shlex.join([sys.executable, "-m", "turgor", *arguments]),
    )  # fmt: skip
    with whole(script.file) as part:
        part.write_text(text, encoding="utf-8")
        part.chmod(0o755)
    again = shlex.join(["turgor", *arguments, "--gather"])
    submit = shlex.join(["sbatch", str(script.file)])
    return f"{designs} designs in {tasks} tasks. Submit them: {submit}; then write the table: {again}"


def _directive(value: str) -> str:
    """Write a value of a directive of SLURM, in quotes where it needs them."""
    if not value.isprintable():
        raise TurgorError(f"{value!r} has a character that a job script cannot hold; rename the file or folder.")
    if not re.search(r"[^\w./%@:+,=-]", value):
        return value
    return '"' + re.sub(r'(["\\])', r"\\\1", value) + '"'
