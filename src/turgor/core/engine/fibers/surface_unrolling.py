"""Unrolls a face that runs along an axis into the plane of contour length and axial coordinate.

Helices, hoops and axial threads are straight lines there. Every side of the face keeps its quadratic shape functions,
with the contour lengths and axial coordinates of its nodes in place of their positions, so that neighboring sides fit
together without gaps and finding the side under a point is a problem in two dimensions.
"""

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import reference_cell, reference_nodes
from turgor.core.engine.contact.closest import STEPS
from turgor.core.engine.faces.membranes import MEMBRANE_QUADRATURE_DEGREE
from turgor.core.engine.faces.settings import SIDE_SEARCH
from turgor.core.engine.fibers.contour import Contour, contour_of
from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.meshing.cells import side_type
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_POWERS = {
    6: ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)),
    8: ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (2, 1), (1, 2)),
    9: ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (2, 1), (1, 2), (2, 2)),
}


def shape_values(nodes: int, places: Array) -> tuple[Array, Array]:
    """Shape functions (k, n) of a side and their derivatives (k, n, 2) at reference places (k, 2).

    Examples
    --------
    >>> import numpy as np
    >>> shape_values(6, np.array([[1.0, 0.0]]))[0].round(12)[0, :3]
    array([0., 1., 0.])
    """
    i, j = np.array(_POWERS[nodes]).T
    x, y = places[:, :1], places[:, 1:]
    terms = x**i * y**j
    slopes = np.stack([i * x ** np.maximum(i - 1, 0) * y**j, j * x**i * y ** np.maximum(j - 1, 0)])
    inverse = _inverse(nodes)
    return terms @ inverse, np.ascontiguousarray(np.moveaxis(slopes @ inverse, 0, -1))


@cache
def _inverse(nodes: int) -> Array:
    """Coefficients of the shape functions of the nodes, by power."""
    i, j = np.array(_POWERS[nodes]).T
    at = reference_nodes(9)[:8] if nodes == 8 else reference_nodes(nodes)
    return np.asarray(np.linalg.inv(at[:, :1] ** i * at[:, 1:] ** j))


@dataclass(frozen=True, slots=True, eq=False)
class UnrolledSurface:
    """A face in the plane of contour length and axial coordinate.

    Parameters
    ----------
    sides : (f, n) int array
        Nodes of the sides.
    flat : (f, n, 2) array [m]
        Contour length and axial coordinate of the nodes of each side; on a closed contour a side may reach beyond it.
    contour : Contour
        The cross-section.
    start, end : float [m]
        Axial coordinates of the two ends of the face.
    """

    sides: Ints
    flat: Array
    contour: Contour
    start: float
    end: float
    _tree: "cKDTree"
    _seeds: tuple[Ints, Array, Array]

    def find(self, points: Array) -> tuple[Ints, Array]:
        """Side under each point (k, 2) of the plane, −1 where there is none, and the reference place (k, 2) in it."""
        points = points.copy()
        if self.contour.closed:
            points[:, 0] %= self.contour.length
        side = np.full(len(points), -1)
        place = np.zeros((len(points), 2))
        margin = ROUND_OFF.same * (self.end - self.start)
        within = (points[:, 1] >= self.start - margin) & (points[:, 1] <= self.end + margin)
        if not self.contour.closed:
            within &= (points[:, 0] >= -margin) & (points[:, 0] <= self.contour.length + margin)
        open_ = np.flatnonzero(within)
        nearest = self._tree.query(points, k=SIDE_SEARCH.nearest)[1]
        owner, shift, seed = self._seeds
        tried = np.full((len(points), SIDE_SEARCH.nearest), -1)
        for rank in range(nearest.shape[1]):
            candidate = nearest[open_, rank]
            fresh = (tried[open_] != owner[candidate][:, None]).all(axis=1)
            tried[open_, rank] = owner[candidate]
            at, candidate = open_[fresh], candidate[fresh]
            moved = points[at] - np.c_[shift[candidate], np.zeros(len(at))]
            places = self.place(owner[candidate], moved, seed[candidate])
            good = _outside(self.sides.shape[1], places) <= ROUND_OFF.same
            side[at[good]], place[at[good]] = owner[candidate[good]], places[good]
            open_ = open_[side[open_] < 0]
            if not len(open_):
                break
        return side, place

    def place(self, sides: Ints, points: Array, guess: Array | None = None) -> Array:
        """Reference places (k, 2) of points (k, 2) in given sides, which they may leave."""
        nodes = self.flat[sides]
        if guess is None:
            guess = np.tile(reference_nodes(self.sides.shape[1]).mean(axis=0), (len(sides), 1))
            if self.contour.closed:
                middle = nodes[:, :, 0].mean(axis=1)
                points = points.copy()
                points[:, 0] -= self.contour.length * np.round((points[:, 0] - middle) / self.contour.length)
        place = guess.copy()
        for _ in range(STEPS):
            N, dN = shape_values(self.sides.shape[1], place)
            error = points - np.einsum("ka,kai->ki", N, nodes)
            J = np.einsum("kad,kai->kid", dN, nodes)
            size = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
            size = np.where(np.abs(size) > 1e-300, size, 1e-300)
            step = (
                np.c_[
                    J[:, 1, 1] * error[:, 0] - J[:, 0, 1] * error[:, 1],
                    J[:, 0, 0] * error[:, 1] - J[:, 1, 0] * error[:, 0],
                ]
                / size[:, None]
            )
            place = np.clip(place + step, -2, 3)
            if np.abs(step).max(initial=0.0) < 1e-13:
                break
        return np.asarray(place)

    def slopes(self, sides: Ints, points: Array, direction: Array) -> Array:
        """Derivatives (k, n) of the shape functions along directions (k, 2) in given sides at points (k, 2).

        They are interpolated from the integration points of membranes, where the strains of a quadratic side are best.
        """
        count = self.sides.shape[1]
        table = reference_cell(count, MEMBRANE_QUADRATURE_DEGREE[side_type(count).corners])
        J = np.einsum("qad,kai->kqid", table.dN, self.flat[sides])
        local = np.linalg.solve(J, np.broadcast_to(direction[:, None, :, None], (*J.shape[:2], 2, 1)))[..., 0]
        share = _bilinear(self.place(sides, points)) @ np.linalg.pinv(_bilinear(table.points))
        if len(table.points) == 3:
            share = _bilinear(self.place(sides, points))[:, :3] @ np.linalg.inv(_bilinear(table.points)[:, :3])
        return np.asarray(np.einsum("kq,qad,kqd->ka", share, table.dN, local, optimize=True))

    @property
    def fineness(self) -> float:
        """Smaller extent of the smaller sides [m]."""
        return float(np.percentile(np.ptp(self.flat, axis=1).min(axis=1), 10))


def unroll(points: Array, sides: Ints, axis: Array, name: str) -> UnrolledSurface:
    """Unroll a face of a mesh that runs along an axis.

    Parameters
    ----------
    points : (n, 3) array [m]
        Reference positions of all nodes of the mesh.
    sides : (f, n) int array
        Sides of the face.
    axis : (3,) array
        Direction of the axis, a unit vector.
    name : str
        What the face is called in messages.

    Raises
    ------
    TurgorError
        If the face does not begin with one contour, or its cross-section changes along the axis.
    """
    contour = contour_of(points, sides, axis, name)
    nodes, local = np.unique(sides, return_inverse=True)
    along = points[nodes] @ axis
    length, distance = contour.project(points[nodes])
    worst = float(distance.max())
    if worst > FIBERS.prismatic * contour.length:
        raise TurgorError(
            f"fibers on '{name}': the cross-section of this face changes along the axis by {worst / mm:.3g} mm; "
            "discrete threads need one that stays the same, smeared fibers do not."
        )
    flat = np.stack([length, along], axis=1)[local.reshape(sides.shape)]
    if contour.closed:
        flat[:, :, 0] -= contour.length * np.round((flat[:, :, 0] - flat[:, :1, 0]) / contour.length)
    return _indexed(sides, flat, contour, along)


def _indexed(sides: Ints, flat: Array, contour: Contour, along: Array) -> UnrolledSurface:
    from scipy.spatial import cKDTree  # slow to load, and few models have threads

    count = sides.shape[1]
    step = (np.arange(SIDE_SEARCH.samples) + 0.5) / SIDE_SEARCH.samples
    grid = np.stack(np.meshgrid(step, step), axis=-1).reshape(-1, 2)
    if side_type(count).corners == 3:
        grid = grid[grid.sum(axis=1) <= 1.0]
    seeds = np.einsum("qa,fai->fqi", shape_values(count, grid)[0], flat).reshape(-1, 2)
    owner = np.repeat(np.arange(len(sides)), len(grid))
    place = np.tile(grid, (len(sides), 1))
    shifts = (-contour.length, 0.0, contour.length) if contour.closed else (0.0,)
    tree = cKDTree(np.concatenate([seeds + [shift, 0.0] for shift in shifts]))
    index = (
        np.tile(owner, len(shifts)),
        np.repeat(np.array(shifts), len(owner)),
        np.tile(place, (len(shifts), 1)),
    )
    return UnrolledSurface(sides, flat, contour, float(along.min()), float(along.max()), tree, index)


def _bilinear(place: Array) -> Array:
    x, y = place.T
    return np.stack([np.ones(len(place)), x, y, x * y], axis=1)


def _outside(nodes: int, place: Array) -> Array:
    """How far places are outside the reference side."""
    low = -place.min(axis=1)
    high = place.sum(axis=1) - 1 if side_type(nodes).corners == 3 else place.max(axis=1) - 1
    return np.asarray(np.maximum(low, high))
