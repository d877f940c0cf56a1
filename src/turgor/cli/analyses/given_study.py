"""Studies that commands take: a folder or a table that was written, or a study file that is computed first."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import typer

from turgor.cli.start.signals import saved_in_folder

if TYPE_CHECKING:
    from turgor.studies.runs.executors.executor import Executor
    from turgor.studies.runs.factor import Factor
    from turgor.studies.runs.study import Study
    from turgor.studies.study_file.study_file import StudyFile
    from turgor.studies.uncertainty.spread import Spread

#: Ending of study files.
TOML = ".toml"


class HowComputed(Protocol):
    """Options of commands that compute a study file."""

    @property
    def processes(self) -> int:
        """Processes at once."""

    @property
    def scheduler(self) -> str | None:
        """Address of a Dask scheduler."""

    @property
    def retry(self) -> bool:
        """Whether failed runs are computed again."""

    @property
    def changes(self) -> list[str] | None:
        """What ``--set`` states."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenStudy:
    """A study that a command analyzes.

    Parameters
    ----------
    study : Study
    folder : Path
        Folder of its files.
    file : StudyFile or None
        The study file, if there is one: where and what measures are read, and how they are analyzed.
    """

    study: "Study"
    folder: Path
    file: "StudyFile | None" = None

    @property
    def at(self) -> tuple[str, float] | None:
        """Where measures are read, as the study file says."""
        return None if self.file is None or self.file.sweep is None else self.file.sweep.at

    @property
    def measures(self) -> Sequence[str]:
        """What is measured, as the study file says."""
        return () if self.file is None or self.file.sweep is None else self.file.sweep.measures


def given_study(path: Path, how: HowComputed, kind: str) -> GivenStudy:
    """Read a study, or compute that of a study file.

    Parameters
    ----------
    path : Path
        Folder of ``turgor sweep``, table of a study, or study file.
    how : HowComputed
        For a study file.
    kind : str
        ``"sensitivity"`` or ``"surrogate"``.

    Returns
    -------
    GivenStudy
    """
    from turgor.cli.analyses.machines import executor_of
    from turgor.foundation.errors import TurgorError
    from turgor.job.text.overrides import parse_changes
    from turgor.studies.runs.files.study_folder import load_study, write_study
    from turgor.studies.study_file.study_file import read_study_file

    if path.suffix.lower() != TOML:
        given_options = {"--set": how.changes, "--scheduler": how.scheduler, "--retry": how.retry}
        option = next((name for name, value in given_options.items() if value), None)
        if option is not None:
            raise TurgorError(f"{option} goes with a study file, which is computed; '{path}' is read as it is.")
        study = load_study(path)
        return GivenStudy(study=study, folder=path if path.is_dir() else path.with_suffix(""))
    file = read_study_file(path, parse_changes(how.changes or ()), kind)
    folder = Path(f"{file.name}-study")
    executor = executor_of(how.scheduler, gather=False, processes=how.processes)
    study = computed_study(file, folder, executor, retry=how.retry)
    given = GivenStudy(study=study, folder=folder, file=file)
    write_study(study, folder, given.measures or study.measures, given.at)
    for line in study.problems:
        typer.echo(line, err=True)
    return given


def computed_study(file: "StudyFile", folder: Path, executor: "Executor", *, retry: bool = False) -> "Study":
    """Compute a study file, with a display of its progress; its runs are stored in the folder.

    Parameters
    ----------
    file : StudyFile
        With a sweep.
    folder : Path
    executor : Executor
        Where runs are computed.
    retry : bool
        Whether runs that failed or ended early before are computed again.

    Returns
    -------
    Study
    """
    from turgor.cli.analyses.progress import StudyProgress
    from turgor.studies.runs.evaluations import Evaluations
    from turgor.studies.runs.jobs.job_function import RUNS
    from turgor.studies.study_file.job_sweep import sweep_job

    with (
        saved_in_folder(folder),
        StudyProgress(0 if file.sweep is None else len(file.sweep.designs)) as progress,
        Evaluations(folder=folder / RUNS, executor=executor, progress=progress, retry=retry) as runs,
    ):
        return sweep_job(file, folder, runs)


def numbers_given(texts: Sequence[str] | None, units: Mapping[str, str], option: str) -> dict[str, float]:
    """Read values such as ``wall=1.2 mm``.

    Parameters
    ----------
    texts : sequence of str or None
    units : mapping of str to str
        Unit in which each name is shown.
    option : str
        Beginning of messages.

    Returns
    -------
    dict of str to float [SI]
    """
    from turgor.foundation.errors import TurgorError, unknown
    from turgor.studies.runs.jobs.job_numbers import JobNumber, read_number

    numbers = {}
    for text in texts or ():
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and name and value):
            raise TurgorError(f"{option} is '{text}'; write NAME=VALUE, such as {option} pressure='30 kPa'.")
        if name not in units:
            raise unknown(f"name in {option}", name, units)
        numbers[name] = read_number(value, JobNumber(key=name, value=0.0, unit=units[name]), f"{option} {name}")
    return numbers


def values_given(
    texts: Sequence[str] | None, factors: "Sequence[Factor]", option: str
) -> "dict[str, float | int | str]":
    """Read values of factors such as ``wall=1.2 mm`` or ``materials.body=ecoflex-00-30/yeoh-steck-2019``.

    Parameters
    ----------
    texts : sequence of str or None
    factors : sequence of Factor
    option : str
        Beginning of messages.

    Returns
    -------
    dict of str to float or str [SI]
    """
    choices = {each.name for each in factors if each.is_choice}
    values: dict[str, float | int | str] = {}
    for text in texts or ():
        name, sign, value = (part.strip() for part in text.partition("="))
        values |= {name: value} if sign and name in choices else numbers_given([text], units_of(factors), option)
    return values


def spreads_given(texts: Sequence[str], factors: "Sequence[Factor]") -> "list[Spread]":
    """Read spreads of factors such as ``wall=1.2 mm+-0.1 mm``; without a mean around the middle of the range.

    Parameters
    ----------
    texts : sequence of str
    factors : sequence of Factor

    Returns
    -------
    list of Spread
    """
    from turgor.foundation.errors import TurgorError, unknown
    from turgor.studies.runs.jobs.job_numbers import JobNumber
    from turgor.studies.uncertainty.job_spreads import read_spread

    known = {each.name: each for each in factors}
    spreads = []
    for text in texts:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and name and value):
            raise TurgorError(f"--spread is '{text}'; write NAME=MEAN+-DEVIATION, such as wall='1.2 mm+-0.1 mm'.")
        if name not in known:
            raise unknown("name in --spread", name, known)
        middle = float(known[name].at(0.5))
        number = JobNumber(key=name, value=middle, unit=known[name].unit)
        try:
            spreads.append(read_spread(name, value, number))
        except TurgorError as error:
            raise TurgorError(f"--spread {name}: {error}") from None
    return spreads


def read_at(text: str, study: "Study") -> tuple[str, float] | None:
    """Read where measures are read, such as ``pressure=40 kPa``; nothing is None."""
    if not text:
        return None
    units = {name: study.unit(name) for name in study.measures}
    ((name, value),) = numbers_given([text], units, "--at").items()
    return name, value


def units_of(factors: "Sequence[Factor]") -> dict[str, str]:
    """Return the unit in which each factor is shown."""
    return {each.name: each.unit for each in factors}
