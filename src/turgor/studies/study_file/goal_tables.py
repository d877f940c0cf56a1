"""``[[optimize.targets]]`` and the other goals of a study file."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.studies.optimization.goals import (
    Goal,
    Limit,
    Maximize,
    Minimize,
    Target,
    TipPath,
)
from turgor.studies.optimization.row_values import At
from turgor.studies.study_file.numbers import Table, check_keys, number_in, numbers_in, unit_in

#: Keys of each goal, by the name of its list.
GOAL_KEYS = {
    "targets": ("measure", "value", "at", "scale", "tolerance"),
    "paths": ("x", "z", "pressure", "tolerance"),
    "limits": ("measure", "most", "least", "at", "scale", "tolerance"),
    "objectives": ("minimize", "maximize", "at", "scale"),
}


def read_goal(kind: str, table: Table) -> Goal:
    """Read one goal.

    Parameters
    ----------
    kind : str
        ``"targets"``, ``"paths"``, ``"limits"`` or ``"objectives"``.
    table : mapping
        As it stands in the file.

    Returns
    -------
    Goal

    Raises
    ------
    TurgorError
        If a key is unknown, or a value is missing or wrong.

    Examples
    --------
    >>> read_goal("targets", {"measure": "bending_angle", "value": "60 deg"}).unit
    'deg'
    """
    check_keys(table, GOAL_KEYS[kind], kind)
    if kind == "paths":
        return _path(table)
    at = _at(table.get("at"))
    numbers = {key: number_in(table[key], key) for key in table if key in _NUMBERS}
    if kind == "objectives":
        given = [key for key in ("minimize", "maximize") if key in table]
        if len(given) != 1:
            raise TurgorError('an objective needs either minimize or maximize, such as minimize = "solid_volume".')
        kind_of = Minimize if given[0] == "minimize" else Maximize
        return kind_of(str(table[given[0]]), at=at, scale=numbers.get("scale"))
    if "measure" not in table:
        raise TurgorError("'measure' is missing; name one, such as measure = \"bending_angle\".")
    name, scale = str(table["measure"]), numbers.get("scale")
    tolerance = {"tolerance": numbers["tolerance"]} if "tolerance" in numbers else {}
    if kind == "limits":
        unit = unit_in(table.get("most", table.get("least")))
        ends = numbers.get("most"), numbers.get("least")
        return Limit(name, most=ends[0], least=ends[1], at=at, scale=scale, unit=unit, **tolerance)
    if "value" not in numbers:
        raise TurgorError("'value' is missing; write the target with its unit, such as \"60 deg\".")
    return Target(name, numbers["value"], at=at, scale=scale, unit=unit_in(table["value"]), **tolerance)


#: Keys of goals that hold numbers.
_NUMBERS = ("value", "most", "least", "scale", "tolerance")


#: What the lists of a path measure, with an example.
_LISTS = dict.fromkeys(("x", "z"), ("length", "0, -2, -8 mm")) | {"pressure": ("pressure", "0, 10, 20 kPa")}


def _path(table: Table) -> TipPath:
    """Read a path: lists of numbers with a unit, such as ``x = "0, -2, -8 mm"``."""
    lists = {key: numbers_in(table[key], key, *_LISTS[key]) for key in table if key != "tolerance"}
    for key in ("x", "z"):
        if key not in lists:
            raise TurgorError(f"'{key}' is missing; write numbers and their unit, such as \"0, -2, -8 mm\".")
    if len(lists["x"]) != len(lists["z"]):
        raise TurgorError(f"x has {len(lists['x'])} numbers and z {len(lists['z'])}; give as many of both.")
    points = list(zip(lists["x"], lists["z"], strict=True))
    at = ("pressure", lists["pressure"]) if "pressure" in lists else None
    path = TipPath(points, at=at)
    return replace(path, tolerance=number_in(table["tolerance"], "tolerance")) if "tolerance" in table else path


def _at(given: Any) -> At:
    """Read where a measure is read, such as ``{ pressure = "30 kPa" }``."""
    if given is None:
        return None
    if not isinstance(given, Mapping) or len(given) != 1:
        raise TurgorError(f'at is {given!r}; write one column and its value, such as {{ pressure = "30 kPa" }}.')
    ((name, value),) = given.items()
    return name, number_in(value, f"at.{name}")
