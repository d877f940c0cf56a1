"""Walls of tubes and spheres under pressure: the exact equilibrium of an incompressible rubber, by quadrature.

In a tube r² − a² = (R² − A²)/λz, in a sphere r³ − a³ = R³ − A³. The radial equilibrium dσr/dr = n (σθ − σr)/r with
n = 1 (tube) or 2 (sphere) gives the pressure P = ∫ n (σθ − σr) dr/r; the stresses come from the energy of the law.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.derivatives import stretch_derivatives
from turgor.core.materials.laws.laws import Law
from turgor.fast_models.formulas.inversion import CLOSE, PASSES

Array = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)

#: Relative step of the differences with which Newton's method finds the state of a tube.
STEP = 1e-6


@dataclass(frozen=True, slots=True)
class Wall:
    """A round wall: law, inner and outer radius [m] at rest.

    Integrals over the wall use 24 Gauss points in log R: for a wall ten times as wide outside as inside, eight digits
    are right at a stretch of 3.
    """

    law: Law
    inner: float
    outer: float

    @property
    def _radii(self) -> tuple[Array, Array]:
        """Radii R of the quadrature and weights, so that ∫ f dR = Σ w f."""
        half = np.log(self.outer / self.inner) / 2
        R = np.sqrt(self.inner * self.outer) * np.exp(half * _NODES)
        return R, half * _WEIGHTS * R

    def sphere_pressure(self, stretch: Array) -> Array:
        """Pressure [Pa] of a sphere by the stretch of its inner wall, (n,)."""
        R, weights = self._radii
        cube = R**3 + (stretch[:, None] ** 3 - 1) * self.inner**3
        hoop = np.cbrt(cube) / R
        radial = hoop**-2.0
        _, by_hoop, _, by_radial, *_ = stretch_derivatives(self.law, hoop, hoop, radial)
        return np.asarray((2 * (hoop * by_hoop - radial * by_radial) * R**2 / cube) @ weights)

    def sphere_outside(self, stretch: Array) -> Array:
        """Stretch of the outer wall of the sphere, (n,)."""
        return np.asarray(np.cbrt(1 + (stretch**3 - 1) * (self.inner / self.outer) ** 3))

    def tube(self, stretch: Array, axial: Array) -> tuple[Array, Array]:
        """Pressure [Pa] and axial force beyond that of the pressure on closed ends [N], by inner and axial stretch."""
        R, weights = self._radii
        square = (stretch * self.inner)[:, None] ** 2 + (R**2 - self.inner**2) / axial[:, None]
        hoop, along = np.sqrt(square) / R, np.broadcast_to(axial[:, None], square.shape)
        radial = 1 / (hoop * along)
        _, by_hoop, by_axial, by_radial, *_ = stretch_derivatives(self.law, hoop, along, radial)
        around, through = hoop * by_hoop, radial * by_radial
        dr = weights * R / along
        pressure = ((around - through) / square * dr).sum(axis=1)
        force = np.pi * ((2 * along * by_axial - around - through) * dr).sum(axis=1)
        return pressure, force

    def tube_outside(self, stretch: Array, axial: Array) -> Array:
        """Stretch of the outer wall of the tube, (n,)."""
        share = (self.inner / self.outer) ** 2
        return np.asarray(np.sqrt(stretch**2 * share + (1 - share) / axial))

    def free_tube(self, stretch: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Pressure [Pa] and axial stretch of a tube with closed ends that nothing else pulls, by inner stretch, (n,).

        ``start`` is a guess of the axial stretch. Not numbers where none was found.
        """
        axial = np.ones_like(stretch) if start is None else start
        for _ in range(PASSES):
            force, ahead = self.tube(np.tile(stretch, 2), np.concatenate([axial, axial * (1 + STEP)]))[1].reshape(2, -1)
            slope = (ahead - force) / (STEP * axial)
            with np.errstate(invalid="ignore", divide="ignore"):
                change = np.clip(-force / slope, -0.1 * axial, 0.3 * axial)
            axial = axial + change
            if not (np.abs(change) > CLOSE * axial).any():
                break
            if (np.abs(change) <= 1e-9).all():  # round-off of the force is reached
                break
        settled = np.abs(change) < 1e-6
        return np.where(settled, self.tube(stretch, axial)[0], np.nan), np.where(settled, axial, np.nan)
