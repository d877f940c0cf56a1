"""Sections of a job file: each turns one table into values, and notes what is wrong."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from turgor.errors import TurgorError, unknown
from turgor.geometry import Geometry
from turgor.job.cad import CAD_FILE, read_cad_file
from turgor.job.job import ACTUATORS, Actuator, Output, standard_measures
from turgor.job.lines import Key
from turgor.job.loads import requested_factors
from turgor.job.mesh_files import MESH_FILE, read_mesh_file
from turgor.job.problems import Problems
from turgor.job.tables import (
    EngineTable,
    MeshTable,
    OutputTable,
    dataclass_table,
    procedure_table,
    read_table,
    shown,
)
from turgor.meshing.exchange.mesh_file import MeshedShape
from turgor.meshing.sizes import check_face_sizes, check_settings, default_size
from turgor.meshing.swept import check_cells
from turgor.model.loads import Gravity, Pressure
from turgor.solvers.blocked_force import BlockedForce
from turgor.solvers.dynamic import Dynamic
from turgor.solvers.grasp import Grasp
from turgor.solvers.path_procedures import ArcLength, Auto, GasMass, VolumeControl
from turgor.solvers.procedures import Static
from turgor.solvers.stabilized import Stabilized
from turgor.solvers.stages import OneProcedure
from turgor.units import parse_quantity

#: Procedures by the name that job files use. A new one is one line here; its keys are its fields.
PROCEDURES: Mapping[str, type[Any]] = {
    "static": Static,
    "blocked_force": BlockedForce,
    "grasp": Grasp,
    "volume_control": VolumeControl,
    "gas_mass": GasMass,
    "arc_length": ArcLength,
    "auto": Auto,
    "stabilized": Stabilized,
    "dynamic": Dynamic,
}

#: Procedures that drive the actuator without any load.
DRIVING = ("volume_control", "gas_mass")


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
    if isinstance(values, Mapping) and values.get("type") == CAD_FILE:
        return read_cad_file(values, problems)
    if isinstance(values, Mapping) and values.get("type") == MESH_FILE:
        return read_mesh_file(values, problems)
    family = _chosen({**ACTUATORS, CAD_FILE: None, MESH_FILE: None}, "actuator type", values, key, problems)
    table = read_table(dataclass_table(family), values, key, problems) if family else None
    if family is None or table is None:
        return None
    made: Actuator | None = problems.attempt(
        key, lambda: family(**_fields_of(table)), fields=[item.name for item in fields(family)]
    )
    return made


def read_mesh(values: Any, geometry: Geometry | None, problems: Problems) -> MeshTable | None:
    """Read ``[mesh]``; where the shape is known, choose a missing size and refuse at once what `mesh` will refuse."""
    key = ("mesh",)
    table: MeshTable | None = read_table(MeshTable, values, key, problems)
    if table is None or geometry is None:
        return table
    if isinstance(geometry._shape, MeshedShape):
        if values:
            problems.add(key, "the actuator is a mesh already; leave the table [mesh] out, or mesh the part again.")
        return table.model_copy(update={"size": geometry.extent})
    size = default_size(geometry, table.cells) if table.size is None else table.size
    settings = (size, table.grading, table.wall_cells)
    problems.attempt(key, lambda: check_settings(geometry, *settings), fields=("size", "grading", "wall_cells"))
    problems.attempt((*key, "face_sizes"), lambda: check_face_sizes(geometry, table.face_sizes, size))
    problems.attempt((*key, "cells"), lambda: check_cells(geometry, table.cells, table.face_sizes))
    return table.model_copy(update={"size": size})


def read_procedure(values: Any, loads: tuple[Pressure | Gravity, ...], problems: Problems) -> OneProcedure | None:
    """Read ``[procedure]``; requested pressures become load factors."""
    key = ("procedure",)
    kind = _chosen(PROCEDURES, "procedure", values, key, problems)
    table = read_table(procedure_table(kind), values, key, problems) if kind else None
    if kind is None or table is None:
        return None
    given = _fields_of(table)
    if kind is Grasp and any(isinstance(value, tuple) for value in given["at"]):
        why = "in a grasp the pressure rises until closing and is held then"
        problems.add((*key, "at"), f"a pressure does not say which state is meant: {why}; request load factors.")
        return None
    given["at"] = tuple(requested_factors(given["at"], loads, problems))
    made: OneProcedure | None = problems.attempt(key, lambda: kind(**given), fields=given)
    return made


def drives(values: Any) -> bool:
    """Whether ``[procedure]`` drives the actuator by itself, so that there need not be any load."""
    return isinstance(values, Mapping) and values.get("type") in DRIVING


def duration_of(values: Any) -> float | None:
    """Duration of ``[procedure]`` [s], None where it has none or a wrong one, which `read_procedure` will say."""
    try:
        return parse_quantity(values["duration"], "time")
    except (TurgorError, TypeError, KeyError):
        return None


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
