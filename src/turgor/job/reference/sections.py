"""Sections of a job file: all tables but those of the actuator families."""

from collections.abc import Iterator, Mapping
from functools import partial
from inspect import getdoc
from typing import Any

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.laws.laws import LAWS, Hooke
from turgor.core.meshing.bodies.assembly import PlacedBody
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.settings import MeshSettings
from turgor.core.model.bonds import Bond
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.obstacles import Obstacle, SelfContact
from turgor.core.model.points import ReferencePoint
from turgor.core.model.rigid import RigidFile
from turgor.core.setups.blocked_tip import blocked_force
from turgor.core.setups.grasped_object import grasp
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.step_options import StepOptions
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.job.job import Output
from turgor.job.read import DEFAULTS
from turgor.job.reference.kinds import Kind
from turgor.job.reference.ranges import Reader
from turgor.job.reference.tables import JobKey, JobTable, Source, toml
from turgor.job.tables.bodies.body_tables import BodyTable
from turgor.job.tables.bonds import BondTable, read_bonds
from turgor.job.tables.cad import CAD_FILE, CadFileTable, SelectorTable, SplitTable
from turgor.job.tables.contact import ContactTable, read_contact
from turgor.job.tables.fibers import FibersTable, read_fibers
from turgor.job.tables.loads import read_loads
from turgor.job.tables.material_tables import LibraryTable, SourceTable, StatedTable, law_table
from turgor.job.tables.materials import read_materials
from turgor.job.tables.mesh_files import MESH_FILE, MeshFileTable
from turgor.job.tables.obstacles import SHAPES, STL, ObstacleTable, obstacle_table, read_obstacles
from turgor.job.tables.points import PointTable, read_points
from turgor.job.tables.procedures import PROCEDURES, procedure_fields, procedure_table, read_procedure
from turgor.job.tables.sections import read_engine, read_mesh, read_output
from turgor.job.tables.setups import SETUPS, read_setup, setup_table
from turgor.job.tables.stages import StageTable
from turgor.job.tables.supports import SupportTable, stated_supports
from turgor.job.text.box_table import BoxTable
from turgor.job.text.equation_table import EquationTable, TermTable
from turgor.job.text.listed_loads import listed_kinds, listed_table, loads_model
from turgor.job.text.load_tables import (
    CavityTable,
    ForceTable,
    GravityTable,
)
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import EngineTable, MeshTable, OutputTable, default_of
from turgor.units import format_quantity

#: Functions that say what the keys of a setup mean.
_EXPLAINED: Mapping[str, Any] = {"blocked_force": blocked_force, "grasp": grasp}

#: Keys that a kind cannot do without, in the notation of a job file.
_NEEDED: Mapping[str, Mapping[str, Any]] = {
    "plane": {"point": [0, 0, "-5 mm"], "normal": "+z"},
    "sphere": {"center": [0, 0, "-20 mm"], "radius": "10 mm"},
    "cylinder": {"center": [0, 0, "-20 mm"], "axis": "+y", "radius": "5 mm"},
    "box": {"center": [0, 0, "-20 mm"], "size": ["10 mm", "10 mm", "10 mm"]},
    "arruda_boyce": {"mu": "60 kPa", "locking_stretch": 3.0},
    "blatz_ko": {"mu": "30 kPa"},
    "extended_tube": {"Gc": "60 kPa", "Ge": "60 kPa", "delta": 0.1, "beta": 0.3},
    "generalized_rivlin": {"coefficients": {"C10": "50 kPa"}},
    "gent": {"mu": "60 kPa", "Jm": 50.0},
    "holzapfel_gasser_ogden": {
        "C10": "5 kPa",
        "k1": "20 kPa",
        "k2": 1.0,
        "orientation": {"along": [1, 0, 0], "across": [0, 1, 0]},
    },
    "hooke": {"E": "2 GPa", "nu": 0.3, "thickness": "0.1 mm"},
    "hyperfoam": {"mu": ["5 kPa"], "alpha": [8.0], "nu": [0.0]},
    "woven": {"E": "1 GPa", "nu": 0.2, "E_weft": "0.5 GPa", "G": "20 MPa", "thickness": "0.3 mm", "warp": [1, 0, 0]},
    "mooney_rivlin": {"C10": "40 kPa", "C01": "10 kPa"},
    "neo_hooke": {"C10": "50 kPa"},
    "ogden": {"mu": ["60 kPa"], "alpha": [2.0]},
    "orthotropic": {"C10": "1 MPa", "orientation": {"along": [1, 0, 0], "across": [0, 1, 0]}},
    "yeoh": {"C10": "50 kPa", "C20": "2 kPa"},
    "yeoh_n": {"coefficients": ["50 kPa", "2 kPa"]},
    "grasp": {"pull_distance": "8 mm"},
}

#: Values of the keys that a procedure cannot do without, by their dimension.
_EXAMPLES: Mapping[str, Any] = {"length": "8 mm", "number": 2.0, "pressure": "20 kPa", "time": "2 s", "volume": "5 mL"}


def section_tables(shape: Geometry | None = None) -> Iterator[JobTable]:
    """Yield the tables of a job file in its order, without those of the actuator families.

    Parameters
    ----------
    shape : Geometry, optional
        Actuator to which ranges refer; the default fast PneuNet if it is not given.

    Examples
    --------
    >>> next(table.header for table in section_tables())
    'top of the file'
    """
    built = shape or FastPneuNet().build()
    yield _top()
    yield from _files()
    yield _of(BodyTable, "[bodies.NAME]", PlacedBody)
    yield _mesh(built)
    yield from _materials(built)
    yield from _fibers(built)
    yield _bonds(built)
    yield _supports()
    yield _of(SupportTable, "[supports.NAME]")
    yield _of(EquationTable, "[supports.NAME], with terms")
    yield _of(TermTable, "{ ... } of terms")
    yield from _loads(built)
    yield _points(built)
    yield from _contact(built)
    yield from _procedures()
    yield _of(StageTable, "[[stages]]")
    yield _output(built)
    yield _of(EngineTable, "[engine]", read=read_engine)


def _of(model: Any, header: str, *described: Any, read: Reader | None = None, **more: Any) -> JobTable:
    words = " ".join((getdoc(model) or "").partition("\n\nKeys")[0].split()).rpartition("``: ")[2]
    return Source(model=model, described=described, read=read, **more).table(header, words[:1].upper() + words[1:])


def _output(shape: Geometry) -> JobTable:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_output(values, shape, None, problems)

    return _of(OutputTable, "[output]", Output, read=read)


def _top() -> JobTable:
    """Key that stands in no table."""
    name = JobKey(
        name="name",
        kind="text",
        default="",
        allowed="letters, digits, '-', '_' and '.'",
        meaning="Name of the run and of its folder of results; that of the file by default.",
        example='"finger"',
    )
    return JobTable(header="top of the file", words="What stands before the first table.", keys=(name,))


def _supports() -> JobTable:
    """Supports: the faces are the keys."""
    directions = JobKey(
        name="FACE",
        kind="text",
        default=toml(DEFAULTS["supports"]["fixed"], Kind(words="text")),
        allowed=f"some of x, y and z; or {', '.join(stated_supports())}",
        meaning="Directions in which the face is fixed, or that its radius is, or that it stays plane. The default is "
        "that of the face `fixed`, where the part has one.",
        example='"xyz"',
    )
    return JobTable(
        header="[supports]", words="How faces are fixed; mirror planes are supported by themselves.", keys=(directions,)
    )


def _mesh(shape: Geometry) -> JobTable:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_mesh(values, shape, problems)

    # a size and a kind of cells, because it takes a second to choose them
    base = {"size": format_quantity(2 * shape.smallest_wall, "mm"), "cells": "tetrahedra"}
    return _of(MeshTable, "[mesh]", MeshSettings, read=read, base=base)


def file_tables() -> Mapping[str, JobTable]:
    """Return the tables of actuators that come from files, by their types."""
    return {
        CAD_FILE: _of(CadFileTable, f'[actuator], type = "{CAD_FILE}"', CadFile),
        MESH_FILE: _of(MeshFileTable, f'[actuator], type = "{MESH_FILE}"', MeshFile),
    }


def _files() -> Iterator[JobTable]:
    tables = file_tables()
    yield tables[CAD_FILE]
    yield _of(SplitTable, "[actuator.split]", SplitPlane)
    yield tables[MESH_FILE]
    yield _of(SelectorTable, "{ ... } of a face or region")


def _materials(shape: Geometry) -> Iterator[JobTable]:
    def read(name: str, values: Mapping[str, Any], problems: Problems) -> None:
        read_materials({name: values}, shape, problems)

    body, layer = partial(read, "body"), partial(read, "strain_limiting_layer")
    base = {"library": "paper", "record": "hooke-polygerinos-2020", "thickness": "0.1 mm"}
    yield _of(LibraryTable, "[materials.NAME], from the library", read=layer, base=base, unasked=("record",))
    base = {"law": "hooke", **_NEEDED["hooke"]}
    yield _of(StatedTable, "[materials.NAME], stated by its law", read=layer, base=base)
    law: Any
    for name, law in LAWS.items():
        model, reader = law_table(law), layer if issubclass(law, Hooke) else body
        header, words = f'[materials.NAME], law = "{name}"', (getdoc(law) or "").splitlines()[0]
        base = {"law": name, **_NEEDED.get(name, {})}
        source = Source(model=model, described=(law,), read=reader, base=base, without=StatedTable.model_fields)
        yield source.table(header, words)
    yield _of(SourceTable, "[materials.NAME.source]")


def _fibers(shape: Geometry) -> Iterator[JobTable]:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_fibers({"hoops": values}, shape, problems)

    base = {"face": "outside", "library": "kevlar-fiber", "angle_from_circumference": "0 deg", "spacing": "3 mm"}
    yield _of(FibersTable, "[fibers.NAME]", Fibers, Winding, Hooke, read=read, base=base, unasked=("record",))
    yield _of(BoxTable, "[fibers.NAME.within]")


def _bonds(shape: Geometry) -> JobTable:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_bonds({"glue": values}, shape, problems)

    base = {"between": ["body", "base"], "peel_strength": "50 kPa", "energy_peel": "200 J/m²"}
    return _of(BondTable, "[bonds.NAME]", Bond, read=read, base=base)


def _loads(shape: Geometry) -> Iterator[JobTable]:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_loads(values, shape, {}, problems)

    yield _of(loads_model(), "[loads]", read=read)
    yield _of(CavityTable, "[loads.CAVITY]", read=lambda values, problems: read({"cavity": values}, problems))
    yield _of(ForceTable, "[loads.FACE]", read=lambda values, problems: read({"tip": values}, problems),
              base={"force": [0, 0, "-0.5 N"]})  # fmt: skip
    for key, kind in listed_kinds().items():
        yield _of(listed_table(kind), f"[[loads.{key}]]")
    yield _of(GravityTable, "[loads.gravity]", read=lambda values, problems: read({"gravity": values}, problems),
              base={"direction": "-z"})  # fmt: skip


def _points(shape: Geometry) -> JobTable:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_points({"plate": values}, shape, (), None, problems)

    return _of(PointTable, "[points.NAME]", ReferencePoint, read=read, base={"face": "tip"})


def _contact(shape: Geometry) -> Iterator[JobTable]:
    def read(values: Mapping[str, Any], problems: Problems) -> None:
        read_contact(values, {}, shape, problems)

    def obstacle(values: Mapping[str, Any], problems: Problems) -> None:
        read_obstacles({"plate": values}, shape, problems)

    yield _of(ContactTable, "[contact]", Contact, SelfContact, read=read)
    base: Mapping[str, Any] = {"shape": "plane", **_NEEDED["plane"]}
    yield _of(ObstacleTable, "[obstacles.NAME]", Obstacle, read=obstacle, base=base)
    for name in (*SHAPES, STL):
        described = SHAPES.get(name, RigidFile)
        words = (getdoc(described) or "").splitlines()[0]
        model, base = obstacle_table(name), {"shape": name, **_NEEDED.get(name, {})}
        reader = None if name == STL else obstacle
        source = Source(model=model, described=(described,), read=reader, base=base, without=ObstacleTable.model_fields)
        yield source.table(f'[obstacles.NAME], shape = "{name}"', words)


def _procedures() -> Iterator[JobTable]:
    rest = (Static, StepOptions, VolumeControl)
    kind: Any
    for name, kind in PROCEDURES.items():
        needed = [each for each in procedure_fields(kind) if default_of(each) is ...]
        base = {"type": name} | {each.name: _EXAMPLES[each.metadata.get("dimension", "number")] for each in needed}
        words = (getdoc(kind) or "").splitlines()[0]
        source = Source(model=procedure_table(kind), described=(kind, *rest), read=_procedure, base=base)
        yield source.table(f'[procedure], type = "{name}"', words)
    setup: Any
    for name, setup in SETUPS.items():
        base = {"type": name, **_NEEDED.get(name, {})}
        described = _EXPLAINED[name]
        words = (getdoc(setup) or "").splitlines()[0].partition(";")[0] + "."
        source = Source(
            model=setup_table(setup),
            described=(described, setup, *rest),
            read=partial(_setup, name),
            base=base,
        )
        yield source.table(f'[procedure], type = "{name}"', words)


def _procedure(values: Mapping[str, Any], problems: Problems) -> None:
    read_procedure(values, (), problems)


def _setup(name: str, values: Mapping[str, Any], problems: Problems) -> None:
    read_setup(name, values, (), problems)
