"""Bending of discrete threads: joints between neighboring trusses that resist a change of their angle.

A joint between trusses with unit tangents τ₁ and τ₂ has the energy ½ E I κ² ℓ of a beam whose curvature is
|τ₂ − τ₁| / ℓ, less the one at rest; ℓ is half of both lengths. It ties the nodes of two neighboring sides. Only the
amount of curvature counts, not its plane: a thread that is bent as much in another plane is not strained, nor is one
that is twisted.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.fiber_trusses import FiberTrusses
from turgor.core.model.fibers import Fibers
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Joints:
    """Joints between neighboring trusses of a thread.

    Parameters
    ----------
    nodes : (k, 2 n) int array
        Nodes of the two sides.
    along : (k, 2, n) array
        Tangents per reference length of the two trusses from the positions of their nodes.
    stiffness : (k,) array
        E I / ℓ.
    rest : (k,) array
        |τ₂ − τ₁| at rest.
    """

    nodes: Ints
    along: Array
    stiffness: Array
    rest: Array

    def scaled(self, length: float, stress: float) -> "Joints":
        """The joints in scaled units."""
        return replace(self, along=self.along * length, stiffness=self.stiffness / (stress * length**3))

    @property
    def unknowns(self) -> Ints:
        """Displacement components that each joint ties, (k, 6 n); nodes of both sides are listed twice."""
        return (3 * self.nodes[:, :, None] + np.arange(3)).reshape(len(self.nodes), -1)


def joints_of(threads: FiberTrusses, fibers: Fibers, points: Array) -> Joints:
    """Join the trusses of each thread, at rest as they lie; ``points`` (n, 3) [m] are the nodes at rest."""
    p = threads.pieces
    first = np.flatnonzero(threads.thread[1:] == threads.thread[:-1])
    pair = np.stack([first, first + 1], axis=1)
    joints = Joints(
        nodes=p.sides[pair].reshape(len(pair), -1),
        along=p.along[pair],
        stiffness=fibers.bending_stiffness / p.weights[pair].mean(axis=1),
        rest=np.zeros(len(pair)),
    )
    tangents, _ = _tangents(joints, points)
    return replace(joints, rest=np.linalg.norm(tangents[:, 1] - tangents[:, 0], axis=1))


def _tangents(joints: Joints, x: Array) -> tuple[Array, Array]:
    """Unit tangents (k, 2, 3) of both trusses and their stretches (k, 2)."""
    at = x[joints.nodes].reshape(len(joints.nodes), 2, -1, 3)
    t = np.einsum("ksa,ksai->ksi", joints.along, at)
    size = np.linalg.norm(t, axis=2)
    return t / size[..., None], size


def _bent(joints: Joints, tangents: Array) -> Array:
    """|τ₂ − τ₁| of each joint, more than zero, so that a straight joint has a direction to bend in."""
    return np.maximum(np.linalg.norm(tangents[:, 1] - tangents[:, 0], axis=1), ROUND_OFF.same)


def bending_energy(joints: Joints, x: Array) -> float:
    """Energy of all joints at positions ``x``."""
    tangents, _ = _tangents(joints, x)
    return 0.5 * float((joints.stiffness * (_bent(joints, tangents) - joints.rest) ** 2).sum())


def _slopes(joints: Joints, x: Array) -> tuple[Array, Array, Array, Array]:
    """Unit tangents, stretches, energy by τ₁·τ₂, and τ₁·τ₂ by the two tangents (k, 2, 3)."""
    tangents, size = _tangents(joints, x)
    by_cosine = -joints.stiffness * (1 - joints.rest / _bent(joints, tangents))
    cosine = np.einsum("ki,ki->k", tangents[:, 0], tangents[:, 1])[:, None, None]
    across = (tangents[:, ::-1] - cosine * tangents) / size[..., None]
    return tangents, size, by_cosine, across


def bending_forces(joints: Joints, x: Array) -> Array:
    """Nodal forces (k, 2 n, 3) at positions ``x``."""
    _, _, by_cosine, across = _slopes(joints, x)
    out = np.einsum("k,ksa,ksi->ksai", by_cosine, joints.along, across)
    return np.asarray(out.reshape(len(joints.nodes), -1, 3))


def bending_tangents(joints: Joints, x: Array) -> Array:
    """Stiffness (k, 6 n, 6 n) at positions ``x``."""
    tangents, size, by_cosine, across = _slopes(joints, x)
    count = len(joints.nodes)
    cosine = np.einsum("ki,ki->k", tangents[:, 0], tangents[:, 1])
    curving = joints.stiffness * joints.rest / _bent(joints, tangents) ** 3
    outer = np.einsum("ksi,ksj->ksij", tangents, tangents)
    normal = np.eye(3) - outer
    second = np.empty((count, 2, 2, 3, 3))  # second derivatives of the cosine by the two tangents
    for s in (0, 1):
        mixed = np.einsum("ki,kj->kij", across[:, s], tangents[:, s]) / size[:, s, None, None]
        bend = cosine[:, None, None] * normal[:, s] / size[:, s, None, None] ** 2
        second[:, s, s] = -mixed - mixed.transpose(0, 2, 1) - bend
    second[:, 0, 1] = normal[:, 0] @ normal[:, 1] / (size[:, 0] * size[:, 1])[:, None, None]
    second[:, 1, 0] = second[:, 0, 1].transpose(0, 2, 1)
    H = by_cosine[:, None, None, None, None] * second
    H += curving[:, None, None, None, None] * np.einsum("ksi,kuj->ksuij", across, across)
    K = np.einsum("ksa,kub,ksuij->ksaiubj", joints.along, joints.along, H, optimize=True)
    width = 3 * joints.nodes.shape[1]
    return np.asarray(K.reshape(count, width, width))


def lower_of_doubled(local: Array, unknowns: Ints) -> Array:
    """Lower triangles of matrices row by row, where an unknown may be listed twice: its mixed entries count double."""
    rows, columns = np.tril_indices(local.shape[1])
    doubled = (unknowns[:, rows] == unknowns[:, columns]) & (rows != columns)
    return np.asarray((local[:, rows, columns] * (1.0 + doubled)).ravel())
