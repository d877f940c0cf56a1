"""Inertia: mass and damping of a time step as a part of the equations in reduced coordinates.

The mass is a constant matrix. The damping of the full model, a viscous stress in proportion to the rate of Green's
strain, is quadratic in the coordinates like the stiffness of a Hooke sheet: an exact polynomial, without resistance
to rotations.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.solvers.dynamics.generalized_alpha import TimeStep
from turgor.reduced.parts.polynomials import Sheets, SheetsAt

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Masses:
    """What a reduced model needs to move.

    Parameters
    ----------
    mass : (r, r) array
        Its product with a scaled acceleration, in lengths per s², is a scaled force.
    viscosity : Sheets
        Form of the viscous stress for a damping time of one second.
    """

    mass: Array
    viscosity: Sheets


@dataclass(frozen=True, slots=True, eq=False)
class Inertia:
    """Inertia and damping in one time step.

    Parameters
    ----------
    masses : Masses
    rule : TimeStep
        Velocity and acceleration at the end of the step by the coordinates there.
    alpha, tau : float [1/s], [s]
        Damping by mass and by stiffness.
    """

    masses: Masses
    rule: TimeStep
    alpha: float
    tau: float

    def at(self, q: Array) -> "InertiaAt":
        """Evaluate at coordinates (r,)."""
        return InertiaAt(self, q, self.rule.velocity(q), self.masses.viscosity.at(q) if self.tau else None)


@dataclass(frozen=True, slots=True, eq=False)
class InertiaAt:
    """Inertia and damping at coordinates at the end of a time step."""

    inertia: Inertia
    q: Array
    velocity: Array
    viscous: SheetsAt | None

    @property
    def damping(self) -> Array:
        """Forces (r,) of the damping."""
        out = np.asarray(self.inertia.alpha * (self.inertia.masses.mass @ self.velocity))
        if self.viscous is not None:
            out = out + self._stress @ self.viscous.slopes
        return out

    @property
    def _stress(self) -> Array:
        """Viscous stress (n,), by products of coordinates."""
        assert self.viscous is not None
        form = self.inertia.masses.viscosity.form
        return np.asarray(self.inertia.tau * (form @ (self.viscous.slopes @ self.velocity)))

    def forces(self) -> Array:
        """Forces (r,)."""
        return np.asarray(self.inertia.masses.mass @ self.inertia.rule.acceleration(self.q)) + self.damping

    def tangent(self, geometric: Array | None) -> Array:
        """Tangent (r, r)."""
        i, rule = self.inertia, self.inertia.rule
        out = np.asarray((rule.stiffness + i.alpha * rule.rate) * i.masses.mass)
        if self.viscous is None:
            return out
        sheets, slopes = i.masses.viscosity, self.viscous.slopes
        changing = rule.rate * slopes + sheets.slopes(np.concatenate([[0.0], self.velocity]))
        return out + i.tau * slopes.T @ (sheets.form @ changing) + 2.0 * sheets.full(self._stress)[1:, 1:]

    def linearized(self, update: Array) -> None:
        """No stresses enter the geometric part."""
