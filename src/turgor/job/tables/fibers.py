"""Fibers of a job file: one table ``[fibers.NAME]`` for each winding."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import pi
from typing import Annotated, Any

from pydantic import AfterValidator, Field

from turgor.core.geometry.directions import AXES
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.failure_tables import failure_tables
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.library.records import find_record
from turgor.core.materials.material import Material
from turgor.core.model.embedded import EmbeddedThreads
from turgor.core.model.fibers import DISCRETE, SMEARED, Fibers, Winding
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.source import Source
from turgor.job.tables.material_tables import SourceTable, Strengths
from turgor.job.tables.materials import read_library
from turgor.job.text.box_table import BoxTable, box_table
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Angle, Coordinate, Density, Expansion, Length, Pressure, Table, read_table, shown
from turgor.units import format_quantity

#: Keys of a table for the path of threads, with the unit of each in a lock file.
_WINDING = {
    "angle_from_axis": "deg",
    "angle_from_circumference": "deg",
    "turns": "",
    "pitch": "mm",
    "spacing": "mm",
    "starts": "",
    "hand": "",
}


def _axis(name: str) -> str:
    if name not in AXES:
        raise unknown("axis of a winding", name, AXES)
    return name


class FibersTable(Table):
    """``[fibers.NAME]``: threads and how they are wound.

    Keys
    ----
    face : str or list of str
        Face that the threads are wound on; several that go around together. Or state ``through``.
    through : list of lists of points [m]
        Points of each thread inside the body, which runs straight from one to the next; instead of ``face`` and the
        keys of a winding. Their form is ``"discrete"``.
    library : str
        Material of the threads from the library; or state ``E``.
    record : str, optional
        Record of the material; needed where it has several.
    name : str
        Name of the material in reports.
    law : str
        Law of the threads.
    nu : float [-]
        Poisson's ratio, which has no effect on threads.
    density : float [kg/m³]
        Density of the threads.
    expansion : float [1/K]
        Linear thermal expansion along the threads, which a temperature of the winding takes; that of the record by
        default.
    source : table
        Where the constants come from, as for a material.
    strength : table
        Tensile strength and elongation at break of the threads with their source; that of the record by default.
    diameter : float [m]
        Diameter of a thread; that of the record by default.
    axis : str
        Axis around which the threads are wound.
    within : table
        Planes that threads do not cross.
    """

    face: str | list[str] | None = None
    through: list[list[list[Coordinate]]] | None = Field(
        default=None, examples=['[[["0 mm", 0, "4 mm"], ["60 mm", 0, "4 mm"]]]']
    )
    library: str | None = Field(default=None, examples=['"kevlar-fiber"'])
    record: str | None = Field(default=None, examples=['"hooke-connolly-2015"'])
    name: str | None = Field(default=None, examples=['"thread"'])
    law: str = "hooke"
    E: Pressure | None = Field(default=None, examples=['"30 GPa"'])
    nu: float = 0.3  # of a thread it has no effect
    density: Density | None = None
    expansion: Expansion | None = None
    source: SourceTable | None = Field(default=None, examples=['{ text = "data sheet" }'])
    strength: Strengths | None = Field(default=None, examples=['{ tensile_strength = "3 GPa", source = "maker" }'])
    diameter: Length | None = Field(default=None, examples=['"0.2 mm"'])
    angle_from_axis: Angle | None = None
    angle_from_circumference: Angle | None = None
    turns: float | None = None
    pitch: Length | None = None
    spacing: Length | None = None
    starts: int | None = None
    hand: str = "right"
    axis: Annotated[str, AfterValidator(_axis)] = "x"
    form: str | None = None
    compression: float = 0.0
    bending: bool = False
    within: BoxTable | None = Field(default=None, examples=['{ x_from = "5 mm", x_to = "95 mm" }'])


def read_fibers(values: Any, geometry: Geometry | None, problems: Problems) -> dict[str, Fibers]:
    """Read ``[fibers]``: a table for each winding."""
    key = ("fibers",)
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [fibers.winding] and the keys of a winding below it.")
        return {}
    flat = [name for name in values if name in FibersTable.model_fields or name == "angle"]
    if flat:
        problems.add((*key, flat[0]), "a winding needs a name of its own; write [fibers.winding] and keys below it.")
        return {}
    windings = {name: _read_winding(entry, (*key, name), geometry, problems) for name, entry in values.items()}
    return {name: fibers for name, fibers in windings.items() if fibers is not None}


def _read_winding(values: Any, key: Key, geometry: Geometry | None, problems: Problems) -> Fibers | None:
    if isinstance(values, Mapping) and "angle" in values:
        problems.add(
            (*key, "angle"),
            f"{shown(values['angle'])} does not say from where it is counted; write angle_from_axis (0 deg runs along "
            "the axis) or angle_from_circumference (0 deg runs around it).",
        )
        return None
    table: FibersTable | None = read_table(FibersTable, values, key, problems)
    if table is None or not _faces_are_there(table, key, geometry, problems):
        return None
    material = _material(table, key, problems)
    winding = problems.attempt(key, partial(_winding, table), fields=(*_WINDING, "through"))
    diameter = None if material is None else _diameter(table, key, problems)
    _check_turns(table, key, geometry, problems)
    if material is None or winding is None or diameter is None:
        return None
    make = partial(_fibers, table, key[-1], material, diameter, winding)
    return problems.attempt(key, make, fields=("face", "diameter", "compression", "within", "pitch", "bending"))


def _faces_are_there(table: FibersTable, key: Key, geometry: Geometry | None, problems: Problems) -> bool:
    if (table.face is None) == (table.through is None):
        state = (
            "missing; name it, or the points inside the body: through" if table.face is None else "stated with through"
        )
        problems.add((*key, "face"), f"'face' of the threads is {state}.")
        return False
    if table.face is None:
        return True
    faces = [table.face] if isinstance(table.face, str) else table.face
    if not faces:
        problems.add((*key, "face"), "the list is empty; name the face that the threads are wound on.")
    if geometry is None:
        return bool(faces)
    wrong = [face for face in faces if face not in geometry.faces]
    for face in wrong:
        problems.add((*key, "face"), str(unknown("face", face, geometry.faces)))
    return bool(faces) and not wrong


def _material(table: FibersTable, key: Key, problems: Problems) -> Material | None:
    """Material of the threads: from the library, or stated by its modulus."""
    if table.law != "hooke":
        problems.add((*key, "law"), f"{shown(table.law)} is not allowed; fibers have the law 'hooke'.")
        return None
    if (table.library is None) == (table.E is None):
        given = "both library and E" if table.E is not None else "neither library nor E"
        problems.add(key, f"the threads have {given}; name a material of the library, or state Young's modulus E.")
        return None
    if table.library is not None:
        material = read_library(table.library, table.record, table.density, key, problems)
        if material is None:
            return None
        expansion = material.expansion if table.expansion is None else table.expansion
        return replace(material, strength=table.strength or material.strength, expansion=expansion)
    source = Source(text=f"stated in {problems.file}")
    if table.source is not None:
        source = Source(text=table.source.text, detail=table.source.detail, doubts=tuple(table.source.doubts))

    def make() -> Material:
        law = Hooke(E=table.E, nu=table.nu)  # type: ignore[arg-type]
        name = table.name or key[-1]
        return Material(
            name=name,
            law=law,
            density=table.density,
            source=source,
            strength=table.strength,
            expansion=table.expansion,
        )

    return problems.attempt(key, make, fields=("E", "nu", "density"))


def _winding(table: FibersTable) -> Winding | EmbeddedThreads:
    if table.through is not None:
        wrong = sorted(table.model_fields_set & {*_WINDING, "axis"})
        if wrong:
            raise TurgorError(f"{wrong[0]} is a key of threads on a face; those with through have none.")
        return EmbeddedThreads(through=table.through)
    stated = {name: getattr(table, name) for name in _WINDING}
    return Winding(**stated, axis=AXES[table.axis])


def _check_turns(table: FibersTable, key: Key, geometry: Geometry | None, problems: Problems) -> None:
    """Note a mirror plane that turns a helix of one hand into the other."""
    mirrors = [] if geometry is None else [face for face in geometry.faces if face.startswith("symmetry_")]
    angle = table.angle_from_axis if table.angle_from_axis is not None else table.angle_from_circumference
    straight = angle is not None and not 1e-9 < angle < pi / 2 - 1e-9
    if not mirrors or table.through is not None or table.hand not in ("right", "left") or straight:
        return
    problems.add(
        (*key, "hand"),
        f"the mirror plane {mirrors[0]} turns a {table.hand}-handed helix into one of the other hand; set "
        'actuator.symmetric = false, or wind both hands with hand = "both".',
    )


def _diameter(table: FibersTable, key: Key, problems: Problems) -> float | None:
    """Diameter of the table, or that of the record."""
    if table.diameter is not None:
        return table.diameter
    if table.library is not None and not table.library.endswith(".toml"):
        stated = find_record(table.library, table.record).diameter
        if stated is not None:
            return stated
    where = "" if table.library is None else f", and the record of '{table.library}' states none"
    problems.add((*key, "diameter"), f"'diameter' of a thread is missing{where}.")
    return None


def _fibers(
    table: FibersTable, name: str, material: Material, diameter: float, winding: Winding | EmbeddedThreads
) -> Fibers:
    box = table.within
    return Fibers(
        face=table.face if isinstance(table.face, str) else tuple(table.face or ()),
        material=material,
        diameter=diameter,
        winding=winding,
        form=table.form or (SMEARED if table.through is None else DISCRETE),
        compression=table.compression,
        bending=table.bending,
        within=None if box is None else box.corners,
        name=name,
    )


def fibers_tables(fibers: Mapping[str, Fibers]) -> dict[str, Any]:
    """Write windings as tables of a job file; `read_fibers` gives the same windings back."""
    return {name: _table(each) for name, each in fibers.items()}


def _table(fibers: Fibers) -> dict[str, Any]:
    values = _course_table(fibers)
    material, law, source = fibers.material, fibers.material.law, fibers.material.source
    assert isinstance(law, Hooke)
    values |= {"name": material.name, "E": format_quantity(law.E, "GPa"), "nu": law.nu}
    if material.density is not None:
        values["density"] = format_quantity(material.density, "kg/m³")
    if material.expansion is not None:
        values["expansion"] = format_quantity(material.expansion, "1/K")
    values["source"] = {"text": source.text, "detail": source.detail, "doubts": list(source.doubts)}
    values |= failure_tables(material)
    values["diameter"] = format_quantity(fibers.diameter, "mm")
    values |= {"form": fibers.form, "compression": fibers.compression, "bending": fibers.bending}
    if fibers.within is not None:
        values["within"] = box_table(fibers.within)
    return values


def _course_table(fibers: Fibers) -> dict[str, Any]:
    """Keys of how threads run: on which face and how, or through which points."""
    winding = fibers.winding
    if isinstance(winding, EmbeddedThreads):
        points = [[[format_quantity(x, "mm") for x in point] for point in thread] for thread in winding.through]
        return {"through": points}
    values: dict[str, Any] = {"face": fibers.face if isinstance(fibers.face, str) else list(fibers.face)}
    for name, unit in _WINDING.items():
        value = getattr(winding, name)
        if value is not None:
            values[name] = format_quantity(value, unit) if unit else value
    names = [name for name, axis in AXES.items() if axis == tuple(winding.axis)]
    if not names:
        raise TurgorError(f"the axis {winding.axis} of a winding has no form in a job file; wind around x, y or z.")
    return {**values, "axis": names[0]}
