"""Fit a Prony series to relaxation tests, stress softening to cyclic tests, or both."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.fitting.histories.history_fit import HistoryFit, quality_of
from turgor.core.materials.fitting.histories.history_points import HistoryPoints
from turgor.core.materials.fitting.settings import DETERMINATION, FIT, HISTORY_FIT
from turgor.core.materials.history.softening import Mullins, softening
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.conventions import scaled_law
from turgor.core.materials.laws.laws import FiberLaw, FoamLaw, Law
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source


@dataclass(frozen=True, slots=True)
class _Search:
    """Nonlinear search; its variables are the logarithms of the relaxation times, 1/r, the logarithm of m, and β."""

    terms: int
    softening: bool
    beta: bool
    rescale: bool
    points: HistoryPoints

    @property
    def bounds(self) -> tuple[Array, Array]:
        low, high = self.points.span
        rows = [(np.log(low), np.log(10 * high))] * self.terms
        if self.softening:
            rows += [HISTORY_FIT.inverse_r, tuple(np.log(each * self.points.top) for each in HISTORY_FIT.m)]
            rows += [HISTORY_FIT.beta] if self.beta else []
        return np.array([row[0] for row in rows]), np.array([row[1] for row in rows])

    def parts(self, x: Array) -> tuple[Mullins | None, list[float]]:
        tau = np.exp(x[: self.terms])
        if not self.softening:
            return None, tau.tolist()
        inverse, m, *beta = (float(value) for value in x[self.terms :])
        return Mullins(r=1 / inverse, m=float(np.exp(m)), beta=beta[0] if beta else 0.0), tau.tolist()

    def residual(self, x: Array) -> Array:
        mullins, tau = self.parts(x)
        columns = self.points.columns(mullins, tau)
        return np.asarray(columns @ self.points.shares(columns, self.rescale) - self.points.measured)


def fit_history(
    law: Law,
    tests: MaterialTest | Sequence[MaterialTest],
    *,
    terms: int = 0,
    stress_softening: bool = False,
    beta: bool = False,
    rescale: bool = True,
) -> HistoryFit:
    """Fit a Prony series, stress softening, or both to tests with time; the form of the law stays as it is.

    The residual of each test is divided by its largest stress. The search finds relaxation times between the interval
    of the points and ten times the longest test. For given times, nonnegative least squares gives the shares gᵢ.

    Parameters
    ----------
    law : Law
        Law that was fitted to first loading curves.
    tests : MaterialTest or sequence of MaterialTest
        Tests with time, in uniaxial, equibiaxial or planar mode. Points at rest, as from `rest_below`, are not used.
    terms : int
        Terms of the Prony series; terms that come out as zero are left out.
    stress_softening : bool
        Whether to fit r and m; this needs cycles.
    beta : bool
        Whether to fit β too; this needs cycles to several largest stretches.
    rescale : bool
        Whether a factor multiplies the law: a law from tests of finite speed is neither instantaneous nor long-term.

    Returns
    -------
    HistoryFit

    Raises
    ------
    TurgorError
        If nothing is to be fitted, a test has no time or another mode, or the law is that of a foam or has directions.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> t = np.linspace(0.0, 40.0, 81)
    >>> stress = 2.5e5 * (0.7 + 0.3 * np.exp(-t / 4.0))
    >>> relaxing = MaterialTest(mode="uniaxial", stretch=0 * t + 1.5, nominal_stress=stress, time=t, name="relaxing")
    >>> fitted = fit_history(NeoHooke(C10=0.12e6), relaxing, terms=1)
    >>> round(fitted.values["tau1"], 4)
    4.0
    """
    tests = [tests] if isinstance(tests, MaterialTest) else list(tests)
    _check_relaxes(law)
    _check(tests, terms, stress_softening)
    search = _Search(terms, stress_softening, beta, rescale, HistoryPoints(law, tests, HISTORY_FIT.points))
    values = _values(search, _best(search))
    material = _material(law, values, search, tests)
    return HistoryFit(
        material=material,
        values=_of_scaled_law(values),
        **_uncertainty(search, values),
        largest_softening=_largest_softening(material.stress_softening, search.points.top * values["scale"]),
        quality=quality_of(material, tests),
    )


def _check_relaxes(law: Any) -> None:
    """Raise an error for a law that cannot relax or soften: the theory is that of the isochoric stress of a rubber."""
    name = type(law).__name__
    if isinstance(law, FiberLaw):
        raise TurgorError(
            f"{name} has directions, and relaxation and softening are fitted to isotropic rubbers only: a test does "
            "not show which part of the stress of rubber and fibers relaxes. Fit it without, or fit the rubber alone."
        )
    if isinstance(law, FoamLaw):
        raise TurgorError(
            f"{name} is the law of a foam, and relaxation and softening are fitted to rubbers only: a pull does not "
            "show whether the change of volume relaxes with the shape. Fit it without, or use the law of a rubber, "
            "such as yeoh, where the foam keeps its volume."
        )


def _check(tests: Sequence[MaterialTest], terms: int, stress_softening: bool) -> None:
    """Raise an error for no tests, for a negative number of terms, and for neither terms nor softening."""
    if not tests:
        raise TurgorError("no test was given; fit_history needs at least one test with time.")
    if terms < 0:
        raise TurgorError(f"terms is {terms}; the number of terms of the Prony series is 0 or more.")
    if not (terms or stress_softening):
        raise TurgorError(
            "terms is 0 and stress_softening is False; there is nothing to fit. Give terms=1 or stress_softening=True."
        )


def _best(search: _Search) -> Array:
    from scipy.optimize import least_squares

    low, high = search.bounds
    random = np.random.default_rng(0)
    starts = [low + (high - low) * random.uniform(0.1, 0.9, len(low)) for _ in range(HISTORY_FIT.starts)]
    fits = [least_squares(search.residual, start, bounds=(low, high)) for start in starts]
    return np.asarray(min(fits, key=lambda each: each.cost).x)


def _values(search: _Search, x: Array) -> dict[str, float]:
    """Parameters by name; terms are sorted by relaxation time, and those of zero share are left out."""
    mullins, tau = search.parts(x)
    shares = search.points.shares(search.points.columns(mullins, tau), search.rescale)
    scale = float(shares.sum())
    if not shares[0] > FIT.least_share * scale:
        raise TurgorError(
            f"terms is {search.terms}, and the tests relax without limit: no long-term stress is left. Give a longer "
            "test, or fewer terms."
        )
    terms = sorted((float(t), float(b)) for t, b in zip(tau, shares[1:], strict=True) if b > 1e-6 * scale)
    values = {"scale": scale}
    for n, (t, b) in enumerate(terms, 1):
        values |= {f"g{n}": b / scale, f"tau{n}": t}
    if mullins is not None:
        values |= {"r": mullins.r, "m": mullins.m} | ({"beta": mullins.beta} if search.beta else {})
    return values


def _of_scaled_law(values: Mapping[str, float]) -> dict[str, float]:
    """Parameters of the scaled law: m is an energy density and scales with the law."""
    return dict(values) | ({"m": values["m"] * values["scale"]} if "m" in values else {})


def _prony(values: Mapping[str, float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    count = sum(name.startswith("tau") for name in values)
    numbers = range(1, count + 1)
    return tuple(values[f"g{n}"] for n in numbers), tuple(values[f"tau{n}"] for n in numbers)


def _mullins(values: Mapping[str, float]) -> Mullins | None:
    return Mullins(r=values["r"], m=values["m"], beta=values.get("beta", 0.0)) if "r" in values else None


def _material(law: Law, values: Mapping[str, float], search: _Search, tests: Sequence[MaterialTest]) -> Material:
    g, tau = _prony(values)
    stretches = np.concatenate([test.stretch for test in tests])
    return Material(
        name="fitted rubber",
        law=scaled_law(law, values["scale"]),
        stretch_range=(min(1.0, float(stretches.min())), float(stretches.max())),
        source=Source(text=f"fitted to {', '.join(test.name for test in tests)}"),
        viscoelasticity=Prony(g=g, tau=tau, moduli="instantaneous") if g else None,
        stress_softening=_mullins(_of_scaled_law(values)),
    )


def _uncertainty(search: _Search, values: Mapping[str, float]) -> dict[str, Any]:
    """Standard errors, active bounds, and parameters that the tests do not determine."""
    at_bound = _active_bounds(search, values)
    free = [name for name in values if name not in at_bound and (search.rescale or name != "scale")]
    best = np.array([values[name] for name in free])
    predicted = partial(_predicted, search, dict(values), free)
    steps = 1e-4 * np.abs(best)
    rows = [(predicted(best + d) - predicted(best - d)) / (2 * d.sum()) for d in np.diag(steps)]
    jacobian = np.stack(rows, axis=1) if rows else np.empty((len(search.points.measured), 0))
    off = predicted(best) - search.points.measured
    variance = off @ off / max(1, len(off) - len(free))
    covariance = variance * np.linalg.pinv((jacobian * steps).T @ (jacobian * steps)) * np.outer(steps, steps)
    errors = dict.fromkeys(values, 0.0) | dict(zip(free, np.sqrt(covariance.diagonal()).tolist(), strict=True))
    if "m" in errors:
        errors["m"] *= values["scale"]
    loose = [
        name for name, value in _of_scaled_law(values).items() if errors[name] > DETERMINATION.large_error * abs(value)
    ]
    return {"errors": errors, "bounds_hit": tuple(at_bound.values()), "undetermined": tuple(loose)}


def _active_bounds(search: _Search, values: Mapping[str, float]) -> dict[str, str]:
    """Sentence about each parameter that is at a bound of the search, by name."""
    low, high = search.points.span
    edges = {name: (low, 10 * high, "s") for name in values if name.startswith("tau")}
    inverse, m, beta = HISTORY_FIT.inverse_r, HISTORY_FIT.m, HISTORY_FIT.beta
    edges |= {"r": (1 / inverse[1], 1 / inverse[0], ""), "beta": (*beta, "")}
    edges |= {"m": (m[0] * search.points.top, m[1] * search.points.top, "Pa of the law as given")}
    at_bound = {}
    for name, (least, most, unit) in edges.items():
        for edge, word in ((least, "smallest"), (most, "largest")):
            if name in values and abs(values[name] - edge) <= 1e-3 * (most if name == "beta" else edge):
                at_bound[name] = f"{name} is limited by the {word} value of the search, {edge:.4g} {unit}".rstrip()
    return at_bound


def _predicted(search: _Search, values: dict[str, float], free: Sequence[str], x: Array) -> Array:
    values = values | dict(zip(free, x.tolist(), strict=True))
    g, tau = _prony(values)
    columns = search.points.columns(_mullins(values), tau)
    return np.asarray(values["scale"] * (columns @ np.array([1 - sum(g), *g])))


def _largest_softening(mullins: Mullins | None, top: float) -> float:
    """Share of the stress that is lost near rest after the energy density ``top`` [Pa]."""
    return 0.0 if mullins is None else 1.0 - float(softening(mullins, 0.0, top)[0])
