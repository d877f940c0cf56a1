"""Attached: places on the surface, such as those of markers and point forces, and how to find them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.closest import foot_point, overhang, place, shapes
from turgor.core.engine.faces.settings import SIDE_SEARCH
from turgor.core.geometry.wedge import Wedge
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import outer_triangles
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Attached:
    """Where something is fixed on the surface.

    Parameters
    ----------
    nodes : (k,) int array
        Nodes of the side.
    at : (2,) array
        Place on it.
    arm : (3,) array [m]
        From there to the point, in the frame of the surface: along its first tangent, across it, along its normal.
    mirrored : (3,) array
        −1 for each direction in which the modeled part was mirrored to reach the point, else 1.
    mirrors : (3,) array [m]
        Positions of these mirror planes.
    wedge : Wedge, optional
        Of which the modeled part is a sector.
    sector : int
        By how many sectors the modeled part was turned to reach the point.
    """

    nodes: NDArray[np.int64]
    at: Array
    arm: Array
    mirrored: Array
    mirrors: Array
    wedge: Wedge | None = None
    sector: int = 0

    def position(self, points: Array) -> Array:
        """Position (3,) [m] when the nodes of the mesh are at some points (n, 3) [m]."""
        foot, frame = _frame(_corners(points, self.nodes), self.at)
        modeled = foot + self.arm @ frame
        if self.wedge is not None:
            return self.wedge.images(modeled, self.sector)
        return np.asarray(self.mirrors + self.mirrored * (modeled - self.mirrors))

    @property
    def shares(self) -> Array:
        """Shape functions (k,) of the nodes at the place: the shares of a force there that they carry."""
        values = _shape_functions(9 if len(self.nodes) == 8 else len(self.nodes), self.at)
        if len(self.nodes) != 8:
            return values
        out = values[:8].copy()  # the node in the middle follows the others
        out[:4] -= 0.25 * values[8]
        out[4:] += 0.5 * values[8]
        return out


def attach(mesh: Mesh, point: Point, planes: Sequence[tuple[int, float]]) -> Attached:
    """Find the place on the surface that is nearest to a point.

    Parameters
    ----------
    mesh : Mesh
    point : (3,) floats [m]
        On either side of the mirror planes, or in any sector of a wedge.
    planes : sequence of (axis, position [m])
        Mirror planes.

    Returns
    -------
    Attached
    """
    modeled, mirrored, mirrors = np.array(point), np.ones(3), np.zeros(3)
    for axis, position in planes:
        inside = mesh.points[:, axis].mean() - position
        if (modeled[axis] - position) * inside < 0:
            modeled[axis] = 2 * position - modeled[axis]
            mirrored[axis], mirrors[axis] = -1.0, position
    if mesh.wedge is not None:
        return _in_sector(mesh, mesh.wedge, modeled)
    surface = _surface(mesh)
    _, side, place_on = _nearest(surface, modeled)
    foot, frame = _frame(surface.corners[side], place_on)
    return Attached(surface.sides[side], place_on, frame @ (modeled - foot), mirrored, mirrors)


def on_face(mesh: Mesh, face: str, points: Array) -> tuple[NDArray[np.int64], Array, Array]:
    """Find the place on a face that is nearest to each point.

    Parameters
    ----------
    mesh : Mesh
    face : str
    points : (p, 3) array [m]

    Returns
    -------
    nodes : (p, k) int array
        Nodes of the side.
    shares : (p, k) array
        Its shape functions there.
    away : (p,) array [m]
        Distance of the point.
    """
    surface = _sampled(mesh, mesh.carrying_sides(face))
    places = [_nearest(surface, point) for point in points]
    feet = [Attached(surface.sides[side], at, np.zeros(3), np.ones(3), np.zeros(3)) for _, side, at in places]
    return (
        np.array([each.nodes for each in feet]),
        np.array([each.shares for each in feet]),
        np.array([away for away, _, _ in places]),
    )


def _in_sector(mesh: Mesh, wedge: Wedge, point: Array) -> Attached:
    """The nearest place of all sectors, as that of the modeled one and the turn that leads to it.

    Of sectors that are as near, the modeled one is taken, or else the next one.
    """
    surface = _surface(mesh)
    back = [wedge.images(point, -sector) for sector in range(wedge.fold)]
    nearest = [_nearest(surface, each) for each in back]
    least = min(away for away, _, _ in nearest) + ROUND_OFF.same * float(np.ptp(mesh.points))
    sector = next(i for i, (away, _, _) in enumerate(nearest) if away <= least)
    _, side, place_on = nearest[sector]
    foot, frame = _frame(surface.corners[side], place_on)
    return Attached(
        surface.sides[side],
        place_on,
        frame @ (back[sector] - foot),
        np.ones(3),
        np.zeros(3),
        wedge=wedge,
        sector=sector,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Surface:
    """Sides (f, k) with the positions of their nodes, and samples of them: places (p, 2) and a tree of f p points."""

    sides: NDArray[np.int64]
    corners: Array
    places: Array
    tree: Any


@lru_cache(maxsize=4)  # a job may have thousands of markers
def _surface(mesh: Mesh) -> _Surface:
    """The sides of a mesh, of a wedge those that do not lie inside the whole."""
    sides = outer_triangles(mesh)
    if mesh.wedge is not None:
        for name in mesh.cut_faces:
            sides = sides[~np.isin(sides, mesh.face_nodes(name)).all(axis=1)]
    return _sampled(mesh, sides)


def _sampled(mesh: Mesh, sides: NDArray[np.int64]) -> _Surface:
    from scipy.spatial import cKDTree  # slow to load, and few models have points on sides

    corners = _corners(mesh.points, sides)
    places = _places(corners.shape[1])
    weights = np.array([_shape_functions(corners.shape[1], at) for at in places])
    samples = np.einsum("pk,fki->fpi", weights, corners)
    return _Surface(sides, corners, places, cKDTree(samples.reshape(-1, 3)))


def _nearest(surface: _Surface, point: Array) -> tuple[float, int, Array]:
    """Distance of a point from the nearest side, that side, and the place on it."""
    corners, places = surface.corners, surface.places
    nearest = np.atleast_1d(surface.tree.query(point, k=min(SIDE_SEARCH.nearest, surface.tree.n))[1])
    best = (float(np.inf), 0, places[0])
    for number in nearest:
        side, sample = divmod(int(number), len(places))
        for at in (places[sample], _foot(corners[side], point, places[sample])):
            if at is not None:
                away = float(np.linalg.norm(_frame(corners[side], at)[0] - point))
                best = min(best, (away, side, at), key=lambda each: each[0])
    return best


def _corners(points: Array, nodes: NDArray[np.int64]) -> Array:
    """Positions of the nodes of sides; eight nodes get a ninth in the middle, where their shape functions put it."""
    corners = points[nodes]
    if nodes.shape[-1] != 8:
        return np.asarray(corners)
    middle = 0.5 * corners[..., 4:, :].sum(axis=-2) - 0.25 * corners[..., :4, :].sum(axis=-2)
    return np.concatenate([corners, middle[..., None, :]], axis=-2)


def _places(count: int) -> Array:
    """Places (p, 2) at which sides of ``count`` nodes are sampled, their edges among them."""
    grid = np.linspace(0, 1, SIDE_SEARCH.samples)
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
