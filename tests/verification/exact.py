"""Exact answers of the incompressible verification cases, for any law, from its energy by quadrature."""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from turgor.core.materials.laws.homogeneous import biaxial, equibiaxial, nominal_stress, planar
from turgor.core.materials.laws.laws import Law


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


def closed_tube(law: Law, stretch: float, inner: float, outer: float) -> tuple[float, float]:
    """Axial stretch and internal pressure [Pa] of a thick tube with closed, free ends.

    With Ŵ(λ, λz) = W(λ, λz, 1/(λ λz)) and r² − a² = (R² − A²)/λz: P = ∫ Ŵ,λ / (λ² λz − 1) dλ from the stretch of the
    outer to that of the inner wall, and the force beyond that of the pressure on the ends, which is zero, is
    proportional to ∫ (2 λz Ŵ,z − λ Ŵ,λ) λ / (λ² λz − 1)² dλ (Haughton and Ogden 1979).
    """

    def integral(axial: float, force: bool) -> float:
        outside = (((stretch * inner) ** 2 + (outer**2 - inner**2) / axial) ** 0.5) / outer

        def integrand(x: float) -> float:
            nominal = nominal_stress(law, biaxial(x, axial))
            hoop, along, below = nominal[0, 0], nominal[1, 1], x * x * axial - 1
            return float((2 * axial * along - x * hoop) * x / below**2 if force else hoop / below)

        tiny = 1e-9 * law.shear_modulus  # the force passes through zero, where no relative error can be asked for
        return float(quad(integrand, outside, stretch, epsabs=tiny, epsrel=1e-10)[0])

    axial = float(brentq(lambda z: integral(z, True), 1.0, 2.0, xtol=1e-13))
    return axial, integral(axial, False)


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


def hertz_ball(approach: float, radius: float, modulus: float) -> tuple[float, float, float]:
    """Force [N], contact radius [m] and largest pressure [Pa] of a rigid plane on an incompressible elastic ball.

    Hertz, with the approach [m] of the plane to the ball's center as for a half space; ``modulus`` is Young's.
    """
    a = np.sqrt(radius * approach)
    stiffness = modulus / 0.75
    return 4 / 3 * stiffness * a**3 / radius, a, 2 * stiffness * a / (np.pi * radius)


def ball_approach(contact_radius: float, terms: int = 1000) -> float:
    """Approach of a plane to the center of an incompressible ball of radius 1, over that of Hertz's half space.

    The linear solution of a whole ball under Hertz's pressure on two opposite caps, in Legendre functions:
    u_r = Σ (A rⁿ⁺¹ + B rⁿ⁻¹) Pₙ with div u = 0, ∇p = μ∇²u and no shear at the surface. The ratio is about
    1 − a/4 for a small contact radius a: the ball is stiffer than the half space.
    """
    x, weight = np.polynomial.legendre.leggauss(400)
    phi = np.pi / 4 * (x + 1)
    sine = contact_radius * np.sin(phi)
    cosine = np.sqrt(1 - sine**2)
    pressure = weight * np.pi / 4 * contact_radius * np.cos(phi) ** 2 * sine / cosine
    pole, last, legendre = 0.0, np.ones_like(cosine), cosine
    for n in range(2, terms):
        last, legendre = legendre, ((2 * n - 1) * cosine * legendre - (n - 1) * last) / n
        if n % 2:  # two opposite caps
            continue
        share = (2 * n + 1) * float(pressure @ legendre)
        ratio = -((n - 1) * (n + 1)) / (n * (n + 2))  # A / B, from the shear stress at the surface
        radial = -ratio * (4 * n + 6) / n + 2 * ((n + 1) * ratio + n - 1)
        pole += share * (1 + ratio) / radial
    return pole * 8 / (np.pi * contact_radius)  # for μ = 1, where Hertz's largest pressure is 8 a / π


def held_tube(law: Law, stretch: float, inner: float, held: float, outer: float) -> tuple[float, float]:
    """Pressure [Pa] of a closed tube whose material keeps its radius at ``held``, and what the hoops there press [Pa].

    r² = h² + (R² − h²)/λz everywhere, so that the energy depends on λz alone and the volume within the tube grows by
    π h² for each λz: P = ∫ dŴ/dλz 2 R dR / h². Across the hoops the radial stress, and with it the mean stress, jumps
    by q = P − ∫ λθ Ŵ,θ R/(λz r²) dR.
    """

    def integral(force: bool) -> float:
        def integrand(R: float) -> float:
            square = held**2 + (R**2 - held**2) / stretch
            hoop = square**0.5 / R
            nominal = nominal_stress(law, biaxial(hoop, stretch))
            slope = -(R**2 - held**2) / (2 * square**0.5 * stretch**2 * R)
            if force:
                return float((nominal[0, 0] * slope + nominal[1, 1]) * 2 * R / held**2)
            return float(hoop * nominal[0, 0] * R / (stretch * square))

        parts = (quad(integrand, *ends, epsabs=0, epsrel=1e-10)[0] for ends in ((inner, held), (held, outer)))
        return float(sum(parts))

    pressure = integral(force=True)
    return pressure, pressure - integral(force=False)
