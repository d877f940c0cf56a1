"""The points of several tests as one system: weighted stresses, and the stress of a law's terms at them."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.materials.experiments.material_test import Array, MaterialTest
from turgor.materials.laws.homogeneous import nominal_stress
from turgor.materials.laws.law_spec import LawSpec

#: The deformation of each mode with its range of stretch.
ModeRanges: TypeAlias = Sequence[tuple[Callable[[Any], Array], tuple[float, float]]]

#: Relative weights count a stress below this share of the largest of its test as if it were that share.
WEIGHT_FLOOR = 0.05

#: Smallest exponent of Ogden's law; below it two laws cannot be told apart by any test.
LEAST_EXPONENT = 0.05

#: Stretches at which stability is looked at, in each mode.
STABILITY_POINTS = 240
BEYOND = 1.005


class FitPoints:
    """Deformations, measured nominal stresses and weights of all tests in one row each.

    Parameters
    ----------
    tests : sequence of MaterialTest
        What to fit to.
    weights : str
        ``"relative"`` or ``"absolute"``.
    """

    def __init__(self, tests: Sequence[MaterialTest], weights: str) -> None:
        self.measured = np.concatenate([test.measured for test in tests])
        self.F = np.concatenate([test.deformation for test in tests])
        rows, start = [], 0
        for test in tests:
            rows.append((start, test))
            start += len(test.stretch)
        self._rows = rows
        if weights == "relative":
            floors = [np.maximum(np.abs(t.measured), WEIGHT_FLOOR * np.abs(t.measured).max()) for t in tests]
            scale = np.concatenate(floors)
        else:
            scale = np.full(len(self.measured), np.abs(self.measured).max())
        if not (scale > 0).all():
            raise TurgorError("a test has no stress at all; nothing can be fitted to it.")
        self.weight = 1.0 / scale
        self.target = self.measured * self.weight
        self._known: dict[float, Array] = {}

    def stress(self, law: Any) -> Array:
        """Nominal stress of a law at every point, in the order of ``measured`` [Pa]."""
        P = nominal_stress(law, self.F)
        return np.concatenate([test.components(P[start : start + len(test.stretch)]) for start, test in self._rows])

    def columns(self, spec: LawSpec, shapes: Sequence[float] | Array) -> Array:
        """Weighted stress of every coefficient's term at its unit value; (m, n) array."""
        return columns_of(spec, shapes, lambda law: self.stress(law) * self.weight, self._known)


def columns_of(
    spec: LawSpec, shapes: Sequence[float] | Array, stress: Callable[[Any], Array], known: dict[float, Array]
) -> Array:
    """Stress of each term of a law alone, from the law itself: nothing is written down twice.

    Parameters
    ----------
    spec : LawSpec
        The law.
    shapes : sequence of float
        Its shape parameters.
    stress : callable
        From a law to its stresses.
    known : dict
        Terms that were evaluated before, by their shape; new ones are added.
    """
    if spec.sign == "slope":
        count = len(spec.coefficients)
        unit = np.eye(count)
        first = stress(spec.make(unit[0], ()))
        # a law must have a positive shear modulus, so the other terms are evaluated on top of the first
        return np.stack([first, *(stress(spec.make(unit[0] + unit[k], ())) - first for k in range(1, count))], axis=1)
    found = []
    for shape in shapes:
        value = off_zero(shape) if spec.sign == "shape" else float(shape)
        if value not in known:
            known[value] = stress(_single(spec, value))
        found.append(known[value])
    return np.stack(found, axis=1)


def off_zero(exponent: float) -> float:
    """Return an exponent of Ogden's law, moved away from 0, where its coefficient would grow without limit.

    Examples
    --------
    >>> off_zero(-0.001), off_zero(2.0)
    (-0.05, 2.0)
    """
    sign = -1.0 if exponent < 0 else 1.0
    return sign * max(abs(float(exponent)), LEAST_EXPONENT)


def stability_rows(spec: LawSpec, ranges: ModeRanges) -> tuple[Array, Array]:
    """Return rows g and steps s: the stress of a law linear in its coefficients rises by g · coefficients over each s.

    Both the nominal and the Cauchy stress must rise with the stretch.

    Parameters
    ----------
    spec : LawSpec
        A law without shape parameters.
    ranges : sequence of (mode, (float, float)) [-]
        The deformation of each mode as a function, and its range of stretch, which is made to include 1.
    """
    rows, steps = [], []
    for mode, (low, high) in ranges:
        # a little beyond both ends, so that the slope at the very end counts, too
        grid = np.geomspace(min(low, 0.999) / BEYOND, max(high, 1.001) * BEYOND, STABILITY_POINTS)
        F = mode(grid)
        nominal = columns_of(spec, (), partial(_pull, F), {})
        rows += [np.diff(nominal, axis=0), np.diff(nominal * grid[:, None], axis=0)]
        steps += [np.diff(grid)] * 2
    return np.concatenate(rows), np.concatenate(steps)


def modulus_row(spec: LawSpec) -> Array:
    """Initial shear modulus of each unit coefficient; (n,) array [-]."""
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
    return np.asarray(nominal_stress(law, F)[:, 0, 0])


def _single(spec: LawSpec, shape: float) -> Any:
    """One term of a law with shape parameters, with a positive shear modulus."""
    return spec.make([np.sign(shape) if spec.sign == "shape" else 1.0], [shape])
