"""Modes: the displacements and mean stresses that a reduced model combines."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Modes:
    """Orthonormal modes of snapshots.

    Parameters
    ----------
    vectors : (size, r) array
    dual : (size, r) array
        The inner product times the modes: coordinates of a vector are dualᵀ vector.
    missed : float
        Square size of the snapshots that the modes miss, over the whole.
    """

    vectors: Array
    dual: Array
    missed: float


def modes_of(snapshots: Array, product: sp.spmatrix, most: int, truncation: float) -> Modes:
    """Find the modes that miss least of snapshots (size, k).

    Parameters
    ----------
    snapshots : (size, k) array
    product : (size, size) sparse array
        Inner product.
    most : int
    truncation : float
        Share of the square sizes that may be missed.

    Returns
    -------
    Modes
    """
    gram = snapshots.T @ (product @ snapshots)
    values, turns = np.linalg.eigh(0.5 * (gram + gram.T))
    values, turns = np.maximum(values[::-1], 0.0), turns[:, ::-1]
    missed = 1.0 - np.cumsum(values) / values.sum()
    count = min(most, int(np.searchsorted(-missed, -truncation)) + 1, int((values > 1e-13 * values[0]).sum()))
    vectors = snapshots @ (turns[:, :count] / np.sqrt(values[:count]))
    for _ in range(2):  # round-off of small values
        lower = np.linalg.cholesky(vectors.T @ (product @ vectors))
        vectors = np.linalg.solve(lower, vectors.T).T
    return Modes(vectors, np.asarray(product @ vectors), max(0.0, float(missed[count - 1])))


def rest_stiffness(system: System) -> sp.csc_matrix:
    """Stiffness (3 n, 3 n) of the nodes of the mesh at rest along x, y and z, without supports, ties and contact."""
    at = system.evaluate(np.zeros(system.size), 0.0)
    assert at is not None
    base, n = system.layout.base, 3 * len(system.model.mesh.points)
    data = np.zeros(len(base.indices))
    system.rubber.add_tangents(data, system.split(at.unknowns), at.isochoric, None, False)
    system.terms.add(data, system.terms.tangents(Configuration(system.points), None))
    return base.full(data)[:n, :n]


def with_more(modes: Modes, vectors: Array, product: sp.spmatrix, most: int) -> Modes:
    """Add modes of what is left of other vectors (size, k).

    Parameters
    ----------
    modes : Modes
    vectors : (size, k) array
    product : (size, size) sparse array
        Inner product.
    most : int
        Modes that are added at most.

    Returns
    -------
    Modes
    """
    left = vectors - modes.vectors @ (modes.dual.T @ vectors)
    more = modes_of(left, product, most, 1e-4).vectors
    more = more - modes.vectors @ (modes.dual.T @ more)
    both = np.hstack([modes.vectors, more])
    return Modes(both, np.asarray(product @ both), modes.missed)


def normalized(vectors: Array, product: sp.spmatrix) -> tuple[Array, Array]:
    """Vectors (size, k) of a size of one in an inner product, and the sizes that they had."""
    sizes = np.sqrt(np.einsum("nk,nk->k", vectors, product @ vectors))
    return vectors / sizes, np.asarray(sizes)
