"""Corners of cavities about which thin walls bend, detected from the edges of a shape.

The wall over a ring sector is an arch between two webs, the wall over a long box a plate between two others. Pressure
bends them about the corners as about hinges, so the mesh at the corners determines how far they bulge;
`turgor.core.meshing.sizing.local_sizes` makes the cells there smaller.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry import occ
from turgor.core.geometry.geometry import Geometry

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ThinCornerSettings:
    """Which corners of cavities need small cells; `test_thin_corners` needs the numbers.

    Parameters
    ----------
    thin : float
        A wall up to this many times thicker than the thinnest one counts as thin: the mesh size suits thicker ones.
    long : float
        Between flat walls, a corner counts where it is this many times longer than the thinnest wall is thick. The
        corners of chambers of PneuNets are shorter; there are many, and the default size is within 1 % without smaller
        cells. A layer of a sweep that is this long belongs to a tube.
    sharp : float
        Faces meet at a sharp edge, and an edge is curved, where directions differ by more than this sine.
    """

    thin: float = 1.5
    long: float = 20.0
    sharp: float = 0.1


THIN_CORNERS = ThinCornerSettings()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThinCorners:
    """Corners of one cavity about which thin walls bend.

    Parameters
    ----------
    name : str
        Name of the cavity.
    curved : tuple of int
        Places of its curved faces before thin walls, in the list of faces of the shape.
    lines : (c, 2, 3) array [m]
        Ends of the corners, which are straight.
    folded : tuple of int
        Places of its curved faces that meet another one in a sharp curved edge at a thin wall: the folds of bellows.
    """

    name: str
    curved: tuple[int, ...]
    lines: Array
    folded: tuple[int, ...] = ()


def find_thin_corners(geometry: Geometry) -> tuple[ThinCorners, ...]:
    """Find the straight corners of cavities with four-sided faces where a thin curved wall ends or long flat ones meet.

    Tubes have none, because their walls close on themselves; fillets have none, because they meet their walls smoothly.
    Bellows with sharp folds have folded faces.

    Parameters
    ----------
    geometry : Geometry

    Returns
    -------
    tuple of ThinCorners
        One for each cavity that has some.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
    >>> from turgor.core.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator
    >>> sectors = OmnidirectionalActuator(chamber_shape="ring_sector", symmetric=True).build()
    >>> [(found.name, len(found.curved), len(found.lines)) for found in find_thin_corners(sectors)]
    [('cavity_1', 2, 4), ('cavity_2', 1, 7)]
    >>> find_thin_corners(ExtendingCylinder().build())
    ()
    """
    faces, scale = list(geometry._cad.faces), geometry.length_scale
    thin, thin_corners = THIN_CORNERS.thin * geometry.smallest_wall / scale, []
    for name in geometry.cavity_volumes:
        walls = _Walls(faces=faces, name=name, thin=thin)
        corners = walls.corners()
        curved = tuple(sorted({i for pair in corners.values() for i in pair if walls.is_thin_and_curved(i)}))
        chosen = [edge for edge, pair in corners.items() if set(pair) & set(curved)]
        long = [
            pair for edge, pair in corners.items() if edge.mass >= THIN_CORNERS.long * geometry.smallest_wall / scale
        ]
        flat = {i for pair in long for i in pair}
        chosen += [edge for edge, pair in corners.items() if edge not in chosen and set(pair) & flat]
        folded = walls.folded()
        if chosen or folded:
            lines = np.array([[_xyz(edge.start), _xyz(edge.end)] for edge in chosen]).reshape(-1, 2, 3) * scale
            thin_corners.append(ThinCorners(name=name, curved=curved, lines=lines, folded=folded))
    return tuple(thin_corners)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Walls:
    """Walls of one cavity of a shape; they are thin up to a thickness [CAD units]."""

    faces: list[Any]
    name: str
    thin: float

    def corners(self) -> dict[Any, tuple[int, ...]]:
        """Return the straight sharp edges between two four-sided faces of the cavity at thin walls, and these faces."""
        pairs = self._pairs(lambda i: len(dict.fromkeys(self.faces[i].edges)) == 4)
        return {edge: pair for edge, pair in pairs.items() if _is_straight(edge) and self._folds(edge, pair)}

    def folded(self) -> tuple[int, ...]:
        """Return the curved faces of the cavity that meet in sharp curved edges at thin walls."""
        pairs = self._pairs(self._is_curved)
        folds = [pair for edge, pair in pairs.items() if not _is_straight(edge) and self._folds(edge, pair)]
        return tuple(sorted({i for pair in folds for i in pair}))

    def _pairs(self, chosen: Callable[[int], bool]) -> dict[Any, tuple[int, ...]]:
        """Edges between two faces of the cavity, and these faces, where both are chosen."""
        owners: dict[Any, list[int]] = {}
        for i, face in enumerate(self.faces):
            if face.name == self.name and chosen(i):
                for edge in dict.fromkeys(face.edges):
                    owners.setdefault(edge, []).append(i)
        return {edge: tuple(pair) for edge, pair in owners.items() if len(pair) == 2}

    def _folds(self, edge: Any, pair: tuple[int, ...]) -> bool:
        return _fold(edge, *(self.faces[i] for i in pair)) and self._is_thin_at(edge)

    def is_thin_and_curved(self, i: int) -> bool:
        """Return whether a face is curved and its wall is thin in the middle of its arcs."""
        if not self._is_curved(i):
            return False
        middles = [_samples(edge)[0][2] for edge in dict.fromkeys(self.faces[i].edges) if not _is_straight(edge)]
        return all(self._is_thin_at(occ.Vertex(occ.Pnt(*middle))) for middle in middles)

    def _is_curved(self, i: int) -> bool:
        points = np.concatenate([_samples(edge)[0] for edge in dict.fromkeys(self.faces[i].edges)])
        depth = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        return bool(depth[2] > 1e-6 * depth[0])

    def _is_thin_at(self, place: Any) -> bool:
        """Whether the outside or another cavity is closer than the limit of a thin wall."""
        beyond = (f for f in self.faces if f.name == "outside" or (_is_cavity(f) and f.name != self.name))
        return any(float(place.Distance(face)) <= self.thin for face in beyond)


def _is_cavity(face: Any) -> bool:
    return str(face.name).startswith("cavity")


def _xyz(point: Any) -> Array:
    return np.array([point.x, point.y, point.z], dtype=np.float64)


def _samples(edge: Any) -> tuple[Array, Array]:
    """Points along an edge and unit tangents there, (5, 3) each."""
    start, end = edge.parameter_interval
    at = np.linspace(float(start), float(end), 5)
    tangents = np.array([_xyz(edge.Tangent(s)) for s in at])
    length = np.linalg.norm(tangents, axis=1, keepdims=True)
    return np.array([_xyz(edge.Value(s)) for s in at]), tangents / np.where(length > 0, length, 1.0)


def _is_straight(edge: Any) -> bool:
    _, tangents = _samples(edge)
    return bool(np.linalg.norm(np.cross(tangents[0], tangents), axis=1).max() < THIN_CORNERS.sharp)


def _fold(edge: Any, one: Any, other: Any) -> bool:
    """Whether two faces meet at a sharp angle along their common edge."""
    first, second = _into(one, edge), _into(other, edge)
    return bool(len(first) and len(second) and np.linalg.norm(np.cross(first, second)) > THIN_CORNERS.sharp)


def _into(face: Any, edge: Any) -> Array:
    """Tangent of a face at the start of one of its edges, perpendicular to the edge; empty if unknown."""
    corner, along, length = _xyz(edge.start), _samples(edge)[1][0], float(edge.mass)
    for neighbor in dict.fromkeys(face.edges):
        points, tangents = _samples(neighbor)
        for end, sign in ((0, 1.0), (-1, -1.0)):
            across = sign * (tangents[end] - (tangents[end] @ along) * along)
            rise = float(np.linalg.norm(across))
            if np.linalg.norm(points[end] - corner) < 1e-6 * length and rise > THIN_CORNERS.sharp:
                return np.asarray(across / rise)
    return np.zeros(0)
