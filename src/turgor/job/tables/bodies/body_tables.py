"""Bodies of a job: ``[bodies.NAME]``, the parts of a hand, an arm or a gripper with what it holds, both ways."""

from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from types import MappingProxyType
from typing import Any

from pydantic import Field, create_model

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.solids import Ball, Block, RoundBar
from turgor.core.meshing.bodies.assembly import Assembly, PlacedBody
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.foundation.errors import near_match
from turgor.job.job import ACTUATORS, Actuator
from turgor.job.tables.cad import CAD_FILE, read_cad_file
from turgor.job.tables.mesh_files import MESH_FILE, read_mesh_file
from turgor.job.tables.obstacles import Angles, Lengths
from turgor.job.text.lines import Key
from turgor.job.text.listed_loads import loads_model
from turgor.job.text.load_tables import Mass
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import (
    Length,
    MeshTable,
    Table,
    chosen_kind,
    dataclass_table,
    fields_of_table,
    read_table,
    shown,
)
from turgor.units import format_quantity

#: The type of an actuator that consists of the tables ``[bodies.NAME]``.
ASSEMBLY = "assembly"

#: Plain solids by their names in job files.
SOLIDS: Mapping[str, type[Any]] = MappingProxyType({"ball": Ball, "block": Block, "round_bar": RoundBar})

#: Keys of ``[mesh]`` that act on what is meshed already.
LATER = ("imperfection", "target", "target_measure", "most_unknowns")


class BodyTable(Table):
    """``[bodies.NAME]``: one of several bodies. Its type and dimensions are those of an actuator or a plain solid.

    The name of the body is appended to those of its regions and faces: ``cavity_NAME``, ``tip_NAME``.

    Keys
    ----
    type : str
        A family of actuators; ``"ball"``, ``"block"`` or ``"round_bar"``; ``"cad_file"`` or ``"mesh_file"``.
    like : str
        Another body, whose keys are taken where none are stated here.
    """

    type: str = Field(examples=['"fast_pneunet"'])
    like: str | None = Field(default=None, examples=['"finger"'])
    origin: Lengths = Field(default=(0.0, 0.0, 0.0), examples=['["10 mm", 0, 0]'])
    rotation: Angles = Field(default=(0.0, 0.0, 0.0), examples=['[0, 0, "90 deg"]'])
    size: Length | None = Field(default=None, examples=['"3 mm"'])
    copies: int = Field(default=1, examples=["3"])
    around: str | None = Field(default=None, examples=['"z"'])
    step: Lengths | None = Field(default=None, examples=['["50 mm", 0, 0]'])
    on: str | None = Field(default=None, examples=['"palm.top"'])
    mass: Mass | None = Field(default=None, examples=['"50 g"'])


#: Keys of a body besides its part.
_PLACING = tuple(name for name in BodyTable.model_fields if name not in ("type", "like"))


@cache
def _table_of(kind: type) -> type[Table]:
    """Table of a body of a kind: its dimensions, and the keys of all bodies."""
    return create_model(f"{kind.__name__}Body", __base__=(BodyTable, dataclass_table(kind)))


def read_part(values: Any, problems: Problems, key: Key) -> Actuator | None:
    """Read a part with its type and dimensions, without the keys of a body."""
    if isinstance(values, Mapping) and values.get("type") == CAD_FILE:
        return read_cad_file(values, problems, key)
    if isinstance(values, Mapping) and values.get("type") == MESH_FILE:
        return read_mesh_file(values, problems, key)
    family = chosen_kind(ACTUATORS, "actuator type", values, key, problems, (CAD_FILE, MESH_FILE))
    table = read_table(dataclass_table(family), values, key, problems) if family else None
    return None if family is None or table is None else _made(family, table, key, problems)


def _made(family: Any, table: Any, key: Key, problems: Problems) -> Actuator | None:
    names = [item.name for item in fields(family)]
    values = {name: value for name, value in fields_of_table(table).items() if name in names}
    result: Actuator | None = problems.attempt(key, lambda: family(**values), fields=names)
    return result


def read_bodies(values: Any, mesh: Any, problems: Problems) -> Assembly | None:
    """Read ``[bodies]``, a table for each body, and the settings of their mesh.

    Parameters
    ----------
    values : object
    mesh : object
        Keys of ``[mesh]`` that say how bodies are meshed.
    problems : Problems
        Takes what is wrong.

    Returns
    -------
    Assembly or None
        None where something is wrong.
    """
    key = ("bodies",)
    if not isinstance(values, Mapping) or not all(isinstance(each, Mapping) for each in values.values()):
        problems.add(key, f"{shown(values)} is no table of bodies; write [bodies.finger] and its keys below it.")
        return None
    for name in values:
        if name in loads_model().model_fields:
            problems.add((*key, name), f"'{name}' is a key of [loads]; give the body another name.")
    settings: MeshTable | None = read_table(MeshTable, mesh, ("mesh",), problems)
    read = {name: _read_body(_with_like(name, values, problems), (*key, name), problems) for name in values}
    bodies = {name: body for name, body in read.items() if body is not None}
    if settings is None or len(bodies) < len(values):
        return None
    return problems.attempt(key, lambda: Assembly(bodies=bodies, mesh=settings.settings))


def _with_like(name: str, bodies: Mapping[str, Any], problems: Problems) -> Mapping[str, Any]:
    """Keys of a body, with those of the body that it is like."""
    other = bodies[name].get("like")
    if other is None:
        return dict(bodies[name])
    rest = [each for each in bodies if each != name and "like" not in bodies[each]]
    if other not in rest:
        problems.add(
            ("bodies", name, "like"),
            f"{shown(other)} is no body that it can be like{near_match(str(other), rest) or '.'} "
            f"Allowed: {', '.join(rest) or 'none'}.",
        )
        return dict(bodies[name])
    return {**bodies[other], **bodies[name]}


def _read_body(values: Mapping[str, Any], key: Key, problems: Problems) -> PlacedBody | None:
    part, placing = _read_keys(values, key, problems)
    if part is None or placing is None:
        return None
    stated = {name: getattr(placing, name) for name in _PLACING}
    return problems.attempt(key, lambda: PlacedBody(part=part, **stated), fields=_PLACING)


def _read_keys(values: Mapping[str, Any], key: Key, problems: Problems) -> tuple[Actuator | None, Any]:
    """Part of a body, and the table with the keys of all bodies."""
    if values.get("type") in (CAD_FILE, MESH_FILE):
        own = {name: value for name, value in values.items() if name in BodyTable.model_fields}
        rest = {name: value for name, value in values.items() if name not in own or name == "type"}
        return read_part(rest, problems, key), read_table(BodyTable, own, key, problems)
    kinds = {**dict(ACTUATORS), **SOLIDS}
    family = chosen_kind(kinds, "type of a body", values, key, problems, (CAD_FILE, MESH_FILE))
    table = None if family is None else read_table(_table_of(family), values, key, problems)
    return (None, None) if table is None else (_made(family, table, key, problems), table)


def bodies_tables(assembly: Assembly, part_table: Any) -> dict[str, dict[str, Any]]:
    """Write bodies as the tables of a job file; `read_bodies` gives the same back.

    Parameters
    ----------
    assembly : Assembly
    part_table : callable
        ``part_table(part)``, the dimensions of a part as keys of a job file.

    Returns
    -------
    dict
    """
    return {name: {"type": type_of(body.part)} | part_table(body.part) | _placing(body)
            for name, body in assembly.bodies.items()}  # fmt: skip


def type_of(part: Any) -> str:
    """Return the name of the type of a part in job files.

    Examples
    --------
    >>> from turgor.core.geometry.solids import Block
    >>> type_of(Block())
    'block'
    """
    if isinstance(part, CadFile):
        return CAD_FILE
    if isinstance(part, MeshFile):
        return MESH_FILE
    return next(name for name, kind in {**SOLIDS, **dict(ACTUATORS)}.items() if kind is type(part))


def _placing(body: PlacedBody) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, unit in (("origin", "mm"), ("rotation", "deg"), ("step", "mm")):
        vector = getattr(body, name)
        if vector is not None and (any(vector) or name == "step"):
            values[name] = [format_quantity(part, unit) for part in vector]
    for name, unit in (("size", "mm"), ("mass", "g")):
        if getattr(body, name) is not None:
            values[name] = format_quantity(getattr(body, name), unit)
    for name in ("around", "on"):
        if getattr(body, name) is not None:
            values[name] = getattr(body, name)
    return values | ({"copies": body.copies} if body.copies > 1 else {})
