"""Shapes: the picture of an actuator from its dimensions or its file, without a mesh, and its size and volumes."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.inspection import Inspection, inspect_here
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.job.job import Actuator
from turgor.job.tables.cad import CAD_FILE
from turgor.job.tables.materials import read_materials
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import Problems
from turgor.studio.tasks.content import content_of, noted, plain, table_in
from turgor.studio.tasks.forms import form_of_actuator
from turgor.studio.tasks.patches import patches_of, patches_of_file
from turgor.units import format_quantity, mm


def shape_of(file: Path) -> dict[str, Any]:
    """Return what the page shows of the shape of a job.

    Parameters
    ----------
    file : Path
        A job; only its table ``[actuator]`` must be right.

    Returns
    -------
    dict
        ``problems`` by key; ``form`` and ``content`` of the job; and, where the shape could be made, its ``scene``,
        ``facts`` and ``faces``.
    """
    content, problems = content_of(file)
    table = table_in(content, "actuator")
    out: dict[str, Any] = {"content": plain(content), "kind": table.get("type"), "form": None, "problems": []}
    try:
        out |= _drawn(table, content, problems)
    except TurgorError as error:
        problems.add(("actuator",), error.on_command_line)
    out["problems"] = noted(problems)
    out["form"] = form_of_actuator(table if not out["problems"] else {"type": table.get("type")})
    return out


def built(table: Mapping[str, Any], problems: Problems) -> Geometry | None:
    """Return the geometry of a table ``[actuator]``; None where it is wrong, which is noted."""
    actuator = read_actuator(table, problems)
    if actuator is None:
        return None
    make = actuator.build if isinstance(actuator, CadFile | MeshFile) else partial(_of_family, actuator)
    return problems.attempt(("actuator",), make)


@lru_cache(maxsize=8)
def _of_family(actuator: Actuator) -> Geometry:
    """Build a family once: the screens of the page ask for it one after another."""
    return actuator.build()


def _drawn(table: dict[str, Any], content: dict[str, Any], problems: Problems) -> dict[str, Any]:
    if table.get("type") == CAD_FILE:
        actuator = read_actuator(table, problems)
        return _of_file(actuator) if isinstance(actuator, CadFile) else {}
    shape = built(table, problems)
    if shape is None:
        return {}
    patches = patches_of(shape)
    copies = len(patches.images)
    facts = {
        "size": patches.size(),
        "wall": shape.smallest_wall,
        "cavities": {name: volume * copies for name, volume in shape.cavity_volumes.items()},
        "volume": shape.solid_volume * copies,
        "mass": _mass(shape, content, copies),
    }
    return {"scene": patches.scene(), "facts": facts, "faces": [], "findings": _sentences(shape.findings)}


def _mass(shape: Geometry, content: dict[str, Any], copies: int) -> float | None:
    """Mass of the whole [kg], where the density of every region is known."""
    materials = read_materials(content.get("materials", {}), shape, Problems("", {}))
    density = {name: each.density for name, each in materials.items() if isinstance(each, Material)}
    volumes = {str(solid.name): 0.0 for solid in getattr(shape._cad, "solids", ())} or dict.fromkeys(shape.regions, 0.0)
    if len(volumes) == 1:
        volumes = dict.fromkeys(volumes, shape.solid_volume)
    else:
        for solid in getattr(shape._cad, "solids", ()):
            volumes[str(solid.name)] += float(solid.mass) * shape.length_scale**3
    parts = [(volume, density.get(name)) for name, volume in volumes.items()]
    if any(each is None or not volume for volume, each in parts):
        return None
    return copies * sum(volume * each for volume, each in parts if each is not None)


def _of_file(actuator: CadFile) -> dict[str, Any]:
    """A CAD file: the whole part with all its faces, each with a selector that picks it."""
    found = _inspected(_Named(actuator))
    patches = patches_of_file(found, actuator.axes)
    in_file = Counter(face.name_in_file for face in found.faces)
    faces = [
        {
            "name": face.name,
            "area": face.area,
            "color": face.color,
            "selector": {"name": face.name_in_file}
            if face.name_in_file and in_file[face.name_in_file] == 1
            else {"near": _point_on(patch.triangles)},
        }
        for face, patch in zip(found.faces, patches.faces, strict=True)
    ]
    facts = {
        "size": patches.size(),
        "wall": found.smallest_wall,
        "cavities": {cavity.name: cavity.volume for cavity in found.cavities},
        "volume": sum(body.volume for body in found.bodies),
        "mass": None,
    }
    return {"scene": patches.scene(), "facts": facts, "faces": faces, "findings": _sentences(found.findings)}


@dataclass(frozen=True, slots=True)
class _Named:
    """A CAD file with its names; equal ones are looked through once."""

    actuator: CadFile

    @property
    def _key(self) -> str:
        given = self.actuator
        return repr((given.sha256, given.unit, given.faces, given.regions, given.split))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Named) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@lru_cache(maxsize=4)
def _inspected(named: _Named) -> Inspection:
    """Look through a file in this process: it is a child of the server, and may crash."""
    given = named.actuator
    return inspect_here(given.file, given.unit, dict(given.faces), dict(given.regions), given.split)


def _point_on(triangles: NDArray[np.float64]) -> list[str]:
    """A point on a face, to the thousandth of a millimeter: the middle of its largest triangle."""
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    middle = triangles[int(area.argmax())].mean(axis=0)
    return [format_quantity(round(float(value) / mm, 3) * mm, "mm") for value in middle]


def _sentences(findings: Iterable[Finding]) -> list[str]:
    return [f"{each.message} {each.advice}".strip() for each in findings]
