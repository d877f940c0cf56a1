"""Stages in a job: ``[[stages]]``, an array of tables with one for each, both ways."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any

from pydantic import Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers
from turgor.core.model.history import RAMP
from turgor.core.model.loads import Load
from turgor.core.model.obstacles import Vector
from turgor.core.model.sheets import Sheet
from turgor.core.model.supports import Displacement, Shift, Support
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.stages import Stage, Stages, check_stage
from turgor.foundation.errors import TurgorError, unknown
from turgor.job.tables.loads import check_motion, loads_table, read_loads
from turgor.job.tables.obstacles import Lengths
from turgor.job.tables.procedures import duration_of, read_procedure, written_procedure
from turgor.job.tables.setups import refuse_setup
from turgor.job.text.lines import Key, Place
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Says, Table, read_table, shown
from turgor.units import format_quantity

STAGES = "stages"


class StageTable(Table):
    """``[[stages]]``: procedures one after another; each begins where the last one ended.

    What a stage does not state stays as it was.

    Keys
    ----
    name : str
        Name of the stage.
    procedure : table
        Procedure of the stage, as ``[procedure]``; static by default.
    loads : table
        Loads at the end of the stage, as ``[loads]``; the others do not change.
    displacements : table
        Displacement of faces that ``[supports]`` fixes, by the name of the face.
    moves : table
        Displacement of obstacles at the end of the stage, by the name of the obstacle.
    """

    name: str = Field(examples=['"fill"'])
    procedure: Annotated[Any, Says("table", '{ type = "static" }')] = None
    loads: Annotated[Any, Says("table", '{ pressure = "60 kPa" }')] = None
    displacements: dict[str, Lengths] = Field(default_factory=dict, examples=['{ tip = [0, 0, "-5 mm"] }'])
    moves: dict[str, Lengths] = Field(default_factory=dict, examples=['{ plate = [0, 0, "5 mm"] }'])


@dataclass(frozen=True, slots=True)
class Around:
    """Sections of a job on which stages act.

    Parameters
    ----------
    geometry : Geometry or None
        The actuator; None where it could not be built.
    materials : mapping of str to Material, Shell, Membrane or Fibers
        Windings by their names, too.
    supports : tuple of Support
    contact : Contact
    loads : tuple of Pressure, Gravity or Force
    moved : bool
        Whether an obstacle has a path.
    """

    geometry: Geometry | None
    materials: Mapping[str, Material | Sheet | Fibers]
    supports: tuple[Support, ...]
    contact: Contact
    loads: tuple[Load, ...]
    moved: bool


def with_names(lines: Mapping[Key, Place], content: Mapping[str, Any]) -> dict[Key, Place]:
    """Return the places of keys, with the name of a stage in the place of its number."""
    named = {str(number): name for number, name in enumerate(_labels(content.get(STAGES)), start=1)}
    places = {}
    for key, line in lines.items():
        inside = key[0] == STAGES and len(key) > 1 and key[1] in named
        places[(STAGES, named[key[1]], *key[2:]) if inside else key] = line
    return places


def _labels(values: Any) -> list[str]:
    """Label of each stage in messages: its name, or its number if it has none of its own."""
    labels: list[str] = []
    for number, entry in enumerate(values if isinstance(values, list) else [], start=1):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        labels.append(name if isinstance(name, str) and name.strip() and name not in labels else str(number))
    return labels


def first_duration(values: Any) -> float | None:
    """Duration of the first stage [s], the time of histories in ``[loads]``; None if it has none."""
    first = values[0] if isinstance(values, list) and values else None
    return duration_of(first.get("procedure")) if isinstance(first, Mapping) else None


def read_stages(values: Any, around: Around, problems: Problems) -> Stages | None:
    """Read ``[[stages]]``.

    Parameters
    ----------
    values : list of mappings
        The tables.
    around : Around
        The rest of the job.
    problems : Problems
        Takes what is wrong.

    Returns
    -------
    Stages or None
        None where something is wrong.
    """
    if not isinstance(values, list) or not values:
        problems.add((STAGES,), f"{shown(values)} is no list of stages; write [[stages]] and the keys of one below it.")
        return None
    read: list[Stage | None] = []
    for number, (label, entry) in enumerate(zip(_labels(values), values, strict=True)):
        read.append(_read_stage(entry, number, around, problems.below((STAGES, label))))
        if isinstance(entry, Mapping) and entry.get("name") in [each.name for each in read[:-1] if each is not None]:
            problems.add((STAGES, label, "name"), f"'{entry['name']}' names another stage too; give each its own name.")
    stages = [stage for stage in read if stage is not None]
    if len(stages) < len(values) or problems.entries:
        return None
    if not (around.loads or around.moved or any(map(_changes, stages))):
        problems.add((STAGES,), "nothing drives the actuator in any stage; give one of them loads, moves or a volume.")
        return None
    return problems.attempt((STAGES,), partial(Stages, tuple(stages)))


def _changes(stage: Stage) -> bool:
    """Whether a stage changes a load, a support or an obstacle."""
    return bool(stage.loads or stage.displacements or stage.moves or stage.procedure.requested)


def _read_stage(entry: Any, number: int, around: Around, problems: Problems) -> Stage | None:
    if not isinstance(entry, Mapping):
        problems.add((), f"{shown(entry)} is no table; write [[stages]] and its keys below it.")
        return None
    table: StageTable | None = read_table(StageTable, entry, (), problems)
    entry_procedure = entry.get("procedure", {"type": "static"})
    refused = refuse_setup(entry_procedure, problems.within[-1], problems)
    procedure = None if refused else read_procedure(entry_procedure, (), problems)
    duration, stated = duration_of(entry_procedure), entry.get("loads", {})
    loads = read_loads(stated, around.geometry, around.materials, problems, False, duration)
    if table is None:
        return None
    displacements = _displacements(table.displacements, around, problems)
    _check_moves(table.moves, around.contact, problems)
    if procedure is None:
        return None
    check_motion(procedure, (*around.loads, *loads), around.materials, problems)
    make = partial(Stage, loads=loads, displacements=displacements, moves=dict(table.moves))
    stage: Stage | None = problems.attempt((), partial(make, table.name, procedure))
    if stage is not None:
        problems.attempt(("procedure",), partial(check_stage, stage, number))
    return stage


def _displacements(stated: Mapping[str, Vector], around: Around, problems: Problems) -> tuple[Displacement, ...]:
    """Displacements of faces, in the directions in which ``[supports]`` fixes them."""
    fixed = dict(support.prescribed for support in around.supports if support.prescribed[0])
    displacements = []
    for face, vector in stated.items():
        key = ("displacements", face)
        if around.geometry is not None and face not in around.geometry.faces:
            problems.add(key, str(unknown("face", face, around.geometry.faces)))
        elif face not in fixed:
            known = ", ".join(fixed) or "none"
            problems.add(key, f"a stage moves faces that [supports] fixes, and '{face}' is not among them: {known}.")
        else:
            free = [axis for axis, part in zip("xyz", vector, strict=True) if part and axis not in fixed[face]]
            if free:
                problems.add(key, f"it moves along {', '.join(free)}, but '{face}' is fixed in {fixed[face]} only.")
            displacements.append(Displacement(face, Shift(vector), fixed[face]))
    return tuple(displacements)


def _check_moves(moves: Mapping[str, Vector], contact: Contact, problems: Problems) -> None:
    names = [obstacle.name for obstacle in contact.obstacles]
    for name in moves:
        if name in names:
            continue
        why = str(unknown("obstacle", name, names)) if names else "the job has no obstacles; add one under [obstacles]."
        problems.add(("moves", name), why)


def stages_tables(procedure: Procedure) -> list[dict[str, Any]]:
    """Write stages as tables of a job file; `read_stages` gives the same ones back.

    Parameters
    ----------
    procedure : Stages

    Returns
    -------
    list of dict

    Raises
    ------
    TurgorError
        If a displacement is a function, which has no form in a job file.
    """
    return [_written(stage) for stage in procedure.stages]


def _written(stage: Stage) -> dict[str, Any]:
    values: dict[str, Any] = {"name": stage.name, "procedure": written_procedure(stage.procedure)}
    if stage.loads:
        values["loads"] = loads_table(stage.loads)
    if stage.displacements:
        values["displacements"] = {each.face: _in_mm(_vector(each)) for each in stage.displacements}
    if stage.moves:
        values["moves"] = {name: _in_mm(place) for name, place in stage.moves.items()}
    return values


def _vector(moved: Displacement) -> Vector:
    shift = moved.shift
    if moved.way != RAMP:
        raise TurgorError(
            f"the displacement of '{moved.face}' has a history, which has no form in a stage of a job file."
        )
    return shift


def _in_mm(vector: Vector) -> list[str]:
    return [format_quantity(value, "mm") for value in vector]
