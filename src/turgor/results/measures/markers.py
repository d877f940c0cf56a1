"""Markers: named points on or near the surface that are followed along the path, as a camera follows them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from turgor.engine.contact.closest import foot_point, overhang, place, shapes
from turgor.errors import TurgorError
from turgor.meshing.mesh import Mesh
from turgor.meshing.surface import outer_triangles
from turgor.results.fields.state_fields import MeshFacts, MirrorPlane, StateFields
from turgor.results.measures.reading import Measure
from turgor.units import mm

Array = NDArray[np.float64]
Point = tuple[float, float, float]

#: A side is sampled at so many places along each of its edges to find the one that is nearest.
SAMPLES = 5

#: So many of the nearest samples are looked at more closely.
CANDIDATES = 12

#: A marker may be this far from the surface, as a share of the size of the part; farther ones are mistakes of units.
FARTHEST = 0.25


@dataclass(frozen=True, slots=True, eq=False)
class Attached:
    """Where a marker is fixed on the surface.

    Parameters
    ----------
    nodes : (k,) int array
        Nodes of the side.
    at : (2,) array
        Place on it.
    arm : (3,) array [m]
        From there to the marker, in the frame of the surface: along its first tangent, across it, along its normal.
    mirrored : (3,) array
        −1 for each direction in which the modeled part was mirrored to reach the marker, else 1.
    mirrors : (3,) array [m]
        Positions of these mirror planes.
    """

    nodes: NDArray[np.int64]
    at: Array
    arm: Array
    mirrored: Array
    mirrors: Array

    def position(self, points: Array) -> Array:
        """Position (3,) [m] when the nodes of the mesh are at some points (n, 3) [m]."""
        foot, frame = _frame(_corners(points, self.nodes), self.at)
        modeled = foot + self.arm @ frame
        return np.asarray(self.mirrors + self.mirrored * (modeled - self.mirrors))


def marker(name: str, point: Sequence[float]) -> tuple[Measure, Measure, Measure]:
    """Return the coordinates of a marker as measures, as a camera would record them.

    A marker on the surface moves with the point of the surface on which it lies. One beside it, such as a ball on a
    pin, moves with the nearest point of the surface and turns with the surface there. One on the mirror image of a
    modeled half is the image of its mirror image.

    Parameters
    ----------
    name : str
        The measures are ``NAME_x``, ``NAME_y`` and ``NAME_z``.
    point : (3,) floats [m]
        Where it is at rest.

    Returns
    -------
    tuple of three Measure
        Its coordinates [m], written in mm.

    Raises
    ------
    TurgorError
        If the name or the point cannot be used; when it is read, if it is farther from the surface than a quarter of
        the size of the part.

    Examples
    --------
    >>> [each.name for each in marker("knuckle", (20e-3, 0, 15e-3))]
    ['knuckle_x', 'knuckle_y', 'knuckle_z']
    """
    given = np.asarray(point, dtype=np.float64)
    if given.shape != (3,) or not np.isfinite(given).all():
        raise TurgorError(f"marker '{name}': {point!r} is no point; give three coordinates in meters.")
    known: Point = (float(given[0]), float(given[1]), float(given[2]))
    x, y, z = (
        Measure(
            name=f"{name}_{letter}",
            unit="mm",
            function=partial(_coordinate, name, known, axis),
            definition=f"{letter} coordinate of the marker '{name}', at rest near {_text(given)}",
        )
        for axis, letter in enumerate("xyz")
    )
    return x, y, z


def check_markers(mesh: Mesh, markers: Mapping[str, Point]) -> None:
    """Refuse markers that are too far from a part.

    Parameters
    ----------
    mesh : Mesh
    markers : mapping of str to (3,) floats [m]

    Raises
    ------
    TurgorError
        With the place, the distance and the nearest point of the surface.
    """
    for name, point in markers.items():
        _attached(mesh, name, point, MeshFacts(mesh).mirrors)


def _coordinate(name: str, point: Point, axis: int, at: StateFields) -> float:
    fixed = at.facts.once((name, point), partial(_attached, at.mesh, name, point, at.facts.mirrors))
    return float(fixed.position(at.mesh.points + at.displacement)[axis])


def _attached(mesh: Mesh, name: str, point: Point, planes: tuple[MirrorPlane, ...]) -> Attached:
    """Find where a marker is fixed."""
    modeled, mirrored, mirrors = np.array(point), np.ones(3), np.zeros(3)
    for plane in planes:
        inside = mesh.points[:, plane.axis].mean() - plane.position
        if (modeled[plane.axis] - plane.position) * inside < 0:
            modeled[plane.axis] = 2 * plane.position - modeled[plane.axis]
            mirrored[plane.axis], mirrors[plane.axis] = -1.0, plane.position
    sides = outer_triangles(mesh)
    side, place_on = _nearest(mesh.points, sides, modeled)
    foot, frame = _frame(_corners(mesh.points, sides[side]), place_on)
    away, size = float(np.linalg.norm(modeled - foot)), float(np.ptp(mesh.points, axis=0).max())
    if away > FARTHEST * size:
        raise TurgorError(
            f"marker '{name}' at {_text(np.array(point))} is {away / mm:.4g} mm from the surface, whose nearest point "
            f"is {_text(foot)}; a marker lies on the surface or within {FARTHEST * size / mm:.3g} mm of it."
        )
    return Attached(sides[side], place_on, frame @ (modeled - foot), mirrored, mirrors)


def _nearest(points: Array, sides: NDArray[np.int64], point: Array) -> tuple[int, Array]:
    """Side and place on it that are nearest to a point."""
    corners = _corners(points, sides)
    places = _places(corners.shape[1])
    weights = np.array([_shape_functions(corners.shape[1], at) for at in places])
    samples = np.einsum("pk,fki->fpi", weights, corners)
    flat = samples.reshape(-1, 3)
    found = np.atleast_1d(cKDTree(flat).query(point, k=min(CANDIDATES, len(flat)))[1])
    best = (np.inf, 0, places[0])
    for number in found:
        side, sample = divmod(int(number), len(places))
        for at in (places[sample], _foot(corners[side], point, places[sample])):
            if at is not None:
                away = float(np.linalg.norm(_frame(corners[side], at)[0] - point))
                best = min(best, (away, side, at), key=lambda each: each[0])
    return best[1], best[2]


def _corners(points: Array, nodes: NDArray[np.int64]) -> Array:
    """Positions of the nodes of sides; eight nodes get a ninth in the middle, where their shape functions put it."""
    corners = points[nodes]
    if nodes.shape[-1] != 8:
        return np.asarray(corners)
    middle = 0.5 * corners[..., 4:, :].sum(axis=-2) - 0.25 * corners[..., :4, :].sum(axis=-2)
    return np.concatenate([corners, middle[..., None, :]], axis=-2)


def _places(count: int) -> Array:
    """Places (p, 2) at which sides of ``count`` nodes are sampled, their edges among them."""
    grid = np.linspace(0, 1, SAMPLES)
    return np.array([(r, s) for r in grid for s in grid if count != 6 or r + s <= 1 + 1e-12])


def _tables(count: int) -> tuple[Array, Array, Array]:
    return np.empty(count), np.empty((count, 2)), np.empty((count, 3))


def _shape_functions(count: int, at: Array) -> Array:
    tables = _tables(count)
    shapes(at[0], at[1], *tables)
    return tables[0]


def _foot(corners: Array, point: Array, guess: Array) -> Array | None:
    """Place of the point of a curved side that is nearest to a point; None where that is outside the side."""
    frame = np.empty(3), np.empty((2, 3)), np.empty((3, 3))
    r, s = foot_point(point, corners, (float(guess[0]), float(guess[1])), _tables(len(corners)), frame)
    inside = np.isfinite((r, s)).all() and overhang(len(corners), r, s)[0] <= 0
    return np.array([r, s]) if inside else None


def _frame(corners: Array, at: Array) -> tuple[Array, Array]:
    """Point of a side, and its frame in rows: first tangent, across, normal."""
    tables, (x, d, h) = _tables(len(corners)), (np.empty(3), np.empty((2, 3)), np.empty((3, 3)))
    shapes(at[0], at[1], *tables)
    place(corners, *tables, x, d, h)
    first = d[0] / np.linalg.norm(d[0])
    normal = np.cross(d[0], d[1])
    normal /= np.linalg.norm(normal)
    return x, np.array([first, np.cross(normal, first), normal])


def _text(point: Array) -> str:
    return f"({', '.join(f'{value / mm:.4g}' for value in point)}) mm"
