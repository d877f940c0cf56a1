"""``[optimize]`` of a study file: goals, a workspace, rules of casting, and how the search goes."""

from collections.abc import Mapping
from dataclasses import fields
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from turgor.foundation.errors import TurgorError, unknown
from turgor.job.text.problems import Problems
from turgor.studies.optimization.goals import Goal
from turgor.studies.optimization.job_optimization import OptimizationPlan
from turgor.studies.optimization.manufacture import Casting
from turgor.studies.optimization.search import Search
from turgor.studies.study_file.goal_tables import GOAL_KEYS, read_goal
from turgor.studies.study_file.job_base import JobBase
from turgor.studies.study_file.numbers import Table, check_keys, number_in, numbers_in

Made = TypeVar("Made")

#: The table of an optimization.
OPTIMIZE = ("optimize",)

#: Tables within it, and settings of the search, which stand in it.
TABLES = ("workspace", "casting")
SETTINGS = tuple(each.name for each in fields(Search))

#: Settings that are no numbers.
WORDS = ("method", "slopes")


def read_optimize(
    given: Any, factors: Mapping[tuple[str, ...], Any], base: JobBase, folder: Path, problems: Problems
) -> OptimizationPlan | None:
    """Read ``[optimize]``.

    Parameters
    ----------
    given : mapping
        The table.
    factors : mapping of tuple of str to value
        ``[factors]`` by the parts of their keys.
    base : JobBase
    folder : Path
        Not used; readers of all tables have it.
    problems : Problems

    Returns
    -------
    OptimizationPlan or None
        None if there is any problem.
    """
    if not isinstance(given, Mapping):
        problems.add(OPTIMIZE, f"{given!r} is not a table; write [optimize] and its keys below it.")
        return None
    for key in given:
        if key not in (*GOAL_KEYS, *TABLES, *SETTINGS):
            problems.add((*OPTIMIZE, key), str(unknown("key", key, (*GOAL_KEYS, *TABLES, *SETTINGS))))
    ranges = [problems.attempt(("factors", *place), partial(base.range, ".".join(place), value))
              for place, value in factors.items()]  # fmt: skip
    if not ranges:
        problems.add(("factors",), "nothing varies; write [factors] with a key of the job and its range.")
    goals = _goals(given, problems)
    search = problems.attempt(OPTIMIZE, partial(_search, given))
    casting = None
    if "casting" in given:
        casting = problems.attempt((*OPTIMIZE, "casting"), partial(_settings, Casting, given["casting"]))
    workspace = problems.attempt((*OPTIMIZE, "workspace"), partial(_workspace, given.get("workspace", {})))
    if problems.entries or search is None or workspace is None:
        return None
    known = [each for each in ranges if each is not None]
    return OptimizationPlan(
        factors=tuple(factor for factor, _ in known), start={factor.name: start for factor, start in known},
        goals=goals, workspace=workspace, casting=casting, search=search,
    )  # fmt: skip


def _goals(given: Table, problems: Problems) -> tuple[Goal, ...]:
    goals: list[Goal] = []
    for kind in GOAL_KEYS:
        tables = given.get(kind, [])
        if not isinstance(tables, list) or not all(isinstance(each, Mapping) for each in tables):
            problems.add((*OPTIMIZE, kind), f"{tables!r} is not a list of tables, [[optimize.{kind}]].")
            continue
        for number, table in enumerate(tables, start=1):
            goal = problems.attempt((*OPTIMIZE, kind, str(number)), partial(read_goal, kind, table))
            goals += [] if goal is None else [goal]
    return tuple(goals)


def _search(given: Table) -> Search:
    return _settings(Search, {key: value for key, value in given.items() if key in SETTINGS})


def _workspace(given: Any) -> dict[str, tuple[float, ...]]:
    """Read the pressures [Pa] of each cavity, such as ``{"cavity_1": "0, 10, 20 kPa"}``."""
    if not isinstance(given, Mapping):
        raise TurgorError(f"{given!r} is not a table, [optimize.workspace].")
    return {name: tuple(numbers_in(text, name, "pressure", "0, 10, 20 kPa")) for name, text in given.items()}


def _settings(kind: type[Made], table: Any) -> Made:
    """Make settings from a table: texts with units are quantities, but words stay words."""
    if not isinstance(table, Mapping):
        raise TurgorError(f"{table!r} is not a table.")
    check_keys(table, [each.name for each in fields(kind)], kind.__name__.lower())  # type: ignore[arg-type]
    given = {
        key: value if isinstance(value, bool | int) or key in WORDS else number_in(value, key)
        for key, value in table.items()
    }
    return kind(**given)
