"""Reading of job files: a `Job`, or an error that lists all mistakes at once."""

import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.bodies.assembly import Assembly
from turgor.core.model.loads import Load
from turgor.core.setups.setup_values import Setup
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.errors import TurgorError, near_file, near_match
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.family_cache import geometry_on_disk
from turgor.job.job import Actuator, Job
from turgor.job.symmetry_breakers import with_broken_planes
from turgor.job.tables.bodies.body_tables import ASSEMBLY, LATER
from turgor.job.tables.bodies.rigid_bodies import rigid_materials, rigs_of
from turgor.job.tables.bonds import read_bonds
from turgor.job.tables.contact import read_contact
from turgor.job.tables.fibers import read_fibers
from turgor.job.tables.loads import check_motion, read_loads
from turgor.job.tables.materials import read_materials
from turgor.job.tables.mesh_files import MESH_FILE
from turgor.job.tables.points import DRIVING, read_points
from turgor.job.tables.procedures import drives, duration_of, read_procedure
from turgor.job.tables.sections import read_actuator, read_engine, read_mesh, read_output
from turgor.job.tables.setups import SETUPS, read_setup, setup_type
from turgor.job.tables.stages import STAGES, Around, first_duration, read_stages, with_names
from turgor.job.tables.supports import moves_a_face, read_supports
from turgor.job.text.lines import key_lines
from turgor.job.text.overrides import changed, changed_places
from turgor.job.text.problems import JobError, Problems
from turgor.job.text.quantities import shown

#: Keys of a job file; the last one is written into lock files and says which versions wrote them.
SECTIONS = (
    "name",
    "actuator",
    "bodies",
    "mesh",
    "materials",
    "fibers",
    "bonds",
    "supports",
    "loads",
    "points",
    "contact",
    "obstacles",
    "procedure",
    "stages",
    "output",
    "engine",
    "written_by",
)

#: Sections that may be left out, with their default content.
DEFAULTS: Mapping[str, Mapping[str, Any]] = {
    "mesh": {},
    "fibers": {},
    "bonds": {},
    "supports": {"fixed": "xyz"},
    "points": {},
    "contact": {},
    "obstacles": {},
    "procedure": {"type": "static"},
    "output": {},
    "engine": {},
}

_NAME = re.compile(r"[\w.-]+")


def read_job(path: str | Path, changes: Mapping[str, Any] = MappingProxyType({}), *, like: Job | None = None) -> Job:
    """Read a job file: TOML, in which every quantity carries its unit.

    Parameters
    ----------
    path : str or Path
        The file; a lock file that a run wrote is a job file too.
    changes : mapping of str to value
        Values that replace or join those of the file, by dotted key as in TOML: ``{"loads.pressure": "30 kPa"}``. A
        stage is named by its name or its number.
    like : Job, optional
        A job whose shape is taken, not built again, where the actuator is equal.

    Returns
    -------
    Job

    Raises
    ------
    JobError
        If anything in the file is wrong: one line per problem with file, line, key, value and what is allowed.
    TurgorError
        If the file cannot be read or is no TOML.
    """
    path = Path(path)
    text = _text(path)
    try:
        content = read_toml(text, str(path))
    except TurgorError as error:
        raise JobError([str(error)]) from error
    content = changed(content, DEFAULTS, changes)
    problems = Problems(str(path), with_names(changed_places(key_lines(text), changes), content))
    job = _read(content, name_of_file(path), problems, None if like is None else like.built)
    problems.raise_any()
    assert job is not None
    return job


def name_of_file(path: Path) -> str:
    """Return the name of the run of a job file that states none: any file name makes one.

    Examples
    --------
    >>> name_of_file(Path("my job (2).toml")), name_of_file(Path("%.toml"))
    ('my-job-2', 'job')
    """
    return path.stem if _NAME.fullmatch(path.stem) else "-".join(re.findall(r"[\w.]+", path.stem)) or "job"


def _given(content: Mapping[str, Any], problems: Problems) -> dict[str, Any]:
    """Content of each section, or its default; None for a required section that is missing."""
    for key in content:
        if key not in SECTIONS:
            known = ", ".join(SECTIONS)
            problems.add((key,), f"unknown key '{key}'{near_match(key, SECTIONS) or '.'} Known keys: {known}.")
    given = {key: content.get(key, DEFAULTS.get(key)) for key in SECTIONS}
    if given["actuator"] is None and isinstance(given["mesh"], Mapping) and "file" in given["mesh"]:
        own = {key: value for key, value in given["mesh"].items() if key != "imperfection"}
        rest = {key: value for key, value in given["mesh"].items() if key not in own}
        given["actuator"], given["mesh"] = {"type": MESH_FILE, **own}, rest  # a mesh file replaces both
    if given["bodies"] is not None:
        if "actuator" in content:
            problems.add(("actuator",), "[bodies] states the actuators; write this one as [bodies.NAME].")
        stated = dict(given["mesh"]) if isinstance(given["mesh"], Mapping) else {}
        given["mesh"] = {key: stated.pop(key) for key in LATER if key in stated}
        given["actuator"] = {"type": ASSEMBLY, "bodies": given["bodies"], "mesh": stated}
    if STAGES in content and "procedure" in content:
        problems.add(("procedure",), "every stage has a procedure of its own; write it there and leave this one out.")
    if (_alone(given) or _rigged(given["points"])) and given["loads"] is None:
        given["loads"] = {}
    for key in ("actuator", "materials", "loads"):
        if key == "materials" and _all_rigid(given["bodies"]):
            continue
        if given[key] is None and not (key == "loads" and _moves(given["obstacles"])):
            problems.add((key,), f"the table [{key}] is missing.")
    return given


def _alone(given: Mapping[str, Any]) -> bool:
    """Whether no load is needed: the procedure or a moved face drives the actuator, or stages have their own loads."""
    return given[STAGES] is not None or drives(given["procedure"]) or moves_a_face(given["supports"])


def _read_path(given: Mapping[str, Any], around: Around, problems: Problems) -> tuple[Setup | None, Procedure | None]:
    """Read the setup and the procedure, or the stages."""
    if given[STAGES] is not None:
        return None, read_stages(given[STAGES], around, problems)
    setup = setup_type(given["procedure"])
    if setup is not None:
        return read_setup(setup, given["procedure"], around.loads, problems) or (None, None)
    procedure = read_procedure(given["procedure"], around.loads, problems, SETUPS)
    check_motion(procedure, around.loads, around.materials, problems)
    return None, procedure


def _read(
    content: Mapping[str, Any], stem: str, problems: Problems, built: tuple[Actuator, Geometry] | None
) -> Job | None:
    given = _given(content, problems)
    name = read_name(content.get("name", stem), problems)
    actuator = read_actuator(given["actuator"], problems) if given["actuator"] is not None else None
    actuator = with_broken_planes(actuator, given)
    geometry = built[1] if built is not None and built[0] == actuator else _build(actuator, problems)
    mesh = read_mesh(given["mesh"], geometry, problems)
    if given["bodies"] is not None and geometry is None:
        return None  # other sections name bodies, faces and regions, which are unknown
    rigid = rigid_materials(actuator, geometry)
    stated = given["materials"] is not None or rigid
    materials = read_materials(given["materials"] or {}, geometry, problems, rigid) if stated else {}
    fibers = read_fibers(given["fibers"], geometry, problems)
    bodies = {**fibers, **materials}
    bonds = read_bonds(given["bonds"], geometry, problems)
    loads: tuple[Load, ...] = ()
    timed = first_duration(given[STAGES]) if given[STAGES] is not None else duration_of(given["procedure"])
    if given["loads"] is not None:
        needed = not _alone(given) and not _rigged(given["points"])
        loads = read_loads(given["loads"], geometry, bodies, problems, needed, timed)
    supports = read_supports(content.get("supports", _fixed(actuator, geometry)), geometry, problems)
    contact, rigid_files = read_contact(given["contact"], given["obstacles"], geometry, problems)
    points = rigs_of(actuator, read_points(given["points"], geometry, loads, timed, problems))
    around = Around(geometry, bodies, supports, contact, loads, _moves(given["obstacles"]))
    setup, procedure = _read_path(given, around, problems)
    output = read_output(given["output"], geometry, setup, problems)
    threads = read_engine(given["engine"], problems)
    if problems.entries or actuator is None or mesh is None or procedure is None or output is None:
        return None
    return Job(
        name=name,
        actuator=actuator,
        mesh=mesh.settings,
        mesh_target=mesh.target,
        mesh_target_measure=mesh.target_measure,
        mesh_most_unknowns=mesh.most_unknowns,
        imperfection=mesh.imperfection,
        materials=materials,
        supports=supports,
        fibers=fibers,
        bonds=bonds,
        loads=loads,
        points=points,
        contact=contact,
        rigid_files=rigid_files,
        setup=setup,
        procedure=procedure,
        output=output,
        threads=threads,
        built=None if geometry is None else (actuator, geometry),
    )


def _fixed(actuator: Actuator | None, geometry: Geometry | None) -> Mapping[str, Any]:
    """Default supports: the face ``fixed``, that of each body unless a plate joins it to another one.

    A part without it is supported by mirror planes, inertia or reference points.
    """
    if isinstance(actuator, Assembly):
        faces = [f"fixed_{name}" for name in actuator.members if name not in {*actuator.joints, *actuator.rigid}]
    else:
        faces = list(DEFAULTS["supports"])
    return {face: "xyz" for face in faces if geometry is None or face in geometry.faces}


def _all_rigid(bodies: object) -> bool:
    """Whether all bodies are rigid, so that none needs a material."""
    entries = bodies.values() if isinstance(bodies, Mapping) else ()
    return bool(entries) and all(isinstance(entry, Mapping) and "mass" in entry for entry in entries)


def _rigged(points: object) -> bool:
    """Whether anything acts on a reference point or moves it, which drives the actuator where no load does."""
    entries = points.values() if isinstance(points, Mapping) else ()
    return any(isinstance(entry, Mapping) and DRIVING & set(entry) for entry in entries)


def _moves(obstacles: object) -> bool:
    """Whether any obstacle has a path or a rotation, which drives the actuator where no load does."""
    entries = obstacles.values() if isinstance(obstacles, Mapping) else ()
    return any(isinstance(entry, Mapping) and {"path", "rotation"} & set(entry) for entry in entries)


def _build(actuator: Actuator | None, problems: Problems) -> Geometry | None:
    """Build the shape, because its names are keys of other sections, or find on disk what is known about it."""
    if actuator is None:
        return None
    key = "bodies" if isinstance(actuator, Assembly) else "actuator"
    return geometry_on_disk(actuator) or problems.attempt((key,), actuator.build)


def read_name(value: object, problems: Problems) -> str:
    """Return a name from which the name of a folder is made, or note a problem."""
    if isinstance(value, str) and _NAME.fullmatch(value):
        return value
    problems.add(("name",), f"{shown(value)} is not a name; use letters, digits, '-', '_' and '.'.")
    return ""


def _text(path: Path) -> str:
    if path.is_dir():
        raise TurgorError(f"'{path}' is a folder; name a job file, such as '{path / 'job.toml'}'.")
    if not path.exists():
        folder = path.parent
        known = sorted(entry.name for entry in folder.glob("*.toml")) if folder.is_dir() else []
        listed = f" TOML files there: {', '.join(known)}." if known else ""
        raise TurgorError(f"there is no job file '{path}'{near_file(path, known)}{listed}")
    return read_text(path)
