"""Energy of a wound tube: extension, inflation and torsion of a round wall of any law, with threads on a cylinder.

Unknowns are the inner radius a, the axial stretch λz and the twist τ for each reference length. The wall keeps its
volume, r² = a² + (R² − A²)/λz; its deformation in the directions (R, Θ, Z) has C_ΘΘ = r²/R², C_ΘZ = τ r²/R,
C_ZZ = λz² + τ² r² and C_RR = 1/(C_ΘΘ C_ZZ − C_ΘZ²). A thread at the angle α from the axis on the radius B has
λf² = (± sin α b/B + cos α τ b)² + (cos α λz)²; the upper sign is that of a right-handed helix.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from turgor.materials.laws.derivatives import stretch_derivatives
from turgor.materials.laws.laws import Law

Array = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)

#: Newton's method: most iterations, relative residual at its end, step of the differences.
PASSES, CLOSE, STEP = 12, 1e-11, 1e-7

#: Finest cut of a step of the pressure, as a share.
FINEST = 1 / 1024


@dataclass(frozen=True, slots=True)
class Family:
    """Threads of one direction.

    Parameters
    ----------
    angle : float [rad]
        From the axis.
    stiffness : float [N/m]
        Tension for each width and strain; infinite for threads that do not stretch.
    hand : float
        +1 right-handed, −1 left-handed; 0 where both hands (or hoops, or axial threads) make the winding symmetric.
    compression : float
        Share of the stiffness that works below the length at rest.
    """

    angle: float
    stiffness: float
    hand: float
    compression: float = 0.0


@dataclass(frozen=True, slots=True)
class Point:
    """A state of the tube: inner radius [m], axial stretch, twist [rad/m], tension for each width of rigid families."""

    inner: float
    axial: float
    twist: float
    rigid: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class WoundWall:
    """A wall with threads on it.

    Parameters
    ----------
    law : Law
    inner, outer, wound : float [m]
        Radii of the wall and of the cylinder on which the threads lie.
    families : sequence of Family
    thin : bool
        Whether the wall counts as a membrane on the radius ``wound``, which the pressure then pushes too.
    """

    law: Law
    inner: float
    outer: float
    wound: float
    families: Sequence[Family]
    thin: bool = False

    @property
    def symmetric(self) -> bool:
        """Whether no twist can come."""
        return all(family.hand == 0 for family in self.families)

    @property
    def base(self) -> float:
        """Radius on which the pressure pushes, at rest [m]."""
        return self.wound if self.thin else self.inner

    def radius(self, at: Point, R: Array | float) -> Array:
        """Current radius of what was at R."""
        return np.asarray(np.sqrt(at.inner**2 + (np.asarray(R) ** 2 - self.base**2) / at.axial))

    def slopes(self, at: Point) -> Array:
        """Derivatives of the energy of the wall for each length by inner radius, axial stretch and twist, (3,)."""
        R, area = self._points
        g = at.inner**2 + (R**2 - self.base**2) / at.axial
        of_g = np.array([np.full_like(R, 2 * at.inner), -(R**2 - self.base**2) / at.axial**2, np.zeros_like(R)])
        C = np.empty((len(R), 2, 2))
        C[:, 0, 0], C[:, 1, 1] = g / R**2, at.axial**2 + at.twist**2 * g
        C[:, 0, 1] = C[:, 1, 0] = at.twist * g / R
        squares, axes = np.linalg.eigh(C)
        l1, l2 = np.sqrt(squares[:, 0]), np.sqrt(squares[:, 1])
        l3 = 1 / (l1 * l2)
        _, W1, W2, W3, *_ = stretch_derivatives(self.law, l1, l2, l3)
        principal = np.stack([W1 / l1, W2 / l2], axis=1)
        S = np.einsum("nik,nk,njk->nij", axes, principal, axes)
        by_g = S[:, 0, 0] / R**2 + 2 * S[:, 0, 1] * at.twist / R + S[:, 1, 1] * at.twist**2
        own = np.zeros((3, len(R)))
        own[1] = 2 * at.axial * S[:, 1, 1]
        own[2] = 2 * S[:, 0, 1] * g / R + 2 * S[:, 1, 1] * at.twist * g
        through = -W3 * l3  # ½ S_RR dC_RR = −½ W3 l3 d(det C)/det C, with det C = λz² g/R²
        own[1] += 2 * through / at.axial
        return np.asarray(((of_g * (by_g + through / g) + own) / 2) @ area)

    def threads(self, at: Point) -> tuple[Array, Array]:
        """Squares of the stretches of the families (f,), and their derivatives by radius, stretch and twist (f, 3)."""
        b = float(self.radius(at, self.wound))
        of_b = np.array([at.inner / b, -(self.wound**2 - self.base**2) / (2 * b * at.axial**2), 0.0])
        s = np.array([np.sin(family.angle) * (family.hand or 1.0) for family in self.families]) / self.wound
        c = np.array([np.cos(family.angle) for family in self.families])
        free = np.array([abs(family.hand) for family in self.families])
        around = s + c * at.twist * free
        squares = (around * b) ** 2 + (c * at.axial) ** 2
        slopes = (2 * b * around**2)[:, None] * of_b
        slopes[:, 1] += 2 * c**2 * at.axial
        slopes[:, 2] += 2 * b**2 * around * c * free
        return squares, slopes

    def tensions(self, at: Point) -> Array:
        """Tension of each family for each width at rest [N/m]; negative where threads are pushed, (f,)."""
        stretches = np.sqrt(self.threads(at)[0])
        rigid = iter(at.rigid)
        return np.array(
            [
                next(rigid) if family.stiffness == inf else family.stiffness * _resisting(family, stretch - 1)
                for family, stretch in zip(self.families, stretches, strict=True)
            ]
        )

    def pull(self, at: Point, pressure: float) -> float:
        """Force that pulls at closed ends beyond that of the pressure [N]."""
        return float(self._forces(at, pressure)[1])

    def follow(self, pressures: Array, *, axial: float | None = None) -> list[Point]:
        """Take the tube through pressures [Pa], its ends free or its stretch held; ends where no state is found."""
        found: list[Point] = []
        at, before = self.rest, 0.0
        if axial is not None:
            for stretch in np.linspace(1.0, axial, max(2, int(abs(axial - 1) / 0.02) + 2))[1:]:
                reached = self._solved(self._moved(at, float(stretch)), 0.0, held=True)
                if reached is None:
                    return found
                at = reached
        for pressure in pressures:
            step = before
            share = 1.0
            while step != pressure:
                target = float(pressure) if share == 1.0 else step + share * (float(pressure) - step)
                reached = self._solved(at, target, held=axial is not None)
                if reached is None:
                    share /= 2
                    if share < FINEST:
                        return found
                    continue
                at, step, share = reached, target, 1.0 if target == pressure else min(1.0, 2 * share)
            found.append(at)
            before = float(pressure)
        return found

    @property
    def rest(self) -> Point:
        """The tube without pressure."""
        return Point(self.base, 1.0, 0.0, (0.0,) * sum(family.stiffness == inf for family in self.families))

    @property
    def _points(self) -> tuple[Array, Array]:
        """Radii of the quadrature, and area of the wall around each."""
        if self.thin:
            return np.array([self.wound]), np.array([np.pi * (self.outer**2 - self.inner**2)])
        middle, half = (self.outer + self.inner) / 2, (self.outer - self.inner) / 2
        R = middle + half * _NODES
        return R, 2 * np.pi * R * half * _WEIGHTS

    def _moved(self, at: Point, axial: float) -> Point:
        """The same threads at another axial stretch: what holds a rigid winding, and a first guess for the others."""
        for family in self.families:
            square = 1 - (np.cos(family.angle) * axial) ** 2
            if family.stiffness == inf and np.sin(family.angle) > 1e-9 and square > 0:
                b = self.wound * np.sqrt(square) / np.sin(family.angle)
                inner = b**2 - (self.wound**2 - self.base**2) / axial
                return Point(float(np.sqrt(max(inner, 1e-4 * self.base**2))), axial, at.twist, at.rigid)
        return Point(at.inner, axial, at.twist, at.rigid)

    def _forces(self, at: Point, pressure: float) -> Array:
        """What is out of balance: by inner radius, axial stretch, twist; then by how much rigid threads stretch."""
        out = self.slopes(at)
        out -= np.pi * pressure * np.array([2 * at.inner * at.axial, at.inner**2, 0.0])
        squares, slopes = self.threads(at)
        around = np.pi * self.wound  # 2 π B for each length, and half of the derivative of the square
        stretched = []
        rigid = iter(at.rigid)
        for family, square, slope in zip(self.families, squares, slopes, strict=True):
            if family.stiffness == inf:
                out += around * next(rigid) * slope
                stretched.append(square - 1)
            else:
                size = float(np.sqrt(square))
                out += around * family.stiffness * _resisting(family, size - 1) / size * slope
        return np.concatenate([out, stretched])

    def _solved(self, start: Point, pressure: float, *, held: bool) -> Point | None:
        """Newton's method from a state nearby; None where it finds none."""
        unit = self.law.shear_modulus * self.base**2
        scale = np.array([self.base, 1.0, 1 / self.base, *[unit / self.base] * len(start.rigid)])
        weight = np.array([self.base / unit, 1 / unit, 1 / (self.base * unit), *[1.0] * len(start.rigid)])
        free = np.array([True, not held, not self.symmetric, *[True] * len(start.rigid)])
        x = np.array([start.inner, start.axial, start.twist, *start.rigid]) / scale

        def unbalanced(x: Array) -> Array:
            a, axial, twist, *rigid = (x * scale).tolist()
            return self._forces(Point(a, axial, twist, tuple(rigid)), pressure) * weight

        size = max(1.0, pressure / self.law.shear_modulus)
        for _ in range(PASSES):
            r = unbalanced(x)
            if not np.isfinite(r).all():
                return None
            if float(np.abs(r[free]).max()) < CLOSE * size:
                a, axial, twist, *rigid = (x * scale).tolist()
                return Point(a, axial, twist, tuple(rigid))
            J = np.empty((len(x), len(x)))
            for k in np.flatnonzero(free):
                ahead, behind = x.copy(), x.copy()
                ahead[k] += STEP
                behind[k] -= STEP
                J[:, k] = (unbalanced(ahead) - unbalanced(behind)) / (2 * STEP)
            try:
                change = np.linalg.solve(J[np.ix_(free, free)], -r[free])
            except np.linalg.LinAlgError:
                return None
            shape = np.abs(change[: int(free[:3].sum())]).max()
            x[free] += change * min(1.0, 0.2 / shape if shape > 0 else 1.0)
            if x[0] <= 0 or x[1] <= 0:
                return None
        return None


def _resisting(family: Family, strain: float) -> float:
    """Strain that a thread resists."""
    return strain if strain > 0 else family.compression * strain
