"""Shapes: the picture of an actuator from its dimensions or its file, without a mesh, and its size and volumes."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.inspection import Inspection, inspect_here
from turgor.core.geometry.cad.parametric.drawn import part_file
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.model.obstacles import Obstacle
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.job.tables.cad import CAD_FILE
from turgor.job.tables.contact import read_contact
from turgor.job.tables.materials import read_materials
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import Problems
from turgor.studio.tasks.building import built
from turgor.studio.tasks.content import actuator_in, content_of, noted, plain
from turgor.studio.tasks.forms import form_of_actuator
from turgor.studio.tasks.patches import patches_of, patches_of_file
from turgor.units import format_quantity, mm


def shape_of(file: Path, modeled: bool = False) -> dict[str, Any]:
    """Return what the page shows of the shape of a job.

    Parameters
    ----------
    file : Path
        A job; only its table ``[actuator]`` must be right.
    modeled : bool
        Whether a CAD file is shown as it is modeled, along our axes; else as it lies in the file, where it is named.

    Returns
    -------
    dict
        ``problems`` by key; ``form`` and ``content`` of the job; and, where the shape could be made, its ``scene``,
        ``facts`` and ``faces``.
    """
    content, problems = content_of(file)
    table = actuator_in(content)
    out: dict[str, Any] = {"content": plain(content), "kind": table.get("type"), "form": None, "problems": []}
    try:
        out |= _drawn(table, content, problems, modeled)
    except TurgorError as error:
        problems.add(("actuator",), error.on_command_line)
    out["problems"] = noted(problems)
    out["form"] = form_of_actuator(table)
    return out


def _drawn(table: dict[str, Any], content: dict[str, Any], problems: Problems, modeled: bool) -> dict[str, Any]:
    if table.get("type") == CAD_FILE and not modeled:
        actuator = read_actuator(table, problems)
        return _of_file(actuator) if isinstance(actuator, CadFile) else {}
    shape = built(table, problems)
    if shape is None:
        return {}
    patches = patches_of(shape)
    copies = len(patches.images)
    facts = {
        "size": np.ptp(patches.box(), axis=0).tolist(),
        "wall": shape.smallest_wall,
        "cavities": {name: volume * copies for name, volume in shape.cavity_volumes.items()},
        "volume": shape.solid_volume * copies,
        "mass": _mass(shape, content, copies),
    }
    obstacles = _obstacles(content, shape)
    return {"scene": patches.scene(obstacles), "facts": facts, "faces": [], "findings": _sentences(shape.findings)}


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


def _obstacles(content: dict[str, Any], shape: Geometry) -> tuple[Obstacle, ...]:
    """The obstacles that are right; what is wrong with others is said on the screen Loads."""
    contact, _ = read_contact({}, content.get("obstacles", {}), shape, Problems("", {}))
    return contact.obstacles


def _of_file(actuator: CadFile) -> dict[str, Any]:
    """A CAD file: the whole part with all its faces, each with a selector that picks it."""
    part = _inspected(_Named(actuator))
    patches = patches_of_file(part, actuator.axes)
    in_file = Counter(face.name_in_file for face in part.faces)
    faces = [
        {
            "name": face.name,
            "area": face.area,
            "color": face.color,
            "selector": {"name": face.name_in_file}
            if face.name_in_file and in_file[face.name_in_file] == 1
            else {"near": _point_on(patch.triangles)},
        }
        for face, patch in zip(part.faces, patches.faces, strict=True)
    ]
    facts = {
        "size": np.ptp(patches.box(), axis=0).tolist(),
        "wall": part.smallest_wall,
        "cavities": {cavity.name: cavity.volume for cavity in part.cavities},
        "bodies": [{"name": body.region, "volume": body.volume, "color": body.color} for body in part.bodies],
        "volume": sum(body.volume for body in part.bodies),
        "mass": None,
    }
    return {"scene": patches.scene(), "facts": facts, "faces": faces, "findings": _sentences(part.findings)}


@dataclass(frozen=True, slots=True)
class _Named:
    """A CAD file with its names; equal ones are looked through once."""

    actuator: CadFile

    @property
    def _key(self) -> str:
        given = self.actuator
        drawn = (given.sha256, given.function, given.dimensions)
        return repr((drawn, given.unit, given.faces, given.regions, given.split))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Named) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@lru_cache(maxsize=4)
def _inspected(named: _Named) -> Inspection:
    """Look through a file in this process: it is a child of the server, and may crash."""
    given = named.actuator
    with part_file(given.file, given.function, given.dimensions, given.unit) as path:
        return inspect_here(path, given.unit, dict(given.faces), dict(given.regions), given.split)


def _point_on(triangles: NDArray[np.float64]) -> list[str]:
    """A point on a face, to the thousandth of a millimeter: the middle of its largest triangle."""
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    middle = triangles[int(area.argmax())].mean(axis=0)
    return [format_quantity(round(float(value) / mm, 3) * mm, "mm") for value in middle]


def _sentences(findings: Iterable[Finding]) -> list[str]:
    return [f"{each.message} {each.advice}".strip() for each in findings]
