"""Plates: the bending of a sheet whose slope jumps between the sides it lies on, inside one of them and at an edge.

Cells carry no slope across their sides that is continuous from cell to cell. A sheet on them therefore bends in
two places: its curvature inside each side, and its angle at each edge. Both come from the normal n of the surface
with tangents a₁, a₂, and both have first and second variations in closed form. Let aᵞ be the dual tangents, and let
z = Σ zₐ xₐ be a combination of second derivatives of the position. Its curvature is b = n·z, and

    δb  = n·v,                         v = δz − (aᵞ·z) δx,ᵧ
    δ²b = −Σᵧ 2 (n·δx,ᵧ)(aᵞ·v) − b aᵞᵟ (n·δx,ᵧ)(n·δx,ᵟ).

The normal turns about the unit tangent t of an edge by α, where c = t × n lies in the surface, across the edge:

    δα  = −n·w,                        w = (c·aᵞ) δx,ᵧ
    δ²α = Σᵧ 2 (n·δx,ᵧ)(aᵞ·w) + (n·δt)(c·δt).

Variations are rows, one number for each displacement component of the nodes: the outer product of a vector of space
with a number for each node. A matrix of second variations is ½ times the sum of two outer products of rows.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import tables_at

Array = NDArray[np.float64]

#: Deflections of a side that do not bend it: the linear ones.
FLAT = 3


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A surface at some of its points.

    Parameters
    ----------
    normal : (..., 3) array
    dual : (..., 2, 3) array
        Dual tangents aᵞ.
    inverse : (..., 2, 2) array
        Their products aᵞ·aᵟ.
    slopes : (..., m, 2) array
        Derivatives of the shape functions along two parameters.
    """

    normal: Array
    dual: Array
    inverse: Array
    slopes: Array

    @property
    def across(self) -> Array:
        """Rows n·δx,ᵧ, (..., 2, m, 3): a property, because forces do without them."""
        return rows(np.swapaxes(self.slopes, -1, -2), self.normal[..., None, :])


def surface_at(corners: Array, slopes: Array) -> Surface:
    """Find normal and dual tangents at points of pieces.

    Parameters
    ----------
    corners : (..., m, 3) array
        Positions of the nodes of each piece, broadcast over its points.
    slopes : (..., m, 2) array
        Derivatives of the shape functions along two parameters.
    """
    tangents = np.swapaxes(slopes, -1, -2) @ corners
    normal = cross(tangents[..., 0, :], tangents[..., 1, :])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    inverse = _inverse(tangents @ np.swapaxes(tangents, -1, -2))
    return Surface(normal, inverse @ tangents, inverse, slopes)


def cross(a: Array, b: Array) -> Array:
    """Cross products (..., 3), in half the time of `numpy.cross`."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        out[..., i] = a[..., j] * b[..., k] - a[..., k] * b[..., j]
    return out


def _inverse(metric: Array) -> Array:
    """Inverses of symmetric matrices (..., 2, 2), in closed form."""
    a, b, d = metric[..., 0, 0], metric[..., 0, 1], metric[..., 1, 1]
    out = np.empty(metric.shape)
    out[..., 0, 0], out[..., 1, 1] = d, a
    out[..., 0, 1] = out[..., 1, 0] = -b
    return out / (a * d - b * b)[..., None, None]


def rows(numbers: Array, vectors: Array) -> Array:
    """Variations (..., m, 3) from a number for each node (..., m) and a vector (..., 3)."""
    return np.asarray(numbers[..., None] * vectors[..., None, :])


def covariant(at: Surface, slopes: Array, seconds: Array, z: Array) -> Array:
    """Numbers (..., c, m) of v = δz − (aᵞ·z) δx,ᵧ from those of δz, ``seconds`` (..., c, m), and z (..., c, 3)."""
    along = z @ np.swapaxes(at.dual, -1, -2)
    return np.asarray(seconds - along @ np.swapaxes(slopes, -1, -2))


def second_derivatives(nodes: int, points: Array) -> Array:
    """Second derivatives (q, n, 2, 2) of the shape functions of a side at reference points (q, 2).

    First derivatives are quadratic at most along each parameter, for which central differences are exact.
    """
    weights, steps = np.ones(len(points)), 0.5 * np.eye(2)
    ends = [[tables_at(nodes, points + way * step, weights).dN for way in (1, -1)] for step in steps]
    return np.stack([ahead - behind for ahead, behind in ends], axis=-1)


def curvature_numbers(tangents: Array, seconds: Array, first: Array, second: Array) -> Array:
    """Numbers (..., n) of the second derivative of the position along two unit vectors (..., 3) of a surface.

    ``tangents`` (..., 2, 3) and ``seconds`` (..., n, 2, 2) are derivatives along the parameters of the side, the
    tangents those at rest.
    """
    dual = np.linalg.inv(tangents @ np.swapaxes(tangents, -1, -2)) @ tangents
    parts = (np.einsum("...ai,...i->...a", dual, vector) for vector in (first, second))
    return np.einsum("...a,...b,...nab->...n", *parts, seconds)


def quadratic(left: Array, right: Array) -> Array:
    """Sum of the outer products (k, 3 m, 3 m) of rows (k, q, r, m, 3), symmetrized."""
    flat = [part.reshape(len(part), -1, part.shape[-2] * 3) for part in (left, right)]
    out = np.swapaxes(flat[0], 1, 2) @ flat[1]
    return np.asarray(0.5 * (out + np.swapaxes(out, 1, 2)))


def least_penalties(bending: Array, moments: Array) -> Array:
    """Find the least penalty η of each edge with which the bending energy of each side is positive.

    With the share η D / (2 h) of the penalty, a side and its share of the mean moments have a positive energy where

        ½ ∫ κ : ℂ : κ dA ≥ Σ ∫ m² h / (4 η D) dL

    for all deflections of its nodes. The η that each edge needs alone, times the one factor that all need together,
    fulfill it. A square needs 1 where ν = 0, sides of folded tubes 2 to 7.

    Parameters
    ----------
    bending : (f, n, n) array
        Twice the bending energy of each side, of the deflections of its nodes.
    moments : (f, k, n, n) array
        m² h / D integrated along each of its k edges.

    Returns
    -------
    (f, k) array

    Examples
    --------
    >>> least_penalties(np.diag([0, 0, 0, 1.0, 2.0])[None], np.diag([0, 0, 0, 2.0, 2.0])[None, None])
    array([[1.]])
    """
    values, vectors = np.linalg.eigh(bending)
    unit = (vectors[..., FLAT:] / np.sqrt(values[:, None, FLAT:]))[:, None]
    shares = 0.5 * np.swapaxes(unit, -1, -2) @ moments @ unit
    alone = np.linalg.eigvalsh(shares)[..., -1]
    together = np.linalg.eigvalsh((shares / alone[..., None, None]).sum(axis=1))[:, -1]
    return np.asarray(alone * together[:, None])
