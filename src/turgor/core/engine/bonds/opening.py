"""Opening of a bond across its middle surface, with the derivatives that a tangent needs.

With the distance u between the two sides and the tangents a, b of the surface midway between them, the normal is
n = (a × b)/|a × b| and the opening g = u·n. The squared slip is |u|² − g². Both are the same after any rotation of
the whole, so that forces from an energy in them have no moment.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Levi-Civita symbol: e_i × e_j along e_k.
LEVI_CIVITA = np.cross(np.eye(3)[:, None], np.eye(3)[None])


@dataclass(frozen=True, slots=True, eq=False)
class Opening:
    """Opening at points, with derivatives by u, a and b in this order.

    Parameters
    ----------
    across : (p,) array
        g, negative where the sides are pressed into each other.
    along : (p,) array
        Squared slip.
    across_rate : (p, 3, 3) array
        ∂g.
    along_rate : (p, 3, 3) array
        ∂ of the squared slip.
    normal : (p, 3) array
    size : (p,) array
        |a × b|.
    z : (p, 3, 3) array
        u, a, b.
    """

    across: Array
    along: Array
    across_rate: Array
    along_rate: Array
    normal: Array
    size: Array
    z: Array

    @staticmethod
    def at(z: Array) -> "Opening":
        """That of u, a, b, (p, 3, 3)."""
        u, a, b = z[:, 0], z[:, 1], z[:, 2]
        m = np.cross(a, b)
        size = np.linalg.norm(m, axis=1)
        normal = m / size[:, None]
        g = np.einsum("pi,pi->p", u, normal)
        tilt = (u - g[:, None] * normal) / size[:, None]
        rate = np.stack([normal, np.cross(b, tilt), np.cross(tilt, a)], axis=1)
        slip = -2 * g[:, None, None] * rate
        slip[:, 0] += 2 * u
        along = np.maximum(np.einsum("pi,pi->p", u, u) - g**2, 0.0)
        return Opening(g, along, rate, slip, normal, size, z)

    def second_rate(self) -> Array:
        """∂²g, (p, 9, 9)."""
        u, a, b = self.z[:, 0], self.z[:, 1], self.z[:, 2]
        n, g = self.normal, self.across
        s = u - g[:, None] * n
        flat = np.eye(3) - n[:, :, None] * n[:, None, :]
        mixed = n[:, :, None] * s[:, None, :]
        by_area = -(mixed + mixed.swapaxes(1, 2) + g[:, None, None] * flat) / self.size[:, None, None] ** 2
        turn = np.stack([-_cross(b), _cross(a)], axis=1)  # ∂m by a and b
        out = np.zeros((len(g), 3, 3, 3, 3))
        first = np.einsum("pij,prjk->prik", flat / self.size[:, None, None], turn)
        for r in (0, 1):
            out[:, 0, :, r + 1] = first[:, r]
            out[:, r + 1, :, 0] = first[:, r].swapaxes(1, 2)
            for q in (0, 1):
                out[:, r + 1, :, q + 1] = np.einsum("pki,pkl,plj->pij", turn[:, r], by_area, turn[:, q])
        bent = np.einsum("pi,ijk->pjk", s / self.size[:, None], LEVI_CIVITA)
        out[:, 1, :, 2] += bent
        out[:, 2, :, 1] += bent.swapaxes(1, 2)
        return out.reshape(len(g), 9, 9)


def _cross(v: Array) -> Array:
    """Matrices of v × ."""
    return np.asarray(np.einsum("ijk,pj->pik", LEVI_CIVITA, v))
