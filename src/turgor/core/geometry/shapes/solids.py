"""Boxes, booleans, names and volumes of the CAD kernel netgen.occ, for the actuators."""

from collections.abc import Collection, Mapping, Sequence
from functools import reduce
from operator import add, sub
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.shapes.tolerances import TOLERANCE

Range = tuple[float, float]


def box(x: Range, y: Range, z: Range) -> Any:
    """Make a box from its ranges in meters."""
    scale = METERS_PER_CAD_UNIT
    return occ.Box(occ.Pnt(x[0] / scale, y[0] / scale, z[0] / scale), occ.Pnt(x[1] / scale, y[1] / scale, z[1] / scale))


def union(shapes: Sequence[Any]) -> Any:
    """Fuse shapes into one."""
    return reduce(add, shapes)


def cut(shape: Any, tools: Sequence[Any]) -> Any:
    """Subtract shapes from a shape."""
    return reduce(sub, tools, shape)


def glue(regions: Mapping[str, Any]) -> Any:
    """Join solids so that they share the faces where they touch; each keeps its name as a region."""
    for name, shape in regions.items():
        shape.mat(name)
    return occ.Glue(list(regions.values()))


def name_plane(shape: Any, axis: int, position: float, name: str, keep: Collection[str] = ()) -> None:
    """Name all faces that lie in the plane where coordinate ``axis`` is ``position`` [m], but those named ``keep``."""
    for face in shape.faces:
        if face.name not in keep and in_plane(face, axis, position):
            face.name = name


def in_plane(face: Any, axis: int, position: float) -> bool:
    """Whether a face lies in the plane where coordinate ``axis`` is ``position`` [m]."""
    away = (abs(corner[axis] - position / METERS_PER_CAD_UNIT) for corner in face.bounding_box)
    return bool(max(away) <= TOLERANCE.length)


def name_rest(shape: Any, name: str) -> None:
    """Name all faces that have no name yet."""
    for face in shape.faces:
        if not face.name:
            face.name = name


def face_names(shape: Any) -> tuple[str, ...]:
    """List the names of the faces, sorted."""
    return tuple(sorted({face.name for face in shape.faces}))


def region_names(shape: Any) -> tuple[str, ...]:
    """List the names of the solids in their order."""
    return tuple(dict.fromkeys(solid.name for solid in shape.solids))


def volume(shape: Any) -> float:
    """Volume of all solids of a shape [m³]."""
    return float(sum(solid.mass for solid in shape.solids)) * METERS_PER_CAD_UNIT**3
