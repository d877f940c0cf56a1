"""Touching: contact of the actuator with itself and with planes, at points that ever came near something."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.store.codec import SEVEN_DIGITS
from turgor.reduced.parts import touching_kernels

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Touching:
    """Points that may touch sides of the actuator.

    Parameters
    ----------
    rest : (n, 3) array
        Scaled positions of the nodes of all sides.
    modes : (n, 3, r) array
    points : (k, a) int array
        Nodes of the side of each point.
    shape : (k, a) array
        Its shape functions.
    springs : (k,) array
        Pressure per depth.
    areas : (k,) array
        Area of each point times the share of the pass.
    sides : (s, a) int array
        Nodes of the sides that may be touched.
    side_springs, depth : (s,) arrays
    overhang : (s, e) array
    candidates : ((k + 1,), (c,)) int arrays
        Sides that each point may touch: where they start, and which.
    """

    rest: Array
    modes: Array = field(metadata=SEVEN_DIGITS)
    points: Ints
    shape: Array
    springs: Array
    areas: Array
    sides: Ints
    side_springs: Array
    depth: Array
    overhang: Array
    candidates: tuple[Ints, Ints]

    def at(self, q: Array) -> "TouchingAt":
        """Find what touches at coordinates (r,)."""
        x = self.rest + (self.modes.reshape(-1, len(q)) @ q).reshape(-1, 3)
        partner, at, gap = touching_kernels.find(
            x, self.points, self.shape, self.sides, (self.overhang, self.depth), self.candidates
        )
        number = np.flatnonzero((partner >= 0) & (gap < 0.0))
        return TouchingAt(self, x, number, partner[number], at[number], gap[number])


@dataclass(frozen=True, eq=False)
class TouchingAt:
    """Points that touch: positions of all nodes, numbers of the points, their partners, places and gaps."""

    touching: Touching
    x: Array
    number: Ints
    partner: Ints
    place: Array
    gap: Array

    @property
    def _stiff(self) -> Array:
        """Force per depth of the points that touch."""
        t = self.touching
        return np.asarray(t.areas[self.number] * np.minimum(t.springs[self.number], t.side_springs[self.partner]))

    def energy(self) -> float:
        """Energy of the penetration."""
        return 0.5 * float(self._stiff @ self.gap**2)

    @cached_property
    def pressed(self) -> tuple[Array, Array]:
        """Forces and tangent."""
        t = self.touching
        touching = (self.number, self.partner, self.place)
        force, K = touching_kernels.press(self.x, t.modes, t.points, t.shape, t.sides, touching, self._stiff)
        return np.asarray(force), np.asarray(K)

    def forces(self) -> Array:
        """Forces (r,)."""
        return self.pressed[0]

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r)."""
        return self.pressed[1]

    def linearized(self, update: Array) -> None:
        """No stresses enter the geometric part."""


@dataclass(frozen=True, slots=True, eq=False)
class Facing:
    """Points that may touch a plane: their gaps are linear in the coordinates.

    Parameters
    ----------
    rest : (k,) array
        Gaps at rest.
    slopes : (k, r) array
    stiff : (k,) array
        Force per depth.
    """

    rest: Array
    slopes: Array = field(metadata=SEVEN_DIGITS)
    stiff: Array

    def at(self, q: Array) -> "FacingAt":
        """Measure the gaps at coordinates (r,)."""
        gap = self.rest + self.slopes @ q
        inside = gap < 0.0
        return FacingAt(gap[inside], self.slopes[inside], self.stiff[inside])


@dataclass(frozen=True, slots=True, eq=False)
class FacingAt:
    """Points behind a plane: gaps, slopes and stiffness."""

    gap: Array
    slopes: Array
    stiff: Array

    def energy(self) -> float:
        """Energy of the penetration."""
        return 0.5 * float(self.stiff @ self.gap**2)

    def forces(self) -> Array:
        """Forces (r,)."""
        return (self.stiff * self.gap) @ self.slopes

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r)."""
        return (self.slopes.T * self.stiff) @ self.slopes

    def linearized(self, update: Array) -> None:
        """No stresses enter the geometric part."""
