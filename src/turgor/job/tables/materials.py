"""Materials of a job file: from the library, or stated by their law."""

from collections.abc import Mapping
from dataclasses import fields, replace
from math import inf
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.laws.laws import LAWS, GeneralizedRivlin, Hooke
from turgor.core.materials.laws.names import law_name
from turgor.core.materials.library.records import find_record, from_library, library
from turgor.core.materials.material import Material
from turgor.core.model.layers import as_solid
from turgor.core.model.sheets import Membrane, Sheet, Shell
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.source import Source
from turgor.job.tables.material_tables import LibraryTable, StatedTable, law_table
from turgor.job.text.body_names import by_body, unknown_part
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import read_table, shown

#: Forms of a strain-limiting layer: a shell, a membrane without bending stiffness, a thin solid region of its own, or
#: combined constants for the region below it.
SHELL, MEMBRANE, SOLID, COMBINED = FORMS = ("shell", "membrane", "solid", "combined")

#: Keys of a rubber for its behavior in time, besides its law.
HISTORY = ("viscoelasticity", "stress_softening", "permanent_set")

#: Keys that a job may state where a record has them, too.
OWN = (*HISTORY, "bending_stiffness", "expansion", "strength", "crack_growth")

#: Region that combined constants apply to.
BASE = "base"


def read_materials(
    values: Any, geometry: Geometry | None, problems: Problems, own: Mapping[str, Material] = MappingProxyType({})
) -> dict[str, Material | Sheet]:
    """Read ``[materials]``: one entry per region, and one with a thickness for each reinforced face.

    Regions of ``own`` have a material already, whatever the table says.
    """
    key = ("materials",)
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [materials] and one material per region below it.")
        return {}
    values, problems = by_body("materials", values, geometry, problems)
    materials: dict[str, Material | Sheet] = {}
    forms = {name: _form_of(entry, (*key, name), geometry, problems) for name, entry in values.items()}
    combined = [name for name, form in forms.items() if form == COMBINED]
    if BASE in values and combined:
        problems.add((*key, BASE), f"the combined constants of {combined[0]} stand for this region; leave one out.")
    for name, entry in values.items():
        if geometry is not None and name not in (*geometry.regions, *geometry.faces):
            known = (
                *geometry.regions,
                *(face for face in geometry.faces if not face.startswith(("symmetry_", "cyclic_"))),
            )
            problems.add((*key, name), str(unknown_part("region or face", name, known, geometry)))
            continue
        material = _read_material(entry, (*key, name), forms[name], geometry, problems)
        if material is not None:
            # parts of the same material share one object, so that a report describes it once
            region = BASE if forms[name] == COMBINED else name
            materials[region] = next((other for other in materials.values() if other == material), material)
    if geometry is not None:
        given = {*own, *(BASE if forms[name] == COMBINED else name for name in values)}
        missing = [region for region in geometry.regions if region not in given]
        if missing:
            problems.add(key, f"no material for region {', '.join(missing)}; give each region one.")
    return materials | dict(own)


def _read_material(
    values: Any, key: Key, form: str | None, geometry: Geometry | None, problems: Problems
) -> Material | Sheet | None:
    if isinstance(values, Mapping) and "law" in values:
        law = problems.attempt((*key, "law"), lambda: law_name(str(values["law"])))
        if law is None:
            return None
        kind: Any = LAWS[law]
        table = read_table(law_table(kind), values, key, problems)
    elif isinstance(values, Mapping) and "library" not in values:
        problems.add(key, _without_law(values))
        return None
    else:
        table = read_table(LibraryTable, values, key, problems)
    if table is None:
        return None
    if form is not None and form not in FORMS:
        problems.add((*key, "form"), str(unknown("form", form, FORMS)))
        return None
    stated = isinstance(table, StatedTable)
    material = _stated(table, key, problems) if stated else _from_library(table, key, problems)
    if material is None or not _form_fits(form, material, table.thickness, key, geometry, problems):
        return None
    layer = form in (SOLID, COMBINED)
    if not layer and not _suits(material, table.thickness, key, geometry, problems):
        return None
    if not _keys_of_sheets_fit(table, form, key, problems):
        return None
    if table.thickness is not None:
        return _sheet(table, form, material, key, problems)
    return as_solid(material) if form == SOLID else material


def _without_law(values: Mapping[str, Any]) -> str:
    """Say what a material lacks that names neither the library nor a law, by its constants."""
    laws = {name: {item.name for item in fields(kind)} for name, kind in LAWS.items()}
    given = [key for key in values if any(key in constants for constants in laws.values())]
    fitting = [name for name, constants in laws.items() if given and set(given) <= constants]
    if not fitting:
        return "'library' or 'law' is missing; name a material of the library, or a law and its constants."
    least = min(fitting, key=lambda name: len(laws[name]))
    are = "is a constant" if len(given) == 1 else "are constants"
    return f"'law' is missing; {' and '.join(given)} {are} of law = \"{least}\"."


def _keys_of_sheets_fit(table: Any, form: str | None, key: Key, problems: Problems) -> bool:
    """Whether the keys of sheets are those of its form."""
    if table.compression is not None and (table.thickness is None or form in (SOLID, COMBINED)):
        problems.add((*key, "compression"), "only a sheet on a face has a compression; leave it out.")
    elif table.warp is not None and (table.thickness is None or form in (SOLID, COMBINED)):
        problems.add((*key, "warp"), "only a woven sheet on a face has a warp; leave it out.")
    elif table.bending_stiffness is not None and form != SHELL:
        problems.add((*key, "bending_stiffness"), "only a shell on a face has a bending stiffness; leave it out.")
    else:
        return True
    return False


def _sheet(table: Any, form: str | None, material: Material, key: Key, problems: Problems) -> Sheet | None:
    kind = Membrane if form == MEMBRANE else Shell
    own = replace(material, bending_stiffness=None) if kind is Membrane else material
    share = 1.0 if table.compression is None else table.compression
    return problems.attempt(
        key, lambda: kind(own, table.thickness, share, table.warp), fields=("thickness", "compression", "warp")
    )


def _form_of(entry: Any, key: Key, geometry: Geometry | None, problems: Problems) -> str | None:
    """Form that an entry states; else that of a sheet: of its compression, of its record, or a shell."""
    if not isinstance(entry, Mapping):
        return None
    if "form" in entry or geometry is None or key[-1] in geometry.regions:
        return entry.get("form")
    if "compression" in entry:
        return MEMBRANE
    name, record = entry.get("library"), entry.get("record")
    if not isinstance(name, str) or not isinstance(record, str | None):
        return SHELL
    try:
        return find_record(_file(name, problems), record).form or SHELL
    except TurgorError:
        return SHELL  # the reader of shells reports what is wrong with it


def _form_fits(
    form: str | None,
    material: Material,
    thickness: float | None,
    key: Key,
    geometry: Geometry | None,
    problems: Problems,
) -> bool:
    """Whether a form other than a sheet fits the name, and has no thickness of its own."""
    name = key[-1]
    if geometry is None or form is None:
        return True
    region = name in geometry.regions
    if form in (MEMBRANE, SHELL) and region:
        problems.add((*key, "form"), f"'{name}' is a region; \"{form}\" is for sheets on faces.")
    elif form == SOLID and not region:
        problems.add((*key, "form"), f"'{name}' is a face; a solid layer needs a thickness, actuator.layer.")
    elif form == COMBINED and (region or BASE not in geometry.regions):
        why = f"'{name}' is a region" if region else f"the actuator has no region '{BASE}'"
        problems.add((*key, "form"), f"{why}; \"combined\" gives a face's constants to the region '{BASE}' below it.")
    elif form in (SOLID, COMBINED) and thickness is not None:
        problems.add((*key, "thickness"), f'form = "{form}" takes the thickness of its region; leave thickness out.')
    elif form == COMBINED and isinstance(material.law, Hooke):
        problems.add(key, f"'{material.name}' is linear elastic; combined constants are those of a rubber's law.")
    else:
        return True
    return False


def _from_library(table: LibraryTable, key: Key, problems: Problems) -> Material | None:
    material = read_library(table.library, table.record, table.density, key, problems)
    stated = {name: getattr(table, name) for name in OWN if getattr(table, name) is not None}
    if material is None or not stated:
        return material
    return problems.attempt(key, lambda: replace(material, **stated), fields=OWN)


def read_library(name: str, record: str | None, density: float | None, key: Key, problems: Problems) -> Material | None:
    """Return a material of the library or of a file in the folder of the job; a stated density replaces its own."""
    wrong = "record" if name in library() else "library"
    file = _file(name, problems)
    material = problems.attempt((*key, wrong), lambda: from_library(file, record=record))
    if material is None or density is None:
        return material
    return problems.attempt(key, lambda: replace(material, density=density), fields=("density",))


def _file(name: str, problems: Problems) -> str:
    """Name of a material of the library, or the path of a file, which is relative to the folder of the job."""
    return str(Path(problems.file).parent / name) if name.endswith(".toml") else name


def _stated(table: Any, key: Key, problems: Problems) -> Material | None:
    kind = LAWS[law_name(table.law)]
    source = Source(text=f"stated in {problems.file}")
    if table.source is not None:
        source = Source(text=table.source.text, detail=table.source.detail, doubts=tuple(table.source.doubts))
    stretch_range = table.stretch_range
    if stretch_range is not None and not (len(stretch_range) == 2 and 0 < stretch_range[0] <= 1 <= stretch_range[1]):
        problems.add((*key, "stretch_range"), f"{stretch_range} is not [smallest, largest] with 1 between them.")
        return None

    def make() -> Material:
        return Material(
            name=table.name or key[-1],
            law=_law(kind, {item.name: getattr(table, item.name) for item in fields(kind)}),
            bulk_modulus=getattr(table, "bulk_modulus", inf),
            density=table.density,
            stretch_range=(stretch_range[0], stretch_range[1]) if stretch_range else None,
            source=source,
            **{name: getattr(table, name, None) for name in (*OWN, "orientation")},
        )

    return problems.attempt(
        key, make, fields=(*(item.name for item in fields(kind)), "bulk_modulus", "density", "bending_stiffness")
    )


def _law(kind: Any, constants: Mapping[str, Any]) -> Any:
    if kind is GeneralizedRivlin:
        return GeneralizedRivlin.from_names(constants["coefficients"])
    return kind(**constants)


def _suits(
    material: Material, thickness: float | None, key: Key, geometry: Geometry | None, problems: Problems
) -> bool:
    """Whether regions get rubbers, and faces sheets with a thickness."""
    name, elastic = key[-1], isinstance(material.law, Hooke)
    if geometry is None:
        return True
    if name in geometry.regions and thickness is not None:
        problems.add(
            (*key, "thickness"),
            f"'{name}' is a region, and only a sheet on a face has a thickness. A film that is a body of its own takes "
            'form = "solid" and the thickness that it is drawn with; or fill it with a rubber, and give the sheet to '
            f"a face on its outside, one of {', '.join(geometry.faces)}.",
        )
    elif name in geometry.regions and elastic:
        problems.add(
            key,
            f"'{material.name}' is linear elastic, for sheets only; a region needs a rubber's law, "
            'or form = "solid" where it is a film.',
        )
    elif name not in geometry.regions and thickness is None:
        problems.add((*key, "thickness"), f"'thickness' is missing; '{name}' is a face, and its sheet needs one.")
    else:
        return True
    return False
