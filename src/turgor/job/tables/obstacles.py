"""Obstacles in a job: one table ``[obstacles.NAME]`` for each rigid body, both ways."""

from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields, is_dataclass
from dataclasses import Field as DataclassField
from functools import cache, partial
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, create_model

from turgor.core.geometry.directions import DIRECTIONS
from turgor.core.geometry.geometry import Geometry
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import Obstacle, RigidShape, Vector
from turgor.core.model.obstacles.rigid_shape import dimension_of
from turgor.core.model.rigid import RigidFile
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.registry import Registry, class_of_file, name_in
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Length, Says, Table, coordinate, read_table, shown
from turgor.units import UNITS, format_quantity, parse_quantity

#: Shapes by the name of their file, except those from STL files; their fields are their keys.
SHAPES: Registry[type[RigidShape]] = Registry(
    "turgor.core.model.obstacles",
    class_of_file(lambda kind: is_dataclass(kind) and issubclass(kind, RigidShape) and kind.in_job_files),
)

#: The shape that comes from an STL file.
STL = "stl"


def _lengths(value: object) -> Vector:
    if not isinstance(value, list) or len(value) != 3:
        raise TurgorError(f"{shown(value)} is not three lengths along x, y and z, such as [0, 0, '-2 mm'].")
    x, y, z = (coordinate(part) for part in value)
    return x, y, z


def _direction(value: object) -> Vector:
    if isinstance(value, str):
        signed = value if value.startswith(("+", "-")) else f"+{value}"
        if signed not in DIRECTIONS:
            raise unknown("direction", value, DIRECTIONS)
        return DIRECTIONS[signed]
    if not isinstance(value, list) or len(value) != 3 or any(type(part) not in (int, float) for part in value):
        raise TurgorError(f"{shown(value)} is not a direction; write '+z', or three numbers such as [0, 0, 1].")
    x, y, z = (float(part) for part in value)
    return x, y, z


def _angles(value: object) -> Vector:
    if not isinstance(value, list) or len(value) != 3:
        raise TurgorError(f"{shown(value)} is not a rotation about x, y and z, such as [0, 0, '90 deg'].")
    x, y, z = (coordinate(part, "angle") for part in value)
    return x, y, z


def _way(value: object, read: Callable[[object], Vector], example: str) -> tuple[tuple[float, Vector], ...]:
    points: list[Any] = value if isinstance(value, list) else [value]
    for point in points:
        if not isinstance(point, list) or len(point) != 2 or type(point[0]) not in (int, float):
            raise TurgorError(
                f"{shown(point)} is no point of a path; write [load factor, [x, y, z]], such as "
                f"[[0, [0, 0, 0]], [1, [0, 0, '{example}']]]."
            )
    return tuple((float(factor), read(place)) for factor, place in points)


Lengths = Annotated[Any, BeforeValidator(_lengths), Says("three lengths", '[0, 0, "-2 mm"]', "length")]
Direction = Annotated[Any, BeforeValidator(_direction), Says("direction or three numbers", '"+z"')]
Way = Annotated[
    Any,
    BeforeValidator(partial(_way, read=_lengths, example="5 mm")),
    Says("list of points [load factor, three lengths]", '[[0, [0, 0, 0]], [1, [0, 0, "5 mm"]]]', "length"),
]
Turns = Annotated[
    Any,
    BeforeValidator(partial(_way, read=_angles, example="90 deg")),
    Says("list of points [load factor, three angles]", '[[0, [0, 0, 0]], [1, [0, 0, "90 deg"]]]', "angle"),
]
Angles = Annotated[Any, BeforeValidator(_angles), Says("three angles", '[0, 0, "90 deg"]', "angle")]
SpringStiffness = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="spring stiffness"))]
ContactStiffness = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="contact stiffness"))]


class ObstacleTable(Table):
    """``[obstacles.NAME]``: the keys that all rigid bodies have.

    Keys
    ----
    shape : str
        Shape; its dimensions are further keys.
    """

    shape: str
    friction: float = 0.0
    path: Way = ()
    rotation: Turns = ()
    about: Lengths | None = None
    spring: SpringStiffness | None = None
    face: str | None = None
    stiffness: ContactStiffness | None = None
    elastic_slip: Length | None = None


class StlTable(ObstacleTable):
    """``[obstacles.NAME]`` from an STL file.

    Keys
    ----
    file : str
        STL file; its path counts from the folder of the job file.
    """

    file: str = Field(examples=['"cup.stl"'])
    unit: str = "mm"
    sha256: str = ""


@cache
def obstacle_table(shape: str) -> type[ObstacleTable]:
    """Make the table of a shape: its fields, and the keys that all have.

    Parameters
    ----------
    shape : str
        One of `SHAPES`, or `STL`.

    Returns
    -------
    type of ObstacleTable
    """
    if shape == STL:
        return StlTable
    kind: Any = SHAPES[shape]
    keys: dict[str, Any] = {item.name: (_type_of(item), _default_of(item)) for item in fields(kind)}
    return create_model(f"{shape.title()}Table", __base__=ObstacleTable, **keys)


def _type_of(item: DataclassField[Any]) -> Any:
    dimension = dimension_of(item)
    if item.type == Vector:
        return Lengths if dimension == "length" else Direction
    if dimension != "length":
        return Annotated[float, BeforeValidator(partial(parse_quantity, dimension=dimension))]
    return Coordinate if item.type is float else Length | None


def _default_of(item: DataclassField[Any]) -> Any:
    return ... if item.default is MISSING else item.default


def read_obstacles(
    values: Any, geometry: Geometry | None, problems: Problems
) -> tuple[list[Obstacle], dict[str, RigidFile]]:
    """Read ``[obstacles]``, a table for each rigid body; return the bodies, and the STL files of some of them.

    Parameters
    ----------
    values : mapping
        The table.
    geometry : Geometry or None
        The actuator, whose faces are known; None where it could not be built.
    problems : Problems
        Takes what is wrong.

    Returns
    -------
    obstacles : list of Obstacle
    files : dict of str to RigidFile
    """
    key = ("obstacles",)
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [obstacles.plate] and the keys of a plate below it.")
        return [], {}
    flat = [name for name, entry in values.items() if not isinstance(entry, Mapping)]
    if flat:
        problems.add((*key, flat[0]), "an obstacle needs a name of its own; write [obstacles.plate] and keys below it.")
        return [], {}
    obstacles, files = [], {}
    for name, entry in values.items():
        table = _read_obstacle(entry, (*key, name), geometry, problems)
        if table is None:
            continue
        if isinstance(table, StlTable):
            files[name] = _file(table, (*key, name), problems)
        obstacle = _obstacle(table, files.get(name), (*key, name), problems)
        if obstacle is not None:
            obstacles.append(obstacle)
    return obstacles, {name: file for name, file in files.items() if file is not None}


def _read_obstacle(values: Any, key: Key, geometry: Geometry | None, problems: Problems) -> ObstacleTable | None:
    if "shape" not in values:
        problems.add((*key, "shape"), f"'shape' is missing; allowed: {', '.join((*SHAPES, STL))}.")
        return None
    shape = str(values["shape"])
    if shape not in (*SHAPES, STL):
        problems.add((*key, "shape"), str(unknown("shape", shape, (*SHAPES, STL))))
        return None
    if key[-1] == SELF:
        problems.add(key, f"the name '{SELF}' is that of the results of self-contact; take another one.")
        return None
    table: ObstacleTable | None = read_table(obstacle_table(shape), values, key, problems)
    if table is not None and table.face is not None and geometry is not None and table.face not in geometry.faces:
        problems.add((*key, "face"), str(unknown("face", table.face, geometry.faces)))
        return None
    return table


def _file(table: StlTable, key: Key, problems: Problems) -> RigidFile | None:
    """STL file of a body; its path is relative to the folder of the job file."""
    file = Path(problems.file).parent / table.file
    where = (*key, "file") if not file.is_file() else key
    make = partial(RigidFile, file=file.resolve(), unit=table.unit, sha256=table.sha256)
    return problems.attempt(where, make, fields=("sha256",))


def _obstacle(table: ObstacleTable, file: RigidFile | None, key: Key, problems: Problems) -> Obstacle | None:
    keys = type(table).model_fields
    shape: RigidShape | None
    if isinstance(table, StlTable):
        shape = None if file is None else problems.attempt(key, file.read, fields=("unit",))
    else:
        kind: Any = SHAPES[table.shape]
        dimensions = {item.name: getattr(table, item.name) for item in fields(kind)}
        shape = problems.attempt(key, partial(kind, **dimensions), fields=keys)
    if shape is None:
        return None
    common = {name: getattr(table, name) for name in ObstacleTable.model_fields if name != "shape"}
    return problems.attempt(key, partial(Obstacle, name=key[-1], shape=shape, **common), fields=keys)


def obstacles_tables(contact: Contact, files: Mapping[str, RigidFile]) -> dict[str, Any]:
    """Write obstacles as tables of a job file; `read_obstacles` gives the same ones back.

    Parameters
    ----------
    contact : Contact
    files : mapping of str to RigidFile
        The files of the obstacles that come from one.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If a body of triangles has no file.
    """
    return {obstacle.name: _written(obstacle, files.get(obstacle.name)) for obstacle in contact.obstacles}


def _written(obstacle: Obstacle, file: RigidFile | None) -> dict[str, Any]:
    values = _shape_values(obstacle, file)
    values["friction"] = obstacle.friction
    if obstacle.path:
        values["path"] = [[factor, _shown(place)] for factor, place in obstacle.path]
    if obstacle.rotation:
        values["rotation"] = [[factor, _shown(turn, "angle")] for factor, turn in obstacle.rotation]
    if obstacle.about is not None:
        values["about"] = _shown(obstacle.about)
    if obstacle.spring is not None:
        values["spring"] = format_quantity(obstacle.spring, "N/m")
    if obstacle.face is not None:
        values["face"] = obstacle.face
    if obstacle.stiffness is not None:
        values["stiffness"] = format_quantity(obstacle.stiffness, "MPa/mm")
    if obstacle.elastic_slip is not None:
        values["elastic_slip"] = format_quantity(obstacle.elastic_slip, "mm")
    return values


def _shape_values(obstacle: Obstacle, file: RigidFile | None) -> dict[str, Any]:
    shape: Any = obstacle.shape
    if file is not None:
        return {"shape": STL, "file": Path(file.file).as_posix(), "unit": file.unit, "sha256": file.sha256}
    name = name_in(SHAPES, shape)
    if name is None:
        own = f"the shape {type(shape).__name__} has no form in a job file."
        lost = "triangles without a file have no form in a job file; name their STL file."
        raise TurgorError(f"obstacle '{obstacle.name}': {own if shape.in_job_files else lost}")
    values: dict[str, Any] = {"shape": name}
    for item in fields(shape):
        value = getattr(shape, item.name)
        if value is not None:
            values[item.name] = _shown(value, dimension_of(item))
    return values


def _shown(value: Any, dimension: str = "length") -> Any:
    if isinstance(value, tuple):
        return [_shown(part, dimension) for part in value]
    unit = "mm" if dimension == "length" else next(iter(UNITS.get(dimension, ())), "")
    return format_quantity(value, unit) if unit else value
