"""BearingTerm: multipliers that let a reference point turn about an axis only, or that drive its turn about an axis."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.points.point_unknowns import Carrier, carriers_of
from turgor.core.engine.term import Configuration, Setting, Term, displacements, lower
from turgor.core.model.points import Hinge

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class BearingTerm(Term):
    """W = m₀ a·Rb + m₁ a·Rc + m₂ (cos θ (c·Rb − b·Rc) − sin θ (b·Rb + c·Rc)), for an axis a = b × c fixed in space.

    The first two multipliers keep the axis where it is: those of a hinge. The third one drives the twist of the
    point about the axis to θ and leaves the tilt of the axis free: R is a turn by θ about a, then one about an axis
    across a. Which multipliers are free is a matter of `hold_points`. The angle is a prescribed component of
    its own, r θ, so that the force on it is the driving moment over r.

    Parameters
    ----------
    carrier : Carrier
    slopes : (4, 3, 3) array
        Derivatives of the four products by the arrows, over r: those of a·Rb, a·Rc, c·Rb − b·Rc and b·Rb + c·Rc.
    rest : (3,) array
        Scaled position of the point at rest.
    radius : float
        Scaled length r of the arrows.
    """

    couples = True

    carrier: Carrier
    slopes: Array
    rest: Array
    radius: float

    @property
    def unknowns(self) -> Ints:
        """All nodes of the point (1, 3 k): a solver that pivots finds them in one front."""
        return displacements(self.carrier.node + np.arange(self.carrier.count)[None])

    def add_forces(self, out: Array, at: Configuration) -> None:
        """Add the derivative of W."""
        products, multipliers, turn = self._parts(at.position)
        sine, cosine = np.sin(turn), np.cos(turn)
        out[self.carrier.arrows] += np.tensordot(_weights(multipliers, sine, cosine), self.slopes, 1) / self.radius
        out[self.carrier.bolts[0]] += [products[0], products[1], cosine * products[2] - sine * products[3]]
        out[self.carrier.bolts[1], 0] -= multipliers[2] * (sine * products[2] + cosine * products[3]) / self.radius

    def tangents(self, at: Configuration, stresses: Array) -> Array:
        """Second derivative of W."""
        products, multipliers, turn = self._parts(at.position)
        sine, cosine = np.sin(turn), np.cos(turn)
        first = 3 * (self.carrier.bolts[0] - self.carrier.node)
        angle = first + 3
        local = np.zeros((3 * self.carrier.count, 3 * self.carrier.count))
        slopes = self.slopes.reshape(4, 9) / self.radius
        local[first : first + 3, 3:12] = [slopes[0], slopes[1], cosine * slopes[2] - sine * slopes[3]]
        local[angle, 3:12] = -multipliers[2] * (sine * slopes[2] + cosine * slopes[3]) / self.radius
        local[angle, first + 2] = -(sine * products[2] + cosine * products[3]) / self.radius
        local += local.T
        local[angle, angle] = multipliers[2] * (sine * products[3] - cosine * products[2]) / self.radius**2
        return lower(local[None])

    def _parts(self, position: Array) -> tuple[Array, Array, float]:
        """The four products over r, the three multipliers, and the angle θ."""
        arrows = position[self.carrier.arrows] - self.rest + self.radius * np.eye(3)
        multipliers, driven = position[self.carrier.bolts] - self.rest
        return np.einsum("kij,ij->k", self.slopes, arrows) / self.radius, multipliers, float(driven[0] / self.radius)


def _weights(multipliers: Array, sine: float, cosine: float) -> Array:
    """Share (4,) of each product in W."""
    return np.array([*multipliers[:2], multipliers[2] * cosine, -multipliers[2] * sine])


def bearing_slopes(carrier: Carrier) -> Array:
    """Derivatives (4, 3, 3) of the four products of a `BearingTerm` by unit arrows R eᵢ."""
    assert carrier.bearing is not None
    axis = np.array(carrier.bearing.direction)
    a = axis / np.linalg.norm(axis)
    b = np.cross(a, np.eye(3)[np.abs(a).argmin()])
    b /= np.linalg.norm(b)
    c = np.cross(a, b)
    return np.array([np.outer(b, a), np.outer(c, a), np.outer(b, c) - np.outer(c, b), np.outer(b, b) + np.outer(c, c)])


def stopped(carrier: Carrier, motion: Array) -> Array:
    """Components (k,) of a small motion (n, 3) of all nodes from rest that the bearing of a point blocks."""
    if carrier.bearing is None:
        return np.zeros(0)
    products = np.einsum("kij,ij->k", bearing_slopes(carrier), motion[carrier.arrows])
    return np.asarray(products[:2] if isinstance(carrier.bearing, Hinge) else products[2:3])


def bearing_terms(setting: Setting) -> Sequence[BearingTerm]:
    """One for each reference point with a bearing."""
    return [
        BearingTerm(each, bearing_slopes(each), setting.points[each.node], each.radius / setting.length)
        for each in carriers_of(setting.model)
        if each.bearing is not None
    ]
