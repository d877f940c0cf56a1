"""Networks: a second law at the points of a body, which hardens in a deformed shape and has a reference of its own.

A network has the gradient F_r = Fₑ G with G = F_g F_s⁻¹, F_s being the gradient of the shape in which it has no stress.
Its isochoric energy per volume of the cells at rest is f W(F_r). From S_r and 4 ∂²W/∂C_r² follow S = G S_r Gᵀ and the
moduli with G on each of their four indices. It resists a change of shape only; the volume is that of the cells.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells import spectral
from turgor.core.materials.laws.derivatives import stretch_derivatives
from turgor.core.materials.laws.laws import Law
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """One network of one body.

    Parameters
    ----------
    cells, rows : (c,) int arrays
        Its cells, and their rows among those whose laws need gradients.
    law : Law
    factor : (c, q) array
        On its energy per volume of the stress-free cells.
    reference : (c, q, 3, 3) array
        G.
    """

    cells: Ints
    rows: Ints
    law: Law
    factor: Array
    reference: Array

    def add_response(self, F: Array, stress: Array, tangent: Array, scale: float) -> None:
        """Add stress (s, q, 6) and moduli (s, q, 21) over a scale at gradients F (s, q, 3, 3), in place."""
        bar, directions, size = spectral.principal_stretches(np.ascontiguousarray(F[self.rows] @ self.reference))
        W = np.stack(stretch_derivatives(self.law, *bar)[1:]) * (self.factor / scale)
        S, packed = spectral.spectral_response(bar, directions, size, W[:3], W[3:])
        S, packed = turned(self.reference, S, packed)
        stress[self.rows] += S
        tangent[self.rows] += packed

    def energy(self, F: Array) -> Array:
        """Energy density (c, q) [Pa] at gradients F (s, q, 3, 3)."""
        bar, _, _ = spectral.principal_stretches(np.ascontiguousarray(F[self.rows] @ self.reference))
        return np.asarray(self.factor * stretch_derivatives(self.law, *bar)[0])


def turned(G: Array, S: Array, packed: Array) -> tuple[Array, Array]:
    """Stress (c, q, 6) and moduli (c, q, 21) of a network with the gradient F G, as those by F.

    Parameters
    ----------
    G : (c, q, 3, 3) array
    S, packed : (c, q, 6), (c, q, 21) arrays
        Stress and lower triangle of the moduli by F G.
    """
    turn = _turn(G)
    lower, full = np.tril_indices(6), np.empty((*S.shape[:2], 6, 6))
    full[..., lower[0], lower[1]] = packed
    full[..., lower[1], lower[0]] = packed
    moduli = (turn @ full @ np.swapaxes(turn, -1, -2))[..., lower[0], lower[1]]
    return np.einsum("cqvw,cqw->cqv", turn, S), moduli


def _turn(G: Array) -> Array:
    """Matrices (..., 6, 6) that take the six components of a symmetric A to those of G A Gᵀ."""
    out = np.empty((*G.shape[:-2], 6, 6))
    for w, (k, l) in enumerate(PAIRS):
        for v, (i, j) in enumerate(PAIRS):
            out[..., v, w] = G[..., i, k] * G[..., j, l]
            if k != l:
                out[..., v, w] += G[..., i, l] * G[..., j, k]
    return out
