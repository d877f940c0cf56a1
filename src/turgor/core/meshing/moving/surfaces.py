"""Surfaces of CAD faces: points at parameters, and the nearest points to others."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.moving.settings import MOVING

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Surface:
    """The surface of a CAD face, which goes on beyond its edges.

    Parameters
    ----------
    face : CAD face
    surface : CAD surface
    scale : float [m]
        Length of one CAD unit.
    """

    face: Any
    surface: Any
    scale: float

    @property
    def center(self) -> Array:
        """Center (3,) of the face [m]."""
        center = self.face.center
        return np.array([center.x, center.y, center.z]) * self.scale

    def at(self, uv: Array) -> tuple[Array, Array, Array]:
        """Points (n, 3) [m] and derivatives by both parameters (n, 3), at parameters (n, 2)."""
        if self.plane is not None and len(uv):
            origin, along, across = self.plane
            points = origin + uv[:, :1] * along + uv[:, 1:] * across
            return points, np.broadcast_to(along, points.shape), np.broadcast_to(across, points.shape)
        return self._evaluated(uv)

    @cached_property
    def plane(self) -> tuple[Array, Array, Array] | None:
        """Origin and both derivatives of a plane; None for other surfaces."""
        points, along, across = self._evaluated(np.array([[0.0, 0.0], [0.3, 0.2], [0.1, 0.7], [0.9, 0.4]]))
        size = float(np.abs([along, across]).max())
        if np.abs(along - along[0]).max() + np.abs(across - across[0]).max() > MOVING.exact * size:
            return None
        return points[0], along[0], across[0]

    def _evaluated(self, uv: Array) -> tuple[Array, Array, Array]:
        derivatives = [self.surface.D1(u, v) for u, v in uv.tolist()]
        flat = (
            np.array([[(each.x, each.y, each.z) for each in one] for one in derivatives]).reshape(-1, 3, 3) * self.scale
        )
        return flat[:, 0], flat[:, 1], flat[:, 2]

    def nearest(self, points: Array, uv: Array) -> tuple[Array, Array]:
        """Find the nearest points of the surface, from parameters close to theirs: parameters (n, 2), points (n, 3)."""
        uv = np.array(uv, dtype=np.float64)
        nearest, along, across = (np.array(each) for each in self.at(uv))
        size = max(float(np.abs(points).max(initial=0.0)), 1e-300)
        active = np.arange(len(uv))
        for _ in range(MOVING.iterations):
            step = _step(points[active] - nearest[active], along[active], across[active])
            length = np.linalg.norm(step[:, :1] * along[active] + step[:, 1:] * across[active], axis=1)
            active, step = active[length > MOVING.exact * size], step[length > MOVING.exact * size]
            if not len(active):
                break
            uv[active] += step
            nearest[active], along[active], across[active] = self.at(uv[active])
        return uv, nearest

    def searched(self, point: Array, size: float) -> tuple[Array, float]:
        """Search for the parameters (2,) of a point (3,) on a face of a size [m], and return how far off they are."""
        if self.plane is not None:
            uv, nearest = self.nearest(point[None], np.zeros((1, 2)))
            return uv[0], float(np.linalg.norm(nearest[0] - point))
        shares = np.array(MOVING.starts)
        length = size / self.scale
        one = np.unique(np.concatenate([shares, 2 * np.pi * shares, length * shares, -length * shares]))
        starts = np.stack(np.meshgrid(one, one), axis=-1).reshape(-1, 2)
        away = np.linalg.norm(self.at(starts)[0] - point, axis=1)
        best = starts[np.argsort(away)[: MOVING.refined]]
        uv, nearest = self.nearest(np.tile(point, (len(best), 1)), best)
        away = np.linalg.norm(nearest - point, axis=1)
        return uv[away.argmin()], float(away.min())


def surface_of(face: Any, scale: float) -> Surface:
    """Return the surface of a CAD face.

    Parameters
    ----------
    face : CAD face
    scale : float [m]
        Length of one CAD unit.

    Returns
    -------
    Surface
    """
    return Surface(face, face.surf, scale)


def _step(missing: Array, along: Array, across: Array) -> Array:
    """Change of parameters (n, 2) that takes points of a surface nearest to others, of which (n, 3) is left."""
    a, b, c = (np.einsum("ni,ni->n", *pair) for pair in ((along, along), (along, across), (across, across)))
    r, s = (np.einsum("ni,ni->n", missing, each) for each in (along, across))
    determinant = a * c - b * b
    safe = np.where(determinant > 1e-14 * a * c, determinant, np.inf)  # nothing moves at a pole
    return np.asarray(np.stack([(c * r - b * s) / safe, (a * s - b * r) / safe], axis=1))
