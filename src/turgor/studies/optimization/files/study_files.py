"""Study files of an optimization: factors, goals and settings as TOML, beside a job file."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

from turgor.foundation.errors import TurgorError
from turgor.foundation.toml_text import read_text, read_toml
from turgor.studies.optimization.files.numbers import Table, check_keys, number_in, numbers_in, unit_in
from turgor.studies.optimization.files.workspaces import read_workspace
from turgor.studies.optimization.goals import (
    LIMIT_TOLERANCE,
    PATH_TOLERANCE,
    TARGET_TOLERANCE,
    Goal,
    Limit,
    Maximize,
    Minimize,
    Target,
    TipPath,
)
from turgor.studies.optimization.manufacture import Casting
from turgor.studies.optimization.row_values import At
from turgor.studies.optimization.search import Search
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.jobs.job_factors import job_factor
from turgor.studies.runs.jobs.job_file import JobFile
from turgor.studies.runs.jobs.study_file import flat_keys

Made = TypeVar("Made")

#: Tables of a study file; lists of tables are written with two brackets.
KEYS = ("job", "factors", "targets", "paths", "limits", "objectives", "workspace", "casting", "search")
GOALS = ("targets", "paths", "limits", "objectives")

#: Keys of each goal.
GOAL_KEYS = {
    "targets": ("measure", "value", "at", "scale", "tolerance"),
    "paths": ("x", "z", "pressure", "tolerance"),
    "limits": ("measure", "most", "least", "at", "scale", "tolerance"),
    "objectives": ("minimize", "maximize", "at", "scale"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFile:
    """What a study file asks for.

    Parameters
    ----------
    file : Path
    job : Path
        The job file, beside the study file where its path is relative.
    factors : mapping of str to mapping
        ``low``, ``high`` and ``start`` by the keys of the job, as they stand there.
    goals : tuple of Goal
    workspace : mapping of str to tuple of float [Pa]
        Pressures of each cavity; empty where no goal reads the workspace.
    casting : Casting or None
        None where nothing is to be cast.
    search : Search
    """

    file: Path
    job: Path
    factors: Mapping[str, Table]
    goals: tuple[Goal, ...]
    workspace: Mapping[str, tuple[float, ...]]
    casting: Casting | None
    search: Search


def read_study_file(path: str | Path) -> StudyFile:
    """Read a study file of an optimization.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    StudyFile

    Raises
    ------
    TurgorError
        If it cannot be read, or a key or a value is wrong; the sentence names both.
    """
    path = Path(path)
    content = read_toml(read_text(path), str(path))
    check_keys(content, KEYS, str(path))
    for key in ("job", "factors"):
        if not content.get(key):
            raise TurgorError(f"{path}: '{key}' is missing; {_MISSING[key]}")
    goals = [_goal(kind, table, f"{path}: [[{kind}]]") for kind in GOALS for table in _list(content, kind, path)]
    if "casting" in content:
        casting = _made(Casting, _table(content, "casting", path), f"{path}: [casting]")
    return StudyFile(
        file=path,
        job=path.parent / str(content["job"]),
        factors=_factor_tables(_table(content, "factors", path), path),
        goals=tuple(goals),
        workspace=read_workspace(_table(content, "workspace", path), f"{path}: [workspace]"),
        casting=casting if "casting" in content else None,
        search=_made(Search, _table(content, "search", path), f"{path}: [search]"),
    )


_MISSING = {
    "job": 'name the job file: job = "finger.toml".',
    "factors": 'give ranges: [factors] with "actuator.wall" = { low = "1 mm", high = "2 mm" }.',
}


def read_factors(study: StudyFile, base: JobFile) -> tuple[list[Factor], dict[str, Value]]:
    """Return the factors with the units of the job, and where the search starts: at the job where nothing else is said.

    Parameters
    ----------
    study : StudyFile
    base : JobFile
        The job.

    Returns
    -------
    (list of Factor, dict of str to number)

    Raises
    ------
    TurgorError
        If the job has no such number, or a unit is missing.
    """
    found: list[Factor] = []
    start: dict[str, Value] = {}
    for key, table in study.factors.items():
        try:
            ends = {end: table[end] for end in ("low", "high")}
            factor = job_factor(key, ends, base.content, base.numbers)
            number = base.numbers[factor.name.split(",")[0]]
            begin = number.value
            if "start" in table:
                begin = float(job_factor(key, [table["start"]], base.content, base.numbers).levels[0])
        except TurgorError as error:
            raise TurgorError(f"{study.file}: [factors] {key}: {error}") from None
        low, high = factor.bounds
        found.append(factor)
        start[factor.name] = round(begin) if number.whole else min(max(begin, low), high)
    return found, start


def _factor_tables(given: Table, path: Path) -> dict[str, Table]:
    """Ranges by their keys with dots between."""
    named = {".".join(place): each for place, each in flat_keys(given)}
    return {key: _factor_table(key, each, path) for key, each in named.items()}


def _factor_table(key: str, given: Any, path: Path) -> Table:
    where = f"{path}: [factors] {key}"
    if not isinstance(given, Mapping):
        raise TurgorError(f'{where} is {given!r}; write {{ low = "1 mm", high = "2 mm" }}.')
    check_keys(given, ("low", "high", "start"), where)
    for end in ("low", "high"):
        if end not in given:
            raise TurgorError(f"{where}: '{end}' is missing.")
    return given


def _goal(kind: str, table: Table, where: str) -> Goal:
    """Read one goal."""
    check_keys(table, GOAL_KEYS[kind], where)
    if kind == "paths":
        return _path(table, where)
    at = _at(table.get("at"), where)
    numbers = {key: number_in(table[key], f"{where}.{key}") for key in table if key in _NUMBERS}
    if kind == "objectives":
        given = [key for key in ("minimize", "maximize") if key in table]
        if len(given) != 1:
            raise TurgorError(f'{where} needs either minimize or maximize, such as minimize = "solid_volume".')
        kind_of = Minimize if given[0] == "minimize" else Maximize
        return kind_of(str(table[given[0]]), at=at, scale=numbers.get("scale"))
    if "measure" not in table:
        raise TurgorError(f"{where}: 'measure' is missing; name one, such as measure = \"bending_angle\".")
    name, scale = str(table["measure"]), numbers.get("scale")
    if kind == "limits":
        tolerance = numbers.get("tolerance", LIMIT_TOLERANCE)
        unit = unit_in(table.get("most", table.get("least")))
        ends = numbers.get("most"), numbers.get("least")
        return Limit(name, most=ends[0], least=ends[1], at=at, scale=scale, tolerance=tolerance, unit=unit)
    if "value" not in numbers:
        raise TurgorError(f"{where}: 'value' is missing; write the wanted one with its unit, such as \"60 deg\".")
    tolerance = numbers.get("tolerance", TARGET_TOLERANCE)
    return Target(name, numbers["value"], at=at, scale=scale, tolerance=tolerance, unit=unit_in(table["value"]))


#: Keys of goals that hold numbers.
_NUMBERS = ("value", "most", "least", "scale", "tolerance")


#: What the lists of a path measure, with an example.
_LISTS = dict.fromkeys(("x", "z"), ("length", "0, -2, -8 mm")) | {"pressure": ("pressure", "0, 10, 20 kPa")}


def _path(table: Table, where: str) -> TipPath:
    """Read a path: lists of numbers with a unit, such as ``x = "0, -2, -8 mm"``."""
    lists = {
        key: numbers_in(table[key], f"{where}.{key}", *_LISTS[key]) for key in table if key != "tolerance"
    }  # fmt: skip
    for key in ("x", "z"):
        if key not in lists:
            raise TurgorError(f"{where}: '{key}' is missing; write numbers and their unit, such as \"0, -2, -8 mm\".")
    if len(lists["x"]) != len(lists["z"]):
        raise TurgorError(f"{where}: x has {len(lists['x'])} numbers and z {len(lists['z'])}; give as many of both.")
    points = list(zip(lists["x"], lists["z"], strict=True))
    at = ("pressure", lists["pressure"]) if "pressure" in lists else None
    tolerance = number_in(table["tolerance"], f"{where}.tolerance") if "tolerance" in table else PATH_TOLERANCE
    return TipPath(points, at=at, tolerance=tolerance)


def _at(given: Any, where: str) -> At:
    """Read where a measure is read, such as ``{ pressure = "30 kPa" }``."""
    if given is None:
        return None
    if not isinstance(given, Mapping) or len(given) != 1:
        raise TurgorError(
            f'{where}.at is {given!r}; write one column and its value, such as {{ pressure = "30 kPa" }}.'
        )
    ((name, value),) = given.items()
    return name, number_in(value, f"{where}.at.{name}")


#: Settings that are no numbers.
_WORDS = ("method", "slopes")


def _made(kind: type[Made], table: Table, where: str) -> Made:
    """Make settings from a table: texts with units are quantities, but words stay words."""
    check_keys(table, [each.name for each in fields(kind)], where)  # type: ignore[arg-type]
    given = {
        key: value if isinstance(value, bool | int) or key in _WORDS else number_in(value, f"{where}.{key}")
        for key, value in table.items()
    }
    return kind(**given)


def _table(content: Table, key: str, path: Path) -> Table:
    given = content.get(key, {})
    if not isinstance(given, Mapping):
        raise TurgorError(f"{path}: '{key}' is {given!r}; it is a table, [{key}].")
    return given


def _list(content: Table, key: str, path: Path) -> Sequence[Table]:
    given = content.get(key, [])
    if not isinstance(given, list) or not all(isinstance(each, Mapping) for each in given):
        raise TurgorError(f"{path}: '{key}' is {given!r}; it is a list of tables, [[{key}]].")
    return given
