"""Fiber-reinforced tubes without ends: extension, inflation and twist by the minimum of the potential energy.

Incompressible neo-Hookean tube, r² = a² + (R² − A²)/λz, twist τ for each reference length, families of smeared fibers
on the outer surface with M = cos α eΘ + sin α eZ (α from the circumference), energy ½ k λ₀ (λ/λ₀ − 1)² for each
reference area, slack where λ < λ₀; λ₀ is 1 unless stated. Closed ends: the pressure also pulls at π a². This defines
case V20; the functions reproduce its values, and serve where other radii, stiffnesses and angles are needed.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, root

Array = NDArray[np.float64]
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


@dataclass(frozen=True, kw_only=True)
class FiberTube:
    """A tube: radii, shear modulus, families of fibers (stiffness per width [N/m], angle from the circumference).

    Fibers have the length ``rest`` over that in the tube at rest where nothing pulls them.
    """

    inner: float
    outer: float
    shear_modulus: float
    families: Sequence[tuple[float, float]] = ()
    rest: float = 1.0

    def radius(self, a: float, stretch: float, R: Array | float) -> Array:
        """Current radius of what was at R, from the current inner radius."""
        return np.sqrt(a**2 + (np.asarray(R) ** 2 - self.inner**2) / stretch)

    def fiber_stretches(self, a: float, stretch: float, twist: float) -> Array:
        """Stretch of each family."""
        b = float(self.radius(a, stretch, self.outer))
        angles = np.array([angle for _, angle in self.families])
        around = np.cos(angles) * b / self.outer + np.sin(angles) * twist * b
        return np.hypot(around, np.sin(angles) * stretch)

    def slopes(self, a: float, stretch: float, twist: float) -> Array:
        """Derivatives of the energy by inner radius, stretch and twist."""
        middle, half = (self.outer + self.inner) / 2, (self.outer - self.inner) / 2
        R = middle + half * _NODES
        square = self.radius(a, stretch, R) ** 2
        by_square = 1 / R**2 + twist**2 - R**2 / (square * stretch) ** 2
        by_stretch = 2 * stretch - 2 * R**2 / (square * stretch**3)
        rubber = self.shear_modulus / 2 * 2 * np.pi * R * half * _WEIGHTS
        of_square = np.array([np.full_like(R, 2 * a), -(R**2 - self.inner**2) / stretch**2, np.zeros_like(R)])
        own = np.array([np.zeros_like(R), by_stretch, 2 * twist * square])
        return np.asarray((of_square * by_square + own) @ rubber + self._fiber_slopes(a, stretch, twist))

    def _fiber_slopes(self, a: float, stretch: float, twist: float) -> Array:
        b = float(self.radius(a, stretch, self.outer))
        of_b = np.array([a / b, -(self.outer**2 - self.inner**2) / (2 * b * stretch**2), 0.0])
        out = np.zeros(3)
        for (stiffness, angle), size in zip(self.families, self.fiber_stretches(a, stretch, twist), strict=True):
            c, s = np.cos(angle) / self.outer, np.sin(angle)
            along = b * (c + s * twist) ** 2 * of_b + np.array([0.0, s**2 * stretch, b**2 * (c + s * twist) * s])
            out += 2 * np.pi * self.outer * stiffness * max(size / self.rest - 1, 0.0) * along / size
        return out

    def inflated(self, pressure: float, stretch: float, twist: float = 0.0) -> tuple[float, float, float]:
        """Held at its length and turn: current inner radius, pull at the ends beyond the pressure's, torque."""

        def unbalanced(a: float) -> float:
            return float(self.slopes(a, stretch, twist)[0] - 2 * np.pi * pressure * a * stretch)

        a = brentq(unbalanced, 0.5 * self.inner, 8 * self.inner, xtol=1e-14 * self.inner)
        slopes = self.slopes(a, stretch, twist)
        return a, float(slopes[1] - np.pi * pressure * a**2), float(slopes[2])

    def free(self, pressure: float, *, steps: int = 20) -> tuple[float, float, float]:
        """Closed and free: current inner radius, stretch along the axis, twist for each reference length [1/m]."""
        scale = np.array([self.inner, 1.0, 1 / self.inner])
        force = self.shear_modulus * self.inner**2
        x = np.array([1.0, 1.0, 0.0])
        for p in np.linspace(0, pressure, steps + 1)[1:]:

            def unbalanced(x: Array, p: float = p) -> Array:
                a, stretch, twist = x * scale
                pushed = np.array([2 * a * stretch, a**2, 0.0]) * np.pi * p
                return (self.slopes(a, stretch, twist) - pushed) * scale / force

            x = root(unbalanced, x, method="lm", tol=1e-13).x
            assert np.abs(unbalanced(x)).max() < 1e-6, f"no equilibrium at {p}"
        return tuple(float(value) for value in x * scale)  # type: ignore[return-value]
