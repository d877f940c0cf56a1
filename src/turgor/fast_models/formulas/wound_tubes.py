"""Wound tube: how a tube with threads on it lengthens, widens and twists."""

from collections.abc import Sequence
from math import atan, cos, inf, pi

import numpy as np
from numpy.typing import ArrayLike

from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.material import Material
from turgor.core.model.fibers import Fibers
from turgor.fast_models.formulas.formula import Formula, beyond_tests, law_of, not_so_simple, path_of, too_short
from turgor.fast_models.formulas.thick_walled import ELASTIC, TUBES, Tube
from turgor.fast_models.formulas.wound_energy import Family, Point, WoundWall
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.round_off import ROUND_OFF
from turgor.foundation.source import Source
from turgor.units import kPa

#: Angle from the axis below which threads run along it, and as far from 90° below which they are hoops [rad].
ALONG = ROUND_OFF.same

WOUND_TUBE = Formula(
    name="wound_tube",
    title="Extension, expansion and twist of a tube with threads, against pressure and angle.",
    families=TUBES,
    assumptions=(
        ELASTIC,
        "The tube is long and stays round and straight: the caps do not hold the wall next to them.",
        "The threads are so close that they act like a sheet, and they do not slide on the rubber.",
    ),
    source=Source(
        text="derived here from the energy of the wall and the threads",
        detail="kinematics as Adkins and Rivlin 1955, Phil. Trans. R. Soc. A 248, 201",
    ),
)


def wound_tube(
    actuator: Tube,
    material: Material,
    fibers: Fibers | Sequence[Fibers],
    pressure: ArrayLike,
    *,
    wall: str = "thick",
    inextensible: bool = False,
) -> Response:
    """Inflate a tube that is wound with threads: its extension, expansion and twist.

    Assumptions: The rubber is incompressible and elastic: no relaxation, no softening. The tube is long and stays round
    and straight: the caps do not hold the wall next to them. The threads are so close that they act like a sheet, and
    they do not slide on the rubber.

    The minimum of the energy of wall and threads less P V. Threads that do not stretch obey
    λz² cos²α + λθ² sin²α = 1 without a twist, α from the axis; a soft tube then ends at tan²α = 2, 54.7356°.

    Parameters
    ----------
    actuator : ExtendingCylinder, FiberReinforcedCylinder, ContractingTube or TwistingTube
        The threads lie on its outside, or below the skin where it has one, which is taken to be of the same rubber.
    material : Material
        A rubber.
    fibers : Fibers or several
        Their angle, hand and stiffness for each width; ``face`` and ``form`` do not count.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several that rise.
    wall : str
        ``"thick"``: the exact wall; ``"thin"``: a membrane that lies where the threads are.
    inextensible : bool
        Whether threads do not stretch at all. They are then not allowed to go slack either (F04).

    Returns
    -------
    Response
        ``pressure``, ``tip_displacement_x``, ``twist_angle`` (negative against a right-handed helix),
        ``cavity_volume``, ``axial_stretch``, ``inner_stretch``, ``fiber_angle`` (of the first winding, from the axis,
        now), ``maximum_fiber_tension`` (of one thread). Status ``limit_point`` where no state was found beyond.

    Raises
    ------
    TurgorError
        If the windings leave the tube no way to move, or pressures do not rise.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.twisting_tube import TwistingTube
    >>> from turgor.core.materials.laws.laws import Hooke, NeoHooke
    >>> from turgor.core.model.fibers import Winding
    >>> thread = Material(name="thread", law=Hooke(E=31067e6, nu=0.36))
    >>> helix = Winding(angle_from_axis=np.radians(60), spacing=2e-3)
    >>> kevlar = Fibers(face="outside", material=thread, diameter=0.1778e-3, winding=helix)
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> tube = TwistingTube(length=110e-3)  # 100 mm between the caps
    >>> wound_tube(tube, rubber, kevlar, [30e3])["twist_angle_deg"].round(2)  # V20: −0.844783 degrees for each mm
    array([-84.48])
    """
    WOUND_TUBE.check_family(actuator)
    windings = (fibers,) if isinstance(fibers, Fibers) else tuple(fibers)
    body = wound_wall(actuator, material, windings, wall=wall, inextensible=inextensible)
    if inextensible and len(body.families) >= (2 if body.symmetric else 3):
        raise TurgorError(
            f"{len(body.families)} directions of threads that do not stretch leave the tube no way to move; "
            "use inextensible=False, or fewer windings."
        )
    pressures = path_of("pressure", pressure)
    if (falls := np.diff(pressures) < 0).any():
        row = int(falls.argmax())
        raise TurgorError(
            f"pressure falls from {pressures[row] / kPa:g} to {pressures[row + 1] / kPa:g} kPa; it must rise, as "
            "the path is followed from rest."
        )
    return _answered(actuator, material, windings, body, pressures)


def _answered(
    actuator: Tube, material: Material, windings: Sequence[Fibers], body: WoundWall, pressures: np.ndarray
) -> Response:
    """Follow the pressures, and say where the path ends and what does not hold."""
    states = body.follow(pressures)
    ended = pressures[: len(states)]
    length = actuator.length - 2 * actuator.cap
    findings: list[Finding | None] = [not_so_simple(material), too_short(length, 2 * actuator.inner_radius)]
    findings += beyond_tests(material, [max(at.axial, at.inner / body.base) for at in states])
    findings.append(pushed(body, states))
    status, message = "converged", ""
    if len(states) < len(pressures):
        last = ended[-1] / kPa if len(ended) else 0.0
        status, message = "limit_point", f"No state was found beyond {last:.5g} kPa: the tube balloons or buckles."
    return WOUND_TUBE.response(
        _columns(body, windings, states, ended, length), findings, status=status, message=message
    )


def wound_wall(
    actuator: Tube, material: Material, windings: Sequence[Fibers], *, wall: str, inextensible: bool
) -> WoundWall:
    """Make the wall with its families of threads."""
    if wall not in ("thick", "thin"):
        raise unknown("wall of a tube", str(wall), ("thick", "thin"))
    wound = actuator.inner_radius + actuator.wall
    skin = actuator.skin if isinstance(actuator, FiberReinforcedCylinder) else 0.0
    free = actuator.length - 2 * actuator.cap
    return WoundWall(
        law=law_of(material),
        inner=actuator.inner_radius,
        outer=wound + skin,
        wound=wound,
        families=_families(windings, wound, free, rigid=inextensible),
        thin=wall == "thin",
    )


def angle_and_spacing(fibers: Fibers, radius: float, length: float) -> tuple[float, float]:
    """Angle from the axis [rad] and distance between neighbors [m] of threads around a cylinder."""
    winding = fibers.wound
    if winding.angle_from_axis is not None:
        angle = winding.angle_from_axis
    elif winding.angle_from_circumference is not None:
        angle = pi / 2 - winding.angle_from_circumference
    else:
        pitch = winding.pitch if winding.pitch is not None else length / (winding.turns or 1.0)
        angle = atan(2 * pi * radius / pitch)
    if winding.spacing is not None:
        return angle, winding.spacing
    if angle > pi / 2 - ALONG:
        raise TurgorError(
            f"winding starts is {winding.starts}, but hoops do not start at an end; give their spacing instead."
        )
    return angle, 2 * pi * radius * cos(angle) / (winding.starts or 1)


def _families(windings: Sequence[Fibers], radius: float, length: float, *, rigid: bool) -> tuple[Family, ...]:
    families, single = [], False
    for fibers in windings:
        angle, spacing = angle_and_spacing(fibers, radius, length)
        stiffness = inf if rigid else fibers.stretching_stiffness / spacing
        turned = ALONG < angle < pi / 2 - ALONG
        hand = {"right": 1.0, "left": -1.0, "both": 0.0}[fibers.wound.hand] if turned else 0.0
        single = single or hand != 0
        double = 2 if turned and hand == 0 else 1
        families.append(Family(angle, stiffness * double, hand, fibers.compression))
    if not single:
        return tuple(families)
    return tuple(part for family in families for part in _hands(family))


def _hands(family: Family) -> tuple[Family, ...]:
    """Both hands by themselves, since the tube may twist."""
    if family.hand or not ALONG < family.angle < pi / 2 - ALONG:
        return (Family(family.angle, family.stiffness, family.hand or 1.0, family.compression),)
    return tuple(Family(family.angle, family.stiffness / 2, hand, family.compression) for hand in (1.0, -1.0))


def pushed(body: WoundWall, states: Sequence[Point]) -> Finding | None:
    """F04: threads are pushed along their length, where real ones go slack."""
    least = min((float(body.tensions(at).min()) for at in states), default=0.0)
    if least >= -1e-9 * body.law.shear_modulus * body.base:
        return None
    return Finding(
        code="F04",
        severity=Severity.WARNING,
        message=f"Threads are pushed with up to {-least:.3g} N for each meter of width; real ones go slack.",
        advice="Let them go slack: inextensible=False with compression 0, or leave out the threads that are pushed.",
    )


def _columns(
    body: WoundWall, windings: Sequence[Fibers], states: Sequence[Point], pressures: np.ndarray, length: float
) -> list[Column]:
    axial = np.array([at.axial for at in states])
    inner = np.array([at.inner for at in states])
    twist = np.array([at.twist for at in states])
    b = np.array([float(body.radius(at, body.wound)) for at in states])
    first = body.families[0]
    around = np.sin(first.angle) * b / body.wound + np.cos(first.angle) * twist * b * first.hand
    _, spacing = angle_and_spacing(windings[0], body.wound, length)
    hands = 2 if body.symmetric and ALONG < first.angle < pi / 2 - ALONG else 1
    tension = np.array([float(body.tensions(at)[0]) for at in states]) * spacing / hands
    return [
        Column("pressure", "kPa", pressures),
        Column("tip_displacement_x", "mm", (axial - 1) * length),
        Column("twist_angle", "deg", twist * length),
        Column(
            "cavity_volume",
            "mL",
            np.pi * inner**2 * axial * length,
        ),
        Column("axial_stretch", "", axial),
        Column("inner_stretch", "", inner / body.base),
        Column("fiber_angle", "deg", np.arctan2(around, np.cos(first.angle) * axial)),
        Column("maximum_fiber_tension", "N", tension),
    ]
