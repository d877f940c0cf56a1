"""Sections of a job file: each turns one table into values, and notes what is wrong."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from turgor.errors import unknown
from turgor.geometry import Geometry
from turgor.job.job import ACTUATORS, Actuator, Output, standard_measures
from turgor.job.lines import Key
from turgor.job.problems import Problems
from turgor.job.tables import (
    DIRECTIONS,
    EngineTable,
    LoadsTable,
    MeshTable,
    OutputTable,
    dataclass_table,
    procedure_table,
    read_table,
    shown,
)
from turgor.materials.material import Material
from turgor.meshing.generate import mesh, size_range
from turgor.model.loads import Gravity, Pressure
from turgor.model.model import Membrane
from turgor.model.supports import Fixed
from turgor.solvers.procedures import Static
from turgor.units import format_quantity

PROCEDURES: Mapping[str, type[Static]] = {"static": Static}


def _chosen(kinds: Mapping[str, Any], what: str, values: Any, key: Key, problems: Problems) -> Any | None:
    """The kind that the key ``type`` of a table names."""
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [{'.'.join(key)}] and its keys below it.")
        return None
    if "type" not in values:
        problems.add((*key, "type"), f"'type' is missing; allowed: {', '.join(kinds)}.")
        return None
    name = str(values["type"])
    if name not in kinds:
        problems.add((*key, "type"), str(unknown(what, name, kinds)))
        return None
    return kinds[name]


def _fields_of(table: Any) -> dict[str, Any]:
    """The values of a checked table without its type."""
    return {name: getattr(table, name) for name in type(table).model_fields if name != "type"}


def read_actuator(values: Any, problems: Problems) -> Actuator | None:
    """Read ``[actuator]``: a type and its dimensions."""
    key = ("actuator",)
    family = _chosen(ACTUATORS, "actuator type", values, key, problems)
    table = read_table(dataclass_table(family), values, key, problems) if family else None
    if family is None or table is None:
        return None
    made: Actuator | None = problems.attempt(
        key, lambda: family(**_fields_of(table)), fields=[item.name for item in fields(family)]
    )
    return made


def read_mesh(values: Any, geometry: Geometry | None, problems: Problems) -> MeshTable | None:
    """Read ``[mesh]``; where the shape is known, refuse at once what `mesh` will refuse."""
    table: MeshTable | None = read_table(MeshTable, values, ("mesh",), problems)
    if table is None or geometry is None:
        return table
    low, high = size_range(geometry)
    if not (low <= table.size <= high and 0.1 <= table.grading <= 1):
        problems.attempt(
            ("mesh",), lambda: mesh(geometry, size=table.size, grading=table.grading), fields=("size", "grading")
        )
    return table


def read_loads(
    values: Any, geometry: Geometry | None, materials: Mapping[str, Material | Membrane], problems: Problems
) -> tuple[Pressure | Gravity, ...]:
    """Read ``[loads]``: a gauge pressure in the cavity, gravity, or both."""
    key = ("loads",)
    table = read_table(LoadsTable, values, key, problems)
    if table is None:
        return ()
    loads: list[Pressure | Gravity] = []
    if table.pressure is not None:
        loads.append(Pressure("cavity", table.pressure))
    if table.gravity is not None and _gravity_allowed(table.gravity, geometry, materials, problems):
        loads.append(Gravity(DIRECTIONS[table.gravity]))
    if table.pressure is None and table.gravity is None:
        problems.add(key, "nothing drives the actuator; give pressure, gravity or both.")
    return tuple(loads)


def _gravity_allowed(
    text: str, geometry: Geometry | None, materials: Mapping[str, Material | Membrane], problems: Problems
) -> bool:
    key = ("loads", "gravity")
    if geometry is not None and f"symmetry_{text[1]}" in geometry.faces:
        problems.add(key, f"'{text}' points across the mirror plane of a half model; set actuator.symmetric = false.")
        return False
    light = [n for n, m in materials.items() if isinstance(m, Material) and m.density is None]
    for name in light:
        problems.add(("materials", name), "has no density, and gravity needs it; add density, such as '1100 kg/m³'.")
    return not light


def read_supports(values: Any, geometry: Geometry | None, problems: Problems) -> tuple[Fixed, ...]:
    """Read ``[supports]``: for each face the directions in which it is held."""
    if not isinstance(values, Mapping):
        problems.add(("supports",), f"{shown(values)} is not a table; write [supports] and faces below it.")
        return ()
    supports = []
    for face, directions in values.items():
        key = ("supports", face)
        if geometry is not None and face not in geometry.faces:
            problems.add(key, str(unknown("face", face, geometry.faces)))
        elif not isinstance(directions, str) or not directions or not set(directions) <= set("xyz"):
            problems.add(key, f"{shown(directions)} is not allowed; name the held directions, such as 'xyz' or 'z'.")
        else:
            supports.append(Fixed(face, directions))
    return tuple(supports)


def read_procedure(values: Any, loads: tuple[Pressure | Gravity, ...], problems: Problems) -> Static | None:
    """Read ``[procedure]``; requested pressures become load factors."""
    key = ("procedure",)
    kind = _chosen(PROCEDURES, "procedure", values, key, problems)
    table = read_table(procedure_table(kind), values, key, problems) if kind else None
    if kind is None or table is None:
        return None
    given = _fields_of(table)
    top = next((load.pressure for load in loads if isinstance(load, Pressure)), None)
    given["at"] = tuple(_load_factors(given["at"], top, problems))
    made: Static | None = problems.attempt(key, lambda: kind(**given), fields=given)
    return made


def _load_factors(requested: list[Any], top: float | None, problems: Problems) -> list[float]:
    factors = []
    for value in requested:
        if not isinstance(value, tuple):
            factors.append(value)
            continue
        if not top:
            problems.add(("procedure", "at"), "pressures are requested, but loads.pressure is missing or zero.")
            break
        factor = value[0] / top
        if not 0 < factor <= 1:
            given, limit = format_quantity(value[0], "kPa"), format_quantity(top, "kPa")
            problems.add(("procedure", "at"), f"{given} does not lie between 0 and loads.pressure, {limit}.")
            break
        factors.append(factor)
    return sorted(set(factors))


def read_engine(values: Any, problems: Problems) -> int | None:
    """Read ``[engine]``: the number of threads."""
    table = read_table(EngineTable, values, ("engine",), problems)
    if table is None or table.threads is None:
        return None
    from turgor.engine.runtime import EngineOptions  # here, because it loads the engine

    options = problems.attempt(("engine",), lambda: EngineOptions(threads=table.threads), fields=("threads",))
    return None if options is None else options.threads


def read_output(values: Any, problems: Problems) -> Output | None:
    """Read ``[output]``: which measures, and what else to write."""
    key = ("output",)
    table = read_table(OutputTable, values, key, problems)
    if table is None:
        return None
    if len(set(table.measures)) < len(table.measures):
        problems.add((*key, "measures"), "a measure is listed twice.")
    if problems.found:
        return None  # the job is refused: the standard measures, which load the engine, are not needed
    return Output(
        measures=tuple(table.measures) or standard_measures(),
        fields=table.fields,
        pictures=table.pictures,
        report=table.report,
    )
