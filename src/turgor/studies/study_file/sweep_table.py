"""``[sweep]`` of a study file: which designs are computed, and what is read from them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import isfinite
from pathlib import Path
from typing import Any

from turgor.core.results.measures.measures import find_measure
from turgor.foundation.errors import TurgorError, near_match
from turgor.job.job import Job
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Table, read_table
from turgor.studies.runs.designs import Designs, factorial, latin_hypercube, sobol
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.jobs.columns import unit_of_column
from turgor.studies.study_file.job_base import JobBase
from turgor.units import UNITS, parse_quantity, split_quantity, unit_value

#: Rules by which designs are chosen.
DESIGNS = ("factorial", "latin_hypercube", "sobol", "table")

#: The table of a sweep.
SWEEP = ("sweep",)


class SweepTable(Table):
    """``[sweep]``: the designs that are computed, and what the table and the pictures show.

    Keys
    ----
    design : str
        Rule by which designs are chosen: ``"factorial"``, ``"latin_hypercube"``, ``"sobol"`` or ``"table"``.
    samples : int
        Number of designs of a Latin hypercube or of Sobol points.
    seed : int
    table : str
        CSV file with a line for each design; its headers are keys with units, ``actuator.wall (mm)``.
    measures : list of str
        By default those of the job.
    at : table
        One column of the responses and its value, at which measures are read: ``{ pressure = "50 kPa" }``; by default
        the end of each path.
    mesh_error : bool
        Whether the mesh error of each run is estimated; by default as the job says.
    """

    design: str = "factorial"
    samples: int | None = None
    seed: int = 0
    table: str | None = None
    measures: list[str] | None = None
    at: dict[str, Any] | None = None
    mesh_error: bool | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepPlan:
    """The designs of a sweep, and what is read from them.

    Parameters
    ----------
    designs : Designs
    measures : tuple of str
        Names; empty for those of the job.
    at : (str, float) or None [SI]
    mesh_error : bool
    """

    designs: Designs
    measures: tuple[str, ...] = ()
    at: tuple[str, float] | None = None
    mesh_error: bool = True


def read_sweep(
    given: Any, factors: Mapping[tuple[str, ...], Any], base: JobBase, folder: Path, problems: Problems
) -> SweepPlan | None:
    """Read ``[sweep]``.

    Parameters
    ----------
    given : mapping
        The table.
    factors : mapping of tuple of str to value
        ``[factors]`` by the parts of their keys.
    base : JobBase
    folder : Path
        Where relative paths begin.
    problems : Problems

    Returns
    -------
    SweepPlan or None
        None if there is any problem.
    """
    parsed = [problems.attempt(("factors", *place), partial(base.factor, ".".join(place), value))
            for place, value in factors.items()]  # fmt: skip
    table: SweepTable | None = read_table(SweepTable, given, SWEEP, problems)
    if table is None or problems.entries:
        return None
    designs = _designs(table, [each for each in parsed if each is not None], folder, base, problems)
    measures = read_measures(table.measures, SWEEP, problems)
    at = read_at(table.at, base.job, measures, SWEEP, problems)
    if designs is None or problems.entries:
        return None
    error = bool(base.job.output.mesh_error) if table.mesh_error is None else table.mesh_error
    return SweepPlan(designs=designs, measures=measures, at=at, mesh_error=error)


def read_measures(given: Sequence[str] | None, key: tuple[str, ...], problems: Problems) -> tuple[str, ...]:
    """Return the names of measures of a table; none if it names none."""
    measures = [problems.attempt((*key, "measures"), partial(_measure, each)) for each in given or ()]
    return tuple(each for each in measures if each is not None)


def read_at(
    given: Mapping[str, Any] | None, job: Job, measures: Sequence[str], key: tuple[str, ...], problems: Problems
) -> tuple[str, float] | None:
    """Return the column and its value [SI] at which measures are read; None if the table has neither."""
    if given is None or problems.entries:
        return None
    return problems.attempt((*key, "at"), partial(_at, given, job, measures))


def _designs(
    given: SweepTable, factors: list[Factor], folder: Path, base: JobBase, problems: Problems
) -> Designs | None:
    rule = given.design
    if rule not in DESIGNS:
        near = near_match(rule, DESIGNS) or "."
        problems.add((*SWEEP, "design"), f"unknown design '{rule}'{near} Known: {', '.join(DESIGNS)}.")
        return None
    if rule == "table":
        if factors or given.table is None:
            missing = "'table' is missing: the name of a CSV file." if given.table is None else "leave out [factors]."
            problems.add((*SWEEP, "table"), f"a table names its factors itself; {missing}")
            return None
        return problems.attempt((*SWEEP, "table"), partial(base.table, folder / given.table))
    if not factors:
        problems.add(("factors",), "nothing varies; write [factors] with a key of the job and its levels.")
        return None
    if rule == "factorial":
        return problems.attempt(("factors",), partial(factorial, factors))
    if given.samples is None:
        problems.add((*SWEEP, "samples"), "'samples' is missing: the number of designs.")
        return None
    sampled = latin_hypercube if rule == "latin_hypercube" else sobol
    return problems.attempt(SWEEP, partial(sampled, factors, given.samples, given.seed), ("samples",))


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
