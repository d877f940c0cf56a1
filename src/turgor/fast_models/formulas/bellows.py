"""Castigliano's theorem for bellows: axial stiffness, effective area and blocked force of folds that bend."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np
from numpy.typing import ArrayLike

from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.core.geometry.actuators.parallel_bellows import ParallelBellows
from turgor.core.materials.material import Material
from turgor.fast_models.formulas.formula import Formula, not_so_simple, path_of, poisson_ratio, strained, young_modulus
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)

CASTIGLIANO_BELLOWS = Formula(
    name="castigliano_bellows",
    title="Blocked force, blocked moment and small free motion of bellows whose folds bend.",
    families=("BellowsOfRevolution", "ParallelBellows"),
    assumptions=(
        "Strains and rotations are small, and the rubber is linear with the modulus that it has at rest.",
        "The wall of a fold bends along its generator only: rings around the axis neither stretch nor bend.",
        "Neck and crest do not rotate, and what pushes across the axis does not bend the wall.",
        "Parallel bellows bend with constant curvature, and ribs and plates are rigid.",
    ),
    source=Source(
        text="derived here by Castigliano's theorem",
        detail="the approach of Drotman et al. 2019 as Xavier, Fleming and Yong 2021, section 1.1, describe it",
        doubts=("the publication of Drotman et al. was not at hand; its own equations may differ",),
    ),
)


@dataclass(frozen=True, slots=True)
class Fold:
    """Half a fold: a wall from neck to crest that does not rotate at either end.

    Parameters
    ----------
    inner, outer : float [m]
        Radii of the middle of the wall at neck and crest.
    bending : float [N m]
        Bending stiffness D = E t³ / (12 (1 − ν²)) for each width.
    rounding : float [m]
        Radius of the quarter circles at both ends; between them the wall is flat.
    slant : float
        Length of the generator over its radial part, at least 1: a cone without quarter circles.
    """

    inner: float
    outer: float
    bending: float
    rounding: float = 0.0
    slant: float = 1.0

    @property
    def compliance(self) -> float:
        """Extension for each axial force [m/N]: ∂²U/∂F²; of a flat ring [(b² − a²)/2 − (b − a)²/ln(b/a)] / (2 π D)."""
        r, ds = self._generator
        lever = r - ds.sum() / (ds / r).sum()
        return float((lever**2 / r) @ ds) / (2 * pi * self.bending)

    @property
    def area(self) -> float:
        """Effective area [m²]: blocked force over pressure, ∂²U/∂F∂P over ∂²U/∂F²."""
        r, ds = self._generator
        lever = r - ds.sum() / (ds / r).sum()
        return float((pi / 3 * r**2 * lever) @ ds) / (2 * pi * self.bending) / self.compliance

    @property
    def _generator(self) -> tuple[np.ndarray, np.ndarray]:
        """Radii along the wall, and the length around each."""
        angle = pi / 4 * (_NODES + 1)
        turn, bow = pi / 4 * _WEIGHTS * self.rounding, self.rounding * (1 - np.cos(angle))
        low, high = self.inner + self.rounding, self.outer - self.rounding
        flat = (low + high) / 2 + (high - low) / 2 * _NODES
        r = np.concatenate([self.inner + bow, flat, self.outer - bow])
        return r, np.concatenate([turn, (high - low) / 2 * _WEIGHTS * self.slant, turn])

    @property
    def plate_compliance(self) -> float:
        """Extension for each axial force of a flat ring as a plate, whose rings around the axis resist, too [m/N]."""
        a, b = self.inner, self.outer

        def part(r: float) -> float:  # of r φ, from the shear force F / (2 π r)
            return (r**2 / 2 * log(r) - r**2 / 4) / (2 * pi * self.bending)

        C1 = (part(b) - part(a)) / ((b**2 - a**2) / 2)
        C2 = part(a) - C1 * a**2 / 2

        def sunk(r: float) -> float:  # ∫ φ dr
            own = (r**2 / 4 * (log(r) - 0.5) - r**2 / 8) / (2 * pi * self.bending)
            return own - C1 * r**2 / 4 - C2 * log(r)

        return abs(sunk(b) - sunk(a))


def castigliano_bellows(
    actuator: BellowsOfRevolution | ParallelBellows,
    material: Material,
    pressure: ArrayLike,
    *,
    shares: Sequence[float] = (1.0, 0.0, 0.0),
) -> Response:
    """Push with bellows: the force of a bellows whose length is fixed, and its small motion where it is free.

    Assumptions: Strains and rotations are small, and the rubber is linear with the modulus that it has at rest. The
    wall of a fold bends along its generator only: rings around the axis neither stretch nor bend. Neck and crest do not
    rotate, and what pushes across the axis does not bend the wall. Parallel bellows bend with constant curvature, and
    ribs and plates are rigid.

    The ring at the radius r carries N = F + P π r² and bends with M = M₀ + ∫ N dr on the width 2 π r. From
    U = ∫ M²/(4 π r D) ds, ∂U/∂M₀ = 0 gives M₀ and ∂U/∂F the extension of half a fold, c F + c A P: a bellows of n folds
    pushes with P A when it is fixed, and lengthens by 2 n c P A when it is free. A is nearly π times the square of the
    mean radius. Three bellows at the distance d from the middle push with Σ Pᵢ A and bend with Σ Pᵢ A dᵢ.

    Parameters
    ----------
    actuator : BellowsOfRevolution or ParallelBellows
    material : Material
        The material of the folds.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several.
    shares : (3,) floats
        Pressure in each of three parallel bellows over ``pressure``; a single bellows has none.

    Returns
    -------
    Response
        ``pressure``, ``blocked_force`` (along the axis), ``tip_displacement_x`` (free) and, of parallel bellows,
        ``blocked_moment`` and ``bending_angle`` (free).

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> push = castigliano_bellows(BellowsOfRevolution(), rubber, [5e3])
    >>> push["blocked_force"].round(2)  # 5 kPa on the mean radius of 12 mm: 2.262 N
    array([2.26])
    """
    CASTIGLIANO_BELLOWS.check_family(actuator)
    pressures = path_of("pressure", pressure)
    fold = fold_of(actuator, material)
    compliance = 2 * actuator.folds * fold.compliance
    one = pressures * fold.area
    columns = [Column("pressure", "kPa", pressures)]
    if isinstance(actuator, BellowsOfRevolution):
        columns += [Column("blocked_force", "N", one), Column("tip_displacement_x", "mm", one * compliance)]
        moved = one * compliance
    else:
        given, places = _shares(shares), _places(actuator)
        moment = np.linalg.norm(given @ places)
        own = 3 * ((fold.inner + fold.outer) / 2) ** 2 / 2  # a bellows resists a turn by itself
        stiffness = (float((places**2).sum()) / 2 + own) / compliance
        moved = one * given.max() * compliance
        columns += [
            Column("blocked_force", "N", one * given.sum()),
            Column("tip_displacement_x", "mm", one * given.sum() * compliance / 3),
            Column("blocked_moment", "Nm", one * moment),
            Column("bending_angle", "deg", one * moment / stiffness),
        ]
    findings = [
        not_so_simple(material),
        _rings(fold),
        _steep(actuator),
        strained(_strain(actuator, fold, float(moved.max())), "the folds"),
    ]
    return CASTIGLIANO_BELLOWS.response(columns, findings)


def fold_of(actuator: BellowsOfRevolution | ParallelBellows, material: Material) -> Fold:
    """Return half a fold of a bellows as a ring."""
    nu = poisson_ratio(material)
    D = young_modulus(material) * actuator.wall**3 / (12 * (1 - nu**2))
    a, b = actuator.inner_radius + actuator.wall / 2, actuator.outer_radius - actuator.wall / 2
    if not b > a:
        raise TurgorError("the wall is as thick as the fold is high; there is no fold left that could bend.")
    if actuator.fold_shape == "straight":
        return Fold(a, b, D, slant=sqrt(1 + (actuator.pitch / 2 / (b - a)) ** 2))
    return Fold(a, b, D, rounding=actuator.pitch / 4)


def _places(actuator: ParallelBellows) -> np.ndarray:
    """Axes of the bellows in the plane (y, z), (3, 2) [m]."""
    angles = 2 * pi * np.arange(3) / 3
    return actuator.side / sqrt(3) * np.stack([-np.sin(angles), np.cos(angles)], axis=1)


def _shares(shares: Sequence[float]) -> np.ndarray:
    given = np.asarray(shares, dtype=np.float64)
    if given.shape != (3,) or not np.isfinite(given).all() or (given < 0).any() or not given.any():
        raise TurgorError(f"shares is {shares!r}; three numbers from 0 are needed, one for each bellows.")
    return given


def _strain(actuator: BellowsOfRevolution | ParallelBellows, fold: Fold, moved: float) -> float:
    """Largest strain of the wall in bending, of a strip clamped at both ends: 3 t δ / w²."""
    return 3 * actuator.wall * moved / (2 * actuator.folds) / (fold.outer - fold.inner) ** 2


def _rings(fold: Fold) -> Finding | None:
    """F06: rings around the axis resist, which the strips leave out."""
    softer = Fold(fold.inner, fold.outer, fold.bending).compliance / fold.plate_compliance - 1
    if softer < 0.02:
        return None
    return Finding(
        code="F06",
        severity=Severity.WARNING if softer > 0.1 else Severity.NOTE,
        message=f"As a plate whose rings resist as well, a flat fold is {100 * softer:.3g} % stiffer than the formula "
        f"says, with a crest {fold.outer / fold.inner:.3g} times as wide as the neck.",
        advice="The blocked force hardly depends on it; divide a free motion accordingly, or use finite elements.",
    )


def _steep(actuator: BellowsOfRevolution | ParallelBellows) -> Finding | None:
    """F12: a wall that rises along the axis cannot bend without stretching its rings."""
    rise = actuator.pitch / 2 / actuator.wall
    if rise < 1.5:
        return None
    return Finding(
        code="F12",
        severity=Severity.WARNING,
        message=f"Between neck and crest the wall rises by {rise:.3g} times its thickness; it cannot bend without "
        "stretching its rings, and is stiffer than the formula says.",
        advice="Trust the blocked force; take the free motion as an upper bound, or use finite elements.",
    )
