"""TendonTerm: the forces of a cable on its guides, with the tension that friction leaves along it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.faces.attached import Attached, attach
from turgor.core.engine.faces.settings import SIDE_SEARCH
from turgor.core.engine.term import Configuration, Setting, Term, displacements, lower
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import share_at
from turgor.core.model.loads.tendon import Tendon
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Sine of the turn at a guide below which friction is flat there: the direction of a turn of zero is not defined.
STRAIGHT = 1e-9


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


@dataclass(frozen=True, eq=False)
class TendonTerm(Term):
    """Forces of a cable: at a guide the tension before it and that after it, each along its piece.

    Parameters
    ----------
    load : Tendon
    nodes : (k,) int array
        Nodes that carry the guides.
    shares : (g, k) array
        Shares of the nodes in the motion of each guide.
    rest : (g, 3) array
        Scaled positions of the guides at rest.
    points : (k, 3) array
        Scaled positions of the nodes at rest.
    tension : float
        Scaled tension at a share of one on the modeled part; 0 where the pull is given.
    stiffness, pull : float
        Scaled, of the modeled part; 0 where the tension is given.
    """

    external = True
    couples = True

    load: Tendon
    nodes: Ints
    shares: Array
    rest: Array
    points: Array
    tension: float
    stiffness: float
    pull: float

    @property
    def unknowns(self) -> Ints:
        """Displacements of all nodes that carry a guide, (1, 3 k)."""
        return displacements(self.nodes[None])

    @cached_property
    def _rest_lengths(self) -> Array:
        return np.asarray(np.linalg.norm(np.diff(self.rest, axis=0), axis=1))

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces on the nodes."""
        pulled = self.pulled(at)
        pieces = pulled.tensions[:, None] * pulled.directions
        on_guides = np.vstack([pieces, np.zeros(3)]) - np.vstack([np.zeros(3), pieces])
        out[self.nodes] += self.shares.T @ on_guides

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Symmetric part of the derivative of minus the forces."""
        whole = self._derivative(at)
        return lower(0.5 * (whole + whole.T)[None])

    def unsymmetric(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Skew part of it, which friction makes."""
        if not self.load.friction:
            return None
        whole, unknowns = self._derivative(at), self.unknowns[0]
        places = (np.repeat(unknowns, len(unknowns)), np.tile(unknowns, len(unknowns)))
        return sp.csc_matrix((0.5 * (whole - whole.T).ravel(), places), shape=(size, size))

    def _derivative(self, at: Configuration) -> Array:
        """Derivative (3 k, 3 k) of minus the forces by the displacements of the nodes."""
        pulled = self.pulled(at)
        count = len(self.rest)
        by_guides = np.einsum("si,sgj->sigj", pulled.directions, pulled.by_guides)
        across = np.eye(3) - np.einsum("si,sj->sij", pulled.directions, pulled.directions)
        across *= (pulled.tensions / pulled.lengths)[:, None, None]
        pieces = np.arange(count - 1)
        by_guides[pieces, :, pieces + 1] += across
        by_guides[pieces, :, pieces] -= across
        whole = np.zeros((count, 3, count, 3))
        whole[:-1] -= by_guides
        whole[1:] += by_guides
        return np.einsum("gk,giHj,Hl->kilj", self.shares, whole, self.shares).reshape(3 * len(self.nodes), -1)

    def guides(self, at: Configuration) -> Array:
        """Scaled positions (g, 3) of the guides."""
        return np.asarray(self.rest + self.shares @ (at.position[self.nodes] - self.points))

    def pulled(self, at: Configuration) -> Pulled:
        """Directions, lengths and tensions of the pieces, of the modeled part."""
        chords = np.diff(self.guides(at), axis=0)
        lengths = np.linalg.norm(chords, axis=1)
        directions = chords / lengths[:, None]
        left, left_by = self._left(directions, lengths)
        share, total_by = share_at(self.load.history, at.load_factor), _of_length(directions)
        if self.load.tension is not None:
            first, first_by = share * self.tension, np.zeros_like(total_by)
        else:
            weights = self._rest_lengths / self._rest_lengths.sum()
            mean, mean_by = float(weights @ left), np.einsum("s,sgj->gj", weights, left_by)
            drawn = float((lengths - self._rest_lengths).sum()) + share * self.pull
            taut = drawn > 0
            first = self.stiffness * drawn / mean if taut else 0.0
            first_by = self.stiffness * total_by / mean - first * mean_by / mean if taut else np.zeros_like(total_by)
        by_guides = left[:, None, None] * first_by + first * left_by
        return Pulled(directions, lengths, first * left, by_guides)

    def _left(self, directions: Array, lengths: Array) -> tuple[Array, Array]:
        """Share (s,) of the motor's tension that is left in each piece, and its derivative (s, g, 3) by the guides."""
        count, friction = len(directions), self.load.friction
        left, left_by = np.ones(count), np.zeros((count, count + 1, 3))
        turned, turned_by = 0.0, np.zeros((count + 1, 3))
        for i in range(1, count if friction else 1):
            before, after = directions[i - 1], directions[i]
            cosine, sine = float(before @ after), float(np.linalg.norm(np.cross(before, after)))
            turned += float(np.arctan2(sine, cosine))
            if sine > STRAIGHT:
                by_before = -(after - cosine * before) / sine / lengths[i - 1]
                by_after = -(before - cosine * after) / sine / lengths[i]
                turned_by[i - 1] -= by_before
                turned_by[i] += by_before - by_after
                turned_by[i + 1] += by_after
            left[i] = np.exp(-friction * turned)
            left_by[i] = -friction * left[i] * turned_by
        return left, left_by


def _of_length(directions: Array) -> Array:
    """Derivative (g, 3) of the length of the cable by the positions of the guides."""
    return np.vstack([np.zeros(3), directions]) - np.vstack([directions, np.zeros(3)])


def cable_of(mesh: Mesh, load: Any, displacement: Array, load_factor: float) -> tuple[Array, Array]:
    """Guides (g, 3) [m] of a cable in a state, and the tension (g - 1,) [N] of the whole cable in each piece."""
    term = _term_on(mesh, mesh.points, (1.0, 1.0), load)
    at = Configuration(mesh.points + displacement, load_factor)
    return term.guides(at), term.pulled(at).tensions / _modeled_part(mesh, load)


def tendon_terms(setting: Setting) -> list[TendonTerm]:
    """One for each cable."""
    mesh, scales = setting.model.mesh, (setting.length, setting.stress)
    cables = (load.cable for load in setting.model.loads)
    return [_term_on(mesh, setting.points, scales, each) for each in cables if each is not None]


def _term_on(mesh: Mesh, points: Array, scales: tuple[float, float], load: Any) -> TendonTerm:
    """The term of a tendon; refuses points that are not on the surface, or on both sides of a mirror plane."""
    if mesh.revolved:
        raise TurgorError("a tendon does not run around an axisymmetric mesh; take another kind of cells.")
    guides = [_guide(mesh, number, point) for number, point in enumerate(load.through, start=1)]
    nodes = np.unique(np.concatenate([each.nodes for each in guides]))
    shares = np.zeros((len(guides), len(nodes)))
    for row, each in enumerate(guides):
        np.add.at(shares[row], np.searchsorted(nodes, each.nodes), each.shares)
    part = _modeled_part(mesh, load)
    length, stress = scales
    force = stress * length**2
    return TendonTerm(
        load=load,
        nodes=nodes,
        shares=shares,
        rest=np.array(load.through) / length,
        points=points[nodes],
        tension=part * (load.tension or 0.0) / force,
        stiffness=part * (load.cable_stiffness or 0.0) * length / force,
        pull=(load.pull or 0.0) / length,
    )


def _guide(mesh: Mesh, number: int, point: tuple[float, float, float]) -> Attached:
    guide = attach(mesh, point, mesh.mirror_planes)
    limit = SIDE_SEARCH.point_force_within * float(np.ptp(mesh.points, axis=0).max())
    away = float(np.linalg.norm(guide.arm))
    if away > limit:
        raise TurgorError(
            f"tendon: point {number} of through is {away / mm:.4g} mm away from the surface; guides are on the "
            f"surface, or within {limit / mm:.3g} mm of it."
        )
    if (guide.mirrored < 0).any():
        raise TurgorError(f"tendon: point {number} of through is beyond the mirror plane; give the modeled half of it.")
    return guide


def _modeled_part(mesh: Mesh, load: Tendon) -> float:
    """Share of the cable that the modeled part carries: half of one in a mirror plane."""
    part, points = 1.0, np.array(load.through)
    size = float(np.ptp(mesh.points, axis=0).max())
    for axis, position in mesh.mirror_planes:
        inside = np.abs(points[:, axis] - position) <= ROUND_OFF.mesh_digits * size
        if inside.any() and not inside.all():
            raise TurgorError(
                f"tendon: it leaves the mirror plane normal to {'xyz'[axis]} at point "
                f"{int(np.argmin(inside)) + 1}; model the whole actuator (symmetric = false)."
            )
        part *= 0.5 if inside.all() else 1.0
    return part
