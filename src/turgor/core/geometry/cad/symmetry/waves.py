"""Waves: how the surface of a part varies about an axis.

A face that goes all around, such as one spline with lobes, lies like its image in any turn by its area, center and
second moments alone. Its waves tell lobes from a circle.
"""

import numpy as np
from numpy.typing import NDArray

from turgor.core.geometry.cad.facets import Facets
from turgor.core.geometry.cad.symmetry.settings import SYMMETRY

Array = NDArray[np.float64]


def surface_waves(facets: Facets, axis: int, center: Array) -> Array:
    """Fourier coefficients (24,) of the surface about an axis, weighted by the radius squared, over that weight.

    Parameters
    ----------
    facets : Facets
    axis : int
        Number of the axis.
    center : (3,) array [CAD units]
        A point on the axis.
    """
    b, c = (axis + 1) % 3, (axis + 2) % 3
    corners = facets.corners() - center
    flat = corners[..., [b, c]]
    longest = np.max([np.linalg.norm(flat[:, i] - flat[:, j], axis=1) for i, j in ((0, 1), (1, 2), (2, 0))], axis=0)
    spots, weights = _spots(corners, longest, 2 * float(np.abs(flat).max()) / SYMMETRY.pieces)
    z = spots[:, b] + 1j * spots[:, c]
    radius = np.abs(z)
    unit = z / np.maximum(radius, 1e-12 * radius.max())
    weights, turned, waves = weights * radius**2, np.ones_like(unit), []
    for _ in range(2 * SYMMETRY.most_fold):
        turned *= unit
        waves.append(abs(complex(weights @ turned)))
    return np.array(waves) / weights.sum()


def returns(waves: Array, fold: int) -> bool:
    """Whether a surface may return to itself by a number of turns: only every fold-th wave is there; 0 for none."""
    orders = np.arange(1, 2 * SYMMETRY.most_fold + 1)
    return bool((waves[orders % fold != 0 if fold else orders > 0] < SYMMETRY.same).all())


def _spots(triangles: Array, longest: Array, size: float) -> tuple[Array, Array]:
    """Centers (s, 3) and areas (s,) of the pieces of triangles (t, 3, 3), cut until sides (t,) are below a size."""
    a, b, c = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = np.linalg.norm(np.cross(b, c), axis=1) / 2
    count = np.clip(np.ceil(longest / size), 1, SYMMETRY.pieces).astype(np.int64)
    spots, weights = [], []
    for n in np.unique(count):
        i, j = (grid.ravel() for grid in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
        upward = np.stack([i, j], axis=1)[i + j < n] + 1 / 3
        downward = np.stack([i, j], axis=1)[i + j < n - 1] + 2 / 3
        at = np.concatenate([upward, downward]) / n
        rows = count == n
        here = a[rows, None] + at[:, :1] * b[rows, None] + at[:, 1:] * c[rows, None]
        spots.append(here.reshape(-1, 3))
        weights.append(np.repeat(area[rows] / n**2, len(at)))
    return np.concatenate(spots), np.concatenate(weights)
