"""Materials of a job file: from the library, or stated by their law."""

from collections.abc import Mapping
from dataclasses import fields, replace
from math import inf
from pathlib import Path
from typing import Any

from turgor.errors import unknown
from turgor.geometry import Geometry
from turgor.job.lines import Key
from turgor.job.problems import Problems
from turgor.job.tables import LibraryTable, StatedTable, law_table, read_table, shown
from turgor.materials.laws import GeneralizedRivlin, Hooke
from turgor.materials.material import Material
from turgor.materials.records import LAWS, from_library, library
from turgor.model.model import Membrane
from turgor.source import Source


def read_materials(values: Any, geometry: Geometry | None, problems: Problems) -> dict[str, Material | Membrane]:
    """Read ``[materials]``: one entry per region, and one with a thickness for each reinforced face."""
    key = ("materials",)
    if not isinstance(values, Mapping):
        problems.add(key, f"{shown(values)} is not a table; write [materials] and one material per region below it.")
        return {}
    found: dict[str, Material | Membrane] = {}
    for name, entry in values.items():
        if geometry is not None and name not in (*geometry.regions, *geometry.faces):
            known = (*geometry.regions, *(face for face in geometry.faces if not face.startswith("symmetry_")))
            problems.add((*key, name), str(unknown("region or face", name, known)))
            continue
        made = _read_material(entry, (*key, name), geometry, problems)
        if made is not None:
            # parts of the same material share one object, so that a report describes it once
            found[name] = next((other for other in found.values() if other == made), made)
    if geometry is not None:
        missing = [region for region in geometry.regions if region not in values]
        if missing:
            problems.add(key, f"no material for region {', '.join(missing)}; give each region one.")
    return found


def _read_material(values: Any, key: Key, geometry: Geometry | None, problems: Problems) -> Material | Membrane | None:
    if isinstance(values, Mapping) and "law" in values:
        law = str(values["law"])
        if law not in LAWS:
            problems.add((*key, "law"), str(unknown("law", law, LAWS)))
            return None
        kind: Any = LAWS[law]
        table = read_table(law_table(kind), values, key, problems)
    else:
        table = read_table(LibraryTable, values, key, problems)
    if table is None:
        return None
    stated = isinstance(table, StatedTable)
    material = _stated(table, key, problems) if stated else _from_library(table, key, problems)
    if material is None or not _suits(material, table.thickness, key, geometry, problems):
        return None
    if table.thickness is None:
        return material
    return problems.attempt(key, lambda: Membrane(material, thickness=table.thickness), fields=("thickness",))


def _from_library(table: LibraryTable, key: Key, problems: Problems) -> Material | None:
    wrong = "record" if table.library in library() else "library"
    name = table.library
    if name.endswith(".toml"):
        name = str(Path(problems.file).parent / name)  # beside the job
    material = problems.attempt((*key, wrong), lambda: from_library(name, record=table.record))
    if material is None or table.density is None:
        return material
    return problems.attempt(key, lambda: replace(material, density=table.density), fields=("density",))


def _stated(table: Any, key: Key, problems: Problems) -> Material | None:
    kind = LAWS[table.law]
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
        )

    return problems.attempt(key, make, fields=(*(item.name for item in fields(kind)), "bulk_modulus", "density"))


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
        problems.add((*key, "thickness"), f"'{name}' is a region, and only a sheet on a face has a thickness.")
    elif name in geometry.regions and elastic:
        problems.add(key, f"'{material.name}' is linear elastic, for sheets only; a region needs a rubber's law.")
    elif name not in geometry.regions and thickness is None:
        problems.add((*key, "thickness"), f"'thickness' is missing; '{name}' is a face, and its sheet needs one.")
    else:
        return True
    return False
