"""Surface: sides that may touch, their quadrature points and how stiff they are behind."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.contact.closest import centers_of, points_of
from turgor.core.engine.contact.settings import CONTACT_SEARCH, PENALTY
from turgor.core.meshing.cells import side_type
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import cell_sides, corner_keys
from turgor.core.model.model import Model
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Sides of the body that may touch something, in scaled units.

    Parameters
    ----------
    sides : (s, n) int array
    N : (q, n) array
        Shape functions at the quadrature points.
    dN : (q, n, 2) array
    weights : (s, q) array
        Reference area that belongs to each point.
    spring : (s,) array
        Pressure per depth.
    height : (s,) array
        Of the cell behind each side.
    coupled : bool
        Whether the cells couple all nodes of a side: not the middles that follow.
    outward : (s,) bool array, optional
        Of films, which have every side twice: whether it looks out of its cavity.
    """

    sides: Ints
    N: Array
    dN: Array
    weights: Array
    spring: Array
    height: Array
    coupled: bool = True
    outward: NDArray[np.bool_] | None = None

    def chosen(self, which: Ints | NDArray[np.bool_]) -> "Surface":
        """Return some of the sides."""
        return replace(
            self,
            sides=np.ascontiguousarray(self.sides[which]),
            weights=self.weights[which],
            spring=self.spring[which],
            height=self.height[which],
            outward=None if self.outward is None else self.outward[which],
        )

    @property
    def corners(self) -> int:
        """Corners of each side."""
        return side_type(self.sides.shape[1]).corners

    @property
    def layers(self) -> tuple[Ints, ...]:
        """Sides that look one way: all of a solid; of films first those that look inwards, then the others."""
        if self.outward is None:
            return (self.sides,)
        return self.sides[~self.outward], self.sides[self.outward]


def whole_surface(model: Model, points: Array, volumes: Array, stress: float) -> Surface:
    """Collect every side of a solid that belongs to one cell only.

    Parameters
    ----------
    model : Model
    points : (n, 3) array
        Scaled reference positions.
    volumes : (c,) array
        Scaled volumes of the cells.
    stress : float [Pa]
        Scale of stresses.
    """
    mesh = model.mesh
    every = cell_sides(mesh.cells)
    _, index, count = np.unique(corner_keys(every, len(points)), return_index=True, return_counts=True)
    outer = np.sort(index[count == 1])
    sides = np.ascontiguousarray(every[outer])
    owner = outer // (len(every) // len(mesh.cells))
    r = side_tables(sides.shape[1])
    _, _, growth = points_of(points, sides, r.N, r.dN)
    weights = growth * r.weights
    tall = 3.0 if mesh.cell_type.corners == 4 else 1.0
    height = tall * volumes[owner] / weights.sum(axis=1)
    modulus = np.empty(len(mesh.cells))
    for name, material in model.region_materials.items():
        modulus[mesh.regions[name]] = 3 * material.law.shear_modulus / stress
    spring = PENALTY.stiffness * modulus[owner] / height
    return Surface(sides, r.N, r.dN, weights, spring, height, coupled=not mesh.serendipity)


def of_face(mesh: Mesh, surface: Surface, *names: str) -> NDArray[np.bool_]:
    """Which sides of a surface belong to named faces."""
    n = len(mesh.points)
    keys = [corner_keys(mesh.face(name), n) for name in names]
    return np.isin(corner_keys(surface.sides, n), np.concatenate([np.zeros(0, dtype=np.int64), *keys]))


def overhangs(points: Array, sides: Ints, mirrored: NDArray[np.bool_]) -> Array:
    """How far a foot point may lie beyond each edge of each side (s, e); ``mirrored`` marks nodes on mirror planes."""
    kind = side_type(sides.shape[1])
    _, _, normal = centers_of(points, sides, kind.corners)
    edges, owner, (first, second) = joined(sides)
    out = np.full(len(edges), ROUND_OFF.mesh_digits)
    smooth = np.einsum("ei,ei->e", normal[owner[first]], normal[owner[second]]) > CONTACT_SEARCH.smooth
    out[first[smooth]] = out[second[smooth]] = CONTACT_SEARCH.overhang
    out[mirrored[edges].all(axis=1)] = CONTACT_SEARCH.overhang  # the surface goes on behind the mirror
    return np.ascontiguousarray(out.reshape(len(kind.edges), -1).T)


def joined(sides: Ints) -> tuple[Ints, Ints, tuple[Ints, Ints]]:
    """Edges of all sides (e, 2) with their sides (e,), and the rows of edges that join two sides."""
    kind = side_type(sides.shape[1])
    edges = np.concatenate([np.sort(sides[:, list(pair)], axis=1) for pair in kind.edges])
    owner = np.tile(np.arange(len(sides)), len(kind.edges))
    _, edge, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(edge.ravel(), kind="stable")
    twice = (np.cumsum(count) - count)[count == 2]
    return edges, owner, (order[twice], order[twice + 1])


def strangers(points: Array, sides: Ints) -> tuple[Ints, Ints]:
    """Sides that share a node with each side and never touch it, as start (s + 1,) and list: all but those in a groove.

    Two sides at a common edge seem to lie inside each other where the body between them is a wedge; where they look at
    each other through air, they may close like a book.
    """
    kind = side_type(sides.shape[1])
    a, b = neighbors(sides, kind.corners)
    center, _, normal = centers_of(points, sides, kind.corners)
    apart = center[b] - center[a]
    above = CONTACT_SEARCH.above * np.linalg.norm(apart, axis=1)
    groove = (np.einsum("pi,pi->p", apart, normal[a]) > above) & (np.einsum("pi,pi->p", apart, normal[b]) < -above)
    return listed(a[~groove], b[~groove], len(sides))


def neighbors(sides: Ints, corners: int) -> tuple[Ints, Ints]:
    """Pairs of sides that share a corner; each side is its own neighbor, too."""
    nodes, local = np.unique(sides[:, :corners], return_inverse=True)
    rows = np.repeat(np.arange(len(sides)), corners)
    touching = sp.csr_matrix((np.ones(rows.size, np.int32), (rows, local.ravel())), shape=(len(sides), len(nodes)))
    graph = (touching @ touching.T).tocoo()
    return graph.row.astype(np.int64), graph.col.astype(np.int64)


def listed(rows: Ints, values: Ints, count: int) -> tuple[Ints, Ints]:
    """Values of each of ``count`` rows one after another: start (count + 1,), values."""
    order = np.lexsort((values, rows))
    return np.searchsorted(rows[order], np.arange(count + 1)).astype(np.int64), np.ascontiguousarray(values[order])


@dataclass(frozen=True, slots=True, eq=False)
class Rims:
    """Sharp convex edges of sides.

    A sharp rim that slides over the points of a surface would drop, or take up, one row of them after the other, and
    the force would jump each time. Instead it passes each point within a band, in which the pressure of the point
    fades.

    Parameters
    ----------
    width : (t, e) array
        Width of each side across each of its edges at rest; inf where the edge is no sharp rim.
    """

    width: Array

    def beyond(self, band: float) -> Array:
        """How far (t, e) a foot point may lie beyond each edge, for a band of that length."""
        return np.minimum(band / self.width, CONTACT_SEARCH.beyond)

    def within(self, sides: Ints, at: Array) -> tuple[Array, Ints]:
        """How far (k,) places (k, 2) on sides lie within the nearest rim of theirs, inf without one, and its edge."""
        inside, ways = _TRIANGLE if self.width.shape[1] == 3 else _QUADRILATERAL
        width = self.width[sides]
        sharp = np.isfinite(width)
        every = np.where(sharp, (inside + at @ ways.T) * np.where(sharp, width, 0.0), np.inf)
        return every.min(axis=1), every.argmin(axis=1)

    def covered(self, partner: Ints, at: Array, band: Array, outside: bool) -> tuple[Array, Array]:
        """Shares (k,) of points that sides cover, and the derivatives (k, 2) of these by the places.

        ``at`` are the places (k, 2) on the ``partner`` sides, ``band`` (k,) the length of the band within a rim, and
        ``outside`` says whether it has as much beyond the rim.
        The energy of the penetration that fades is lost: a rim that gained it would push points off.
        """
        _, ways = _TRIANGLE if self.width.shape[1] == 3 else _QUADRILATERAL
        within, edge = self.within(partner, at)
        start, whole = (band, 2 * band) if outside else (np.zeros(len(band)), band)
        way = np.clip((start + within) / whole, 0, 1)
        width = self.width[partner, edge]
        slope = 6 * way * (1 - way) * np.where(np.isfinite(width), width, 0.0) / whole
        return way**2 * (3 - 2 * way), slope[:, None] * ways[edge]


#: How far places (r, s) lie inside each edge: constants (e,) and derivatives (e, 2).
_TRIANGLE = np.array([0.0, 1.0, 0.0]), np.array([[0.0, 1.0], [-1.0, -1.0], [1.0, 0.0]])
_QUADRILATERAL = np.array([0.0, 1.0, 1.0, 0.0]), np.array([[0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]])


def rims(points: Array, sides: Ints, borders: bool) -> Rims:
    """Find the sharp convex edges of sides (t, n); ``borders`` says whether edges of one side alone are such."""
    kind = side_type(sides.shape[1])
    center, _, normal = centers_of(points, sides, kind.corners)
    _, owner, (first, second) = joined(sides)
    a, b = owner[first], owner[second]
    smooth = np.einsum("ei,ei->e", normal[a], normal[b]) > CONTACT_SEARCH.smooth
    groove = np.einsum("ei,ei->e", center[b] - center[a], normal[a]) > 0
    rim = np.full(len(owner), borders)
    rim[first] = rim[second] = ~(smooth | groove)
    corner = points[sides[:, : kind.corners]]
    along = np.roll(corner, -1, axis=1) - corner
    inward = np.cross(normal[:, None, :], along)
    inward /= np.linalg.norm(inward, axis=2, keepdims=True)
    over = 3 if kind.corners == 3 else 2  # the center is at a third of a triangle, in the middle of a quadrilateral
    width = over * np.einsum("tei,tei->te", center[:, None, :] - corner, inward)
    return Rims(np.where(rim.reshape(len(kind.edges), -1).T, width, np.inf))
