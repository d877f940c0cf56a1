"""Fit of a law with directions to tension tests of specimens that were cut along the directions of a material."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from math import pi
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.law_spec import is_dimensionless
from turgor.core.materials.laws.laws import LAWS
from turgor.core.materials.laws.names import law_name
from turgor.core.materials.material import Material
from turgor.core.materials.orientation import Orientation
from turgor.core.materials.oriented import oriented_stress
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]

#: Tests with the direction that each specimen was cut along.
Cuts: TypeAlias = tuple[tuple[str, MaterialTest], ...]

#: How the material lies in a specimen that is pulled along x, by the direction it was cut along.
CUTS: Mapping[str, tuple[tuple[int, int, int], tuple[int, int, int]]] = {
    "along": ((1, 0, 0), (0, 1, 0)),
    "across": ((0, 1, 0), (1, 0, 0)),
    "through": ((0, 1, 0), (0, 0, 1)),
}

#: Largest value of each number without a unit; the least is 0.
_LIMITS: Mapping[str, float] = {"k2": 50.0, "kappa": 1 / 3, "angle": pi / 2}

#: Steps of the search for the width of a specimen, the change of its logarithm for a slope, and that of the last step.
_STEPS, _STEP, _LAST = 40, 1e-6, 1e-6


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DirectionsFit:
    """A law with directions that was fitted.

    Parameters
    ----------
    law : any law
        Such as `Orthotropic`.
    angle : float [rad]
        Of two families of fibers to the first direction.
    values, errors : dict of str to float
        Parameters that were fitted, in SI units, and their standard errors.
    relative : float [-]
        Root mean square of the deviations over the stresses.
    tests : tuple of (str, MaterialTest)
        What it was fitted to, with the direction of each specimen.
    """

    law: Any
    angle: float
    values: Mapping[str, float]
    errors: Mapping[str, float]
    relative: float
    tests: Cuts = ()

    __repr__ = brief

    def material(self, cut: str = "along") -> Material:
        """Return the material, with its directions in a specimen that is pulled along x.

        Parameters
        ----------
        cut : str
            Direction that the specimen was cut along.
        """
        return _lying(self.law, self.angle, cut)

    def stress(self, cut: str, stretch: Array) -> Array:
        """Return the nominal stress [Pa] of a specimen that was cut along a direction, at stretches [-]."""
        return specimen_stress(self.material(cut), stretch)

    def off(self, cut: str, test: MaterialTest) -> float:
        """Return the root mean square of the deviations from a test, over its stresses.

        Parameters
        ----------
        cut : str
            Direction that its specimen was cut along.
        test : MaterialTest
        """
        return float(np.sqrt(np.mean(_deviations(self.material(cut), test) ** 2)))


def fit_directions(
    law: str,
    tests: Mapping[str, MaterialTest | Sequence[MaterialTest]],
    *,
    fixed: Mapping[str, float] | None = None,
    starts: int = 4,
    seed: int = 0,
) -> DirectionsFit:
    """Fit a law with directions to uniaxial tests of specimens that were cut along them.

    Parameters
    ----------
    law : str
        ``"orthotropic"`` or ``"holzapfel_gasser_ogden"``, whose angle of fibers is fitted, too.
    tests : mapping of str to MaterialTest, or to several
        Uniaxial tests by the direction of the specimen: ``"along"`` the first one, ``"across"``, the second one, or
        ``"through"``, the third one. Each specimen contracts as its free directions like.
    fixed : mapping of str to float, optional
        Parameters that are known, in SI units, such as ``{"a3": 0.0}``.
    starts, seed : int
        Number of random starts of the search, and their seed.

    Returns
    -------
    DirectionsFit

    Raises
    ------
    TurgorError
        If the tests do not determine a parameter.

    Examples
    --------
    >>> x = np.linspace(1.05, 1.5, 10)
    >>> strip = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=2e6 * (x - x**-2), name="a print")
    >>> result = fit_directions("orthotropic", {"along": strip, "across": strip}, fixed={"a3": 0.0, "C20": 0, "C30": 0})
    >>> round(result.values["C10"] / 1e6, 3)
    1.0
    """
    kind: Any = LAWS[law_name(law)]
    if not hasattr(kind, "families"):
        raise TurgorError(f"{kind.__name__} has no directions; fit it with fit.")
    known = tuple(
        (cut, each) for cut, some in tests.items() for each in ([some] if isinstance(some, MaterialTest) else some)
    )
    _check(known)
    search = _Search.of(kind, known, dict(fixed or {}))
    random = np.random.default_rng(seed)
    ends = [search.descend(random.uniform(0.02, 1.0, len(search.names))) for _ in range(starts)]
    best = min(ends, key=lambda end: float(end.cost))
    return search.result(best.x, best.jac)


def specimen_stress(material: Material, stretch: Array) -> Array:
    """Nominal stress [Pa] of a specimen that is pulled along x, its other two directions free of traction.

    Parameters
    ----------
    material : Material
        With a law with directions.
    stretch : (n,) array [-]
    """
    z = -0.5 * np.log(stretch)
    for _ in range(_STEPS):
        pull, across = _stress(material, np.tile(stretch, 2), np.concatenate([z, z + _STEP]))
        now, then = np.split(across, 2)
        change = np.clip(-now * _STEP / (then - now), -0.2, 0.2)
        z = z + change
        if not np.abs(change).max() > _LAST:
            break
    by_width = np.diff(np.split(pull, 2), axis=0)[0] / _STEP
    return np.asarray((np.split(pull, 2)[0] + by_width * change) / stretch)


def _stress(material: Material, stretch: Array, z: Array) -> tuple[Array, Array]:
    """Cauchy stress along the pull and across it, the third direction being free."""
    F = np.zeros((len(stretch), 3, 3))
    F[:, 0, 0], F[:, 1, 1] = stretch, np.exp(z)
    F[:, 2, 2] = 1 / (stretch * F[:, 1, 1])
    stress = oriented_stress(material, F)
    return stress[:, 0, 0], stress[:, 1, 1]


@dataclass(frozen=True, slots=True)
class _Search:
    """Parameters that are searched for, each over its size, and what they are compared with."""

    kind: Any
    tests: Cuts
    fixed: Mapping[str, float]
    names: tuple[str, ...]
    sizes: Array

    @staticmethod
    def of(kind: Any, tests: Cuts, fixed: Mapping[str, float]) -> "_Search":
        pressures = [item.name for item in fields(kind) if not is_dimensionless(item)]
        angle = ("angle",) if "k1" in pressures else ()
        every = (*(item.name for item in fields(kind)), *angle)
        for name in fixed:
            if name not in every:
                raise unknown("parameter", name, every)
        names = tuple(name for name in every if name not in fixed)
        slope = max(_slope(test) for _, test in tests)
        return _Search(kind, tests, fixed, names, np.array([_LIMITS.get(name, slope) for name in names]))

    def law(self, x: Array) -> tuple[Any, float]:
        """The law, and the angle of its fibers, of parameters over their sizes."""
        values = {**self.fixed, **dict(zip(self.names, map(float, x * self.sizes), strict=True))}
        angle = values.pop("angle", 0.0)
        return self.kind(**values), angle

    def residual(self, x: Array) -> Array:
        """Deviations over the stresses, at least a share of the largest one."""
        law, angle = self.law(x)
        return np.concatenate([_deviations(_lying(law, angle, cut), test) for cut, test in self.tests])

    def descend(self, start: Array) -> Any:
        """Search from a start within the bounds; the first coefficient stays positive."""
        low = np.where(np.array(self.names) == "C10", 1e-6, 0.0)
        high = np.array([1.0 if name in _LIMITS else np.inf for name in self.names])
        return least_squares(self.residual, start, bounds=(low, high), xtol=1e-10, ftol=1e-10, gtol=1e-10)

    def result(self, x: Array, jacobian: Array) -> DirectionsFit:
        """The fit at the best parameters."""
        x = np.where(x < FIT.least_share**2, 0.0, x)  # a bound is met to round-off only
        residual, (law, angle) = self.residual(x), self.law(x)
        idle = [name for name, column in zip(self.names, jacobian.T, strict=True) if not np.abs(column).max() > 1e-9]
        if idle:
            raise TurgorError(f"the tests do not determine {', '.join(idle)}; state it in fixed, or add a test.")
        spread = float(residual @ residual) / max(len(residual) - len(x), 1)
        variance = np.diag(np.linalg.pinv(jacobian.T @ jacobian)) * spread
        return DirectionsFit(
            law=law,
            angle=angle,
            values=dict(zip(self.names, map(float, x * self.sizes), strict=True)),
            errors=dict(zip(self.names, map(float, np.sqrt(variance) * self.sizes), strict=True)),
            relative=float(np.sqrt(np.mean(residual**2))),
            tests=self.tests,
        )


def _slope(test: MaterialTest) -> float:
    """Neo-Hookean modulus of a test, 2 C10 [Pa]: the size of its parameters."""
    shape = test.stretch - test.stretch**-2
    slope = float(shape @ test.nominal_stress) / max(float(shape @ shape), 1e-300)
    if not slope > 0:
        raise TurgorError(f"the stress of test '{test.name}' does not rise with the stretch; check its sign.")
    return slope


def _lying(law: Any, angle: float, cut: str) -> Material:
    """The material as it lies in a specimen."""
    first, second = CUTS[cut]
    return Material(name=cut, law=law, orientation=Orientation(along=first, across=second, angle=angle))


def _deviations(material: Material, test: MaterialTest) -> Array:
    """Deviations from a test over its stresses, at least a share of the largest one."""
    measured = test.nominal_stress
    scale = np.maximum(np.abs(measured), FIT.weight_floor * np.abs(measured).max())
    return np.asarray((specimen_stress(material, test.stretch) - measured) / scale)


def _check(tests: Cuts) -> None:
    if not tests:
        raise TurgorError(
            "no test was given; a law with directions needs one along each direction that is to be known."
        )
    for cut, test in tests:
        if cut not in CUTS:
            raise unknown("direction of a specimen", cut, CUTS)
        if test.mode != "uniaxial":
            raise TurgorError(
                f"test '{test.name}' is {test.mode}; specimens cut along a direction are pulled uniaxially."
            )
