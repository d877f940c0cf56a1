"""Tension of threads: at each piece by itself, and averaged over the sides of cells around it."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.fiber_kernels import Pieces
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.meshing.cells import SIDE_TYPES, cell_type, side_type
from turgor.core.model.fibers import Fibers

Array = NDArray[np.float64]


def tangents(pieces: Pieces, points: Array) -> Array:
    """Current tangent of each piece per reference length, (k, 3), from current positions of the nodes (n, 3) [m]."""
    return np.asarray(np.einsum("ka,kai->ki", pieces.along, points[pieces.sides]))


def piece_tension(fibers: Fibers, stretch: Array, rest: ThreadRest) -> Array:
    """Tension of one thread at each piece by itself, (k,) [N], from its stretch beyond that without stress."""
    share = np.where(stretch >= 1, rest.stiffness, fibers.compression * rest.stiffness)
    return np.asarray(share * fibers.stretching_stiffness * (stretch - 1))


def smooth_tension(pieces: Pieces, tension: Array) -> Array:
    """Average tensions over the sides of cells around each piece, weighted by length or area.

    Threads hardly stretch, and the strains of a quadratic side are not exact enough for them. Along a thread the
    tension jumps from truss to truss, and in the middle of a side it is twice as large as near the edge. The average is
    right. Each node of the mesh gets the average of the sides around it, by hand of the winding, and each side the
    average of its corners. This averages over two sides in every direction. Embedded threads, whose pieces lie in
    cells, are averaged over two cells along each thread.

    Parameters
    ----------
    pieces : Pieces
    tension : (k,) array [N]
        Tension at each piece by itself.

    Returns
    -------
    (k,) array [N]
    """
    count = pieces.sides.shape[1]
    corners = (side_type if count in {each.nodes for each in SIDE_TYPES} else cell_type)(count).corners
    nodes = pieces.sides[:, :corners]
    _, places = np.unique(nodes + (nodes.max() + 1) * pieces.hand[:, None], return_inverse=True)
    places = places.reshape(nodes.shape)
    weights = np.repeat(pieces.weights, corners)
    total = np.bincount(places.ravel(), weights)
    weighted = np.bincount(places.ravel(), weights * np.repeat(tension, corners))
    return np.asarray((weighted / np.where(total > 0, total, 1.0))[places].mean(axis=1))
