"""Part starters: a commented job for a part from a CAD file or a mesh file, with the names that it needs."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.files import SUFFIXES
from turgor.core.geometry.cad.inspection import FaceFacts, Inspection, inspect_cad
from turgor.core.geometry.cad.parametric.drawn import PARAMETRIC, part_file
from turgor.core.geometry.cad.parametric.file_table import read_file_table
from turgor.core.geometry.cad.parametric.parameter import Stated
from turgor.core.geometry.cad.selectors import Selector, WithNormal
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.core.meshing.exchange.read import READERS
from turgor.foundation.display import MOST_ROWS
from turgor.foundation.errors import TurgorError
from turgor.job.reference.kinds import Kind
from turgor.job.reference.sections import file_tables
from turgor.job.reference.starters import commented, first_materials
from turgor.job.reference.tables import toml
from turgor.job.tables.cad import CAD_FILE
from turgor.job.tables.mesh_files import MESH_FILE
from turgor.units import mm

#: Endings of files that hold a part.
PART_ENDINGS = (*SUFFIXES, *PARAMETRIC, *READERS)

#: A plane face is at the end of a part if it is this near to it, relative to the length of the part.
AT_THE_END = 0.02

#: Names that supports and measures of a job need, and the end of the longest side at which each is looked for.
ENDS = {"fixed": "-", "tip": "+"}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """A part in a job file: its lines of comment, its table, and the part itself."""

    comment: Sequence[str]
    kind: str
    ends: Mapping[str, str]
    shape: Geometry
    dimensions: Mapping[str, Stated] = field(default_factory=dict)


def is_part(name: str) -> bool:
    """Whether a name is that of a file that may hold a part, by its ending.

    Examples
    --------
    >>> is_part("finger.STL"), is_part("fast_pneunet")
    (True, False)
    """
    return Path(name).suffix.lower() in PART_ENDINGS


def part_starter(file: Path, folder: Path, unit: str | None = None) -> str:
    """Write a commented job for a part: its faces in comments, its ends chosen, every key with its default.

    Parameters
    ----------
    file : Path
        CAD file, script that draws a part, table of CAD files, or mesh file.
    folder : Path
        Where the job will lie; the path of the part counts from there.
    unit : str, optional
        Unit of the numbers in the file.

    Returns
    -------
    str
        TOML.

    Raises
    ------
    TurgorError
        If the file cannot be read.
    """
    part = _mesh_part(file, unit) if file.suffix.lower() in READERS else _cad_part(file, unit)
    faces = {name: {"normal": normal} for name, normal in part.ends.items()}
    table = {
        "type": part.kind,
        "file": _from(folder, file),
        "unit": unit,
        "faces": faces,
        "dimensions": part.dimensions,
    }
    lines = [f"{key} = {toml(value, Kind(words=''))}" for key, value in table.items() if value]
    head = [f"A job for {file.name}, to begin with: choose your material; check which faces are fixed and measured."]
    text = "".join(f"# {line}\n" for line in (*head, *part.comment))
    text += "\n".join(["[actuator]", *lines, "", first_materials(part.shape), _loads(part.shape), ""])
    return commented(text, part.shape, file_tables()[part.kind])


def _cad_part(file: Path, unit: str | None) -> _Part:
    dimensions = read_file_table(file).first if file.suffix.lower() == ".csv" else {}  # a script has defaults
    with part_file(file, stated=dimensions, unit=unit) as drawn:
        inspection = inspect_cad(drawn, unit=unit)
    axis = int(np.argmax(inspection.size))
    ends = {name: f"{sign}{'xyz'[axis]}" for name, sign in ENDS.items() if _has_end(inspection, axis, sign, name)}
    chosen: dict[str, Selector] = {name: WithNormal(normal) for name, normal in ends.items()}  # type: ignore[arg-type]
    shape = CadFile(file=file, dimensions=dimensions, unit=unit, faces=chosen).build()
    size = " x ".join(f"{side / mm:.4g}" for side in inspection.size)
    comment = [f"It measures {size} mm (unit {inspection.unit}). `turgor inspect {file.name}` says more."]
    comment += _listed(inspection.faces)
    return _Part(comment=comment, kind=CAD_FILE, ends=ends, shape=shape, dimensions=dimensions)


def _has_end(inspection: Inspection, axis: int, sign: str, name: str) -> bool:
    """Whether a part has a plane face at an end of an axis, and no face of the name already."""
    if any(name in (face.name, face.name_in_file) for face in inspection.faces):
        return False
    outward = np.eye(3)[axis] * (1 if sign == "+" else -1)
    out = [body.high if sign == "+" else body.low for body in inspection.bodies]
    end = max(float(outward @ corner) for corner in out)
    plane = [face for face in inspection.faces if face.normal is not None and outward @ face.normal > 1 - 1e-6]
    return any(end - float(outward @ face.center) < AT_THE_END * inspection.size[axis] for face in plane)


def _listed(faces: Sequence[FaceFacts]) -> list[str]:
    """A line for each of the largest faces: a scanned part has hundreds."""
    largest = sorted(faces, key=lambda face: -face.area)[:MOST_ROWS]
    remaining = len(faces) - len(largest)
    lines = ["Its faces, the largest first: name, area [mm²], center [mm], normal."]
    for face in largest:
        normal = "curved" if face.normal is None else _numbers(face.normal)
        center = _numbers([part / mm for part in face.center])
        name = face.name_in_file or face.name
        lines.append(f"  {name:12} {face.area / mm**2:10.4g}  {center:24} {normal}")
    return [*lines, f"  … and {remaining} smaller ones"] if remaining else lines


def _numbers(values: Sequence[float]) -> str:
    return toml([round(value, 3) + 0.0 for value in values], Kind(words=""))


def _mesh_part(file: Path, unit: str | None) -> _Part:
    mesh = MeshFile(file=file, unit=unit).read()
    axis = int(np.argmax(np.ptp(mesh.points, axis=0)))
    ends: dict[str, str] = {}
    for name, sign in ENDS.items():
        if not mesh.symmetry_faces and name not in mesh.faces and _picks(file, unit, name, f"{sign}{'xyz'[axis]}"):
            ends[name] = f"{sign}{'xyz'[axis]}"
    chosen: dict[str, Selector] = {name: WithNormal(normal) for name, normal in ends.items()}  # type: ignore[arg-type]
    shape = MeshFile(file=file, unit=unit, faces=chosen).build()
    size = " x ".join(f"{side / mm:.4g}" for side in np.ptp(mesh.points, axis=0))
    comment = [
        f"It measures {size} mm and has {mesh.counts}.",
        f"Its regions: {', '.join(mesh.regions)}. Its faces: {', '.join(mesh.faces)}.",
    ]
    return _Part(comment=comment, kind=MESH_FILE, ends=ends, shape=shape)


def _picks(file: Path, unit: str | None, name: str, normal: str) -> bool:
    """Whether a mesh has plane sides with a normal."""
    try:
        MeshFile(file=file, unit=unit, faces={name: WithNormal(normal)}).read()  # type: ignore[arg-type]
    except TurgorError:
        return False
    return True


def _loads(shape: Geometry) -> str:
    """A small pressure in every cavity; the weight of a part without one."""
    cavities = list(shape.cavity_volumes)
    if len(cavities) == 1:
        return '[loads]\npressure = "1 kPa"'
    if cavities:
        return "\n\n".join(f'[loads.{name}]\npressure = "1 kPa"' for name in cavities)
    return '[loads.gravity]\ndirection = "-z"'


def _from(folder: Path, file: Path) -> str:
    """Path of a file from a folder."""
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # on another drive
        return file.resolve().as_posix()
