"""Study files: TOML that names a job, what varies in it, and what is measured."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from math import isfinite
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from turgor.core.results.measures.measures import find_measure
from turgor.foundation.errors import TurgorError, near_file, near_match
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.read import name_of_file, read_job, read_name
from turgor.job.text.lines import key_lines
from turgor.job.text.problems import JobError, Problems
from turgor.job.text.quantities import Table, read_table
from turgor.studies.runs.designs import Designs, factorial, latin_hypercube, sobol
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.files.designs_csv import read_designs
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.runs.jobs.job_factors import RANGE, check_choices, job_factor
from turgor.studies.runs.jobs.job_numbers import numbers_of
from turgor.units import UNITS, parse_quantity, split_quantity, unit_value

#: Keys of a study file.
SECTIONS = ("name", "job", "factors", "design", "output")

#: Rules by which designs are chosen.
KINDS = ("factorial", "latin_hypercube", "sobol", "table")

AnyTable = TypeVar("AnyTable", bound=Table)


class DesignTable(Table):
    """``[design]``: the rule by which designs are chosen.

    Keys
    ----
    kind : str
        ``"factorial"``, ``"latin_hypercube"``, ``"sobol"`` or ``"table"``.
    samples : int
        Number of designs of a Latin hypercube or of Sobol points.
    seed : int
    table : str
        CSV file with a line for each design; its headers are keys with units, ``actuator.wall (mm)``.
    """

    kind: str = "factorial"
    samples: int | None = None
    seed: int = 0
    table: str | None = None


class MeasuredTable(Table):
    """``[output]``: what the table and the pictures show.

    Keys
    ----
    measures : list of str
        By default those of the job.
    at : table
        One column of the responses and its value, at which measures are read: ``{ pressure = "50 kPa" }``; by default
        the end of each path.
    mesh_error : bool
        Whether the mesh error of each run is estimated; by default as the job says.
    """

    measures: list[str] | None = None
    at: dict[str, Any] | None = None
    mesh_error: bool | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFile:
    """What a study file asks for.

    Parameters
    ----------
    name : str
    job : Job
    designs : Designs
    measures : tuple of str
        Names; empty for those of the job.
    at : (str, float) or None [SI]
    mesh_error : bool
    """

    name: str
    job: Job
    designs: Designs
    measures: tuple[str, ...] = ()
    at: tuple[str, float] | None = None
    mesh_error: bool = True


@dataclass(frozen=True, slots=True)
class JobBase:
    """The job that a study varies.

    Parameters
    ----------
    file : Path
    changes : mapping
        Of the command line.
    """

    file: Path
    changes: Mapping[str, Any]
    job: Job = field(init=False)
    whole: Mapping[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "job", read_job(self.file, self.changes))
        object.__setattr__(self, "whole", tomllib.loads(lock_text(self.job, {})))

    def factor(self, key: str, given: Any) -> Factor:
        """Return a factor that the job takes."""
        found = job_factor(key, given, self.whole, numbers_of(self.whole))
        check_choices(self.file, self.changes, [found], self.whole)
        return found

    def table(self, file: Path) -> Designs:
        """Return the designs of a table that the job takes."""
        designs = read_designs(file, numbers_of(self.whole))
        check_choices(self.file, self.changes, designs.factors, self.whole)
        return designs


def read_study_file(path: str | Path, changes: Mapping[str, Any] = MappingProxyType({})) -> StudyFile:
    """Read a study file.

    Parameters
    ----------
    path : str or Path
    changes : mapping of str to value
        Changes of the job, as for `turgor.jobs.read_job`.

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
    problems = Problems(str(path), key_lines(text))
    for key in content:
        if key not in SECTIONS:
            problems.add(
                (key,), f"unknown key '{key}'{near_match(key, SECTIONS) or '.'} Known keys: {', '.join(SECTIONS)}."
            )
    if not isinstance(content.get("job"), str):
        problems.add(("job",), "'job' is missing; name a job file, such as job = \"finger.toml\".")
    problems.raise_any()
    base = JobBase(path.parent / content["job"], changes)
    found = _read(content, path, base, problems)
    problems.raise_any()
    assert found is not None
    return found


def _read(content: Mapping[str, Any], path: Path, base: JobBase, problems: Problems) -> StudyFile | None:
    job = base.job
    factors = _factors(content.get("factors", {}), base, problems)
    design: DesignTable | None = read_table(DesignTable, content.get("design", {}), ("design",), problems)
    output: MeasuredTable | None = read_table(MeasuredTable, content.get("output", {}), ("output",), problems)
    if design is None or output is None or problems.found:
        return None
    designs = _designs(design, factors, path, base, problems)
    measures = [problems.attempt(("output", "measures"), partial(_measure, each))
                for each in output.measures or ()]  # fmt: skip
    given = output.at
    at = None
    if given is not None and not problems.found:
        named = tuple(each for each in measures if each is not None)
        at = problems.attempt(("output", "at"), partial(_at, given, job, named))
    if designs is None or problems.found:
        return None
    return StudyFile(
        name=read_name(content.get("name", name_of_file(path)), problems), job=job, designs=designs,
        measures=tuple(each for each in measures if each is not None), at=at,
        mesh_error=bool(job.output.mesh_error) if output.mesh_error is None else output.mesh_error,
    )  # fmt: skip


def _factors(given: Any, base: JobBase, problems: Problems) -> list[Factor]:
    if not isinstance(given, Mapping):
        problems.add(("factors",), f"{given!r} is not a table; write [factors] and its keys below it.")
        return []
    found = []
    for place, value in flat_keys(given):
        factor = problems.attempt(("factors", *place), partial(base.factor, ".".join(place), value))
        if factor is not None:
            found.append(factor)
    return found


def flat_keys(given: Mapping[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Go through factors, whether their keys stand in quotes or as tables within tables.

    Parameters
    ----------
    given : mapping
        ``[factors]`` of a study file.
    above : tuple of str
        Keys of the tables around it.

    Yields
    ------
    (tuple of str, value)
        The parts of the key, and levels or a range.

    Examples
    --------
    >>> dict(flat_keys({"actuator": {"wall": {"low": "1 mm", "high": "2 mm"}}}))
    {('actuator', 'wall'): {'low': '1 mm', 'high': '2 mm'}}
    """
    for name, value in given.items():
        if isinstance(value, Mapping) and not set(value) & set(RANGE):
            yield from flat_keys(value, (*above, name))
        else:
            yield (*above, name), value


def _designs(
    design: DesignTable, factors: list[Factor], path: Path, base: JobBase, problems: Problems
) -> Designs | None:
    if design.kind not in KINDS:
        known = ", ".join(KINDS)
        problems.add(
            ("design", "kind"), f"unknown kind '{design.kind}'{near_match(design.kind, KINDS) or '.'} Known: {known}."
        )
        return None
    if design.kind == "table":
        if factors or design.table is None:
            missing = "'table' is missing: the name of a CSV file." if design.table is None else "leave out [factors]."
            problems.add(("design", "table"), f"a table names its factors itself; {missing}")
            return None
        file = path.parent / design.table
        return problems.attempt(("design", "table"), partial(base.table, file))
    if not factors:
        problems.add(("factors",), "nothing varies; write [factors] with a key of the job and its levels.")
        return None
    if design.kind == "factorial":
        return problems.attempt(("factors",), partial(factorial, factors))
    samples = design.samples
    if samples is None:
        problems.add(("design", "samples"), "'samples' is missing: the number of designs.")
        return None
    rule = latin_hypercube if design.kind == "latin_hypercube" else sobol
    return problems.attempt(("design",), partial(rule, factors, samples, design.seed), ("samples",))


def _measure(name: str) -> str:
    return find_measure(name).name


def _at(given: Mapping[str, Any], job: Job, measures: Sequence[str]) -> tuple[str, float]:
    if len(given) != 1:
        raise TurgorError('give one column and its value, such as { pressure = "50 kPa" }.')
    ((name, value),) = given.items()
    unit = unit_of_column(job, name, measures)
    if isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value):
        return name, float(value)
    read = split_quantity(value) if isinstance(value, str) else None
    if read is None:
        raise TurgorError(f"{name}: {value!r} is no number with a unit, such as '50 kPa'.")
    dimension = next((each for each, units in UNITS.items() if unit in units), "")
    return name, parse_quantity(str(value), dimension) if dimension else read[0] * unit_value(read[1])
