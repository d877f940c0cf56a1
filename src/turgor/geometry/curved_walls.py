"""Curved thin walls of cavities that end in corners, found from the edges of a shape.

The wall over a ring sector is an arch between two webs. Pressure bends it about its corners as about hinges, so the
corners decide how far it bulges; `turgor.meshing.local_sizes` makes the cells there smaller.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from netgen.occ import Pnt, Vertex
from numpy.typing import NDArray

from turgor.geometry.geometry import Geometry

Array = NDArray[np.float64]

#: A curved wall up to this many times thicker than the thinnest one counts as thin: the mesh size suits thicker ones.
THIN = 1.5

#: An edge is straight, and two faces meet smoothly, where directions differ by less than this sine.
ALIKE = 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurvedWall:
    """Curved face of a cavity before a thin wall that ends in straight corners.

    Parameters
    ----------
    face : int
        Place of the CAD face in the list of the shape.
    name : str
        Its name.
    thickness : float [m]
        Thickness of the wall where it is thickest: at its corners or in its middle.
    corners : (c, 2, 3) array [m]
        Ends of the straight edges where the curved face meets another face of the cavity at an angle.
    """

    face: int
    name: str
    thickness: float
    corners: Array


def find_curved_walls(geometry: Geometry) -> tuple[CurvedWall, ...]:
    """Find the curved thin walls of cavities that end in straight corners.

    Tubes have none, because their walls close on themselves, and fillets have none, because they meet smoothly.

    Parameters
    ----------
    geometry : Geometry

    Returns
    -------
    tuple of CurvedWall

    Examples
    --------
    >>> from turgor.geometry import ExtendingCylinder, OmnidirectionalActuator
    >>> sectors = OmnidirectionalActuator(chamber_shape="ring_sector", symmetric=True).build()
    >>> [(wall.name, len(wall.corners), round(wall.thickness * 1e3, 6)) for wall in find_curved_walls(sectors)]
    [('cavity_1', 1, 2.0), ('cavity_2', 2, 2.0)]
    >>> find_curved_walls(ExtendingCylinder().build())
    ()
    """
    faces = list(geometry._shape.faces)
    cavities = [i for i, face in enumerate(faces) if str(face.name).startswith("cavity")]
    owners: dict[Any, list[int]] = {}
    for i in cavities:
        for edge in dict.fromkeys(faces[i].edges):
            owners.setdefault(edge, []).append(i)
    shared = {edge: pair for edge, pair in owners.items() if len(pair) == 2 and _is_straight(edge)}
    walls = []
    for i in cavities:
        edges = [edge for edge, pair in shared.items() if i in pair]
        if not edges or not _is_curved(faces[i]):
            continue
        edges = [edge for edge in edges if _meet_at_an_angle(edge, *(faces[k] for k in shared[edge]))]
        thickness = _thickness(faces, i, edges) * geometry.length_scale
        if edges and thickness <= THIN * geometry.smallest_wall:
            corners = np.array([[_xyz(edge.start), _xyz(edge.end)] for edge in edges]) * geometry.length_scale
            walls.append(CurvedWall(face=i, name=str(faces[i].name), thickness=thickness, corners=corners))
    return tuple(walls)


def _xyz(point: Any) -> Array:
    return np.array([point.x, point.y, point.z], dtype=np.float64)


def _samples(edge: Any) -> tuple[Array, Array]:
    """Points along an edge and unit tangents there, (5, 3) each."""
    at = np.linspace(*edge.parameter_interval, 5)
    tangents = np.array([_xyz(edge.Tangent(s)) for s in at])
    length = np.linalg.norm(tangents, axis=1, keepdims=True)
    return np.array([_xyz(edge.Value(s)) for s in at]), tangents / np.where(length > 0, length, 1.0)


def _is_straight(edge: Any) -> bool:
    _, tangents = _samples(edge)
    return bool(np.linalg.norm(np.cross(tangents[0], tangents), axis=1).max() < ALIKE)


def _is_curved(face: Any) -> bool:
    """Whether the rim of a face lies in no plane."""
    points = np.concatenate([_samples(edge)[0] for edge in dict.fromkeys(face.edges)])
    depth = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(depth[2] > 1e-6 * depth[0])


def _meet_at_an_angle(edge: Any, one: Any, other: Any) -> bool:
    """Whether two faces fold at their common straight edge: neither continues the other smoothly."""
    into = [_into(face, edge) for face in (one, other)]
    return all(len(d) for d in into) and bool(np.linalg.norm(np.cross(*into)) > ALIKE)


def _into(face: Any, edge: Any) -> Array:
    """Direction in which a face leaves the start of one of its straight edges, square to the edge; empty if unknown."""
    corner, along = _xyz(edge.start), _xyz(edge.end) - _xyz(edge.start)
    along /= np.linalg.norm(along)
    for neighbor in dict.fromkeys(face.edges):
        if neighbor == edge:
            continue
        points, tangents = _samples(neighbor)
        reach = 1e-6 * max(1.0, float(np.linalg.norm(points[-1] - points[0])))
        for end, sign in ((0, 1.0), (-1, -1.0)):
            if np.linalg.norm(points[end] - corner) < reach:
                across = sign * (tangents[end] - (tangents[end] @ along) * along)
                length = np.linalg.norm(across)
                return np.asarray(across / length) if length > ALIKE else np.zeros(0)
    return np.zeros(0)


def _thickness(faces: list[Any], i: int, corners: list[Any]) -> float:
    """Distance from a cavity to the outside or the next cavity, the largest of corners and arcs [CAD units]."""
    beyond = [f for f in faces if f.name == "outside" or (str(f.name).startswith("cavity") and f.name != faces[i].name)]
    arcs = [_samples(edge)[0][2] for edge in dict.fromkeys(faces[i].edges) if not _is_straight(edge)]
    places = [*corners, *(Vertex(Pnt(*middle)) for middle in arcs)]
    return max(min((float(place.Distance(face)) for face in beyond), default=float("inf")) for place in places)
