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

from turgor.core.materials.laws.derivatives import stretch_derivatives
from turgor.core.materials.laws.laws import Law
from turgor.fast_models.formulas.thick_walls import STEP

Array = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, slots=True)
class WoundTubeSettings:
    """How the equations of wound tubes are solved; all are without unit.

    Parameters
    ----------
    iterations, small_residual : int, float
        Newton's method: most iterations, and relative residual at its end.
    equal_stretches : float
        Principal stretches whose squares differ by less than twice this share count as equal.
    near : float
        How far from the last state the parabola through three may lead, relative.
    finest_step : float
        Finest cut of a step of the pressure, as a share.
    """

    iterations: int = 12
    small_residual: float = 1e-11
    equal_stretches: float = 1e-6
    near: float = 0.1
    finest_step: float = 1 / 1024


SETTINGS = WoundTubeSettings()


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

    def slopes(self, x: Array) -> Array:
        """Derivatives of the energy of the wall for each length by inner radius, axial stretch and twist, (n, 3).

        ``x`` has a state in each row: inner radius, axial stretch and twist come first.
        """
        R, area = self._points
        a, axial, twist = x[:, 0, None], x[:, 1, None], x[:, 2, None]
        beyond = R**2 - self.base**2
        g = a**2 + beyond / axial
        around, along, shear = g / R**2, axial**2 + twist**2 * g, twist * g / R  # C_ΘΘ, C_ZZ, C_ΘZ
        mean, half = (around + along) / 2, np.hypot((around - along) / 2, shear)
        l1 = np.sqrt(mean + half)
        l2 = axial * np.sqrt(g) / (R * l1)  # from the determinant of C, which does not lose digits
        l3 = 1 / (l1 * l2)
        _, W1, W2, W3, W11, _, _, W12, *_ = stretch_derivatives(self.law, l1, l2, l3)
        close = half < SETTINGS.equal_stretches * mean
        with np.errstate(invalid="ignore", divide="ignore"):
            apart = (W1 / l1 - W2 / l2) / (2 * half)
        by_C = np.where(close, ((W11 - W12) - W1 / l1) / (2 * l1**2), apart)  # S = own I + by_C C
        own = W1 / l1 - by_C * l1**2
        around, along, shear = own + by_C * around, own + by_C * along, by_C * shear  # S_ΘΘ, S_ZZ, S_ΘZ
        through = -W3 * l3  # ½ S_RR dC_RR = −½ W3 l3 d(det C)/det C, with det C = λz² g/R²
        by_g = around / R**2 + 2 * shear * twist / R + along * twist**2 + through / g
        by_axial = 2 * axial * along + 2 * through / axial - by_g * beyond / axial**2
        by_twist = 2 * g * (shear / R + along * twist)
        out = np.empty((len(x), 3))
        out[:, 0], out[:, 1], out[:, 2] = (2 * a * by_g) @ area, by_axial @ area, by_twist @ area
        return out / 2

    def threads(self, x: Array) -> tuple[Array, Array]:
        """Squares of the stretches of the families (n, f), and their derivatives by the first three of x (n, f, 3)."""
        a, axial, twist = x[:, 0, None], x[:, 1, None], x[:, 2, None]
        beyond = self.wound**2 - self.base**2
        square = a**2 + beyond / axial
        s, c, free = self._directions
        turned = s + c * twist * free
        squares = turned**2 * square + (c * axial) ** 2
        by_axial = 2 * c**2 * axial - turned**2 * beyond / axial**2
        slopes = np.empty((*squares.shape, 3))
        slopes[..., 0], slopes[..., 1], slopes[..., 2] = 2 * a * turned**2, by_axial, 2 * square * turned * c * free
        return squares, slopes

    def tensions(self, at: Point) -> Array:
        """Tension of each family for each width at rest [N/m]; negative where threads are pushed, (f,)."""
        x = self._row(at)
        return np.asarray(self._pulled(x, np.sqrt(self.threads(x)[0]))[0])

    def pull(self, at: Point, pressure: float) -> float:
        """Force that pulls at closed ends beyond that of the pressure [N]."""
        return float(self._forces(self._row(at), pressure)[0, 1])

    def follow(self, pressures: Array, *, axial: float | None = None) -> list[Point]:
        """Take the tube through pressures [Pa], its ends free or its stretch fixed; ends where no state is found."""
        points: list[Point] = []
        at = self.rest
        if axial is not None:
            for stretch in np.linspace(1.0, axial, max(2, int(abs(axial - 1) / 0.02) + 2))[1:]:
                reached = self._solved(self._moved(at, float(stretch)), 0.0, stretch_fixed=True)
                if reached is None:
                    return points
                at = reached
        path = [(0.0, at)]
        for pressure in pressures.tolist():
            share = 1.0
            while path[-1][0] != pressure:
                before = path[-1][0]
                target = pressure if share == 1.0 else before + share * (pressure - before)
                reached = self._next(path, target, stretch_fixed=axial is not None)
                if reached is not None:
                    path.append((target, reached))
                share = min(1.0, 2 * share) if reached is not None else share / 2
                if share < SETTINGS.finest_step:
                    return points
            points.append(path[-1][1])
        return points

    def _next(self, path: Sequence[tuple[float, Point]], pressure: float, *, stretch_fixed: bool) -> Point | None:
        """State at the next pressure, from the path continued as a parabola, or from its last state."""
        if len(path) > 3:
            knots = np.array([before for before, _ in path[-3:]])
            states = np.concatenate([self._row(at) for _, at in path[-3:]])
            weights = [
                np.prod([(pressure - other) / (knot - other) for other in knots if other != knot]) for knot in knots
            ]
            a, axial, twist, *rigid = (np.array(weights) @ states).tolist()
            near = abs(axial / states[-1, 1] - 1) + abs(a / states[-1, 0] - 1) < SETTINGS.near
            if near and (
                reached := self._solved(Point(a, axial, twist, tuple(rigid)), pressure, stretch_fixed=stretch_fixed)
            ):
                return reached
        return self._solved(path[-1][1], pressure, stretch_fixed=stretch_fixed)

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
        """The same threads at another axial stretch: exact for a rigid winding, and a first guess for the others."""
        for family in self.families:
            square = 1 - (np.cos(family.angle) * axial) ** 2
            if family.stiffness == inf and np.sin(family.angle) > 1e-9 and square > 0:
                b = self.wound * np.sqrt(square) / np.sin(family.angle)
                inner = b**2 - (self.wound**2 - self.base**2) / axial
                return Point(float(np.sqrt(max(inner, 1e-4 * self.base**2))), axial, at.twist, at.rigid)
        return Point(at.inner, axial, at.twist, at.rigid)

    @property
    def _directions(self) -> tuple[Array, Array, Array]:
        """Of each family: signed sine of its angle over the radius, cosine, and whether a twist turns it, (f,)."""
        s = np.array([np.sin(family.angle) * (family.hand or 1.0) for family in self.families]) / self.wound
        c = np.array([np.cos(family.angle) for family in self.families])
        return s, c, np.array([abs(family.hand) for family in self.families])

    def _row(self, at: Point) -> Array:
        return np.array([[at.inner, at.axial, at.twist, *at.rigid]])

    def _pulled(self, x: Array, stretches: Array) -> Array:
        """Tensions (n, f) from the stretches, those of rigid families from the unknowns."""
        rigid = np.isinf([family.stiffness for family in self.families])
        stiffness = np.where(rigid, 0.0, [family.stiffness for family in self.families])
        pushed = np.array([family.compression for family in self.families])
        strain = stretches - 1
        tension = stiffness * np.where(strain > 0, strain, pushed * strain)
        tension[:, rigid] = x[:, 3:]
        return np.asarray(tension)

    def _forces(self, x: Array, pressure: float) -> Array:
        """Residuals (n, m): by radius, axial stretch and twist; then by how much rigid threads stretch."""
        a, axial = x[:, 0], x[:, 1]
        out = self.slopes(x)
        out[:, 0] -= 2 * np.pi * pressure * a * axial
        out[:, 1] -= np.pi * pressure * a**2
        squares, slopes = self.threads(x)
        rigid = np.isinf([family.stiffness for family in self.families])
        stretches = np.sqrt(squares)
        share = self._pulled(x, stretches) / np.where(rigid, 1.0, stretches)
        # 2 π B for each length, and half of the derivative of the square
        out += np.pi * self.wound * np.einsum("nf,nfk->nk", share, slopes)
        return np.concatenate([out, squares[:, rigid] - 1], axis=1)

    def _solved(self, start: Point, pressure: float, *, stretch_fixed: bool) -> Point | None:
        """Newton's method from a state nearby; None where it does not converge."""
        unit = self.law.shear_modulus * self.base**2
        rigid = len(start.rigid)
        scale = np.array([self.base, 1.0, 1 / self.base, *[unit / self.base] * rigid])
        weight = np.array([self.base / unit, 1 / unit, 1 / (self.base * unit), *[1.0] * rigid])
        free = np.flatnonzero([True, not stretch_fixed, not self.symmetric, *[True] * rigid])
        x = self._row(start)[0] / scale
        steps = np.zeros((2 * len(free) + 1, len(x)))  # the state itself, then one step ahead and back in each unknown
        steps[1 + np.arange(len(free)), free] = STEP
        steps[1 + len(free) + np.arange(len(free)), free] = -STEP
        size = max(1.0, pressure / self.law.shear_modulus)
        for _ in range(SETTINGS.iterations):
            around = self._forces((x + steps) * scale, pressure)[:, free] * weight[free]
            r, ahead, back = around[0], around[1 : 1 + len(free)], around[1 + len(free) :]
            if not np.isfinite(around).all():
                return None
            if float(np.abs(r).max()) < SETTINGS.small_residual * size:
                a, axial, twist, *tension = (x * scale).tolist()
                return Point(a, axial, twist, tuple(tension))
            try:
                change = np.linalg.solve((ahead - back).T / (2 * STEP), -r)
            except np.linalg.LinAlgError:
                return None
            shape = np.abs(change[free < 3]).max()
            x[free] += change * min(1.0, 0.2 / shape if shape > 0 else 1.0)
            if x[0] <= 0 or x[1] <= 0:
                return None
        return None
