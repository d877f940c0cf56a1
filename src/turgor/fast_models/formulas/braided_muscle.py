"""McKibben muscle: its pull against pressure and contraction, without and with the wall of its bladder."""

from math import cos, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike

from turgor.core.geometry.actuators.contracting_tube import ContractingTube
from turgor.core.materials.material import Material
from turgor.core.model.fibers import Fibers
from turgor.fast_models.formulas.formula import Formula, beyond_tests, not_so_simple, path_of, too_short
from turgor.fast_models.formulas.inversion import inverted, rising
from turgor.fast_models.formulas.thick_walled import ELASTIC
from turgor.fast_models.formulas.wound_energy import Array, WoundWall
from turgor.fast_models.formulas.wound_tubes import ALONG, angle_and_spacing, wound_wall
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import deg, kPa

IDEAL_MCKIBBEN = Formula(
    name="ideal_mckibben",
    title="Pull of a braid that does not stretch, without a bladder.",
    families=("ContractingTube",),
    assumptions=(
        "The braid has both hands and its threads do not stretch.",
        "The muscle stays a cylinder to its ends.",
        "The wall of the bladder has no stiffness, and there is no friction between threads.",
    ),
    source=Source(
        text="Chou and Hannaford 1996, IEEE Trans. Robot. Autom. 12, 90",
        detail="after Gaylord 1958 and Schulte 1961; virtual work F = −P dV/dl",
    ),
)

MCKIBBEN = Formula(
    name="mckibben",
    title="Pull of a muscle whose bladder is a thick wall of any law.",
    families=("ContractingTube",),
    assumptions=(
        ELASTIC,
        "The braid has both hands and its threads do not stretch.",
        "The muscle stays a cylinder to its ends.",
        "There is no friction between threads, and the bladder does not slide on them.",
    ),
    source=Source(text="derived here from the energy of the wall", detail="virtual work F = dW/dl − P dV/dl"),
)


def ideal_mckibben(
    actuator: ContractingTube, fibers: Fibers, pressure: ArrayLike, contraction: ArrayLike = 0.0
) -> Response:
    """Pull with a braid that does not stretch: the force of an ideal McKibben muscle.

    Assumptions: The braid has both hands and its threads do not stretch. The muscle stays a cylinder to its ends. The
    wall of the bladder has no stiffness, and there is no friction between threads.

    F = π r₀² P [a (1 − ε)² − b] with a = 3/tan²θ₀, b = 1/sin²θ₀, θ₀ from the axis; no force is left at
    ε = 1 − √(b/a), where the threads lie at 54.7356° whatever θ₀ is.

    Parameters
    ----------
    actuator : ContractingTube
        Its outer radius is that of the braid, r₀.
    fibers : Fibers
        Their angle; both hands.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several.
    contraction : float or (n,) array [-]
        ε = shortening over length, one for all pressures or one for each.

    Returns
    -------
    Response
        ``pressure``, ``contraction``, ``pull_force`` (negative: pushes), ``fiber_angle``.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Hooke
    >>> from turgor.core.model.fibers import Winding
    >>> thread = Material(name="thread", law=Hooke(E=31e9, nu=0.3))
    >>> winding = Winding(angle_from_axis=25 * deg, spacing=1e-3, hand="both")
    >>> braid = Fibers(face="outside", material=thread, diameter=0.1e-3, winding=winding)
    >>> muscle = ContractingTube(inner_radius=9e-3, wall=1e-3)
    >>> pull = ideal_mckibben(muscle, braid, [100e3, 100e3], [0.0, 0.1])["pull_force"]
    >>> (pull / (np.pi * 0.01**2 * 100e3)).round(6)  # V19
    array([8.19782 , 5.576441])
    """
    IDEAL_MCKIBBEN.check_family(actuator)
    start = _angle(actuator, fibers)
    pressures = path_of("pressure", pressure)
    shortened = _matched(contraction, pressures)
    a, b = 3 / np.tan(start) ** 2, 1 / sin(start) ** 2
    force = np.pi * actuator.outer_radius**2 * pressures * (a * (1 - shortened) ** 2 - b)
    along = cos(start) * (1 - shortened)
    if (along > 1).any():
        raise TurgorError(
            f"contraction is {shortened.min():g}; the threads lie along the axis at {1 - 1 / cos(start):.4g} already."
        )
    columns = [
        Column("pressure", "kPa", pressures),
        Column("contraction", "", shortened),
        Column("pull_force", "N", force),
        Column("fiber_angle", "deg", np.arccos(along)),
    ]
    finding = _wall_counts(actuator)
    return IDEAL_MCKIBBEN.response(columns, [finding, _short(actuator)])


def mckibben(
    actuator: ContractingTube,
    material: Material,
    fibers: Fibers,
    pressure: ArrayLike,
    contraction: ArrayLike | None = None,
) -> Response:
    """Pull with a bladder of rubber in a braid: the ideal force less what the wall takes, for any law.

    Assumptions: The rubber is incompressible and elastic: no relaxation, no softening. The braid has both hands and its
    threads do not stretch. The muscle stays a cylinder to its ends. There is no friction between threads, and the
    bladder does not slide on them.

    The braid gives the outer radius, λz² cos²θ₀ + (b/B)² sin²θ₀ = 1, the volume of the wall the inner one; the force is
    F = −P dV/dl + dW/dl with the energy W of the wall. Since the wall keeps its volume, −P dV/dl is the ideal force at
    the radius of the braid exactly.

    Parameters
    ----------
    actuator : ContractingTube
        Its bladder, whose outside is the braid.
    material : Material
        The rubber of the bladder.
    fibers : Fibers
        Their angle; both hands.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several.
    contraction : float or (n,) array [-], optional
        ε = shortening over length, one for all pressures or one for each; by default what it is without a load.

    Returns
    -------
    Response
        ``pressure``, ``contraction``, ``pull_force`` (negative: pushes), ``fiber_angle``, ``cavity_volume``,
        ``tip_displacement_x``.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Hooke, NeoHooke
    >>> from turgor.core.model.fibers import Winding
    >>> thread = Material(name="thread", law=Hooke(E=31e9, nu=0.3))
    >>> winding = Winding(angle_from_axis=25 * deg, spacing=1e-3, hand="both")
    >>> braid = Fibers(face="outside", material=thread, diameter=0.1e-3, winding=winding)
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> muscle = mckibben(ContractingTube(), rubber, braid, [200e3])
    >>> muscle["contraction"].round(3)  # the ideal muscle shortens by 0.363
    array([0.3])
    """
    MCKIBBEN.check_family(actuator)
    start = _angle(actuator, fibers)
    wall = wound_wall(actuator, material, (fibers,), wall="thick", inextensible=True)
    pressures = path_of("pressure", pressure)
    length = actuator.length - 2 * actuator.cap
    shortened = 1 - _unloaded(wall, start, pressures) if contraction is None else _matched(contraction, pressures)
    states = _braid_states(wall, start, 1 - shortened)
    by_wall, by_pressure = _pull(wall, states)
    pull = by_wall - pressures * by_pressure
    inner, axial = states[:, 0], states[:, 1]
    columns = [
        Column("pressure", "kPa", pressures),
        Column("contraction", "", 1 - axial),
        Column("pull_force", "N", pull),
        Column("fiber_angle", "deg", np.arccos(np.minimum(cos(start) * axial, 1.0))),
        Column("cavity_volume", "mL", np.pi * inner**2 * axial * length),
        Column("tip_displacement_x", "mm", (axial - 1) * length),
    ]
    findings = [not_so_simple(material), *beyond_tests(material, inner / actuator.inner_radius), _short(actuator)]
    return MCKIBBEN.response(columns, findings)


def _braid_states(wall: WoundWall, start: float, axial: Array) -> Array:
    """States that the braid allows at axial stretches, as rows of `WoundWall.slopes`."""
    square = 1 - (cos(start) * axial) ** 2
    b = wall.wound * np.sqrt(np.maximum(square, 0.0)) / sin(start)
    inner = b**2 - (wall.wound**2 - wall.inner**2) / axial
    closed = (square <= 0) | (inner <= 0)
    if closed.any():
        raise TurgorError(
            f"contraction is {1 - axial[closed][0]:g}; a braid of {start / deg:.4g} deg then leaves the bladder no "
            "cavity."
        )
    return np.stack([np.sqrt(inner), axial, np.zeros_like(axial)], axis=1)


def _unloaded(wall: WoundWall, start: float, pressure: Array) -> Array:
    """Axial stretches without a load: between rest, where the wall is unstressed, and where an ideal muscle ends."""
    ideal = 1 / (sqrt(3) * cos(start))
    if abs(ideal - 1) < 1e-12:
        return np.ones_like(pressure)

    def balanced(share: Array) -> Array:
        """The pressure that holds a share of the way to where an ideal muscle ends."""
        by_wall, by_pressure = _pull(wall, _braid_states(wall, start, 1 + share * (ideal - 1)))
        return by_wall / by_pressure

    shares = np.concatenate([[0.0], 1 - np.geomspace(0.99, 1e-6, 40)])
    rise = rising(balanced, shares, float(pressure.max()))
    if pressure.max() > rise.y[-1]:
        raise TurgorError(
            f"pressure is {pressure.max() / kPa:g} kPa; the formula is not followed beyond {rise.y[-1] / kPa:.4g} kPa."
        )
    return 1 + inverted(balanced, rise, pressure) * (ideal - 1)


def _pull(wall: WoundWall, x: Array) -> tuple[Array, Array]:
    """Force of the wall, and what each pascal takes from it, by virtual work along the line that the braid allows."""
    slopes, along = wall.slopes(x), wall.threads(x)[1][:, 0]
    ratio = along[:, 1] / along[:, 0]
    by_pressure = np.pi * (x[:, 0] ** 2 - 2 * x[:, 0] * x[:, 1] * ratio)
    return slopes[:, 1] - slopes[:, 0] * ratio, by_pressure


def _angle(actuator: ContractingTube, fibers: Fibers) -> float:
    angle, _ = angle_and_spacing(fibers, actuator.outer_radius, actuator.length - 2 * actuator.cap)
    if fibers.wound.hand != "both":
        raise TurgorError(f"hand of the winding is '{fibers.wound.hand}'; a braid has hand = 'both'.")
    if not ALONG < angle < np.pi / 2 - ALONG:
        raise TurgorError(f"the threads run at {angle / deg:g} deg from the axis; a braid lies between 0 and 90 deg.")
    return angle


def _matched(contraction: ArrayLike, pressures: np.ndarray) -> np.ndarray:
    given = np.asarray(contraction, dtype=np.float64)
    if given.shape not in ((), pressures.shape) or not np.isfinite(given).all() or not (given < 1).all():
        raise TurgorError(
            f"contraction is {contraction!r}; a number below 1 is needed, or one for each of the "
            f"{len(pressures)} pressures."
        )
    return np.asarray(np.broadcast_to(given, pressures.shape))


def _wall_counts(actuator: ContractingTube) -> Finding | None:
    """F09: a wall that is not thin."""
    share = actuator.wall / actuator.outer_radius
    if share < 0.05:
        return None
    return Finding(
        code="F09",
        severity=Severity.NOTE,
        message=f"The wall of the bladder is {100 * share:.3g} % of the radius, and the ideal muscle leaves it out.",
        advice="Use mckibben, which takes the wall and its rubber into account.",
    )


def _short(actuator: ContractingTube) -> Finding | None:
    return too_short(actuator.length - 2 * actuator.cap, 2 * actuator.outer_radius)
