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
    spread = _spread(before, middles)
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


def _spread(prescribed: PrescribedComponents, middles: Middles) -> sp.csr_matrix:
    """Displacements of the middles along x, y and z from the components that do not follow."""
    count = len(prescribed.mask)
    weights = sp.csr_matrix((middles.weights, (middles.followers, middles.leaders)), shape=(count, count))
    out = (sp.kron(weights, sp.identity(3), format="csr") @ prescribed.spread()).tocsr()
    out.eliminate_zeros()
    return out
