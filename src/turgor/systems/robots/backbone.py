"""Backbone: slices across the axis of an actuator, whose poses follow from the coordinates of a reduced model.

The pose of a slice is the rigid motion x → c + R (X − C) that is closest to that of its plane, with weights of volume.
R is the rotation of the polar decomposition of Σ w x ⊗ A, which is linear in the coordinates. The arms A are the parts
of X − C in the plane, less what is correlated with the place along the axis: a wall that bulges more at one side of
the slice than at the other turns nothing.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.mass import cell_volumes
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.reduced import Reduced

Array: TypeAlias = NDArray[np.float64]


#: A slice whose second moment along x is smaller than this share of the others is a plane.
FLAT = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Slice:
    """Nodes of a slice with their weights, whose sum is one.

    Parameters
    ----------
    nodes : (k,) int array
    weights : (k,) array
    center : (3,) array [m]
        Of the whole actuator at rest.
    second : (3, 3) array [m²]
        Σ w (X − C) ⊗ A of the whole actuator, symmetric.
    lean : (3,) array
        A = X − C − lean times its part along x.
    """

    nodes: NDArray[np.int64]
    weights: Array
    center: Array
    second: Array
    lean: Array

    def arms(self, points: Array) -> Array:
        """Arms (k, 3) [m] of places (k, 3) at rest."""
        away = points - self.center
        return np.asarray(away - away[:, :1] * self.lean)


@dataclass(frozen=True, slots=True, eq=False)
class Backbone:
    """Slices of a reduced model from the base to the tip.

    Parameters
    ----------
    slices : tuple of Slice
        The last is the face ``tip`` where there is one.
    centers : (m, 3, r) array [m]
        Modes of the mean displacement of each.
    moments : (m, 3, 3, 1 + r) array [m²]
        Of positions with those at rest: at rest, then the modes.
    base : (3,) array [m]
        Center of the end that is fixed.
    length : float [m]
    """

    slices: tuple[Slice, ...]
    centers: Array
    moments: Array
    base: Array
    length: float

    def poses(self, q: Array) -> tuple[Array, Array]:
        """Rotations (m, 3, 3) and positions (m, 3) [m] of the slices at coordinates (r,)."""
        places = np.array([each.center for each in self.slices]) + self.centers @ q
        return rotations_of(self.moments @ np.concatenate([[1.0], q])), places

    def frames(self, q: Array) -> tuple[Array, Array]:
        """Poses (m + 1) with that of the base first, which does not move."""
        turns, places = self.poses(q)
        return np.concatenate([np.eye(3)[None], turns]), np.concatenate([self.base[None], places])


def rotations_of(moments: Array) -> Array:
    """Rotations (m, 3, 3) that are closest to matrices (m, 3, 3)."""
    u, _, v = np.linalg.svd(moments)
    u[..., :, 2] *= np.sign(np.linalg.det(u @ v))[..., None]
    return np.asarray(u @ v)


def backbone_of(reduced: Reduced, links: int) -> Backbone:
    """Cut a reduced model into slices at the ends of equal links.

    Parameters
    ----------
    reduced : Reduced
        Of an actuator along x that is fixed where x is smallest.
    links : int
        At least 2.

    Returns
    -------
    Backbone
    """
    if not 2 <= links <= 60:
        raise TurgorError(f"the number of links is {links}; allowed is 2 to 60.")
    mesh, scale = reduced.model.mesh, reduced.scales[0]
    facts, weights = MeshFacts(mesh), nodal_volumes(mesh)
    low, length = float(mesh.points[:, 0].min()), float(np.ptp(mesh.points[:, 0]))
    at, half = low + length * np.arange(1, links + 1) / links, max(0.5 * length / links, scale)
    slices = [slice_of(facts, np.abs(mesh.points[:, 0] - x) <= half, weights) for x in at]
    if "tip" in mesh.faces:
        on_tip = np.zeros(len(weights), dtype=bool)
        on_tip[np.unique(mesh.face("tip"))] = True
        slices[-1] = slice_of(facts, on_tip, np.ones(len(weights)))
    modes = reduced.modes.reshape(len(weights), 3, -1)
    centers, moments = [], []
    for each in slices:
        own = modes[each.nodes].astype(np.float64) * scale
        centers.append(facts.of_whole(np.einsum("n,ncr->rc", each.weights, own)).T)
        moments.append(np.concatenate([each.second[..., None], _moments(facts, each, own)], axis=-1))
    if "tip" in mesh.faces:
        centers[-1] = reduced.tip * scale
    base = slice_of(facts, mesh.points[:, 0] - low <= half, weights).center.copy()
    base[0] = low
    return Backbone(tuple(slices), np.array(centers), np.array(moments), base, length)


def nodal_volumes(mesh: Mesh) -> Array:
    """Volume (n,) [m³] that each corner stands for: an even share of its cells; zero for other nodes."""
    corners = mesh.cell_type.corners
    shares = np.repeat(cell_volumes(mesh)[:, None] / corners, corners, axis=1)
    out = np.bincount(mesh.cells[:, :corners].ravel(), shares.ravel(), minlength=len(mesh.points))
    return out.astype(np.float64)


def slice_of(facts: MeshFacts, inside: NDArray[np.bool_], weights: Array) -> Slice:
    """Nodes with weights as a slice, of which the whole actuator has all mirror images."""
    nodes = np.flatnonzero(inside & (weights > 0))
    if len(nodes) < 4:
        raise TurgorError(f"a slice has {len(nodes)} nodes of the mesh; take fewer links.")
    share = weights[nodes] / weights[nodes].sum()
    points = facts.mesh.points[nodes]
    images = [image.of(points) for image in facts.images]
    center = np.mean([share @ each for each in images], axis=0)
    away = [each - center for each in images]
    whole = np.mean([np.einsum("n,na,nb->ab", share, each, each) for each in away], axis=0)
    lean = np.array([1.0, *(whole[0, 1:] / whole[0, 0] if whole[0, 0] > FLAT * np.trace(whole) else (0.0, 0.0))])
    second = whole - np.outer(whole[:, 0], lean)
    second[0] = 0.0
    return Slice(nodes, share, center, second, lean)


def _moments(facts: MeshFacts, piece: Slice, modes: Array) -> Array:
    """Moments (3, 3, r) of modes (k, 3, r) of displacement with the positions at rest, of the whole actuator."""
    out = np.zeros((3, 3, modes.shape[2]))
    for image in facts.images:
        arm = piece.arms(image.of(facts.mesh.points[piece.nodes]))
        moved = np.einsum("ab,nbr->nar", image.turn, modes)
        out += np.einsum("n,nar,nb->abr", piece.weights, moved, arm, optimize=True)
    return out / len(facts.images)
