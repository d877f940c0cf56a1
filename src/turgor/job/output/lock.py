"""Lock file: every value of a run, defaults included, as a job file that repeats the run."""

from collections.abc import Mapping
from dataclasses import fields
from math import inf
from typing import Any

import tomlkit

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.materials.failure_tables import failure_tables
from turgor.core.materials.laws.law_spec import is_dimensionless
from turgor.core.materials.laws.laws import LAWS, Hooke
from turgor.core.materials.library.record_history import history_tables
from turgor.core.materials.material import Material
from turgor.core.materials.orientation import orientation_table
from turgor.core.meshing.bodies.assembly import Assembly
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.sheets import Sheet, Shell
from turgor.foundation.errors import TurgorError
from turgor.foundation.registry import name_in
from turgor.job.job import Job, actuator_type
from turgor.job.tables.bodies.body_tables import bodies_tables
from turgor.job.tables.bonds import bonds_tables
from turgor.job.tables.cad import cad_file_table
from turgor.job.tables.contact import contact_table
from turgor.job.tables.fibers import fibers_tables
from turgor.job.tables.loads import loads_table
from turgor.job.tables.mesh_files import mesh_file_table
from turgor.job.tables.obstacles import obstacles_tables
from turgor.job.tables.points import points_tables
from turgor.job.tables.procedures import written_procedure
from turgor.job.tables.setups import written_setup
from turgor.job.tables.stages import STAGES, stages_tables
from turgor.job.tables.supports import supports_table
from turgor.units import format_quantity

#: Units in which a lock file states the dimensions of a value.
_UNIT = {"length": "mm", "angle": "deg", "pressure": "MPa", "density": "kg/m³"}

#: Sections in the order in which a lock file states them.
_ORDER = (
    "name", "actuator", "bodies", "mesh", "materials", "fibers", "bonds", "supports", "loads", "points", "contact",
    "obstacles", "procedure", STAGES, "output", "engine", "written_by",
)  # fmt: skip

_HEADER = (
    "# Every value of one run, defaults included. This is a job file: `turgor run` with it repeats the run.\n"
    "# [written_by] says which versions wrote it; it is not read.\n\n"
)


def lock_text(job: Job, written_by: Mapping[str, str | int]) -> str:
    """Write a job with every default as TOML; `read_job` returns an equal job from it.

    Parameters
    ----------
    job : Job
        The run.
    written_by : mapping
        Versions and settings of the program; they are recorded, and not read back.
    """
    content: dict[str, Any] = {
        "name": job.name,
        **_actuator(job.actuator),
        "mesh": _mesh(job),
        "materials": {name: material_table(entry) for name, entry in job.materials.items()},
        "fibers": fibers_tables(job.fibers),
        "bonds": bonds_tables(job.bonds),
        "supports": supports_table(job.supports),
        "loads": loads_table(job.loads),
        "points": points_tables(job.points),
        "contact": contact_table(job.contact),
        "obstacles": obstacles_tables(job.contact, job.rigid_files),
        "output": _output(job),
        "engine": {"threads": job.threads} if job.threads is not None else {},
        "written_by": dict(written_by),
    }
    if job.procedure.stages:
        content[STAGES] = stages_tables(job.procedure)
    elif job.setup is not None:
        content["procedure"] = written_setup(job.setup, job.procedure, job.loads)
    else:
        content["procedure"] = written_procedure(job.procedure, job.loads)
    return _HEADER + tomlkit.dumps({key: content[key] for key in _ORDER if key in content})


def _actuator(actuator: Any) -> dict[str, Any]:
    """The table of the actuator, or those of its bodies."""
    own = dimensions(actuator)
    return {"bodies": own} if isinstance(actuator, Assembly) else {"actuator": {"type": actuator_type(actuator)} | own}


def _output(job: Job) -> dict[str, Any]:
    content = {item.name: _plain(getattr(job.output, item.name)) for item in fields(job.output)}
    del content["markers"]
    if job.output.markers:
        content["markers"] = {
            name: [format_quantity(value, "mm") for value in point] for name, point in job.output.markers.items()
        }
    return content


def dimensions(actuator: Any) -> dict[str, Any]:
    """Return the fields of an actuator in the form of a job file: lengths and angles with their unit."""
    if isinstance(actuator, CadFile):
        return cad_file_table(actuator)
    if isinstance(actuator, MeshFile):
        return mesh_file_table(actuator)
    if isinstance(actuator, Assembly):
        return bodies_tables(actuator, dimensions)
    values = {}
    for item in fields(actuator):
        value, dimension = getattr(actuator, item.name), item.metadata.get("dimension", "length")
        if item.type is float and dimension != "number":
            values[item.name] = format_quantity(value, _UNIT[dimension])
        else:
            values[item.name] = value
    return values


def _mesh(job: Job) -> dict[str, Any]:
    sizes = {"imperfection": [format_quantity(size, "mm") for size in job.imperfection]} if job.imperfection else {}
    if isinstance(job.actuator, MeshFile):
        return sizes
    mesh = job.actuator.mesh if isinstance(job.actuator, Assembly) else job.mesh_settings
    cells = {} if mesh.cells is None else {"cells": mesh.cells}
    return {
        **({} if mesh.size is None else {"size": format_quantity(mesh.size, "mm")}),
        "grading": mesh.grading,
        "face_sizes": {name: format_quantity(size, "mm") for name, size in mesh.face_sizes.items()},
        "wall_cells": mesh.wall_cells,
        **cells,
        **({} if mesh.quality == MeshSettings().quality else {"quality": mesh.quality}),
        **_features(mesh.ignore_features_below),
        **_target(job),
        **sizes,
    }


def _features(limit: float | None) -> dict[str, Any]:
    """Key of the limit of small features, if one is given."""
    return {} if limit is None else {"ignore_features_below": format_quantity(limit, "mm")}


def _target(job: Job) -> dict[str, Any]:
    """Keys of the target of the mesh refinement, if there is one."""
    if job.mesh_target is None:
        return {}
    measure = {"target_measure": job.mesh_target_measure} if job.mesh_target_measure else {}
    return {"target": f"{100 * job.mesh_target:.6g} %", **measure, "most_unknowns": job.mesh_most_unknowns}


def material_table(entry: Material | Sheet) -> dict[str, Any]:
    """Write a material or a sheet as a table of a job file."""
    material = entry.material if isinstance(entry, Sheet) else entry
    law = name_in(LAWS, material.law)
    if law is None:
        raise TurgorError(f"job files have no name for the law {type(material.law).__name__} of '{material.name}'.")
    elastic = isinstance(material.law, Hooke)
    unit = "GPa" if elastic else "MPa"
    values: dict[str, Any] = {"name": material.name, "law": law}
    for item in fields(material.law):  # type: ignore[arg-type]
        value = getattr(material.law, item.name)
        values[item.name] = _constants(value, None if is_dimensionless(item) else unit)
    if not elastic and not material.is_foam:
        incompressible = material.bulk_modulus == inf
        values["bulk_modulus"] = "incompressible" if incompressible else format_quantity(material.bulk_modulus, "MPa")
    values |= history_tables(material) | failure_tables(material)
    if material.orientation is not None:
        values["orientation"] = orientation_table(material.orientation)
    if material.density is not None:
        values["density"] = format_quantity(material.density, "kg/m³")
    if material.expansion is not None:
        values["expansion"] = format_quantity(material.expansion, "1/K")
    if material.stretch_range is not None:
        values["stretch_range"] = list(material.stretch_range)
    if isinstance(entry, Sheet):
        values["thickness"] = format_quantity(entry.thickness, "mm")
        values["form"] = type(entry).__name__.lower()
        if isinstance(entry, Shell) and material.bending_stiffness is not None:
            values["bending_stiffness"] = format_quantity(material.bending_stiffness, "µN m")
        if entry.warp is not None:
            values["warp"] = list(entry.warp)
        if entry.wrinkles:
            values["compression"] = entry.compression
    source = material.source
    return values | {"source": {"text": source.text, "detail": source.detail, "doubts": list(source.doubts)}}


def _constants(value: Any, unit: str | None) -> Any:
    """A constant, a list for all terms, or coefficients by their exponents, in the form that `law_table` reads."""
    if not isinstance(value, tuple):
        return value if unit is None else format_quantity(value, unit)
    if isinstance(value[0], tuple):
        return {f"C{i}{j}": _constants(number, unit) for i, j, number in value}
    return [_constants(number, unit) for number in value]


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
