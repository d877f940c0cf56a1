"""Distances: lengths of vectors with their first and second derivatives, of which formulas of shapes consist."""

import numpy as np

from turgor.core.model.obstacles.rigid_shape import Array, Distances


def from_center(vectors: Array, plane: Array, shortest: float) -> Distances:
    """Return lengths of vectors in a plane, or in space, with derivatives; the plane is its projector, (3, 3)."""
    length = np.linalg.norm(vectors, axis=1)
    aimless = length <= shortest
    column = plane[:, np.linalg.norm(plane, axis=0).argmax()]
    safe = np.where(aimless, 1.0, length)
    out = np.where(aimless[:, None], column / np.linalg.norm(column), vectors / safe[:, None])
    bend = (plane - outer(out, out)) / safe[:, None, None]
    bend[aimless] = 0.0
    return length, out, bend


def outer(a: Array, b: Array) -> Array:
    """Return the dyads (k, 3, 3) of vectors (k, 3)."""
    return np.asarray(a[:, :, None] * b[:, None, :])
