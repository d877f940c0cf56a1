"""Harmonic extension: motions given at some nodes, continued over triangles or tetrahedra by Laplace's equation."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A six-node triangle as four of three nodes.
QUARTERS = np.array([(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)])


@dataclass(frozen=True, eq=False)
class Extension:
    """The harmonic extension from some nodes to others; a linear motion stays linear.

    Parameters
    ----------
    stiffness : (n, n) sparse array
        Of Laplace's equation.
    free : (k,) int array
        Nodes whose motion is unknown.
    """

    stiffness: csr_array
    free: Ints

    def extended(self, motion: Array) -> Array:
        """Motions (k, 3) of the free nodes, of those of all others in (n, 3)."""
        if not len(self.free):
            return np.zeros((0, 3))
        given = motion.copy()
        given[self.free] = 0.0
        return np.asarray(self._factors.solve(-(self.stiffness @ given)[self.free]))

    @cached_property
    def _factors(self) -> Any:
        return splu(self.stiffness[self.free][:, self.free].tocsc())


def over_triangles(points: Array, triangles: Ints, free: Ints) -> Extension:
    """Return the extension over faces of six-node triangles, to nodes inside them.

    Parameters
    ----------
    points : (n, 3) array [m]
    triangles : (f, 6) int array
    free : (k,) int array

    Returns
    -------
    Extension
    """
    return Extension(_laplace(points, triangles[:, QUARTERS].reshape(-1, 3)), free)


def over_cells(points: Array, cells: Ints, free: Ints) -> Extension:
    """Return the extension over the corners of tetrahedra.

    Parameters
    ----------
    points : (n, 3) array [m]
    cells : (c, 4) int array
    free : (k,) int array

    Returns
    -------
    Extension
    """
    return Extension(_laplace(points, cells), free)


def _laplace(points: Array, simplices: Ints) -> csr_array:
    """Stiffness of Laplace's equation on linear triangles or tetrahedra."""
    edges = points[simplices[:, 1:]] - points[simplices[:, :1]]
    metric = edges @ edges.transpose(0, 2, 1)
    inverse = np.linalg.inv(metric)  # gradients of all corners but the first, multiplied with each other
    factor = np.sqrt(np.linalg.det(metric))
    first = -inverse.sum(axis=2)
    corner = np.concatenate([-first.sum(axis=1, keepdims=True), first], axis=1)[:, None]
    local = np.concatenate([corner, np.concatenate([first[:, :, None], inverse], axis=2)], axis=1)
    local *= factor[:, None, None]
    size = simplices.shape[1]
    rows, columns = np.repeat(simplices, size, axis=1).ravel(), np.tile(simplices, (1, size)).ravel()
    return coo_array((local.ravel(), (rows, columns)), shape=(len(points),) * 2).tocsr()
