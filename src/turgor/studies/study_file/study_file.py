"""StudyFile: the content of a study file, and its reader."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.foundation.errors import TurgorError, near_file, near_match
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.job import Job
from turgor.job.read import name_of_file, read_name
from turgor.job.text.lines import key_lines
from turgor.job.text.problems import JobError, Problems
from turgor.job.text.quantities import read_table
from turgor.studies.calibration.job_calibration import CalibrationPlan
from turgor.studies.optimization.job_optimization import OptimizationPlan
from turgor.studies.study_file.analysis_tables import SensitivityTable, SurrogateTable
from turgor.studies.study_file.calibrate_table import read_calibrate
from turgor.studies.study_file.job_base import JobBase, check_factor, flat_keys
from turgor.studies.study_file.optimize_table import read_optimize
from turgor.studies.study_file.sweep_table import SweepPlan, read_sweep
from turgor.studies.study_file.uncertainty_table import read_uncertainty
from turgor.studies.uncertainty.job_uncertainty import UncertaintyPlan

#: Kinds of study with runs of their own, and analyses of the runs of a sweep; each has a table.
SEARCHES = ("optimize", "calibrate", "uncertainty")
ANALYSES = ("sensitivity", "surrogate")
KINDS = ("sweep", *SEARCHES, *ANALYSES)

#: Keys of a study file.
SECTIONS = ("name", "job", "factors", *KINDS)


#: Readers of the tables of studies with runs of their own.
READERS: Mapping[str, Callable[[Any, Mapping[tuple[str, ...], Any], JobBase, Path, Problems], Any]] = MappingProxyType(
    {"sweep": read_sweep, "optimize": read_optimize, "calibrate": read_calibrate, "uncertainty": read_uncertainty}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFile:
    """Content of a study file: a job, and a plan for each kind of study with a table.

    Parameters
    ----------
    name : str
    job : Job
    folder : Path
        Of the job file; files that are factors lie in it.
    sweep : SweepPlan or None
    optimize : OptimizationPlan or None
    calibrate : CalibrationPlan or None
    uncertainty : UncertaintyPlan or None
    sensitivity : SensitivityTable
    surrogate : SurrogateTable
    """

    name: str
    job: Job
    folder: Path = Path()
    sweep: SweepPlan | None = None
    optimize: OptimizationPlan | None = None
    calibrate: CalibrationPlan | None = None
    uncertainty: UncertaintyPlan | None = None
    sensitivity: SensitivityTable = field(default_factory=SensitivityTable)
    surrogate: SurrogateTable = field(default_factory=SurrogateTable)


def read_study_file(path: str | Path, changes: Mapping[str, Any] = MappingProxyType({}), kind: str = "") -> StudyFile:
    """Read a study file.

    Parameters
    ----------
    path : str or Path
    changes : mapping of str to value
        Changes of the job, as for `turgor.jobs.read_job`.
    kind : str
        The kind of study that is needed, such as ``"optimize"``: its table must be there, and others are not read. By
        default all are read.

    Returns
    -------
    StudyFile

    Raises
    ------
    JobError
        If anything in the file is wrong: a line for each problem, with file, line and key.
    TurgorError
        If the file or its job cannot be read.
    """
    path = Path(path)
    if not path.is_file():
        known = sorted(each.name for each in path.parent.glob("*.toml")) if path.parent.is_dir() else []
        raise TurgorError(f"there is no study file '{path}'{near_file(path, known)}")
    text = read_text(path)
    try:
        content = read_toml(text, str(path))
    except TurgorError as error:
        raise JobError([str(error)]) from None
    return study_of(content, path, Problems(str(path), key_lines(text)), changes, kind)


def study_of(
    content: Mapping[str, Any], path: Path, problems: Problems, changes: Mapping[str, Any], kind: str = ""
) -> StudyFile:
    """Read the content of a study file, from wherever it comes.

    Parameters
    ----------
    content : mapping
    path : Path
        The file; relative paths begin in its folder.
    problems : Problems
        Where its problems are noted.
    changes, kind
        As those of `read_study_file`.

    Returns
    -------
    StudyFile
    """
    for key in content:
        if key not in SECTIONS:
            near = near_match(key, SECTIONS) or "."
            problems.add((key,), f"unknown key '{key}'{near} Known keys: {', '.join(SECTIONS)}.")
    if not isinstance(content.get("job"), str):
        problems.add(("job",), "'job' is missing; name a job file, such as job = \"finger.toml\".")
    needed = "sweep" if kind in ANALYSES else kind
    if needed and needed not in content and (needed != "sweep" or set(content) & set(SEARCHES)):
        problems.add((needed,), f"the table [{needed}] is missing.")
    problems.raise_any()
    base = JobBase(path.parent / content["job"], changes)
    plans = _plans(content, base, path.parent, problems, kind)
    name = read_name(content.get("name", name_of_file(path)), problems)
    problems.raise_any()
    return StudyFile(name=name, job=base.job, folder=base.file.parent, **plans)


def _plans(content: Mapping[str, Any], base: JobBase, folder: Path, problems: Problems, kind: str) -> dict[str, Any]:
    """Read the tables of the kinds; a file without a search is a sweep."""
    factors = _factors(content.get("factors", {}), problems)
    kinds = [kind] if kind else [each for each in KINDS if each in content]
    if not set(kinds) & {"sweep", *SEARCHES}:
        kinds = ["sweep", *kinds]
    plans: dict[str, Any] = {}
    for each in kinds:
        given = content.get(each, {})
        if each in ANALYSES:
            table = SensitivityTable if each == "sensitivity" else SurrogateTable
            plans[each] = read_table(table, given, (each,), problems)
        else:
            plans[each] = READERS[each](given, factors, base, folder, problems)
    return plans


def _factors(given: Any, problems: Problems) -> dict[tuple[str, ...], Any]:
    if not isinstance(given, Mapping):
        problems.add(("factors",), f"{given!r} is not a table; write [factors] and its keys below it.")
        return {}
    factors = dict(flat_keys(given))
    for place, value in factors.items():
        problems.attempt(("factors", *place), partial(check_factor, value))
    return factors
