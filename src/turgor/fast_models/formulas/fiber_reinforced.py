"""Fiber-reinforced bender: the moment of the pressure about the layer balances that of the stretched wall."""

from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.core.materials.laws.derivatives import stretch_derivatives
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.fast_models.formulas.formula import Formula, beyond_tests, law_of, not_so_simple, path_of, too_short
from turgor.fast_models.formulas.inversion import inverted, rising
from turgor.fast_models.formulas.thick_walled import ELASTIC, HIGHEST
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import deg, kPa

Array = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)

FIBER_REINFORCED = Formula(
    name="fiber_reinforced_bender",
    title="Bending angle and tip force of a half-round bender that is wound with fibers.",
    families=("FiberReinforcedBender",),
    assumptions=(
        ELASTIC,
        "Fibers keep every section from changing its shape, so that the wall is stretched along the axis alone.",
        "The strain-limiting layer keeps its length and bends freely.",
        "The curvature is the same everywhere along the cavity, and the end walls stay straight.",
    ),
    source=Source(
        text="Polygerinos et al. 2015, IEEE Trans. Robot. 31, 778",
        detail="torque balance about the bottom layer, derived here from the geometry, and for any law",
    ),
)


def fiber_reinforced_bender(
    actuator: FiberReinforcedBender,
    material: Material,
    pressure: ArrayLike,
    *,
    prescribed_angle: float = 0.0,
) -> Response:
    """Bend a half-round bender with fibers, and push with its tip: the torque balance about the layer.

    Assumptions: The rubber is incompressible and elastic: no relaxation, no softening. Fibers keep every section from
    changing its shape, so that the wall is stretched along the axis alone. The strain-limiting layer keeps its length
    and bends freely. The curvature is the same everywhere along the cavity, and the end walls stay straight.

    P ∫ z dA over the cavity = ∫ z ∂Ŵ/∂λ dA over the wall, with λ = 1 + κ z at the height z above the layer and
    Ŵ(λ) = W(λ, 1, 1/λ); the first is P (4 r³ + 3 π r² b)/6 for the radius r on a base b. For a neo-Hookean law
    ∂Ŵ/∂λ = μ (λ − λ⁻³). A blocked tip pushes with F = (Mₚ − M_wall)/L, a rigid lever of the length L.

    Parameters
    ----------
    actuator : FiberReinforcedBender
        Its section; a skin counts as wall, below the layer too.
    material : Material
        The rubber of the wall and of the skin.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several.
    prescribed_angle : float [rad]
        Angle at which ``blocked_force`` is taken; 0 is straight.

    Returns
    -------
    Response
        ``pressure``, ``bending_angle``, ``blocked_force``, ``cavity_volume``, ``largest_stretch``.

    Raises
    ------
    TurgorError
        If a pressure would stretch the wall more than six times, or the law is not defined there.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.157e6))
    >>> bender = FiberReinforcedBender(skin=0.0, end_wall=1e-3, length=162e-3)
    >>> fiber_reinforced_bender(bender, rubber, [50e3, 100e3])["bending_angle_deg"].round(2)
    array([ 54.95, 119.37])
    """
    FIBER_REINFORCED.check_family(actuator)
    law, pressures = law_of(material), path_of("pressure", pressure)
    z, weights = _wall(actuator)
    r, b = actuator.radius, actuator.base
    area, lever = pi * r**2 / 2, (4 * r**3 + 3 * pi * r**2 * b) / 6
    length = actuator.length - 2 * actuator.end_wall
    top = b + r + actuator.wall + actuator.skin

    def balanced(curvature: Array) -> Array:
        """The pressure that a curvature needs."""
        return _moment(law, z, weights, curvature) / lever

    rise = rising(balanced, np.concatenate([[0.0], np.geomspace(0.01, HIGHEST - 1, 24)]) / top, pressures.max())
    if pressures.max() > rise.y[-1]:
        raise TurgorError(
            f"pressure is {pressures.max() / kPa:g} kPa; at {rise.y[-1] / kPa:.4g} kPa the top of the wall is "
            f"stretched {1 + rise.x[-1] * top:.3g} times already, and the formula is not followed further."
        )
    curvature = inverted(balanced, rise, pressures)
    blocked_curvature = prescribed_angle / length
    wall_moment = _moment(law, z, weights, np.array([blocked_curvature]))[0]
    columns = [
        Column("pressure", "kPa", pressures),
        Column("bending_angle", "deg", curvature * length),
        Column("blocked_force", "N", (pressures * lever - wall_moment) / actuator.length),
        Column("cavity_volume", "mL", (area + curvature * lever) * length),
        Column("largest_stretch", "", 1 + curvature * top),
    ]
    findings: list[Finding | None] = [not_so_simple(material), too_short(length, 2 * r)]
    findings += beyond_tests(material, 1 + curvature * top)
    findings += [_bulging(actuator, law, float(pressures.max())), _closed(float(curvature.max()) * length)]
    return FIBER_REINFORCED.response(columns, findings)


def _wall(actuator: FiberReinforcedBender) -> tuple[Array, Array]:
    """Heights of the wall above the layer, and the area around each: half discs and rectangles, added and removed."""
    b, half = actuator.base, actuator.radius + actuator.wall + actuator.skin
    parts = [_half_disc(half, b, 1.0), _half_disc(actuator.radius, b, -1.0), _rectangle(-actuator.skin, b, 2 * half)]
    z, weights = (np.concatenate(each) for each in zip(*parts, strict=True))
    return z, weights


def _half_disc(radius: float, base: float, sign: float) -> tuple[Array, Array]:
    angle = pi / 4 * (_NODES + 1)
    return base + radius * np.sin(angle), sign * _WEIGHTS * pi / 4 * 2 * radius**2 * np.cos(angle) ** 2


def _rectangle(low: float, high: float, width: float) -> tuple[Array, Array]:
    return low + (high - low) * (_NODES + 1) / 2, _WEIGHTS / 2 * (high - low) * width


def _moment(law: Law, z: Array, weights: Array, curvature: Array) -> Array:
    """Moment of the wall about the layer [N m] by curvature, (n,)."""
    stretch = 1 + curvature[:, None] * z
    with np.errstate(invalid="ignore", divide="ignore"):
        across = 1 / stretch
        _, along, _, through, *_ = stretch_derivatives(law, stretch, np.ones_like(stretch), across)
        return np.where((stretch > 0).all(axis=1), (along - through * across**2) @ (weights * z), np.nan)


def _bulging(actuator: FiberReinforcedBender, law: Law, pressure: float) -> Finding | None:
    """F08: the flat side bulges, as a strip of the base between the walls would."""
    width = 2 * actuator.radius
    sag = (
        pressure * width**4 / (32 * 4 * law.shear_modulus * (actuator.base + actuator.skin) ** 3)
    )  # both edges clamped
    if sag < 0.02 * actuator.radius:
        return None
    return Finding(
        code="F08",
        severity=Severity.WARNING,
        message=f"At {pressure / kPa:.4g} kPa the base of the section, a strip between the walls, would bulge by "
        f"{100 * sag / actuator.radius:.2g} % of the radius by linear theory, and the formula takes the section as "
        "rigid.",
        advice="A section that becomes round bends a little more at first, and then far less, since its chamber comes "
        "nearer to the layer. Use finite elements, or a flat side that is stiff across.",
    )


def _closed(angle: float) -> Finding | None:
    """F10: the bender meets itself."""
    if angle <= 2 * pi:
        return None
    return Finding(
        code="F10",
        severity=Severity.NOTE,
        message=f"The bending angle reaches {angle / deg:.4g} deg; beyond 360 deg the bender would meet itself.",
        advice="Read such angles as a curvature.",
    )
