"""CableTerm: the forces of a cable on its guides, from the tensions of its pieces."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.attached import Attached, attach
from turgor.core.engine.faces.settings import SIDE_SEARCH
from turgor.core.engine.term import Configuration, Term, displacements, lower
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Pulled:
    """Directions, lengths and tensions of the pieces of a cable, with their derivatives by the positions of the guides.

    Parameters
    ----------
    directions : (s, 3) array
    lengths, tensions : (s,) array
    by_guides : (s, g, 3) array
        Derivatives of the tensions.
    """

    directions: Array
    lengths: Array
    tensions: Array
    by_guides: Array


@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """A cable on the mesh at rest.

    Parameters
    ----------
    nodes : (k,) int array
        Nodes that carry the guides.
    shares : (g, k) array
        Shares of the nodes in the motion of each guide.
    rest : (g, 3) array
        Scaled positions of the guides at rest.
    points : (k, 3) array
        Scaled positions of the nodes at rest.
    part : float
        Share of the cable that the modeled part carries: half of one in a mirror plane.
    """

    nodes: Ints
    shares: Array
    rest: Array
    points: Array
    part: float


@dataclass(frozen=True, eq=False)
class CableTerm(Term):
    """Forces of a cable: at a guide the tension before it and that after it, each along its piece.

    A subclass says how large the tensions are.
    """

    external = True
    couples = True

    load: Any
    laid: Laid

    def pulled(self, at: Configuration) -> Pulled:
        """Directions, lengths and tensions of the pieces, of the modeled part."""
        raise NotImplementedError

    @property
    def memory_key(self) -> str:
        """Key of its internal variables."""
        return f"cable {self.load.place}"

    @property
    def unknowns(self) -> Ints:
        """Displacements of all nodes that carry a guide, (1, 3 k)."""
        return displacements(self.laid.nodes[None])

    @cached_property
    def rest_lengths(self) -> Array:
        """Scaled lengths of the pieces at rest."""
        return np.asarray(np.linalg.norm(np.diff(self.laid.rest, axis=0), axis=1))

    def guides(self, at: Configuration) -> Array:
        """Scaled positions (g, 3) of the guides."""
        moved = at.position[self.laid.nodes] - self.laid.points
        return np.asarray(self.laid.rest + self.laid.shares @ moved)

    def way(self, at: Configuration) -> tuple[Array, Array]:
        """Directions (s, 3) and lengths (s,) of the pieces."""
        chords = np.diff(self.guides(at), axis=0)
        lengths = np.linalg.norm(chords, axis=1)
        return chords / lengths[:, None], lengths

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces on the nodes."""
        pulled = self.pulled(at)
        pieces = pulled.tensions[:, None] * pulled.directions
        on_guides = np.vstack([pieces, np.zeros(3)]) - np.vstack([np.zeros(3), pieces])
        out[self.laid.nodes] += self.laid.shares.T @ on_guides

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Symmetric part of the derivative of minus the forces."""
        whole = self.derivative(at)
        return lower(0.5 * (whole + whole.T)[None])

    def derivative(self, at: Configuration) -> Array:
        """Derivative (3 k, 3 k) of minus the forces by the displacements of the nodes."""
        pulled, shares = self.pulled(at), self.laid.shares
        count = len(self.laid.rest)
        by_guides = np.einsum("si,sgj->sigj", pulled.directions, pulled.by_guides)
        across = np.eye(3) - np.einsum("si,sj->sij", pulled.directions, pulled.directions)
        across *= (pulled.tensions / pulled.lengths)[:, None, None]
        pieces = np.arange(count - 1)
        by_guides[pieces, :, pieces + 1] += across
        by_guides[pieces, :, pieces] -= across
        whole = np.zeros((count, 3, count, 3))
        whole[:-1] -= by_guides
        whole[1:] += by_guides
        return np.einsum("gk,giHj,Hl->kilj", shares, whole, shares).reshape(3 * len(self.laid.nodes), -1)


def by_length(directions: Array) -> Array:
    """Derivative (g, 3) of the length of a cable by the positions of its guides."""
    return np.vstack([np.zeros(3), directions]) - np.vstack([directions, np.zeros(3)])


def lay_cable(mesh: Mesh, points: Array, length: float, load: Any) -> Laid:
    """Lay a cable on the nodes of a mesh, whose scaled positions are ``points``.

    Raises
    ------
    TurgorError
        If a guide is not on the surface, or the cable is on both sides of a mirror plane.
    """
    if mesh.revolved:
        raise TurgorError(f"a {load.kind} does not run around an axisymmetric mesh; take another kind of cells.")
    guides = [_guide(mesh, load.kind, number, point) for number, point in enumerate(load.through, start=1)]
    nodes = np.unique(np.concatenate([each.nodes for each in guides]))
    shares = np.zeros((len(guides), len(nodes)))
    for row, each in enumerate(guides):
        np.add.at(shares[row], np.searchsorted(nodes, each.nodes), each.shares)
    return Laid(nodes, shares, np.array(load.through) / length, points[nodes], _modeled_part(mesh, load))


def _guide(mesh: Mesh, kind: str, number: int, point: tuple[float, float, float]) -> Attached:
    guide = attach(mesh, point, mesh.mirror_planes)
    limit = SIDE_SEARCH.point_force_within * float(np.ptp(mesh.points, axis=0).max())
    away = float(np.linalg.norm(guide.arm))
    if away > limit:
        raise TurgorError(
            f"{kind}: point {number} of through is {away / mm:.4g} mm away from the surface; guides are on the "
            f"surface, or within {limit / mm:.3g} mm of it."
        )
    if (guide.mirrored < 0).any():
        raise TurgorError(f"{kind}: point {number} of through is beyond the mirror plane; give the modeled half of it.")
    return guide


def _modeled_part(mesh: Mesh, load: Any) -> float:
    part, points = 1.0, np.array(load.through)
    size = float(np.ptp(mesh.points, axis=0).max())
    for axis, position in mesh.mirror_planes:
        inside = np.abs(points[:, axis] - position) <= ROUND_OFF.mesh_digits * size
        if inside.any() and not inside.all():
            raise TurgorError(
                f"{load.kind}: it leaves the mirror plane normal to {'xyz'[axis]} at point "
                f"{int(np.argmin(inside)) + 1}; model the whole actuator (symmetric = false)."
            )
        part *= 0.5 if inside.all() else 1.0
    return part
