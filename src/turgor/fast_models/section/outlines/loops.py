"""Loops: what lines of a section enclose, for each reference length of a helical state.

In a helical state all points move along s with the velocity w(y) = λ e₁ + κ × y, which has no divergence. The volume
that a loop encloses for each reference length is therefore the flow of w through any cap of it, and by Stokes' theorem

    V′ = ∮ (½ λ e₁ × y − ½ |y|² κ) · dy ,

whatever the warping of the loop. V′ has the derivatives that a pressure p in a cavity needs: −p ∂V′/∂y are the forces
on its walls, −p ∂V′/∂(λ, κ) are the thrust and the moments on closed ends. A loop that mirror planes cut is closed
along them, where the integrand is zero.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.section.kinematics import STRAINS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(3)  # exact: the integrand is of degree 5 along an edge
_N = np.stack([_POINTS * (_POINTS - 1) / 2, _POINTS * (_POINTS + 1) / 2, 1 - _POINTS**2], axis=1)
_DN = np.stack([_POINTS - 0.5, _POINTS + 0.5, -2 * _POINTS], axis=1)

#: ∂(y₂ d₃ − y₃ d₂)/∂y = _TURN d, and ∂/∂d = −_TURN y.
_TURN = np.array([[0.0, 0, 0], [0, 0, 1], [0, -1, 0]])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Loop:
    """Edges (e, 3) of a section, both ends and the middle, all in one direction around what they enclose."""

    edges: Ints

    def volume(self, y: Array, strains: Array) -> float:
        """V′ at positions (n, 3) and strains (4,)."""
        at, step = self._at(y)
        turned = at[..., 1] * step[..., 2] - at[..., 2] * step[..., 1]
        integrand = 0.5 * strains[0] * turned - 0.5 * (at**2).sum(-1) * (step @ strains[1:])
        return float((integrand @ _WEIGHTS).sum())

    def _at(self, y: Array) -> tuple[Array, Array]:
        """Positions and their derivatives (e, g, 3) along the edges."""
        own = y[self.edges]
        return np.einsum("ga,eai->egi", _N, own), np.einsum("ga,eai->egi", _DN, own)

    def derivatives(self, y: Array, strains: Array) -> tuple[Array, Array]:
        """Gradient (e, 9 + 4) and Hessian (e, 13, 13) of the part of each edge."""
        at, step = self._at(y)
        stretch, kappa = strains[0], strains[1:]
        square, flow = (at**2).sum(-1), step @ kappa
        by_at = 0.5 * stretch * step @ _TURN.T - flow[..., None] * at
        by_step = -0.5 * stretch * at @ _TURN.T - 0.5 * square[..., None] * kappa
        count, size = len(self.edges), 9 + STRAINS
        r, K = np.zeros((count, size)), np.zeros((count, size, size))
        r[:, :9] = (_summed(by_at, _N) + _summed(by_step, _DN)).reshape(count, 9)
        turned = at[..., 1] * step[..., 2] - at[..., 2] * step[..., 1]
        r[:, 9] = 0.5 * turned @ _WEIGHTS
        r[:, 10:] = -0.5 * np.einsum("g,eg,egi->ei", _WEIGHTS, square, step)
        W = _WEIGHTS
        twice = -np.einsum("g,eg,ga,gb,ij->eaibj", W, flow, _N, _N, np.eye(3))
        cross = 0.5 * stretch * _TURN - at[..., :, None] * kappa
        both = np.einsum("g,ga,gb,egij->eaibj", W, _N, _DN, cross)
        K[:, :9, :9] = (twice + both + both.transpose(0, 3, 4, 1, 2)).reshape(count, 9, 9)
        by_stretch = _summed(0.5 * step @ _TURN.T, _N) + _summed(-0.5 * at @ _TURN.T, _DN)
        K[:, :9, 9] = by_stretch.reshape(count, 9)
        by_kappa = -np.einsum("g,ga,egi,egj->eaij", W, _N, at, step)
        by_kappa -= 0.5 * np.einsum("g,ga,eg,ij->eaij", W, _DN, square, np.eye(3))
        K[:, :9, 10:] = by_kappa.reshape(count, 9, 3)
        K[:, 9:, :9] = np.swapaxes(K[:, :9, 9:], 1, 2)
        return r, K

    @property
    def unknowns(self) -> int:
        """Degrees of freedom of an edge."""
        return 9 + STRAINS


def _summed(values: Array, table: Array) -> Array:
    """∑ over the points of values (e, g, 3) and shape functions (g, 3): (e, 3, 3)."""
    return np.asarray(np.einsum("g,ga,egi->eai", _WEIGHTS, table, values))
