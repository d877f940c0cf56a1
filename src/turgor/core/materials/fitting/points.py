"""Points of several tests as one linear system: weighted stresses, and the stress of each term of a law."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.homogeneous import nominal_stress
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.foundation.errors import TurgorError

#: The deformation of each mode with its range of stretch.
ModeRanges: TypeAlias = Sequence[tuple[Callable[[Any], Array], tuple[float, float]]]


class FitPoints:
    """Deformations, measured nominal stresses and weights of all tests in one row each.

    Parameters
    ----------
    tests : sequence of MaterialTest
        Tests of the fit.
    weights : str
        ``"relative"``, ``"absolute"`` or ``"even"``.
    """

    def __init__(self, tests: Sequence[MaterialTest], weights: str) -> None:
        self.measured = np.concatenate([test.measured for test in tests])
        self.F = np.concatenate([test.deformation for test in tests])
        rows, start = [], 0
        for test in tests:
            rows.append((start, test))
            start += len(test.stretch)
        self._rows = rows
        if weights in ("relative", "even"):
            floors = [np.maximum(np.abs(t.measured), FIT.weight_floor * np.abs(t.measured).max()) for t in tests]
            scale = np.concatenate(floors)
        else:
            scale = np.full(len(self.measured), np.abs(self.measured).max())
        if not (scale > 0).all():
            idle = next(test for test in tests if not np.any(test.measured))
            raise TurgorError(f"test '{idle.name}' has no stress at all; nothing can be fitted to it.")
        self.weight = (even_shares(tests) ** 0.5 if weights == "even" else 1.0) / scale
        self.target = self.measured * self.weight
        self._known: dict[Any, Array] = {}

    @property
    def names(self) -> str:
        """The tests, as messages name them."""
        return ", ".join(f"'{test.name}'" for _, test in self._rows)

    def stress(self, law: Any) -> Array:
        """Return the nominal stress of a law at every point, in the order of ``measured`` [Pa]."""
        P = nominal_stress(law, self.F)
        return np.concatenate([test.components(P[start : start + len(test.stretch)]) for start, test in self._rows])

    def columns(self, spec: LawSpec, shapes: Sequence[float] | Array) -> Array:
        """Return the weighted stress of the term of each coefficient, at a coefficient of 1; (m, n) array."""
        return columns_of(spec, shapes, lambda law: self.stress(law) * self.weight, self._known)


def even_shares(tests: Sequence[MaterialTest]) -> Array:
    """Return the weight of every point with which equal intervals of stretch, and all modes, count alike; mean 1.

    Parameters
    ----------
    tests : sequence of MaterialTest

    Examples
    --------
    >>> dense = [1.0, 1.01, 1.02, 1.03, 2.0]
    >>> even_shares([MaterialTest(mode="uniaxial", stretch=dense, nominal_stress=dense, name="a strip")]).round(2)
    array([0.02, 0.05, 0.05, 2.45, 2.42])
    """
    shares = [_intervals(test) for test in tests]
    count = sum(map(len, shares))
    modes = {test.mode for test in tests}
    for mode in modes:
        which = [n for n, test in enumerate(tests) if test.mode == mode]
        own = sum(len(shares[n]) for n in which)
        for n in which:
            shares[n] = shares[n] * count / (len(modes) * own)
    return np.concatenate(shares)


def _intervals(test: MaterialTest) -> Array:
    """Interval of stretch that each point stands for, over the mean one; 1 where stretches are no path."""
    if test.mode in ("biaxial", "simple_shear") or np.ptp(test.stretch) == 0:
        return np.ones(len(test.measured))
    order = np.argsort(test.stretch, kind="stable")
    stretch = test.stretch[order]
    middles = (stretch[1:] + stretch[:-1]) / 2
    shares = np.empty(len(stretch))
    shares[order] = np.diff(np.concatenate([stretch[:1], middles, stretch[-1:]]))
    return shares / shares.mean()


def columns_of(
    spec: LawSpec, shapes: Sequence[float] | Array, stress: Callable[[Any], Array], known: dict[Any, Array]
) -> Array:
    """Return the stress of each term of a law, evaluated with the law itself.

    Parameters
    ----------
    spec : LawSpec
        The law.
    shapes : sequence of float
        Its shape parameters.
    stress : callable
        ``stress(law)`` returns the stresses of a law.
    known : dict
        Stresses of the terms that were evaluated before, by shape; new ones are added.
    """
    if spec.sign == "slope":
        count = len(spec.coefficients)
        unit = np.eye(count)
        first = stress(spec.make(unit[0], ()))
        # a law must have a positive shear modulus, so the other terms are evaluated on top of the first
        return np.stack([first, *(stress(spec.make(unit[0] + unit[k], ())) - first for k in range(1, count))], axis=1)
    if spec.sign == "positive":
        return _columns_of_all(spec, tuple(map(float, shapes)), stress, known)
    columns = []
    for shape in shapes:
        value = off_zero(shape)
        if value not in known:
            known[value] = stress(spec.make([np.sign(value)], [value]))  # a positive shear modulus
        columns.append(known[value])
    return np.stack(columns, axis=1)


def _columns_of_all(
    spec: LawSpec, shapes: tuple[float, ...], stress: Callable[[Any], Array], known: dict[Any, Array]
) -> Array:
    """Stress of the term of each coefficient of a law whose terms may have any of the shapes."""
    if shapes not in known:
        unit = np.eye(len(spec.coefficients))
        known[shapes] = np.stack([stress(spec.make(each, shapes)) for each in unit.tolist()], axis=1)
    return known[shapes]


def off_zero(exponent: float) -> float:
    """Return an exponent of Ogden's law, moved away from 0, where the coefficient would tend to infinity.

    Examples
    --------
    >>> off_zero(-0.001), off_zero(2.0)
    (-0.05, 2.0)
    """
    sign = -1.0 if exponent < 0 else 1.0
    return sign * max(abs(float(exponent)), FIT.least_exponent)


def stability_rows(spec: LawSpec, ranges: ModeRanges) -> tuple[Array, Array]:
    """Return the constraints of stability: rows g, with stress increments g · coefficients, and stretch increments s.

    Both the nominal and the Cauchy stress must rise with the stretch.

    Parameters
    ----------
    spec : LawSpec
        A law without shape parameters.
    ranges : sequence of (mode, (float, float)) [-]
        The deformation of each mode as a function, and its range of stretch, which is extended to include 1.
    """
    rows, steps = [], []
    for mode, (low, high) in ranges:
        # a little beyond both ends, so that the slope at the ends counts too
        ends = min(low, 0.999) / FIT.beyond, max(high, 1.001) * FIT.beyond
        grid = np.geomspace(*ends, FIT.stability_points)
        F = mode(grid)
        nominal = columns_of(spec, (), partial(_pull, F), {})
        rows += [np.diff(nominal, axis=0), np.diff(nominal * grid[:, None], axis=0)]
        steps += [np.diff(grid)] * 2
    return np.concatenate(rows), np.concatenate(steps)


def modulus_row(spec: LawSpec) -> Array:
    """Return the initial shear modulus of each term, at a coefficient of 1; (n,) array [-]."""
    unit = np.eye(len(spec.coefficients))
    first = spec.make(unit[0], ()).shear_modulus
    rest = (spec.make(unit[0] + row, ()).shear_modulus - first for row in unit[1:])
    return np.array([first, *rest])


def within(test: MaterialTest, stretch: tuple[float, float] | None) -> MaterialTest | None:
    """Return the part of a test within a range of stretch; None where it has fewer than two points."""
    if stretch is None or test.mode == "simple_shear":
        return test
    low, high = stretch
    keep: NDArray[np.bool_] = (test.stretch >= low) & (test.stretch <= high)
    if test.stretch_2 is not None:
        keep &= test.stretch_2 <= high
    if keep.all():
        return test
    if keep.sum() < 2:
        return None
    return test.keeping(keep, f"Outside the stretch {low:g} to {high:g} that is fitted")


def _pull(F: Array, law: Any) -> Array:
    """Nominal stress of a law along the first axis, (n,) [Pa]."""
    return np.asarray(nominal_stress(law, F)[:, 0, 0])


def different(tests: Sequence[MaterialTest]) -> int:
    """Count the measured stresses at different stretches: fifty at one stretch say no more than one of them."""
    places: set[tuple[object, ...]] = set()
    for test in tests:
        second = test.stretch if test.stretch_2 is None else test.stretch_2
        axes = range(len(test.measured) // len(test.stretch))
        for place in np.round(np.stack([test.stretch, second], axis=-1), FIT.same_decimals).tolist():
            places.update((test.mode, *place, axis) for axis in axes)
    return len(places)
