"""Obstacles: rigid bodies without friction that the actuator may touch, in places that inputs may move.

The translation of a body is three coordinates more, whose values follow from the inputs. So the force on the body and
its derivatives come with those of the actuator.
"""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.contact.settings import PENALTY
from turgor.core.model.obstacles import RigidShape
from turgor.foundation.store.codec import SEVEN_DIGITS

Array = NDArray[np.float64]


class BodyAt(Protocol):
    """What touching a body does."""

    def energy(self) -> float:
        """Scaled energy."""

    def forces(self) -> Array:
        """Forces (r + 3,), those of the body's translation last."""

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r + 3, r + 3)."""


class Body(Protocol):
    """Points of the actuator and a body that they may touch."""

    def at(self, q: Array) -> BodyAt:
        """Find what touches at coordinates (r,) and a translation (3,) of the body, one after the other."""


@dataclass(frozen=True, slots=True, eq=False)
class Shaped:
    """Points that may touch a shape whose distance is a formula.

    Parameters
    ----------
    rest : (k, 3) array
        Scaled positions at rest.
    modes : (k, 3, r + 3) array
        How they move with the coordinates, and against the translation of the body.
    stiff : (k,) array
        Force per depth.
    deeper : (k,) array
        How much deeper one update of Newton's method may bring each.
    shape : RigidShape
        Scaled.
    """

    rest: Array
    modes: Array = field(metadata=SEVEN_DIGITS)
    stiff: Array
    deeper: Array
    shape: RigidShape

    def at(self, q: Array) -> "ShapedAt":
        """Measure the gaps."""
        x = self.rest + (self.modes.reshape(-1, len(q)) @ q).reshape(-1, 3)
        gap, normal, bend = self.shape.signed_distance(x)
        inside = np.flatnonzero(gap < 0.0)
        touching = self.modes[inside], self.stiff[inside], gap[inside], normal[inside], bend[inside]
        return ShapedAt(*touching, gap, self.deeper)


@dataclass(frozen=True, slots=True, eq=False)
class ShapedAt:
    """Points in a body: how they move, stiffness, gaps with first and second derivatives; then gaps of all points."""

    modes: Array
    stiff: Array
    gap: Array
    normal: Array
    bend: Array
    gaps: Array
    deeper: Array

    def share(self, new: "ShapedAt") -> float:
        """Share of the way to another place after which no point is deeper by more than it may be; 1 if none is."""
        allowed = np.minimum(self.gaps, 0.0) - self.deeper
        bad = new.gaps < allowed - (PENALTY.margin - 1) * self.deeper
        way = (self.gaps[bad] - allowed[bad]) / (self.gaps[bad] - new.gaps[bad])
        return max(float(way.min(initial=1.0)), PENALTY.shortest)

    def energy(self) -> float:
        """Energy of the penetration."""
        return 0.5 * float(self.stiff @ self.gap**2)

    def forces(self) -> Array:
        """Forces (r + 3,)."""
        return np.asarray((self.stiff * self.gap) @ self._slopes)

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r + 3, r + 3)."""
        slopes = self._slopes
        out = (slopes.T * self.stiff) @ slopes
        if self.bend.any():
            turned = (self.stiff * self.gap)[:, None, None] * (self.bend @ self.modes)
            out += self.modes.reshape(-1, out.shape[0]).T @ turned.reshape(-1, out.shape[0])
        return np.asarray(out)

    @property
    def _slopes(self) -> Array:
        return np.asarray((self.normal[:, None, :] @ self.modes)[:, 0])


@dataclass(frozen=True, slots=True, eq=False)
class Obstructing:
    """An obstacle, and where it is.

    Parameters
    ----------
    name : str
    body : Body
    origin : (3,) array
        Scaled translation of the body where all inputs are zero.
    place : (3, 1 + n) array
        How it translates with the inputs, the share of the loads that are no inputs first.
    whole : (3, 3) array [N]
        Force on the body from the whole actuator, of a scaled one from the modeled part.
    largest : float [N]
        Largest force on it in training.
    """

    name: str
    body: Body
    origin: Array
    place: Array
    whole: Array
    largest: float = 0.0

    def at(self, q: Array, inputs: Array) -> "ObstructingAt":
        """Find what touches at coordinates (r,) and inputs (1 + n,)."""
        at = self.body.at(np.concatenate([q, self.origin + self.place @ inputs]))
        return ObstructingAt(self, at.forces(), at.tangent(None), at)


@dataclass(frozen=True, slots=True, eq=False)
class ObstructingAt:
    """Forces and tangent of an obstacle by the coordinates and its translation."""

    obstacle: Obstructing
    every: Array
    stiffness: Array
    body: BodyAt

    def share(self, new: "ObstructingAt") -> float:
        """Share of the way to another place after which no point is too much deeper in the body; 1 if none is."""
        one, other = self.body, new.body
        return one.share(other) if isinstance(one, ShapedAt) and isinstance(other, ShapedAt) else 1.0

    def forces(self) -> Array:
        """Forces (r,)."""
        return self.every[:-3]

    def energy(self) -> float:
        """Energy of the penetration."""
        return self.body.energy()

    def work(self, before: "ObstructingAt", change: Array) -> float:
        """Work that moves the obstacle while the inputs change (1 + n,), by the trapezoidal rule."""
        return 0.5 * float((self.every[-3:] + before.every[-3:]) @ (self.obstacle.place @ change))

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r)."""
        return self.stiffness[:-3, :-3]

    def linearized(self, update: Array) -> None:
        """No stresses enter the geometric part."""

    def by_inputs(self) -> Array:
        """Derivative (r, 1 + n) of the forces by the inputs."""
        return self.stiffness[:-3, -3:] @ self.obstacle.place

    def force(self) -> Array:
        """Force (3,) [N] of the whole actuator on the obstacle."""
        return -self.obstacle.whole @ self.every[-3:]

    def force_rates(self, rates: Array) -> Array:
        """Derivatives (3, 1 + n) of that force by the inputs, from those of the coordinates (r, 1 + n)."""
        by_place = self.stiffness[-3:, -3:] @ self.obstacle.place
        return -self.obstacle.whole @ (self.stiffness[-3:, :-3] @ rates + by_place)
