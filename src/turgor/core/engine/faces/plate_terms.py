"""PlateTerm and HingeTerm: bending of shells, by C0 interior penalty on the quadratic sides of cells.

The energy of a plate that may also bend at the edges of its sides, by angles θ that the penalty keeps small, is

    ∫ ½ κ : ℂ : κ dA + Σ ∫ (−{m} θ + η D / (2 h) θ²) dL,        m = D (κ_νν + ν κ_ττ)

(Engel et al. 2002, doi 10.1016/S0045-7825(02)00286-4; Brenner and Sung 2005, doi 10.1007/s10915-004-4135-7, for
linear plates). κ is the change of the curvature n·x,ₐᵦ, and θ that of the angle between the normals of two sides,
so that rotations cost nothing. {m} is the mean of the bending moments on both sides across the edge, and h the height
of the triangles over it. The middle term is what makes the plate converge: without it, the penalty would have to grow
with refinement, and the plate with it. On flat sides that are not very skew the energy is positive for η > 3.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.plates import Surface, covariant, cross, quadratic, rows, surface_at
from turgor.core.engine.term import Configuration, Term, add_at_nodes, displacements, lower

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class PlateTerm(Term):
    """The bending of sides.

    Parameters
    ----------
    nodes : (f, n) int array
    slopes : (f, q, n, 2) array
        Derivatives of the shape functions along two parameters.
    seconds : (f, q, 3, n) array
        Second derivatives along 11, 22 and twice 12 of a frame in the surface at rest.
    rest : (f, q, 3) array
        Curvatures at rest.
    areas : (f, q) array
    moduli : (3, 3) or (f, q, 3, 3) array
        Scaled bending stiffness; that of each point where the sheet is woven.
    """

    nodes: Ints
    slopes: Array
    seconds: Array
    rest: Array
    areas: Array
    moduli: Array

    @property
    def unknowns(self) -> Ints:
        """Displacements of the nodes."""
        return displacements(self.nodes)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces of the bending moments."""
        surface, curving, curvature = self.curving(at.position)
        moments = self.areas[..., None] * self._moments(curvature)
        numbers = (moments[..., None, :] @ curving)[..., 0, :]
        add_at_nodes(out, self.nodes, np.swapaxes(numbers, 1, 2) @ surface.normal)

    def energy(self, position: Array) -> float:
        """Energy of the curvature."""
        _, _, curvature = self.curving(position)
        return 0.5 * float((self.areas * ((curvature - self.rest) * self._moments(curvature)).sum(axis=-1)).sum())

    def stresses(self, position: Array, update: Array) -> Array:
        """Bending moments (f, q, 3)."""
        surface, curving, curvature = self.curving(position)
        away = surface.normal @ np.swapaxes(update[self.nodes], 1, 2)
        return self._moments(curvature + (curving @ away[..., None])[..., 0])

    def _moments(self, curvature: Array) -> Array:
        """Bending moments (f, q, 3) of curvatures."""
        return np.asarray((self.moduli @ (curvature - self.rest)[..., None])[..., 0])

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Material part, and the geometric part of the moments."""
        surface, curving, curvature = self.curving(at.position)
        bends = rows(curving, surface.normal[:, :, None])
        weighed = self.areas[..., None] * stresses
        pulled = np.einsum("fqc,fqcm->fqm", weighed, curving)
        turned = second_row(surface, -2 * pulled, -(weighed * curvature).sum(axis=-1))
        flat = (self.areas[..., None, None] * self.moduli) @ bends.reshape(*bends.shape[:3], -1)
        scaled = flat.reshape(bends.shape)
        return lower(quadratic(np.concatenate([bends, surface.across], 2), np.concatenate([scaled, turned], 2)))

    def curving(self, position: Array) -> tuple[Surface, Array, Array]:
        """The surface, the numbers (f, q, 3, 6) of the change of its curvatures, and these (f, q, 3)."""
        corners = position[self.nodes][:, None]
        surface = surface_at(corners, self.slopes)
        z = self.seconds @ corners
        return surface, covariant(surface, self.slopes, self.seconds, z), (z @ surface.normal[..., None])[..., 0]


@dataclass(frozen=True, slots=True, eq=False)
class HingeTerm(Term):
    """The angles at edges: between two sides of a sheet, or one and the side of a body that holds its slope.

    Everything is taken at points of edges. Triangles have one, the middle of the edge. The mean moment of flat
    triangles sees the mean angle alone; with two points the penalty would hold its change along the edge too, and
    coarse plates would be three times too stiff. Quadrilaterals have two points of Gauss, because their angle is
    quadratic along the edge.

    Parameters
    ----------
    nodes : (e, m) int array
        Nodes of both sides.
    slopes : (e, 2, m, 2) array
        Derivatives of the shape functions of both sides along their parameters; zero at nodes of the other one.
    moments : (e, 2, m) array
        Second derivatives of the position whose curvature is the share of each side in the mean moment.
    along : (e, m) array
        Derivatives along the edge.
    rest : (e, 2) array
        Mean moment and angle at rest.
    lengths, penalty : (e,) arrays
        Length of the edge that each point stands for, and its moment per angle and length.
    """

    couples = True

    nodes: Ints
    slopes: Array
    moments: Array
    along: Array
    rest: Array
    lengths: Array
    penalty: Array

    @property
    def unknowns(self) -> Ints:
        """Displacements of the nodes."""
        return displacements(self.nodes)

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the forces of the mean moment and of the penalty."""
        bent = self._bent(at.position)
        moment, angle = bent.values.T
        weights = self.lengths[:, None] * np.stack([-angle, self.penalty * angle - moment], axis=1)
        add_at_nodes(out, self.nodes, np.einsum("er,ermi->emi", weights, bent.changes))

    def energy(self, position: Array) -> float:
        """Energy of mean moment and penalty; it may be negative, that of the whole sheet is not."""
        moment, angle = self._bent(position).values.T
        return float((self.lengths * (0.5 * self.penalty * angle - moment) * angle).sum())

    def stresses(self, position: Array, update: Array) -> Array:
        """Changes of mean moment and angle (e, 2)."""
        bent = self._bent(position)
        return np.asarray(bent.values + np.einsum("ermi,emi->er", bent.changes, update[self.nodes]))

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Products of the changes of moment and angle, and their second variations."""
        bent = self._bent(at.position)
        moment, angle = self.lengths * stresses.T
        turned = np.array([-1.0, 1.0]) * (self.penalty * angle - moment)[:, None]
        by_moment, by_angle = np.moveaxis(bent.changes, 1, 0)
        weights = self.lengths[:, None, None]
        hinged = weights * (self.penalty[:, None, None] * by_angle - 2 * by_moment)
        numbers = 2 * angle[:, None, None] * bent.curving + 2 * turned[..., None] * bent.turning
        second = second_row(bent.surface, numbers, angle[:, None] * bent.curvature)
        swung = (turned / bent.stretch[:, None] ** 2)[..., None] * self.along[:, None]
        left = (by_angle[:, None], *_pairs(bent.surface.across), rows(self.along[:, None], bent.surface.normal))
        right = (hinged[:, None], *_pairs(second), rows(swung, bent.conormal))
        return lower(quadratic(np.concatenate(left, axis=1), np.concatenate(right, axis=1)))

    def _bent(self, position: Array) -> "Bent":
        corners = position[self.nodes][:, None]
        surface = surface_at(corners, self.slopes)
        tangent = (self.along[:, None] @ corners[:, 0])[:, 0]
        stretch = np.linalg.norm(tangent, axis=1)
        unit = tangent / stretch[:, None]
        conormal = cross(unit[:, None], surface.normal)
        z = self.moments[:, :, None] @ corners
        curving = covariant(surface, self.slopes, self.moments[:, :, None], z)[:, :, 0]
        curvature = (z[:, :, 0] * surface.normal).sum(axis=2)
        turning = (self.slopes @ (surface.dual @ conormal[..., None]))[..., 0]
        first, second = surface.normal[:, 0], surface.normal[:, 1]
        angle = np.arctan2((unit * cross(first, second)).sum(axis=1), (first * second).sum(axis=1))
        values = np.stack([curvature.sum(axis=1), angle], axis=1) - self.rest
        values[:, 1] -= 2 * np.pi * np.round(values[:, 1] / (2 * np.pi))
        by_moment, by_angle = rows(curving, surface.normal).sum(axis=1), rows(turning, surface.normal)
        changes = np.stack([by_moment, by_angle[:, 0] - by_angle[:, 1]], axis=1)
        return Bent(surface, conormal, stretch, curving, turning, curvature, values, changes)


@dataclass(frozen=True, slots=True, eq=False)
class Bent:
    """Edges at some positions.

    Parameters
    ----------
    surface : Surface
        Those of both sides (e, 2).
    conormal : (e, 2, 3) array
        Unit vectors t × n.
    stretch : (e,) array
        Derivative of the position along the edge.
    curving, turning : (e, 2, m) arrays
        Numbers of v and of w.
    curvature : (e, 2) array
        Shares in the mean moment, without those at rest.
    values : (e, 2) array
        Changes of mean moment and angle since rest.
    changes : (e, 2, m, 3) array
        The variations of both.
    """

    surface: Surface
    conormal: Array
    stretch: Array
    curving: Array
    turning: Array
    curvature: Array
    values: Array
    changes: Array


def _pairs(rows_of_both: Array) -> tuple[Array, Array]:
    """Rows (e, 2, r, m, 3) of two sides as two arrays (e, r, m, 3)."""
    return rows_of_both[:, 0], rows_of_both[:, 1]


def second_row(at: Surface, numbers: Array, curvature: Array) -> Array:
    """What the rows n·δx,ᵧ are multiplied with in a second variation, (..., 2, m, 3).

    ``numbers`` (..., m) stand before (n·δx,ᵧ)(aᵞ·…), ``curvature`` (...) before aᵞᵟ (n·δx,ᵧ)(n·δx,ᵟ).
    """
    across = at.across
    mixed = (at.inverse @ across.reshape(*across.shape[:-2], -1)).reshape(across.shape)
    return np.asarray(rows(numbers[..., None, :], at.dual) + mixed * curvature[..., None, None, None])
