"""Tables of a job file: the keys of each, and the types of their values.

The keys of an actuator are the fields of its dataclass, so a new family needs no code here.
"""

from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, fields
from dataclasses import Field as DataclassField
from functools import partial
from types import MappingProxyType
from typing import Annotated, Any, get_args

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, create_model

from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import check_quality, check_target
from turgor.foundation.errors import TurgorError, near_match, unknown
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.units import parse_quantity

#: How tables are checked. What checks one is made when it is first read: a job has few of the tables that there are.
CONFIG = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False, defer_build=True)


@dataclass(frozen=True, slots=True)
class Says:
    """Kind of a value, if its type does not state it.

    Parameters
    ----------
    words : str
        In words, such as ``"three lengths"``.
    example : str
        A value in TOML.
    dimension : str
        Key of `turgor.units.UNITS`, where the value has a unit.
    """

    words: str
    example: str
    dimension: str = ""


Length = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="length"))]
Angle = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="angle"))]
Pressure = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="pressure"))]
Density = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="density"))]
Expansion = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="expansion"))]
BendingStiffness = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="bending stiffness"))]
Acceleration = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="acceleration"))]

#: Type of a float field by the dimension that its dataclass states.
QUANTITIES: Mapping[str, Any] = {
    "length": Length,
    "angle": Angle,
    "pressure": Pressure,
    "density": Density,
    "number": float,
}


def coordinate(value: object, dimension: str = "length") -> float:
    """Read a length, or an angle; zero needs no unit."""
    return 0.0 if value == 0 and not isinstance(value, bool) else parse_quantity(value, dimension)


Coordinate = Annotated[float, BeforeValidator(coordinate)]


def _measure(name: str) -> str:
    from turgor.core.results.measures.measures import find_measure  # here, because it loads the engine

    return find_measure(name).name


def _quality(name: str) -> str:
    check_quality(name)
    return name


def _share(value: object) -> float:
    """Read a share, such as ``"2 %"``."""
    text = value.strip() if isinstance(value, str) else ""
    try:
        share = float(text.removesuffix("%")) / 100 if text.endswith("%") else None
    except ValueError:
        share = None
    if share is None:
        raise TurgorError(f"{value!r} is no share in percent; write it as '2 %'.")
    check_target(share)
    return share


def _lengths(value: object) -> tuple[float, ...]:
    """Read one length or a list of them."""
    return tuple(parse_quantity(each, "length") for each in (value if isinstance(value, list) else [value]))


Lengths = Annotated[
    tuple[float, ...], BeforeValidator(_lengths), Says("a length or a list of lengths", '["0.1 mm", "0.05 mm"]')
]

Share = Annotated[float, BeforeValidator(_share), Says("share in percent", '"2 %"')]


def _mesh_error(value: object) -> bool | str:
    """Read whether the mesh error is estimated, and how."""
    if isinstance(value, bool) or value == "linear":
        return value
    raise TurgorError(f"{value!r} is not true, false or 'linear'.")


MeshErrorWay = Annotated[bool | str, BeforeValidator(_mesh_error), Says("true, false or `linear`", '"linear"')]


class Table(BaseModel):
    """A table whose keys are all known."""

    model_config = CONFIG


_MESH = MeshSettings()


class MeshTable(Table):
    """``[mesh]``: how the actuator is meshed.

    Keys
    ----
    size : float [m]
        Largest edge length aimed at; chosen for the actuator and the quality by default.
    quality : str
        Mesh error that is requested: `draft` 10 %, `normal` 2 %, `fine` 0.5 %. It chooses the size where none is
        stated, and a run reports measures that miss it.
    cells : str
        Kind of the cells; what suits the actuator by default.
    ignore_features_below : float [m]
        Fillets and other rounds of a smaller radius make cells no smaller; by default half the size, where rounds of a
        CAD file would make more unknowns than the rest of it.
    target : float, optional
        Largest mesh error of a measure at the last state, as a share; the mesh is refined until it is met.
    target_measure : str, optional
        Measure that the target is for; the first one of ``[output]`` by default.
    most_unknowns : int
        Largest number of unknowns of a refined mesh.
    imperfection : float or list of float [m]
        Largest deviation of the stress-free shape along the first buckling mode, or along the first modes in turn.
    """

    size: Length | None = Field(default=None, examples=['"3 mm"'])
    quality: Annotated[str, AfterValidator(_quality)] = Field(default=_MESH.quality, examples=['"draft"'])
    grading: float = _MESH.grading
    face_sizes: dict[str, Length] = Field(default_factory=dict, examples=['{ cavity = "1 mm" }'])
    wall_cells: int = _MESH.wall_cells
    cells: str | None = Field(default=_MESH.cells, examples=['"hexahedra"'])
    ignore_features_below: Length | None = Field(default=None, examples=['"1 mm"'])
    target: Share | None = None
    target_measure: Annotated[str, AfterValidator(_measure)] | None = None
    most_unknowns: int = 200_000
    imperfection: Lengths = ()

    @property
    def settings(self) -> MeshSettings:
        """Return the settings of the mesh."""
        return MeshSettings(
            size=self.size,
            quality=self.quality,
            grading=self.grading,
            face_sizes=self.face_sizes,
            wall_cells=self.wall_cells,
            cells=self.cells,
            ignore_features_below=self.ignore_features_below,
        )


class EngineTable(Table):
    """``[engine]``: how the computer works; only the last digits of results depend on it.

    Keys
    ----
    threads : int, optional
        Number of threads; all processors by default.
    """

    threads: int | None = None


class OutputTable(Table):
    """``[output]``: what is measured and written.

    Keys
    ----
    measures : list of str
        Names of the measures in ``response.csv``, in this order; empty for the standard ones.
    markers : table of three lengths each
        Points on or near the surface whose coordinates are written too.
    """

    measures: list[Annotated[str, AfterValidator(_measure)]] = Field(
        default=[], examples=['["bending_angle", "cavity_volume"]']
    )
    markers: dict[str, list[Coordinate]] = Field(default_factory=dict, examples=['{ knuckle = ["20 mm", 0, "15 mm"] }'])
    fields: bool = True
    pictures: bool = True
    report: bool = True
    mesh_error: MeshErrorWay = True


#: Values of ``type`` by the words that others use for them.
MEANT: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("riks", "crisfield", "arclength", "static_riks"), "arc_length"),
        **dict.fromkeys(("newton", "nonlinear", "static_general", "general"), "static"),
        **dict.fromkeys(("transient", "implicit", "explicit", "dynamics"), "dynamic"),
        **dict.fromkeys(("volume", "syringe"), "volume_control"),
        **dict.fromkeys(("force", "tip_force"), "blocked_force"),
        "mckibben": "contracting_tube",
    }
)


def dataclass_table(value: type) -> type[Table]:
    """Make the table of a dataclass: one key per field, and a ``type``.

    A float is a length unless its field says otherwise: ``field(metadata={"dimension": "angle"})``; the dimension
    ``"number"`` takes no unit.
    """
    return table_of(f"{value.__name__}Table", {item.name: (_type_of(item), default_of(item)) for item in fields(value)})


def table_of(name: str, keys: Mapping[str, Any]) -> type[Table]:
    """Make a table of keys, each with its type and default, and of a ``type``."""
    return create_model(name, __base__=Table, **{"type": (str, ...), **keys})


def read_table(table: type[Table], values: object, key: Key, problems: Problems) -> Any | None:
    """Check the values of a table; note every problem and return None if there is any."""
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write {problems.head(key)} and its keys below it.")
        return None
    try:
        return table.model_validate(dict(values))
    except ValidationError as error:
        for item in error.errors(include_url=False):
            # without indices of lists and names of the functions that read
            place = tuple(part for part in item["loc"] if isinstance(part, str) and not part.startswith("function-"))
            problems.add((*key, *place), _sentence(table, place, item))
        return None


def chosen_kind(
    kinds: Mapping[str, Any], what: str, values: Any, key: Key, problems: Problems, others: Iterable[str] = ()
) -> Any | None:
    """Return the kind that the key ``type`` of a table names; ``others`` are names that other functions read."""
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write {problems.head(key)} and its keys below it.")
        return None
    if "type" not in values:
        problems.add((*key, "type"), f"'type' is missing; allowed: {', '.join((*kinds, *others))}.")
        return None
    name = str(values["type"])
    if name not in kinds:
        problems.add((*key, "type"), str(unknown(what, name, (*kinds, *others), MEANT)))
        return None
    return kinds[name]


def fields_of_table(table: Any) -> dict[str, Any]:
    """Return the values of a checked table, without its type."""
    return {name: getattr(table, name) for name in type(table).model_fields if name != "type"}


def shown(value: object) -> str:
    """Write a value in the notation of TOML, for messages."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "a table"
    return repr(value)


_NEEDED = {
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number without a unit",
    "bool_type": "true or false",
    "string_type": "a text in quotes",
    "list_type": "a list in square brackets",
    "model_type": "a table in braces",
    "dict_type": "a table in braces",
    "finite_number": "a finite number",
}


def _sentence(table: type[BaseModel], place: Key, item: Any) -> str:
    """Sentence for an error of pydantic."""
    kind, given = item["type"], item["input"]
    if kind == "extra_forbidden":
        known = list(_model_at(table, place[:-1]).model_fields)
        return f"unknown key '{place[-1]}'{near_match(place[-1], known) or '.'} Known keys: {', '.join(known)}."
    if kind == "missing":
        return f"'{place[-1]}' is missing, and it has no default."
    error = item.get("ctx", {}).get("error")
    if isinstance(error, TurgorError):
        return str(error)
    if kind == "list_type" and isinstance(given, Mapping):
        return f"a table is not a list; its head has double brackets, [[{place[-1]}]] with what stands before it."
    needed = _NEEDED.get(kind)
    return f"{shown(given)} is not {needed}." if needed else f"{shown(given)} is not allowed: {item['msg']}."


def _model_at(table: type[BaseModel], place: Key) -> type[BaseModel]:
    """The table at a key inside another one, or in a mapping of tables."""
    for part in place:
        item = table.model_fields.get(part)
        kinds = _kinds(item.annotation) if item is not None else []
        table = next((kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)), table)
    return table


def _kinds(annotation: Any) -> list[Any]:
    """Types in an annotation."""
    inner = get_args(annotation)
    return [kind for one in inner for kind in _kinds(one)] if inner else [annotation]


def _type_of(item: DataclassField[Any]) -> Any:
    return item.type if item.type is not float else QUANTITIES[item.metadata.get("dimension", "length")]


def default_of(item: DataclassField[Any]) -> Any:
    """Return the default of a field of a dataclass in the form of pydantic."""
    if item.default is not MISSING:
        return item.default
    return item.default_factory() if item.default_factory is not MISSING else ...
