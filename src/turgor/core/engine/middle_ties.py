"""Ties of the middles of hexahedra to the other nodes of their side or cell, where a mesh has them follow."""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import PrescribedComponents
from turgor.core.engine.algebra.multipoint import MultiPoint
from turgor.core.engine.algebra.node_frames import NodeFrames
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.middles import Middles, middles_of

Ints = NDArray[np.int64]


def with_middles(prescribed: PrescribedComponents, mesh: Mesh) -> PrescribedComponents:
    """Let the middles of a mesh follow, whatever a support prescribes at them; other meshes change nothing.

    A middle follows along x, y and z. Where a node that it follows has directions of its own, or follows others itself,
    what that node follows takes its place. A middle of a rigid face or of a plane section follows these as before.
    """
    if not mesh.serendipity:
        return prescribed
    middles = middles_of(mesh.cells)
    count = len(prescribed.mask)
    is_middle = np.zeros(count, dtype=bool)
    is_middle[middles.followers] = True
    before = _without_turned_middles(prescribed, is_middle)
    spread = _spread(before, middles, 3 * count)
    own = np.repeat(is_middle, 3)
    own[before.ties.followers] = False
    rows = np.flatnonzero(own)
    entries = spread[rows].tocoo()
    ties = MultiPoint(
        np.concatenate([before.ties.followers, rows[entries.row]]),
        np.concatenate([before.ties.leaders, entries.col.astype(np.int64)]),
        np.concatenate([before.ties.weights, entries.data]),
    )
    mask = before.mask.copy()
    mask[is_middle] = True
    moving = tuple((nodes[~is_middle[nodes]], axes, support) for nodes, axes, support in before.moving)
    return replace(before, mask=mask, moving=moving, ties=ties)


def _without_turned_middles(prescribed: PrescribedComponents, is_middle: NDArray[np.bool_]) -> PrescribedComponents:
    """The same without directions, and the ties along them, of middles."""
    frames, ties = prescribed.frames, prescribed.ties
    stays = ~is_middle[frames.nodes]
    turned = np.zeros(len(is_middle), dtype=bool)
    turned[frames.nodes[~stays]] = True
    tied = ~turned[ties.followers // 3]
    return replace(
        prescribed,
        frames=NodeFrames(frames.nodes[stays], frames.axes[stays]),
        normals=prescribed.normals[stays],
        ties=MultiPoint(ties.followers[tied], ties.leaders[tied], ties.weights[tied]),
    )


def _spread(prescribed: PrescribedComponents, middles: Middles, size: int) -> sp.csr_matrix:
    """Displacements of the middles along x, y and z from the components that do not follow."""
    ties, frames = prescribed.ties, prescribed.frames
    axes = np.broadcast_to(np.eye(3), (size // 3, 3, 3)).copy()
    axes[frames.nodes] = frames.axes
    turn = sp.bsr_matrix((axes.transpose(0, 2, 1), np.arange(size // 3), np.arange(size // 3 + 1)), shape=(size, size))
    weights = sp.csr_matrix((middles.weights, (middles.followers, middles.leaders)), shape=(size // 3, size // 3))
    free = np.setdiff1d(np.arange(size), ties.followers)
    rows, columns = np.concatenate([free, ties.followers]), np.concatenate([free, ties.leaders])
    values = np.concatenate([np.ones(len(free)), ties.weights])
    chain = sp.csr_matrix((values, (rows, columns)), shape=(size, size))
    out = (sp.kron(weights, sp.identity(3), format="csr") @ turn.tocsr() @ chain).tocsr()
    out.eliminate_zeros()
    return out
