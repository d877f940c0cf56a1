"""Sections of a job file: each turns one table into values, and notes what is wrong."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.names import measured_faces
from turgor.core.meshing.default_settings import chosen_cells
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sizing.sizes import check_face_sizes, check_features, check_settings
from turgor.core.meshing.sweeping.swept import check_cells
from turgor.core.setups.setup_values import Setup
from turgor.job.job import Actuator, Output, standard_measures
from turgor.job.tables.bodies.body_tables import ASSEMBLY, LATER, read_bodies, read_part
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import (
    EngineTable,
    MeshTable,
    OutputTable,
    read_table,
)


def read_actuator(values: Any, problems: Problems) -> Actuator | None:
    """Read ``[actuator]``: a type and its dimensions; or the bodies that stand for it."""
    if isinstance(values, Mapping) and values.get("type") == ASSEMBLY:
        return read_bodies(values.get("bodies"), values.get("mesh", {}), problems)
    return read_part(values, problems, ("actuator",))


def read_mesh(values: Any, geometry: Geometry | None, problems: Problems) -> MeshTable | None:
    """Read ``[mesh]``; if the shape is known, choose a missing size and report what `mesh` would refuse."""
    key = ("mesh",)
    table: MeshTable | None = read_table(MeshTable, values, key, problems)
    if table is None or geometry is None:
        return table
    if isinstance(geometry.shape, MeshedShape):
        if set(values) - set(LATER if geometry.shape.bodies else ("imperfection",)):
            problems.add(key, "the actuator is a mesh already; leave the table [mesh] out, or mesh the part again.")
        return table.model_copy(update={"size": geometry.extent})
    cells = chosen_cells(geometry, table.settings)
    size = default_size(geometry, cells, table.quality) if table.size is None else table.size
    table = table.model_copy(update={"size": size, "cells": cells})
    settings = table.settings
    problems.attempt(key, lambda: check_settings(geometry, settings), fields=("size", "grading", "wall_cells"))
    problems.attempt((*key, "face_sizes"), lambda: check_face_sizes(geometry, table.face_sizes, size))
    limit = table.ignore_features_below
    problems.attempt((*key, "ignore_features_below"), lambda: check_features(geometry, limit, size, cells))
    problems.attempt((*key, "cells"), lambda: check_cells(geometry, cells))
    return table


def read_engine(values: Any, problems: Problems) -> int | None:
    """Read ``[engine]``: the number of threads."""
    table = read_table(EngineTable, values, ("engine",), problems)
    if table is None or table.threads is None:
        return None
    from turgor.core.engine.runtime import EngineOptions  # here, because it loads the engine

    options = problems.attempt(("engine",), lambda: EngineOptions(threads=table.threads), fields=("threads",))
    return None if options is None else options.threads


def _marker(name: str, point: Sequence[float]) -> None:
    """Refuse a marker whose name or place cannot be used."""
    from turgor.core.results.measures.markers import marker  # here: it loads the engine

    marker(name, point)


def read_output(values: Any, geometry: Geometry | None, setup: Setup | None, problems: Problems) -> Output | None:
    """Read ``[output]``: which measures, by default those that the part has, and what else to write.

    To measures that are listed come those that the setup is for.
    """
    key = ("output",)
    table = read_table(OutputTable, values, key, problems)
    if table is None:
        return None
    if len(set(table.measures)) < len(table.measures):
        problems.add((*key, "measures"), "a measure is listed twice.")
    for name, point in table.markers.items():
        problems.attempt((*key, "markers", name), partial(_marker, name, point))
    if problems.entries:
        return None  # the job is refused: the standard measures, which load the engine, are not needed
    measures = tuple(table.measures)
    if not measures or setup is not None:
        faces = None if geometry is None else measured_faces(geometry.faces, geometry.cavities)
        standard = standard_measures(faces)  # what a procedure is for joins them by itself
        own = () if setup is None or measures in ((), standard) else setup.measures
        measures = tuple(dict.fromkeys((*(measures or standard), *own)))
    return Output(
        measures=measures,
        markers={name: (point[0], point[1], point[2]) for name, point in table.markers.items()},
        fields=table.fields,
        pictures=table.pictures,
        report=table.report,
        mesh_error=table.mesh_error,
    )
