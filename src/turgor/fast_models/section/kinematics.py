"""Kinematics of a helical state: vectors of a section that stretch with its points and with the strains of the rod.

A section of a rod whose strains do not change along it is, at the reference length s, a turned and shifted copy of
itself: x(s, Y) = r(s) + R(s) y(Y), with R′ = R [κ]× and r′ = λ R e₁. The line r passes through the origin of the
section, and e₁ is its tangent. Seen from R, the derivative of x along s is w(y) = λ e₁ + κ × y, those in the section
are ∂y/∂Y and ∂y/∂Z: nothing depends on s. Every tangent vector of a body, of a sheet on it or of a thread in it is

    tₖ = Σₐ g⁰ₐₖ yₐ + g¹ₐₖ w(yₐ)

with the positions yₐ of the nodes of the section; the derivative of the deformation, F, has three of them. This form
is exact, and the 4 strains λ, κ₁ (twist), κ₂, κ₃ are unknowns besides the yₐ. κ is rotation per reference length.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.section.plane import Plane

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Strains of the rod: its stretch and three components of the curvature.
STRAINS = 4


def skew(v: Array) -> Array:
    """Matrices [v]× (..., 3, 3) of the cross product with vectors (..., 3).

    Examples
    --------
    >>> (skew(np.array([0.0, 0.0, 1.0])) @ [1.0, 0.0, 0.0]).tolist()
    [0.0, 1.0, 0.0]
    """
    out = np.zeros((*v.shape, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    out[..., 1, 0], out[..., 2, 0], out[..., 2, 1] = v[..., 2], -v[..., 1], v[..., 0]
    return out


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Vectors:
    """Tangent vectors at integration points, k at each.

    Parameters
    ----------
    nodes : (f, n) int array
        Nodes of the section that carry each piece.
    plain, along : (f, q, n, k) arrays
        g⁰ and g¹.
    weights : (f, q) array
        Area or length of the section that each point stands for.
    """

    nodes: Ints
    plain: Array
    along: Array
    weights: Array

    @property
    def unknowns(self) -> int:
        """Degrees of freedom of a piece: three for each node, then the strains."""
        return 3 * self.nodes.shape[1] + STRAINS

    def at(self, y: Array, strains: Array) -> Array:
        """Tangent vectors (f, q, 3, k) at positions (n, 3) and strains (4,)."""
        own = y[self.nodes]
        w = np.cross(strains[1:], own)
        w[..., 0] += strains[0]
        return np.asarray(np.swapaxes(own, 1, 2)[:, None] @ self.plain + np.swapaxes(w, 1, 2)[:, None] @ self.along)

    def derivatives(self, y: Array, strains: Array) -> Array:
        """Derivatives (f, q, 3k, 3n + 4) of the vectors by the degrees of freedom."""
        f, q, n, k = self.plain.shape
        turn = skew(strains[1:])
        out = np.zeros((f, q, 3, k, self.unknowns))
        plain, along = (np.swapaxes(table, 2, 3) for table in (self.plain, self.along))
        for i in range(3):
            for j in range(3):
                part = turn[i, j] * along
                out[:, :, i, :, j : 3 * n : 3] = part + plain if i == j else part
        out[:, :, 0, :, 3 * n] = self.along.sum(axis=2)
        reached = np.swapaxes(y[self.nodes], 1, 2)[:, None] @ self.along  # (f, q, 3, k)
        out[..., 3 * n + 1 :] = np.moveaxis(-skew(np.swapaxes(reached, 2, 3)), 2, 3)
        return out.reshape(f, q, 3 * k, self.unknowns)

    def gradient(self, B: Array, P: Array) -> Array:
        """Forces (f, 3n + 4) of stresses P (f, q, 3k), with the derivatives B."""
        weighted = (self.weights[..., None] * P).reshape(len(P), 1, -1)
        return np.asarray((weighted @ B.reshape(len(B), -1, self.unknowns))[:, 0])

    def hessian(self, B: Array, P: Array, A: Array) -> Array:
        """Stiffness (f, 3n + 4, 3n + 4) of stresses P and moduli A (f, q, 3k, 3k)."""
        count, n, k = len(B), self.nodes.shape[1], self.plain.shape[3]
        moved = (self.weights[..., None, None] * (A @ B)).reshape(count, -1, self.unknowns)
        K = np.swapaxes(B.reshape(count, -1, self.unknowns), 1, 2) @ moved
        stress = (self.weights[..., None] * P).reshape(*P.shape[:2], 3, k)
        # the second derivative of t by κ and y: P · (δκ × δy) = −δκ · [P]× δy
        resultant = np.einsum("fqik,fqnk->fni", stress, self.along, optimize=True)
        mixed = np.moveaxis(-skew(resultant), 1, 2).reshape(count, 3, 3 * n)
        K[:, 3 * n + 1 :, : 3 * n] += mixed
        K[:, : 3 * n, 3 * n + 1 :] += np.swapaxes(mixed, 1, 2)
        return np.asarray(K)


def from_slice(plane: Plane, nodes: Ints, tables: Array, height: Array, weights: Array) -> Vectors:
    """Turn tables on the nodes of a slice into those of the section.

    Parameters
    ----------
    plane : Plane
    nodes : (f, m) int array
        Nodes of the slice; three of each row lie above one another.
    tables : (f, q, m, k) array
        Vectors Σ table · x from positions of these nodes, with derivatives by lengths of the slice at rest.
    height : (f, q) array
        Distance of the integration points from the near plane.
    weights : (f, q) array
        Area or volume of each point.

    Returns
    -------
    Vectors
        With the points of one level along x, which stand for those above them; weights are those of the section.
    """
    below = plane.node_of[nodes]
    own = np.sort(below, axis=1)[:, ::3]
    to = (below[:, :, None] == own[:, None, :]).astype(np.float64)
    chosen = lowest(height, plane.thickness)
    # x(s, Y) = y + s w near a point: the derivative of a slice that is straight there gives g⁰ and g¹
    above = plane.height[nodes][:, None, :] - np.take_along_axis(height, chosen, axis=1)[..., None]
    tables = np.take_along_axis(tables, chosen[..., None, None], axis=1)
    plain = np.einsum("fqmk,fmn->fqnk", tables, to, optimize=True)
    along = np.einsum("fqmk,fqm,fmn->fqnk", tables, above, to, optimize=True)
    lowest_weights = np.take_along_axis(weights, chosen, axis=1)
    share = weights.sum(axis=1) / lowest_weights.sum(axis=1) / plane.thickness
    return Vectors(nodes=own, plain=plain, along=along, weights=lowest_weights * share[:, None])


def lowest(height: Array, thickness: float) -> Ints:
    """Integration points (f, r) of the lowest level of each side; which these are depends on how it is numbered.

    Examples
    --------
    >>> lowest(np.array([[0.2, 0.8, 0.2, 0.8], [0.2, 0.2, 0.8, 0.8]]), 1.0).tolist()
    [[0, 2], [0, 1]]
    """
    level = height - height.min(axis=1, keepdims=True) < 1e-9 * thickness
    return np.nonzero(level)[1].reshape(len(height), -1)
