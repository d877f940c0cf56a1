"""Thick tube and thick sphere under pressure, for any law."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.geometry.actuators.twisting_tube import TwistingTube
from turgor.core.geometry.rules import check_length
from turgor.core.materials.material import Material
from turgor.fast_models.formulas.formula import Formula, beyond_tests, law_of, not_so_simple, path_of, too_short
from turgor.fast_models.formulas.inversion import extremum, inverted, rising
from turgor.fast_models.formulas.thick_walls import Wall
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import kPa, m

Array = NDArray[np.float64]

#: A family with the radii and the caps of a tube.
Tube = ExtendingCylinder | FiberReinforcedCylinder | ContractingTube | TwistingTube
TUBES = ("ExtendingCylinder", "FiberReinforcedCylinder", "ContractingTube", "TwistingTube")

#: Largest stretch of a wall to which pressures are followed, and samples up to there.
HIGHEST, SAMPLES = 6.0, 60

ELASTIC = "The rubber is incompressible and elastic: no relaxation, no softening."

THICK_TUBE = Formula(
    name="thick_tube",
    title="Pressure, widening and lengthening of a tube without fibers, past its limit point.",
    families=TUBES,
    assumptions=(
        ELASTIC,
        "The tube is long and stays round and straight: the caps do not hold the wall next to them.",
        "There are no fibers, and no skin.",
    ),
    source=Source(text="Haughton and Ogden 1979, J. Mech. Phys. Solids 27, 179", detail="thick-walled tube"),
)

THICK_SPHERE = Formula(
    name="thick_sphere",
    title="Pressure of a hollow sphere against its widening, past its limit point.",
    families=(),
    assumptions=(ELASTIC, "The sphere stays a sphere: no side of it balloons before the others."),
    source=Source(text="Green and Zerna, Theoretical Elasticity, 1954", detail="inflation of a spherical shell"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HollowSphere:
    """A hollow sphere: what `thick_sphere` takes, since no family of actuators is one.

    Parameters
    ----------
    inner_radius, wall : float [m]
        Radius of the cavity and thickness of the wall at rest.
    """

    inner_radius: float
    wall: float

    def __post_init__(self) -> None:
        for name in ("inner_radius", "wall"):
            check_length(name, getattr(self, name), high=1 * m)


@dataclass(frozen=True, slots=True)
class Turn:
    """A point at which the pressure turns: ``kind`` (maximum or minimum), pressure [Pa], stretch of the inner wall."""

    kind: str
    pressure: float
    inner_stretch: float


def thick_tube(
    actuator: Tube,
    material: Material,
    pressure: ArrayLike | None = None,
    *,
    inner_stretch: ArrayLike | None = None,
    ends: str = "closed",
) -> Response:
    """Inflate a tube without fibers: the exact solution of a long one, for any law.

    Assumptions: The rubber is incompressible and elastic: no relaxation, no softening. The tube is long and stays round
    and straight: the caps do not hold the wall next to them. There are no fibers, and no skin.

    P = ∫ (σθ − σr) dr/r over the wall, with r² − a² = (R² − A²)/λz. With closed ends λz is such that the wall carries
    the push of the pressure on the caps and nothing else; it begins with the square of the pressure.

    Parameters
    ----------
    actuator : ExtendingCylinder, FiberReinforcedCylinder, ContractingTube or TwistingTube
        Its radii, and its length without the caps.
    material : Material
        A rubber.
    pressure : float or (n,) array [Pa], optional
        The largest pressure, or several; on the branch that rises from rest. The path ends at the limit point.
    inner_stretch : float or (n,) array [-], optional
        The largest stretch of the inner wall, or several, instead of the pressure: this passes limit points.
    ends : str
        ``"closed"``: caps that are free to move; ``"fixed"``: the length is fixed.

    Returns
    -------
    Response
        ``pressure``, ``inner_stretch``, ``outer_stretch``, ``axial_stretch``, ``tip_displacement_x``,
        ``cavity_volume``, ``axial_force`` (what holds the ends). Status ``limit_point`` where a pressure is beyond it.

    Raises
    ------
    TurgorError
        If neither or both of pressure and stretch are given, or the law cannot reach them.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> tube = ExtendingCylinder(inner_radius=5e-3, wall=2e-3)
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> thick_tube(tube, rubber, inner_stretch=[1.5])["pressure_kPa"].round(4)  # V06
    array([56.3469])
    """
    THICK_TUBE.check_family(actuator)
    wall = Wall(law_of(material), actuator.inner_radius, actuator.inner_radius + actuator.wall)
    axial_of = _axial_of(wall, ends)
    along = _followed(lambda x: axial_of(x)[0], pressure, inner_stretch)
    pressures, axial = axial_of(along.stretch)
    length = actuator.length - 2 * actuator.cap
    inside = wall.inner * along.stretch
    _, force = wall.tube(along.stretch, axial)
    columns = [
        Column("pressure", "kPa", pressures),
        Column("inner_stretch", "", along.stretch),
        Column("outer_stretch", "", wall.tube_outside(along.stretch, axial)),
        Column("axial_stretch", "", axial),
        Column("tip_displacement_x", "mm", (axial - 1) * length),
        Column("cavity_volume", "mL", np.pi * inside**2 * axial * length),
        Column("axial_force", "N", force),
    ]
    findings: list[Finding | None] = [not_so_simple(material), too_short(length, 2 * wall.inner)]
    findings += beyond_tests(material, np.concatenate([along.stretch, axial]))
    return THICK_TUBE.response(columns, findings, status=along.status, message=along.message)


def thick_sphere(
    sphere: HollowSphere,
    material: Material,
    pressure: ArrayLike | None = None,
    *,
    inner_stretch: ArrayLike | None = None,
) -> Response:
    """Inflate a hollow sphere: the exact solution, for any law.

    Assumptions: The rubber is incompressible and elastic: no relaxation, no softening. The sphere stays a sphere: no
    side of it balloons before the others.

    P = ∫ 2 (σθ − σr) dr/r over the wall, with r³ − a³ = R³ − A³.

    Parameters
    ----------
    sphere : HollowSphere
    material : Material
        A rubber.
    pressure : float or (n,) array [Pa], optional
        The largest pressure, or several; on the branch that rises from rest. The path ends at the limit point.
    inner_stretch : float or (n,) array [-], optional
        The largest stretch of the inner wall, or several, instead of the pressure: this passes limit points.

    Returns
    -------
    Response
        ``pressure``, ``inner_stretch``, ``outer_stretch``, ``cavity_volume``.

    Raises
    ------
    TurgorError
        If neither or both of pressure and stretch are given, or the law cannot reach them.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> ball = HollowSphere(inner_radius=10e-3, wall=5e-3)
    >>> thick_sphere(ball, rubber, inner_stretch=[1.5])["pressure_kPa"].round(4)  # V04
    array([117.1621])
    """
    wall = Wall(law_of(material), sphere.inner_radius, sphere.inner_radius + sphere.wall)
    along = _followed(wall.sphere_pressure, pressure, inner_stretch)
    columns = [
        Column("pressure", "kPa", wall.sphere_pressure(along.stretch)),
        Column("inner_stretch", "", along.stretch),
        Column("outer_stretch", "", wall.sphere_outside(along.stretch)),
        Column("cavity_volume", "mL", 4 / 3 * np.pi * (wall.inner * along.stretch) ** 3),
    ]
    findings = [not_so_simple(material), *beyond_tests(material, along.stretch)]
    return THICK_SPHERE.response(columns, findings, status=along.status, message=along.message)


def limit_points(
    part: Tube | HollowSphere, material: Material, *, ends: str = "closed", up_to: float = 4.0
) -> tuple[Turn, ...]:
    """Find the maxima and minima of the pressure of a tube or a sphere without fibers.

    Parameters
    ----------
    part : HollowSphere, or a family that `thick_tube` takes
    material : Material
        A rubber.
    ends : str
        As for `thick_tube`; a sphere has none.
    up_to : float [-]
        Largest stretch of the inner wall to look at.

    Returns
    -------
    tuple of Turn
        In the order of the path; empty where the pressure rises all the way.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> (turn,) = limit_points(HollowSphere(inner_radius=10e-3, wall=5e-3), rubber)
    >>> turn.kind, round(turn.pressure / 1e3, 5), round(turn.inner_stretch, 5)  # V04: 118.44454 kPa at 1.603434
    ('maximum', 118.44454, 1.60343)
    """
    wall = Wall(law_of(material), part.inner_radius, part.inner_radius + part.wall)
    axial_of = _axial_of(wall, ends)
    curve = wall.sphere_pressure if isinstance(part, HollowSphere) else lambda x: axial_of(x)[0]
    x = _samples(up_to, 200)
    slopes = np.diff(curve(x))
    turns = []
    for k in np.flatnonzero(slopes[:-1] * slopes[1:] < 0):
        at = extremum(curve, x[k], x[k + 2])
        kind = "maximum" if slopes[k] > 0 else "minimum"
        turns.append(Turn(kind, float(curve(np.array([at]))[0]), at))
    return tuple(turns)


@dataclass(frozen=True, slots=True)
class _Path:
    stretch: Array
    status: str = "converged"
    message: str = ""


def _axial_of(wall: Wall, ends: str) -> Callable[[Array], tuple[Array, Array]]:
    """Pressure and axial stretch by inner stretch."""
    known = "closed", "fixed"
    if ends not in known:
        raise unknown("ends of a tube", str(ends), known)
    if ends == "closed":
        knots = _samples(HIGHEST, SAMPLES)
        _, axial = wall.free_tube(knots)
        return lambda x: wall.free_tube(x, np.interp(x, knots, np.where(np.isfinite(axial), axial, 1.0)))
    return lambda x: (wall.tube(x, np.ones_like(x))[0], np.ones_like(x))


def _samples(up_to: float, count: int) -> Array:
    return np.asarray(np.geomspace(1.0, up_to, count))


def _followed(curve: Callable[[Array], Array], pressure: ArrayLike | None, stretch: ArrayLike | None) -> _Path:
    """Stretches of the inner wall along the path, up to the limit point."""
    if (pressure is None) == (stretch is None):
        raise TurgorError("give either pressure or inner_stretch, one of them.")
    if stretch is not None:
        return _Path(path_of("inner_stretch", stretch, low=1.0))
    assert pressure is not None
    pressures = path_of("pressure", pressure)
    rise = rising(curve, _samples(HIGHEST, SAMPLES), float(pressures.max()))
    top = float(rise.y[-1])
    within = pressures <= top
    if not rise.turns and not within.all():
        raise TurgorError(
            f"pressure is {pressures.max() / kPa:g} kPa; at {top / kPa:.4g} kPa the inner wall is stretched "
            f"{rise.x[-1]:.3g} times already, and the formula is not followed further."
        )
    known = inverted(curve, rise, pressures[within])
    if within.all():
        return _Path(known)
    return _Path(np.append(known, rise.x[-1]), "limit_point", _limit(top, rise.x))


def _limit(top: float, x: Sequence[float] | Array) -> str:
    return (
        f"The pressure has its maximum of {top / kPa:.5g} kPa where the inner wall is stretched {x[-1]:.4g} times; "
        "give inner_stretch to follow it further."
    )
