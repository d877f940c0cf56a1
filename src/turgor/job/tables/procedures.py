"""Procedures in a job: reading and writing of ``[procedure]``, also within a stage."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import Field
from functools import partial
from typing import Annotated, Any, get_args, get_origin

from pydantic import BeforeValidator

from turgor.core.model.loads import Load
from turgor.core.solvers.procedures.listed import PROCEDURES as PROCEDURES
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.step_options import fields_in_order
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.registry import name_in
from turgor.job.tables.loads import only_pressure, requested_factors
from turgor.job.text.load_values import says_three, three
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import (
    Says,
    Table,
    chosen_kind,
    default_of,
    fields_of_table,
    read_table,
    shown,
    table_of,
)
from turgor.units import format_quantity, kPa, parse_quantity

#: Units in which lock files state the fields of a procedure.
_UNITS = {
    "volume": "mL",
    "pressure": "kPa",
    "length": "mm",
    "time": "s",
    "speed": "m/s",
    "rate": "1/s",
    "rotational stiffness": "N m/rad",
    "angle": "deg",
    "spring stiffness": "N/mm",
}


def read_procedure(
    values: Any, loads: tuple[Load, ...], problems: Problems, others: Iterable[str] = ()
) -> Procedure | None:
    """Read ``[procedure]``, or that of a stage; requested pressures become load factors.

    ``others`` are further names for the message about an unknown one.
    """
    key = ("procedure",)
    kind = chosen_kind(PROCEDURES, "procedure", values, key, problems, others)
    table = read_table(procedure_table(kind), values, key, problems) if kind else None
    if kind is None or table is None:
        return None
    given = fields_of_table(table)
    why = "in a stage the pressure goes from what it was to its new value" if problems.within else ""
    if not states_requested(given["at"], why, problems):
        return None
    given["at"] = tuple(requested_factors(given["at"], loads, problems))
    procedure: Procedure | None = problems.attempt(key, lambda: kind(**given), fields=given)
    return procedure


def states_requested(at: Sequence[Any], why: str, problems: Problems) -> bool:
    """Return whether requested states are clear; if there is a reason against pressures, note those among them."""
    if why and any(isinstance(value, tuple) for value in at):
        problems.add(("procedure", "at"), f"a pressure does not say which state is meant: {why}; request load factors.")
        return False
    return True


def drives(values: Any) -> bool:
    """Return whether ``[procedure]`` drives the actuator without a load: by a value for each cavity, or a velocity."""
    kind = PROCEDURES.get(str(values.get("type"))) if isinstance(values, Mapping) else None
    thrown = isinstance(values, Mapping) and "velocity" in values
    return kind is not None and (thrown or any(_by_cavity(item) for item in procedure_fields(kind)))


def duration_of(values: Any) -> float | None:
    """Return the duration of ``[procedure]`` [s]; None without one, or if `read_procedure` will reject it."""
    try:
        return parse_quantity(values["duration"], "time")
    except (TurgorError, TypeError, KeyError):
        return None


def procedure_table(value: type) -> type[Table]:
    """Make the table of a procedure: one key per field, and ``at`` as pressures or load factors.

    Fields are numbers without a unit, unless they state a dimension: ``field(metadata={"dimension": "volume"})``. Such
    a field may be a table with one value for each cavity. The dimension ``"names"`` takes a name or a list of names.
    """
    return table_of(f"{value.__name__}Table", field_keys(procedure_fields(value)))


def field_keys(items: Iterable[Field[Any]]) -> dict[str, Any]:
    """Return the keys of a table for fields: type and default of each."""
    keys: dict[str, Any] = {item.name: (_step_type(item), default_of(item)) for item in items}
    if "at" in keys:
        keys["at"] = (list[_STATE], [])
    return keys


def procedure_fields(value: type) -> list[Field[Any]]:
    """Return the fields of a procedure for job files: all but functions, ``field(metadata={"job": False})``."""
    return [item for item in fields_in_order(value) if item.init and item.metadata.get("job", True)]


def written_procedure(procedure: Procedure, loads: tuple[Load, ...] = ()) -> dict[str, Any]:
    """Write a procedure as the table of a job file; `read_procedure` gives the same one back.

    Parameters
    ----------
    procedure : Procedure
    loads : tuple of Load
        Loads; if they have a single pressure, requested states are written as pressures. Empty in a stage.
    """
    name = name_in(PROCEDURES, procedure)
    if name is None:
        raise unknown("procedure", type(procedure).__name__, PROCEDURES)
    values = stated_fields(procedure, procedure_fields(type(procedure)))
    return {"type": name} | values | {"at": requested(procedure.at, only_pressure(loads))}


def stated_fields(value: Any, items: Iterable[Field[Any]]) -> dict[str, Any]:
    """Return fields in the form of a job file, without those that are None."""
    stated = {item.name: _stated(item, getattr(value, item.name)) for item in items}
    return {key: each for key, each in stated.items() if each is not None}


def requested(at: Iterable[float], top: float | None) -> list[str | float]:
    """Return requested states in the form of a job file: as pressures if there is a top pressure."""
    return [_requested(factor, top) for factor in at]


def _by_cavity(item: Field[Any]) -> bool:
    """Return whether a field takes a number for each cavity, as the volume of `VolumeControl` does."""
    return any(get_origin(each) is Mapping for each in get_args(item.type))


def _step_type(item: Field[Any]) -> Any:
    """Type of a field of a procedure."""
    if "dimension" not in item.metadata:
        return item.type
    dimension, several = item.metadata["dimension"], _by_cavity(item)
    if item.metadata.get("three"):
        return Annotated[Any, three(dimension), says_three(dimension)]
    return Annotated[Any, BeforeValidator(partial(_quantities, dimension=dimension, several=several))]


def _quantities(value: object, dimension: str, several: bool = False) -> object:
    """Read a quantity, or one for each cavity where there may be several; or names."""
    if dimension == "names":
        return _names(value)
    if several and isinstance(value, Mapping):
        return {name: _quantities(each, dimension) for name, each in value.items()}
    if dimension != "number":
        return parse_quantity(value, dimension)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TurgorError(f"{shown(value)} is not a number without a unit.")
    return float(value)


def _names(value: object) -> tuple[str, ...]:
    listed = value if isinstance(value, list) else [value]
    if not all(isinstance(name, str) for name in listed):
        raise TurgorError(f"{shown(value)} is neither a name in quotes nor a list of names.")
    return tuple(listed)


def _load_factor_or_pressure(value: object) -> object:
    """Read a number as a load factor, and text as a pressure ``(pressure,)`` until the top pressure is known."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    return (parse_quantity(value, "pressure"),)


_STATE = Annotated[Any, BeforeValidator(_load_factor_or_pressure), Says("load factor or pressure", "0.5", "pressure")]


def _requested(factor: float, top: float | None) -> str | float:
    """Pressure at a load factor if it reads back as exactly this factor, else the load factor."""
    if top is None:
        return factor
    for digits in range(1, 18):
        pressure = float(f"{factor * top / kPa:.{digits}g}") * kPa
        if pressure / top == factor:
            return format_quantity(pressure, "kPa")
    return factor


def _stated(item: Field[Any], value: Any) -> Any:
    """Field of a procedure in the form of a job file: with its unit, and for each cavity if there are several."""
    if isinstance(value, Mapping):
        return {name: _stated(item, each) for name, each in value.items()}
    unit = _UNITS.get(item.metadata.get("dimension", ""))
    if callable(value):
        raise TurgorError(f"the {item.name} of the procedure is a function, which has no form in a job file.")
    if item.metadata.get("three") and value is not None:
        return [format_quantity(part, str(unit)) for part in value]
    if unit is None or value is None:
        return list(value) if isinstance(value, tuple) else value
    return format_quantity(value, unit)
