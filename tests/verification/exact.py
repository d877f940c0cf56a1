"""Exact answers of the incompressible verification cases, for any law, from its energy by quadrature."""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from turgor.materials.homogeneous import equibiaxial, nominal_stress, planar
from turgor.materials.laws import Law


def sphere_pressure(law: Law, stretch: float, inner: float, outer: float) -> float:
    """Internal pressure [Pa] of a thick sphere whose inner radius has grown by ``stretch``.

    P = ∫ Ŵ′(λ) / (λ³ − 1) dλ from the stretch of the outer to that of the inner wall, with Ŵ(λ) = W(λ⁻², λ, λ),
    whose slope is twice the nominal equibiaxial stress; r³ − a³ = R³ − A³.
    """
    outside = (outer**3 + (stretch**3 - 1) * inner**3) ** (1 / 3) / outer

    def integrand(x: float) -> float:
        return float(2 * nominal_stress(law, equibiaxial(x))[0, 0] / (x**3 - 1))

    return float(quad(integrand, outside, stretch, epsabs=0, epsrel=1e-10)[0])


def tube_pressure(law: Law, stretch: float, inner: float, outer: float) -> float:
    """Internal pressure [Pa] of a thick tube held at its length whose inner radius has grown by ``stretch``.

    P = ∫ Ŵ′(λ) / (λ² − 1) dλ with Ŵ(λ) = W(λ, 1/λ, 1), whose slope is the nominal planar stress; r² − a² = R² − A².
    """
    outside = (outer**2 + (stretch**2 - 1) * inner**2) ** 0.5 / outer

    def integrand(x: float) -> float:
        return float(nominal_stress(law, planar(x))[0, 0] / (x**2 - 1))

    return float(quad(integrand, outside, stretch, epsabs=0, epsrel=1e-10)[0])


def tube_stretch(law: Law, pressure: float, inner: float, outer: float, limit: float = 4.0) -> float:
    """Stretch of the inner wall of the tube at a pressure, between 1.01 and ``limit``."""
    return float(brentq(lambda x: tube_pressure(law, x, inner, outer) - pressure, 1.01, limit, xtol=1e-13))


def sphere_stretch(law: Law, pressure: float, inner: float, outer: float, limit: float) -> float:
    """Stretch of the inner wall of the sphere at a pressure, on the rising branch between 1.01 and ``limit``."""
    return float(brentq(lambda x: sphere_pressure(law, x, inner, outer) - pressure, 1.01, limit, xtol=1e-13))


def bent_block(points: np.ndarray, angle: float, thickness: float, length: float) -> np.ndarray:
    """Rivlin's flexure: positions of a block bent to a total angle about the z axis, plane strain, incompressible.

    The thickness runs along x from 0 to ``thickness``, the length along y from −``length``/2 to +``length``/2:
    r² = r₁² + 2 α x with α = length/angle, polar angle y/α, r₁ = α λ₁, λ₁λ₂ = 1, λ₂² − λ₁² = 2 thickness/α.
    """
    alpha = length / angle
    half = thickness / alpha
    outer_square = half + np.sqrt(half**2 + 1)  # λ₂²
    inner_square = 1 / outer_square
    r = alpha * np.sqrt(inner_square + 2 * points[:, 0] / alpha)
    turn = points[:, 1] / alpha
    return np.column_stack([r * np.cos(turn), r * np.sin(turn), points[:, 2]])
