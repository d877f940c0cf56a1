"""Parts of a CAD shape: vertices, curves and surfaces with their incidence, in the order in which it was built."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.core.meshing.moving.curves import Curve, curve_of
from turgor.core.meshing.moving.surfaces import Surface, surface_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """Vertices, edges and faces of a CAD shape, each once; those that two bodies share as well.

    Parameters
    ----------
    vertices : (v, 3) array [m]
    curves : tuple of Curve
        Of the edges.
    ends : tuple of tuple of int
        Vertices of each edge; one for a closed edge.
    surfaces : tuple of Surface
        Of the faces.
    rims : tuple of frozenset of int
        Edges of each face, its seam included.
    names : tuple of str
        Of the faces.
    """

    vertices: Array
    curves: tuple[Curve, ...]
    ends: tuple[tuple[int, ...], ...]
    surfaces: tuple[Surface, ...]
    rims: tuple[frozenset[int], ...]
    names: tuple[str, ...]


def parts_of(geometry: Geometry) -> Parts:
    """Read the parts of the CAD shape of a geometry.

    Parameters
    ----------
    geometry : Geometry

    Returns
    -------
    Parts

    Raises
    ------
    TurgorError
        If it has no CAD shape, because it was given by facets or a mesh.
    """
    shape, scale = geometry._cad, geometry.length_scale
    if not hasattr(shape, "WriteBrep"):
        raise TurgorError(
            f"'{geometry.name}' is given by facets or a mesh, not by CAD faces that nodes of tetrahedra could follow."
        )
    vertices = _numbers(shape.vertices)
    edges = _numbers(edge for edge in shape.edges if edge.mass > TOLERANCE.length)
    faces = list(dict.fromkeys(shape.faces))
    return Parts(
        vertices=np.array([(each.p.x, each.p.y, each.p.z) for each in vertices]) * scale,
        curves=tuple(curve_of(edge, scale) for edge in edges),
        ends=tuple(_ends(edge, vertices) for edge in edges),
        surfaces=tuple(surface_of(face, scale) for face in faces),
        rims=tuple(frozenset(edges[edge] for edge in face.edges if edge in edges) for face in faces),
        names=tuple(str(face.name) for face in faces),
    )


def _numbers(parts: Any) -> dict[Any, int]:
    """Number of each part; the same part may come several times."""
    return {part: number for number, part in enumerate(dict.fromkeys(parts))}


def _ends(edge: Any, vertices: dict[Any, int]) -> tuple[int, ...]:
    """Vertices of an edge in the direction of its parameter."""
    ends = list(dict.fromkeys(edge.vertices))
    start = edge.Value(edge.parameter_interval[0])
    away = [sum((getattr(each.p, axis) - getattr(start, axis)) ** 2 for axis in "xyz") for each in ends]
    return tuple(vertices[each] for each in (ends if away[0] <= away[-1] else ends[::-1]))
