"""Listed loads: those that a job file states as tables ``[[loads.KEY]]``, with the fields of the load as keys.

A file in `turgor.core.model.loads` whose class states a ``job_key`` is all that a new one needs.
"""

import inspect
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, Field, fields
from functools import cache, partial
from types import GenericAlias
from typing import Annotated, Any

import pydantic
from pydantic import BeforeValidator, create_model

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.loads.load import Load
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.registry import Registry, class_of_file
from turgor.job.reference.kinds import kind_of
from turgor.job.reference.meanings import meanings
from turgor.job.text.load_tables import LoadsTable
from turgor.job.text.load_values import OVER_TIME, SHARES, Points, Vector, history_of, history_values, says_three, three
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Says, Table, default_of, shown
from turgor.units import UNITS, format_quantity, parse_quantity

#: Loads by the name of their file: the classes in their folder.
LOADS: Registry[type[Load]] = Registry(
    "turgor.core.model.loads", class_of_file(lambda kind: issubclass(kind, Load) and kind is not Load)
)

#: Units in which lock files state the fields of loads; SI units of other dimensions.
_UNITS: Mapping[str, str] = {"length": "mm", "pressure": "kPa", "mass": "g", "angle": "deg", "share": "%"}

_POINTS = '[["20 °C", 1], ["60 °C", 0.8]]'
_PLACES = '[["0 mm", 0, "5 mm"], ["80 mm", 0, "5 mm"]]'
_TWO_FACES = '["tip", "outside"]'


def listed_kinds() -> dict[str, type]:
    """Return the loads that a job file states as lists of tables, by the key below ``[loads]``.

    Examples
    --------
    >>> listed_kinds()["point_forces"].__name__
    'PointForce'
    """
    return {kind.job_key: kind for kind in LOADS.values() if kind.job_key}


@cache
def listed_table(kind: type) -> type[Table]:
    """Make the table of a load: a key for each field, and ``history_over_time``.

    A field states its dimension, and its key where that is not its name:
    ``field(metadata={"dimension": "force", "key": "force"})``.
    """
    load: Any = kind
    texts = meanings(load)
    keys: dict[str, Any] = {_key(item): (_type_of(item), _default_of(item)) for item in _stated(kind)}
    keys |= {"history": (Points, None), "history_over_time": (Points, None)}
    lines = [f"{_key(item)} : value\n    {texts.get(item.name, '')}" for item in _stated(kind)]
    lines += [f"history : value\n    {SHARES}", f"history_over_time : value\n    {OVER_TIME}"]
    doc = f"``[[loads.{load.job_key}]]``: {_first_line(kind)}\n\nKeys\n----\n" + "\n".join(lines)
    return create_model(f"{kind.__name__}Table", __base__=Table, __doc__=doc, **keys)


def loads_model() -> type[LoadsTable]:
    """Return the table ``[loads]`` with a list of tables for each listed load."""
    return _loads_model(tuple(listed_kinds().items()))


@cache
def _loads_model(kinds: tuple[tuple[str, type], ...]) -> type[LoadsTable]:
    tables: dict[str, Any] = {key: listed_table(kind) for key, kind in kinds}
    keys: dict[str, Any] = {
        key: (GenericAlias(list, table), pydantic.Field([], examples=[_example(table)]))
        for key, table in tables.items()
    }
    lines = [f"    {key} : list of tables\n        {_first_line(kind)}" for key, kind in kinds]
    doc = "\n".join([(LoadsTable.__doc__ or "").rstrip(), *lines, ""])
    return create_model("LoadsTable", __base__=LoadsTable, __doc__=doc, **keys)


def _example(table: type[Table]) -> str:
    """A list of one table with the keys that have no default, in TOML."""
    needed = {key: item for key, item in table.model_fields.items() if item.is_required()}
    values = [f"{key} = {(item.examples or [kind_of(item).example])[0]}" for key, item in needed.items()]
    return f"[{{ {', '.join(values)} }}]"


def read_listed(
    table: Any,
    geometry: Geometry | None,
    duration: float | None,
    problems: Problems,
    windings: Iterable[str] = (),
) -> list[Load]:
    """Return the loads of the tables in ``[loads]``.

    Parameters
    ----------
    table : Table
        ``[loads]``, checked.
    geometry : Geometry or None
        The actuator; None where it could not be built.
    duration : float or None [s]
        Of the procedure.
    problems : Problems
        Takes what is wrong.
    windings : iterable of str
        Names of windings, which may have states.
    """
    loads: list[Load] = []
    for name, kind in listed_kinds().items():
        key = ("loads", name)
        for each in getattr(table, name):
            load = problems.attempt(key, partial(_load_of, kind, each, duration))
            if load is not None and fits(load, geometry, key, problems, windings=windings):
                loads.append(load)
    return loads


def fits(
    load: Load,
    geometry: Geometry | None,
    key: tuple[str, ...],
    problems: Problems,
    points: Iterable[str] = (),
    windings: Iterable[str] = (),
) -> bool:
    """Return whether an actuator has the faces of a load, and every image of its modeled part has the load.

    Parameters
    ----------
    load : Load
    geometry : Geometry or None
        The actuator; None where it could not be built.
    key : tuple of str
        Where the load stands.
    problems : Problems
        Takes what is wrong.
    points : iterable of str
        Names of reference points, on which a load may act as on a face.
    windings : iterable of str
        Names of windings, which may have a state as a body has.
    """
    if geometry is None:
        return True
    faces = geometry.faces
    wrong = [str(unknown("face", name, faces)) for name in load.named_faces if name not in (*faces, *points)]
    if load.of_bodies and load.place not in (*geometry.regions, *faces, *windings):
        wrong.append(str(unknown(f"body of a {load.kind}", load.place, (*geometry.regions, *windings))))
    for number, axis in enumerate("xyz"):
        if f"symmetry_{axis}" in geometry.faces and not load.mirrored(number):
            wrong.append(
                f"the {load.kind} has no mirror image in a half model, whose mirror plane is normal to {axis}; "
                "model the whole (actuator.symmetric = false, where the family has this key)."
            )
    wedge = geometry.wedge
    if wedge is not None and not load.turned("xyz".index(wedge.axis)):
        wrong.append(
            f"the {load.kind} is not the same in all sectors of the wedge about {wedge.axis}; set actuator.symmetry "
            '= "none".'
        )
    for sentence in wrong:
        problems.add(key, sentence)
    return not wrong


def listed_values(loads: Iterable[Load]) -> dict[str, list[dict[str, Any]]]:
    """Write loads as keys of ``[loads]``; `read_listed` gives the same ones back."""
    values: dict[str, list[dict[str, Any]]] = {}
    for load in loads:
        if load.job_key:
            values.setdefault(load.job_key, []).append(_written(load))
    return values


def _load_of(kind: Any, table: Any, duration: float | None) -> Any:
    given = {item.name: getattr(table, _key(item)) for item in _stated(kind)}
    return kind(**given, history=history_of(table, _words(kind), duration, _usual(kind)))


def _usual(kind: type) -> Any:
    """The history of a load that states none."""
    return next(item.default for item in fields(kind) if item.name == "history")


def _words(kind: Any) -> str:
    return str(kind.job_key).replace("_", " ")


def _first_line(kind: Any) -> str:
    return (inspect.getdoc(kind) or "").splitlines()[0]


def _stated(kind: Any) -> list[Field[Any]]:
    """Fields that are keys; a shape is that of a state, which a job file does not know."""
    return [item for item in fields(kind) if item.name not in ("history", "shape")]


def _key(item: Field[Any]) -> str:
    return str(item.metadata.get("key", item.name))


def _type_of(item: Field[Any]) -> Any:
    dimension = item.metadata.get("dimension", "")
    if item.metadata.get("table"):
        return Annotated[Any, Says("text or table", item.metadata["example"])]
    if item.metadata.get("points"):
        read = BeforeValidator(partial(_points, dimension=dimension))
        return Annotated[Any, read, Says("text or list of points", _POINTS)]
    if item.type == tuple[Vector, ...]:
        return Annotated[
            list[Annotated[list[Coordinate], pydantic.Field(min_length=3, max_length=3)]],
            Says("list of points", _PLACES),
        ]
    if item.type == Vector and dimension in ("", "length"):
        return list[Coordinate] if dimension else list[float]
    if item.type == Vector:
        return Annotated[Any, three(dimension), says_three(dimension)]
    if item.type == tuple[str, str]:
        return Annotated[
            list[str],
            pydantic.Field(min_length=2, max_length=2),
            Says("two texts", item.metadata.get("example", _TWO_FACES)),
        ]
    return Annotated[float, BeforeValidator(partial(parse_quantity, dimension=dimension))] if dimension else item.type


def _points(value: object, dimension: str) -> object:
    """A word, or points (quantity, number)."""
    if not isinstance(value, list):
        return value
    if not all(isinstance(pair, list) and len(pair) == 2 for pair in value):
        raise TurgorError(f"{shown(value)} is no list of points; write {_POINTS}.")
    return tuple((parse_quantity(first, dimension), second) for first, second in value)


def _default_of(item: Field[Any]) -> Any:
    """Default of a key, with the length of a list and an example of it."""
    examples = {"length": '["20 mm", 0, "15 mm"]', "": "[0, 0, 1]"}
    example = examples.get(item.metadata.get("dimension", ""))
    if item.type != Vector or example is None:
        return default_of(item)
    return pydantic.Field(default_of(item), min_length=3, max_length=3, examples=[example])


def _written(load: Any) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for item in _stated(type(load)):
        value = getattr(load, item.name)
        if value != item.default or item.default is MISSING:
            values[_key(item)] = _shown(value, item.metadata.get("dimension", ""), item.metadata.get("points", False))
    return values | history_values(load.history, _usual(type(load)))


def _shown(value: Any, dimension: str, points: bool = False) -> Any:
    if isinstance(value, str):
        return value
    if hasattr(value, "table"):
        return value.table()
    if points:
        return [[_shown(first, dimension), second] for first, second in value]
    if isinstance(value, tuple):
        return [_shown(part, dimension) for part in value]
    unit = _UNITS.get(dimension) or next(iter(UNITS.get(dimension, ())), None)
    return value if unit is None else format_quantity(value, unit)
