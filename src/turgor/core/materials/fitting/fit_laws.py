"""Fit of a law to any set of tests: least squares of the nominal stress, stable over the requested range."""

from collections.abc import Sequence
from math import log
from typing import Any, TypeAlias

import numpy as np
from scipy.optimize import least_squares

from turgor.core.materials.experiments.copies import check_copies
from turgor.core.materials.experiments.machine import check_machine
from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.experiments.slack import check_preload, check_slack, check_slip
from turgor.core.materials.fitting.checks import check_working_range, covered_range, fit_findings
from turgor.core.materials.fitting.constrained import solve_constrained
from turgor.core.materials.fitting.law_specs import law_spec, shape_bounds
from turgor.core.materials.fitting.points import (
    FitPoints,
    ModeRanges,
    different,
    modulus_row,
    off_zero,
    stability_rows,
    within,
)
from turgor.core.materials.fitting.result import Fit, FitResidual
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.fitting.uncertainty import Uncertainty, uncertainty_of
from turgor.core.materials.laws.homogeneous import equibiaxial, planar, uniaxial
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.laws.stability import Mode, instabilities
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding

#: How deviations are weighted; see `fit`.
WEIGHTS = ("relative", "absolute", "even")

Shapes: TypeAlias = Sequence[float] | Array


def fit(
    law: str | type | LawSpec,
    tests: MaterialTest | Sequence[MaterialTest],
    *,
    stretch: tuple[float, float] | None = None,
    weights: str = "relative",
    stable: bool = True,
    starts: int = 20,
    seed: int = 0,
) -> Fit:
    """Fit a law to one or more tests at once, by least squares of the nominal stress.

    The stress of every law is linear in its coefficients. Linear least squares finds the coefficients exactly, with
    inequality constraints for stability. Only exponents or a limiting stretch need a nonlinear search, from several
    starts.

    Parameters
    ----------
    law : str or type
        Name or class, such as ``"yeoh"``, ``"ogden-3"``, ``"rivlin-2"``, or ``Yeoh``.
    tests : MaterialTest or sequence of MaterialTest
        Tests of any modes. Every point has the same weight, so `thin` tests with many points.
    stretch : (float, float), optional [-]
        Requested range. Points outside are left out, and the law is stable inside, in every mode. By default all
        points count, and each mode is stable up to the first invariant of uniaxial tension at their largest stretch.
    weights : str
        ``"relative"`` divides deviations by the stress (at least 5 % of the test's largest); ``"absolute"`` does not.
        ``"even"`` is relative, and equal intervals of stretch count alike, as do all modes, however dense points are.
    stable : bool
        Whether uniaxial, equibiaxial and planar stresses must rise with the stretch; for Ogden all μᵢ αᵢ ≥ 0.
    starts, seed : int
        Number of random starts of the search for shape parameters, and their seed.

    Returns
    -------
    Fit
        Law, parameters with standard errors, error of every test, findings, and the `Material`.

    Examples
    --------
    >>> x = np.linspace(1.1, 2.0, 10)
    >>> test = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=0.24e6 * (x - x**-2), name="a strip")
    >>> round(fit("neo-hooke", test).values["C10"])
    120000
    """
    spec = law_spec(law)
    given = (tests,) if isinstance(tests, MaterialTest) else tuple(tests)
    _check(given, stretch, weights, starts)
    used = _used(given, stretch, spec)
    stable_range = _range(used, stretch)
    search = _Search(spec, FitPoints(used, weights), _mode_ranges(stable_range, strict=stretch is not None), stable)
    best, facts = _solved(search, starts, seed)
    fitted = Fit(
        **facts,
        quality=tuple(FitResidual.of(test, test.predicted(best)) for test in used),
        stretch=stable_range,
        stretch_range=covered_range(given, stable_range),
        instability=_instability(best, stable_range),
        weights=weights,
        tests=used,
    )
    return fitted.with_findings((*fit_findings(fitted, given), *check_tests(given, used, weights)))


def check_tests(given: Sequence[MaterialTest], used: Sequence[MaterialTest], weights: str = "") -> tuple[Finding, ...]:
    """Return the findings about tests, whole and as they are fitted: copies, slack, preload, slip, and their range."""
    chosen = () if weights == "even" else check_working_range(used)  # even weights are those of a range that was chosen
    measured = (*check_preload(given), *check_slip(given), *check_machine(given))
    return (*check_copies(given), *check_slack(used), *measured, *chosen)


def _used(
    tests: Sequence[MaterialTest], stretch: tuple[float, float] | None, spec: LawSpec
) -> tuple[MaterialTest, ...]:
    """Points of tests within the requested range; an error if there are too few."""
    used = tuple(part for part in (within(test, stretch) for test in tests) if part is not None)
    if not used and stretch is not None:
        raise TurgorError(f"no test has two points between stretch {stretch[0]:g} and {stretch[1]:g}.")
    there, least = different(used), len(spec.names) + 1
    if there < least:
        raise TurgorError(f"{spec.name} needs stresses at {least} different stretches or more; the tests have {there}.")
    return used


def _solved(search: "_Search", starts: int, seed: int) -> tuple[Any, dict[str, Any]]:
    """Find the law, and what a `Fit` states about its parameters."""
    spec = search.spec
    shapes, agreed = search.run(starts, seed) if spec.shapes else ((), 1)
    coefficients, active = search.coefficients(shapes)
    try:
        fitted = spec.make(coefficients.tolist(), shapes)
    except TurgorError as error:
        raise TurgorError(f"{spec.name} cannot be fitted to these tests: {error}") from error
    residual = search.residual(coefficients, shapes)
    search.check_linear(fitted, residual)
    known = search.uncertainty(coefficients, shapes, active)
    values = (*map(float, coefficients), *map(float, shapes))
    return fitted, {
        "spec": spec,
        "law": fitted,
        "values": dict(zip(spec.names, values, strict=True)),
        "errors": dict(zip(spec.names, map(float, known.errors), strict=True)),
        "correlation": known.correlation,
        "combination": known.combination(spec.names, values, len(spec.coefficients)),
        "bounds_hit": search.bounds_hit(coefficients, shapes, active),
        "aic": _aic(residual, len(spec.names)),
        "starts": (agreed, starts if spec.shapes else 1),
    }


class _Search:
    """Search for the shape parameters; for given shapes, linear least squares gives the coefficients."""

    def __init__(self, spec: LawSpec, points: FitPoints, ranges: ModeRanges, stable: bool) -> None:
        self.spec, self.points, self.stable = spec, points, stable
        invariants = [float((points.F**2).sum(axis=(1, 2)).max())]
        if stable:
            invariants += [float((mode(np.array(edges)) ** 2).sum(axis=(1, 2)).max()) for mode, edges in ranges]
        invariant = max(invariants)
        modulus = self._modulus()
        self.bounds = np.array(shape_bounds(spec, invariant)).reshape(-1, 2)
        self.G = np.empty((0, len(spec.coefficients)))
        self.h = np.empty(0)
        if spec.sign == "slope":
            rows, steps = stability_rows(spec, ranges) if stable else (self.G, self.h)
            self.G = np.vstack([rows, modulus_row(spec)])
            # a slope of exactly zero would count as unstable, so the limit is a small positive one
            self.h = FIT.least_share * modulus * np.append(steps, 1.0)
            self._slope_columns: Array | None = points.columns(spec, ())
        elif stable or spec.sign == "positive":
            self.G = np.eye(len(spec.coefficients))
            self.h = np.zeros(len(spec.coefficients))

    def _columns(self, shapes: Shapes) -> Array:
        if self.spec.sign == "slope":
            assert self._slope_columns is not None
            return self._slope_columns
        return self.points.columns(self.spec, shapes)

    def _modulus(self) -> float:
        """Neo-Hookean shear modulus of all points, as the scale of the stresses [Pa]."""
        column = self.points.columns(law_spec("neo-hooke"), ())[:, 0]
        modulus = 2 * float(column @ self.points.target / (column @ column))
        if not modulus > 0:
            raise TurgorError(
                f"the stresses of {self.points.names} have the wrong sign: tension shows negative stress, or "
                "compression positive stress; check the sign of the force."
            )
        return modulus

    def _signs(self, shapes: Shapes) -> Array:
        signs = np.ones(len(self.spec.coefficients))
        return np.where(np.asarray(shapes) < 0, -1.0, 1.0) if self.spec.sign == "shape" else signs

    def coefficients(self, shapes: Shapes) -> tuple[Array, Array]:
        """Return the best coefficients for given shapes, and the active constraints as rows."""
        best, active = solve_constrained(self._columns(shapes), self.points.target, self.G, self.h)
        if self.spec.sign != "slope" and len(self.G):
            best = np.where(active, 0.0, np.maximum(best, 0.0))
        return best * self._signs(shapes) + 0.0, self.G[active]

    def residual(self, coefficients: Array, shapes: Shapes) -> Array:
        """Return the weighted residual at every point."""
        return self._columns(shapes) @ (coefficients * self._signs(shapes)) - self.points.target

    def check_linear(self, law: Any, residual: Array) -> None:
        """Raise an error for a law whose stress is not linear in its coefficients."""
        own = self.points.stress(law) * self.points.weight - self.points.target
        if not np.allclose(own, residual, rtol=0.0, atol=1e-6 * float(np.abs(self.points.target).max())):
            raise TurgorError(f"{self.spec.name} cannot be fitted: its stress is not linear in its coefficients.")

    def _reduced(self, shapes: Array) -> Array:
        return self.residual(self.coefficients(shapes)[0], shapes)

    def run(self, starts: int, seed: int) -> tuple[tuple[float, ...], int]:
        """Search from several starts; return the best shapes and the number of starts with the same residual."""
        random = np.random.default_rng(seed)
        ends = [self._descend(self._start(random), 25, 1e-4) for _ in range(starts)]
        ends.sort(key=lambda end: end[0])
        ends[: FIT.refined_starts] = [self._descend(shapes, 200, 1e-10) for _, shapes in ends[: FIT.refined_starts]]
        cost, best = min(ends[: FIT.refined_starts], key=lambda end: end[0])
        floor = 1e-12 * float(self.points.target @ self.points.target)
        agreed = sum(end[0] <= 1.05 * cost + floor for end in ends)
        order = np.argsort(best) if self.spec.sign == "shape" else np.arange(len(best))
        ordered = [off_zero(value) if self.spec.sign == "shape" else float(value) for value in best[order]]
        return tuple(ordered), agreed

    def _descend(self, start: Array, steps: int, tolerance: float) -> tuple[float, Array]:
        end = least_squares(
            self._reduced,
            start,
            bounds=self.bounds.T,
            xtol=tolerance,
            ftol=tolerance,
            gtol=tolerance,
            max_nfev=steps,
            x_scale=np.maximum(np.abs(start), 0.5),
        )
        return float(end.cost), end.x

    def _start(self, random: np.random.Generator) -> Array:
        low, high = self.bounds.T
        if self.spec.sign == "positive":
            low = np.maximum(low, 1e-6 * high)  # a bound of zero has no logarithm
            return np.asarray(np.exp(random.uniform(np.log(low), np.log(high))))
        sizes = np.exp(random.uniform(np.log(0.5), np.log(10.0), len(low)))
        signs = np.where(random.random(len(low)) < 0.35, -1.0, 1.0)
        return np.asarray(np.clip(sizes * signs, low + 1e-6, high - 1e-6))

    def uncertainty(self, coefficients: Array, shapes: Sequence[float], active: Array) -> Uncertainty:
        """Return the uncertainty from the Jacobian, in the directions without an active constraint."""
        J = [self._columns(shapes) * self._signs(shapes)]
        for k, value in enumerate(shapes):
            step = 1e-5 * max(1.0, abs(value))
            ahead, behind = list(shapes), list(shapes)
            ahead[k], behind[k] = value + step, value - step
            J.append((self.residual(coefficients, ahead) - self.residual(coefficients, behind))[:, None] / (2 * step))
        jacobian = np.hstack(J)
        limits = [np.hstack([row, np.zeros(len(shapes))]) for row in active]
        for k in range(len(shapes)):
            at_bound = np.isclose(shapes[k], self.bounds[k], rtol=1e-4).any()
            idle = self.spec.sign != "slope" and coefficients[k] == 0
            if at_bound or idle:
                limits.append(np.eye(jacobian.shape[1])[len(coefficients) + k])
        return uncertainty_of(
            jacobian, self.residual(coefficients, shapes), np.array(limits).reshape(len(limits), jacobian.shape[1])
        )

    def bounds_hit(self, coefficients: Array, shapes: Sequence[float], active: Array) -> tuple[str, ...]:
        """Return a sentence for each active bound or constraint."""
        hit = []
        for name, value, (low, high) in zip(self.spec.shapes, shapes, self.bounds, strict=True):
            for bound in (low, high):
                if np.isclose(value, bound, rtol=1e-4):
                    hit.append(f"{name} is at its bound {bound:.4g}")
        if self.spec.sign == "shape" and self.stable:
            names = zip(self.spec.coefficients, coefficients, strict=True)
            hit += [f"{name} is 0: this term is not needed" for name, value in names if value == 0]
        elif len(active):
            hit.append("stability over the range limits the coefficients")
        return tuple(hit)


def _aic(residual: Array, parameters: int) -> float:
    count = len(residual)
    misfit = float(residual @ residual) / count
    return count * log(max(misfit, 1e-300)) + 2 * (parameters + 1)


def _mode_ranges(stable_range: tuple[float, float], *, strict: bool) -> ModeRanges:
    """Range of stretch in which each mode must be stable; see `fit`."""
    low, high = stable_range
    if strict:
        return tuple((mode, stable_range) for mode in (uniaxial, equibiaxial, planar))
    # at the I₁ of uniaxial tension: I₁ ≈ 2 λ² in equibiaxial and λ² in planar tension, for large stretches
    return ((uniaxial, stable_range), (equibiaxial, (low, max(high / np.sqrt(2), 1.0))), (planar, stable_range))


def _instability(law: Law, stretch: tuple[float, float]) -> dict[str, float]:
    """Stretch at which stability is first lost in a range, by the strictest criterion; stable modes are left out."""
    low, high = min(stretch[0], 1.0), max(stretch[1], 1.0)
    modes: tuple[Mode, ...] = ("uniaxial", "equibiaxial", "planar")
    unstable = {mode: instabilities(law, mode, high, low) for mode in modes}
    return {mode: float(next(iter(lost.values()))) for mode, lost in unstable.items() if lost}


def _range(tests: Sequence[MaterialTest], stretch: tuple[float, float] | None) -> tuple[float, float]:
    if stretch is not None:
        return stretch
    ranges = [test.range for test in tests if test.mode != "simple_shear"]
    if not ranges:
        sheared = max(float(np.abs(test.stretch).max()) for test in tests)
        return 1.0, float(sheared / 2 + np.sqrt(1 + sheared**2 / 4))  # largest principal stretch of simple shear
    return min(1.0, *(low for low, _ in ranges)), max(1.0, *(high for _, high in ranges))


def _check(tests: Sequence[MaterialTest], stretch: tuple[float, float] | None, weights: str, starts: int) -> None:
    if not tests:
        raise TurgorError("no test was given; a law needs at least one to be fitted to.")
    for test in tests:
        turn = test.first_turn()
        if turn is not None:
            raise TurgorError(
                f"test '{test.name}' turns round at point {turn + 1} (stretch {test.stretch[turn]:.4g}); choose one "
                "loading curve with select_cycle first."
            )
    if stretch is not None and not (0 < stretch[0] <= 1 < stretch[1] or 0 < stretch[0] < 1 <= stretch[1]):
        raise TurgorError(f"stretch is {stretch[0]:g} to {stretch[1]:g}; the range must include the undeformed 1.")
    if weights not in WEIGHTS:
        raise unknown("weights", weights, WEIGHTS)
    if starts < 1:
        raise TurgorError(f"starts is {starts}; at least 1 is needed.")
