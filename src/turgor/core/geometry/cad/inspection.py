"""Inspection of a CAD file: its bodies, faces and cavities."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.colors import hexadecimal
from turgor.core.geometry.cad.files import check_file, reading
from turgor.core.geometry.cad.naming import Naming, name_faces, scaled
from turgor.core.geometry.cad.part import Part, as_vector, load_part
from turgor.core.geometry.cad.selectors import Selector
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.cad.symmetry.facet_cut import facet_symmetry
from turgor.core.geometry.cad.symmetry.find import find_symmetry
from turgor.core.geometry.cad.walls import smallest_wall
from turgor.core.geometry.child_process import in_child
from turgor.core.geometry.directions import Vector
from turgor.foundation.display import brief
from turgor.foundation.finding import Finding
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyFacts:
    """One body: region, color as ``#rrggbb`` or empty, volume [m³] and bounding box [m]."""

    region: str
    color: str
    volume: float
    low: Vector
    high: Vector


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FaceFacts:
    """One face: its name, name and color in the file, area [m²], center [m], and normal of a plane face.

    ``between`` says whether it lies between two bodies; ``triangles`` (t, 3, 3) [m] are for pictures.
    """

    name: str
    name_in_file: str
    color: str
    area: float
    center: Vector
    normal: Vector | None
    between: bool = False
    triangles: Array = field(repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class CavityFacts:
    """One cavity: name, whether it is closed, volume [m³], and (area [m²], center [m]) of each opening."""

    name: str
    closed: bool
    volume: float
    openings: tuple[tuple[float, Vector], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspection:
    """Content of a CAD file.

    Parameters
    ----------
    name : str
        File name.
    unit : str
        Unit of its numbers, and where it is stated.
    size : (3,) tuple [m]
        Sides of the bounding box.
    smallest_wall : float [m]
        Thickness that 99 % of its walls exceed.
    bodies, faces, cavities : tuples
        Facts about its parts.
    findings : tuple of Finding
        Findings about cavities and names.
    symmetry : str
        Mirror planes and rotations that map the part onto itself, in words; empty for a part that is given by facets.
    """

    name: str
    unit: str
    size: Vector
    smallest_wall: float
    bodies: tuple[BodyFacts, ...]
    faces: tuple[FaceFacts, ...]
    cavities: tuple[CavityFacts, ...]
    findings: tuple[Finding, ...]
    symmetry: str = ""

    __repr__ = brief


def inspect_cad(
    path: str | Path,
    *,
    unit: str | float | None = None,
    faces: Mapping[str, Selector] | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
) -> Inspection:
    """Read a CAD file and return its bodies, faces and cavities; arguments and names are those of `read_cad`.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3, symmetric=False).build()
    >>> with TemporaryDirectory() as folder:
    ...     finger.shape.WriteStep(str(Path(folder) / "finger.step"))
    ...     found = inspect_cad(Path(folder) / "finger.step")
    >>> [(body.region, round(body.volume * 1e9)) for body in found.bodies]
    [('body', 3077), ('base', 600)]
    >>> [(cavity.name, cavity.closed, round(cavity.volume * 1e9)) for cavity in found.cavities]
    [('cavity', True, 2098)]
    """
    check_file(path, unit)
    return in_child(reading(path), inspect_here, Path(path), unit, dict(faces or {}), dict(regions or {}), split)


def inspect_here(
    path: Path,
    unit: str | float | None = None,
    faces: Mapping[str, Selector] | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
) -> Inspection:
    """Look through a CAD file as `inspect_cad`, but in this process, which the CAD kernel may crash."""
    part = load_part(path, unit, regions or {}, split)
    naming = name_faces(part, faces or {}, split.interface if split is not None else None)
    low, high = part.facets.points.min(axis=0), part.facets.points.max(axis=0)
    return Inspection(
        name=path.name,
        unit=part.file.unit,
        size=as_vector((high - low) * mm),
        smallest_wall=smallest_wall(part.facets) * mm,
        bodies=_bodies(part),
        faces=_faces(part, naming),
        cavities=_cavities(naming),
        findings=(*part.file.findings, *naming.findings),
        symmetry=str((facet_symmetry if isinstance(part.shape, SurfaceShape) else find_symmetry)(part, naming.names)),
    )


def _bodies(part: Part) -> tuple[BodyFacts, ...]:
    number = {face: i for i, face in enumerate(part.faces)}
    solids = [part.shape] if isinstance(part.shape, SurfaceShape) else list(part.shape.solids)
    bodies = []
    for body, region in zip(solids, part.regions, strict=True):
        own = [part.items[number[face]] for face in body.faces]
        color = Counter(item.color for item in own).most_common(1)[0][0]
        corners = np.concatenate([item.triangles.reshape(-1, 3) for item in own])
        bodies.append(
            BodyFacts(
                region=region,
                color=hexadecimal(color) if color is not None else "",
                volume=float(body.mass) * mm**3,
                low=as_vector(corners.min(axis=0)),
                high=as_vector(corners.max(axis=0)),
            )
        )
    return tuple(bodies)


def _faces(part: Part, naming: Naming) -> tuple[FaceFacts, ...]:
    return tuple(
        FaceFacts(
            name=name,
            name_in_file=item.name,
            color=hexadecimal(item.color) if item.color is not None else "",
            area=float(face.mass) * mm**2,
            center=item.center,
            normal=item.normal,
            between=len(owners) > 1,
            triangles=item.triangles,
        )
        for name, item, face, owners in zip(naming.names, part.items, part.faces, part.owners, strict=True)
    )


def _cavities(naming: Naming) -> tuple[CavityFacts, ...]:
    measured = {name: scaled(hollow) for name, hollow in naming.cavities.items()}
    return tuple(
        CavityFacts(
            name=name,
            closed=not hollow.openings,
            volume=hollow.volume,
            openings=tuple((opening.area, as_vector(opening.center)) for opening in hollow.openings),
        )
        for name, hollow in measured.items()
    )
